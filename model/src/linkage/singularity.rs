//! This file says how near two arms are to being parallel, where the linkage loses a direction.

use nalgebra::Matrix2;
use rigproof_spec::geometry::{Angle, Arms};
use rigproof_spec::units::RAD_PER_DEG;

use super::{Pose, from_to, point_a_m, point_b_m};
use crate::error::ModelError;

/// Two arms that are parallel at a singularity (§4.5).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Pair {
    /// AE and ED: the determinant of `J_θ` is zero, an inverse singularity, the reach of the left side.
    AeEd,
    /// BC and CD: the determinant of `J_θ` is zero, an inverse singularity, the reach of the right side.
    BcCd,
    /// ED and CD: the determinant of `J_x` is zero, a forward singularity.
    EdCd,
}

impl Pair {
    /// All pairs.
    pub const ALL: [Pair; 3] = [Pair::AeEd, Pair::BcCd, Pair::EdCd];

    /// The names of the two arms.
    pub const fn arms(self) -> [&'static str; 2] {
        match self {
            Pair::AeEd => ["AE", "ED"],
            Pair::BcCd => ["BC", "CD"],
            Pair::EdCd => ["ED", "CD"],
        }
    }

    /// The angle between them.
    pub const fn angle(self) -> Angle {
        match self {
            Pair::AeEd => Angle::E,
            Pair::BcCd => Angle::C,
            Pair::EdCd => Angle::D,
        }
    }

    /// Between which two angles, themselves not allowed, the thesis's assembly lies, degrees.
    pub const fn range_deg(self) -> [f64; 2] {
        match self {
            Pair::AeEd => [180.0, 360.0],
            Pair::BcCd | Pair::EdCd => [0.0, 180.0],
        }
    }
}

/// Least [`measure`] at which a pose is computed: here base angles still come back from a tip position in f64 to 1e-11 rad,
/// and each tenth of it costs another digit.
pub const LEAST_MEASURE: f64 = 1e-5;

/// How far a pose is from the singularity of a pair: the sine of the angle between the two arms, 0 at the singularity, 1
/// at a right angle, negative in another assembly than the thesis's.
pub fn measure(pose: &Pose, pair: Pair) -> f64 {
    let sine = libm::sin(pose.angle_rad(pair.angle()));
    match pair {
        Pair::AeEd => -sine,
        Pair::BcCd | Pair::EdCd => sine,
    }
}

/// Checks that a pose is away from its singularities.
///
/// # Errors
/// [`ModelError::Singular`]: a [`measure`] is below [`LEAST_MEASURE`].
pub fn check(pose: &Pose) -> Result<(), ModelError> {
    for pair in Pair::ALL {
        let measure = measure(pose, pair);
        if measure.is_nan() || measure < LEAST_MEASURE {
            return Err(at(pair, pose.angle_rad(pair.angle()) / RAD_PER_DEG));
        }
    }
    Ok(())
}

/// The error of a pair at an angle, degrees.
pub(super) fn at(pair: Pair, value_deg: f64) -> ModelError {
    let [least_deg, greatest_deg] = pair.range_deg();
    ModelError::Singular {
        pair,
        value_deg,
        least_deg,
        greatest_deg,
    }
}

/// `J_x` of (4.3), 2×2, rows ED and CD, columns x, y, m: its determinant is zero where ED and CD are parallel.
//= thesis (4.3)
pub fn j_x(pose: &Pose) -> Matrix2<f64> {
    let [ed_x, ed_y] = from_to(pose.point_e_m, pose.tip_m);
    let [cd_x, cd_y] = from_to(pose.point_c_m, pose.tip_m);
    Matrix2::new(ed_x, ed_y, cd_x, cd_y)
}

/// `J_θ` with which `J_x·ẋ = J_θ·θ̇` holds for θ = (θA, θB), 2×2, m² (4.2).
///
/// ```text
/// J_θ = diag(AE_x·ED_y − AE_y·ED_x, BC_x·CD_y − BC_y·CD_x)
/// ```
///
/// Arm AE turning at θ̇A moves E by θ̇A·(−AE_y, AE_x); ED is rigid, so ED·ẋ = ED·Ė = θ̇A·(AE_x·ED_y − AE_y·ED_x), and
/// likewise on the other side. The determinant is zero where AE and ED or BC and CD are parallel.
///
/// # Differs from the thesis
/// (4.4) prints [`base_jacobian`] in its place (erratum `j-theta`).
//= thesis (4.2)
pub fn j_theta(arms: &Arms, pose: &Pose) -> Matrix2<f64> {
    let [ae_x, ae_y] = from_to(point_a_m(arms), pose.point_e_m);
    let [bc_x, bc_y] = from_to(point_b_m(arms), pose.point_c_m);
    let [ed_x, ed_y] = from_to(pose.point_e_m, pose.tip_m);
    let [cd_x, cd_y] = from_to(pose.point_c_m, pose.tip_m);
    Matrix2::new(
        ae_x * ed_y - ae_y * ed_x,
        0.0,
        0.0,
        bc_x * cd_y - bc_y * cd_x,
    )
}

/// J of (4.1) for θ = (θA, θB), 2×2, rows A, B, columns x, y, rad/m: θ̇ = J·ẋ. This is the matrix that (4.4) prints.
///
/// # Errors
/// [`ModelError::Singular`].
//= thesis (4.1)
//= thesis (4.4)
pub fn base_jacobian(arms: &Arms, pose: &Pose) -> Result<Matrix2<f64>, ModelError> {
    check(pose)?;
    let (j_x, j_theta) = (j_x(pose), j_theta(arms, pose));
    Ok(Matrix2::new(
        j_x.m11 / j_theta.m11,
        j_x.m12 / j_theta.m11,
        j_x.m21 / j_theta.m22,
        j_x.m22 / j_theta.m22,
    ))
}
