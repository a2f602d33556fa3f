//! This file runs the human-subject experiment with simulated operators: three of them, as in §6.5.1.

use std::sync::OnceLock;

use rigproof_model::control::GainUnit;
use rigproof_model::control::path::Line;
use rigproof_model::operator::Abilities;
use rigproof_model::trial::{LINES, Metrics, trial};
use rigproof_spec::layout::Layout;
use rigproof_spec::methods::Method;

use crate::Error;

/// The configurations, in the order of tables C.1 to C.6.
pub const LAYOUTS: [Layout; 2] = [Layout::ThreeBrake, Layout::FourBrake];

/// A controller as it was tried.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tried {
    /// Its letter (table 6.2).
    pub letter: &'static str,
    /// In words.
    pub words: &'static str,
    pub method: Method,
    pub unit: GainUnit,
}

const N: Tried = row("N", "no control", Method::Uncontrolled);
const S: Tried = row("S", "SDOF", Method::Sdof);
const G: Tried = row("G", "SDOF with gap", Method::SdofWithGap);
const H: Tried = row("H", "high gain", Method::ProportionalHigh);
const L: Tried = row("L", "low gain, 5 N·s/cm", Method::ProportionalLow);

/// The five of table 6.2 in its order, the gains read as N·s/cm (erratum `gain-unit`).
pub const FIVE: [Tried; 5] = [N, S, G, H, L];

/// The low gain in its printed unit.
pub const AS_PRINTED: Tried = Tried {
    letter: "L as printed",
    words: "low gain, 5 N·s/m",
    method: Method::ProportionalLow,
    unit: GainUnit::PerMetre,
};

/// All that were tried.
pub const ALL: [Tried; 6] = [N, S, G, H, L, AS_PRINTED];

const fn row(letter: &'static str, words: &'static str, method: Method) -> Tried {
    Tried {
        letter,
        words,
        method,
        unit: GainUnit::PerCentimetre,
    }
}

/// The three operators: that of decision 0047, one who sees later, and one with a softer hand (decision 0063).
const OPERATORS: [Abilities; 3] = [
    Abilities::CAREFUL,
    Abilities {
        delay_s: 0.22,
        ..Abilities::CAREFUL
    },
    Abilities {
        correction_n_per_m: 35.0,
        damping_n_s_per_m: 14.0,
        ..Abilities::CAREFUL
    },
];
/// Runs of each operator under each set of conditions: people had three (§6.5.1), with which a median still hangs on a few.
const RUNS: u64 = 9;

/// One run of the experiment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trial {
    pub layout: Layout,
    /// 1 or 2.
    pub line: u8,
    pub tried: Tried,
    /// 1, 2 or 3.
    pub operator: u8,
    pub metrics: Metrics,
}

/// Every run, in the order of the tables; three figures show them, and the first that asks has them run.
pub fn all() -> Result<&'static [Trial], Error> {
    static RUNS_OF_ALL: OnceLock<Result<Vec<Trial>, Error>> = OnceLock::new();
    let trials = RUNS_OF_ALL.get_or_init(run_all).as_ref();
    trials.map(Vec::as_slice).map_err(Clone::clone)
}

fn run_all() -> Result<Vec<Trial>, Error> {
    let mut trials = Vec::new();
    for (layout, line) in LAYOUTS.into_iter().flat_map(|l| [(l, 1), (l, 2)]) {
        for tried in ALL {
            trials.extend(group(layout, line, tried)?);
        }
    }
    Ok(trials)
}

/// The runs of one set of conditions.
fn group(layout: Layout, line: u8, tried: Tried) -> Result<Vec<Trial>, Error> {
    let refused = |error| Error::model("a trial of the simulated operator", error);
    let segment = match line {
        1 => LINES[0],
        _ => LINES[1],
    };
    let path = Line::through(segment.from_m, segment.to_m).map_err(refused)?;
    let mut trials = Vec::new();
    for (operator, abilities) in (1..).zip(OPERATORS) {
        for run in 0..RUNS {
            // Every run has an aim and a tremor of its own.
            let seed = 1009 * u64::from(operator) + 7919 * run + 31;
            let (method, unit) = (tried.method, tried.unit);
            let record = trial(layout, method, unit, segment, abilities, seed).map_err(refused)?;
            if !record.arrived {
                let problem = format!(
                    "operator {operator} does not reach the end of line {line} with {} in 20 s",
                    tried.words
                );
                return Err(Error::model("a trial of the simulated operator", problem));
            }
            trials.push(Trial {
                layout,
                line,
                tried,
                operator,
                metrics: record.metrics(&path).map_err(refused)?,
            });
        }
    }
    Ok(trials)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_runs_are_those_of_the_experiment_and_come_out_the_same_twice() {
        let of = || group(Layout::FourBrake, 2, H).unwrap();
        let first = of();
        // Three times the 180 sets of data of §6.5.1, and as many again of the low gain as printed as of any controller.
        let groups = 2 * LAYOUTS.len() * ALL.len();
        assert_eq!(groups * first.len(), 3 * (180 + 36));
        assert_eq!(first, of());
        // Different operators and runs, not one run many times.
        for (index, trial) in first.iter().enumerate() {
            let others = first.iter().skip(index + 1);
            assert!(
                others
                    .map(|other| other.metrics)
                    .all(|m| m != trial.metrics)
            );
        }
    }
}
