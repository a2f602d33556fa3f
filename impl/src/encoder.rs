//! This file says which angle a count of an encoder is (§4.6).

use core::f64::consts::TAU;

use crate::number::Real;

/// Counts a turn as §4.6 prints them (decision 0032).
pub const COUNTS_PER_TURN: u32 = 100_000;
/// Most counts a turn: up to here every count of one turn is a number of its own in f32.
pub const MOST_COUNTS_PER_TURN: u32 = 1 << 24;

/// The encoder of one base joint: its counter is a 32-bit integer that may wrap round.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Encoder<R> {
    zero_count: i32,
    counts_per_turn: i32,
    rad_per_count: R,
}

impl<R: Real> Encoder<R> {
    /// An encoder of 1 to [`MOST_COUNTS_PER_TURN`] counts a turn, and its count at angle zero; `None` beyond.
    pub fn new(counts_per_turn: u32, zero_count: i32) -> Option<Encoder<R>> {
        let counts = i32::try_from(counts_per_turn).ok()?;
        (1..=MOST_COUNTS_PER_TURN)
            .contains(&counts_per_turn)
            .then(|| Encoder {
                zero_count,
                counts_per_turn: counts,
                rad_per_count: R::of(TAU / f64::from(counts_per_turn)),
            })
    }

    /// Counts from zero to a count: exact while the joint is less than 2³¹ counts from there, wherever the counter wraps.
    pub fn travel(&self, count: i32) -> i32 {
        count.wrapping_sub(self.zero_count)
    }

    /// Whether a travel is one that a base joint can have, which is stopped long before a whole turn (§4.5).
    pub fn reaches(&self, travel: i32) -> bool {
        (-self.counts_per_turn..=self.counts_per_turn).contains(&travel)
    }

    /// The angle of one count, rad.
    pub fn rad_per_count(&self) -> R {
        self.rad_per_count
    }

    /// The angle of a travel, rad. Within a turn the count itself is exact, in f32 too; what is rounded is one product.
    pub fn angle_rad(&self, travel: i32) -> R {
        R::of(f64::from(travel)) * self.rad_per_count
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_counter_may_wrap_between_zero_and_now() {
        let encoder = Encoder::<f64>::new(COUNTS_PER_TURN, i32::MAX - 1234).unwrap();
        let travel = encoder.travel((i32::MAX - 1234).wrapping_add(17_389));
        assert_eq!(travel, 17_389);
        assert!((encoder.angle_rad(travel) - 1.092_583).abs() < 1e-6);
        assert_eq!(
            encoder.travel((i32::MAX - 1234).wrapping_sub(i32::MAX)),
            -i32::MAX
        );
    }

    #[test]
    fn every_count_of_a_turn_is_an_angle_of_its_own_in_f32() {
        for counts in [20_000, COUNTS_PER_TURN, 1_000_000] {
            let encoder = Encoder::<f32>::new(counts, 0).unwrap();
            let turn = i32::try_from(counts).unwrap();
            assert!((-turn..turn).all(|k| encoder.angle_rad(k) < encoder.angle_rad(k + 1)));
        }
    }

    #[test]
    fn an_encoder_that_cannot_be_is_refused() {
        for counts in [0, MOST_COUNTS_PER_TURN + 1, u32::MAX] {
            assert_eq!(Encoder::<f64>::new(counts, 7), None);
        }
        let encoder = Encoder::<f64>::new(19_997, 7).unwrap();
        assert!(encoder.reaches(-19_997) && !encoder.reaches(19_998) && !encoder.reaches(i32::MIN));
    }
}
