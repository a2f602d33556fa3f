//! This file computes the yield torque of the magnetorheological brake, thesis (3.2) to (3.7) and §3.4.3.
//!
//! The yield is positive and its sign comes from the velocity (§5.3.4), so the brake never drives.

use crate::law::{Effect, Law};
use rigproof_spec::joint::Joint;
use rigproof_spec::tables::{
    Edge, TimeConstantFit, TorqueGainFit, backlash_width_deg, time_constant_fit, torque_gain_fit,
};
use rigproof_spec::units::{RAD_PER_DEG, rpm_from_rad_s};

/// Reverse travel from which the shaft counts as inside the backlash window, degrees.
pub const BACKLASH_ENTRY_DEG: f64 = 0.02;
/// Least time constant, s: the fits of table 3.3 turn negative at small currents and low speeds.
pub const LEAST_TIME_CONSTANT_S: f64 = 1e-3;
/// Least speed of the logarithm in (3.7), rpm.
pub const LEAST_SPEED_RPM: f64 = 0.05;

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
    inside: bool,
    torque_nm: f64,
    lagged_nm: f64,
}

impl Brake {
    /// The brake of a joint, settled at a position and a current.
    pub fn new(joint: Joint, hidden: Option<Effect>, position_rad: f64, current_a: f64) -> Brake {
        let width_rad = match hidden {
            Some(Effect {
                law: Law::BacklashWidth { width },
                ..
            }) => width,
            _ => backlash_width_deg(joint) * RAD_PER_DEG,
        };
        let mut brake = Brake {
            gain: torque_gain_fit(joint),
            rising: time_constant_fit(joint, Edge::Rising),
            falling: time_constant_fit(joint, Edge::Falling),
            hidden,
            width_rad,
            window_low_rad: position_rad - width_rad,
            play_current_a: current_a,
            inside: false,
            torque_nm: 0.0,
            lagged_nm: 0.0,
        };
        brake.torque_nm = brake.target_nm(0.0, current_a);
        brake.lagged_nm = brake.torque_nm;
        brake
    }

    /// Resisting torque in motion, N·m, at least zero.
    pub fn yield_nm(&self) -> f64 {
        self.lagged_nm
    }

    /// Moves the brake over one fine step to a position, at a speed and a current.
    pub fn step(
        &mut self,
        time_s: f64,
        position_rad: f64,
        speed_rad_s: f64,
        current_a: f64,
        step_s: f64,
    ) {
        self.follow(position_rad);
        let current_a = self.magnetic_current_a(current_a);
        let target_nm = self.target_nm(time_s, current_a);
        let time_constant_s = if target_nm >= self.torque_nm {
            time_constant_s(&self.rising, Edge::Rising, current_a, speed_rad_s)
        } else {
            time_constant_s(&self.falling, Edge::Falling, current_a, speed_rad_s)
        };
        self.torque_nm = relax(self.torque_nm, target_nm, step_s / time_constant_s);
        self.lagged_nm = match self.hidden {
            Some(Effect {
                law: Law::Lag { time_constant },
                ..
            }) if self.acts(time_s) => {
                relax(self.lagged_nm, self.torque_nm, step_s / time_constant)
            }
            _ => self.torque_nm,
        };
    }

    fn acts(&self, time_s: f64) -> bool {
        self.hidden.is_some_and(|hidden| hidden.acts(time_s))
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
        let Some(Effect {
            law: Law::CurrentHysteresis { width },
            ..
        }) = self.hidden
        else {
            return current_a;
        };
        let half = 0.5 * width;
        self.play_current_a = self
            .play_current_a
            .clamp(current_a - half, current_a + half)
            .max(0.0);
        self.play_current_a
    }

    fn target_nm(&self, time_s: f64, current_a: f64) -> f64 {
        let factor = match self.hidden {
            Some(Effect {
                law: Law::Gain { fraction },
                ..
            }) if self.acts(time_s) => 1.0 + fraction,
            _ => 1.0,
        };
        let current_a = if self.inside { 0.0 } else { current_a };
        factor * torque_gain_nm(&self.gain, current_a)
    }
}

/// Steady torque of a current, N·m (3.3).
fn torque_gain_nm(fit: &TorqueGainFit, current_a: f64) -> f64 {
    if current_a < 0.2 {
        fit.k_1 * current_a + fit.k_2
    } else {
        (fit.k_3 * current_a + fit.k_4) * current_a + fit.k_5
    }
}

/// Time constant, s (3.5) to (3.7), extrapolated below the tested speeds and kept positive.
fn time_constant_s(fit: &TimeConstantFit, edge: Edge, current_a: f64, speed_rad_s: f64) -> f64 {
    let speed_rpm = rpm_from_rad_s(speed_rad_s.abs());
    if speed_rpm >= edge.threshold_rpm() {
        return fit.a_avg_s;
    }
    let log_speed = libm::log2(speed_rpm.max(LEAST_SPEED_RPM));
    let without_current = (fit.a_4 * log_speed + fit.a_2) * log_speed + fit.a_6;
    let per_ampere = (fit.a_5 * log_speed + fit.a_3) * log_speed + fit.a_1;
    (without_current + per_ampere * current_a).max(LEAST_TIME_CONSTANT_S)
}

fn relax(value: f64, target: f64, ratio: f64) -> f64 {
    target + (value - target) * libm::exp(-ratio)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn settled(brake: &mut Brake, position_rad: f64, current_a: f64) -> f64 {
        for _ in 0..20_000 {
            brake.step(0.0, position_rad, 2.0, current_a, 5e-5);
        }
        brake.yield_nm()
    }

    #[test]
    fn the_torque_settles_on_the_quadratic_of_table_3_2() {
        let mut brake = Brake::new(Joint::E, None, 0.0, 0.0);
        // -2.72·0.25 + 9.37·0.5 - 0.71 by hand.
        assert!((settled(&mut brake, 0.3, 0.5) - 3.295).abs() < 1e-9);
        // 4.32·0.1 + 0.21 by hand.
        assert!((settled(&mut brake, 0.3, 0.1) - 0.642).abs() < 1e-9);
    }

    #[test]
    fn inside_the_window_only_the_off_state_is_left() {
        let mut brake = Brake::new(Joint::C, None, 0.0, 0.9);
        let degree = RAD_PER_DEG;
        settled(&mut brake, 10.0 * degree, 0.9);
        let full_nm = settled(&mut brake, 9.99 * degree, 0.9);
        assert!(full_nm > 5.0, "0.01° of reversal is no entry: {full_nm}");
        assert!((settled(&mut brake, 9.0 * degree, 0.9) - 0.27).abs() < 1e-9);
        assert!((settled(&mut brake, 8.1 * degree, 0.9) - full_nm).abs() < 1e-9);
    }

    #[test]
    fn time_constants_stay_positive_at_any_speed() {
        for joint in Joint::ALL {
            for edge in Edge::ALL {
                let fit = time_constant_fit(joint, edge);
                for k in 0..200 {
                    let speed_rad_s = 0.004 * f64::from(k);
                    for current_a in [0.0, 0.03, 0.31, 0.97] {
                        let a_s = time_constant_s(&fit, edge, current_a, speed_rad_s);
                        assert!((LEAST_TIME_CONSTANT_S..1.0).contains(&a_s), "{a_s} s");
                    }
                }
            }
        }
        let fit = time_constant_fit(Joint::A, Edge::Rising);
        // 1 rpm: log2 is zero, so a1·I + a6 = 0.0697·0.5 + 0.0025.
        let a_s = time_constant_s(&fit, Edge::Rising, 0.5, 0.104_719_755_119_659_8);
        assert!((a_s - 0.037_35).abs() < 1e-12);
    }
}
