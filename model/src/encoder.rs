//! This file says what the encoders on the base joints see (§4.6, §5.3.1).

use core::f64::consts::PI;

/// Counts a turn as §4.6 prints them.
pub const COUNTS_PER_TURN: u32 = 100_000;
/// Counts a turn that the 0.000360° of §5.3.1 would need.
pub const COUNTS_PER_TURN_OF_SIMULATION: u32 = 1_000_000;
/// Counts a turn of 5000 lines in quadrature, as the part number HS30C176B15N5000 suggests.
pub const COUNTS_PER_TURN_OF_PART: u32 = 20_000;

/// An encoder: an angle is rounded to the nearest count.
///
/// # Differs from the thesis
///
/// §5.3.1 prints 0.000360°, §4.6 100 000 counts, which are 0.0036° (gap `encoder-resolution`).
///
/// ```
/// use rigproof_model::encoder::Encoder;
/// let encoder = Encoder::default();
/// assert_eq!(encoder.count(0.7), 11141);
/// assert!((encoder.reading_rad(0.7) - 0.7).abs() <= 0.5 * encoder.resolution_rad());
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Encoder {
    counts_per_turn: u32,
}

impl Default for Encoder {
    /// The encoder of §4.6.
    fn default() -> Encoder {
        Encoder {
            counts_per_turn: COUNTS_PER_TURN,
        }
    }
}

impl Encoder {
    /// An encoder of some counts a turn; none count as one.
    pub fn new(counts_per_turn: u32) -> Encoder {
        Encoder {
            counts_per_turn: counts_per_turn.max(1),
        }
    }

    /// The angle of one count, rad.
    pub fn resolution_rad(&self) -> f64 {
        2.0 * PI / f64::from(self.counts_per_turn)
    }

    /// The count nearest to an angle, rad; halves away from zero.
    pub fn count(&self, angle_rad: f64) -> i64 {
        (angle_rad / self.resolution_rad()).round() as i64
    }

    /// The angle that is read at an angle, rad: within half a count of it.
    pub fn reading_rad(&self, angle_rad: f64) -> f64 {
        self.count(angle_rad) as f64 * self.resolution_rad()
    }

    /// The speed that one count in one sample looks like, rad/s.
    pub fn one_count_speed_rad_s(&self, sample_s: f64) -> f64 {
        self.resolution_rad() / sample_s
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rigproof_spec::units::{RAD_PER_DEG, rpm_from_rad_s};

    #[test]
    fn the_printed_resolutions_contradict_each_other() {
        let deg = |counts| Encoder::new(counts).resolution_rad() / RAD_PER_DEG;
        assert!((deg(COUNTS_PER_TURN) - 0.0036).abs() < 1e-15);
        assert!((deg(COUNTS_PER_TURN_OF_SIMULATION) - 0.000_36).abs() < 1e-16);
        assert!((deg(COUNTS_PER_TURN_OF_PART) - 0.018).abs() < 1e-15);
    }

    #[test]
    fn one_count_in_a_millisecond_is_above_the_slowest_tested_speed() {
        let rpm = |counts| rpm_from_rad_s(Encoder::new(counts).one_count_speed_rad_s(1e-3));
        assert!((rpm(COUNTS_PER_TURN) - 0.6).abs() < 1e-12);
        assert!((rpm(COUNTS_PER_TURN_OF_SIMULATION) - 0.06).abs() < 1e-13);
        assert!((rpm(COUNTS_PER_TURN_OF_PART) - 3.0).abs() < 1e-12);
    }

    #[test]
    fn a_reading_is_the_nearest_count_on_both_sides_of_zero() {
        let encoder = Encoder::new(997);
        for step in -700..700 {
            let angle_rad = 0.003_17 * f64::from(step) + 0.000_71;
            let reading_rad = encoder.reading_rad(angle_rad);
            assert!((reading_rad - angle_rad).abs() <= 0.5 * encoder.resolution_rad() + 1e-15);
            assert_eq!(encoder.count(reading_rad), encoder.count(angle_rad));
            assert_eq!(encoder.count(-angle_rad), -encoder.count(angle_rad));
        }
    }
}
