//! This file says what a brake's backlash is: a window as wide as it was, that only a shaft at its edge can move.

use super::Margin;

/// The window of a backlash and the shaft in it, rad.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Window {
    /// The lower boundary θ1, rad.
    pub theta_1_rad: f64,
    /// The upper boundary θ2, rad.
    pub theta_2_rad: f64,
    /// The shaft's angle, rad.
    pub theta_rad: f64,
    /// Whether the shaft counts as inside, where the brake resists with its off-state torque only.
    pub inside: bool,
}

/// Whether the window is as wide as the brake's backlash, to a slack for rounding; the margin is what is left of it, rad.
///
/// Source: §3.4.3, figure 3.14: the boundaries travel together.
pub fn backlash_width(window: &Window, width_rad: f64, slack_rad: f64) -> Margin {
    Margin(slack_rad - (window.theta_2_rad - window.theta_1_rad - width_rad).abs())
}

/// Whether the shaft is within its window, to a slack, and inside only between the boundaries; the margin to the nearer boundary is rad.
///
/// Source: §3.4.3: outside, the boundary travels with the shaft.
pub fn backlash_window(window: &Window, slack_rad: f64) -> Margin {
    let slack_rad = if window.inside { 0.0 } else { slack_rad };
    Margin(window.theta_rad - window.theta_1_rad + slack_rad)
        .and(Margin(window.theta_2_rad - window.theta_rad + slack_rad))
}

/// Whether the boundaries held still, to a slack, where the shaft stayed between them, or moved the way the shaft did where it reached
/// one; the margin is what is left of the slack, rad.
///
/// Source: §3.4.3: the boundaries hold still while the shaft is inside and travel with it otherwise.
pub fn backlash_travel(before: &Window, after: &Window, slack_rad: f64) -> Margin {
    let moved_rad = after.theta_1_rad - before.theta_1_rad;
    let up_rad = (after.theta_rad - before.theta_2_rad).max(0.0);
    let down_rad = (before.theta_1_rad - after.theta_rad).max(0.0);
    Margin(slack_rad - (moved_rad - up_rad + down_rad).abs())
}

/// Whether a brake asks for no more than its off-state torque while its shaft is inside; the margin is N·m.
///
/// Source: §3.4.3: inside the backlash only the off-state torque is felt.
pub fn backlash_torque(inside: bool, torque_nm: f64, off_state_nm: f64) -> Margin {
    if inside {
        Margin(off_state_nm - torque_nm.abs())
    } else {
        Margin(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BEFORE: Window = Window {
        theta_1_rad: 0.31,
        theta_2_rad: 0.34,
        theta_rad: 0.33,
        inside: true,
    };

    #[test]
    fn a_window_keeps_its_width() {
        assert!(backlash_width(&BEFORE, 0.03, 1e-12).holds());
        assert!(!backlash_width(&BEFORE, 0.031, 1e-12).holds());
        assert!(!backlash_width(&BEFORE, f64::NAN, 1e-12).holds());
    }

    #[test]
    fn a_shaft_inside_is_between_the_boundaries() {
        assert!(backlash_window(&BEFORE, 0.0).holds());
        for theta_rad in [0.309, 0.341, f64::NAN] {
            let beyond = Window {
                theta_rad,
                ..BEFORE
            };
            assert!(!backlash_window(&beyond, 0.002).holds(), "{theta_rad} rad");
            let engaged = Window {
                inside: false,
                ..beyond
            };
            assert_eq!(
                backlash_window(&engaged, 0.002).holds(),
                theta_rad.is_finite()
            );
        }
    }

    #[test]
    fn only_a_shaft_at_its_edge_moves_the_window() {
        let pushed = |theta_rad, by_rad| Window {
            theta_1_rad: BEFORE.theta_1_rad + by_rad,
            theta_2_rad: BEFORE.theta_2_rad + by_rad,
            theta_rad,
            inside: false,
        };
        for (theta_rad, by_rad) in [(0.36, 0.02), (0.28, -0.03), (0.32, 0.0)] {
            let travel = |moved| backlash_travel(&BEFORE, &pushed(theta_rad, moved), 1e-12);
            assert!(travel(by_rad).holds(), "{theta_rad} rad");
            assert!(!travel(by_rad + 0.001).holds(), "{theta_rad} rad");
            assert!(!travel(f64::NAN).holds());
        }
    }

    #[test]
    fn inside_only_the_off_state_torque_is_felt() {
        assert!(backlash_torque(true, -0.21, 0.22).holds());
        assert!(!backlash_torque(true, -0.23, 0.22).holds());
        assert!(!backlash_torque(true, f64::NAN, 0.22).holds());
        assert!(backlash_torque(false, 5.9, 0.22).holds());
    }
}
