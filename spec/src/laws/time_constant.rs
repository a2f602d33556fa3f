//! This file says that a brake's torque never moves away from where it is going.

use super::Margin;

/// Whether a time constant is above zero and finite; the margin is by how much it exceeds the least positive number, s.
///
/// Source: (3.4): the yield torque approaches its end value exponentially.
pub fn time_constant(time_constant_s: f64) -> Margin {
    if time_constant_s.is_infinite() {
        Margin(f64::NEG_INFINITY)
    } else {
        Margin(time_constant_s - f64::MIN_POSITIVE)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_time_constant_is_above_zero_and_finite() {
        assert!(time_constant(0.0037).holds());
        assert!(time_constant(f64::MIN_POSITIVE).holds());
        for broken in [0.0, -0.0159, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert!(!time_constant(broken).holds(), "{broken} s");
        }
    }
}
