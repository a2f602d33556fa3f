//! This file controls one joint without a robot: the virtual spring and the virtual wall of §3.6.

use rigproof_spec::tables::BrakeTable;
use rigproof_spec::units::deg_from_rad;

use super::current_gain;

/// Spring constant of the virtual spring, N·m/° (§3.6).
pub const SPRING_NM_PER_DEG: f64 = 0.05;
/// Spring constant of the virtual wall, N·m/° (§3.6).
pub const WALL_NM_PER_DEG: f64 = 500.0;

/// The look-up table of §3.6: the torque that a virtual spring asks for at a position.
///
/// | symbol | here | unit | range |
/// |---|---|---|---|
/// | k | `stiffness_nm_per_deg` | N·m/° | > 0 |
/// | – | `start_rad`: where the spring begins; it is compressed by growing angles | rad | – |
/// | – | `most_nm`: where the table ends (gap `wall-torque`) | N·m | ≥ 0 |
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VirtualSpring {
    /// Spring constant, N·m/°.
    pub stiffness_nm_per_deg: f64,
    /// Angle at which the spring begins, rad.
    pub start_rad: f64,
    /// The most torque that it asks for, N·m.
    pub most_nm: f64,
}

impl VirtualSpring {
    /// Desired torque at a position, N·m: against the compression, so never negative.
    ///
    /// ```
    /// use rigproof_model::brake::{SPRING_NM_PER_DEG, VirtualSpring};
    /// use rigproof_spec::units::rad_from_deg;
    /// let spring = VirtualSpring {
    ///     stiffness_nm_per_deg: SPRING_NM_PER_DEG,
    ///     start_rad: rad_from_deg(12.0),
    ///     most_nm: 4.0,
    /// };
    /// // 46° into the spring: 0.05·46 = 2.3 N·m.
    /// assert!((spring.desired_torque(rad_from_deg(58.0)) - 2.3).abs() < 1e-12);
    /// assert_eq!(spring.desired_torque(0.1), 0.0);
    /// ```
    pub fn desired_torque(&self, theta_rad: f64) -> f64 {
        let compressed_deg = deg_from_rad(theta_rad - self.start_rad);
        let torque_nm = self.stiffness_nm_per_deg * compressed_deg;
        if torque_nm > self.most_nm {
            self.most_nm
        } else if torque_nm > 0.0 {
            torque_nm
        } else {
            0.0
        }
    }
}

/// The controllers of figures 3.19 and 3.20: look-up table, proportional feedback of the torque, inverse torque gain.
///
/// ```text
/// I = K⁻¹(τ_d + g·(τ_d − τ))        g = 0 in open loop
/// ```
///
/// | symbol | here | unit |
/// |---|---|---|
/// | τ_d | [`VirtualSpring::desired_torque`] | N·m |
/// | τ | `torque_nm`: metered, positive against growing angles | N·m |
/// | g | `feedback_gain` | 1 |
/// | K⁻¹ | [`current_gain`] | A |
///
/// # Differs from the thesis
///
/// The text does not say where the feedback term enters; here it is a torque, before the inverse gain (gap
/// `torque-feedback`).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OneJoint {
    /// What the controller knows of its brake.
    pub table: BrakeTable,
    /// What it lets the hand feel.
    pub spring: VirtualSpring,
    /// Feedback gain; 0 is the open loop.
    pub feedback_gain: f64,
}

impl OneJoint {
    /// Current at a position and a metered torque, A.
    ///
    /// Zero when the torque shows motion out of the spring, which a brake cannot push.
    pub fn current(&self, theta_rad: f64, torque_nm: f64) -> f64 {
        let desired_nm = self.spring.desired_torque(theta_rad);
        if desired_nm == 0.0 || torque_nm < 0.0 {
            return 0.0;
        }
        let asked_nm = desired_nm + self.feedback_gain * (desired_nm - torque_nm);
        current_gain(&self.table, asked_nm)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::brake::{Brake, torque_gain};
    use rigproof_spec::joint::Joint;
    use rigproof_spec::tables::brake_table;
    use rigproof_spec::units::rad_from_deg;

    fn spring() -> VirtualSpring {
        VirtualSpring {
            stiffness_nm_per_deg: SPRING_NM_PER_DEG,
            start_rad: 0.13,
            most_nm: 4.3,
        }
    }

    #[test]
    fn the_open_loop_asks_for_the_torque_of_the_spring() {
        for joint in Joint::ALL {
            let control = OneJoint {
                table: brake_table(joint),
                spring: spring(),
                feedback_gain: 0.0,
            };
            for angle_deg in [17.3, 41.9, 73.7] {
                let theta_rad = 0.13 + rad_from_deg(angle_deg);
                let current_a = control.current(theta_rad, 0.7);
                let torque_nm = torque_gain(joint, current_a);
                assert!((torque_nm - 0.05 * angle_deg).abs() < 1e-12, "{joint:?}");
            }
        }
    }

    #[test]
    fn feedback_closes_the_same_share_of_a_torque_that_is_off() {
        // A brake that gives 11 % more than its table: the loop settles where τ = 1.11·K(I), off-state apart.
        let joint = Joint::B;
        let mut plant = brake_table(joint);
        for k in [
            &mut plant.torque_gain.k_1,
            &mut plant.torque_gain.k_3,
            &mut plant.torque_gain.k_4,
        ] {
            *k *= 1.11;
        }
        plant.torque_gain.k_5 *= 1.11;
        let settled = |feedback_gain: f64| {
            let control = OneJoint {
                table: brake_table(joint),
                spring: spring(),
                feedback_gain,
            };
            let mut brake = Brake::of(plant, 0.2);
            let mut torque_nm = 0.0;
            for step in 1..=600 {
                // Far in the spring, where its table has ended.
                let theta_rad = 3.1 + 0.001 * f64::from(step);
                let current_a = control.current(theta_rad, torque_nm);
                torque_nm = brake.step(current_a, theta_rad, 1.0, 0.001);
            }
            torque_nm - 4.3
        };
        let (open, closed) = (settled(0.0), settled(1.7));
        assert!((open - 0.11 * 4.3).abs() < 1e-9, "{open}");
        // 1.11·(τ_d + g·(τ_d − τ)) = τ: the error shrinks by 1 + 1.11·g.
        assert!(
            (closed - open / (1.0 + 1.11 * 1.7)).abs() < 1e-6,
            "{closed}"
        );
    }

    #[test]
    fn no_current_flows_on_the_way_out() {
        let control = OneJoint {
            table: brake_table(Joint::C),
            spring: spring(),
            feedback_gain: 0.9,
        };
        assert_eq!(control.current(1.3, -0.27), 0.0);
        assert_eq!(control.current(0.11, 0.27), 0.0);
        assert!(control.current(1.3, 0.27) > 0.1);
    }
}
