//! This file takes out laws of friction that only mend the form of another one at their joint.

use super::refine::refine;
use super::together::{bends, mends};
use super::{Found, refs};
use crate::cause::Cause;
use crate::problem::{Problem, Term};
use crate::regression::{Blocks, fit};
use crate::rules::OF_ITS_FORM;

/// Drops, weakest first, every law with a memory of its motion that explains a tenth of what one that bends explains at its joint, both from the
/// start. Where a true friction is no bristle, no peak and no settling, two of them are nearer to it than one.
pub(super) fn take_out_forms(
    problem: &Problem,
    nominal: &[Term],
    found: &mut Vec<Found>,
    blocks: &Blocks,
) -> Vec<Cause> {
    let mut taken_out = Vec::new();
    while let Some(index) = weakest_form(problem, nominal, found, blocks) {
        taken_out.push(found.remove(index).term.cause);
        refine(problem, nominal, found, blocks);
    }
    taken_out
}

fn weakest_form(
    problem: &Problem,
    nominal: &[Term],
    found: &[Found],
    blocks: &Blocks,
) -> Option<usize> {
    let with = fit(problem, &refs(nominal, found), blocks).left_out();
    let explained: Vec<f64> = (0..found.len())
        .map(|index| {
            let mut fewer = found.to_vec();
            fewer.remove(index);
            fit(problem, &refs(nominal, &fewer), blocks).left_out() - with
        })
        .collect();
    let is_form = |index: usize| {
        let (own, gain) = (found.get(index)?, explained.get(index)?);
        let cause = own.term.cause;
        let mut others = found.iter().zip(&explained).enumerate();
        let has_form = others.any(|(place, (other, of_other))| {
            place != index
                && bends(other.term.cause.mechanism)
                && other.term.cause.at == cause.at
                && other.term.onset_s.is_none()
                && *gain < OF_ITS_FORM * of_other
        });
        (mends(cause.mechanism) && own.term.onset_s.is_none() && has_form).then_some((index, *gain))
    };
    let forms = (0..found.len()).filter_map(is_form);
    forms
        .min_by(|a, b| a.1.total_cmp(&b.1))
        .map(|(index, _)| index)
}

#[cfg(test)]
mod tests {
    use super::*;

    use crate::plants::five_bar;
    use crate::plants::five_bar::recorded::{noise_rows, short_run, target};
    use crate::problem::add;
    use crate::select::usable_rms;
    use rigproof_spec::effect::Mechanism;
    use rigproof_spec::joint::Joint;

    #[test]
    fn a_hundredth_of_what_a_peak_explains_is_its_form_and_half_is_a_bristle() {
        let run = short_run();
        let mut problem = five_bar::recorded::problem(&run);
        let at = |mechanism, joint, shape: &[f64]| {
            let cause = five_bar::run::at(mechanism, joint);
            problem.term(cause, shape, None).unwrap()
        };
        let peak = at(Mechanism::Stribeck, Joint::B, &[0.17, 2.0, 0.004]);
        let [own, other] = [Joint::B, Joint::A].map(|j| at(Mechanism::Presliding, j, &[0.031]));
        let mut left = |bristle: &Term, level: f64| {
            let [first, second] = [&peak, bristle].map(|term| &term.free[0].raw);
            let size = usable_rms(&problem, first) / usable_rms(&problem, second);
            let mut raw = noise_rows(&problem, 47);
            add(&mut raw, first, 0.9);
            add(&mut raw, second, 0.9 * size * level);
            problem.target = target(&problem, raw);
            let found = |term: &Term| Found {
                term: term.clone(),
                z: 5.0,
                share: 0.5,
                at_floor: true,
                probability: 1.0,
            };
            let mut both = vec![found(&peak), found(bristle)];
            let taken_out = take_out_forms(&problem, &[], &mut both, &Blocks::new(&problem));
            assert_eq!(taken_out.len() + both.len(), 2);
            both.len()
        };
        assert_eq!(
            [left(&own, 0.1), left(&own, 0.7), left(&other, 0.1)],
            [1, 2, 2]
        );
    }
}
