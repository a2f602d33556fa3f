//! This file says in which direction a brake pushes the tip, and along which line it lets it move: (6.9) to (6.11).

use core::f64::consts::FRAC_PI_2;

use nalgebra::Vector2;

/// Angle of the force of a positive torque on one joint, rad (6.9).
///
/// ```text
/// ∠F_i = atan(F_y / F_x) = atan(J_iy / J_ix)
/// ```
///
/// `row` is (J_ix, J_iy), 1/m. Computed with atan2.
///
/// # Differs from the thesis
///
/// The printed arctangent gives the opposite force where J_ix is negative and nothing where it is zero (erratum
/// `force-angle-quadrant`).
//= thesis (6.9)
pub fn force_angle(row: Vector2<f64>) -> f64 {
    libm::atan2(row.y, row.x)
}

/// The two angles of a joint's local path of a single degree of freedom, rad (6.10): the force angle plus and minus 90°.
///
/// ```text
/// ∠p_i = atan(J_iy / J_ix) ± 90°
/// ```
//= thesis (6.10)
pub fn path_angles(row: Vector2<f64>) -> [f64; 2] {
    let force_rad = force_angle(row);
    [force_rad + FRAC_PI_2, force_rad - FRAC_PI_2]
}

/// Force at the tip of 1 N·m of a brake that opposes the tip's velocity, N (6.11).
///
/// ```text
/// ∠F_i = atan(J_iy / J_ix)          F_i·v < 0
/// ∠F_i = atan(J_iy / J_ix) + 180°   F_i·v ≥ 0
/// ```
///
/// | symbol | here | unit |
/// |---|---|---|
/// | J_i | `row` | 1/m |
/// | v | `velocity_m_s` | m/s |
///
/// J_i·v is the joint's speed, so the rule takes the sign of minus the joint's speed.
//= thesis (6.11)
pub fn opposing_force(row: Vector2<f64>, velocity_m_s: Vector2<f64>) -> Vector2<f64> {
    if row.dot(&velocity_m_s) < 0.0 {
        row
    } else {
        -row
    }
}
