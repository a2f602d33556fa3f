//! This file says that a brake only ever takes energy out of its shaft.

use super::Margin;

/// Whether a brake takes power from its shaft; the margin is the dissipated power −τ·ω, W.
///
/// `torque_on_shaft_nm` is what the brake exerts on the shaft, positive in the sense of the joint angle: minus the
/// resistance. `omega_rad_s` is the shaft's speed in the same sense.
///
/// Source: chapter 1, "may only apply force in a direction that opposes velocity", and §5.3.4: the sign of its torque is the negative sign of the joint's velocity.
pub fn dissipation(torque_on_shaft_nm: f64, omega_rad_s: f64) -> Margin {
    Margin(-torque_on_shaft_nm * omega_rad_s)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_torque_along_the_motion_breaks_the_law() {
        assert!(dissipation(-1.31, 0.77).holds());
        assert!(dissipation(1.31, -0.77).holds());
        assert!(!dissipation(1.31, 0.77).holds());
        assert!(!dissipation(-1.31, -0.77).holds());
        assert_eq!(dissipation(-1.31, 0.77), Margin(1.31 * 0.77));
    }

    #[test]
    fn an_undefined_power_breaks_the_law() {
        assert!(!dissipation(f64::NAN, 0.77).holds());
        assert!(!dissipation(f64::INFINITY, 0.0).holds());
    }
}
