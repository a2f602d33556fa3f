//! This file says how strong the force at the tip may be, and against what it acts.

use super::Margin;
use crate::layout::Layout;
use crate::methods::greatest_desired_force_n;

/// Whether a force asked for at the tip is within what every brake can give everywhere. The margin is N.
///
/// Source: §6.1.2, "maximum desired force magnitudes of 19.5 and 22.0 N".
pub fn desired_force(layout: Layout, force_n: f64) -> Margin {
    Margin(force_n).and(Margin(greatest_desired_force_n(layout) - force_n))
}

/// Whether a force on the tip opposes its velocity; the margin is the power it takes out, W.
///
/// Source: §6.3, "due to passivity constraints, the force contribution from each brake must act in a direction that
/// opposes velocity".
pub fn opposition(force_n: [f64; 2], velocity_m_s: [f64; 2]) -> Margin {
    let [force_x, force_y] = force_n;
    let [velocity_x, velocity_y] = velocity_m_s;
    Margin(-(force_x * velocity_x + force_y * velocity_y))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_limit_differs_between_the_layouts() {
        assert!(desired_force(Layout::ThreeBrake, 19.3).holds());
        assert!(!desired_force(Layout::ThreeBrake, 19.7).holds());
        assert!(desired_force(Layout::FourBrake, 21.9).holds());
        assert!(!desired_force(Layout::FourBrake, 22.1).holds());
        assert!(!desired_force(Layout::FourBrake, -0.3).holds());
        assert!(!desired_force(Layout::FourBrake, f64::NAN).holds());
    }

    #[test]
    fn a_force_along_the_motion_breaks_the_law() {
        assert_eq!(opposition([-1.5, 0.5], [0.25, 0.125]), Margin(0.3125));
        assert!(opposition([-1.3, 0.4], [0.07, 0.02]).holds());
        assert!(!opposition([1.3, 0.4], [0.07, 0.02]).holds());
        assert!(!opposition([f64::NAN, 0.4], [0.07, 0.02]).holds());
    }
}
