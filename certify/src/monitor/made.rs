//! This file runs the trials of a certificate again with the monitor beside them: what they covered, and how far each statistic went.

use rayon::prelude::*;
use rigproof_impl::monitor::Monitor;
use rigproof_impl::monitor::constants::{Constants, WATCHED};
use rigproof_impl::monitor::sought::SIGMAS;
use serde::Serialize;

use super::drill;
use super::middle::constants;
use crate::certificate::Certificate;
use crate::controller::Source;
use crate::hand::Hand;
use crate::plan::Plan;
use crate::scenario::{Rig, Scenario};
use crate::trial;

/// Length of a use, samples: ninety seconds, in which the monitor learns the rig as it does in use.
const USE_TICKS: u32 = 90_000;
/// For so many trials there is one use, three in four of them an operator's: together longer than the trials of 10 s.
const TRIALS_OF_USE: u64 = 4;
/// How far beyond what the certificate's trials and uses came to a statistic has to be. The greatest of n trials is passed by the next n with a
/// chance of one half; the excess of a statistic with exponential tails over it is then a small share of it.
const BEYOND: f64 = 1.25;
/// Standard deviations beyond its end that a number may come to in trials and uses without a margin: as many as are enough for an alarm, less
/// the same share.
const SILENT_SIGMAS: f64 = SIGMAS / BEYOND;
/// Least mean square of the surprise that is ever enough: of 16 rows the 0.1 % point of the chi-squared distribution over 16.
const LEAST_SURPRISE: f64 = 2.45;

/// A monitor for one rig of a certificate.
#[derive(Clone, Debug)]
pub struct Made {
    /// The rig.
    pub rig: Rig,
    /// Its numbers.
    pub constants: Constants,
    /// What they rest on.
    pub basis: Basis,
}

/// What the trials came to.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Basis {
    /// Trials that were run again.
    pub trials: u64,
    /// Their samples.
    pub samples: u64,
    /// Samples of longer use of its rigs by operators.
    pub use_samples: u64,
    /// How far each number came beyond its end by 2.4 standard deviations where it was to be silent, in its unit; 0 where it did not.
    pub beyond: [f64; WATCHED],
    /// The greatest mean square of the surprise.
    pub surprise: f64,
}

/// Why there is no monitor.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Refused {
    /// The controller must not go on the rig.
    #[error("it says that the controller must not go on the rig, and is given no monitor: {0}")]
    MustNotGo(String),
    /// Something that the monitor does not know.
    #[error("{0}")]
    Unknown(String),
    /// A scenario cannot be run.
    #[error("its scenario {0} cannot be run")]
    Scenario(u64),
}

/// The monitors of a certificate that holds, one for every rig, from so many of its trials at most.
///
/// # Errors
/// [`Refused`].
pub fn made(
    certificate: &Certificate,
    source: &dyn Source,
    most: u64,
) -> Result<Vec<Made>, Refused> {
    if !certificate.may_go() {
        return Err(Refused::MustNotGo(certificate.reasons.join("; ")));
    }
    let plan = &certificate.plan;
    let each = plan.rigs.iter().map(|rig| one(plan, *rig, source, most));
    each.collect()
}

fn one(plan: &Plan, rig: Rig, source: &dyn Source, most: u64) -> Result<Made, Refused> {
    let open = constants(plan, rig).map_err(Refused::Unknown)?;
    let indices = 0..plan.scenarios.min(most);
    let runs = indices.into_par_iter().map(|index| {
        let scenario = plan.scenario(index);
        if scenario.rig != rig {
            return Ok(Came::NONE);
        }
        let declared = &plan.controller.declared;
        let ran = trial::run(&scenario, source, declared, false).ok_or(Refused::Scenario(index))?;
        let monitor = Monitor::new(&scenario.settings(), &open);
        let mut monitor = monitor.ok_or(Refused::Scenario(index))?;
        let mut came = Came {
            trials: 1,
            ..Came::NONE
        };
        for (sensed, commanded_a) in &ran.told {
            let watched = monitor.watch(sensed, *commanded_a);
            came.samples += 1;
            if !watched.is_faulty {
                came.cover(&monitor);
            }
            if is_quiet(&scenario) {
                came.judge(&monitor, &open);
            }
        }
        Ok(came)
    });
    let came = runs.try_reduce(|| Came::NONE, |one, other| Ok(one.and(&other)))?;
    let covered = came.covered(open);
    let came = came.and(&in_use(plan, rig, source, &covered, most));
    Ok(Made {
        rig,
        constants: came.closed(open),
        basis: Basis {
            trials: came.trials,
            samples: came.samples,
            use_samples: came.use_samples,
            beyond: came.beyond,
            surprise: came.surprise,
        },
    })
}

/// Whether a monitor is meant to be silent there: an operator's hand, and sensors that work. An adversary, and what follows a fault, may
/// raise it: letting go is right there.
fn is_quiet(scenario: &Scenario) -> bool {
    matches!(scenario.hand, Hand::Operator { .. }) && scenario.faults.is_empty()
}

/// What the statistics came to where rigs of the certificate's scenarios are used for longer, by operators who go back and forth with
/// sensors that work. Only the trials say what is covered; where a use leaves that, it ends.
fn in_use(plan: &Plan, rig: Rig, source: &dyn Source, covered: &Constants, most: u64) -> Came {
    let uses = 0..plan.scenarios.min(most).div_ceil(TRIALS_OF_USE);
    let each = uses.into_par_iter().filter_map(|index| {
        let scenario = Scenario {
            ticks: USE_TICKS,
            faults: Vec::new(),
            ..plan.scenario(index)
        };
        if scenario.rig != rig || !is_quiet(&scenario) {
            return None;
        }
        let mut came = Came::NONE;
        let drilled = drill::run(&scenario, source, covered, None, |monitor| {
            came.judge(monitor, covered);
        })?;
        came.use_samples = u64::from(drilled.ticks);
        Some(came)
    });
    each.reduce(|| Came::NONE, |one, other| one.and(&other))
}

/// What trials came to.
#[derive(Clone, Copy)]
struct Came {
    trials: u64,
    samples: u64,
    use_samples: u64,
    /// Greatest of minus x, x, minus y, y, m, and of the squares of speed and force.
    most: [f64; 6],
    cells: u64,
    beyond: [f64; WATCHED],
    surprise: f64,
}

impl Came {
    const NONE: Came = Came {
        trials: 0,
        samples: 0,
        use_samples: 0,
        most: [f64::MIN; 6],
        cells: 0,
        beyond: [0.0; WATCHED],
        surprise: 0.0,
    };

    /// Where a good sample lay.
    fn cover(&mut self, monitor: &Monitor) {
        let seen = monitor.seen();
        let [x, y] = seen.tip_m;
        // Before the second sample nothing was seen.
        if [x, y] == [0.0; 2] {
            return;
        }
        let now = [-x, x, -y, y, seen.speed_squared, seen.force_squared];
        for (most, now) in self.most.iter_mut().zip(now) {
            *most = most.max(now);
        }
        self.cells |= 1 << seen.cell;
    }

    /// How far the statistics went.
    fn judge(&mut self, monitor: &Monitor, of: &Constants) {
        let ends = of.low.iter().zip(&of.high);
        let numbers = monitor.estimate().numbers().iter().zip(ends);
        for (most, (number, (low, high))) in self.beyond.iter_mut().zip(numbers) {
            *most = most.max(number.beyond(*low, *high, SILENT_SIGMAS));
        }
        self.surprise = self.surprise.max(monitor.estimate().surprise());
    }

    fn and(mut self, other: &Came) -> Came {
        self.trials += other.trials;
        self.samples += other.samples;
        self.use_samples += other.use_samples;
        for (most, now) in self.most.iter_mut().zip(other.most) {
            *most = most.max(now);
        }
        self.cells |= other.cells;
        for (most, now) in self.beyond.iter_mut().zip(other.beyond) {
            *most = most.max(now);
        }
        self.surprise = self.surprise.max(other.surprise);
        self
    }

    /// Numbers with the thresholds and the ends that trials and uses came to.
    fn closed(&self, open: Constants) -> Constants {
        Constants {
            margins: self.beyond.map(|beyond| BEYOND * beyond),
            surprise: LEAST_SURPRISE.max(BEYOND * self.surprise),
            ..self.covered(open)
        }
    }

    /// Numbers with the ends of what trials covered.
    fn covered(&self, open: Constants) -> Constants {
        let [left, right, near, far, speed, force] = self.most;
        Constants {
            tip_m: [-left, right, -near, far],
            speed_m_s: speed.max(0.0).sqrt(),
            force_n: force.max(0.0).sqrt(),
            cells: self.cells,
            ..open
        }
    }
}
