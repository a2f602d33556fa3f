//! This file says how fast a joint turns, from the counts of its encoder: first-order adaptive windowing (decision 0073).

use crate::encoder::Encoder;
use crate::number::{Real, least, most};

/// Longest window, samples.
pub const LONGEST_WINDOW: usize = 8;

/// The least common multiple of 1 to [`LONGEST_WINDOW`], in whose parts of a count every slope is a whole number.
const PARTS: f64 = 840.0;
/// Parts of a count a sample that one count is over windows of 1 to [`LONGEST_WINDOW`] samples.
const SHARES: [f64; LONGEST_WINDOW] = [840.0, 420.0, 280.0, 210.0, 168.0, 140.0, 120.0, 105.0];

/// The estimator of one joint: the counts of the last samples.
///
/// The velocity is that of the straight line through the newest count and the one a window before, over the longest window of at
/// most [`LONGEST_WINDOW`] samples whose lines, and those of every shorter window, pass each count between within one count
/// (Janabi-Sharifi, Hayward and Chen, IEEE Trans. Control Systems Technology 8, 2000, "end-fit"). Which window it is, is decided in
/// whole numbers below 2⁴³, which f64 holds exactly: the same in f32 and f64, and exactly zero at rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Velocity<R> {
    /// Travels, the newest first.
    past: [i32; LONGEST_WINDOW],
    rad_s_per_part: R,
}

impl<R: Real> Velocity<R> {
    /// The estimator of a joint that stands at a travel of zero, sampled every `sample_s`, s.
    pub fn new(encoder: &Encoder<R>, sample_s: f64) -> Velocity<R> {
        Velocity {
            past: [0; LONGEST_WINDOW],
            rad_s_per_part: encoder.rad_per_count() * R::of(1.0 / (sample_s * PARTS)),
        }
    }

    /// Forgets the past: the joint stands at a travel.
    pub fn restart(&mut self, travel: i32) {
        self.past = [travel; LONGEST_WINDOW];
    }

    /// The joint's rate at its next travel, rad/s.
    // Always inline: a compiler that sees both joints does them at once, one in each half of a register.
    #[inline(always)]
    pub fn update(&mut self, travel: i32) -> R {
        let [a, b, c, d, e, f, g, h] = self.past;
        self.past = [travel, a, b, c, d, e, f, g];
        let [one, shares @ ..] = SHARES;
        let travel = f64::from(travel);
        let mut slope = (travel - f64::from(a)) * one;
        // A line passes a count `i` samples ago within one count if its slope lies between these. Without a branch: how long a
        // window is cannot be predicted, and asking costs more than going on.
        let (mut lowest, mut highest) = (slope - one, slope + one);
        let mut straight = true;
        for (past, share) in [b, c, d, e, f, g, h].into_iter().zip(shares) {
            let candidate = (travel - f64::from(past)) * share;
            straight &= (lowest <= candidate) & (candidate <= highest);
            slope = if straight { candidate } else { slope };
            lowest = most(candidate - share, lowest);
            highest = least(candidate + share, highest);
        }
        R::of(slope) * self.rad_s_per_part
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn estimator() -> Velocity<f64> {
        Velocity::new(&Encoder::new(99_991, 0).unwrap(), 0.001_3)
    }

    /// Rad/s of one count a sample.
    const ONE: f64 = core::f64::consts::TAU / (99_991.0 * 0.001_3);

    #[test]
    fn a_window_of_one_count_is_as_many_parts_as_it_says() {
        for (window, share) in (1_u8..).zip(SHARES) {
            assert_eq!(f64::from(window) * share, PARTS);
        }
    }

    #[test]
    fn a_resting_joint_has_no_rate_at_all_after_one_window() {
        let mut velocity = estimator();
        for travel in [3, 17, 41, 60] {
            velocity.update(travel);
        }
        let rates: [f64; LONGEST_WINDOW + 1] = core::array::from_fn(|_| velocity.update(61));
        assert!(rates[0] > 0.0);
        assert_eq!(rates[LONGEST_WINDOW], 0.0);
    }

    #[test]
    fn a_steady_rate_is_told_within_the_window_share_of_a_count() {
        // 2.3 counts a sample, rounded down.
        let mut velocity = estimator();
        let rates: [f64; 23] =
            core::array::from_fn(|i| velocity.update((i as f64 * 2.3 + 0.37) as i32));
        for rate in &rates[LONGEST_WINDOW..] {
            assert!((rate / ONE - 2.3).abs() <= 1.0 / LONGEST_WINDOW as f64 + 1e-12);
        }
    }

    #[test]
    fn a_window_ends_where_the_line_would_miss_a_count() {
        let mut velocity = estimator();
        velocity.restart(100);
        for travel in [100, 100, 100, 109, 118] {
            velocity.update(travel);
        }
        // Three counts lie on the line of nine a sample; the next one back does not.
        assert!((velocity.update(127) / ONE - 9.0).abs() < 1e-12);
    }

    #[test]
    fn no_travel_overflows() {
        let mut velocity = estimator();
        for travel in [i32::MIN, i32::MAX, i32::MIN, 0, i32::MAX] {
            assert!(velocity.update(travel).is_finite());
        }
    }

    #[test]
    fn a_joint_that_is_restarted_has_no_rate_where_it_stands() {
        let mut velocity = estimator();
        for travel in [3, 17, 41, 60] {
            velocity.update(travel);
        }
        velocity.restart(613);
        assert_eq!(velocity.update(613), 0.0);
    }
}
