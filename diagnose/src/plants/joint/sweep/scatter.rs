//! This file measures the noise of an effort in a static sweep, whose rows follow each other by no
//! time.

use crate::filter::{deviation, ends};
use crate::rules::SPEEDS_ALIKE;

/// A row among its likes.
#[derive(Clone, Copy, PartialEq)]
struct Row {
    /// About which speed, where the sweep is over a command.
    speed: f64,
    /// Whether the command rose to it.
    rising: bool,
    /// The command, or without one the speed.
    at: f64,
    effort: f64,
}

impl Row {
    fn is_like(self, other: Row) -> bool {
        (self.speed, self.rising) == (other.speed, other.rising)
    }
}

/// About the standard deviation of the noise of an effort: how far a row lies from the straight line
/// between its neighbours (Gasser, Sroka and Jennen-Steinmetz, Biometrika 73, 1986).
///
/// Neighbours are rows of about one speed, next to each other in command, on the same way of the
/// sweep, up or down; without a command, next to each other in speed. `None` where no row has two.
pub fn scatter(effort: &[f64], command: Option<&[f64]>, speed: Option<&[f64]>) -> Option<f64> {
    let mut rows = rows(effort, command, speed)?;
    rows.sort_by(|a, b| {
        let firsts = a.speed.total_cmp(&b.speed).then(a.rising.cmp(&b.rising));
        firsts.then(a.at.total_cmp(&b.at))
    });
    let threes = rows.windows(3).filter_map(|three| match *three {
        [a, b, c] if a.is_like(c) => Some(off([a, b, c])),
        _ => None,
    });
    deviation(threes.collect())
}

/// How far the middle row lies from the line between the others, in standard deviations of one row.
fn off([a, b, c]: [Row; 3]) -> f64 {
    let share = match c.at > a.at {
        true => (b.at - a.at) / (c.at - a.at),
        false => 0.5,
    };
    let line = (1.0 - share) * a.effort + share * c.effort;
    (b.effort - line) / (1.0 + share.powi(2) + (1.0 - share).powi(2)).sqrt()
}

fn rows(effort: &[f64], command: Option<&[f64]>, speed: Option<&[f64]>) -> Option<Vec<Row>> {
    let over = command.or(speed)?;
    let speeds = speed.filter(|_| command.is_some()).unwrap_or_default();
    let [low, high] = ends(speeds.iter().copied());
    let alike = SPEEDS_ALIKE * high.abs().max(low.abs());
    let second = over.get(1).copied().unwrap_or(0.0);
    let before = [second].into_iter().chain(over.iter().copied());
    let rows = effort.iter().zip(over).zip(before).enumerate();
    let rows = rows.map(|(k, ((effort, at), before))| Row {
        speed: speeds.get(k).map_or(0.0, |own| (own / alike).round()),
        rising: if k == 0 { before >= *at } else { *at >= before },
        at: *at,
        effort: *effort,
    });
    Some(rows.collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_is_told_from_a_curve_a_memory_and_a_speed() {
        // Noise of ±0.01 by turns that follow no order of the sweep.
        let noise = |k: usize| 0.01 * libm::sin((k * k * 7 % 101) as f64);
        let commands: Vec<f64> = (0..80)
            .map(|k: u32| f64::from(k % 40).min(f64::from(40 - k % 40)) / 10.0)
            .collect();
        let speeds: Vec<f64> = (0..80).map(|k| [1.0, 9.0][k % 2]).collect();
        let efforts: Vec<f64> = (0..80)
            .map(|k| {
                let late = if k % 40 < 20 { -0.2 } else { 0.2 };
                let command = commands[k] + late;
                command * command + 0.3 * speeds[k] + noise(k)
            })
            .collect();
        let found = scatter(&efforts, Some(&commands), Some(&speeds)).unwrap();
        assert!((0.004..0.04).contains(&found), "{found}");
        assert_eq!(scatter(&efforts, None, None), None);
    }
}
