//! This file forgets the sense of a motion around its turning points.

use rigproof_model::effects::Instant;

/// Takes the sense away as long as the position stays within `still` of where it turns back: when in there it turned, and whether it
/// stood, is not recorded, and a brake without backlash gives its whole torque both ways.
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
        // At rest nearly every sample turns: what was forgotten already is not looked at again.
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
