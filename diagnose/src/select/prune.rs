//! This file takes mechanisms out again: those that others make unnecessary, those that explain too little.

use super::refine::refine;
use super::weigh::{coefficients_of, drives, excitation, usable_rms};
use super::{FLOOR_RATIO, Found, Gates, TIE_Z, refs};
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
        let ratio = usable_rms(problem, &current.residual) / (FLOOR_RATIO * problem.floor);
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
