//! This file marks the direction of motion as unknown around reversals.

use rigproof_model::effects::Instant;

/// Marks the direction as unknown while the position stays within `still` of a reversal. No
/// recording shows when in there the joint reversed or whether it stopped, and a brake without
/// backlash gives its full torque in either direction.
pub(crate) fn forget_sense_near_reversals(motion: &mut [Instant], position: &[f64], still: f64) {
    let turns: Vec<usize> = motion
        .windows(2)
        .enumerate()
        .filter_map(|(k, pair)| match pair {
            [before, after] => (before.speed * after.speed <= 0.0).then_some(k),
            _ => None,
        })
        .collect();
    let mut done = 0;
    for turn in turns {
        // At rest nearly every sample reverses. Samples that are already marked are skipped.
        if turn < done {
            continue;
        }
        let at = position.get(turn).copied().unwrap_or(0.0);
        let near = |x: &f64| (x - at).abs() <= still;
        let (before, after) = position.split_at(turn);
        let first = turn - before.iter().rev().take_while(|x| near(x)).count();
        let count = turn - first + after.iter().take_while(|x| near(x)).count();
        done = first + count;
        let around = motion.iter_mut().skip(first).take(count);
        around.for_each(|now| now.sense = 0.0);
    }
}
