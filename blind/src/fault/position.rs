//! This file spoils a position: it stands, drops out, is set to zero, wraps, loses counts, is repeated, filled in or refreshed too seldom.

use super::{Mark, Recording, mark, moving, quantum, range};
use crate::draw::Draw;

/// The encoder repeats one value for 10 to 25 % of the recording while the mechanism moves on.
pub fn stick(own: &mut Recording<'_>, draw: &mut Draw) -> Option<Mark> {
    let position = own.position()?;
    let count = position.len();
    let length = (draw.uniform(0.1, 0.25) * count as f64) as usize;
    let mut start = 0;
    let [low, high] = range(position);
    // A sensor stuck while the mechanism rests is no fault anybody could see.
    for _ in 0..50 {
        start = (draw.uniform(0.2, 0.7) * count as f64) as usize;
        let [from, to] = range(position.get(start..(start + length).min(count))?);
        if to - from > 0.2 * (high - low) {
            break;
        }
    }
    let frozen = *position.get(start)?;
    for sample in position.iter_mut().skip(start).take(length) {
        *sample = frozen;
    }
    own.on_position((start, (start + length).min(count - 1)))
}

/// A fifth to two fifths of the position cells are empty, in bursts.
pub fn drop_samples(own: &mut Recording<'_>, draw: &mut Draw) -> Option<Mark> {
    let share = draw.uniform(0.2, 0.4);
    let mut samples = own.position()?.iter_mut();
    while samples.len() > 0 {
        let burst = 10 + draw.below(90);
        let kept = (burst as f64 * (1.0 - share) / share) as usize;
        samples.by_ref().take(burst).for_each(|x| *x = f64::NAN);
        samples.by_ref().take(kept).for_each(|_| ());
    }
    own.on_position((0, own.count() - 1))
}

/// From a sample on the position counts from another zero.
pub fn rezero(own: &mut Recording<'_>, draw: &mut Draw) -> Option<Mark> {
    let position = own.position()?;
    let [low, high] = range(position);
    let by = draw.sign() * draw.uniform(0.2, 0.8) * (high - low);
    let start = moving(position, 0.0, draw)?;
    position.iter_mut().skip(start).for_each(|x| *x += by);
    own.on_position((start - 1, start))
}

/// The position begins anew at the end of a counter of 16 bits, or as many as its motion needs.
pub fn wrap(own: &mut Recording<'_>, draw: &mut Draw) -> Option<Mark> {
    let position = own.position()?;
    let [low, high] = range(position);
    let mut period = quantum(position) * 65_536.0;
    while period < 1.02 * (high - low) {
        period *= 2.0;
    }
    let first = *position.first()?;
    let upward = high - first > first - low;
    let share = draw.uniform(0.3, 0.7);
    let end = if upward {
        first + share * (high - first)
    } else {
        first - share * (first - low)
    };
    let beyond = |x: f64| if upward { x > end } else { x < end };
    let start = position.iter().position(|x| beyond(*x))?;
    let last = position.iter().rposition(|x| beyond(*x))?;
    let by = if upward { -period } else { period };
    position
        .iter_mut()
        .filter(|x| beyond(**x))
        .for_each(|x| *x += by);
    own.on_position((start, last))
}

/// Eight samples read zero.
pub fn drop_out(own: &mut Recording<'_>, draw: &mut Draw) -> Option<Mark> {
    let position = own.position()?;
    let [low, high] = range(position);
    let mut hit = Vec::new();
    for _ in 0..400 {
        let k = 20 + draw.below(position.len() - 40);
        let apart = hit.iter().all(|other: &usize| other.abs_diff(k) > 20);
        if hit.len() < 8 && apart && position.get(k)?.abs() > 0.1 * (high - low) {
            hit.push(k);
        }
    }
    for k in &hit {
        *position.get_mut(*k)? = 0.0;
    }
    own.on_position((*hit.iter().min()?, *hit.iter().max()?))
}

/// The encoder misses 30 to 300 counts at once while it moves.
pub fn lose_counts(own: &mut Recording<'_>, draw: &mut Draw) -> Option<Mark> {
    let position = own.position()?;
    let start = moving(position, 1.0, draw)?;
    let by = -quantum(position) * draw.log_uniform(30.0, 300.0).round();
    let forward = position.get(start + 6)? > position.get(start - 6)?;
    let by = if forward { by } else { -by };
    position.iter_mut().skip(start).for_each(|x| *x += by);
    own.on_position((start - 1, start))
}

/// Three in a hundred samples repeat the one before in every channel.
pub fn repeat_single(own: &mut Recording<'_>, draw: &mut Draw) -> Option<Mark> {
    let count = own.count();
    let hit: Vec<usize> = (1..count).filter(|_| draw.chance(0.035)).collect();
    repeat(own, hit.into_iter().map(|k| (k, 1)).collect())
}

/// The same in bursts of 5 to 10 samples.
pub fn repeat_bursts(own: &mut Recording<'_>, draw: &mut Draw) -> Option<Mark> {
    let count = own.count();
    let bursts = (0.04 * count as f64 / 7.5) as usize;
    bursts_of(own, bursts, draw)
}

/// Four bursts of 5 to 10 samples in the whole recording.
pub fn repeat_few(own: &mut Recording<'_>, draw: &mut Draw) -> Option<Mark> {
    bursts_of(own, 4, draw)
}

fn bursts_of(own: &mut Recording<'_>, bursts: usize, draw: &mut Draw) -> Option<Mark> {
    let position = own.position()?.clone();
    let starts = (0..bursts).filter_map(|_| {
        let start = moving(&position, 1.0, draw)?;
        Some((start, 5 + draw.below(6)))
    });
    let starts: Vec<(usize, usize)> = starts.collect();
    repeat(own, starts)
}

fn repeat(own: &mut Recording<'_>, runs: Vec<(usize, usize)>) -> Option<Mark> {
    let first = runs.iter().map(|(start, _)| *start).min()?;
    let last = runs.iter().map(|(start, length)| start + length).max()?;
    for channel in &mut own.trace.channels {
        for (start, length) in &runs {
            let held = *channel.samples.get(start - 1)?;
            channel
                .samples
                .iter_mut()
                .skip(*start)
                .take(*length)
                .for_each(|x| *x = held);
        }
    }
    let [position, effort] = own.names.roles;
    let last = last.min(own.count() - 1);
    Some(mark(&[position, effort, "every channel"], (first, last)))
}

/// Two to five stretches of 0.12 to 0.4 s are straight lines between what was recorded before and after.
pub fn fill_in(own: &mut Recording<'_>, draw: &mut Draw) -> Option<Mark> {
    let step_s = own.trace.time_s.get(1)? - own.trace.time_s.first()?;
    let position = own.position()?;
    let mut hit = Vec::new();
    for _ in 0..2 + draw.below(4) {
        let start = moving(position, 1.0, draw)?;
        let length = (draw.uniform(0.12, 0.4) / step_s) as usize;
        let (from, to) = (*position.get(start)?, position.get(start + length).copied());
        let Some(to) = to else { continue };
        for k in 1..length {
            *position.get_mut(start + k)? = from + (to - from) * k as f64 / length as f64;
        }
        hit.extend([start, start + length]);
    }
    own.on_position((*hit.iter().min()?, *hit.iter().max()?))
}

/// The position is read every 8 to 20 samples only.
pub fn refresh_slowly(own: &mut Recording<'_>, draw: &mut Draw) -> Option<Mark> {
    let every = 8 + draw.below(13);
    let position = own.position()?;
    moving(position, 2.0, draw)?;
    let mut held = f64::NAN;
    for (k, sample) in position.iter_mut().enumerate() {
        if k % every == 0 {
            held = *sample;
        }
        *sample = held;
    }
    own.on_position((0, own.count() - 1))
}
