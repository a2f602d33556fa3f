//! This file is a simulated operator: it sees where the tip is, late, pushes with a bounded force and trembles.

use core::f64::consts::PI;
use std::collections::VecDeque;

use nalgebra::Vector2;

use crate::control::path::Path;
use crate::error::ModelError;

/// What pushes the tip of a rig.
pub trait Hand {
    /// The force on the tip, x and y, N, over the tick of `step_s` that starts with the tip at a point, m, and moving, m/s.
    fn push(&mut self, tip_m: [f64; 2], tip_velocity_m_s: [f64; 2], step_s: f64) -> [f64; 2];
}

/// A force that never changes (§6.4), x and y, N.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConstantPush(pub [f64; 2]);

impl Hand for ConstantPush {
    fn push(&mut self, _: [f64; 2], _: [f64; 2], _: f64) -> [f64; 2] {
        self.0
    }
}

/// The abilities of a simulated operator (decision 0047).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Abilities {
    /// From what is seen to what is done about it, s.
    pub delay_s: f64,
    /// Time constant of the muscles, s.
    pub muscle_s: f64,
    /// Greatest force, N.
    pub greatest_force_n: f64,
    /// Speed that is meant along the path, m/s.
    pub speed_m_s: f64,
    /// Force for a lack of speed, N·s/m.
    pub urge_n_s_per_m: f64,
    /// Rate at which the force grows while speed is lacking, N/m.
    pub impatience_n_per_m: f64,
    /// Force for a seen distance from the path, N/m.
    pub correction_n_per_m: f64,
    /// Force for a seen speed across the path, N·s/m.
    pub damping_n_s_per_m: f64,
    /// Viscosity of the arm itself, without delay, N·s/m.
    pub arm_n_s_per_m: f64,
    /// Root mean square of the slow error of the aim, m.
    pub aim_error_m: f64,
    /// Root mean square of the tremor's force, N.
    pub tremor_n: f64,
}

impl Abilities {
    /// An adult following a line with care (decision 0047).
    pub const CAREFUL: Abilities = Abilities {
        delay_s: 0.16,
        muscle_s: 0.1,
        greatest_force_n: 20.0,
        speed_m_s: 0.1,
        urge_n_s_per_m: 25.0,
        impatience_n_per_m: 40.0,
        correction_n_per_m: 60.0,
        damping_n_s_per_m: 20.0,
        arm_n_s_per_m: 10.0,
        aim_error_m: 0.008,
        tremor_n: 0.15,
    };
}

/// How many sines make up the aim's error, and how many the tremor.
const SINES: usize = 7;

/// A simulated operator who follows a path.
#[derive(Clone, Debug, PartialEq)]
pub struct Operator<P> {
    path: P,
    abilities: Abilities,
    aim: [Sine; SINES],
    tremor: [[Sine; SINES]; 2],
    seen: VecDeque<([f64; 2], [f64; 2])>,
    time_s: f64,
    patience_n: f64,
    force_n: Vector2<f64>,
}

/// One sine of unit amplitude.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Sine {
    omega_rad_s: f64,
    phase_rad: f64,
}

impl<P: Path> Operator<P> {
    /// An operator at the start of a path; the same seed gives the same operator.
    ///
    /// # Errors
    /// [`ModelError::SettingRange`]: an ability is not a finite number from 0 to 10⁶, or the delay more than 1 s.
    pub fn new(path: P, abilities: Abilities, seed: u64) -> Result<Operator<P>, ModelError> {
        for (setting, value, greatest, unit) in [
            ("the delay", abilities.delay_s, 1.0, "s"),
            ("the muscles' time constant", abilities.muscle_s, 1.0, "s"),
            ("the greatest force", abilities.greatest_force_n, 1e6, "N"),
            ("the speed meant", abilities.speed_m_s, 1e6, "m/s"),
            ("the urge", abilities.urge_n_s_per_m, 1e6, "N·s/m"),
            ("the impatience", abilities.impatience_n_per_m, 1e6, "N/m"),
            ("the correction", abilities.correction_n_per_m, 1e6, "N/m"),
            ("the damping", abilities.damping_n_s_per_m, 1e6, "N·s/m"),
            ("the arm's viscosity", abilities.arm_n_s_per_m, 1e6, "N·s/m"),
            ("the error of the aim", abilities.aim_error_m, 1e6, "m"),
            ("the tremor", abilities.tremor_n, 1e6, "N"),
        ] {
            if !(0.0..=greatest).contains(&value) {
                let least = 0.0;
                return Err(ModelError::SettingRange {
                    setting,
                    value,
                    least,
                    greatest,
                    unit,
                });
            }
        }
        let mut draw = Draw(seed);
        Ok(Operator {
            path,
            abilities,
            aim: draw.sines(0.15, 1.0),
            tremor: [draw.sines(8.0, 12.0), draw.sines(8.0, 12.0)],
            seen: VecDeque::new(),
            time_s: 0.0,
            patience_n: 0.0,
            force_n: Vector2::zeros(),
        })
    }

    /// What was seen one delay ago; the first sight until then.
    fn seen(&mut self, now: ([f64; 2], [f64; 2]), step_s: f64) -> ([f64; 2], [f64; 2]) {
        self.seen.push_back(now);
        let ticks = libm::round(self.abilities.delay_s / step_s) as usize;
        while self.seen.len() > ticks + 1 {
            self.seen.pop_front();
        }
        self.seen.front().copied().unwrap_or(now)
    }

    /// The force that is meant, before the muscles, N.
    fn meant(&mut self, tip_m: [f64; 2], velocity_m_s: [f64; 2], step_s: f64) -> Vector2<f64> {
        let abilities = self.abilities;
        let (tip_m, velocity_m_s) = self.seen((tip_m, velocity_m_s), step_s);
        let nearest = self.path.nearest(tip_m);
        let left = Vector2::new(-nearest.tangent.y, nearest.tangent.x);
        let velocity = Vector2::from(velocity_m_s);
        let lack_m_s = abilities.speed_m_s - nearest.tangent.dot(&velocity);
        self.patience_n = (self.patience_n + abilities.impatience_n_per_m * lack_m_s * step_s)
            .clamp(0.0, abilities.greatest_force_n);
        let along_n = abilities.urge_n_s_per_m * lack_m_s + self.patience_n;
        let offset_m = nearest.offset_m - abilities.aim_error_m * sum(&self.aim, self.time_s);
        let across_n = abilities.correction_n_per_m * offset_m
            + abilities.damping_n_s_per_m * left.dot(&velocity);
        nearest.tangent * along_n - left * across_n
    }
}

impl<P: Path> Hand for Operator<P> {
    fn push(&mut self, tip_m: [f64; 2], tip_velocity_m_s: [f64; 2], step_s: f64) -> [f64; 2] {
        let abilities = self.abilities;
        let meant_n = self.meant(tip_m, tip_velocity_m_s, step_s);
        let share = if abilities.muscle_s > 0.0 {
            -libm::expm1(-step_s / abilities.muscle_s)
        } else {
            1.0
        };
        self.force_n += (meant_n - self.force_n) * share;
        let [tremor_x, tremor_y] = self.tremor.map(|sines| sum(&sines, self.time_s));
        self.time_s += step_s;
        let tremor_n = Vector2::new(tremor_x, tremor_y) * abilities.tremor_n;
        let nearest = self.path.nearest(tip_m);
        let velocity = Vector2::from(tip_velocity_m_s);
        let across = velocity - nearest.tangent * nearest.tangent.dot(&velocity);
        let push_n = self.force_n + tremor_n - across * abilities.arm_n_s_per_m;
        let magnitude_n = libm::hypot(push_n.x, push_n.y);
        let scale = if magnitude_n > abilities.greatest_force_n {
            abilities.greatest_force_n / magnitude_n
        } else {
            1.0
        };
        (push_n * scale).into()
    }
}

/// Sum of sines of random phase, of root mean square one.
fn sum(sines: &[Sine; SINES], time_s: f64) -> f64 {
    let total: f64 = sines
        .iter()
        .map(|sine| libm::sin(sine.omega_rad_s * time_s + sine.phase_rad))
        .sum();
    total * libm::sqrt(2.0 / SINES as f64)
}

/// Numbers that follow from a seed: the mixing function of SplitMix64 (Steele, Lea and Flood 2014).
struct Draw(u64);

impl Draw {
    fn share(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^= z >> 31;
        (z >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn sines(&mut self, least_hz: f64, greatest_hz: f64) -> [Sine; SINES] {
        core::array::from_fn(|_| Sine {
            omega_rad_s: 2.0 * PI * (least_hz + (greatest_hz - least_hz) * self.share()),
            phase_rad: 2.0 * PI * self.share(),
        })
    }
}
