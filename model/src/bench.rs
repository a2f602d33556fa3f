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
    let given = |now: &Instant, memory| law.smooth(now, memory) + law.dry(now) * now.sense;
    if !law.remembers() {
        return motion.iter().map(|now| given(now, 0.0)).collect();
    }
    let mut memory = 0.0;
    let mut before: Option<&Instant> = None;
    motion
        .iter()
        .map(|now| {
            let told = now.sense.abs() >= 1.0 || !law.begins_anew();
            if let Some(before) = before.filter(|_| told) {
                let travel = now.position - before.position;
                memory = law.memory_after(memory, travel, travel / step_s);
            }
            before = Some(now);
            given(now, memory)
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
        // Half a second onwards at 0.13 rad/s; the same with a rest in which the smoothed angle rings; on, the sense half told.
        let mut motion = Vec::new();
        let mut position = 0.0;
        for k in 0..700 {
            let (speed, sense) = match k {
                0..300 => (0.13, 1.0),
                300..500 => (0.011 * libm::cos(0.31 * f64::from(k)), 0.0),
                500..600 => (0.13, 1.0),
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
        assert!((share[299] - after(299.0 * 1.3e-4)).abs() < 1e-9);
        assert!((share[599] - after(399.0 * 1.3e-4)).abs() < 1e-9);
        assert!((share[650] - 0.5 * after(399.0 * 1.3e-4)).abs() < 1e-9);
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
