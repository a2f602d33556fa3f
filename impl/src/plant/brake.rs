//! This file says how a brake's yield torque moves over a step and what its mean is.

use rigproof_spec::tables::{BrakeTable, Edge, GAIN_BREAK_A, TimeConstantFit, TorqueGainFit};
use rigproof_spec::units::{rad_s_from_rpm, rpm_from_rad_s};

use super::backlash::{Backlash, Crossing, target_nm};
use super::decay::decayed;
use crate::number::{least, most};

/// Excess of the yield torque over its target below which a fall counts as finished, N·m: half the last digit
/// printed in table 3.2.
const SETTLED_NM: f64 = 0.005;
/// Distance from the target that is no more than rounding, N·m: from there the yield torque stands.
const ROUNDING_NM: f64 = 1e-15;

/// A brake's table, with what is computed from it once.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Characteristic {
    table: BrakeTable,
    /// Off-state torque and torque at the greatest current, N·m.
    limits_nm: [f64; 2],
    speed_range_rad_s: [f64; 2],
    /// Binary logarithm of the slowest measured speed in rpm, at which every slower one is taken.
    slowest_l: f64,
}

/// The state of one brake: the first-order system (3.2) with its backlash.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Brake {
    backlash: Backlash,
    yield_nm: f64,
    fall_origin_a: f64,
    current_a: f64,
}

impl Characteristic {
    /// What a table says.
    pub fn new(table: &BrakeTable) -> Characteristic {
        let [slowest_rpm, _] = table.speed_range_rpm;
        Characteristic {
            table: *table,
            limits_nm: [table.torque_gain.off_state_nm(), table.greatest_nm()],
            speed_range_rad_s: table.speed_range_rpm.map(rad_s_from_rpm),
            slowest_l: libm::log2(slowest_rpm),
        }
    }

    /// Torque without current, N·m.
    pub fn off_state_nm(&self) -> f64 {
        let [off_nm, _] = self.limits_nm;
        off_nm
    }

    /// What the yield torque goes towards at a current, A, inside the backlash or not, N·m.
    #[inline(always)]
    pub fn target_nm(&self, inside: bool, current_a: f64) -> f64 {
        let asked_nm = gain_nm(&self.table.torque_gain, current_a);
        target_nm(inside, asked_nm, self.limits_nm)
    }

    /// Time constant a at the nearest measured current and speed, s (3.5), (3.6).
    //= thesis (3.5)
    //= thesis (3.6)
    #[inline(always)]
    pub fn time_constant_s(&self, current_a: f64, speed_rad_s: f64, edge: Edge) -> f64 {
        let [slowest_rad_s, _] = self.speed_range_rad_s;
        let speed_rad_s = within(speed_rad_s.abs(), self.speed_range_rad_s);
        let fit: &TimeConstantFit = self.table.time_constant(edge);
        if speed_rad_s >= rad_s_from_rpm(edge.threshold_rpm()) {
            return fit.a_avg_s;
        }
        let current_a = within(current_a, self.table.current_range_a);
        //= thesis (3.7)
        let speed_l = if speed_rad_s <= slowest_rad_s {
            self.slowest_l
        } else {
            libm::log2(rpm_from_rad_s(speed_rad_s))
        };
        let square = fit.a_4 + fit.a_5 * current_a;
        let slope = fit.a_2 + fit.a_3 * current_a;
        fit.a_1 * current_a + fit.a_6 + speed_l * (slope + speed_l * square)
    }
}

/// How a shaft turns over a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turn {
    /// Where it was last looked at and where it is now, rad.
    pub way_rad: [f64; 2],
    /// When that was, before and after the start of the step, s.
    pub around_s: [f64; 2],
    /// Its speed now, rad/s.
    pub speed_rad_s: f64,
    /// The length of the step, s.
    pub step_s: f64,
}

impl Brake {
    /// A brake without current, settled, its shaft at `theta_rad` in the middle of the backlash.
    pub fn new(table: &BrakeTable, theta_rad: f64) -> Brake {
        Brake {
            backlash: Backlash::new(table.backlash_width_deg, theta_rad),
            yield_nm: table.torque_gain.off_state_nm(),
            fall_origin_a: 0.0,
            current_a: 0.0,
        }
    }

    /// Advances over a step at a current, A, and returns the mean of the yield torque, N·m.
    ///
    /// The shaft's angle is known where forces are looked at; where it passed a boundary of the backlash since it was last looked
    /// at, at the moment s after the start of the step, the torque changes course then. Where s lies before the start, the
    /// torque is taken back to s on its old course; what its mean then missed is added to this step's.
    //= thesis (3.2)
    #[inline(always)]
    pub fn step(&mut self, of: &Characteristic, current_a: f64, turn: &Turn) -> f64 {
        let [from_rad, to_rad] = turn.way_rad;
        let was_inside = self.backlash.is_inside();
        let mean_nm = match self.backlash.turn(from_rad, to_rad) {
            None => self.follow(of, was_inside, current_a, turn.speed_rad_s, turn.step_s),
            Some(Crossing { part, inside }) => {
                let [before_s, after_s] = turn.around_s;
                let moment_s = (before_s + after_s) * part - before_s;
                self.cross(
                    of,
                    inside,
                    moment_s,
                    current_a,
                    turn.speed_rad_s,
                    turn.step_s,
                )
            }
        };
        self.current_a = current_a;
        within(mean_nm, of.limits_nm)
    }

    /// Turns the shaft of a brake that has no current and has come to its off-state torque, from one angle to another, rad.
    #[inline(always)]
    pub fn rest(&mut self, of: &Characteristic, [from_rad, to_rad]: [f64; 2]) {
        self.backlash.turn(from_rad, to_rad);
        self.yield_nm = of.off_state_nm();
        (self.current_a, self.fall_origin_a) = (0.0, 0.0);
    }

    /// A step in which a boundary of the backlash was passed, inwards or outwards, at a moment, s after its start; seldom, so kept apart.
    #[inline(never)]
    fn cross(
        &mut self,
        of: &Characteristic,
        inside: bool,
        moment_s: f64,
        current_a: f64,
        speed_rad_s: f64,
        step_s: f64,
    ) -> f64 {
        let last_a = self.current_a;
        let mut impulse = |inside: bool, current_a: f64, time_s: f64| {
            self.follow(of, inside, current_a, speed_rad_s, time_s) * time_s
        };
        let impulses = if moment_s < 0.0 {
            impulse(!inside, last_a, moment_s)
                + impulse(inside, last_a, -moment_s)
                + impulse(inside, current_a, step_s)
        } else {
            impulse(!inside, current_a, moment_s) + impulse(inside, current_a, step_s - moment_s)
        };
        impulses / step_s
    }

    /// Follows one course for a time, s, backwards where that is below zero; returns the mean of the yield torque, N·m.
    #[inline(always)]
    fn follow(
        &mut self,
        of: &Characteristic,
        inside: bool,
        current_a: f64,
        speed_rad_s: f64,
        time_s: f64,
    ) -> f64 {
        let target_nm = of.target_nm(inside, current_a);
        let off_nm = self.yield_nm - target_nm;
        if off_nm <= SETTLED_NM {
            self.fall_origin_a = current_a;
        }
        if off_nm.abs() <= ROUNDING_NM {
            self.yield_nm = target_nm;
            return target_nm;
        }
        let (edge, of_current_a) = if off_nm <= 0.0 {
            (Edge::Rising, current_a)
        } else {
            (Edge::Falling, self.fall_origin_a)
        };
        let a_s = of.time_constant_s(of_current_a, speed_rad_s, edge);
        let exponent = time_s / a_s;
        let mean_share = decayed(exponent);
        self.yield_nm = within(self.yield_nm - off_nm * exponent * mean_share, of.limits_nm);
        target_nm + off_nm * mean_share
    }

    /// The greatest torque the brake resists with now, N·m.
    pub fn yield_nm(&self) -> f64 {
        self.yield_nm
    }

    /// The current that its last fall started from, A.
    pub fn fall_origin_a(&self) -> f64 {
        self.fall_origin_a
    }

    /// Its backlash.
    pub fn backlash(&self) -> &Backlash {
        &self.backlash
    }
}

/// Torque gain K, N·m (3.3).
//= thesis (3.3)
#[inline]
fn gain_nm(fit: &TorqueGainFit, current_a: f64) -> f64 {
    if current_a < GAIN_BREAK_A {
        fit.k_1 * current_a + fit.k_2
    } else {
        (fit.k_3 * current_a + fit.k_4) * current_a + fit.k_5
    }
}

/// The nearest value of a range; what is no number stays none.
#[inline]
fn within(value: f64, [from, to]: [f64; 2]) -> f64 {
    least(to, most(from, value))
}

#[cfg(test)]
mod tests {
    use super::*;
    use rigproof_spec::joint::Joint;
    use rigproof_spec::tables::brake_table;

    fn turning(from_rad: f64, to_rad: f64, step_s: f64) -> Turn {
        Turn {
            way_rad: [from_rad, to_rad],
            around_s: [0.0, step_s],
            speed_rad_s: (to_rad - from_rad) / step_s,
            step_s,
        }
    }

    //= thesis (3.2) test
    //= thesis (3.3) test
    #[test]
    fn a_step_of_current_follows_its_exponential_in_value_and_mean() {
        // Brake A at 2.7 rad/s: 7.5 ms towards 6.4448 N·m, whatever the step.
        let of = Characteristic::new(&brake_table(Joint::A));
        let mut brake = Brake::new(&brake_table(Joint::A), 0.31);
        let (mut theta_rad, mut impulse) = (0.31, 0.0);
        for _ in 0..30 {
            let turn = turning(theta_rad, theta_rad + 2.7e-3, 1e-3);
            impulse += brake.step(&of, 0.8, &turn) * 1e-3;
            theta_rad += 2.7e-3;
        }
        let left_nm = (6.4448 - 0.22) * libm::exp(-4.0);
        assert!((brake.yield_nm() - (6.4448 - left_nm)).abs() < 1e-12);
        let expected = 6.4448 * 0.03 - 0.0075 * (6.4448 - 0.22 - left_nm);
        assert!((impulse - expected).abs() < 1e-13);
    }

    //= thesis (3.5) test
    //= thesis (3.7) test
    #[test]
    fn a_slow_rise_has_its_time_constant_by_hand() {
        // A at 0.73 A and 0.5 rpm: 0.0697·0.73 − 0.0129 + 0.0623·0.73 − 0.0055 + 0.0141·0.73 + 0.0025 = 0.090753 s.
        let slow = core::f64::consts::PI / 60.0;
        let of = Characteristic::new(&brake_table(Joint::A));
        let a_s = of.time_constant_s(0.73, -slow, Edge::Rising);
        assert!((a_s - 0.090_753).abs() < 1e-12);
        assert_eq!(of.time_constant_s(0.73, 0.0, Edge::Rising), a_s);
    }

    //= thesis (3.6) test
    #[test]
    fn a_fall_is_as_fast_as_the_current_it_started_from() {
        // B at 0.5 rpm from 0.91 A: 0.0018·0.91 + 0.0007 + 0.0015·0.91 + 0.0011 − 0.0003·0.91 + 0.0052 = 0.00973 s.
        let of = Characteristic::new(&brake_table(Joint::B));
        let mut brake = Brake::new(&brake_table(Joint::B), 0.31);
        let slow = core::f64::consts::PI / 60.0;
        let mut theta_rad = 0.31;
        let mut turn = |brake: &mut Brake, current_a, step_s| {
            let turn = turning(theta_rad, theta_rad + slow * step_s, step_s);
            theta_rad += slow * step_s;
            brake.step(&of, current_a, &turn);
            brake.yield_nm()
        };
        let mut start_nm = 0.0;
        for _ in 0..900 {
            start_nm = turn(&mut brake, 0.91, 7e-3);
        }
        for _ in 0..5 {
            turn(&mut brake, 0.0, 1.3e-3);
        }
        let expected_nm = 0.24 + (start_nm - 0.24) * libm::exp(-6.5e-3 / 0.00973);
        assert!((brake.yield_nm() - expected_nm).abs() < 1e-9);
    }
}
