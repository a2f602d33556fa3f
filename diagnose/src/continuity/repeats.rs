//! This file finds samples that repeat the one before while the plant moves on: in every channel,
//! or in a position alone.

use super::steps::{Steps, median};
use super::{Position, Remark, Stamps, few};
use crate::align::Fault;
use crate::rules::{
    CATCH_UP, FEWEST_REFRESHED, HELD_QUANTA, LONGEST_FREEZE_S, MOST_REPEATED_BY_CHANCE,
    MOVED_WITHIN, REFRESHED,
};

/// # Errors
/// A position that changes only every few samples, by large steps.
pub fn check_refreshed(stamps: Stamps<'_>, own: &Position) -> Result<(), Fault> {
    let steps = Steps::of(stamps, own);
    let mut since = 0usize;
    let mut gaps = Vec::new();
    let mut first = None;
    for (j, step) in steps.step.iter().enumerate() {
        since += 1;
        if *step == 0.0 {
            continue;
        }
        if step.abs() >= HELD_QUANTA * own.quantum {
            gaps.push(since as f64);
            first = first.or(steps.index.get(j).copied());
        }
        since = 0;
    }
    let late = gaps.iter().filter(|gap| **gap > 1.0).count();
    if gaps.len() < FEWEST_REFRESHED || (late as f64) < REFRESHED * gaps.len() as f64 {
        return Ok(());
    }
    let every = median(gaps);
    Err(Fault {
        channel: own.channel,
        from_s: stamps.at(first.unwrap_or(0)),
        to_s: stamps.at(own.samples.len().saturating_sub(1)),
        reason: format!(
            "it changes only every {every:.0} samples (about {:.0} Hz) in a recording of {:.0} Hz: it is refreshed more slowly than it is written; read the sensor for every sample, or write only its own samples",
            1.0 / (every * stamps.step_s),
            1.0 / stamps.step_s
        ),
    })
}

/// Leaves out samples at which every channel repeats the one before while a position moves on.
pub fn leave_out_rows(
    stamps: Stamps<'_>,
    positions: &mut [Position],
    others: &mut [&mut Vec<f64>],
) -> Result<Option<Remark>, Fault> {
    let count = positions.first().map_or(0, |own| own.samples.len());
    let same = |samples: &[f64], k: usize| match (samples.get(k.wrapping_sub(1)), samples.get(k)) {
        (Some(before), Some(now)) => before.to_bits() == now.to_bits(),
        _ => false,
    };
    let stands = |k: usize| positions.iter().all(|own| same(&own.samples, k));
    let repeats = |k: usize| stands(k) && others.iter().all(|own| same(own, k));
    // A channel that never repeats by chance shows repeated samples even in slow motion.
    let moved: Vec<usize> = (1..count).filter(|k| !stands(*k)).collect();
    let tells = others.iter().any(|own| {
        let by_chance = moved.iter().filter(|k| same(own, **k)).count();
        (by_chance as f64) < MOST_REPEATED_BY_CHANCE * moved.len() as f64
    });
    let mut bad = Vec::new();
    let mut longest = 0;
    for (first, end) in runs(count, repeats, stamps) {
        let is_bad = positions
            .iter()
            .any(|own| catches_up(own, (first, end), 0.0) || tells && moves(own, first, end));
        if is_bad {
            longest = longest.max(end - first);
            bad.extend(first..end);
        }
    }
    let of = (1..count).filter(|&k| positions.iter().any(|own| moves(own, k, k + 1)));
    let of = of.count();
    let found = format!(
        "{} of {of} samples repeat the one before in every channel while the plant moves, up to {longest} in a row",
        bad.len()
    );
    let mended = few(
        stamps,
        ("every channel", "repeated"),
        &bad,
        of,
        (
            found,
            "the logger wrote samples again where it had none; record anew, or leave the repeated lines out",
        ),
    )?;
    let own = positions.iter_mut().map(|own| &mut own.samples);
    for samples in own.chain(others.iter_mut().map(|own| &mut **own)) {
        forget(samples, &bad);
    }
    Ok(mended)
}

/// Leaves out samples at which a position alone repeats the one before and then catches up.
pub fn leave_out_held(stamps: Stamps<'_>, own: &mut Position) -> Result<Option<Remark>, Fault> {
    let same = |k: usize| {
        let pair = own.samples.get(k.wrapping_sub(1)).zip(own.samples.get(k));
        pair.is_some_and(|(before, now)| before == now)
    };
    let held = runs(own.samples.len(), same, stamps);
    let held = held
        .into_iter()
        .filter(|run| catches_up(own, *run, HELD_QUANTA));
    let held: Vec<(usize, usize)> = held.collect();
    let longest = held.iter().map(|(first, end)| end - first).max();
    let bad: Vec<usize> = held
        .into_iter()
        .flat_map(|(first, end)| first..end)
        .collect();
    let of = (1..own.samples.len())
        .filter(|&k| moves(own, k, k + 1))
        .count();
    let found = format!(
        "{} of {of} samples repeat the one before while it moves, up to {} in a row, and the next one catches up",
        bad.len(),
        longest.unwrap_or(0)
    );
    let cure = "the sensor is read too late or too seldom; mend that, or leave these cells empty";
    let mended = few(stamps, (own.channel, "held"), &bad, of, (found, cure))?;
    forget(&mut own.samples, &bad);
    Ok(mended)
}

fn forget(samples: &mut [f64], bad: &[usize]) {
    for k in bad {
        if let Some(slot) = samples.get_mut(*k) {
            *slot = f64::NAN;
        }
    }
}

/// Runs of samples that repeat the one before them, as first index and end.
fn runs(count: usize, repeats: impl Fn(usize) -> bool, stamps: Stamps<'_>) -> Vec<(usize, usize)> {
    let longest = (LONGEST_FREEZE_S / stamps.step_s).ceil() as usize;
    let mut runs = Vec::new();
    let mut k = 1;
    while k < count {
        let end = (k..count).find(|&k| !repeats(k)).unwrap_or(count);
        if end > k && end - k <= longest {
            runs.push((k, end));
        }
        k = end + 1;
    }
    runs
}

/// Whether a position moves around a run by more than flicker between counts.
fn moves(own: &Position, first: usize, end: usize) -> bool {
    let before = own.samples.get(first.saturating_sub(1 + MOVED_WITHIN));
    let after = own
        .samples
        .get((end + MOVED_WITHIN).min(own.samples.len().saturating_sub(1)));
    let moved = before
        .zip(after)
        .map(|(before, after)| (after - before).abs());
    moved.is_some_and(|moved| moved > 4.0 * own.quantum + 6.0 * own.noise)
}

/// Whether a position catches up in one step after a run. A step counts from `least` times the
/// usual step.
fn catches_up(own: &Position, (first, end): (usize, usize), least: f64) -> bool {
    let at = |k: usize| own.samples.get(k).copied();
    let step = |k: usize| Some(at(k)? - at(k.checked_sub(1)?)?).filter(|step| !step.is_nan());
    let usual = |steps: core::ops::Range<usize>| median(steps.filter_map(step).collect());
    let Some(caught) = step(end) else {
        return false;
    };
    let before = usual(first.saturating_sub(3)..first);
    let after = usual(end + 1..end + 4);
    let expected = (end - first + 1) as f64 * 0.5 * (before + after);
    let usual = before.abs().max(after.abs());
    let counts = 2.0 * own.quantum + 6.0 * own.noise;
    before.abs().min(after.abs()) >= least * own.quantum
        && caught.abs() >= (HELD_QUANTA * own.quantum).max(1.6 * usual)
        && (caught - expected).abs() <= CATCH_UP * expected.abs() + counts
}
