//! This file says how much torque a current buys once the brake has settled.

use rigproof_spec::joint::Joint;
use rigproof_spec::tables::{GAIN_BREAK_A, TorqueGainFit, torque_gain_fit};

/// Torque gain K of a brake, N·m (3.3).
///
/// ```text
/// K = k1·I + k2             I < 0.2 A
/// K = k3·I² + k4·I + k5     I ≥ 0.2 A
/// ```
///
/// | symbol | here | unit | range |
/// |---|---|---|---|
/// | I | `current_a` | A | 0 to 1 fitted |
/// | k1 … k5 | table 3.2 | N·m/A, N·m, N·m/A², N·m/A, N·m | – |
///
/// The pieces do not meet: at 0.2 A the gain steps down by up to 18.8 mN·m (gap `gain-step`). Above 1 A the quadratic
/// is an extrapolation; [`Brake`](super::Brake) bounds what it takes from it.
///
/// ```
/// use rigproof_model::brake::torque_gain;
/// use rigproof_spec::joint::Joint;
/// // Brake A at 1 A: -3.68 + 12.05 - 0.84.
/// assert!((torque_gain(Joint::A, 1.0) - 7.53).abs() < 1e-12);
/// ```
pub fn torque_gain(joint: Joint, current_a: f64) -> f64 {
    fitted_torque_gain(&torque_gain_fit(joint), current_a)
}

/// Torque gain K of any brake whose coefficients are known, N·m (3.3); see [`torque_gain`].
//= thesis (3.3)
pub fn fitted_torque_gain(fit: &TorqueGainFit, current_a: f64) -> f64 {
    if current_a < GAIN_BREAK_A {
        fit.k_1 * current_a + fit.k_2
    } else {
        fit.k_3 * current_a * current_a + fit.k_4 * current_a + fit.k_5
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    //= thesis (3.3) test
    #[test]
    fn gain_follows_table_3_2_by_hand() {
        // 6.09*0.13 + 0.22 = 1.0117; -2.72*0.37² + 9.37*0.37 - 0.71 = 2.384532;
        // -2.14*0.73² + 8.76*0.73 - 0.49 = 4.764394; -2.21*0.91² + 8.48*0.91 - 0.39 = 5.496699.
        for (joint, current_a, gain_nm) in [
            (Joint::A, 0.13, 1.0117),
            (Joint::E, 0.37, 2.384_532),
            (Joint::B, 0.73, 4.764_394),
            (Joint::C, 0.91, 5.496_699),
        ] {
            let difference = torque_gain(joint, current_a) - gain_nm;
            assert!(
                difference.abs() < 1e-12,
                "{} off by {difference} N·m",
                joint.letter()
            );
        }
    }

    //= thesis (3.3) test
    #[test]
    fn gain_steps_down_at_200_milliampere() {
        for (joint, step_nm) in [
            (Joint::A, 0.0152),
            (Joint::E, 0.0188),
            (Joint::B, 0.0076),
            (Joint::C, 0.0004),
        ] {
            let below = torque_gain(joint, 0.2_f64.next_down());
            let step = below - torque_gain(joint, 0.2);
            assert!((step - step_nm).abs() < 1e-12, "{} {step}", joint.letter());
        }
    }

    #[test]
    fn two_currents_give_the_same_torque_just_below_200_milliampere() {
        for (joint, width_a) in [
            (Joint::A, 0.0025),
            (Joint::E, 0.0044),
            (Joint::B, 0.0016),
            (Joint::C, 0.0001),
        ] {
            let fit = torque_gain_fit(joint);
            let lower = (torque_gain(joint, 0.2) - fit.k_2) / fit.k_1;
            assert!(
                (0.2 - lower - width_a).abs() < 6e-5,
                "{} {lower}",
                joint.letter()
            );
            assert!((torque_gain(joint, lower) - torque_gain(joint, 0.2)).abs() < 1e-12);
        }
    }

    #[test]
    fn the_gain_of_a_turns_down_beyond_1_64_ampere() {
        assert!(torque_gain(Joint::A, 1.71) < torque_gain(Joint::A, 1.637));
        assert!(torque_gain(Joint::A, 1.571) < torque_gain(Joint::A, 1.637));
    }
}
