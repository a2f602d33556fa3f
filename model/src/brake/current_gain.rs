//! This file says which current asks a brake for a torque: the inverse of the torque gain.

use rigproof_spec::tables::{BrakeTable, GAIN_BREAK_A};

use super::fitted_torque_gain;

/// Current for a desired torque, A: the current gain block of §3.6, the inverse of (3.3).
///
/// | symbol | here | unit | range |
/// |---|---|---|---|
/// | K | `torque_nm`: the magnitude that is wanted | N·m | – |
/// | I | the result | A | 0 to the table's greatest current |
///
/// Zero for a torque up to the off-state torque, which the brake resists with anyway; the greatest current for a torque
/// that it cannot reach, and zero for what is no number. Exact everywhere else: the torque gain of the result is the torque
/// that was asked for.
///
/// # Differs from the thesis
///
/// The pieces of (3.3) step down at 0.2 A, so that torques in the step have two currents. The smaller one is given
/// (gap `gain-inverse`).
///
/// ```
/// use rigproof_model::brake::{current_gain, torque_gain};
/// use rigproof_spec::{joint::Joint, tables::brake_table};
/// let current_a = current_gain(&brake_table(Joint::A), 6.4448);
/// assert!((current_a - 0.8).abs() < 1e-12);
/// assert!((torque_gain(Joint::A, current_a) - 6.4448).abs() < 1e-12);
/// ```
//= thesis (3.3)
pub fn current_gain(table: &BrakeTable, torque_nm: f64) -> f64 {
    let fit = &table.torque_gain;
    let [_, greatest_a] = table.current_range_a;
    if torque_nm.is_nan() || torque_nm <= fit.k_2 {
        return 0.0;
    }
    let linear_a = (torque_nm - fit.k_2) / fit.k_1;
    // A torque between the end of the linear and a higher start of the quadratic piece takes the break itself.
    if linear_a < GAIN_BREAK_A || torque_nm <= fitted_torque_gain(fit, GAIN_BREAK_A) {
        return linear_a.min(GAIN_BREAK_A).min(greatest_a);
    }
    if torque_nm >= table.greatest_nm() {
        return greatest_a;
    }
    // k3·I² + k4·I + (k5 − K) = 0 on the rising branch, in the form that loses no digits and takes k3 = 0.
    let discriminant = fit.k_4 * fit.k_4 - 4.0 * fit.k_3 * (fit.k_5 - torque_nm);
    let current_a = 2.0 * (torque_nm - fit.k_5) / (fit.k_4 + libm::sqrt(discriminant));
    if current_a < greatest_a {
        current_a
    } else {
        greatest_a
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::brake::torque_gain;
    use rigproof_spec::joint::Joint;
    use rigproof_spec::tables::brake_table;

    #[test]
    fn the_torque_of_the_current_is_the_torque_asked_for() {
        for joint in Joint::ALL {
            let table = brake_table(joint);
            let (least, greatest) = (table.torque_gain.k_2, table.greatest_nm());
            for share in 1..1000 {
                let torque_nm = least + (greatest - least) * f64::from(share) / 1000.7;
                let current_a = current_gain(&table, torque_nm);
                assert!((0.0..=1.0).contains(&current_a));
                let found_nm = torque_gain(joint, current_a);
                assert!(
                    (found_nm - torque_nm).abs() < 1e-12,
                    "{} {torque_nm} {found_nm}",
                    joint.letter()
                );
            }
        }
    }

    #[test]
    fn a_torque_with_two_currents_takes_the_smaller_one() {
        for joint in Joint::ALL {
            let table = brake_table(joint);
            let high_nm = torque_gain(joint, 0.2_f64.next_down());
            let low_nm = torque_gain(joint, 0.2);
            let current_a = current_gain(&table, 0.37 * high_nm + 0.63 * low_nm);
            assert!(current_a < 0.2 && current_a > 0.195, "{current_a}");
            // Just above the step the current jumps to the quadratic piece, by at most 4.5 mA.
            let jump_a =
                current_gain(&table, high_nm + 1e-9) - current_gain(&table, high_nm - 1e-9);
            assert!(
                (0.0..0.0045).contains(&jump_a),
                "{} {jump_a}",
                joint.letter()
            );
        }
    }

    #[test]
    fn what_cannot_be_reached_takes_the_end_of_the_range() {
        let table = brake_table(Joint::E);
        for torque_nm in [-3.7, 0.0, 0.13, 0.21, f64::NAN] {
            assert_eq!(current_gain(&table, torque_nm), 0.0);
        }
        for torque_nm in [5.94, 7.3, 1e9, f64::INFINITY] {
            assert_eq!(current_gain(&table, torque_nm), 1.0);
        }
    }

    #[test]
    fn a_table_whose_pieces_leave_a_gap_takes_the_break() {
        let mut table = brake_table(Joint::B);
        table.torque_gain.k_1 = 4.1;
        let gap_nm = 0.5 * (4.1 * 0.2 + 0.24 + torque_gain(Joint::B, 0.2));
        assert_eq!(current_gain(&table, gap_nm), 0.2);
    }
}
