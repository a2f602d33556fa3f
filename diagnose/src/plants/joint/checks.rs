//! This file finds channels of a plant of one joint that are dead, clipped or in another unit,
//! before anything is fitted.

use super::align::Signals;
use super::run::PlantKind;
use crate::align::{
    Fault, Metered, Stated, check_clipped, check_metered, check_units, longest_freeze,
};
use crate::filter::ends;
use crate::rules::{DIES_AWAY, GROWS, LEAST_WAY, MOST_TURNS};

/// Checks the channels as recorded, and after repair.
///
/// # Errors
/// The faulty channel, and the reason.
pub fn check(recorded: &Signals, signals: &Signals, step_s: f64) -> Result<(), Fault> {
    check_units_of(recorded)?;
    check_metered_effort(signals, step_s)?;
    check_commanded(signals)?;
    check_clipped(&signals.time_s, &signals.effort, signals.effort_limit)
}

/// Checks that the position's resolution and the effort's noise fit the stated units.
fn check_units_of(signals: &Signals) -> Result<(), Fault> {
    let ends_s = [signals.time_s.first(), signals.time_s.last()];
    let ends_s = ends_s.map(|end| end.copied().unwrap_or(0.0));
    let position = Stated {
        channel: "position",
        samples: &signals.position,
        quantum: signals.position_quantum,
        noise: None,
    };
    let effort = Stated {
        channel: "effort",
        samples: &signals.effort,
        quantum: None,
        noise: signals.effort_noise,
    };
    check_units(&position, ends_s)?;
    check_units(&effort, ends_s)
}

/// Under a constant command an axis comes to rest or keeps its direction. If it is driven to and
/// fro instead, the command is dead or another column.
fn check_commanded(signals: &Signals) -> Result<(), Fault> {
    let level = signals.effort.iter().find(|x| !x.is_nan());
    let Some(level) = level.filter(|_| signals.plant == PlantKind::Axis) else {
        return Ok(());
    };
    if signals.effort.iter().any(|x| !x.is_nan() && x != level) {
        return Ok(());
    }
    let (halves, turns) = to_and_fro(&signals.position);
    let [first, second] = halves;
    let is_driven = turns >= MOST_TURNS && second >= DIES_AWAY * first;
    let moves_dead = *level == 0.0 && starts_by_itself(&signals.position);
    if !is_driven && !moves_dead {
        return Ok(());
    }
    let at = |end: Option<&f64>| end.copied().unwrap_or(0.0);
    Err(Fault {
        channel: "effort",
        from_s: at(signals.time_s.first()),
        to_s: at(signals.time_s.last()),
        reason: format!(
            "the command is {level} (SI) throughout while the position is driven (it turns back {turns} times): the channel is dead, or another column is the command"
        ),
    })
}

/// Whether the motion grows by more than a free motion ever does.
fn starts_by_itself(position: &[f64]) -> bool {
    let stretch = (position.len() / 20).max(2);
    let ways = position.chunks(stretch).map(|own| {
        let [low, high] = ends(own.iter().copied());
        high - low
    });
    let ways: Vec<f64> = ways.collect();
    let greatest = ways.iter().copied().fold(0.0, f64::max);
    let mut least = f64::INFINITY;
    ways.into_iter().any(|way| {
        least = least.min(way);
        way > GROWS * least && way > LEAST_WAY * greatest
    })
}

/// The path length of the first and the second half, and the number of reversals by more than a
/// tenth of the range.
fn to_and_fro(position: &[f64]) -> ([f64; 2], usize) {
    let live: Vec<f64> = position.iter().copied().filter(|x| !x.is_nan()).collect();
    let (first, second) = live.split_at(live.len() / 2);
    let way = |own: &[f64]| -> f64 {
        let pairs = own
            .windows(2)
            .filter_map(|pair| Some(pair.last()? - pair.first()?));
        pairs.map(f64::abs).sum()
    };
    let [low, high] = ends(live.iter().copied());
    let (mut turns, mut extreme, mut upward) = (0, low, true);
    for x in &live {
        extreme = if upward {
            extreme.max(*x)
        } else {
            extreme.min(*x)
        };
        if (x - extreme).abs() > 0.1 * (high - low) {
            (turns, upward, extreme) = (turns + 1, !upward, *x);
        }
    }
    ([way(first), way(second)], turns)
}

/// A metered effort is noisy.
fn check_metered_effort(signals: &Signals, step_s: f64) -> Result<(), Fault> {
    if signals.plant == PlantKind::Axis {
        return Ok(());
    }
    let effort = Metered {
        channel: "effort",
        samples: &signals.effort,
        positions: &[&signals.position],
        least: longest_freeze(step_s),
    };
    check_metered(&effort, &signals.time_s, step_s)
}
