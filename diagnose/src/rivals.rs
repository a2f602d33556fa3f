//! This file holds the rival explanations of a recording, and finds the experiment that separates
//! them best.

use crate::candidates::{realise, variants};
use crate::cause::Cause;
use crate::problem::{Problem, Term};
use crate::regression::{Blocks, fit};
use crate::report::Separation;
use crate::rules::{FINALISTS, LEAST_SIGMAS};
use crate::selection::{Found, Selection, best_variant, refined, refs};
use rayon::prelude::*;

/// A cause with its shape.
#[derive(Clone, Debug)]
pub struct Part {
    pub cause: Cause,
    shape: Vec<f64>,
    known: Option<Vec<f64>>,
}

impl Part {
    fn of(term: &Term) -> Part {
        Part {
            cause: term.cause,
            shape: term.shape.clone(),
            known: term.known.clone(),
        }
    }

    /// The term on another recording, without its onset, which belongs to the original one.
    pub fn on(&self, problem: &Problem) -> Option<Term> {
        let term = realise(problem, self.cause, &self.shape, None, &[])?;
        Some(Term {
            known: self.known.clone(),
            ..term
        })
    }
}

/// An explanation as a rival of others.
#[derive(Clone, Debug)]
pub struct Rival {
    /// The term about which the rivals disagree.
    pub own: Part,
    /// The terms that all rivals share.
    others: Vec<Part>,
}

impl Rival {
    /// The rival that a selection is in the found cause at `index`.
    pub fn of(selection: &Selection, index: usize) -> Option<Rival> {
        let own = selection.found.get(index)?;
        let others = selection.found.iter().enumerate();
        let others = others.filter(|(k, _)| *k != index).map(|(_, f)| &f.term);
        let others = selection.nominal.iter().chain(others);
        Some(Rival {
            own: Part::of(&own.term),
            others: others.map(Part::of).collect(),
        })
    }

    /// Its loss on another recording, with all parameters refitted and the contested cause in its
    /// best trial shape.
    pub fn loss(&self, problem: &Problem, blocks: &Blocks) -> f64 {
        let others: Vec<Term> = self.others.iter().filter_map(|p| p.on(problem)).collect();
        let common: Vec<&Term> = others.iter().collect();
        let bare = fit(problem, &common, blocks);
        let mut tried = variants(problem, self.own.cause, &common, &bare);
        tried.extend(self.own.on(problem));
        best_variant(problem, &common, &tried).map_or(bare.loss, |(_, loss)| loss)
    }
}

/// The terms of a selection on other recordings, nominal ones first.
pub fn parts(selection: &Selection) -> Vec<Part> {
    let terms = refs(&selection.nominal, &selection.found);
    terms.into_iter().map(Part::of).collect()
}

/// The place of the found cause that has rivals, and the selections: the named one, then one for
/// each rival, refitted to the recording, the best first.
///
/// If several causes have rivals, the first of them is chosen: it explains most.
pub fn contested(
    problem: &Problem,
    selection: &Selection,
    rivals: &[Vec<Cause>],
) -> Option<(usize, Vec<Selection>)> {
    let contested = rivals.iter().enumerate().find(|(_, own)| !own.is_empty());
    let (index, rivals) = contested?;
    let in_its_place = |cause: &Cause| replaced(problem, selection, index, *cause);
    let mut others: Vec<Selection> = rivals.iter().filter_map(in_its_place).collect();
    others.sort_by(|a, b| a.after.loss.total_cmp(&b.after.loss));
    others.insert(0, selection.clone());
    Some((index, others))
}

/// The selection with a found cause replaced by another.
fn replaced(
    problem: &Problem,
    selection: &Selection,
    index: usize,
    cause: Cause,
) -> Option<Selection> {
    let blocks = Blocks::new(problem);
    let mut others = selection.found.clone();
    let old = others.remove(index);
    let common = refs(&selection.nominal, &others);
    let bare = fit(problem, &common, &blocks);
    let tried = variants(problem, cause, &common, &bare).into_iter();
    let tried = tried.filter_map(|term| match old.term.onset_s {
        None => Some(term),
        onset_s => realise(problem, cause, &term.shape, onset_s, &[]),
    });
    let tried: Vec<_> = tried.collect();
    let (mut term, _) = best_variant(problem, &common, &tried)?;
    if !term.shape.is_empty() {
        term = refined(problem, &common, term, &blocks);
    }
    let mut found = selection.found.clone();
    if let Some(slot) = found.get_mut(index) {
        *slot = Found { term, ..old };
    }
    let after = fit(problem, &refs(&selection.nominal, &found), &blocks);
    Some(Selection {
        found,
        after,
        ..selection.clone()
    })
}

/// The plan that separates explanations best, and the separation of each pair of them. `names` are
/// theirs, the named one first; `None` with fewer than two.
///
/// `losses` gives the loss of each explanation on a plan if one is true; `None` if the plan cannot
/// be done.
pub fn best<'p, P: Sync>(
    names: &[String],
    plans: &'p [P],
    losses: impl Fn(usize, &P) -> Option<Vec<f64>> + Sync,
) -> Option<(&'p P, Vec<Separation>)> {
    if names.len() < 2 {
        return None;
    }
    // Screening assumes that the named explanation is true. The best plans are then judged for
    // every possible truth.
    let screen = |plan: &P| -> Vec<f64> {
        let losses = losses(0, plan).unwrap_or_default();
        let others = 1..losses.len();
        others.map(|other| beyond(&losses, 0, other)).collect()
    };
    let screened: Vec<Vec<f64>> = plans.par_iter().map(screen).collect();
    let mut finalists: Vec<(&P, f64)> = plans.iter().zip(least(&screened)).collect();
    finalists.sort_by(|(_, one), (_, other)| other.total_cmp(one));
    finalists.truncate(FINALISTS);
    let apart = |plan: &P| separations(names.len(), |truth| losses(truth, plan));
    let apart: Vec<Vec<f64>> = finalists
        .par_iter()
        .map(|(plan, _)| apart(plan).unwrap_or_default())
        .collect();
    let ranked = finalists.iter().zip(&apart).zip(least(&apart));
    let (((plan, _), sigmas), _) = ranked.max_by(|(_, one), (_, other)| one.total_cmp(other))?;
    let name = |place: usize| names.get(place).cloned().unwrap_or_default();
    let pairs = pairs(names.len()).into_iter().zip(sigmas);
    let separations = pairs.map(|([one, other], sigmas)| Separation {
        one: name(one),
        other: name(other),
        sigmas: *sigmas,
        tellable: *sigmas >= LEAST_SIGMAS,
    });
    Some((plan, separations.collect()))
}

/// The least separation that each experiment reaches. Pairs that no experiment separates are left
/// out, because they decide nothing.
fn least(all: &[Vec<f64>]) -> Vec<f64> {
    let greatest = |pair: usize| {
        let own = all.iter().filter_map(|sigmas| sigmas.get(pair));
        own.copied().fold(0.0, f64::max)
    };
    let least = |sigmas: &Vec<f64>| {
        let told = sigmas.iter().enumerate();
        let told = told.filter(|(pair, _)| greatest(*pair) >= LEAST_SIGMAS);
        let least = told.map(|(_, s)| *s).fold(f64::INFINITY, f64::min);
        if least.is_finite() { least } else { 0.0 }
    };
    all.iter().map(least).collect()
}

/// All pairs of indices.
fn pairs(count: usize) -> Vec<[usize; 2]> {
    let all = (0..count).flat_map(|one| (one + 1..count).map(move |other| [one, other]));
    all.collect()
}

/// The separation of an explanation from the true one, in standard deviations of the noise.
fn beyond(losses: &[f64], truth: usize, other: usize) -> f64 {
    let at = |place: usize| losses.get(place).copied().unwrap_or(0.0);
    (at(other) - at(truth)).max(0.0).sqrt()
}

/// The separation of each pair of explanations by an experiment, in standard deviations of the
/// noise: the lesser of the two, as either may be true.
fn separations(
    count: usize,
    losses: impl Fn(usize) -> Option<Vec<f64>> + Sync,
) -> Option<Vec<f64>> {
    let all = (0..count).into_par_iter().map(&losses);
    let all: Vec<Vec<f64>> = all.collect::<Option<_>>()?;
    let way = |truth: usize, other: usize| {
        let losses = all.get(truth);
        losses.map_or(0.0, |losses| beyond(losses, truth, other))
    };
    let apart = |[one, other]: [usize; 2]| way(one, other).min(way(other, one));
    Some(pairs(count).into_iter().map(apart).collect())
}
