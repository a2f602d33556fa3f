//! This file takes mechanisms out again: those that others make unnecessary, those that explain too little.

use super::refine::refine;
use super::weigh::{coefficients_of, drives, excitation, usable_rms};
use super::{Found, Gates, TIE_Z, floor_limit, refs};
use crate::problem::{Cause, Problem, Term};
use crate::regression::{Blocks, fit, paired};

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
        if z < TIE_Z || share < gates.share || drives(&removed.term, &own) {
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
        let ratio = usable_rms(problem, &current.residual) / (floor_limit(problem) * problem.floor);
        let unexplained = current.left_out() * (1.0 - 1.0 / (ratio * ratio)).max(0.0);
        let weakest = (0..found.len())
            .map(|index| {
                let mut fewer = found.clone();
                fewer.remove(index);
                let without = fit(problem, &refs(nominal, &fewer), blocks);
                (without.left_out() - current.left_out(), index)
            })
            .min_by(|a, b| a.0.total_cmp(&b.0));
        match weakest {
            Some((own, index)) if own < problem.plant.own_to_unexplained() * unexplained => {
                taken_out.push(found.remove(index).term.cause);
            }
            _ => return taken_out,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    use crate::problem::{Inertia, Rows};
    use crate::recorded::{Noise, exact_bench};
    use crate::weak::Windows;
    use rigproof_spec::effect::Mechanism;

    #[test]
    fn in_few_windows_noise_that_happens_to_be_loud_takes_no_name_out() {
        let run = exact_bench(&[(Mechanism::Viscous, &[2.3])], 11_000);
        let mut problem = Problem::new(&run, Windows::new(&run, 0.043), Inertia::None);
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
        problem.target = Rows {
            signal: Vec::new(),
            white: problem.whitener.whiten(&raw),
            raw,
        };
        let blocks = Blocks::new(&problem);
        let mut found = vec![Found {
            term,
            z: 3.7,
            share: 0.07,
            at_floor: false,
        }];
        let left = fit(&problem, &refs(&[], &found), &blocks).residual;
        let ratio = usable_rms(&problem, &left) / problem.floor;
        assert!(ratio > 1.35 && ratio < floor_limit(&problem), "{ratio}");
        assert_eq!(prune(&problem, &[], &mut found, &blocks), []);
    }
}
