//! This file finds stretches of a position that were filled in by straight lines.

use super::steps::Steps;
use super::{Position, Remark, Stamps, few};
use crate::align::{Fault, smallest_step};
use crate::rules::{LEAST_STRAIGHT, LONGEST_GAP_S, MOST_STRAIGHT};

/// Relative difference of two equal steps, from rounding.
const ROUNDING: f64 = 1e-9;

/// Leaves out short stretches of a straight line between samples that do not lie on one.
///
/// # Errors
/// A long stretch, or many of them.
pub fn leave_out(stamps: Stamps<'_>, own: &mut Position) -> Result<Option<Remark>, Fault> {
    let runs = filled(stamps, own);
    let longest = runs.iter().max_by_key(|(first, end)| end - first).copied();
    let Some((first, end)) = longest else {
        return Ok(None);
    };
    if stamps.at(end) - stamps.at(first) > LONGEST_GAP_S {
        return Err(Fault {
            channel: own.channel,
            from_s: stamps.at(first),
            to_s: stamps.at(end),
            reason: format!(
                "it is a straight line for {:.3} s, to the last digit: samples were missing and have been filled in; cut the recording there, or leave the cells empty",
                stamps.at(end) - stamps.at(first)
            ),
        });
    }
    let bad: Vec<usize> = runs
        .into_iter()
        .flat_map(|(first, end)| first + 1..end)
        .collect();
    let found = format!(
        "{} samples lie on straight lines to the last digit, filled in between others",
        bad.len()
    );
    let cure = "leave the cells empty where a sample is missing";
    let what = (own.channel, "filled_in");
    let mended = few(stamps, what, &bad, own.samples.len(), (found, cure))?;
    for k in bad {
        if let Some(slot) = own.samples.get_mut(k) {
            *slot = f64::NAN;
        }
    }
    Ok(mended)
}

/// Stretches that were filled in, by the samples at their ends.
///
/// If the resolution is known, filled-in samples lie between counts. Otherwise a straight stretch
/// is suspicious in a recording that is mostly not straight.
fn filled(stamps: Stamps<'_>, own: &Position) -> Vec<(usize, usize)> {
    let steps = Steps::of(stamps, own);
    let size = own
        .samples
        .iter()
        .filter(|x| !x.is_nan())
        .fold(0.0_f64, |m, x| m.max(x.abs()));
    let straight = |j: usize| match (steps.step.get(j), steps.step.get(j + 1)) {
        (Some(one), Some(next)) => {
            *one != 0.0 && (next - one).abs() <= ROUNDING * (size + one.abs()).min(1e3 * one.abs())
        }
        _ => false,
    };
    let mut runs = Vec::new();
    let mut j = 0;
    while j < steps.step.len() {
        let end = (j..steps.step.len()).find(|&k| !straight(k)).unwrap_or(j);
        if end - j >= LEAST_STRAIGHT && bends(&steps, own, j, end) {
            runs.extend(
                steps
                    .index
                    .get(j)
                    .copied()
                    .zip(steps.index.get(end + 1).copied()),
            );
        }
        j = end + 1;
    }
    let moving = steps.step.iter().filter(|step| **step != 0.0).count();
    let all: usize = runs.iter().map(|(first, end)| end - first).sum();
    let counts = own
        .stated_quantum
        .filter(|quantum| are_on(&own.samples, *quantum));
    match counts {
        Some(quantum) => runs.retain(|run| is_between_counts(own, *run, quantum)),
        None if all as f64 > MOST_STRAIGHT * moving as f64 => runs.clear(),
        // Steps of a few counts may be equal by chance.
        None => runs.retain(|(first, _)| {
            let pair = own.samples.get(*first).zip(own.samples.get(first + 1));
            pair.is_some_and(|(a, b)| (b - a).abs() > 1e3 * smallest_step(&own.samples))
        }),
    }
    runs
}

/// Whether most samples are multiples of a resolution.
fn are_on(samples: &[f64], quantum: f64) -> bool {
    let origin = samples.first().copied().unwrap_or(0.0);
    let on = |x: &&f64| {
        let counts = (**x - origin) / quantum;
        (counts - counts.round()).abs() < 0.05
    };
    2 * samples.iter().filter(on).count() > samples.len()
}

/// Whether the motion before or after some steps has another slope. A line that continues the
/// motion does no harm.
fn bends(steps: &Steps, own: &Position, j: usize, end: usize) -> bool {
    let own_step = steps.step.get(j).copied().unwrap_or(0.0);
    let least = own.stated_quantum.unwrap_or(0.0) + 2.0 * own.noise + 0.01 * own_step.abs();
    steps
        .beside(j, end + 1)
        .into_iter()
        .any(|step| (step - own_step).abs() > least)
}

/// Whether most samples of a stretch lie between the counts of its ends.
fn is_between_counts(own: &Position, (first, end): (usize, usize), quantum: f64) -> bool {
    let origin = own.samples.get(first).copied().unwrap_or(0.0);
    let off = |x: &&f64| {
        let counts = (**x - origin) / quantum;
        (counts - counts.round()).abs() > 0.02
    };
    let within = own.samples.get(first + 1..end).unwrap_or_default();
    2 * within.iter().filter(off).count() > within.len()
}
