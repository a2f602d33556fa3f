//! This file says when a shaft is inside its brake's backlash, and what the brake is then asked for.

#[cfg(any(kani, feature = "claims"))]
pub mod proofs;

use rigproof_spec::units::rad_from_deg;

use crate::number::{Scalar, least, most};

/// Reverse travel after which a shaft counts as inside the backlash, degrees (gap `backlash-entry`, decision 0004).
pub const ENTRY_TRAVEL_DEG: f64 = 0.02;

/// Two boundaries that hold still while the shaft is between them and travel with it otherwise (§3.4.3).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Backlash<S = f64> {
    theta_1_rad: S,
    width_rad: S,
    inside: bool,
}

/// How the shaft passed a boundary that changes what the brake is asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// The part of the way that lay before it.
    pub part: f64,
    /// Whether it came inside.
    pub inside: bool,
}

impl Backlash {
    /// A backlash of a width, degrees, with the shaft in its middle at an angle, rad.
    pub fn new(width_deg: f64, theta_rad: f64) -> Backlash {
        let width_rad = rad_from_deg(width_deg);
        Backlash {
            theta_1_rad: theta_rad - 0.5 * width_rad,
            width_rad,
            inside: 0.5 * width_rad > rad_from_deg(ENTRY_TRAVEL_DEG),
        }
    }

    /// Turns the shaft straight from one angle to another, rad; where that changed whether it is inside, says when.
    #[inline]
    pub fn turn(&mut self, from_rad: f64, to_rad: f64) -> Option<Crossing> {
        let was_inside = self.inside;
        let boundary = self.pass(from_rad, to_rad, rad_from_deg(ENTRY_TRAVEL_DEG))?;
        let inside = self.inside;
        (inside != was_inside).then(|| Crossing {
            part: within_one((boundary - from_rad) / (to_rad - from_rad)),
            inside,
        })
    }
}

impl<S: Scalar> Backlash<S> {
    /// Turns the shaft from one angle to another, rad, and returns the angle on the way at which it is, or would have come, inside or out;
    /// none in the travel of `entry`, rad, where it stays what it was.
    #[inline(always)]
    fn pass(&mut self, from_rad: S, to_rad: S, entry: S) -> Option<S> {
        let (low, high) = (self.theta_1_rad, self.theta_1_rad + self.width_rad);
        if to_rad >= high {
            self.theta_1_rad = to_rad - self.width_rad;
            self.inside = false;
            Some(high)
        } else if to_rad <= low {
            self.theta_1_rad = to_rad;
            self.inside = false;
            Some(low)
        } else if to_rad - low > entry && high - to_rad > entry {
            self.inside = true;
            Some(if to_rad < from_rad {
                high - entry
            } else {
                low + entry
            })
        } else {
            None
        }
    }

    /// Whether the shaft is inside, where the brake resists with its off-state torque only.
    pub fn is_inside(&self) -> bool {
        self.inside
    }

    /// The boundaries θ1 and θ2, rad.
    pub fn boundaries_rad(&self) -> [S; 2] {
        [self.theta_1_rad, self.theta_1_rad + self.width_rad]
    }
}

/// What the yield torque moves towards, N·m: the off-state torque inside the backlash, else what the current asks for, within the off-state
/// torque and the greatest.
#[inline]
pub fn target_nm<S: Scalar>(inside: bool, asked_nm: S, [off_state_nm, greatest_nm]: [S; 2]) -> S {
    if inside {
        off_state_nm
    } else {
        most(off_state_nm, least(greatest_nm, asked_nm))
    }
}

/// The nearest number of 0 to 1; what is no number counts as 1.
#[inline]
fn within_one(part: f64) -> f64 {
    if part < 0.0 {
        0.0
    } else if part < 1.0 {
        part
    } else {
        1.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(angle_deg: f64) -> f64 {
        rad_from_deg(angle_deg)
    }

    #[test]
    fn the_moment_of_crossing_is_on_the_way() {
        let mut backlash = Backlash::new(1.7, at(11.1));
        assert!(backlash.is_inside());
        // The boundary is at 11.95°.
        let out = backlash.turn(at(11.75), at(12.35)).unwrap();
        assert!(!out.inside && (out.part - 1.0 / 3.0).abs() < 1e-9);
        // Inside again from 12.33° downwards.
        let entered = backlash.turn(at(12.35), at(12.25)).unwrap();
        assert!(entered.inside && (entered.part - 0.2).abs() < 1e-9);
        assert_eq!(backlash.turn(at(12.25), at(11.1)), None);
    }

    #[test]
    fn a_brake_without_backlash_is_never_inside() {
        let mut backlash = Backlash::new(0.0, at(7.7));
        let angles_deg = [7.7, 8.1, 7.9, 7.899, 9.3, -4.1];
        for way in angles_deg.windows(2) {
            assert_eq!(backlash.turn(at(way[0]), at(way[1])), None);
            assert!(!backlash.is_inside());
        }
    }
}
