//! This file makes one cause of two: a bristle with a constant beside it, by whatever name, is a bristle whose limits differ.

use super::judge::SIMPLER_SHARE;
use super::refine::refined;
use super::weigh::{drives, excitation, is_noise, own_coefficients};
use super::{Found, LEAST_SIGMAS, Selection, TIE_Z, refs};
use crate::candidates::realise;
use crate::cause::Cause;
use crate::problem::{Problem, Term};
use crate::regression::{Blocks, Fit, fit, paired};
use rigproof_model::effects::{LIBRARY, entry, facts};
use rigproof_spec::effect::Mechanism;

/// The law that takes the place of two at one joint, of which the first is this mechanism and gives it its shape.
pub(super) fn takes_both(first: Mechanism) -> Option<(Mechanism, Mechanism)> {
    LIBRARY.iter().find_map(|entry| {
        let [own, beside] = entry.facts.both?;
        (own == first).then_some((entry.mechanism, beside))
    })
}

/// Replaces a bristle and a constant at one joint by the one bristle that does as much with no more numbers.
pub(super) fn merge(problem: &Problem, nominal: &[Term], found: &mut Vec<Found>, blocks: &Blocks) {
    for bristle in 0..found.len() {
        if let Some(fewer) = merged(problem, nominal, found, blocks, bristle) {
            *found = fewer;
            return merge(problem, nominal, found, blocks);
        }
    }
}

fn merged(
    problem: &Problem,
    nominal: &[Term],
    found: &[Found],
    blocks: &Blocks,
    bristle: usize,
) -> Option<Vec<Found>> {
    let own = &found.get(bristle)?.term;
    let (one, constant) = takes_both(own.cause.mechanism)?;
    // A spring has its rest angle where it likes, dry friction with a sense is a constant.
    let beside = |f: &Found| {
        entry(f.term.cause.mechanism).is_some_and(|entry| entry.is_or_has_limit(constant))
            && f.term.cause.at == own.cause.at
            && f.term.onset_s == own.onset_s
    };
    if !found.iter().any(beside) {
        return None;
    }
    let all = found.iter().enumerate();
    let others: Vec<Found> = all
        .filter(|(k, f)| *k != bristle && !beside(f))
        .map(|(_, f)| f.clone())
        .collect();
    let common = refs(nominal, &others);
    let cause = Cause {
        mechanism: one,
        ..own.cause
    };
    let begun = realise(problem, cause, &own.shape, own.onset_s, &[])?;
    let term = refined(problem, &common, begun, blocks);
    let with = beside_others(problem, &common, &[&term], blocks);
    let numbers = own_coefficients(&term, &with);
    let two = fit(problem, &refs(nominal, found), blocks);
    let plain = beside_others(problem, &common, &[own], blocks);
    if drives(&term, numbers) || !does_as_much(problem, &plain, &two, &with) {
        return None;
    }
    let without = fit(problem, &common, blocks);
    let expected = excitation(&term, numbers, blocks);
    let (_, z) = paired(&without.block_loss, &with.block_loss, &expected);
    let one = Found {
        z,
        share: 1.0 - with.left_out() / without.left_out().max(1e-300),
        at_floor: is_noise(problem, &with),
        term,
        probability: 1.0,
    };
    Some([others, vec![one]].concat())
}

fn beside_others(problem: &Problem, common: &[&Term], own: &[&Term], blocks: &Blocks) -> Fit {
    fit(problem, &[common, own].concat(), blocks)
}

/// Whether unequal limits do what the constant did beside the plain bristle: all of it but noise, or nearly all where even both leave more than noise.
///
/// Before anything has moved the constant is there and the bristle is not: that is one moment, which no scatter of blocks would tell.
fn does_as_much(problem: &Problem, plain: &Fit, two: &Fit, with: &Fit) -> bool {
    if is_noise(problem, two) {
        let more = with.left_out() - two.left_out();
        return more < LEAST_SIGMAS * LEAST_SIGMAS && !is_better(two, with);
    }
    let gain = |fitted: &Fit| plain.left_out() - fitted.left_out();
    gain(with) >= SIMPLER_SHARE * gain(two) || !is_better(two, with)
}

/// Whether one fit explains clearly more than another on the blocks that were left out.
fn is_better(one: &Fit, other: &Fit) -> bool {
    let all = vec![1.0; one.block_loss.len()];
    paired(&other.block_loss, &one.block_loss, &all).1 >= TIE_Z
}

/// What a found bristle with unequal limits may be instead: two causes that explain as much together. `None` for anything else.
///
/// Once it has slid they are one law: no experiment tells them apart.
pub(crate) fn as_two(problem: &Problem, selection: &Selection, index: usize) -> Option<[Cause; 2]> {
    let own = &selection.found.get(index)?.term;
    let both = facts(own.cause.mechanism)?.both?;
    let blocks = Blocks::new(problem);
    let mut others = selection.found.clone();
    others.remove(index);
    let causes = both.map(|mechanism| Cause {
        mechanism,
        ..own.cause
    });
    let shapes = [&own.shape[..], &[]];
    let terms: Vec<Term> = causes
        .into_iter()
        .zip(shapes)
        .filter_map(|(cause, shape)| realise(problem, cause, shape, own.onset_s, &[]))
        .collect();
    let common = refs(&selection.nominal, &others);
    let with = beside_others(problem, &common, &terms.iter().collect::<Vec<_>>(), &blocks);
    (!is_better(&selection.after, &with)).then_some(causes)
}

#[cfg(test)]
mod tests {
    use super::*;

    use crate::plant::Run;
    use crate::plants::joint::recorded::{Laws, exact_bench};

    /// What becomes of a bristle and a constant that were named, and what each of them has for a number.
    fn made_of(laws: Laws) -> Vec<(Mechanism, Vec<f64>)> {
        let run = exact_bench(laws, 6_000);
        let problem = Problem::new(&run, run.windows_of(0.017));
        let blocks = Blocks::new(&problem);
        let named = |(mechanism, shape): (Mechanism, &[f64])| Found {
            term: problem.term(Cause::of(mechanism), shape, None).unwrap(),
            z: 3.7,
            share: 0.07,
            at_floor: true,
            probability: 1.0,
        };
        let both = [
            (Mechanism::Presliding, &[0.041][..]),
            (Mechanism::ConstantBias, &[][..]),
        ];
        let mut found: Vec<Found> = both.into_iter().map(named).collect();
        merge(&problem, &[], &mut found, &blocks);
        let mut left = fit(&problem, &refs(&[], &found), &blocks)
            .coefficients
            .into_iter();
        let own = found.iter().map(|f| {
            let numbers = left
                .by_ref()
                .take(f.term.free.len())
                .chain(f.term.shape.clone());
            (f.term.cause.mechanism, numbers.collect())
        });
        own.collect()
    }

    #[test]
    fn a_bristle_whose_limits_differ_is_one_cause() {
        let made = made_of(&[(Mechanism::AsymmetricPresliding, &[2.3, 0.7, 0.041])]);
        let [(Mechanism::AsymmetricPresliding, numbers)] = &made[..] else {
            panic!("{made:?}");
        };
        for (found, hidden) in numbers.iter().zip([2.3, 0.7, 0.041]) {
            assert!((found / hidden - 1.0).abs() < 0.02, "{numbers:?}");
        }
    }

    #[test]
    fn a_constant_that_is_there_before_anything_has_moved_stays_beside_the_bristle() {
        let laws: Laws = &[
            (Mechanism::Presliding, &[1.5, 0.041]),
            (Mechanism::ConstantBias, &[0.8]),
        ];
        let made = made_of(laws);
        let names: Vec<Mechanism> = made.iter().map(|(mechanism, _)| *mechanism).collect();
        assert_eq!(
            names,
            [Mechanism::Presliding, Mechanism::ConstantBias],
            "{made:?}"
        );
    }
}
