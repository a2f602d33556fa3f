//! This file is a brake or damper of any kind by its static characteristic: the effort at which it settles over
//! its command, followed with one time constant up and one down.

/// The static characteristic of a brake, and how fast its effort follows it.
///
/// ```text
/// dτ/dt = (K(u) − τ)/a, a the rising time constant where K(u) is above τ, else the falling one
/// ```
///
/// K is straight between the points and goes on straight beyond the ends, but never falls below zero: a brake
/// does not push. Commands and efforts are in any units, of force where the brake slides and of torque where it
/// turns; a time constant of zero follows at once.
///
/// ```
/// use rigproof_model::brake::Characteristic;
/// let damper = Characteristic {
///     points: vec![[0.0, 20.0], [2.0, 100.0]],
///     rising_s: 0.03,
///     falling_s: 0.06,
/// };
/// assert_eq!(damper.settled(0.5), 40.0);
/// // From rest, 30 ms after a step to 2 V: one time constant on the way from 20 N to 100 N.
/// let effort = damper.next(20.0, 2.0, 0.03);
/// assert!((effort - (100.0 - 80.0 * libm::exp(-1.0))).abs() < 1e-12);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Characteristic {
    /// Command and settled effort, at least two, by growing command.
    pub points: Vec<[f64; 2]>,
    /// Time constant of a growing effort, s.
    pub rising_s: f64,
    /// Time constant of a falling effort, s.
    pub falling_s: f64,
}

impl Characteristic {
    /// The effort at which the brake settles under a command.
    pub fn settled(&self, command: f64) -> f64 {
        let pairs = self.points.windows(2);
        let mut pieces = pairs.filter_map(|pair| <&[[f64; 2]; 2]>::try_from(pair).ok());
        let last = self.points.len().saturating_sub(2);
        let holds = |(k, [_, [end, _]]): &(usize, &[[f64; 2]; 2])| command <= *end || *k == last;
        let own = pieces.by_ref().enumerate().find(holds);
        own.map_or(0.0, |(_, [[from, low], [to, high]])| {
            (low + (high - low) * (command - from) / (to - from)).max(0.0)
        })
    }

    /// The effort a step after it was `effort`, under a command that holds for the step.
    pub fn next(&self, effort: f64, command: f64, step_s: f64) -> f64 {
        let settled = self.settled(command);
        let time_constant_s = match settled > effort {
            true => self.rising_s,
            false => self.falling_s,
        };
        match time_constant_s > 0.0 {
            true => settled + (effort - settled) * libm::exp(-step_s / time_constant_s),
            false => settled,
        }
    }

    /// The same brake with its rising and falling time constants times so much.
    pub fn slowed(&self, [rising, falling]: [f64; 2]) -> Characteristic {
        Characteristic {
            points: self.points.clone(),
            rising_s: rising * self.rising_s,
            falling_s: falling * self.falling_s,
        }
    }

    /// The greatest magnitude of a command among the points.
    pub fn greatest_command(&self) -> f64 {
        self.points
            .iter()
            .fold(0.0, |most, [command, _]| most.max(command.abs()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn own() -> Characteristic {
        Characteristic {
            points: vec![[-1.0, 9.0], [0.0, 1.0], [1.0, 5.0], [3.0, 7.0]],
            rising_s: 0.02,
            falling_s: 0.0,
        }
    }

    #[test]
    fn it_is_straight_between_its_points_and_beyond_the_ends() {
        for (command, settled) in [
            (-2.0, 17.0),
            (-0.5, 5.0),
            (0.0, 1.0),
            (0.25, 2.0),
            (2.0, 6.0),
            (5.0, 9.0),
        ] {
            assert_eq!(own().settled(command), settled, "at {command}");
        }
        let falls = Characteristic {
            points: vec![[0.0, 4.0], [1.0, 2.0]],
            ..own()
        };
        assert_eq!(falls.settled(7.0), 0.0);
    }

    #[test]
    fn a_step_does_not_depend_on_how_it_is_cut_and_edges_have_times_of_their_own() {
        let whole = own().next(1.0, 1.0, 0.03);
        let cut = own().next(own().next(1.0, 1.0, 0.01), 1.0, 0.02);
        assert!((whole - cut).abs() < 1e-12 && whole < 5.0);
        assert_eq!(own().next(6.0, 1.0, 1e-9), 5.0);
        assert_eq!(own().slowed([3.0, 1.0]).rising_s, 3.0 * 0.02);
        assert_eq!(own().greatest_command(), 3.0);
    }
}
