//! This file is physics that the thesis leaves out between a command and the current of a brake.

use rigproof_spec::effect::Mechanism;

use super::decay::decayed;

/// What lies between the current that is asked for and the one that the brake has.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CurrentPath {
    /// Time constant of a lag, s; zero for none.
    time_constant_s: f64,
    /// Error of the gain.
    fraction: f64,
    current_a: f64,
}

impl CurrentPath {
    /// The same path with one more mechanism on it; none for a mechanism that is not of this kind.
    pub fn with(self, mechanism: Mechanism, parameters: &[f64]) -> Option<CurrentPath> {
        match (mechanism, parameters) {
            (Mechanism::Lag, &[time_constant_s])
                if (0.0..=GREATEST_LAG_S).contains(&time_constant_s) =>
            {
                Some(CurrentPath {
                    time_constant_s,
                    ..self
                })
            }
            (Mechanism::GainError, &[fraction]) if fraction.is_finite() => {
                Some(CurrentPath { fraction, ..self })
            }
            _ => None,
        }
    }

    /// The brake's current over a step, A: what it is in the middle, kept inside 0 to 1 A; the path at its end.
    #[inline(always)]
    pub fn step(&mut self, asked_a: f64, step_s: f64) -> f64 {
        let target_a = asked_a * (1.0 + self.fraction);
        let middle_a = if self.time_constant_s > 0.0 {
            let exponent = step_s / self.time_constant_s;
            let change_a = target_a - self.current_a;
            let half = 0.5 * exponent;
            let middle_a = self.current_a + change_a * half * decayed(half);
            self.current_a += change_a * exponent * decayed(exponent);
            middle_a
        } else {
            self.current_a = target_a;
            target_a
        };
        middle_a.clamp(0.0, rigproof_spec::tables::GREATEST_CURRENT_A)
    }
}

/// Longest lag of a current, s.
const GREATEST_LAG_S: f64 = 100.0;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lagging_current_follows_its_exponential() {
        let path = CurrentPath::default().with(Mechanism::Lag, &[0.037]);
        let mut path = path.unwrap().with(Mechanism::GainError, &[-0.13]).unwrap();
        for _ in 0..50 {
            path.step(0.9, 0.74e-3);
        }
        let expected = 0.9 * 0.87 * (1.0 - libm::exp(-1.0));
        assert!((path.current_a - expected).abs() < 1e-14);
    }

    #[test]
    fn what_is_no_path_is_refused() {
        assert_eq!(
            CurrentPath::default().with(Mechanism::ChannelSkew, &[0.01]),
            None
        );
    }
}
