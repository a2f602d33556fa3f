//! This file decides what jitter of the time stamps means: even samples with uneven stamps, or
//! samples that are uneven themselves.

use super::steps::median;
use super::{Position, Remark, Stamps};
use crate::effect::Effect;
use crate::filter::rms;
use crate::rules::{EVEN, RELEVANT_NOISE};
use rigproof_spec::effect::Mechanism;
use rigproof_trace::clock::Grid;

/// Samples moved to a regular grid.
#[derive(Clone, Debug)]
pub struct Settled {
    /// The grid times of the samples, s.
    pub time_s: Vec<f64>,
    /// The remark.
    pub said: Remark,
    /// The position noise that jitter adds, m or rad.
    pub noise: f64,
}

/// Moves positions to the grid of their stamps if these jitter.
///
/// There are two readings: the samples are even, or each was taken at its stamp. The reading with
/// the smoother motion is chosen.
pub fn settle(stamps: Stamps<'_>, positions: &mut [Position]) -> Option<Settled> {
    let grid = Grid::of(stamps.time_s)?;
    if grid.worst_s < EVEN * grid.step_s {
        return None;
    }
    let time_s: Vec<f64> = grid
        .places
        .iter()
        .map(|k| grid.start_s + k * grid.step_s)
        .collect();
    let late: Vec<f64> = stamps
        .time_s
        .iter()
        .zip(&time_s)
        .map(|(t, own)| t - own)
        .collect();
    let (mut even, mut uneven) = (0.0, 0.0);
    let moved: Vec<Vec<f64>> = positions
        .iter()
        .map(|own| moved_back(&own.samples, &grid, &late))
        .collect();
    for (own, moved) in positions.iter().zip(&moved) {
        let scale = own.quantum.max(own.noise).max(1e-300);
        even += roughness(&own.samples) / scale;
        uneven += roughness(moved) / scale;
    }
    let are_even = even <= uneven;
    let (mut noise, mut matters) = (0.0_f64, false);
    for (own, moved) in positions.iter_mut().zip(moved) {
        if !are_even {
            own.samples = moved;
        }
        let predicted = (own.quantum / 12f64.sqrt()).hypot(own.noise);
        let rough = roughness(&own.samples);
        let most = grid.jitter_s * rms(&speeds(&own.samples, &grid));
        matters |= most > RELEVANT_NOISE * predicted;
        let excess = (rough * rough - predicted * predicted).max(0.0).sqrt();
        noise = noise.max(excess.min(most));
    }
    let (from_s, to_s) = (stamps.at(0), stamps.at(late.len().saturating_sub(1)));
    let how = match are_even {
        true => "the samples themselves are even, so they are put on the grid",
        false => "each sample was taken when its stamp says, so positions are carried to the grid",
    };
    let jittering = late
        .iter()
        .filter(|late| late.abs() >= EVEN * grid.step_s)
        .count();
    Some(Settled {
        said: Remark {
            channel: "time",
            what: "jitter",
            from_s,
            to_s,
            count: jittering,
            words: format!(
                "time stamps jitter by {:.2e} s (root mean square, {:.2e} s at most) around a grid of {:.3} Hz: {how}; what is left of it, {noise:.1e} of a position, is in the predicted noise",
                grid.jitter_s,
                grid.worst_s,
                1.0 / grid.step_s
            ),
            cause: (are_even && matters)
                .then(|| Effect::of(Mechanism::ClockJitter, &[grid.jitter_s])),
        },
        time_s,
        noise,
    })
}

/// Speeds on the grid by central differences.
fn speeds(samples: &[f64], grid: &Grid) -> Vec<f64> {
    let at = |k: usize| samples.get(k).copied().unwrap_or(f64::NAN);
    let place = |k: usize| grid.places.get(k).copied().unwrap_or(0.0);
    let each = (0..samples.len()).map(|k| {
        let (before, after) = (k.saturating_sub(1), (k + 1).min(samples.len() - 1));
        let speed =
            (at(after) - at(before)) / ((place(after) - place(before)).max(1.0) * grid.step_s);
        if speed.is_nan() { 0.0 } else { speed }
    });
    each.collect()
}

/// Samples interpolated from their stamps to the grid.
fn moved_back(samples: &[f64], grid: &Grid, late: &[f64]) -> Vec<f64> {
    let speeds = speeds(samples, grid);
    let each = samples.iter().zip(speeds).zip(late);
    each.map(|((x, speed), late)| x - speed * late).collect()
}

/// The noise that would explain the median third difference of a resting position. A smooth motion
/// has a small third difference.
pub fn roughness(samples: &[f64]) -> f64 {
    let bends = samples.windows(4).filter_map(|w| match w {
        [a, b, c, d] => Some((d - 3.0 * c + 3.0 * b - a).abs()),
        _ => None,
    });
    let bends: Vec<f64> = bends.filter(|bend| bend.is_finite()).collect();
    median(bends) / (0.6745 * 20f64.sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A position that swings by `travel` once a second, with stamps that scatter by 0.1 ms.
    fn settled(travel: f64) -> Settled {
        let even = |k: usize| 1e-3 * k as f64;
        let scatter = |k: usize| 1.4e-4 * libm::sin(1.7 * (k * k) as f64);
        let time_s: Vec<f64> = (0..4000).map(|k| even(k) + scatter(k)).collect();
        let swing = |k: usize| travel * libm::sin(core::f64::consts::TAU * even(k));
        let quantum = 1e-4;
        let counted = |k: usize| (swing(k) / quantum).round() * quantum;
        let mut positions = [Position {
            channel: "position",
            samples: (0..4000).map(counted).collect(),
            stated_quantum: Some(quantum),
            quantum,
            noise: 0.0,
            is_angle: true,
            slip: 0.0,
        }];
        let stamps = Stamps {
            time_s: &time_s,
            step_s: 1e-3,
        };
        settle(stamps, &mut positions).unwrap()
    }

    #[test]
    fn stamps_that_scatter_are_a_cause_where_they_displace_more_than_the_sensor_errs() {
        let cause = settled(1.3).said.cause.unwrap();
        assert_eq!(cause.mechanism(), Mechanism::ClockJitter);
        assert!((cause.value(0) - 1e-4).abs() < 5e-6, "{cause:?}");
        assert_eq!(settled(0.02).said.cause, None);
    }
}
