//! This file says how a brake resists from one step to the next.

use rigproof_spec::joint::Joint;
use rigproof_spec::tables::{BrakeTable, Edge, brake_table};

use super::time_constant::{SpeedBand, slowed, time_constant_within};
use super::{Backlash, ENTRY_TRAVEL_DEG, fitted_torque_gain, table_time_constant};

/// Excess of the yield torque over its target below which a fall counts as finished, N·m: half the last digit
/// printed in table 3.2.
const SETTLED_NM: f64 = 0.005;

/// One brake in motion: the first-order system (3.2) with its backlash.
///
/// ```text
/// τ(s) = K(I, θ, τ_{i-1}) / (a(I, ω)·s + 1)
/// ```
///
/// | symbol | here | unit |
/// |---|---|---|
/// | τ | [`Brake::yield_torque`], positive (§5.3.4) | N·m |
/// | K | [`torque_gain`](super::torque_gain), or the off-state torque inside the [`Backlash`] | N·m |
/// | a | [`table_time_constant`] | s |
/// | I, θ, ω | `current_a`, `theta_rad`, `omega_rad_s` | A, rad, rad/s |
///
/// # Differs from the thesis
///
/// (3.2) filters the yield torque, not a signed torque (erratum `signed-filter`), and K is kept between the off-state
/// torque and the torque at 1 A (§5.3.4).
///
/// ```
/// use rigproof_model::brake::Brake;
/// use rigproof_spec::joint::Joint;
/// let mut brake = Brake::new(Joint::A, 0.31);
/// // 30 ms after a step to 0.8 A at 2.7 rad/s: four time constants of 7.5 ms towards 6.4448 N·m.
/// let resistance_nm = brake.step(0.8, 0.391, 2.7, 0.03);
/// let expected_nm = 6.4448 - (6.4448 - 0.22) * libm::exp(-4.0);
/// assert!((resistance_nm - expected_nm).abs() < 1e-12);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Brake {
    table: BrakeTable,
    backlash: Backlash,
    yield_nm: f64,
    fall_origin_a: f64,
}

/// Everything that the next step of a brake depends on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BrakeState {
    /// Yield torque, N·m.
    pub yield_nm: f64,
    /// Current that the last fall started from, A.
    pub fall_origin_a: f64,
    /// The boundary θ1 of its backlash, rad.
    pub boundary_rad: f64,
    /// Whether the shaft is inside its backlash.
    pub is_inside: bool,
}

impl Brake {
    /// A brake without current, settled, its shaft at `theta_rad` in the middle of the backlash.
    pub fn new(joint: Joint, theta_rad: f64) -> Brake {
        Brake::of(brake_table(joint), theta_rad)
    }

    /// A brake of somebody's own table, as [`Brake::new`].
    pub fn of(table: BrakeTable, theta_rad: f64) -> Brake {
        Brake {
            table,
            backlash: Backlash::of_width(table.backlash_width_deg, ENTRY_TRAVEL_DEG, theta_rad),
            yield_nm: table.torque_gain.off_state_nm(),
            fall_origin_a: 0.0,
        }
    }

    /// A brake of the thesis in a state that it has reached.
    pub fn resumed(joint: Joint, state: &BrakeState) -> Brake {
        Brake {
            backlash: Backlash::resumed(joint, state.boundary_rad, state.is_inside),
            yield_nm: state.yield_nm,
            fall_origin_a: state.fall_origin_a,
            ..Brake::new(joint, state.boundary_rad)
        }
    }

    /// The same brake with its shaft at `theta_rad` in the middle of a backlash that is entered after `entry_deg` of travel, for
    /// studies of what the entry travel changes.
    pub fn with_backlash_entry(self, theta_rad: f64, entry_deg: f64) -> Brake {
        Brake {
            backlash: Backlash::of_width(self.table.backlash_width_deg, entry_deg, theta_rad),
            ..self
        }
    }

    /// The table that it goes by.
    pub const fn table(&self) -> BrakeTable {
        self.table
    }

    /// The same brake with its rising and falling time constants times so much, in the state that it is in.
    pub fn slowed(self, times: [f64; 2]) -> Brake {
        Brake {
            table: slowed(self.table, times),
            ..self
        }
    }

    /// The same brake with another table, its shaft at `theta_rad` in the middle of the backlash.
    pub fn with_table(self, table: BrakeTable, theta_rad: f64) -> Brake {
        Brake {
            table,
            backlash: Backlash::of_width(table.backlash_width_deg, ENTRY_TRAVEL_DEG, theta_rad),
            ..self
        }
    }

    /// Advances by `dt_s` and returns the resistance at its end, N·m: positive in the sense of the velocity, so that
    /// the torque on the shaft is minus it. Zero at standstill, where any torque up to [`Brake::yield_torque`] may act.
    ///
    /// `current_a` and `omega_rad_s` hold over the step, `theta_rad` is the angle at its end. The update is the exact
    /// solution of (3.2) over the step, so its length matters only where the motion changes.
    pub fn step(&mut self, current_a: f64, theta_rad: f64, omega_rad_s: f64, dt_s: f64) -> f64 {
        let inside = self.backlash.update(theta_rad);
        let target_nm = self.target_nm(current_a, inside);
        let a_s = self.time_constant_s(current_a, target_nm, omega_rad_s);
        self.yield_nm = self.within_limits(first_order(self.yield_nm, target_nm, dt_s, a_s));
        if omega_rad_s > 0.0 {
            self.yield_nm
        } else if omega_rad_s < 0.0 {
            -self.yield_nm
        } else {
            0.0
        }
    }

    /// What the brake does at a current and a speed until the current, the form of its time constant, the backlash or the
    /// direction of its change is another one.
    pub fn course(&self, current_a: f64, omega_rad_s: f64) -> Course {
        let target_nm = self.target_nm(current_a, self.backlash.is_inside());
        let origin_a = if self.yield_nm <= target_nm + SETTLED_NM {
            current_a
        } else {
            self.fall_origin_a
        };
        let (edge, current_a) = if self.yield_nm <= target_nm {
            (Edge::Rising, current_a)
        } else {
            (Edge::Falling, origin_a)
        };
        Course {
            table: self.table,
            target_nm,
            edge,
            current_a,
            band: SpeedBand::of(&self.table, omega_rad_s, edge),
            origin_a,
        }
    }

    /// The yield torque after a course has run for `exponent` time constants, ∫dt/a, N·m.
    //= thesis (3.2)
    pub fn yield_along(&self, course: &Course, exponent: f64) -> f64 {
        let change_nm = course.target_nm - self.yield_nm;
        self.within_limits(self.yield_nm - change_nm * libm::expm1(-exponent))
    }

    /// Advances along a course by `exponent` time constants, with the shaft at `theta_rad` at its end.
    pub fn follow(&mut self, course: &Course, exponent: f64, theta_rad: f64) {
        self.yield_nm = self.yield_along(course, exponent);
        self.fall_origin_a = course.origin_a;
        self.backlash.update(theta_rad);
    }

    /// The greatest torque the brake resists with now, N·m: what it exerts in motion, a bound at standstill.
    pub fn yield_torque(&self) -> f64 {
        self.yield_nm
    }

    /// The backlash and where it stands.
    pub fn backlash(&self) -> &Backlash {
        &self.backlash
    }

    fn target_nm(&self, current_a: f64, inside: bool) -> f64 {
        if inside {
            self.table.torque_gain.off_state_nm()
        } else {
            self.within_limits(fitted_torque_gain(&self.table.torque_gain, current_a))
        }
    }

    fn within_limits(&self, torque_nm: f64) -> f64 {
        let (off_state_nm, greatest_nm) = (
            self.table.torque_gain.off_state_nm(),
            self.table.greatest_nm(),
        );
        if torque_nm < off_state_nm {
            off_state_nm
        } else if torque_nm > greatest_nm {
            greatest_nm
        } else {
            torque_nm
        }
    }

    /// The time constant towards `target_nm`: of the target current while rising, of the current that the fall
    /// started from while falling (gap `time-constant-current`).
    fn time_constant_s(&mut self, current_a: f64, target_nm: f64, omega_rad_s: f64) -> f64 {
        if self.yield_nm <= target_nm + SETTLED_NM {
            self.fall_origin_a = current_a;
        }
        if self.yield_nm <= target_nm {
            table_time_constant(&self.table, current_a, omega_rad_s, Edge::Rising)
        } else {
            table_time_constant(&self.table, self.fall_origin_a, omega_rad_s, Edge::Falling)
        }
    }
}

/// One course of a [`Brake`]: its yield torque on the way to one target with one form of the time constant.
///
/// A simulation that couples brake and motion integrates 1/a along the course and ends its step where the course does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Course {
    table: BrakeTable,
    target_nm: f64,
    edge: Edge,
    current_a: f64,
    band: SpeedBand,
    origin_a: f64,
}

impl Course {
    /// 1/a at a speed, 1/s.
    pub fn rate_per_s(&self, omega_rad_s: f64) -> f64 {
        1.0 / time_constant_within(
            &self.table,
            self.current_a,
            omega_rad_s,
            self.edge,
            self.band,
        )
    }
}

/// The value after `dt_s` of a first-order system on its way from `start` to `target`.
//= thesis (3.2)
fn first_order(start: f64, target: f64, dt_s: f64, a_s: f64) -> f64 {
    start - (target - start) * libm::expm1(-dt_s / a_s)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Travel that takes any brake out of its backlash.
    const CLEAR_RAD: f64 = 0.047;

    fn settled(joint: Joint, current_a: f64, omega_rad_s: f64) -> Brake {
        let mut brake = Brake::new(joint, 0.31);
        brake.step(
            current_a,
            0.31 + CLEAR_RAD * omega_rad_s.signum(),
            omega_rad_s,
            9.7,
        );
        brake
    }

    //= thesis (3.2) test
    #[test]
    fn a_fall_is_as_fast_as_the_current_it_started_from() {
        // Brake A at 0.5 rpm from 0.93 A: 0.0010*0.93 + 0.0009 + 0.0017*0.93 + 0.0004 + 0.0007*0.93 + 0.0066
        // = 0.011062 s; the target's 0 A would give 0.0079 s as printed.
        let omega_rad_s = core::f64::consts::PI / 60.0;
        let mut brake = settled(Joint::A, 0.93, omega_rad_s);
        let start_nm = brake.yield_torque();
        for _ in 0..7 {
            brake.step(0.0, 0.4, omega_rad_s, 0.0013);
        }
        let expected_nm = 0.22 + (start_nm - 0.22) * libm::exp(-7.0 * 0.0013 / 0.011_062);
        assert!((brake.yield_torque() - expected_nm).abs() < 1e-9);
    }

    #[test]
    fn standstill_gives_a_bound_and_no_torque() {
        let mut brake = settled(Joint::C, 0.67, 1.9);
        assert_eq!(brake.step(0.67, 0.36, 0.0, 0.0011), 0.0);
        // -2.21*0.67² + 8.48*0.67 - 0.39 = 4.299531
        assert!((brake.yield_torque() - 4.299_531).abs() < 1e-9);
    }

    #[test]
    fn a_current_beyond_one_ampere_gives_no_more_than_one_ampere() {
        let brake = settled(Joint::A, 1.37, 1.9);
        assert!((brake.yield_torque() - 7.53).abs() < 1e-9);
        assert!((settled(Joint::A, -0.41, 1.9).yield_torque() - 0.22).abs() < 1e-12);
    }

    #[test]
    fn a_current_that_is_no_number_shows_in_every_later_torque() {
        let mut brake = settled(Joint::B, 0.67, 1.9);
        for current_a in [f64::NAN, 0.67, f64::NAN] {
            assert!(brake.step(current_a, 0.37, 1.9, 0.0011).is_nan());
            assert!(brake.yield_torque().is_nan());
        }
    }

    #[test]
    fn inside_the_backlash_the_torque_decays_to_off_state() {
        let mut brake = settled(Joint::E, 0.83, 2.3);
        let theta_2_rad = brake.backlash().boundaries_rad().1;
        for step in 1..=60 {
            let theta_rad = theta_2_rad - 0.0004 * f64::from(step);
            let resistance_nm = brake.step(0.83, theta_rad, -0.4, 0.001);
            assert_eq!(resistance_nm, -brake.yield_torque());
        }
        assert!(brake.backlash().is_inside());
        assert!((brake.yield_torque() - 0.21).abs() < 1e-3);
    }
}
