//! This file is the bench: a brake or damper turned at imposed motion, its resistance metered.

use crate::effects::{Instant, Law};

/// The resistance of `laws` along an imposed motion, one value a sample.
///
/// Each law's memory is advanced from sample to sample with the motion's own increments, exactly for a speed that
/// holds between them.
pub fn resistance(laws: &[Box<dyn Law>], motion: &[Instant], step_s: f64) -> Vec<f64> {
    let mut total = vec![0.0; motion.len()];
    for law in laws {
        for (sum, value) in total.iter_mut().zip(column(law.as_ref(), motion, step_s)) {
            *sum += value;
        }
    }
    total
}

/// The resistance of one law along an imposed motion.
///
/// A memory that a change of sense begins anew stands still where the sense cannot be told: a smoothed angle rings at rest.
pub fn column(law: &dyn Law, motion: &[Instant], step_s: f64) -> Vec<f64> {
    let first = motion.first().into_iter();
    let travel = first.chain(motion).zip(motion).map(|(before, now)| {
        let told = now.sense.abs() >= 1.0 || !law.begins_anew();
        told.then_some(now.position - before.position)
    });
    remembered(law, motion, travel, step_s)
}

/// The resistance of one law along an imposed motion whose every travel is known better than its speed: the memory goes by it.
pub fn column_by_travel(
    law: &dyn Law,
    motion: &[Instant],
    travel: &[f64],
    step_s: f64,
) -> Vec<f64> {
    remembered(law, motion, travel.iter().copied().map(Some), step_s)
}

/// The resistance of one law along a motion; its memory stands still where there is no travel.
fn remembered(
    law: &dyn Law,
    motion: &[Instant],
    travel: impl Iterator<Item = Option<f64>>,
    step_s: f64,
) -> Vec<f64> {
    let mut memory = law.starts_with();
    let pairs = motion.iter().zip(travel);
    pairs
        .map(|(now, travel)| {
            if let Some(travel) = travel.filter(|_| law.remembers()) {
                memory = law.memory_after(memory, travel, travel / step_s);
            }
            law.smooth(now, memory) + law.dry(now) * now.sense
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::{LIBRARY, law};
    use rigproof_spec::effect::Mechanism;

    #[test]
    fn a_law_remembers_exactly_if_its_memory_moves() {
        let now = Instant {
            time_s: 0.7,
            position: 0.031,
            speed: -0.13,
            sense: -1.0,
        };
        for entry in LIBRARY {
            if let Some(law) = law(entry.mechanism, &[1.3, 0.017, 2.9]) {
                let moves = law.memory_rate(&now, 0.41) != 0.0;
                assert_eq!(law.remembers(), moves, "{:?}", entry.mechanism);
            }
        }
    }

    #[test]
    fn ringing_at_rest_is_no_reversal_and_half_a_sense_no_half_memory() {
        let law = law(Mechanism::ReversalOvershoot, &[0.37, 0.083]).unwrap();
        // Back and then onwards at 0.13 rad/s; a rest in which the smoothed angle rings; on, the sense half told.
        let mut motion = Vec::new();
        let mut position = 0.0;
        for k in 0..900 {
            let (speed, sense) = match k {
                0..200 => (-0.13, -1.0),
                200..500 => (0.13, 1.0),
                500..700 => (0.011 * libm::cos(0.31 * f64::from(k)), 0.0),
                700..800 => (0.13, 1.0),
                _ => (0.001, 0.5),
            };
            position += 1e-3 * speed;
            motion.push(Instant {
                time_s: 1e-3 * f64::from(k),
                position,
                speed,
                sense,
            });
        }
        let share = column(law.as_ref(), &motion, 1e-3);
        let after = |travel: f64| 0.37 * libm::exp(-travel / 0.083);
        // The first motion is no reversal.
        assert!(share[..200].iter().all(|share| share.abs() < 1e-12));
        assert!((share[499] - after(300.0 * 1.3e-4)).abs() < 1e-9);
        assert!((share[799] - after(400.0 * 1.3e-4)).abs() < 1e-9);
        assert!((share[850] - 0.5 * after(400.0 * 1.3e-4)).abs() < 1e-9);
    }

    #[test]
    fn a_bristle_saturates_exponentially_with_travel() {
        let law = law(Mechanism::Presliding, &[2.3, 0.004]).unwrap();
        let motion: Vec<Instant> = (0..200)
            .map(|k| Instant {
                time_s: k as f64 * 1e-3,
                position: 0.07 * k as f64 * 1e-3,
                speed: 0.07,
                sense: 1.0,
            })
            .collect();
        let force = column(law.as_ref(), &motion, 1e-3);
        let travelled = motion[150].position;
        let expected = 2.3 * (1.0 - libm::exp(-travelled / 0.004));
        assert!(
            (force[150] - expected).abs() < 1e-9,
            "{} {expected}",
            force[150]
        );
    }
}
