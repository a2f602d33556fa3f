//! This file takes mechanisms out again: those that others make unnecessary, those that explain too little.

use super::refine::refine;
use super::weigh::{coefficients_of, drives, excitation, is_noise, usable_rms};
use super::{Found, Gates, TIE_Z, floor_limit, refs};
use crate::cause::Cause;
use crate::problem::{Problem, Term};
use crate::regression::{Blocks, Fit, fit, paired};
use crate::rules::{EXACT_TO_UNEXPLAINED, LONE_TO_UNEXPLAINED};
use rigproof_model::effects::facts;

/// Drops every found mechanism that the others, with their shapes adjusted, make unnecessary.
pub(super) fn backward(
    problem: &Problem,
    nominal: &[Term],
    found: &mut Vec<Found>,
    blocks: &Blocks,
    gates: Gates,
) {
    let mut index = 0;
    while index < found.len() {
        let current = fit(problem, &refs(nominal, found), blocks);
        let own = coefficients_of(found, index, &current).to_vec();
        let mut fewer = found.clone();
        let removed = fewer.remove(index);
        refine(problem, nominal, &mut fewer, blocks);
        let without = fit(problem, &refs(nominal, &fewer), blocks);
        let (_, z) = paired(
            &without.block_loss,
            &current.block_loss,
            &excitation(&removed.term, &own, blocks),
        );
        let share = 1.0 - current.left_out() / without.left_out().max(1e-300);
        // One that decides whether anything is left shows in few blocks where z is small.
        let decides =
            problem.rules.by_floor && is_noise(problem, &current) && !is_noise(problem, &without);
        if z < TIE_Z && !decides || share < gates.share || drives(&removed.term, &own) {
            *found = fewer;
        } else {
            if let Some(kept) = found.get_mut(index) {
                (kept.z, kept.share) = (z, share);
            }
            index += 1;
        }
    }
}

/// Takes out, weakest first, every mechanism that explains less than what stays unexplained: beside an
/// unknown of that size it may only be soaking it up.
///
/// Both are left-out white losses; the part of the loss that sensor noise accounts for is not unexplained.
pub(super) fn prune(
    problem: &Problem,
    nominal: &[Term],
    found: &mut Vec<Found>,
    blocks: &Blocks,
) -> Vec<Cause> {
    let mut taken_out = Vec::new();
    loop {
        let current = fit(problem, &refs(nominal, found), blocks);
        let causes: Vec<Cause> = found.iter().map(|f| f.term.cause).collect();
        let least = least_to_unexplained(problem, &causes) * unexplained(problem, &current);
        let weakest = (0..found.len())
            .map(|index| {
                let mut fewer = found.clone();
                fewer.remove(index);
                let without = fit(problem, &refs(nominal, &fewer), blocks);
                (without.left_out() - current.left_out(), index)
            })
            .min_by(|a, b| a.0.total_cmp(&b.0));
        match weakest {
            Some((own, index)) if own < least => {
                taken_out.push(found.remove(index).term.cause);
            }
            _ => return taken_out,
        }
    }
}

/// Left-out loss that sensor noise does not account for.
pub(super) fn unexplained(problem: &Problem, current: &Fit) -> f64 {
    let ratio = usable_rms(problem, &current.residual) / (floor_limit(problem) * problem.floor);
    current.left_out() * (1.0 - 1.0 / (ratio * ratio)).max(0.0)
}

/// Whether one mechanism alone would stay that takes the left-out loss down to that of a fit.
pub(super) fn would_stay(problem: &Problem, cause: Cause, without: f64, with: &Fit) -> bool {
    without - with.left_out()
        >= least_to_unexplained(problem, &[cause]) * unexplained(problem, with)
}

/// Whether one mechanism alone explains enough of what stays, row by row: a block left out tells nothing of what shows in one block.
pub(super) fn outweighs(problem: &Problem, cause: Cause, without: &Fit, with: &Fit) -> bool {
    let [before, after] = [without, with].map(|fit| usable_rms(problem, &fit.residual));
    let noise = floor_limit(problem) * problem.floor;
    let unexplained = (after * after - noise * noise).max(0.0);
    before * before - after * after >= least_to_unexplained(problem, &[cause]) * unexplained
}

/// Multiple of the unexplained energy that each name must explain.
///
/// Friction with a peak, a memory or heat has laws of many families; one of another family leaves a part of the effect, and the name is right.
/// A mass, a sensor's error, a gain or a constant has one form: what it leaves is something else, which it may only stand in for. So does a
/// settling, whose decay follows whatever dies away.
fn least_to_unexplained(problem: &Problem, named: &[Cause]) -> f64 {
    let exact = |cause: &Cause| facts(cause.mechanism).is_none_or(|own| !own.has_forms);
    match problem.rules.by_form {
        true if named.iter().all(exact) => EXACT_TO_UNEXPLAINED,
        true if named.len() == 1 => LONE_TO_UNEXPLAINED,
        _ => problem.rules.own_to_unexplained,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    use crate::plant::Run;
    use crate::plants::five_bar;
    use crate::plants::five_bar::recorded::{noise_rows, short_run, target};
    use crate::plants::joint::recorded::{Noise, exact_bench};
    use crate::problem::add;
    use rigproof_spec::effect::Mechanism;
    use rigproof_spec::joint::Joint;

    #[test]
    fn in_few_windows_noise_that_happens_to_be_loud_takes_no_name_out() {
        let run = exact_bench(&[(Mechanism::Viscous, &[2.3])], 11_000);
        let mut problem = Problem::new(&run, run.windows_of(0.043));
        let every = problem.windows.usable.len() / 24;
        for (row, usable) in problem.windows.usable.iter_mut().enumerate() {
            *usable = row % every == 0;
        }
        let mut noise = Noise::new(37);
        let loud: Vec<f64> = (problem.windows.usable.iter())
            .map(|_| 1.41 * problem.floor * noise.draw())
            .collect();
        let term = problem
            .term(Cause::of(Mechanism::Viscous), &[], None)
            .unwrap();
        let size = usable_rms(&problem, &term.free[0].raw);
        let pairs = loud.iter().zip(&term.free[0].raw);
        let raw: Vec<f64> = pairs
            .map(|(e, x)| e + 0.4 * problem.floor / size * x)
            .collect();
        problem.target = target(&problem, raw);
        let blocks = Blocks::new(&problem);
        let mut found = vec![Found {
            term,
            z: 3.7,
            share: 0.07,
            at_floor: false,
            probability: 1.0,
        }];
        let left = fit(&problem, &refs(&[], &found), &blocks).residual;
        let ratio = usable_rms(&problem, &left) / problem.floor;
        assert!(ratio > 1.35 && ratio < floor_limit(&problem), "{ratio}");
        assert_eq!(prune(&problem, &[], &mut found, &blocks), []);
    }

    #[test]
    fn what_decides_whether_anything_is_left_stays_though_few_blocks_tell_it() {
        let run = short_run();
        let mut problem = five_bar::recorded::problem(&run);
        let cause = five_bar::run::at(Mechanism::DryOffset, Joint::A);
        let onset_s = run.start_s + 0.7 * run.clock().duration_s();
        let term = problem.term(cause, &[], Some(onset_s)).unwrap();
        let mut kept = |level: f64| {
            let mut raw = noise_rows(&problem, 53);
            add(&mut raw, &term.free[0].raw, level);
            problem.target = target(&problem, raw);
            let mut found = vec![Found {
                term: term.clone(),
                z: 3.1,
                share: 0.5,
                at_floor: true,
                probability: 1.0,
            }];
            let blocks = Blocks::new(&problem);
            backward(&problem, &[], &mut found, &blocks, Gates::default());
            found.first().map(|own| own.z)
        };
        let z = kept(0.4).unwrap();
        assert!(z < TIE_Z, "{z}");
        assert_eq!(kept(0.001), None);
    }

    /// What is taken out of one name when it explains some fifteen times what stays unexplained.
    fn taken_out(problem: &mut Problem, cause: Cause, shape: &[f64]) -> Vec<Cause> {
        let ripple = five_bar::run::at(Mechanism::Ripple, Joint::B);
        let [term, other] = [(cause, shape), (ripple, &[0.053][..])]
            .map(|(cause, shape)| problem.term(cause, shape, None).unwrap());
        let [own, other] = [(11.0, &term), (3.0, &other)].map(|(deviations, term)| {
            let rows = &term.free[0];
            let size = rows.white.iter().map(|x| x * x).sum::<f64>() / rows.white.len() as f64;
            let times = deviations / size.sqrt();
            rows.raw.iter().map(|x| times * x).collect::<Vec<f64>>()
        });
        let raw: Vec<f64> = own
            .iter()
            .zip(other)
            .map(|(own, other)| own + other)
            .collect();
        problem.target = target(problem, raw);
        let mut found = vec![Found {
            term,
            z: 3.7,
            share: 0.7,
            at_floor: false,
            probability: 1.0,
        }];
        let blocks = Blocks::new(problem);
        let [with, without] =
            [&found[..], &[]].map(|found| fit(problem, &refs(&[], found), &blocks));
        let stays = would_stay(problem, cause, without.left_out(), &with);
        let by_rows = outweighs(problem, cause, &without, &with);
        let taken_out = prune(problem, &[], &mut found, &blocks);
        assert_eq!([stays, by_rows], [taken_out.is_empty(); 2]);
        taken_out
    }

    #[test]
    fn what_a_mass_leaves_is_something_else_and_what_a_bristle_leaves_may_be_its_own() {
        let run = short_run();
        let mut problem = five_bar::recorded::problem(&run);
        let mass = Cause::of(Mechanism::Payload);
        assert_eq!(taken_out(&mut problem, mass, &[]), [mass]);
        let [bristle, settling] = [Mechanism::Presliding, Mechanism::Settling]
            .map(|mechanism| five_bar::run::at(mechanism, Joint::E));
        assert_eq!(taken_out(&mut problem, bristle, &[0.031]), []);
        assert_eq!(taken_out(&mut problem, settling, &[0.31]), [settling]);
    }
}
