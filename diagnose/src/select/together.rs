//! This file looks for what one mechanism at a time does not show: two or three that mask each other at one joint.

use super::judge::{Trial, judge};
use super::refine::refined;
use super::weigh::is_noise;
use super::{Found, Gates, refs};
use crate::candidates::causes;
use crate::cause::Cause;
use crate::cause::Place;
use crate::problem::{Problem, Term};
use crate::regression::{Blocks, Fit, fit};
use rigproof_model::effects::facts::{Beside, Facts, Family};
use rigproof_model::effects::{Entry, LIBRARY, facts};
use rigproof_spec::effect::Mechanism;

/// Whether a bending law would stand beside another one at its joint: where that leaves nothing but noise, the second only mends the
/// form of the first, which true friction need not have.
pub(super) fn of_one_family(problem: &Problem, cause: Cause, found: &[Found]) -> bool {
    let same = |own: &Found| bends(own.term.cause.mechanism) && own.term.cause.at == cause.at;
    problem.rules.by_family && bends(cause.mechanism) && found.iter().any(same)
}

/// What a mechanism does to names beside it at its joint.
fn beside_of(mechanism: Mechanism) -> Beside {
    facts(mechanism).map_or(Beside::Nothing, |facts| facts.beside)
}

/// Elementary mechanisms, friction first: one number without memory.
pub(crate) fn elementary() -> Vec<Mechanism> {
    those_beside(&[Beside::Elementary])
}

/// The mechanisms that do one of these to names beside them: elementary ones first, of these friction, else in the order of the library.
fn those_beside(wanted: &[Beside]) -> Vec<Mechanism> {
    let entries = LIBRARY.iter();
    let mut own: Vec<&Entry> = entries
        .filter(|entry| wanted.contains(&entry.facts.beside))
        .collect();
    own.sort_by_key(|entry| {
        let Facts { beside, family, .. } = entry.facts;
        (
            beside != Beside::Elementary,
            family != Family::FrictionOfMotion,
        )
    });
    own.into_iter().map(|entry| entry.mechanism).collect()
}

/// Whether a mechanism is elementary: it is named first, and the others must still be needed beside or instead of it.
pub(super) fn is_elementary(mechanism: Mechanism) -> bool {
    beside_of(mechanism) == Beside::Elementary
}

/// Whether a mechanism is elementary friction: what the form of a law that bends lacks is along it.
pub(crate) fn is_elementary_friction(mechanism: Mechanism) -> bool {
    let own = facts(mechanism);
    own.is_some_and(|own| {
        own.beside == Beside::Elementary && own.family == Family::FrictionOfMotion
    })
}

/// Whether a mechanism is a law that only mends the form of one that bends, or bends itself.
pub(super) fn mends(mechanism: Mechanism) -> bool {
    matches!(beside_of(mechanism), Beside::Bends | Beside::Mends)
}

/// Whether a mechanism is such a law.
pub(crate) fn bends(mechanism: Mechanism) -> bool {
    beside_of(mechanism) == Beside::Bends
}

/// Plain friction at the joint of a found law, judged with the law's shape free to go back to what it is without it.
pub(super) fn beside(
    problem: &Problem,
    nominal: &[Term],
    found: &[Found],
    current: &Fit,
    blocks: &Blocks,
    gates: Gates,
) -> Vec<Trial> {
    if !problem.rules.by_family {
        return Vec::new();
    }
    let mut passed = Vec::new();
    for (index, bent) in found.iter().enumerate() {
        let is_bent = bends(bent.term.cause.mechanism) && bent.term.onset_s.is_none();
        if !is_bent {
            continue;
        }
        for term in terms_at(
            problem,
            &refs(nominal, found),
            bent.term.cause.at,
            &elementary(),
        ) {
            let mut others = refs(nominal, found);
            others.remove(nominal.len() + index);
            let mut with = others.clone();
            with.push(&term);
            let straight = refined(problem, &with, bent.term.clone(), blocks);
            others.push(&straight);
            let list = [term.clone()];
            passed.extend(judge(problem, &others, current, &list, term, blocks, gates));
        }
    }
    passed
}

/// The fewest of one joint, two or three, that leave nothing but noise together, where more is left without them.
pub(super) fn masking(
    problem: &Problem,
    common: &[&Term],
    blocks: &Blocks,
    gates: Gates,
) -> Option<Vec<Found>> {
    if !problem.rules.by_family || is_noise(problem, &fit(problem, common, blocks)) {
        return None;
    }
    // Where all of them have a meaning.
    let causes = causes(problem);
    let places = causes
        .iter()
        .filter(|c| c.mechanism == Mechanism::DryOffset);
    // What can mask one another, one number each.
    let maskers = those_beside(&[Beside::Elementary, Beside::Masks]);
    let at_joints: Vec<Vec<Term>> = places
        .map(|cause| terms_at(problem, common, cause.at, &maskers))
        .collect();
    [2, 3].into_iter().find_map(|count| {
        let sets = at_joints.iter().flat_map(|terms| sets_of(terms, count));
        let mut enough: Vec<(f64, Vec<&Term>)> = sets
            .filter_map(|set| {
                let fitted = fit(problem, &[common, &set].concat(), blocks);
                is_noise(problem, &fitted).then_some((fitted.loss, set))
            })
            .collect();
        enough.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut enough = enough.into_iter();
        enough.find_map(|(_, set)| all_pass(problem, common, &set, blocks, gates))
    })
}

/// Every choice of so many terms, in their order.
fn sets_of(terms: &[Term], count: usize) -> Vec<Vec<&Term>> {
    match (count, terms) {
        (0, _) => vec![Vec::new()],
        (_, []) => Vec::new(),
        (_, [first, others @ ..]) => {
            let with = sets_of(others, count - 1).into_iter();
            let with = with.map(|set| [&[first], &set[..]].concat());
            with.chain(sets_of(others, count)).collect()
        }
    }
}

/// The terms as they are found, if each of them passes beside the others.
fn all_pass(
    problem: &Problem,
    common: &[&Term],
    set: &[&Term],
    blocks: &Blocks,
    gates: Gates,
) -> Option<Vec<Found>> {
    let passes = |own: &&Term| {
        let others = set.iter().filter(|other| other.cause != own.cause);
        let with: Vec<&Term> = common.iter().chain(others).copied().collect();
        let current = fit(problem, &with, blocks);
        let list = [(*own).clone()];
        judge(
            problem,
            &with,
            &current,
            &list,
            (*own).clone(),
            blocks,
            gates,
        )
        .map(|t| t.found)
    };
    set.iter().map(passes).collect()
}

/// Mechanisms without a shape at a joint that are not among the terms.
fn terms_at(problem: &Problem, taken: &[&Term], at: Place, mechanisms: &[Mechanism]) -> Vec<Term> {
    let causes = mechanisms.iter().map(|&mechanism| Cause::at(mechanism, at));
    causes
        .filter(|cause| taken.iter().all(|term| term.cause != *cause))
        .filter_map(|cause| problem.kept_term(cause, &[]))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    use crate::plant::Run;
    use crate::plants::five_bar;
    use crate::plants::five_bar::recorded::{noise_rows, short_run, target};
    use crate::problem::add;
    use rigproof_spec::joint::Joint;

    fn at_b(mechanism: Mechanism) -> Cause {
        five_bar::run::at(mechanism, Joint::B)
    }

    /// Hides terms of one column in noise, each times a number.
    fn hide(problem: &mut Problem, hidden: &[(f64, &Term)]) {
        let mut raw = noise_rows(problem, 31);
        for (times, term) in hidden {
            add(&mut raw, &term.free[0].raw, *times);
        }
        problem.target = target(problem, raw);
    }

    #[test]
    fn those_that_mask_each_other_are_found_together_and_one_alone_is_none_of_them() {
        let run = short_run();
        let mut problem = five_bar::recorded::problem(&run);
        let [dry, gain] = [Mechanism::DryOffset, Mechanism::GainError]
            .map(|mechanism| problem.term(at_b(mechanism), &[], None).unwrap());
        hide(&mut problem, &[(0.17, &dry), (-0.31, &gain)]);
        let blocks = Blocks::new(&problem);
        let named = |found: Vec<Found>| -> Vec<String> {
            let mut names: Vec<String> = found
                .iter()
                .map(|own| run.cause_name(own.term.cause))
                .collect();
            names.sort();
            names
        };
        let both = masking(&problem, &[], &blocks, Gates::default()).unwrap();
        assert_eq!(named(both), ["dry_offset at B", "gain_error at B"]);
        for nearly_nothing in [(0.17, &dry), (0.0, &dry)] {
            hide(&mut problem, &[nearly_nothing]);
            assert!(masking(&problem, &[], &blocks, Gates::default()).is_none());
        }
        let [drag, bias] = [Mechanism::Viscous, Mechanism::ConstantBias]
            .map(|mechanism| problem.term(at_b(mechanism), &[], None).unwrap());
        hide(&mut problem, &[(0.17, &dry), (0.11, &drag), (-0.13, &bias)]);
        let three = masking(&problem, &[], &blocks, Gates::default()).unwrap();
        assert_eq!(
            named(three),
            ["constant_bias at B", "dry_offset at B", "viscous at B"]
        );
    }

    #[test]
    fn drag_that_bent_a_peak_is_found_beside_it_and_none_where_there_is_none() {
        let run = short_run();
        let mut problem = five_bar::recorded::problem(&run);
        let cause = at_b(Mechanism::Stribeck);
        let peak = problem.term(cause, &[0.17, 2.0, 0.002], None).unwrap();
        let drag = problem.term(at_b(Mechanism::Viscous), &[], None).unwrap();
        let bent = Found {
            term: problem.term(cause, &[0.23, 1.4, 0.002], None).unwrap(),
            z: 3.7,
            share: 0.7,
            at_floor: false,
            probability: 1.0,
        };
        let mut found_with = |times: f64| -> Vec<String> {
            hide(&mut problem, &[(0.41, &peak), (times, &drag)]);
            let blocks = Blocks::new(&problem);
            let found = [bent.clone()];
            let current = fit(&problem, &refs(&[], &found), &blocks);
            let passed = beside(&problem, &[], &found, &current, &blocks, Gates::default());
            passed
                .iter()
                .map(|t| run.cause_name(t.found.term.cause))
                .collect()
        };
        let named = found_with(0.11);
        assert!(named.contains(&"viscous at B".to_owned()), "{named:?}");
        assert!(!found_with(0.0).contains(&"viscous at B".to_owned()));
    }

    #[test]
    fn a_second_friction_that_bends_is_of_the_family_of_the_first_at_its_own_joint_only() {
        let run = short_run();
        let problem = five_bar::recorded::problem(&run);
        let found = [Found {
            term: problem
                .term(at_b(Mechanism::Stribeck), &[0.17, 2.0, 0.002], None)
                .unwrap(),
            z: 3.7,
            share: 0.7,
            at_floor: true,
            probability: 1.0,
        }];
        let bristle = at_b(Mechanism::Presliding);
        let elsewhere = five_bar::run::at(Mechanism::Presliding, Joint::E);
        assert!(of_one_family(&problem, bristle, &found));
        assert!(!of_one_family(&problem, elsewhere, &found));
        assert!(!of_one_family(&problem, at_b(Mechanism::Viscous), &found));
    }
}
