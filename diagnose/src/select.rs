//! This file chooses mechanisms: forward, backward and swap steps judged on left-out blocks of time.

mod form;
mod judge;
mod merge;
mod onset;
mod prune;
mod refine;
mod sole;
mod step;
mod together;
mod weigh;

use crate::candidates::{all_variants, causes};
use crate::cause::Cause;
use crate::problem::{Problem, Term};
use crate::regression::{Blocks, Fit, fit};
use crate::rules::{
    FLOOR_SIGMAS, GATE_RELEVANCE, GATE_SHARE, GATE_Z, MOST_FOUND, MOST_STAGES, WINDOWS_A_FREEDOM,
};
use form::take_out_forms;
use merge::merge;
use prune::{backward, prune};
use refine::refine;
use sole::sole;
use step::{forward, swap};

pub(crate) use crate::rules::LEAST_SIGMAS;
pub use crate::rules::{FLOOR_RATIO, TIE_Z};
pub(crate) use judge::best as best_variant;
pub(crate) use merge::as_two;
pub(crate) use onset::{change_with_onset, onset_interval};
pub(crate) use refine::refined;
pub(crate) use together::{bends, elementary, is_elementary_friction};
pub(crate) use weigh::gives_energy;
pub use weigh::{is_noise, usable_rms};

/// What a mechanism must show before it is named.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gates {
    /// Paired z over blocks.
    pub z: f64,
    /// Share of the current left-out loss that must go away.
    pub share: f64,
    /// Root-mean-square contribution, as a share of the effort's.
    pub relevance: f64,
}

impl Default for Gates {
    fn default() -> Gates {
        Gates {
            z: GATE_Z,
            share: GATE_SHARE,
            relevance: GATE_RELEVANCE,
        }
    }
}

/// One mechanism that was found, with the evidence for it.
#[derive(Clone, Debug)]
pub struct Found {
    /// The term.
    pub term: Term,
    /// Paired z over blocks when it entered.
    pub z: f64,
    /// Share of the left-out loss it removed when it entered.
    pub share: f64,
    /// Whether nothing beyond sensor noise was left with it.
    pub at_floor: bool,
    /// How probable it is beside other explanations.
    pub probability: f64,
}

/// What stood after one mechanism was named.
#[derive(Clone, Debug)]
pub struct Stage {
    /// The cause that entered.
    pub entered: Cause,
    /// All causes that stood then.
    pub standing: Vec<Cause>,
    /// The shape and the onset of each of them.
    pub shapes: Vec<(Vec<f64>, Option<f64>)>,
    /// Root-mean-square residual of the windows, N or N·m.
    pub residual: f64,
}

/// The outcome of the selection.
#[derive(Clone, Debug)]
pub struct Selection {
    /// Terms of the nominal model.
    pub nominal: Vec<Term>,
    /// Mechanisms found, in the order they were named.
    pub found: Vec<Found>,
    /// Mechanisms that pass the gates but explain less than what stays unexplained: not named.
    pub too_small: Vec<Cause>,
    /// How the mechanisms were named, one after another.
    pub stages: Vec<Stage>,
    /// The fit of the nominal model alone.
    pub before: Fit,
    /// The fit of everything.
    pub after: Fit,
}

/// Residual over floor up to which nothing counts as unexplained on a recording: of few windows noise alone may be above
/// [`FLOOR_RATIO`], so three standard deviations of what it comes to are allowed.
pub fn floor_limit(problem: &Problem) -> f64 {
    let usable = problem.windows.usable.iter().filter(|u| **u).count();
    let freedom = (usable as f64 / WINDOWS_A_FREEDOM).max(1.0);
    FLOOR_RATIO.max(1.0 + FLOOR_SIGMAS / (2.0 * freedom).sqrt())
}

/// Runs the whole search, and where it leaves more than noise looks for the one mechanism that shows in few places.
pub fn select(problem: &mut Problem, nominal: Vec<Term>, gates: Gates) -> Selection {
    let first = searched(problem, nominal, gates);
    if !problem.rules.by_window || is_noise(problem, &first.after) {
        return first;
    }
    let named = !first.found.is_empty();
    let whitener = problem.whitener.clone();
    let mut nominal = first.nominal.clone();
    // Windows are judged one by one: by what sensor noise alone would give.
    problem.rewhiten(problem.floor);
    nominal.iter_mut().for_each(|term| problem.refresh(term));
    let blocks = Blocks::new(problem);
    let Some(found) = sole(problem, &nominal, gates, named) else {
        problem.whiten_with(whitener);
        return first;
    };
    let entered = found.term.cause;
    let found = vec![found];
    let after = fit(problem, &refs(&nominal, &found), &blocks);
    let mut stages = first.stages;
    stages.push(stage(problem, entered, &found, &after.residual));
    Selection {
        before: fit(problem, &refs(&nominal, &[]), &blocks),
        nominal,
        found,
        too_small: Vec::new(),
        stages,
        after,
    }
}

/// What stands once one of these has entered.
fn stage(problem: &Problem, entered: Cause, found: &[Found], residual: &[f64]) -> Stage {
    Stage {
        entered,
        standing: found.iter().map(|f| f.term.cause).collect(),
        shapes: shapes(found),
        residual: usable_rms(problem, residual),
    }
}

/// One search; the noise model is refined twice on the way.
fn searched(problem: &mut Problem, mut nominal: Vec<Term>, gates: Gates) -> Selection {
    let blocks = Blocks::new(problem);
    let rich = rich_residual(problem, &nominal, &blocks);
    rewhiten(problem, &rich, &mut nominal, &mut []);
    let mut stages = Vec::new();
    let mut found = search(problem, &nominal, Vec::new(), &blocks, gates, &mut stages);
    let residual = fit(problem, &refs(&nominal, &found), &blocks).residual;
    rewhiten(problem, &residual, &mut nominal, &mut found);
    found = search(problem, &nominal, found, &blocks, gates, &mut stages);
    let mut too_small = Vec::new();
    if problem.rules.by_family {
        too_small = take_out_forms(problem, &nominal, &mut found, &blocks);
        merge(problem, &nominal, &mut found, &blocks);
        onset::centre(problem, &nominal, &mut found);
    }
    too_small.extend(prune(problem, &nominal, &mut found, &blocks));
    let before = fit(problem, &nominal.iter().collect::<Vec<_>>(), &blocks);
    let after = fit(problem, &refs(&nominal, &found), &blocks);
    Selection {
        nominal,
        found,
        too_small,
        stages,
        before,
        after,
    }
}

fn rewhiten(problem: &mut Problem, residual: &[f64], nominal: &mut [Term], found: &mut [Found]) {
    problem.rewhiten(usable_rms(problem, residual));
    for term in nominal
        .iter_mut()
        .chain(found.iter_mut().map(|f| &mut f.term))
    {
        problem.refresh(term);
    }
}

/// The residual when every mechanism may help at once: a first idea of the noise.
fn rich_residual(problem: &Problem, nominal: &[Term], blocks: &Blocks) -> Vec<f64> {
    let mut terms: Vec<Term> = nominal.to_vec();
    let common: Vec<&Term> = nominal.iter().collect();
    let plain = fit(problem, &common, blocks);
    for tried in all_variants(problem, causes(problem), &common, &plain) {
        let step = (tried.len() / 3).max(1);
        terms.extend(
            tried
                .into_iter()
                .skip(step / 2)
                .step_by(step)
                .filter(|t| t.fixed.is_none()),
        );
    }
    fit(problem, &terms.iter().collect::<Vec<_>>(), blocks).residual
}

impl Selection {
    /// Takes mechanisms out again and fits what stays.
    pub fn withdraw(&mut self, problem: &Problem, causes: &[Cause]) {
        self.found.retain(|f| !causes.contains(&f.term.cause));
        let blocks = Blocks::new(problem);
        self.after = fit(problem, &refs(&self.nominal, &self.found), &blocks);
    }

    /// Takes out what explains too little beside what is unexplained by now.
    pub fn weigh_again(&mut self, problem: &Problem) {
        let blocks = Blocks::new(problem);
        let taken_out = prune(problem, &self.nominal, &mut self.found, &blocks);
        self.too_small.extend(taken_out);
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

fn search(
    problem: &Problem,
    nominal: &[Term],
    mut found: Vec<Found>,
    blocks: &Blocks,
    gates: Gates,
    stages: &mut Vec<Stage>,
) -> Vec<Found> {
    settle(problem, nominal, &mut found, blocks, gates);
    while found.len() < MOST_FOUND && stages.len() < MOST_STAGES {
        let next = forward(problem, nominal, &found, blocks, gates);
        let Some(entered) = next.first().map(|f| f.term.cause) else {
            break;
        };
        for own in next {
            let entered = own.term.cause;
            found.push(own);
            refine(problem, nominal, &mut found, blocks);
            let residual = fit(problem, &refs(nominal, &found), blocks).residual;
            stages.push(stage(problem, entered, &found, &residual));
        }
        let standing: Vec<Cause> = found.iter().map(|f| f.term.cause).collect();
        settle(problem, nominal, &mut found, blocks, gates);
        note_swaps(problem, nominal, &found, &standing, blocks, stages);
        if found.iter().all(|f| f.term.cause != entered)
            && stages.last().is_some_and(|s| s.entered == entered)
        {
            break;
        }
    }
    found
}

fn shapes(found: &[Found]) -> Vec<(Vec<f64>, Option<f64>)> {
    let terms = found.iter().map(|f| &f.term);
    terms.map(|t| (t.shape.clone(), t.onset_s)).collect()
}

/// A mechanism that came in by replacing others is a stage of its own.
fn note_swaps(
    problem: &Problem,
    nominal: &[Term],
    found: &[Found],
    standing: &[Cause],
    blocks: &Blocks,
    stages: &mut Vec<Stage>,
) {
    for new in found
        .iter()
        .map(|f| f.term.cause)
        .filter(|cause| !standing.contains(cause))
    {
        let residual = fit(problem, &refs(nominal, found), blocks).residual;
        stages.push(stage(problem, new, found, &residual));
    }
}

/// Swap and backward passes.
fn settle(
    problem: &Problem,
    nominal: &[Term],
    found: &mut Vec<Found>,
    blocks: &Blocks,
    gates: Gates,
) {
    swap(problem, nominal, found, blocks, gates);
    backward(problem, nominal, found, blocks, gates);
}
