//! This file says when a brake sticks and what it then exerts, as the thesis simulates it: (5.67), (5.68).
#![expect(clippy::indexing_slicing, reason = "indices run over the four joints")]

use nalgebra::{Matrix2, Matrix4, Vector2, Vector4};

use super::acceleration::Equations;
use super::coordinates::{JOINTS, forces};
use super::lumped::{Memory, lumped};
use crate::error::ModelError;

/// How the joints A, E, B, C accelerate with the torques on them: θ̈ = W·τ + θ̈₀.
///
/// This is what (5.68) leaves when the multipliers and the other coordinates are dropped: "a linear equation for applied
/// torque … that does not involve the Lagrange multipliers". W has rank 2, so that no three torques follow from it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Joints {
    /// W, 4×4, rows and columns A, E, B, C, 1/(kg·m²).
    pub compliance: Matrix4<f64>,
    /// θ̈₀, the accelerations without joint torques, rad/s².
    pub free: Vector4<f64>,
}

/// The joints' part of (5.68) under a tip force, N.
///
/// # Errors
/// [`ModelError::NoAcceleration`].
//= thesis (5.68)
pub fn joints(equations: &Equations, tip_force_n: [f64; 2]) -> Result<Joints, ModelError> {
    let inverse = equations.inverse()?;
    let free = equations
        .acceleration(&forces(tip_force_n, [0.0; 4]))?
        .q_ddot;
    Ok(Joints {
        compliance: Matrix4::from_fn(|i, j| inverse[(JOINTS[i], JOINTS[j])]),
        free: Vector4::from_fn(|i, _| free[JOINTS[i]]),
    })
}

impl Joints {
    /// The accelerations of the joints A, E, B, C under brake torques, rad/s².
    pub fn accelerations_rad_s2(&self, torques_nm: [f64; 4]) -> [f64; 4] {
        (self.compliance * Vector4::from(torques_nm) + self.free).into()
    }

    /// The torque that keeps one joint from accelerating while the others have `torques_nm`, N·m.
    pub fn applied_on_one(&self, torques_nm: [f64; 4], held: usize) -> f64 {
        let mut others = torques_nm;
        others[held] = 0.0;
        -self.accelerations_rad_s2(others)[held] / self.compliance[(held, held)]
    }

    /// The torques that keep two joints from accelerating while the others have `torques_nm`, N·m; not numbers where the two
    /// joints turn in proportion.
    pub fn applied_on_two(&self, torques_nm: [f64; 4], [i, j]: [usize; 2]) -> [f64; 2] {
        let mut others = torques_nm;
        (others[i], others[j]) = (0.0, 0.0);
        let accelerations = self.accelerations_rad_s2(others);
        let w = &self.compliance;
        let pair = Matrix2::new(w[(i, i)], w[(i, j)], w[(j, i)], w[(j, j)]);
        let right = Vector2::new(-accelerations[i], -accelerations[j]);
        pair.lu()
            .solve(&right)
            .map_or([f64::NAN; 2], |applied| applied.into())
    }
}

/// The Karnopp rule for one brake: its torque on the joint, N·m (5.67).
///
/// ```text
///     τ_y    |ω| ≥ δω
/// τ = τ_y    |ω| < δω, |τ_a| > τ_y
///     τ_a    |ω| < δω, |τ_a| ≤ τ_y
/// ```
///
/// | symbol | here | unit |
/// |---|---|---|
/// | ω | `omega_rad_s` | rad/s |
/// | δω | `dead_band_rad_s` | rad/s |
/// | `τ_a` | `applied_nm`: what would hold the joint | N·m |
/// | `τ_y` | `yield_nm`, positive | N·m |
///
/// # Differs from the thesis
///
/// (5.67) prints magnitudes; the text gives the sign: that of minus the velocity, and of the torque that held the joint
/// where the velocity is very small (erratum `karnopp-sign`).
//= thesis (5.67)
pub fn karnopp(omega_rad_s: f64, dead_band_rad_s: f64, applied_nm: f64, yield_nm: f64) -> f64 {
    if omega_rad_s.abs() >= dead_band_rad_s {
        -omega_rad_s.signum() * yield_nm
    } else if applied_nm.abs() > yield_nm {
        applied_nm.signum() * yield_nm
    } else {
        applied_nm
    }
}

/// The brakes of a rig under the thesis's rules, with what these remember from one time step to the next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KarnoppBrakes {
    /// δω, rad/s.
    pub dead_band_rad_s: f64,
    memory: Memory,
}

impl KarnoppBrakes {
    /// Brakes with a dead band of `dead_band_rad_s` that remember nothing.
    pub fn new(dead_band_rad_s: f64) -> KarnoppBrakes {
        KarnoppBrakes {
            dead_band_rad_s,
            memory: Memory::default(),
        }
    }

    /// The torques of the brakes A, E, B, C on their joints and which of them stick (§5.3.5).
    ///
    /// One stuck brake takes the torque that holds its joint; two take the torques that hold both; if one of two is asked for
    /// more than its yield, it slips and the other is asked again alone. Three or four go by [`lumped`]. A yield of zero is no
    /// brake.
    pub fn torques_nm(
        &mut self,
        joints: &Joints,
        joint_rates_rad_s: [f64; 4],
        yields_nm: [f64; 4],
    ) -> ([f64; 4], [bool; 4]) {
        let slow = [0, 1, 2, 3]
            .map(|i| yields_nm[i] > 0.0 && joint_rates_rad_s[i].abs() < self.dead_band_rad_s);
        let mut torques_nm = [0, 1, 2, 3].map(|i| {
            if slow[i] {
                0.0
            } else {
                karnopp(joint_rates_rad_s[i], 0.0, 0.0, yields_nm[i])
            }
        });
        let stuck: Vec<usize> = (0..4).filter(|&i| slow[i]).collect();
        match *stuck.as_slice() {
            [] => {}
            [i] => self.hold_one(joints, i, yields_nm, &mut torques_nm),
            [i, j] => {
                let applied = joints.applied_on_two(torques_nm, [i, j]);
                let excess = [
                    applied[0].abs() / yields_nm[i],
                    applied[1].abs() / yields_nm[j],
                ];
                if excess.iter().all(|&share| share <= 1.0) {
                    (torques_nm[i], torques_nm[j]) = (applied[0], applied[1]);
                } else {
                    // The one that is asked for more of its yield lets go first.
                    let [first, second] = if excess[0] >= excess[1] {
                        [i, j]
                    } else {
                        [j, i]
                    };
                    let asked = if first == i { applied[0] } else { applied[1] };
                    torques_nm[first] = karnopp(0.0, 1.0, asked, yields_nm[first]);
                    self.hold_one(joints, second, yields_nm, &mut torques_nm);
                }
            }
            _ => lumped(joints, &stuck, yields_nm, &mut self.memory, &mut torques_nm),
        }
        if stuck.len() < 3 {
            self.memory = Memory::of(torques_nm);
        }
        let held = [0, 1, 2, 3].map(|i| slow[i] && torques_nm[i].abs() < yields_nm[i]);
        (torques_nm, held)
    }

    fn hold_one(&self, joints: &Joints, i: usize, yields_nm: [f64; 4], torques_nm: &mut [f64; 4]) {
        let applied_nm = joints.applied_on_one(*torques_nm, i);
        torques_nm[i] = karnopp(0.0, self.dead_band_rad_s, applied_nm, yields_nm[i]);
    }
}
