//! This file holds the stated resolution and noise of a channel against its samples.

use super::ChannelMap;

/// Fewer samples tell nothing.
const LEAST_SAMPLES: usize = 200;
/// So many more values than steps of the stated resolution fit into their range cannot be.
const MORE_VALUES: f64 = 20.0;
/// Of so many samples the values are told apart: a long recording is not sorted, and not copied.
const MOST_VALUES: usize = 1 << 20;
/// How far the stated noise may exceed what third differences of the samples scatter: filtered noise hardly shows in them.
const ABOVE_THIRD: f64 = 300.0;
/// The same for first differences.
const ABOVE_FIRST: f64 = 20.0;

/// What cannot be true of the resolution or the noise that a map states, with what the samples show, all in the unit of the map.
pub(super) fn contradiction(map: &ChannelMap, samples: &[f64]) -> Option<String> {
    let seen = || samples.iter().copied().filter(|x| x.is_finite());
    if seen().count() < LEAST_SAMPLES {
        return None;
    }
    let (name, unit) = (&map.channel, &map.unit);
    let noise = map.noise.and_then(|noise| {
        let scatter = scatter(samples)?;
        (noise > scatter).then(|| {
            format!(
                "the rig states a noise of {noise} {unit} for `{name}`, but its samples follow each other far more closely than such noise lets them (at most about {:.2e} {unit}); see whether another channel stands in its place, or correct `noise`, the standard deviation of one sample in {unit}, or leave it out",
                scatter / ABOVE_FIRST
            )
        })
    });
    noise.or_else(|| {
        let quantum = map.quantum?;
        let mut values: Vec<f64> = seen().take(MOST_VALUES).collect();
        values.sort_unstable_by(f64::total_cmp);
        let range = values.last()? - values.first()?;
        let bits = 1e-12 * values.last()?.abs().max(values.first()?.abs());
        values.dedup_by(|b, a| *b - *a <= bits);
        let fit = range / quantum + 1.0;
        let beyond = values.len() > 2 && values.len() as f64 > MORE_VALUES * fit;
        beyond.then(|| {
            format!(
                "the rig states a quantum of {quantum} {unit} for `{name}`, but its samples take {} different values within {range:.4} {unit}, where {:.0} fit; correct `quantum`, the smallest step that the channel can show, in {unit}, or leave it out",
                values.len(),
                fit.floor()
            )
        })
    })
}

/// The greatest noise that the samples leave possible; nothing where they never differ.
fn scatter(samples: &[f64]) -> Option<f64> {
    let first = samples.windows(2).filter_map(|own| match own {
        [a, b] => Some(b - a),
        _ => None,
    });
    let third = samples.windows(4).filter_map(|own| match own {
        [a, b, c, d] => Some(((d - c) - (c - b)) - ((c - b) - (b - a))),
        _ => None,
    });
    // White noise makes first differences of twice its variance, third ones of twenty times.
    let (by_first, by_third) = (rms(first) / 2f64.sqrt(), rms(third) / 20f64.sqrt());
    let most = (ABOVE_FIRST * by_first).min(ABOVE_THIRD * by_third);
    (most > 0.0).then_some(most)
}

/// The root mean square of the values that are there.
fn rms(values: impl Iterator<Item = f64>) -> f64 {
    let seen = values.filter(|x| x.is_finite());
    let (count, sum) = seen.fold((0_usize, 0.0), |(count, sum), x| (count + 1, sum + x * x));
    (sum / count.max(1) as f64).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A swing of an encoder of 1 mrad, or of a sensor whose noise is about 0.02.
    fn samples(quantum: f64, noise: f64) -> Vec<f64> {
        let sample = |k: u32| {
            let t = 1e-3 * f64::from(k);
            let x = 0.7 * libm::sin(4.1 * t) + 1.7 * noise * libm::sin(f64::from(k * k % 7919));
            if quantum > 0.0 {
                (x / quantum).round() * quantum
            } else {
                x
            }
        };
        (0..4000).map(sample).collect()
    }

    fn map(quantum: Option<f64>, noise: Option<f64>) -> ChannelMap {
        ChannelMap {
            quantum,
            noise,
            ..ChannelMap::plain("theta", "rad")
        }
    }

    #[test]
    fn what_the_samples_bear_out_is_believed() {
        for (quantum, noise) in [
            (1e-3, 0.0),
            (0.0, 0.02),
            (1e-3, 0.02),
            (6.3e-5, 1e-5),
            (0.05, 0.0),
        ] {
            let samples = samples(quantum, noise);
            let stated = |x: f64| (x > 0.0).then_some(x);
            assert_eq!(
                contradiction(&map(stated(quantum), stated(noise)), &samples),
                None
            );
        }
        assert_eq!(contradiction(&map(Some(3.0), Some(9.0)), &[0.5; 900]), None);
    }

    #[test]
    fn what_is_beyond_reason_is_refused() {
        for (stated, of, word) in [
            (map(Some(3.0), None), samples(1e-3, 0.0), "`quantum`"),
            (map(Some(1e308), None), samples(1e-3, 0.0), "`quantum`"),
            (map(Some(0.2), None), samples(1e-3, 0.0), "`quantum`"),
            (map(None, Some(20.0)), samples(0.0, 0.02), "`noise`"),
            (map(None, Some(1e-2)), samples(0.0, 1e-5), "`noise`"),
            (map(Some(1e-3), Some(0.3)), samples(1e-3, 0.0), "`noise`"),
        ] {
            let said = contradiction(&stated, &of).unwrap();
            assert!(said.contains(word) && said.contains("`theta`"), "{said}");
        }
    }
}
