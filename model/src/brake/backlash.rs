//! This file says when a shaft is inside its brake's backlash.

use rigproof_spec::joint::Joint;
use rigproof_spec::tables::backlash_width_deg;
use rigproof_spec::units::rad_from_deg;

/// Reverse travel after which a shaft counts as inside the backlash, degrees: just over one count of a 20 000-count
/// encoder (0.018°).
pub const ENTRY_TRAVEL_DEG: f64 = 0.02;

/// The backlash of one brake: two boundaries that hold still while the shaft is between them and travel with it
/// otherwise (§3.4.3, figure 3.14).
///
/// | symbol | here | unit |
/// |---|---|---|
/// | θ1, θ2 | [`Backlash::boundaries_rad`], θ1 ≤ θ2 | rad |
///
/// # Differs from the thesis
///
/// The thesis enters when the torque crosses zero; here the shaft enters after [`ENTRY_TRAVEL_DEG`] of travel from a
/// boundary (gap `backlash-entry`). It starts in the middle (gap `backlash-start`).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Backlash {
    theta_1_rad: f64,
    width_rad: f64,
    entry_rad: f64,
    inside: bool,
}

impl Backlash {
    /// The backlash of a brake (table 3.1), with the shaft in its middle at `theta_rad`.
    pub fn new(joint: Joint, theta_rad: f64) -> Backlash {
        Backlash::of_width(backlash_width_deg(joint), ENTRY_TRAVEL_DEG, theta_rad)
    }

    /// A backlash of any width and entry travel, degrees, with the shaft in its middle at `theta_rad`.
    pub fn of_width(width_deg: f64, entry_deg: f64, theta_rad: f64) -> Backlash {
        let width_rad = rad_from_deg(width_deg);
        let mut backlash = Backlash {
            theta_1_rad: theta_rad - width_rad / 2.0,
            width_rad,
            entry_rad: rad_from_deg(entry_deg),
            inside: false,
        };
        backlash.update(theta_rad);
        backlash
    }

    /// The backlash of a brake with its boundary θ1 at an angle, rad, and the shaft inside or not.
    pub fn resumed(joint: Joint, theta_1_rad: f64, inside: bool) -> Backlash {
        Backlash {
            theta_1_rad,
            inside,
            ..Backlash::new(joint, theta_1_rad)
        }
    }

    /// Moves the shaft to `theta_rad`, and the boundaries with it where it reaches one; returns whether it is inside.
    pub fn update(&mut self, theta_rad: f64) -> bool {
        let (theta_1_rad, theta_2_rad) = self.boundaries_rad();
        let entry_rad = self.entry_rad;
        if theta_rad >= theta_2_rad {
            self.theta_1_rad = theta_rad - self.width_rad;
            self.inside = false;
        } else if theta_rad <= theta_1_rad {
            self.theta_1_rad = theta_rad;
            self.inside = false;
        } else if theta_rad - theta_1_rad > entry_rad && theta_2_rad - theta_rad > entry_rad {
            self.inside = true;
        }
        self.inside
    }

    /// Whether the shaft is inside, where the brake resists with its off-state torque only.
    pub fn is_inside(&self) -> bool {
        self.inside
    }

    /// The boundaries θ1 and θ2, rad.
    pub fn boundaries_rad(&self) -> (f64, f64) {
        (self.theta_1_rad, self.theta_1_rad + self.width_rad)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(angle_deg: f64) -> f64 {
        rad_from_deg(angle_deg)
    }

    #[test]
    fn a_reversal_is_off_until_the_whole_width_is_travelled() {
        // Brake E, 1.7°: pushed up to 12.3°, it re-engages going down at 10.6°.
        let mut backlash = Backlash::new(Joint::E, at(11.1));
        assert!(backlash.is_inside());
        assert!(!backlash.update(at(12.3)));
        assert!(backlash.update(at(12.27)));
        assert!(backlash.update(at(10.61)));
        assert!(!backlash.update(at(10.59)));
        let (theta_1_rad, theta_2_rad) = backlash.boundaries_rad();
        assert!((theta_1_rad - at(10.59)).abs() < 1e-12);
        assert!((theta_2_rad - at(12.29)).abs() < 1e-12);
    }

    #[test]
    fn a_reversal_shorter_than_the_entry_travel_keeps_the_torque() {
        let mut backlash = Backlash::new(Joint::C, at(-3.7));
        assert!(!backlash.update(at(-2.1)));
        assert!(!backlash.update(at(-2.119)));
        assert!(!backlash.update(at(-2.103)));
        assert!(backlash.update(at(-2.121)));
    }

    #[test]
    fn a_shaft_that_comes_back_re_engages_at_the_boundary_it_left() {
        let mut backlash = Backlash::new(Joint::B, at(41.3));
        backlash.update(at(43.7));
        assert!(backlash.update(at(43.1)));
        assert!(backlash.update(at(43.699)));
        assert!(!backlash.update(at(43.701)));
    }

    #[test]
    fn brake_a_is_never_inside() {
        let mut backlash = Backlash::new(Joint::A, at(7.7));
        for angle_deg in [8.1, 7.9, 7.899, 9.3, -4.1] {
            assert!(!backlash.update(at(angle_deg)));
        }
    }
}
