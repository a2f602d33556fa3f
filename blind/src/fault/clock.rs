//! This file spoils the clock: it jumps, is set forward by a little, or jitters.

use super::{Mark, Recording, mark, moving};
use crate::draw::Draw;

/// The clock jumps once, forward by 0.5 to 2 s or backward by 0.2 to 1 s, while the mechanism moves on.
pub fn jump(own: &mut Recording<'_>, draw: &mut Draw) -> Option<Mark> {
    let start = (draw.uniform(0.3, 0.7) * own.count() as f64) as usize;
    let forward = draw.chance(0.5);
    let by_s = if forward {
        draw.uniform(0.5, 2.0)
    } else {
        -draw.uniform(0.2, 1.0)
    };
    set(own, start, by_s)
}

/// The clock is set forward by 20 to 60 ms, so little that samples might be missing, while the mechanism moves.
pub fn set_forward(own: &mut Recording<'_>, draw: &mut Draw) -> Option<Mark> {
    let start = moving(own.position()?, 2.0, draw)?;
    let by_s = draw.uniform(0.02, 0.06);
    set(own, start, by_s)
}

fn set(own: &mut Recording<'_>, start: usize, by_s: f64) -> Option<Mark> {
    own.trace
        .time_s
        .iter_mut()
        .skip(start)
        .for_each(|time_s| *time_s += by_s);
    Some(mark(&["time"], (start - 1, start)))
}

/// Every stamp is off by a twentieth of a step, root mean square.
pub fn jitter(own: &mut Recording<'_>, draw: &mut Draw) -> Option<Mark> {
    let step_s = own.trace.time_s.get(1)? - own.trace.time_s.first()?;
    let mut off = || (0.05 * step_s * draw.normal(1.0)).clamp(-0.2 * step_s, 0.2 * step_s);
    own.trace
        .time_s
        .iter_mut()
        .for_each(|time_s| *time_s += off());
    Some(mark(&["time"], (0, own.count() - 1)))
}
