//! This file treats jumps of a position: counters are unwrapped, dropouts are left out, every other
//! jump is a fault.

use super::steps::Steps;
use super::{Position, Remark, Stamps, few};
use crate::align::Fault;
use crate::diagnose::words::rounded;
use crate::filter::ends;
use crate::rules::{LONGEST_DROPOUT, WRAP_NEAR, WRAP_RANGE};
use core::f64::consts::TAU;

/// Powers of two at which counters wrap.
const BITS: core::ops::RangeInclusive<i32> = 8..=32;

/// Removes the jumps of a counter that restarts at the end of its range.
pub fn unwrap(stamps: Stamps<'_>, own: &mut Position) -> Option<Remark> {
    let steps = Steps::of(stamps, own);
    let range = range(&own.samples);
    let (mut offset, mut shifts, mut size) = (0.0, Vec::new(), 0.0);
    let jumps = steps.excesses(own).into_iter().enumerate();
    let jumps = jumps.filter(|(_, (excess, limit))| excess.abs() > *limit);
    let large: Vec<(usize, f64, f64)> = jumps
        .filter_map(|(j, (excess, limit))| {
            // The step that neighbours suggest applies to one interval.
            let by = excess * steps.places.get(j)?;
            (by.abs() * WRAP_RANGE >= range).then_some((j, by, limit))
        })
        .collect();
    for (j, by, limit) in &large {
        let period = period(own, *by, *limit).or_else(|| agreed(&large, *by, *limit));
        if let Some(period) = period {
            offset -= period.copysign(*by);
            size = period;
            shifts.push((*steps.index.get(j + 1)?, offset));
        }
    }
    let (first, last) = (shifts.first()?.0, shifts.last()?.0);
    let mut next = shifts.iter().peekable();
    let mut shift = 0.0;
    for (k, sample) in own.samples.iter_mut().enumerate() {
        if let Some((_, offset)) = next.next_if(|(at, _)| *at == k) {
            shift = *offset;
        }
        *sample += shift;
    }
    let (channel, unit) = (own.channel, if own.is_angle { "rad" } else { "m" });
    let (from_s, to_s, count) = (stamps.at(first), stamps.at(last), shifts.len());
    Some(Remark {
        channel,
        what: "wrapped",
        from_s,
        to_s,
        count,
        words: format!(
            "{channel} wraps {count} time(s) at a period of {size:.6} {unit}, first at {from_s:.3} s: it is unwrapped"
        ),
        cause: None,
    })
}

/// The period of a counter that a jump fits: a turn, or a power of two in counts.
fn period(own: &Position, by: f64, limit: f64) -> Option<f64> {
    let turn = own.is_angle.then_some(TAU);
    let counts = BITS.map(|bits| libm::ldexp(own.stated_quantum.unwrap_or(own.quantum), bits));
    let near = |period: &f64| (by.abs() - period).abs() <= limit.max(WRAP_NEAR * period);
    turn.into_iter().chain(counts).find(near)
}

/// The mean size of the jumps, if there are several of equal size.
fn agreed(large: &[(usize, f64, f64)], by: f64, limit: f64) -> Option<f64> {
    let alike = |(_, other, own): &(usize, f64, f64)| {
        (other.abs() - by.abs()).abs() <= own.max(limit).max(WRAP_NEAR * by.abs())
    };
    let mean = large.iter().map(|(_, by, _)| by.abs()).sum::<f64>() / large.len().max(1) as f64;
    // A dropout jumps there and back.
    let steps = large
        .windows(2)
        .filter_map(|pair| Some(pair.last()?.0 - pair.first()?.0));
    if steps.min().is_some_and(|least| least <= LONGEST_DROPOUT) {
        return None;
    }
    (large.len() > 1 && large.iter().all(alike)).then_some(mean)
}

fn range(samples: &[f64]) -> f64 {
    let [low, high] = ends(samples.iter().copied());
    high - low
}

/// Leaves out a few samples that lie far off, if the motion before continues after them.
pub fn leave_out_dropouts(stamps: Stamps<'_>, own: &mut Position) -> Result<Option<Remark>, Fault> {
    let steps = Steps::of(stamps, own);
    let excesses = steps.excesses(own);
    let sample = |j: usize| own.samples.get(*steps.index.get(j)?).copied();
    let mut bad = Vec::new();
    let mut j = 0;
    while let Some((excess, limit)) = excesses.get(j) {
        let returns = |count: &usize| {
            let back = sample(j + count + 1).zip(sample(j));
            let places = (j..=j + count)
                .filter_map(|k| steps.places.get(k))
                .sum::<f64>();
            // After the dropout the position has moved on with the speed before and after.
            let [before, after] = steps.beside(j, j + count + 1);
            let way = places * 0.5 * (before + after);
            let off = back.map(|(after, before)| after - before - way);
            off.is_some_and(|off| off.abs() <= 0.5 * limit.min(excess.abs()))
        };
        let count = (1..=LONGEST_DROPOUT).find(|count| excess.abs() > *limit && returns(count));
        for k in 1..=count.unwrap_or(0) {
            bad.extend(steps.index.get(j + k));
        }
        j += count.map_or(1, |count| count + 1);
    }
    let found = format!(
        "{} sample(s) far off their neighbours on both sides",
        bad.len()
    );
    let mended = few(
        stamps,
        (own.channel, "dropouts"),
        &bad,
        own.samples.len(),
        (
            found,
            "the cable or the reading of the sensor drops out; mend it, or leave these cells empty",
        ),
    )?;
    for k in bad {
        if let Some(slot) = own.samples.get_mut(k) {
            *slot = f64::NAN;
        }
    }
    Ok(mended)
}

/// Tells the one jump that may be a slip of the sensor on its shaft.
///
/// # Errors
/// Any other jump that nothing explains, or a clock that was set while the position continued.
pub fn check(stamps: Stamps<'_>, own: &Position) -> Result<Option<Remark>, Fault> {
    let steps = Steps::of(stamps, own);
    let excesses = steps.excesses(own);
    check_clock(stamps, own, &steps)?;
    let mut jumps = excesses.iter().enumerate().filter(|(j, (excess, limit))| {
        excess.abs() > *limit && steps.places.get(*j).is_some_and(|places| *places < 2.0)
    });
    let Some((j, (by, _))) = jumps.next() else {
        return Ok(None);
    };
    let others = jumps.count();
    let at = |j: usize| stamps.at(steps.index.get(j).copied().unwrap_or(0));
    let (channel, from_s, to_s) = (own.channel, at(j), at(j + 1));
    let unit = if own.is_angle { "rad" } else { "m" };
    let counts = match own.stated_quantum {
        Some(quantum) => format!(" ({:.0} counts)", by / quantum),
        None => String::new(),
    };
    let usual = steps.expected(j).0;
    let jump = format!(
        "it jumps by {} {unit}{counts} within one sample, where its steps around are {} {unit}",
        rounded(*by),
        rounded(usual)
    );
    if others == 0 && by.abs() <= own.slip {
        return Ok(Some(Remark {
            channel,
            what: "jumped",
            from_s,
            to_s,
            count: 1,
            words: format!(
                "{channel}, {from_s:.3} s: {jump}: counts were lost, or the sensor slipped on its shaft; the recording is used whole, and an error of the sensor from then on is weighed"
            ),
            cause: None,
        }));
    }
    let more = match others {
        0 => String::new(),
        more => format!(", and {more} more such jump(s) follow"),
    };
    Err(Fault {
        channel,
        from_s,
        to_s,
        reason: format!(
            "{jump}{more}: counts were lost, or it was set to another zero; cut the recording there (`--to-s {from_s:.3}`, or `--from-s {to_s:.3}`)"
        ),
    })
}

/// A gap in the time stamps across which the position moves by a single step is no gap: the clock
/// was set.
fn check_clock(stamps: Stamps<'_>, own: &Position, steps: &Steps) -> Result<(), Fault> {
    for (j, places) in steps.places.iter().enumerate() {
        let [before, after] = steps.beside(j, j + 1);
        let usual = 0.5 * (before + after);
        let missing = (places - 1.0) * usual;
        let floor = 4.0 * (own.quantum + own.noise) + (before - after).abs();
        // Samples that are left out make gaps too, but with even stamps.
        let neighbours = steps.index.get(j).zip(steps.index.get(j + 1));
        let Some((k, next)) = neighbours.filter(|(k, next)| **next == **k + 1) else {
            continue;
        };
        let moved = steps.step.get(j).unwrap_or(&0.0) * places;
        if *places >= 3.0
            && missing.abs() > 4.0 * floor
            && (moved - usual).abs() <= 0.25 * missing.abs()
        {
            let (from_s, to_s) = (stamps.at(*k), stamps.at(*next));
            return Err(Fault {
                channel: "time",
                from_s,
                to_s,
                reason: format!(
                    "the clock steps forward by {:.4} s while `{}` moves on by one sample's way: no samples are missing, the clock was set; cut the recording there (`--to-s {from_s:.3}`, or `--from-s {to_s:.3}`)",
                    to_s - from_s - stamps.step_s,
                    own.channel
                ),
            });
        }
    }
    Ok(())
}
