//! This file looks for one mechanism that shows in too few places for blocks to judge it by one another.

use super::judge::best;
use super::prune::outweighs;
use super::refine::refined;
use super::step::with_onsets;
use super::weigh::{drives, excitation, is_noise, own_coefficients};
use super::{Found, Gates, refs};
use crate::candidates::{all_variants, causes, is_at_edge, modelled_effort};
use crate::problem::{Problem, Term};
use crate::regression::{Blocks, Fit, dot, fit, paired};
use crate::rules::{SOLE_NEAR, SOLE_PROMISING, SOLE_SHARE, SOLE_SHARE_WITH_REST};
use rayon::prelude::*;

/// The one mechanism that takes away nearly all, where blocks showed none for what is more, or several that leave more than it; then it may
/// begin during the recording too, and leaves nothing but noise.
///
/// What a brake does within a few hundredths of a radian after one loud reversal lies whole in one block or two, and no block left out can be
/// told from the others; nor can an onset that one block tells. Each window is judged by itself then, with the numbers of all of them.
pub(super) fn sole(
    problem: &Problem,
    nominal: &[Term],
    gates: Gates,
    named: bool,
) -> Option<Found> {
    let common = refs(nominal, &[]);
    let current = fit(problem, &common, &Blocks::new(problem));
    let of_all = |lists: Vec<Vec<Term>>| -> Vec<(Term, f64)> {
        let bests = lists.par_iter();
        bests
            .filter_map(|list| best(problem, &common, list))
            .collect()
    };
    let early = of_all(all_variants(problem, causes(problem), &common, &current));
    let most_left = |share: f64| (1.0 - share) * current.loss;
    let judged = |mut tried: Vec<(Term, f64)>, share: f64| {
        tried.retain(|(_, loss)| *loss <= most_left(share));
        promising(problem, &common, &current, tried, gates)
    };
    let is_enough = |found: &Found| found.at_floor || !named;
    let share = if named { SOLE_NEAR } else { 0.0 };
    judged(early.clone(), share).filter(is_enough).or_else(|| {
        let effort = modelled_effort(problem, &common, &current);
        let lists = early
            .par_iter()
            .map(|(term, _)| with_onsets(problem, term, &effort));
        judged(of_all(lists.collect()), SOLE_NEAR).filter(|found| found.at_floor)
    })
}

/// Of the few that explain most the one that leaves least.
fn promising(
    problem: &Problem,
    common: &[&Term],
    current: &Fit,
    mut tried: Vec<(Term, f64)>,
    gates: Gates,
) -> Option<Found> {
    let blocks = Blocks::new(problem);
    tried.sort_by(|a, b| a.1.total_cmp(&b.1));
    tried.truncate(SOLE_PROMISING);
    let refined = tried
        .into_par_iter()
        .map(|(term, _)| refined(problem, common, term, &blocks));
    let judged = refined.filter_map(|term| by_windows(problem, common, current, term, gates));
    let judged: Vec<(f64, Found)> = judged.collect();
    judged
        .into_iter()
        .min_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, found)| found)
}

/// One mechanism window by window, with the loss that it leaves; `None` where it leaves too much.
fn by_windows(
    problem: &Problem,
    common: &[&Term],
    current: &Fit,
    term: Term,
    gates: Gates,
) -> Option<(f64, Found)> {
    let with = [common, &[&term]].concat();
    let fitted = fit(problem, &with, &Blocks::new(problem));
    let own = own_coefficients(&term, &fitted);
    let at_floor = is_noise(problem, &fitted);
    let share = 1.0 - fitted.loss / current.loss;
    let least = if at_floor {
        SOLE_SHARE
    } else {
        SOLE_SHARE_WITH_REST
    };
    let windows = windows(problem);
    let expected = excitation(&term, own, &windows);
    let [before, after] = [current, &fitted].map(|fit| losses(problem, fit, &windows));
    let z = paired(&before, &after, &expected).1;
    let stands = share >= least
        && outweighs(problem, term.cause, current, &fitted)
        && z >= gates.z
        && !drives(&term, own)
        && !is_at_edge(problem, &term);
    let found = Found {
        term,
        z,
        share,
        at_floor,
        probability: 1.0,
    };
    stands.then_some((fitted.loss, found))
}

/// Every window as a block by itself.
fn windows(problem: &Problem) -> Blocks {
    let outputs = problem.windows.outputs;
    let count = problem.windows.centres.len() / outputs;
    let ranges = (0..count).map(|k| (outputs * k, outputs * (k + 1)));
    Blocks {
        ranges: ranges.collect(),
    }
}

/// The white loss of each window.
fn losses(problem: &Problem, fitted: &Fit, windows: &Blocks) -> Vec<f64> {
    let white = problem.whitener.whiten(&fitted.residual);
    let each = windows.ranges.iter();
    each.map(|&(first, end)| white.get(first..end).map_or(0.0, |part| dot(part, part)))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    use crate::plant::Run;
    use crate::plants::five_bar;
    use crate::plants::five_bar::recorded::{noise_rows, short_run, target};
    use crate::problem::add;
    use rigproof_spec::effect::Mechanism;
    use rigproof_spec::joint::Joint;

    #[test]
    fn one_law_that_leaves_only_noise_is_found_and_none_of_two() {
        let run = short_run();
        let mut problem = five_bar::recorded::problem(&run);
        let at = |mechanism, joint| five_bar::run::at(mechanism, joint);
        let play = at(Mechanism::CurrentHysteresis, Joint::B);
        let play = problem.term(play, &[0.07, 0.3], None).unwrap();
        let dry = at(Mechanism::DryOffset, Joint::A);
        let dry = problem.term(dry, &[], None).unwrap();
        let mut found_with = |times: f64| {
            let mut raw = noise_rows(&problem, 41);
            add(&mut raw, &play.free[0].raw, 0.7);
            add(&mut raw, &dry.free[0].raw, times);
            problem.target = target(&problem, raw);
            sole(&problem, &[], Gates::default(), false)
        };
        let found = found_with(0.0).unwrap();
        assert_eq!(run.cause_name(found.term.cause), "current_hysteresis at B");
        assert!(found_with(0.13).is_none());
    }

    #[test]
    fn one_law_that_begins_late_is_found_where_it_leaves_only_noise() {
        let run = short_run();
        let mut problem = five_bar::recorded::problem(&run);
        let at_b = |mechanism| five_bar::run::at(mechanism, Joint::B);
        let drag = at_b(Mechanism::Viscous);
        let drag = problem.term(drag, &[], Some(1.37)).unwrap();
        let dry = problem.term(at_b(Mechanism::DryOffset), &[], None).unwrap();
        let mut found_with = |times: f64| {
            let mut raw = noise_rows(&problem, 43);
            add(&mut raw, &drag.free[0].raw, 0.31);
            add(&mut raw, &dry.free[0].raw, times);
            problem.target = target(&problem, raw);
            sole(&problem, &[], Gates::default(), true)
        };
        let found = found_with(0.0).unwrap();
        assert_eq!(run.cause_name(found.term.cause), "viscous at B");
        let onset_s = found.term.onset_s.unwrap();
        assert!((onset_s - 1.37).abs() < 0.03, "{onset_s} s");
        assert!(found_with(0.13).is_none());
    }
}
