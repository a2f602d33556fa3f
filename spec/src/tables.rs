//! This file holds the numbers the thesis prints about its brakes: tables 3.1, 3.2 and 3.3, and what was tested.
//!
//! The same tables stand a second time as CSV under `thesis/tables/`; a test compares the two.

use crate::joint::Joint;

/// Largest current the amplifiers are set to deliver, A (§3.2).
pub const GREATEST_CURRENT_A: f64 = 1.0;
/// Smallest current of the step tests other than zero, A (§3.4).
pub const LEAST_TESTED_CURRENT_A: f64 = 0.2;
/// Lowest speed of the step tests, rpm: the motor could hold no lower one (§3.4).
pub const LEAST_TESTED_SPEED_RPM: f64 = 0.5;
/// Current at which the torque gain changes from its linear to its quadratic piece, A (3.3).
pub const GAIN_BREAK_A: f64 = 0.2;
/// Highest speed of the step tests, rpm (§3.4).
pub const GREATEST_TESTED_SPEED_RPM: f64 = 64.0;

/// Backlash width of a brake, degrees (table 3.1).
pub const fn backlash_width_deg(joint: Joint) -> f64 {
    match joint {
        Joint::A => 0.0,
        Joint::E => 1.7,
        Joint::B => 1.5,
        Joint::C => 1.8,
    }
}

/// One row of table 3.2: the coefficients of the torque gain (3.3).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TorqueGainFit {
    /// k1, N·m/A.
    pub k_1: f64,
    /// k2, N·m: the off-state torque, the least a moving brake resists with.
    pub k_2: f64,
    /// k3, N·m/A².
    pub k_3: f64,
    /// k4, N·m/A.
    pub k_4: f64,
    /// k5, N·m.
    pub k_5: f64,
    /// Coefficient of determination of the fit.
    pub r_squared: f64,
}

impl TorqueGainFit {
    /// Torque without current, N·m.
    pub const fn off_state_nm(&self) -> f64 {
        self.k_2
    }

    /// Torque at [`GREATEST_CURRENT_A`], 1 A, where every power of the current is one, N·m.
    pub const fn greatest_nm(&self) -> f64 {
        self.k_3 + self.k_4 + self.k_5
    }
}

/// The torque gain coefficients of a brake (table 3.2).
pub const fn torque_gain_fit(joint: Joint) -> TorqueGainFit {
    let [k_1, k_2, k_3, k_4, k_5, r_squared] = match joint {
        Joint::A => [6.09, 0.22, -3.68, 12.05, -0.84, 0.9977],
        Joint::E => [4.32, 0.21, -2.72, 9.37, -0.71, 0.9901],
        Joint::B => [4.72, 0.24, -2.14, 8.76, -0.49, 0.9880],
        Joint::C => [4.74, 0.27, -2.21, 8.48, -0.39, 0.9802],
    };
    TorqueGainFit {
        k_1,
        k_2,
        k_3,
        k_4,
        k_5,
        r_squared,
    }
}

/// The direction in which a brake's torque is moving: the two halves of table 3.3.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Edge {
    /// The torque grows.
    Rising,
    /// The torque decays.
    Falling,
}

impl Edge {
    /// Both edges, in the order of table 3.3.
    pub const ALL: [Edge; 2] = [Edge::Rising, Edge::Falling];

    /// The word of table 3.3, in lower case.
    pub const fn name(self) -> &'static str {
        match self {
            Edge::Rising => "rising",
            Edge::Falling => "falling",
        }
    }

    /// Speed from which the time constant is constant, rpm (3.5), (3.6).
    pub const fn threshold_rpm(self) -> f64 {
        match self {
            Edge::Rising => 4.0,
            Edge::Falling => 2.0,
        }
    }
}

/// One row of table 3.3: the coefficients of the time constant (3.5) or (3.6), with the current in A, the speed
/// as log2 of rpm and the time in s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimeConstantFit {
    /// Time constant above the speed threshold, s.
    pub a_avg_s: f64,
    /// Coefficient of I.
    pub a_1: f64,
    /// Coefficient of `ω_L`.
    pub a_2: f64,
    /// Coefficient of `I·ω_L`.
    pub a_3: f64,
    /// Coefficient of `ω_L²`.
    pub a_4: f64,
    /// Coefficient of `I·ω_L²`.
    pub a_5: f64,
    /// Constant term.
    pub a_6: f64,
    /// Coefficient of determination of the fit.
    pub r_squared: f64,
}

/// The time constant coefficients of a brake (table 3.3).
pub const fn time_constant_fit(joint: Joint, edge: Edge) -> TimeConstantFit {
    let [a_avg_s, a_1, a_2, a_3, a_4, a_5, a_6, r_squared] = match edge {
        Edge::Rising => rising(joint),
        Edge::Falling => falling(joint),
    };
    TimeConstantFit {
        a_avg_s,
        a_1,
        a_2,
        a_3,
        a_4,
        a_5,
        a_6,
        r_squared,
    }
}

#[rustfmt::skip]
const fn rising(joint: Joint) -> [f64; 8] {
    match joint {
        Joint::A => [0.0075, 0.0697, 0.0129, -0.0623, -0.0055, 0.0141, 0.0025, 0.9782],
        Joint::E => [0.0070, 0.0317, 0.0063, -0.0344, -0.0017, 0.0094, 0.0012, 0.9839],
        Joint::B => [0.0075, 0.0260, 0.0046, -0.0278, -0.0019, 0.0076, 0.0055, 0.9807],
        Joint::C => [0.0064, 0.0451, -0.0088, -0.0185, 0.0055, -0.0020, 0.0019, 0.9698],
    }
}

#[rustfmt::skip]
const fn falling(joint: Joint) -> [f64; 8] {
    match joint {
        Joint::A => [0.0061, 0.0010, -0.0009, -0.0017, 0.0004, 0.0007, 0.0066, 0.9388],
        Joint::E => [0.0054, 0.0017, -0.0002, -0.0017, 0.0006, 0.0000, 0.0050, 0.8473],
        Joint::B => [0.0057, 0.0018, -0.0007, -0.0015, 0.0011, -0.0003, 0.0052, 0.8548],
        Joint::C => [0.0052, 0.0045, -0.0003, -0.0017, 0.0032, -0.0028, 0.0023, 0.9267],
    }
}

/// Everything a brake is described by: tables 3.1 to 3.3, and the range that its numbers were measured over.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BrakeTable {
    /// Backlash width, degrees.
    pub backlash_width_deg: f64,
    /// Torque gain (3.3).
    pub torque_gain: TorqueGainFit,
    /// Rising time constant (3.5).
    pub rising: TimeConstantFit,
    /// Falling time constant (3.6).
    pub falling: TimeConstantFit,
    /// Smallest current of the steps other than zero, and the greatest one, A.
    pub current_range_a: [f64; 2],
    /// Lowest and highest speed of the steps, rpm.
    pub speed_range_rpm: [f64; 2],
}

impl BrakeTable {
    /// Torque at the greatest current, N·m: the most the brake resists with.
    pub const fn greatest_nm(&self) -> f64 {
        let TorqueGainFit { k_3, k_4, k_5, .. } = self.torque_gain;
        let [_, current_a] = self.current_range_a;
        k_3 * current_a * current_a + k_4 * current_a + k_5
    }

    /// The time constant coefficients of an edge.
    pub const fn time_constant(&self, edge: Edge) -> &TimeConstantFit {
        match edge {
            Edge::Rising => &self.rising,
            Edge::Falling => &self.falling,
        }
    }
}

/// The table of one of the thesis's brakes.
pub const fn brake_table(joint: Joint) -> BrakeTable {
    BrakeTable {
        backlash_width_deg: backlash_width_deg(joint),
        torque_gain: torque_gain_fit(joint),
        rising: time_constant_fit(joint, Edge::Rising),
        falling: time_constant_fit(joint, Edge::Falling),
        current_range_a: [LEAST_TESTED_CURRENT_A, GREATEST_CURRENT_A],
        speed_range_rpm: [LEAST_TESTED_SPEED_RPM, GREATEST_TESTED_SPEED_RPM],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_brake_reaches_its_rated_torque_at_the_greatest_current() {
        for joint in Joint::ALL {
            // §3.1 rates the brake at 5.6 N·m; the four fits give 7.53, 5.94, 6.13 and 5.88.
            assert!(
                torque_gain_fit(joint).greatest_nm() > 5.6,
                "{}",
                joint.letter()
            );
        }
    }
}
