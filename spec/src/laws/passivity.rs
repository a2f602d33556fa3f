//! This file says which force a brake may lend the tip, in signs alone, so that it can be asked of any kind of number.

use core::ops::{Add, Mul};

/// Whether a force takes power from a velocity: the computed power is below zero, and so is the exact one, because rounding keeps order.
///
/// Source: §6.3, "the force contribution from each brake must act in a direction that opposes velocity"; at zero power no brake is chosen
/// (gap `joint-at-rest`).
pub fn opposes<T>(force_n: [T; 2], velocity_m_s: [T; 2]) -> bool
where
    T: Copy + PartialOrd + Add<Output = T> + Mul<Output = T> + From<i8>,
{
    dot(force_n, velocity_m_s) < T::from(0)
}

/// Whether a local path lies between the direction of the path and the one towards it, both ends included.
///
/// Source: §6.2: the admissible quarter turn of an SDOF path.
pub fn in_quarter_turn<T>(path: [T; 2], along: [T; 2], towards: [T; 2]) -> bool
where
    T: Copy + PartialOrd + Add<Output = T> + Mul<Output = T> + From<i8>,
{
    dot(path, along) >= T::from(0) && dot(path, towards) >= T::from(0)
}

fn dot<T: Copy + Add<Output = T> + Mul<Output = T>>([a, b]: [T; 2], [c, d]: [T; 2]) -> T {
    a * c + b * d
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_a_force_against_the_motion_opposes_it() {
        assert!(opposes([-1.3, 0.4], [0.07, 0.02]));
        assert!(!opposes([1.3, 0.4], [0.07, 0.02]));
        assert!(!opposes([1.5, -3.0], [0.5, 0.25]));
        assert!(!opposes([f64::NAN, 0.4], [0.07, 0.02]));
        assert!(opposes([-1.3_f32, 0.4], [0.07, 0.02]));
    }

    #[test]
    fn a_quarter_turn_has_two_ends() {
        let (along, towards) = ([0.8, 0.6], [-0.6, 0.8]);
        assert!(in_quarter_turn([0.3, 0.9], along, towards));
        assert!(in_quarter_turn([0.8, 0.6], along, towards));
        assert!(!in_quarter_turn([-0.9, 0.3], along, towards));
        assert!(!in_quarter_turn([0.9, -0.3], along, towards));
        assert!(!in_quarter_turn([f64::NAN, 0.3], along, towards));
    }
}
