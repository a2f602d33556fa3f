//! This file says which current asks a brake for a torque: the inverse of the torque gain.

use rigproof_spec::tables::{BrakeTable, GAIN_BREAK_A};

use crate::number::{Real, least};

/// The current gain block of §3.6 for one brake, with what is computed from its table once.
///
/// # Differs from the thesis
///
/// Of the two currents of a torque inside the step at 0.2 A the smaller one (gap `gain-inverse`).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurrentGain<R> {
    off_state_nm: R,
    k_1_nm_per_a: R,
    /// Torque at which the quadratic piece starts, N·m, at [`GAIN_BREAK_A`].
    start_nm: R,
    greatest_nm: R,
    greatest_a: R,
    /// k4², 4·k3, k4 and k5.
    quadratic: [R; 4],
}

impl<R: Real> CurrentGain<R> {
    /// The inverse of a brake's torque gain.
    pub fn new(table: &BrakeTable) -> CurrentGain<R> {
        let fit = &table.torque_gain;
        let [_, greatest_a] = table.current_range_a;
        let start_nm = fit.k_3 * GAIN_BREAK_A * GAIN_BREAK_A + fit.k_4 * GAIN_BREAK_A + fit.k_5;
        CurrentGain {
            off_state_nm: R::of(fit.k_2),
            k_1_nm_per_a: R::of(fit.k_1),
            start_nm: R::of(start_nm),
            greatest_nm: R::of(table.greatest_nm()),
            greatest_a: R::of(greatest_a),
            quadratic: [fit.k_4 * fit.k_4, 4.0 * fit.k_3, fit.k_4, fit.k_5].map(R::of),
        }
    }

    /// Torque at the greatest current, N·m.
    pub const fn greatest_nm(&self) -> R {
        self.greatest_nm
    }

    /// The current for a torque, A: 0 to the table's greatest one; zero for a torque up to the off-state torque and for what is no
    /// number, the greatest one for a torque that cannot be reached.
    //= thesis (3.3)
    pub fn current_a(&self, torque_nm: R) -> R {
        if torque_nm >= self.greatest_nm {
            return self.greatest_a;
        }
        let above_nm = torque_nm - self.off_state_nm;
        if above_nm > R::zero() {
            least(self.between(torque_nm, above_nm), self.greatest_a)
        } else {
            R::zero()
        }
    }

    fn between(&self, torque_nm: R, above_nm: R) -> R {
        let break_a = R::of(GAIN_BREAK_A);
        let linear_a = above_nm / self.k_1_nm_per_a;
        // A torque between the end of the linear and a higher start of the quadratic piece takes the break itself.
        if linear_a < break_a || torque_nm <= self.start_nm {
            return least(linear_a, break_a);
        }
        let [k_4_squared, four_k_3, k_4, k_5] = self.quadratic;
        let above_nm = torque_nm - k_5;
        let root = (k_4_squared + four_k_3 * above_nm).sqrt();
        (above_nm + above_nm) / (k_4 + root)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rigproof_spec::joint::Joint;
    use rigproof_spec::tables::brake_table;

    //= thesis (3.3) test
    #[test]
    fn the_current_of_a_printed_torque_is_the_current_it_was_printed_at() {
        // (3.3) for brake A at 0.8 A: −3.68·0.64 + 12.05·0.8 − 0.84 = 6.4448 N·m; at 0.15 A: 6.09·0.15 + 0.22 = 1.1335 N·m.
        let gain = CurrentGain::<f64>::new(&brake_table(Joint::A));
        assert!((gain.current_a(6.4448) - 0.8).abs() < 1e-15);
        assert!((gain.current_a(1.1335) - 0.15).abs() < 1e-15);
    }

    #[test]
    fn what_cannot_be_reached_takes_the_end_of_the_range() {
        let gain = CurrentGain::<f32>::new(&brake_table(Joint::E));
        for torque_nm in [-3.7, 0.0, 0.13, 0.21, f32::NAN, f32::NEG_INFINITY] {
            assert_eq!(gain.current_a(torque_nm), 0.0);
        }
        for torque_nm in [5.941, 7.3, 1e9, f32::INFINITY] {
            assert_eq!(gain.current_a(torque_nm), 1.0);
        }
    }

    #[test]
    fn a_torque_in_the_step_takes_the_smaller_current() {
        // Brake E steps from 1.074 down to 1.0552 N·m.
        let gain = CurrentGain::<f64>::new(&brake_table(Joint::E));
        let current_a = gain.current_a(1.0631);
        assert!(current_a > 0.195 && current_a < 0.2);
        assert!(gain.current_a(1.0741) > 0.2);
    }

    #[test]
    fn the_torque_where_the_linear_piece_ends_is_given_by_the_quadratic_one() {
        // Brake E at 0.2 A gives 1.0552 N·m, the linear piece would end at 1.074 N·m.
        let gain = CurrentGain::<f64>::new(&brake_table(Joint::E));
        let mut torque_nm = 1.073_999_999_999_99;
        while (torque_nm - gain.off_state_nm) / gain.k_1_nm_per_a < GAIN_BREAK_A {
            torque_nm = f64::next_up(torque_nm);
        }
        assert_eq!(
            (torque_nm - gain.off_state_nm) / gain.k_1_nm_per_a,
            GAIN_BREAK_A
        );
        let current_a = gain.current_a(torque_nm);
        assert!(
            (-2.72 * current_a * current_a + 9.37 * current_a - 0.71 - torque_nm).abs() < 1e-14
        );
    }
}
