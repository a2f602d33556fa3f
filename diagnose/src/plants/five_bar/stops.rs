//! This file marks the direction of a joint as unknown where it may stop and start again: at low
//! speed, while brakes switch.

use crate::filter::ends;
use crate::rules::{STOP_S, SWITCHED_A, SWITCHED_S};
use rigproof_model::effects::Instant;

/// Whether a brake's current changes near each sample.
pub fn switched(currents: &[Option<Vec<f64>>; 4], step_s: f64, count: usize) -> Vec<bool> {
    let reach = samples(SWITCHED_S, step_s);
    let mut switched = vec![false; count];
    for current in currents.iter().flatten() {
        for (k, switched) in switched.iter_mut().enumerate() {
            *switched |= range(around(current, k, reach).iter().copied()) > SWITCHED_A;
        }
    }
    switched
}

/// Marks the direction as unknown where brakes switch and the recorded angle stays within `still`
/// for a few milliseconds. A joint may stop and start faster than its smoothed angle shows.
pub fn forget_sense_at_stops(
    motion: &mut [Instant],
    recorded: &[f64],
    (step_s, still): (f64, f64),
    switched: &[bool],
) {
    let reach = samples(STOP_S, step_s);
    for (k, (now, switched)) in motion.iter_mut().zip(switched).enumerate() {
        if *switched && range(around(recorded, k, reach).iter().copied()) <= still {
            now.sense = 0.0;
        }
    }
}

fn samples(time_s: f64, step_s: f64) -> usize {
    (time_s / step_s).round().max(1.0) as usize
}

/// The samples within `reach` of sample `k`.
fn around(values: &[f64], k: usize, reach: usize) -> &[f64] {
    let end = (k + reach + 1).min(values.len());
    values.get(k.saturating_sub(reach)..end).unwrap_or_default()
}

/// The greatest value less the least.
fn range(values: impl Iterator<Item = f64>) -> f64 {
    let [low, high] = ends(values);
    high - low
}

#[cfg(test)]
mod tests {
    use super::*;

    const COUNT: f64 = 6.3e-6;

    #[test]
    fn a_stop_between_two_motions_is_seen_where_brakes_are_switched() {
        // A count per millisecond, then 9 ms at one place, then on.
        let recorded: Vec<f64> = (0..60)
            .map(|k: i32| COUNT * f64::from(k.min(30) + (k - 39).max(0)))
            .collect();
        let known = |switched: bool| -> Vec<usize> {
            let mut motion: Vec<Instant> = recorded
                .iter()
                .map(|position| Instant {
                    time_s: 0.0,
                    position: *position,
                    speed: 1e-3,
                    sense: 1.0,
                })
                .collect();
            let switched = vec![switched; motion.len()];
            forget_sense_at_stops(&mut motion, &recorded, (1e-3, 2.5 * COUNT), &switched);
            let forgotten = motion
                .iter()
                .enumerate()
                .filter(|(_, now)| now.sense == 0.0);
            forgotten.map(|(k, _)| k).collect()
        };
        let ends = [0, 59];
        let inside: Vec<usize> = known(true);
        let inside: Vec<usize> = inside.into_iter().filter(|k| !ends.contains(k)).collect();
        assert_eq!(inside, (31..=38).collect::<Vec<_>>());
        assert!(known(false).is_empty());
    }

    #[test]
    fn a_brake_is_switched_around_a_change_of_its_current() {
        let (count, step, step_s) = (400, 170, 1e-3);
        let mut currents = [0.0, 0.31, 0.4, 0.7].map(|current| Some(vec![current; count]));
        currents[0] = None;
        assert!(!switched(&currents, step_s, count).contains(&true));
        currents[1].as_mut().unwrap()[step..].fill(0.34);
        let reach = (SWITCHED_S / step_s).round() as usize;
        let seen = switched(&currents, step_s, count);
        let first = seen.iter().position(|s| *s);
        let last = seen.iter().rposition(|s| *s);
        assert_eq!((first, last), (Some(step - reach), Some(step + reach - 1)));
    }
}
