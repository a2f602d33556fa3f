//! This file describes what no mechanism of the library explains, as a free curve over one
//! variable.

mod variables;

use crate::cause::Place;
use crate::problem::{Problem, Rows};
use crate::regression::{Blocks, left_out_loss};
use crate::report::Unknown;
use crate::rules::{BLOCKS_A_KNOT, CURVE_SHARE, KNOTS, PARITY_TIMES};
pub use variables::variables;

/// The curve over position, speed, time or effort that removes most of the residual; `None` if none
/// helps.
pub fn unknown(problem: &Problem, residual: &[f64]) -> Option<Unknown> {
    let screened = screen(problem, residual, over(problem));
    let best = screened
        .into_iter()
        .filter(|(_, share)| *share > CURVE_SHARE)
        .max_by(|a, b| a.1.total_cmp(&b.1));
    best.map(|(variable, share)| describe(problem, residual, &variable, share))
}

/// Each variable with the share of the left-out loss that a free curve over it removes.
fn screen(problem: &Problem, residual: &[f64], variables: Vec<Variable>) -> Vec<(Variable, f64)> {
    let blocks = Blocks::new(problem);
    let plain = left_out(problem, residual, &[], &blocks).max(1e-300);
    variables
        .into_iter()
        .map(|variable| {
            let curve = variable.columns(problem, &blocks);
            let share = 1.0 - left_out(problem, residual, &curve, &blocks) / plain;
            (variable, share)
        })
        .collect()
}

/// A variable over which a free curve can be drawn. Every list has one value per row.
pub struct Variable {
    /// `position`, `speed`, `time`, `effort` or `load`.
    pub name: &'static str,
    /// Its unit.
    pub unit: String,
    /// Whether the curve is a friction level, whose effort acts along the motion.
    pub level: bool,
    /// The place at which the described effort would act.
    pub at: Place,
    /// Its values.
    pub values: Vec<f64>,
    /// The direction of motion.
    pub sense: Vec<f64>,
    /// The row entry of a unit of effort at that place.
    pub share: Vec<f64>,
}

fn over(problem: &Problem) -> Vec<Variable> {
    problem.run.variables(&problem.windows)
}

impl Variable {
    /// The row entries of a curve of height 1.
    fn effect(&self) -> impl Iterator<Item = f64> + Clone {
        let pairs = self.sense.iter().zip(&self.share);
        pairs.map(|(sense, share)| if self.level { sense * share } else { *share })
    }

    fn knots(&self, blocks: &Blocks) -> Vec<f64> {
        let count = match self.name {
            "time" => (blocks.ranges.len() / BLOCKS_A_KNOT + 1).min(KNOTS),
            _ => KNOTS,
        };
        knots(&self.values, count)
    }

    /// Piecewise linear basis functions with equal shares of the windows.
    fn columns(&self, problem: &Problem, blocks: &Blocks) -> Vec<Rows> {
        let knots = self.knots(blocks);
        let rows = self.values.iter().zip(self.effect());
        (0..knots.len())
            .map(|k| {
                let hat = |(v, effect): (&f64, f64)| hat(&knots, k, *v) * effect;
                problem.rows_of(rows.clone().map(hat).collect())
            })
            .collect()
    }
}

/// The left-out loss of the residual with these columns.
fn left_out(problem: &Problem, residual: &[f64], columns: &[Rows], blocks: &Blocks) -> f64 {
    let white = problem.whitener.whiten(residual);
    left_out_loss(&white, columns, blocks)
}

/// Quantiles of the values, with equal shares between them.
fn knots(values: &[f64], count: usize) -> Vec<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let last = sorted.len().saturating_sub(1);
    let mut knots: Vec<f64> = (0..count)
        .filter_map(|k| sorted.get(k * last / (count - 1)).copied())
        .collect();
    knots.dedup();
    knots
}

fn hat(knots: &[f64], k: usize, value: f64) -> f64 {
    let at = |i: Option<usize>| i.and_then(|i| knots.get(i)).copied();
    let (Some(here), before, after) = (at(Some(k)), at(k.checked_sub(1)), at(Some(k + 1))) else {
        return 0.0;
    };
    match (before, after) {
        (Some(b), _) if value < here => ((value - b) / (here - b)).max(0.0),
        (_, Some(a)) if value > here => ((a - value) / (a - here)).max(0.0),
        _ => 1.0,
    }
}

fn describe(problem: &Problem, residual: &[f64], variable: &Variable, share: f64) -> Unknown {
    let knots = variable.knots(&Blocks::new(problem));
    let branch = |rising| means(problem, &knots, variable, residual, rising);
    let all = branch(None);
    let gap: Vec<f64> = branch(Some(true))
        .iter()
        .zip(branch(Some(false)))
        .map(|(r, f)| r - f)
        .collect();
    let memory = spread(&gap) > spread(&all);
    let parity = parity(&all);
    Unknown {
        variable: variable.name,
        joint: problem.run.place_name(variable.at),
        variable_unit: variable.unit.clone(),
        along_motion: variable.level,
        share,
        shape: knots.into_iter().zip(all).collect(),
        memory,
        parity,
        suggestion: suggestion(variable, memory, parity).to_owned(),
    }
}

/// Mean residual near each knot, over all windows or over those in which the variable rises or
/// falls.
fn means(
    problem: &Problem,
    knots: &[f64],
    variable: &Variable,
    residual: &[f64],
    rising: Option<bool>,
) -> Vec<f64> {
    let outputs = problem.windows.outputs;
    let effect: Vec<f64> = variable.effect().collect();
    (0..knots.len())
        .map(|k| {
            let (mut sum, mut weight) = (0.0, 1e-12);
            let later = variable
                .values
                .iter()
                .zip(variable.values.iter().skip(outputs));
            let rows = residual
                .iter()
                .zip(&effect)
                .zip(&variable.share)
                .skip(outputs);
            let usable = problem.windows.usable.iter().skip(outputs);
            for (((before, now), ((r, effect), share)), _) in
                later.zip(rows).zip(usable).filter(|(_, u)| **u)
            {
                if rising.is_none_or(|up| up == (now > before)) {
                    let w = hat(knots, k, *now);
                    sum += w * (r * effect);
                    weight += w * (share * share);
                }
            }
            sum / weight
        })
        .collect()
}

fn spread(values: &[f64]) -> f64 {
    let mean = values.iter().sum::<f64>() / values.len().max(1) as f64;
    (values.iter().map(|v| (v - mean) * (v - mean)).sum::<f64>() / values.len().max(1) as f64)
        .sqrt()
}

/// Whether the curve is odd or even about its middle.
fn parity(shape: &[f64]) -> &'static str {
    let mean = shape.iter().sum::<f64>() / shape.len().max(1) as f64;
    let (mut odd, mut even) = (0.0, 0.0);
    for (a, b) in shape.iter().zip(shape.iter().rev()) {
        odd += (a - b) * (a - b);
        even += (a + b - 2.0 * mean) * (a + b - 2.0 * mean);
    }
    match odd.total_cmp(&even) {
        _ if odd > PARITY_TIMES * even => "odd",
        _ if even > PARITY_TIMES * odd => "even",
        _ => "neither",
    }
}

fn suggestion(variable: &Variable, memory: bool, parity: &str) -> &'static str {
    match (variable.name, memory, parity) {
        ("position", _, _) if variable.level => {
            "a friction that changes along the travel (a guide, a screw, a seal)"
        }
        ("time", _, _) if variable.level => {
            "a friction that changes during the recording (temperature, settling, wear); time and dissipated energy cannot be told apart here"
        }
        (_, _, _) if variable.level => "a friction that depends on the load that it carries",
        ("speed", false, "odd") => {
            "a friction law that is not a straight line over speed (drag that grows faster, or fades)"
        }
        ("speed", false, _) => "a resistance that depends on the direction of motion",
        ("speed", true, _) => {
            "a friction that remembers the motion (breakaway, settling, lubricant film)"
        }
        ("position", false, _) => {
            "a force along the travel (a guide, a cable, a spring that stiffens)"
        }
        ("position", true, _) => {
            "a force along the travel with memory (backlash, cable or belt hysteresis)"
        }
        ("time", _, _) => {
            "a slow change during the recording (temperature, settling, wear); time and dissipated energy cannot be told apart here"
        }
        (_, true, _) => "a drive or sensor with memory",
        _ => {
            "a drive that is not a straight line (saturation, dead zone), or friction that grows with load"
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    use crate::plant::Run;
    use crate::plants::joint::recorded::exact_bench;
    use rigproof_spec::effect::Mechanism;

    #[test]
    fn a_curve_over_the_position_is_found_and_drawn() {
        let run = exact_bench(&[(Mechanism::Viscous, &[2.3])], 11_000);
        let problem = Problem::new(&run, run.windows_of(0.043));
        let centres = &problem.windows.centres;
        let residual: Vec<f64> = centres
            .iter()
            .map(|c| 0.9 * (run.motion[*c].position / 0.5).powi(3))
            .collect();
        let unknown = unknown(&problem, &residual).unwrap();
        assert_eq!(
            (unknown.variable, unknown.parity, unknown.memory),
            ("position", "odd", false)
        );
        assert!(unknown.share > 0.9, "{}", unknown.share);
    }

    #[test]
    fn a_friction_whose_level_fades_is_no_dry_friction() {
        let run = exact_bench(&[(Mechanism::Viscous, &[2.3])], 11_000);
        let problem = Problem::new(&run, run.windows_of(0.043));
        let centres = &problem.windows.centres;
        // The residual of a friction level that falls along the recording, after a constant level
        // was fitted.
        let residual: Vec<f64> = centres
            .iter()
            .map(|c| &run.motion[*c])
            .map(|now| now.sense * 0.9 * (0.5 - now.time_s / run.clock().duration_s()))
            .collect();
        let unknown = unknown(&problem, &residual).unwrap();
        assert_eq!((unknown.variable, unknown.along_motion), ("time", true));
        assert!(unknown.shape.windows(2).all(|w| w[1].1 < w[0].1));
    }

    #[test]
    fn hats_add_up_to_one_between_the_end_knots() {
        let knots = [-1.3, -0.2, 0.7, 2.9];
        for value in [-1.1, -0.2, 0.31, 2.3] {
            let sum: f64 = (0..4).map(|k| hat(&knots, k, value)).sum();
            assert!((sum - 1.0).abs() < 1e-12, "{value}: {sum}");
        }
        assert_eq!(hat(&knots, 1, 0.7), 0.0);
    }
}
