//! This file is the selected explanation of a recording: its mechanisms, with their joint fit.

mod onset;
mod refine;
mod weigh;

use crate::cause::Cause;
use crate::problem::{Problem, Term};
use crate::regression::{Blocks, Fit, fit};
use crate::rules::{FLOOR_RATIO, FLOOR_SIGMAS, SUSPECTED, WINDOWS_A_FREEDOM};

pub(crate) use onset::{centred, change_with_onset, onset_interval};
pub(crate) use refine::{best_variant, refined};
pub use weigh::{is_noise, usable_rms};

/// One mechanism that was found, with its evidence.
#[derive(Clone, Debug)]
pub struct Found {
    pub term: Term,
    /// Paired z over blocks when it entered.
    pub z: f64,
    /// Share of the left-out loss that it removed when it entered.
    pub share: f64,
    /// Its posterior probability.
    pub probability: f64,
}

/// The selection after one more mechanism entered.
#[derive(Clone, Debug)]
pub struct Stage {
    /// The cause that entered.
    pub entered: Cause,
    /// All causes selected by then.
    pub standing: Vec<Cause>,
    /// The shape and the onset of each of them.
    pub shapes: Vec<(Vec<f64>, Option<f64>)>,
    /// Root-mean-square residual of the windows, N or N·m.
    pub residual: f64,
}

/// The outcome of the selection.
#[derive(Clone, Debug)]
pub struct Selection {
    pub nominal: Vec<Term>,
    /// Mechanisms found, in the order in which they entered.
    pub found: Vec<Found>,
    /// The selection after each entry.
    pub stages: Vec<Stage>,
    /// The fit of the nominal model alone.
    pub before: Fit,
    /// The fit with all mechanisms.
    pub after: Fit,
}

/// The ratio of residual to noise floor up to which a residual counts as noise.
///
/// With few windows noise alone may exceed [`FLOOR_RATIO`], so three standard deviations of the
/// ratio are allowed.
pub fn floor_limit(problem: &Problem) -> f64 {
    let usable = problem.windows.usable.iter().filter(|u| **u).count();
    let freedom = (usable as f64 / WINDOWS_A_FREEDOM).max(1.0);
    FLOOR_RATIO.max(1.0 + FLOOR_SIGMAS / (2.0 * freedom).sqrt())
}

impl Selection {
    /// The same with nothing named.
    pub fn at_most_suspected(&self) -> Selection {
        let mut own = self.clone();
        for found in &mut own.found {
            found.probability = found.probability.min(SUSPECTED);
        }
        own
    }

    /// Removes mechanisms and fits the rest again.
    pub fn withdraw(&mut self, problem: &Problem, causes: &[Cause]) {
        self.found.retain(|f| !causes.contains(&f.term.cause));
        let blocks = Blocks::new(problem);
        self.after = fit(problem, &refs(&self.nominal, &self.found), &blocks);
    }
}

/// The nominal terms and the found ones, in the order of the fit's columns.
pub fn refs<'b>(nominal: &'b [Term], found: &'b [Found]) -> Vec<&'b Term> {
    nominal
        .iter()
        .chain(found.iter().map(|f| &f.term))
        .collect()
}
