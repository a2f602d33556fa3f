//! This file says that a joint between two overrunning clutches turns between their speeds, and what speeds keep it passive.

use super::Margin;

/// Whether a joint's rate lies between the speeds of its two clutches; the margin is the distance to the nearer, rad/s.
///
/// Source: §2.2.1, "Each pair of clutches is driven in opposite directions in order to place velocity limits on each joint."
pub fn velocity_limits(rate_rad_s: f64, [least, greatest]: [f64; 2]) -> Margin {
    Margin(rate_rad_s - least).and(Margin(greatest - rate_rad_s))
}

/// Whether two clutches can never drive their joint: the least speed is backwards or zero, the greatest forwards or zero; the
/// margin is the smaller distance from rest, rad/s.
///
/// A clutch whose motor runs against the joint's own direction would push it. Source: chapter 1, a passive device may only "dissipate,
/// redirect, or store energy".
pub fn clutches_never_drive([least, greatest]: [f64; 2]) -> Margin {
    Margin(-least).and(Margin(greatest))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_joint_outside_its_limits_breaks_the_law() {
        assert!(velocity_limits(0.31, [-0.17, 0.43]).holds());
        assert!(velocity_limits(0.43, [-0.17, 0.43]).holds());
        assert!(!velocity_limits(0.44, [-0.17, 0.43]).holds());
        assert!(!velocity_limits(-0.18, [-0.17, 0.43]).holds());
        assert!(!velocity_limits(f64::NAN, [-0.17, 0.43]).holds());
        assert!(!velocity_limits(0.31, [f64::NAN, 0.43]).holds());
    }

    #[test]
    fn limits_without_rest_between_them_drive() {
        assert!(clutches_never_drive([-0.17, 0.0]).holds());
        assert!(!clutches_never_drive([0.03, 0.43]).holds());
        assert!(!clutches_never_drive([-0.17, -0.03]).holds());
        assert!(!clutches_never_drive([-0.17, f64::NAN]).holds());
    }
}
