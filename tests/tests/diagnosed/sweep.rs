//! This file is a static sweep of a brake, or of friction over speed, with one thing about it other than its description says.

use super::recording::{Noise, Recording};

const EXAMPLE: &str = include_str!("../../../rigs/sweep.toml");
const NOISE_NM: f64 = 0.01;
/// The steady speeds, rad/s.
const SPEEDS_RAD_S: [f64; 4] = [1.0, -4.0, 10.0, -1.5];
/// Rows up, and as many down.
const ROWS: usize = 21;
const FULL_A: f64 = 2.0;

/// What is other than described.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Hidden {
    Nothing,
    /// The torque of the field bends towards a current, A, as a hyperbolic tangent does.
    Bends(f64),
    /// The torque grows with the square of the current up to the same end.
    Square,
    /// Iron that remembers: the current goes through a play of a half width, A.
    Remembers(f64),
    /// Drag, N·m·s/rad.
    Drag(f64),
    /// Without a field: Coulomb friction, N·m, with a peak above it that falls like a bell over a speed, rad/s.
    Peak(f64, f64, f64),
}

impl Hidden {
    fn currents_a(self) -> Vec<f64> {
        let up = (0..ROWS).map(|k| FULL_A * k as f64 / (ROWS - 1) as f64);
        let up: Vec<f64> = up.collect();
        let twice = [0, 1].into_iter();
        let one = || up.iter().chain(up.iter().rev()).copied();
        twice.flat_map(|_| one()).collect()
    }

    fn torques_nm(self, currents_a: &[f64], speeds_rad_s: &[f64]) -> Vec<f64> {
        let mut played_a = 0.0_f64;
        let rows = currents_a.iter().zip(speeds_rad_s);
        let each = rows.map(|(current_a, speed)| {
            let acting_a = match self {
                Hidden::Bends(limit_a) => limit_a * libm::tanh(current_a / limit_a),
                Hidden::Square => current_a * current_a / FULL_A,
                Hidden::Remembers(half_a) => {
                    played_a = played_a.clamp(current_a - half_a, current_a + half_a);
                    played_a
                }
                _ => *current_a,
            };
            let drag = match self {
                Hidden::Drag(drag) => drag * speed,
                _ => 0.0,
            };
            match self {
                Hidden::Peak(level, peak, at) => {
                    let share = libm::exp(-(speed / at).powi(2));
                    (level + peak * share) * speed.signum()
                }
                _ => (0.1 + acting_a) * speed.signum() + drag,
            }
        });
        each.collect()
    }
}

/// The sweep of the example; without a field one over speeds alone.
pub fn recording(hidden: Hidden, seed: u64) -> Recording {
    let mut noise = Noise::new(seed);
    let currents_a = hidden.currents_a();
    let is_map = matches!(hidden, Hidden::Peak(..));
    let speeds_rad_s: Vec<f64> = (0..currents_a.len())
        .map(|k| match is_map {
            true => {
                let fraction = (k / 2) as f64 / (currents_a.len() / 2) as f64;
                let size = 0.05 * libm::pow(400.0, fraction);
                if k % 2 == 0 { size } else { -size }
            }
            false => SPEEDS_RAD_S[k % SPEEDS_RAD_S.len()],
        })
        .collect();
    let torques_nm = noise.on(hidden.torques_nm(&currents_a, &speeds_rad_s), NOISE_NM);
    let mut columns = vec![("w", "rad/s", speeds_rad_s), ("torque", "N·m", torques_nm)];
    let mut rig = EXAMPLE.to_owned();
    match is_map {
        true => {
            let (before, _) = EXAMPLE.split_once("# What the data sheet").unwrap();
            rig = before.replace("current = { channel = \"I\", unit = \"A\" }\n", "");
        }
        false => columns.push(("I", "A", currents_a)),
    }
    // The column of time that is written with it is not looked at.
    Recording::new("sweep".to_owned(), rig, 1.0, columns)
}
