//! This file computes the yield torque of the magnetorheological brake, thesis (3.2) to (3.7) and §3.4.3.
//!
//! The yield is positive and its sign comes from the velocity (§5.3.4), so the brake never drives.

use crate::effect::Effect;
use crate::form::Form;
use rigproof_spec::joint::Joint;
use rigproof_spec::tables::{
    Edge, GREATEST_CURRENT_A, GREATEST_TESTED_SPEED_RPM, LEAST_TESTED_CURRENT_A,
    LEAST_TESTED_SPEED_RPM, TimeConstantFit, TorqueGainFit, backlash_width_deg, time_constant_fit,
    torque_gain_fit,
};
use rigproof_spec::units::{RAD_PER_DEG, rpm_from_rad_s};

/// Reverse travel from which the shaft counts as inside the backlash window, degrees (decision 0004).
const BACKLASH_ENTRY_DEG: f64 = 0.02;
/// Distance from its target at which a fall of the torque is over, N·m (decision 0003).
const FALL_END_NM: f64 = 0.005;

/// What a brake undergoes over one step: the current and the speed that hold, and the position at its end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BrakeStep {
    /// Length of the step, s.
    pub step_s: f64,
    /// Coil current, A.
    pub current_a: f64,
    /// Shaft position at the end, rad.
    pub position_rad: f64,
    /// Shaft speed, rad/s.
    pub speed_rad_s: f64,
}

/// Yield torque of this room's brake with nothing hidden, N·m: what it resists with in motion, one value at the end of
/// every step. The brake starts settled, without current, at `start_rad` in the middle of its backlash.
///
/// Recordings are made with the same code, so that another implementation can be compared with it.
pub fn brake_yield_nm(joint: Joint, start_rad: f64, steps: &[BrakeStep]) -> Vec<f64> {
    let mut brake = Brake::new(joint, None, start_rad);
    let mut time_s = 0.0;
    steps
        .iter()
        .map(|step| {
            time_s += step.step_s;
            brake.step(time_s, step);
            brake.yield_nm()
        })
        .collect()
}

/// One brake, optionally with a hidden effect.
#[derive(Clone, Debug)]
pub struct Brake {
    gain: TorqueGainFit,
    rising: TimeConstantFit,
    falling: TimeConstantFit,
    hidden: Option<Effect>,
    width_rad: f64,
    window_low_rad: f64,
    play_current_a: f64,
    /// The current that a fall of the torque began at.
    origin_a: f64,
    inside: bool,
    torque_nm: f64,
    lagged_nm: f64,
}

impl Brake {
    /// The brake of a joint, settled without current, its shaft in the middle of the backlash window.
    pub fn new(joint: Joint, hidden: Option<Effect>, position_rad: f64) -> Brake {
        let width_rad = match hidden {
            Some(hidden) if hidden.form == Form::Backlash => hidden.first(),
            _ => backlash_width_deg(joint) * RAD_PER_DEG,
        };
        let mut brake = Brake {
            gain: torque_gain_fit(joint),
            rising: time_constant_fit(joint, Edge::Rising),
            falling: time_constant_fit(joint, Edge::Falling),
            hidden,
            width_rad,
            window_low_rad: position_rad - 0.5 * width_rad,
            play_current_a: 0.0,
            origin_a: 0.0,
            inside: false,
            torque_nm: 0.0,
            lagged_nm: 0.0,
        };
        brake.follow(position_rad);
        brake.torque_nm = brake.target_nm(0.0, 0.0);
        brake.lagged_nm = brake.torque_nm;
        brake
    }

    /// Resisting torque in motion, N·m, at least zero.
    pub fn yield_nm(&self) -> f64 {
        self.lagged_nm
    }

    /// Moves the brake over a step that ends at `time_s`.
    pub fn step(&mut self, time_s: f64, step: &BrakeStep) {
        self.follow(step.position_rad);
        let current_a = self.magnetic_current_a(step.current_a);
        let target_nm = self.target_nm(time_s, current_a);
        let excess_nm = self.torque_nm - target_nm;
        if excess_nm <= FALL_END_NM {
            self.origin_a = current_a;
        }
        let time_constant_s = if excess_nm > 0.0 {
            time_constant_s(
                &self.falling,
                Edge::Falling,
                self.origin_a,
                step.speed_rad_s,
            )
        } else {
            time_constant_s(&self.rising, Edge::Rising, current_a, step.speed_rad_s)
        };
        let [rising, falling] = match self.hidden {
            Some(hidden) if hidden.form == Form::TimeConstants && hidden.acts(time_s) => {
                let [rising, falling, ..] = hidden.values;
                [1.0 + rising, 1.0 + falling]
            }
            _ => [1.0; 2],
        };
        let slower = if excess_nm > 0.0 { falling } else { rising };
        self.torque_nm = relax(
            self.torque_nm,
            target_nm,
            step.step_s / (slower * time_constant_s),
        );
        self.lagged_nm = match self.acting(Form::Lag, time_s) {
            Some(lag_s) => relax(self.lagged_nm, self.torque_nm, step.step_s / lag_s),
            None => self.torque_nm,
        };
    }

    /// The number of the hidden effect, if it has this form and acts.
    fn acting(&self, form: Form, time_s: f64) -> Option<f64> {
        let hidden = self
            .hidden
            .filter(|hidden| hidden.form == form && hidden.acts(time_s));
        hidden.map(|hidden| hidden.first())
    }

    /// The backlash window is held while the shaft is inside and dragged by its edge otherwise (§3.4.3).
    fn follow(&mut self, position_rad: f64) {
        let high_rad = self.window_low_rad + self.width_rad;
        if position_rad <= self.window_low_rad {
            self.window_low_rad = position_rad;
            self.inside = false;
        } else if position_rad >= high_rad {
            self.window_low_rad = position_rad - self.width_rad;
            self.inside = false;
        } else {
            let depth_rad = (position_rad - self.window_low_rad).min(high_rad - position_rad);
            self.inside |= depth_rad > BACKLASH_ENTRY_DEG * RAD_PER_DEG;
        }
    }

    fn magnetic_current_a(&mut self, current_a: f64) -> f64 {
        let Some(hidden) = self.hidden.filter(|hidden| hidden.form == Form::Play) else {
            return current_a;
        };
        let half = 0.5 * hidden.first();
        self.play_current_a = self
            .play_current_a
            .clamp(current_a - half, current_a + half)
            .max(0.0);
        self.play_current_a
    }

    fn target_nm(&self, time_s: f64, current_a: f64) -> f64 {
        let factor = 1.0 + self.acting(Form::Gain, time_s).unwrap_or(0.0);
        let current_a = if self.inside { 0.0 } else { current_a };
        factor * torque_gain_nm(&self.gain, current_a)
    }
}

/// Steady torque of a current, N·m (3.3), with its step at 0.2 A (decision 0006), between the off-state torque and the
/// torque at 1 A (decision 0001).
fn torque_gain_nm(fit: &TorqueGainFit, current_a: f64) -> f64 {
    let fitted_nm = if current_a < 0.2 {
        fit.k_1 * current_a + fit.k_2
    } else {
        (fit.k_3 * current_a + fit.k_4) * current_a + fit.k_5
    };
    fitted_nm.clamp(fit.off_state_nm(), fit.greatest_nm())
}

/// Time constant, s (3.5) to (3.7), at the nearest tested current and speed (decision 0002).
fn time_constant_s(fit: &TimeConstantFit, edge: Edge, current_a: f64, speed_rad_s: f64) -> f64 {
    let speed_rpm =
        rpm_from_rad_s(speed_rad_s.abs()).clamp(LEAST_TESTED_SPEED_RPM, GREATEST_TESTED_SPEED_RPM);
    if speed_rpm >= edge.threshold_rpm() {
        return fit.a_avg_s;
    }
    let current_a = current_a.clamp(LEAST_TESTED_CURRENT_A, GREATEST_CURRENT_A);
    let log_speed = libm::log2(speed_rpm);
    let without_current = (fit.a_4 * log_speed + fit.a_2) * log_speed + fit.a_6;
    let per_ampere = (fit.a_5 * log_speed + fit.a_3) * log_speed + fit.a_1;
    without_current + per_ampere * current_a
}

fn relax(value: f64, target: f64, ratio: f64) -> f64 {
    target + (value - target) * libm::exp(-ratio)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn settled(brake: &mut Brake, position_rad: f64, current_a: f64) -> f64 {
        for _ in 0..20_000 {
            brake.step(0.0, &step(position_rad, 2.0, current_a, 5e-5));
        }
        brake.yield_nm()
    }

    fn step(position_rad: f64, speed_rad_s: f64, current_a: f64, step_s: f64) -> BrakeStep {
        BrakeStep {
            step_s,
            current_a,
            position_rad,
            speed_rad_s,
        }
    }

    #[test]
    fn the_torque_settles_on_the_quadratic_of_table_3_2() {
        let mut brake = Brake::new(Joint::E, None, 0.0);
        // -2.72·0.25 + 9.37·0.5 - 0.71 by hand.
        assert!((settled(&mut brake, 0.3, 0.5) - 3.295).abs() < 1e-9);
        // 4.32·0.1 + 0.21 by hand.
        assert!((settled(&mut brake, 0.3, 0.1) - 0.642).abs() < 1e-9);
        // At 1 A: -2.72 + 9.37 - 0.71 by hand; more current gives no more, a negative one no less than off-state.
        assert!((settled(&mut brake, 0.3, 1.4) - 5.94).abs() < 1e-9);
        assert!((settled(&mut brake, 0.3, -0.3) - 0.21).abs() < 1e-9);
    }

    #[test]
    fn inside_the_window_only_the_off_state_is_left() {
        let mut brake = Brake::new(Joint::C, None, 0.0);
        let degree = RAD_PER_DEG;
        settled(&mut brake, 10.0 * degree, 0.9);
        let full_nm = settled(&mut brake, 9.99 * degree, 0.9);
        assert!(full_nm > 5.0, "0.01° of reversal is no entry: {full_nm}");
        assert!((settled(&mut brake, 9.0 * degree, 0.9) - 0.27).abs() < 1e-9);
        assert!((settled(&mut brake, 8.1 * degree, 0.9) - full_nm).abs() < 1e-9);
    }

    #[test]
    fn a_brake_starts_in_the_middle_of_its_window() {
        // Brake B, 1.5°: free for 0.75° either way.
        for way in [1.0, -1.0] {
            let mut brake = Brake::new(Joint::B, None, 0.6);
            let at = |travel_deg: f64| 0.6 + way * travel_deg * RAD_PER_DEG;
            assert!((settled(&mut brake, at(0.74), 0.8) - 0.24).abs() < 1e-9);
            assert!(settled(&mut brake, at(0.76), 0.8) > 5.0);
        }
    }

    #[test]
    fn a_fall_takes_the_current_it_began_at() {
        // Brake A at 0.5 rpm, log2 is -1, falling from 0.93 A:
        // (0.0010 + 0.0017 + 0.0007)·0.93 + 0.0009 + 0.0004 + 0.0066 = 0.011062 s; the target's current would give 8.6 ms.
        let slow_rad_s = 0.052_359_877_559_829_9;
        let mut brake = Brake::new(Joint::A, None, 0.2);
        settled(&mut brake, 0.2, 0.93);
        // The current goes down in two steps of 2.5 ms; the fall is over after neither.
        for current_a in [0.1, 0.0] {
            let target_nm = 6.09 * current_a + 0.22;
            let before_nm = brake.yield_nm();
            for _ in 0..50 {
                brake.step(0.0, &step(0.2, slow_rad_s, current_a, 5e-5));
            }
            let expected_nm = target_nm + (before_nm - target_nm) * libm::exp(-0.0025 / 0.011_062);
            assert!((brake.yield_nm() - expected_nm).abs() < 1e-9);
        }
    }

    #[test]
    fn time_constants_are_those_of_the_tested_range() {
        let fit = time_constant_fit(Joint::A, Edge::Rising);
        let rising_s = |current_a, rpm| {
            time_constant_s(&fit, Edge::Rising, current_a, rpm * 0.104_719_755_119_659_8)
        };
        // 1 rpm: log2 is zero, so a1·I + a6 = 0.0697·0.5 + 0.0025.
        assert!((rising_s(0.5, -1.0) - 0.037_35).abs() < 1e-12);
        // 0.5 rpm: log2 is -1, (0.0697 + 0.0623 + 0.0141)·0.2 - 0.0129 - 0.0055 + 0.0025.
        assert!((rising_s(0.2, 0.5) - 0.013_32).abs() < 1e-12);
        for (current_a, rpm) in [(0.0, 0.0), (0.1, 0.3), (-0.4, 0.01)] {
            assert_eq!(rising_s(current_a, rpm), rising_s(0.2, 0.0));
        }
        assert_eq!(rising_s(1.3, 0.2), rising_s(1.0, 0.0));
        assert_eq!(rising_s(0.7, 400.0), 0.0075);
    }
}
