//! This file checks the clock of a recording.

use super::{Fault, LONGEST_GAP_S};
use crate::rules::{EVEN, LONGEST_GAP_STEPS, LONGEST_STEP_S};
use core::cmp::Ordering;
use rigproof_trace::clock::{Grid, is_even_but_for_gaps};

/// The sample interval: the median step if it fits all stamps, otherwise the mean step of an even
/// grid through them. Rounding of the stamps then does not accumulate.
pub(crate) fn median_step(time_s: &[f64]) -> f64 {
    let mut steps: Vec<f64> = time_s
        .windows(2)
        .map(|w| w.iter().rev().copied().reduce(|b, a| b - a).unwrap_or(0.0))
        .collect();
    steps.sort_by(f64::total_cmp);
    let median_s = steps.get(steps.len() / 2).copied().unwrap_or(1.0);
    let start_s = time_s.first().copied().unwrap_or(0.0);
    let mut stamps = time_s.iter().enumerate();
    let off = |k: usize, t: f64| (t - start_s - k as f64 * median_s).abs();
    if stamps.all(|(k, t)| off(k, *t) < EVEN * median_s) {
        return median_s;
    }
    match is_even_but_for_gaps(time_s) {
        true => median_s,
        false => Grid::of(time_s).map_or(median_s, |grid| grid.step_s),
    }
}

pub(crate) fn check_clock(time_s: &[f64], step_s: f64) -> Result<(), Fault> {
    check_pace(time_s, step_s)?;
    let longest = LONGEST_GAP_S.max(LONGEST_GAP_STEPS * step_s);
    for pair in time_s.windows(2) {
        if let [before, after] = pair
            && after.partial_cmp(before) != Some(Ordering::Greater)
        {
            return Err(Fault {
                channel: "time",
                from_s: *before,
                to_s: *after,
                reason: "the clock stands or runs backward; cut the recording there".to_owned(),
            });
        }
        if let [before, after] = pair
            && after - before > longest
        {
            return Err(Fault {
                channel: "time",
                from_s: *before,
                to_s: *after,
                reason: format!(
                    "{:.3} s without a sample, where {:.4} s is the usual step; cut the recording there",
                    after - before,
                    step_s
                ),
            });
        }
    }
    Ok(())
}

/// A clock so slow that it probably counts in another unit.
fn check_pace(time_s: &[f64], step_s: f64) -> Result<(), Fault> {
    if step_s <= LONGEST_STEP_S {
        return Ok(());
    }
    Err(Fault {
        channel: "time",
        from_s: time_s.first().copied().unwrap_or(0.0),
        to_s: time_s.last().copied().unwrap_or(0.0),
        reason: format!(
            "the samples are {step_s:.4} s apart, at most {LONGEST_STEP_S} s can be diagnosed: if the time stamps are milliseconds, say so in the description (`time = {{ channel = \"…\", unit = \"ms\" }}`)"
        ),
    })
}
