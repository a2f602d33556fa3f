//! This file runs the trials of a certificate again with the monitor beside them: what they covered, and how far each statistic went.

use rayon::prelude::*;
use rigproof_impl::monitor::Monitor;
use rigproof_impl::monitor::constants::{Constants, WATCHED};
use rigproof_spec::methods::SAMPLE_STEP_S;
use serde::Serialize;

use super::drill;
use super::middle::constants;
use super::tail::{Tail, tail};
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
/// Standard deviations beyond its end that raise an alarm of a number at least: one-sided chance 0.0013 where the model is right.
const LEAST_SIGMAS: f64 = 3.0;
/// Least mean square of the surprise that is ever enough: of 16 rows what is passed with a chance of 7·10⁻⁷, 0.02 times in the 28 000 windows
/// of ten hours (chi-squared distribution, by Wilson and Hilferty's approximation).
const LEAST_SURPRISE: f64 = 3.76;

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
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Basis {
    /// Trials that were run again.
    pub trials: u64,
    /// Their samples.
    pub samples: u64,
    /// Samples of longer use of its rigs by operators.
    pub use_samples: u64,
    /// Samples of trials and uses where the monitor was to be silent.
    pub quiet_samples: u64,
    /// How far each number came beyond its end there, and what raises an alarm.
    pub tails: [Tail; WATCHED],
    /// The same of the mean square of the surprise.
    pub surprise: Tail,
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
            return Ok((Came::NONE, None));
        }
        let declared = &plan.controller.declared;
        let ran = trial::run(&scenario, source, declared, false).ok_or(Refused::Scenario(index))?;
        let monitor = Monitor::new(&scenario.settings(), &open);
        let mut monitor = monitor.ok_or(Refused::Scenario(index))?;
        let mut came = Came {
            trials: 1,
            ..Came::NONE
        };
        let mut greatest = Greatest::default();
        for (sensed, commanded_a) in &ran.told {
            let watched = monitor.watch(sensed, *commanded_a);
            came.samples += 1;
            if !watched.is_faulty {
                came.cover(&monitor);
            }
            if is_quiet(&scenario) {
                greatest.judge(&monitor, &open);
            }
        }
        Ok((came, greatest.samples.gt(&0).then_some(greatest)))
    });
    let runs: Result<Vec<(Came, Option<Greatest>)>, Refused> = runs.collect();
    let (came, quiet): (Vec<Came>, Vec<Option<Greatest>>) = runs?.into_iter().unzip();
    let came = came.iter().fold(Came::NONE, |all, one| all.and(one));
    let covered = came.covered(open);
    let mut quiet: Vec<Greatest> = quiet.into_iter().flatten().collect();
    let uses = in_use(plan, rig, source, &covered, most);
    let use_samples = uses.iter().map(|own| own.samples).sum();
    quiet.extend(uses);
    let quiet_samples = quiet.iter().map(|own| own.samples).sum();
    let (tails, surprise) = tails(&quiet, quiet_samples);
    Ok(Made {
        rig,
        constants: Constants {
            levels: tails.map(|own| own.level),
            surprise: surprise.level,
            ..covered
        },
        basis: Basis {
            trials: came.trials,
            samples: came.samples,
            use_samples,
            quiet_samples,
            tails,
            surprise,
        },
    })
}

/// The tails of all numbers and of the surprise.
fn tails(quiet: &[Greatest], samples: u64) -> ([Tail; WATCHED], Tail) {
    let hours = samples as f64 * SAMPLE_STEP_S / 3600.0;
    let of = |each: &dyn Fn(&Greatest) -> f64, least: f64| {
        tail(&quiet.iter().map(each).collect::<Vec<f64>>(), hours, least)
    };
    let mut tails = [Tail::default(); WATCHED];
    for (place, own) in tails.iter_mut().enumerate() {
        let sigmas = |run: &Greatest| run.beyond_squared.get(place).map_or(0.0, |own| own.sqrt());
        *own = of(&sigmas, LEAST_SIGMAS);
    }
    (tails, of(&|run| run.surprise, LEAST_SURPRISE))
}

/// Whether a monitor is meant to be silent there: an operator's hand, and sensors that work. An adversary, and what follows a fault, may
/// raise it: letting go is right there.
fn is_quiet(scenario: &Scenario) -> bool {
    matches!(scenario.hand, Hand::Operator { .. }) && scenario.faults.is_empty()
}

/// What the statistics came to where rigs of the certificate's scenarios are used for longer, by operators who go back and forth with
/// sensors that work. Only the trials say what is covered; where a use leaves that, it ends.
fn in_use(
    plan: &Plan,
    rig: Rig,
    source: &dyn Source,
    covered: &Constants,
    most: u64,
) -> Vec<Greatest> {
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
        let mut greatest = Greatest::default();
        drill::run(&scenario, source, covered, None, |monitor| {
            greatest.judge(monitor, covered);
        })?;
        Some(greatest)
    });
    each.collect()
}

/// How far the statistics went in a run.
#[derive(Clone, Copy, Default)]
struct Greatest {
    samples: u64,
    beyond_squared: [f64; WATCHED],
    surprise: f64,
}

impl Greatest {
    /// Looks at them after a sample.
    fn judge(&mut self, monitor: &Monitor, of: &Constants) {
        self.samples += 1;
        let ends = of.low.iter().zip(&of.high);
        let numbers = monitor.estimate().numbers().iter().zip(ends);
        for (most, (number, (low, high))) in self.beyond_squared.iter_mut().zip(numbers) {
            *most = most.max(number.beyond_squared(*low, *high));
        }
        self.surprise = self.surprise.max(monitor.estimate().surprise());
    }
}

/// What trials covered.
#[derive(Clone, Copy)]
struct Came {
    trials: u64,
    samples: u64,
    /// Greatest of minus x, x, minus y, y, m, and of the squares of speed and force.
    most: [f64; 6],
    cells: u64,
}

impl Came {
    const NONE: Came = Came {
        trials: 0,
        samples: 0,
        most: [f64::MIN; 6],
        cells: 0,
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

    fn and(mut self, other: &Came) -> Came {
        self.trials += other.trials;
        self.samples += other.samples;
        for (most, now) in self.most.iter_mut().zip(other.most) {
            *most = most.max(now);
        }
        self.cells |= other.cells;
        self
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
