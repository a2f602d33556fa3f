//! This file is stage 0: it resamples a recording to regular samples, finds its faults and measures
//! its noise.

mod clock;
mod reversals;
mod units;

use crate::filter::rms;
use crate::filter::{LowPass, ends, gradient};
use crate::rules::{
    AT_LIMIT, BAND_SHARE, JUMP_AROUND, JUMP_SHARE, JUMP_TIMES, LEAST_CUTOFF_HZ, LEVEL_SAMPLES,
    LONGEST_FREEZE_S, LONGEST_GAP_S, LOUD_SPEED, MOST_CLIPPED, MOST_CLIPPED_SHARE, MOST_MISSING,
    QUIET_SPEED, REST_S, SENSE_SIGMAS, STEPPED,
};
use rigproof_model::effects::Instant;
use rustfft::{FftPlannerScalar, num_complex::Complex64};

pub(crate) use clock::{check_clock, median_step};
pub(crate) use reversals::forget_sense_near_reversals;
pub(crate) use units::{Stated, check_units};

/// Why no conclusion can be drawn from a recording.
#[derive(Clone, Debug, PartialEq)]
pub struct Fault {
    /// The role of the channel.
    pub channel: &'static str,
    /// Start, s.
    pub from_s: f64,
    /// End, s.
    pub to_s: f64,
    /// The reason, in words.
    pub reason: String,
}

pub(crate) fn check_missing(
    channel: &'static str,
    time_s: &[f64],
    values: &[f64],
) -> Result<(), Fault> {
    let missing = values.iter().filter(|x| x.is_nan()).count();
    let mut since: Option<f64> = None;
    for (&t, x) in time_s.iter().zip(values) {
        match (x.is_nan(), since) {
            (true, None) => since = Some(t),
            (false, Some(start)) if t - start > LONGEST_GAP_S => {
                return Err(Fault {
                    channel,
                    from_s: start,
                    to_s: t,
                    reason: format!("no value for {:.3} s; cut the recording there", t - start),
                });
            }
            (false, _) => since = None,
            _ => {}
        }
    }
    if missing as f64 > MOST_MISSING * values.len() as f64 {
        return Err(Fault {
            channel,
            from_s: time_s.first().copied().unwrap_or(0.0),
            to_s: time_s.last().copied().unwrap_or(0.0),
            reason: format!("{missing} of {} values are missing", values.len()),
        });
    }
    Ok(())
}

/// A position that repeats one value exactly and then jumps: the plant moved while the channel
/// stood still.
pub(crate) fn check_frozen(time_s: &[f64], position: &[f64], step_s: f64) -> Result<(), Fault> {
    for (first, end) in constant_runs(position, longest_freeze(step_s)) {
        if moved_behind(position, first, end) {
            return Err(frozen("position", time_s, first, end));
        }
    }
    Ok(())
}

/// The number of samples for which a live channel may repeat one value exactly.
pub(crate) fn longest_freeze(step_s: f64) -> usize {
    (LONGEST_FREEZE_S / step_s).ceil() as usize
}

fn frozen(channel: &'static str, time_s: &[f64], first: usize, end: usize) -> Fault {
    let at = |k: usize| time_s.get(k).copied().unwrap_or(0.0);
    Fault {
        channel,
        from_s: at(first),
        to_s: at(end.saturating_sub(1)),
        reason: "the same value to the bit while the plant moves; check the cable".to_owned(),
    }
}

/// Runs of at least `least` samples of one value.
fn constant_runs(values: &[f64], least: usize) -> Vec<(usize, usize)> {
    let mut runs = Vec::new();
    let mut first = 0;
    for k in 1..=values.len() {
        if k == values.len() || values.get(k) != values.get(first) {
            if k - first >= least.max(3) {
                runs.push((first, k));
            }
            first = k;
        }
    }
    runs
}

/// A metered effort, and the positions of what it moves.
pub(crate) struct Metered<'a> {
    /// Its role.
    pub channel: &'static str,
    /// Its samples.
    pub samples: &'a [f64],
    /// The positions, sample for sample.
    pub positions: &'a [&'a [f64]],
    /// The number of samples for which it may repeat one value exactly.
    pub least: usize,
}

/// Checks that a metered effort does not stay constant while the plant moves: the channel would be
/// dead.
pub(crate) fn check_metered(
    effort: &Metered<'_>,
    time_s: &[f64],
    step_s: f64,
) -> Result<(), Fault> {
    let least_moves = longest_freeze(step_s) / 2;
    let moves = |(first, end): (usize, usize)| {
        let stretch = |position: &&[f64]| position.get(first..end).unwrap_or_default().to_vec();
        let stretches = effort.positions.iter().map(stretch);
        let steps = |own: Vec<f64>| own.windows(2).filter(|w| w.first() != w.last()).count();
        stretches.map(steps).max().unwrap_or(0) > least_moves
    };
    let mut runs = constant_runs(effort.samples, effort.least).into_iter();
    match runs.find(|run| moves(*run)) {
        Some((first, end)) => Err(frozen(effort.channel, time_s, first, end)),
        None => Ok(()),
    }
}

/// Whether a constant position must be a fault: it ends in a jump that the motion before and after
/// does not explain.
fn moved_behind(position: &[f64], first: usize, end: usize) -> bool {
    let steps = |from: usize, to: usize| {
        position
            .get(from..to)
            .unwrap_or_default()
            .windows(2)
            .map(|w| (w.last().unwrap_or(&0.0) - w.first().unwrap_or(&0.0)).abs())
            .fold(0.0, f64::max)
    };
    let n = position.len();
    if end + 1 >= n {
        return false;
    }
    let jump = steps(end - 1, end + 1);
    let usual =
        steps(first.saturating_sub(JUMP_AROUND), first).max(steps(end, (end + JUMP_AROUND).min(n)));
    jump > JUMP_TIMES * usual.max(2.0 * smallest_step(position))
}

/// An effort that stays at its own extreme for many samples, unless the rig states that limit.
pub(crate) fn check_clipped(
    time_s: &[f64],
    effort: &[f64],
    effort_limit: Option<f64>,
) -> Result<(), Fault> {
    let live = || effort.iter().copied().filter(|x| !x.is_nan());
    let [low, high] = ends(live());
    for extreme in [high, low] {
        let stated = effort_limit.is_some_and(|limit| extreme.abs() >= AT_LIMIT * limit);
        let count = live().filter(|&x| x == extreme).count();
        if !stated
            && count > MOST_CLIPPED
            && !is_stepped(effort, extreme, high - low)
            && count as f64 > MOST_CLIPPED_SHARE * effort.len() as f64
            && high > low
        {
            let from = effort.iter().position(|&x| x == extreme).unwrap_or(0);
            return Err(Fault {
                channel: "effort",
                from_s: time_s.get(from).copied().unwrap_or(0.0),
                to_s: time_s.last().copied().unwrap_or(0.0),
                reason: format!(
                    "{count} samples at exactly {extreme} (SI): the channel is clipped; if the drive itself saturates there, state it as `limit` in the rig"
                ),
            });
        }
    }
    Ok(())
}

/// Whether an effort reaches its extreme by jumps, or stays on other levels as well: it was then
/// commanded in steps.
fn is_stepped(effort: &[f64], extreme: f64, range: f64) -> bool {
    let pairs = || {
        effort
            .windows(2)
            .filter_map(|pair| Some((*pair.first()?, *pair.last()?)))
    };
    let entered = || pairs().filter(|(before, now)| *now == extreme && *before != extreme);
    let jumps = entered().filter(|(before, _)| (before - extreme).abs() > JUMP_SHARE * range);
    if jumps.count() as f64 >= STEPPED * entered().count().max(1) as f64 {
        return true;
    }
    let dwells: Vec<(usize, usize)> = constant_runs(effort, LEVEL_SAMPLES)
        .into_iter()
        .filter(|(first, _)| effort.get(*first).is_some_and(|x| x.abs() != extreme.abs()))
        .collect();
    let mut levels: Vec<f64> = dwells
        .iter()
        .filter_map(|(first, _)| effort.get(*first))
        .copied()
        .collect();
    levels.sort_by(f64::total_cmp);
    levels.dedup();
    let dwelling: usize = dwells.iter().map(|(first, end)| end - first).sum();
    let others = effort.iter().filter(|x| x.abs() != extreme.abs()).count();
    levels.len() > 1 && 2 * dwelling > others
}

pub(crate) fn regular_count(time_s: &[f64], step_s: f64) -> usize {
    match (time_s.first(), time_s.last()) {
        (Some(first), Some(last)) => ((last - first) / step_s).round() as usize + 1,
        _ => 0,
    }
}

/// Values on regular samples: the recorded one where a stamp lies within a tenth of a step,
/// otherwise interpolated.
///
/// The second vector marks the recorded values.
pub(crate) fn resample(
    time_s: &[f64],
    values: &[f64],
    step_s: f64,
    count: usize,
) -> (Vec<f64>, Vec<bool>) {
    let start = time_s.first().copied().unwrap_or(0.0);
    let known: Vec<(f64, f64)> = time_s
        .iter()
        .copied()
        .zip(values.iter().copied())
        .filter(|(_, x)| !x.is_nan())
        .collect();
    let mut next = 0;
    let mut out = Vec::with_capacity(count);
    let mut recorded = Vec::with_capacity(count);
    for k in 0..count {
        let t = start + k as f64 * step_s;
        while known
            .get(next + 1)
            .is_some_and(|(after, _)| *after <= t + 0.1 * step_s)
        {
            next += 1;
        }
        let (t0, x0) = known.get(next).copied().unwrap_or((t, 0.0));
        let (t1, x1) = known.get(next + 1).copied().unwrap_or((t0, x0));
        let near = (t - t0).abs() <= 0.1 * step_s;
        let share = if t1 > t0 {
            ((t - t0) / (t1 - t0)).clamp(0.0, 1.0)
        } else {
            0.0
        };
        out.push(if near { x0 } else { x0 + share * (x1 - x0) });
        recorded.push(near || t1 - t0 < 2.5 * step_s);
    }
    (out, recorded)
}

/// The smallest difference between two distinct values: the resolution of a quantised channel.
pub(crate) fn smallest_step(values: &[f64]) -> f64 {
    let mut sorted: Vec<f64> = values.iter().copied().filter(|x| x.is_finite()).collect();
    sorted.sort_by(f64::total_cmp);
    let span = sorted.last().unwrap_or(&0.0) - sorted.first().unwrap_or(&0.0);
    sorted
        .windows(2)
        .map(|w| w.last().unwrap_or(&0.0) - w.first().unwrap_or(&0.0))
        .filter(|d| *d > 1e-9 * span)
        .fold(span, f64::min)
}

/// The frequency below which 95 % of an effort's varying power lies, Hz.
pub fn band_hz(effort: &[f64], step_s: f64) -> f64 {
    let mean = effort.iter().sum::<f64>() / effort.len().max(1) as f64;
    let mut spectrum: Vec<Complex64> = effort
        .iter()
        .map(|x| Complex64::new(x - mean, 0.0))
        .collect();
    FftPlannerScalar::new()
        .plan_fft_forward(spectrum.len())
        .process(&mut spectrum);
    let power: Vec<f64> = spectrum
        .iter()
        .take(effort.len() / 2)
        .map(|c| c.norm_sqr())
        .collect();
    let total: f64 = power.iter().sum();
    let mut sum = 0.0;
    let index = power
        .iter()
        .position(|p| {
            sum += p;
            sum >= BAND_SHARE * total
        })
        .unwrap_or(1);
    (index.max(1)) as f64 / (step_s * effort.len() as f64)
}

/// Cut-off of the motion's low-pass, Hz: twice the effort's band.
pub(crate) fn cutoff_hz(step_s: f64, band_hz: f64) -> f64 {
    let rate_hz = 1.0 / step_s;
    (2.0 * band_hz).clamp(LEAST_CUTOFF_HZ.min(0.25 * rate_hz), 0.35 * rate_hz)
}

/// The cut-off, lowered where the position's noise would be a noticeable speed. An effort that is
/// fed back from the position is as fast as its noise.
pub(crate) fn quiet_cutoff_hz(position: &[f64], step_s: f64, cutoff_hz: f64, noise: f64) -> f64 {
    let rate_hz = 1.0 / step_s;
    let least_hz = LEAST_CUTOFF_HZ.min(0.25 * rate_hz);
    let smooth = LowPass::butterworth(4, 2.0 * least_hz / rate_hz).zero_phase(position);
    let slow = rms(&gradient(&smooth, step_s));
    let at_one_hz = noise * core::f64::consts::TAU * (2.0 / rate_hz / 3.0).sqrt();
    let all = LowPass::butterworth(4, 2.0 * cutoff_hz / rate_hz).zero_phase(position);
    let (fast, loud) = (
        rms(&gradient(&all, step_s)),
        at_one_hz * libm::pow(cutoff_hz, 1.5),
    );
    let speed = (fast * fast - loud * loud).max(slow * slow).sqrt();
    if loud <= LOUD_SPEED * speed {
        return cutoff_hz;
    }
    let most = QUIET_SPEED * slow;
    let quiet_hz = libm::pow(most / at_one_hz.max(1e-300), 2.0 / 3.0);
    cutoff_hz.min(quiet_hz.max(least_hz))
}

/// Position and speed after a zero-phase low-pass, and the speed below which noise decides the
/// direction.
pub(crate) fn smoothed_motion(
    position: &[f64],
    step_s: f64,
    cutoff_hz: f64,
    noise: f64,
) -> (Vec<Instant>, f64) {
    let rate_hz = 1.0 / step_s;
    let smooth = LowPass::butterworth(4, 2.0 * cutoff_hz / rate_hz).zero_phase(position);
    let speed = gradient(&smooth, step_s);
    // White noise through the filter and the difference: ∫(2πf)² up to the cut-off.
    let noise_speed =
        noise * core::f64::consts::TAU * cutoff_hz * (2.0 * cutoff_hz / rate_hz / 3.0).sqrt();
    let floor = (SENSE_SIGMAS * noise_speed).max(1e-4 * rms(&speed));
    let motion = smooth
        .iter()
        .zip(&speed)
        .enumerate()
        .map(|(k, (&position, &speed))| Instant {
            time_s: k as f64 * step_s,
            position,
            speed,
            sense: (speed / floor).clamp(-1.0, 1.0),
        })
        .collect();
    (motion, floor)
}

/// Marks the direction as unknown wherever the recorded position stays within `still` for a while,
/// since the smoothed position rings there.
pub(crate) fn forget_sense_at_rest(
    motion: &mut [Instant],
    position: &[f64],
    step_s: f64,
    still: f64,
) {
    let reach = (REST_S / step_s).round().max(1.0) as usize;
    for (k, now) in motion.iter_mut().enumerate() {
        let around = position
            .get(k.saturating_sub(reach)..(k + reach + 1).min(position.len()))
            .unwrap_or_default();
        if moves_through(around, still) {
            continue;
        }
        let [low, high] = ends(around.iter().copied());
        if high - low <= still {
            now.sense = 0.0;
        }
    }
}

/// Whether the two ends of a stretch are already further apart than a joint at rest moves. Most
/// stretches need no closer look.
fn moves_through(around: &[f64], still: f64) -> bool {
    match (around.first(), around.last()) {
        (Some(first), Some(last)) => (last - first).abs() > still,
        _ => false,
    }
}

/// Marks the direction as unknown on both sides of a reversal between two samples. Dry friction
/// jumps at an instant that the samples do not show, and on an axis the acceleration jumps with it.
pub(crate) fn forget_sense_at_reversals(motion: &mut [Instant]) {
    let senses: Vec<f64> = motion.iter().map(|now| now.sense).collect();
    for (k, pair) in senses.windows(2).enumerate() {
        if let [before, after] = pair
            && before * after < 0.0
        {
            motion
                .iter_mut()
                .skip(k)
                .take(2)
                .for_each(|now| now.sense = 0.0);
        }
    }
}
