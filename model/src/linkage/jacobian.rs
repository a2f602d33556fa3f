//! This file says how joint speeds follow from the tip's velocity, and tip forces from joint torques: (5.33) to (5.39).

use nalgebra::{Matrix2, SMatrix};
use rigproof_spec::geometry::Arms;

use super::{Pose, singularity};
use crate::error::ModelError;

/// The Jacobian J of (5.33), 4×2, rows A, E, B, C, columns x, y, rad/m: θ̇ = J·ẋ and F = Jᵀ·τ.
///
/// ```text
/// Jᵀ = [ (J₁⁻¹)ᵀ  (J₂⁻¹)ᵀ ]                                                                (5.39)
/// ```
///
/// J₁ and J₂ are [`from_a_and_e`] and [`from_b_and_c`]. The angles of `pose` are used, so it must belong to `arms`.
///
/// # Errors
/// [`ModelError::Singular`]: the pose is at or beyond a singularity, where J₁ or J₂ has no inverse.
//= thesis (5.33)
//= thesis (5.38)
//= thesis (5.39)
pub fn jacobian(arms: &Arms, pose: &Pose) -> Result<SMatrix<f64, 4, 2>, ModelError> {
    singularity::check(pose)?;
    let left = inverse(&from_a_and_e(arms, pose));
    let right = inverse(&from_b_and_c(arms, pose));
    let mut j = SMatrix::<f64, 4, 2>::zeros();
    j.fixed_view_mut::<2, 2>(0, 0).copy_from(&left);
    j.fixed_view_mut::<2, 2>(2, 0).copy_from(&right);
    Ok(j)
}

/// J₁ of (5.35), 2×2, rows x, y, columns A, E, m/rad: ẋ = J₁·(θ̇A, θ̇E).
///
/// It is the derivative of the left side's tip position (5.34).
//= thesis (5.34)
//= thesis (5.35)
//= thesis (5.36)
pub fn from_a_and_e(arms: &Arms, pose: &Pose) -> Matrix2<f64> {
    let (l_ae, l_ed) = (arms.l_ae_m, arms.l_ed_m);
    two_arms([l_ae, l_ed], pose.theta_a_rad, pose.theta_e_rad)
}

/// J₂ of (5.35), 2×2, rows x, y, columns B, C, m/rad: ẋ = J₂·(θ̇B, θ̇C).
//= thesis (5.37)
pub fn from_b_and_c(arms: &Arms, pose: &Pose) -> Matrix2<f64> {
    let (l_bc, l_cd) = (arms.l_bc_m, arms.l_cd_m);
    two_arms([l_bc, l_cd], pose.theta_b_rad, pose.theta_c_rad)
}

fn two_arms([inner, outer]: [f64; 2], base_rad: f64, elbow_rad: f64) -> Matrix2<f64> {
    let (sine, cosine) = libm::sincos(base_rad);
    let (sine_sum, cosine_sum) = libm::sincos(base_rad + elbow_rad);
    Matrix2::new(
        -inner * sine - outer * sine_sum,
        -outer * sine_sum,
        inner * cosine + outer * cosine_sum,
        outer * cosine_sum,
    )
}

/// The inverse of a 2×2 matrix whose determinant is known not to be zero.
fn inverse(matrix: &Matrix2<f64>) -> Matrix2<f64> {
    let [a, b, c, d] = [matrix.m11, matrix.m12, matrix.m21, matrix.m22];
    let determinant = a * d - b * c;
    Matrix2::new(d, -b, -c, a) / determinant
}
