//! This file averages what belongs together: the steps of one current and one speed in one
//! recording.

use crate::rules::{SAME_CURRENT_A, SAME_SPEED};
use rigproof_spec::tables::Edge;

use super::sampled::{deviation, mean};
use super::{Identified, speed_rpm};

/// Settled torques and time constants by current, speed and recording.
pub struct Sets {
    /// Current, A, the index of its level, and the settled torques of the set, N·m.
    torques: Vec<(f64, usize, Vec<f64>)>,
    /// Edge, current, A, speed, rpm, and the time constants of the set, s.
    times: Vec<(Edge, f64, f64, Vec<f64>)>,
}

impl Sets {
    /// Groups what was found.
    pub fn new(found: &Identified) -> Sets {
        let currents = found.steady.iter().map(|s| s.current_a);
        let currents = levels(
            currents.chain(found.steps.iter().map(|s| s.current_a)),
            |low, high| high - low < SAME_CURRENT_A,
        );
        let speeds = found.steady.iter().map(|s| speed_rpm(s.omega_rad_s));
        let speeds = speeds.chain(found.steps.iter().map(|s| speed_rpm(s.omega_rad_s)));
        let speeds = levels(speeds, |low, high| high < low * (1.0 + SAME_SPEED));
        let torques = grouped(found.steady.iter().map(|s| {
            let key = (
                s.recording,
                level(&currents, s.current_a),
                level(&speeds, speed_rpm(s.omega_rad_s)),
            );
            (key, [s.current_a, 0.0, s.torque_nm])
        }));
        let times = |edge: Edge| {
            let steps = found.steps.iter().filter(move |s| s.edge == edge);
            let sets = grouped(steps.map(|s| {
                let omega_rpm = speed_rpm(s.omega_rad_s);
                let key = (
                    s.recording,
                    level(&currents, s.current_a),
                    level(&speeds, omega_rpm),
                );
                (key, [s.current_a, omega_rpm, s.time_constant_s])
            }));
            sets.into_iter()
                .map(move |(_, [i, omega, a])| (edge, mean(&i), mean(&omega), a))
        };
        Sets {
            torques: torques
                .into_iter()
                .map(|((_, current, _), [i, _, torque])| (mean(&i), current, torque))
                .collect(),
            times: Edge::ALL.into_iter().flat_map(times).collect(),
        }
    }

    /// Current, A, mean settled torque, N·m, and level of the current; one entry per set.
    pub fn steady(&self) -> Vec<(f64, f64, usize)> {
        let sets = self.torques.iter();
        sets.map(|(current_a, level, torques)| (*current_a, mean(torques), *level))
            .collect()
    }

    /// Current, A, speed, rpm, and mean time constant, s; one entry per set.
    pub fn time_constants(&self, edge: Edge) -> Vec<(f64, f64, f64)> {
        let sets = self.times.iter().filter(|(of, ..)| *of == edge);
        sets.map(|(_, current_a, omega_rpm, times)| (*current_a, *omega_rpm, mean(times)))
            .collect()
    }

    /// Current, A, standard deviation of its settled torques, N·m, and their number (§3.4.1, figure
    /// 3.9).
    pub fn scatter(&self) -> Vec<(f64, f64, usize)> {
        let greatest = self.torques.iter().map(|set| set.1).max().unwrap_or(0);
        let of = |level: usize| {
            let sets = self.torques.iter().filter(|set| set.1 == level);
            let (mut currents, mut torques) = (Vec::new(), Vec::new());
            for (current_a, _, set) in sets {
                currents.push(*current_a);
                torques.extend(set);
            }
            (mean(&currents), deviation(&torques), torques.len())
        };
        let all = (0..=greatest).map(of);
        all.filter(|(.., count)| *count > 1).collect()
    }
}

type Key = (usize, usize, usize);

/// Values grouped by key, column by column. Keys are in the order of their first appearance.
fn grouped(items: impl Iterator<Item = (Key, [f64; 3])>) -> Vec<(Key, [Vec<f64>; 3])> {
    let mut sets: Vec<(Key, [Vec<f64>; 3])> = Vec::new();
    for (key, values) in items {
        if !sets.iter().any(|(known, _)| *known == key) {
            sets.push((key, Default::default()));
        }
        let set = sets.iter_mut().find(|(known, _)| *known == key);
        for (column, value) in set.into_iter().flat_map(|(_, set)| set).zip(values) {
            column.push(value);
        }
    }
    sets
}

/// The lowest value of each level. Two neighbours that are `same` belong to one level.
fn levels(values: impl Iterator<Item = f64>, same: fn(f64, f64) -> bool) -> Vec<f64> {
    let mut sorted: Vec<f64> = values.collect();
    sorted.sort_by(f64::total_cmp);
    let mut levels: Vec<f64> = Vec::new();
    let mut before = f64::NEG_INFINITY;
    for value in sorted {
        if levels.is_empty() || !same(before, value) {
            levels.push(value);
        }
        before = value;
    }
    levels
}

/// The index of a value's level.
fn level(levels: &[f64], value: f64) -> usize {
    levels
        .iter()
        .filter(|low| **low <= value)
        .count()
        .saturating_sub(1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_within_the_tolerance_are_one_level() {
        let values = [0.61, 0.2, 0.59, 0.0, 0.215, 0.004];
        let found = levels(values.into_iter(), |low, high| high - low < SAME_CURRENT_A);
        assert_eq!(found, [0.0, 0.2, 0.59]);
        assert_eq!(values.map(|value| level(&found, value)), [2, 1, 2, 0, 1, 0]);
    }

    #[test]
    fn values_are_kept_apart_by_their_key() {
        let items = [
            ((0, 1, 0), [0.5, 4.0, 1.7]),
            ((1, 1, 0), [0.5, 4.0, 9.1]),
            ((0, 1, 0), [0.7, 4.2, 1.9]),
        ];
        let sets = grouped(items.into_iter());
        assert_eq!(sets.len(), 2);
        assert_eq!(sets[0].1, [vec![0.5, 0.7], vec![4.0, 4.2], vec![1.7, 1.9]]);
    }
}
