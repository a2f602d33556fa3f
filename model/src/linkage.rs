//! The five-bar linkage of thesis chapters 4 and 5.1: where its joints are and how its tip moves with them.

mod circles;
pub mod device;
pub mod forward;
pub mod inverse;
pub mod jacobian;
pub mod limits;
pub mod paths;
pub mod printed;
pub mod singularity;
pub mod sweep;
pub mod workspace;

use rigproof_spec::geometry::{Angle, Arms};

use crate::error::ModelError;

pub use singularity::Pair;

/// A configuration of the linkage: the five angles and the three moving points.
///
/// Angles are as in thesis figures 4.5 and 5.1 and (5.34), counter-clockwise positive, rad:
///
/// | symbol | here | from | to | range here |
/// |---|---|---|---|---|
/// | θA | `theta_a_rad` | x axis | arm AE | forward: as given; inverse: above −π/2, at most 3π/2 |
/// | θE | `theta_e_rad` | arm AE | arm ED | between π and 2π |
/// | θB | `theta_b_rad` | x axis | arm BC | forward: as given; inverse: from −π/2, below 3π/2 |
/// | θC | `theta_c_rad` | arm BC | arm CD | between 0 and π |
/// | θD | `theta_d_rad` | arm ED | arm CD | between 0 and π |
///
/// So arm ED points along θA + θE and arm CD along θB + θC. The ranges of θE, θC and θD are the thesis's assembly:
/// elbow E to the left, elbow C to the right, tip outward. Every other assembly lies beyond a singularity and is an error.
/// Points are in the frame of (5.14), (5.15): the origin halfway between A and B, x from A to B, y outward.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// θA, rad.
    pub theta_a_rad: f64,
    /// θE, rad.
    pub theta_e_rad: f64,
    /// θB, rad.
    pub theta_b_rad: f64,
    /// θC, rad.
    pub theta_c_rad: f64,
    /// θD, rad.
    pub theta_d_rad: f64,
    /// Joint E, x and y, m.
    pub point_e_m: [f64; 2],
    /// Joint C, x and y, m.
    pub point_c_m: [f64; 2],
    /// The tip D, x and y, m.
    pub tip_m: [f64; 2],
}

impl Pose {
    /// One of the five angles, rad.
    pub const fn angle_rad(&self, angle: Angle) -> f64 {
        match angle {
            Angle::A => self.theta_a_rad,
            Angle::E => self.theta_e_rad,
            Angle::B => self.theta_b_rad,
            Angle::C => self.theta_c_rad,
            Angle::D => self.theta_d_rad,
        }
    }
}

pub use rigproof_spec::settings::{LONGEST_ARM_M, SHORTEST_ARM_M};

/// Base joint A, m.
pub const fn point_a_m(arms: &Arms) -> [f64; 2] {
    [-arms.l_ab_m / 2.0, 0.0]
}

/// Base joint B, m.
pub const fn point_b_m(arms: &Arms) -> [f64; 2] {
    [arms.l_ab_m / 2.0, 0.0]
}

/// Checks that five numbers are the lengths of a linkage.
///
/// # Errors
/// [`ModelError::ArmLength`]: an arm is not between [`SHORTEST_ARM_M`] and [`LONGEST_ARM_M`], or `L_AB` not between 0
/// and [`LONGEST_ARM_M`].
pub fn check_arms(arms: &Arms) -> Result<(), ModelError> {
    for (arm, value_m, least_m) in [
        ("L_AE", arms.l_ae_m, SHORTEST_ARM_M),
        ("L_ED", arms.l_ed_m, SHORTEST_ARM_M),
        ("L_BC", arms.l_bc_m, SHORTEST_ARM_M),
        ("L_CD", arms.l_cd_m, SHORTEST_ARM_M),
        ("L_AB", arms.l_ab_m, 0.0),
    ] {
        if !(least_m..=LONGEST_ARM_M).contains(&value_m) {
            return Err(ModelError::ArmLength {
                arm,
                value_m,
                least_m,
                greatest_m: LONGEST_ARM_M,
            });
        }
    }
    Ok(())
}

/// The pose of the three moving points, or the singularity it lies at or beyond.
fn pose_of_points(
    arms: &Arms,
    [theta_a_rad, theta_b_rad]: [f64; 2],
    [point_e_m, point_c_m, tip_m]: [[f64; 2]; 3],
) -> Result<Pose, ModelError> {
    let arm_ae = from_to(point_a_m(arms), point_e_m);
    let arm_ed = from_to(point_e_m, tip_m);
    let arm_bc = from_to(point_b_m(arms), point_c_m);
    let arm_cd = from_to(point_c_m, tip_m);
    let pose = Pose {
        theta_a_rad,
        theta_e_rad: 2.0 * core::f64::consts::PI + turn_rad(arm_ae, arm_ed),
        theta_b_rad,
        theta_c_rad: turn_rad(arm_bc, arm_cd),
        theta_d_rad: turn_rad(arm_ed, arm_cd),
        point_e_m,
        point_c_m,
        tip_m,
    };
    singularity::check(&pose)?;
    Ok(pose)
}

fn from_to([x_1, y_1]: [f64; 2], [x_2, y_2]: [f64; 2]) -> [f64; 2] {
    [x_2 - x_1, y_2 - y_1]
}

/// The angle from one vector to another, above −π and at most π, rad.
fn turn_rad([x_1, y_1]: [f64; 2], [x_2, y_2]: [f64; 2]) -> f64 {
    libm::atan2(x_1 * y_2 - y_1 * x_2, x_1 * x_2 + y_1 * y_2)
}

/// A point at a distance and a direction from another one.
fn along([x, y]: [f64; 2], length_m: f64, direction_rad: f64) -> [f64; 2] {
    let (sine, cosine) = libm::sincos(direction_rad);
    [x + length_m * cosine, y + length_m * sine]
}
