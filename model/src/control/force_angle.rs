//! This file says in which direction a brake pushes the tip, and along which line it lets it move: (6.9) to (6.11).

use core::f64::consts::FRAC_PI_2;

use nalgebra::Vector2;
use rigproof_spec::methods::STANDING;

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

/// Rate of a joint, rad/s: J_i·v, and exactly zero where the joint stands: at [`STANDING`] of the greatest rate that it can have at this
/// speed, or below.
///
/// | symbol | here | unit |
/// |---|---|---|
/// | J_i | `row` | 1/m |
/// | v | `velocity_m_s` | m/s |
pub fn joint_rate(row: Vector2<f64>, velocity_m_s: Vector2<f64>) -> f64 {
    let rate_rad_s = row.dot(&velocity_m_s);
    let greatest_rad_s = libm::hypot(row.x, row.y) * libm::hypot(velocity_m_s.x, velocity_m_s.y);
    if rate_rad_s.abs() <= STANDING * greatest_rad_s {
        0.0
    } else {
        rate_rad_s
    }
}

/// Force at the tip of 1 N·m of a brake that opposes the tip's velocity, N (6.11); `None` where the joint stands.
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
///
/// # Differs from the thesis
///
/// A joint that stands has no force (gap `joint-at-rest`): what the print gives it at F_i·v = 0 opposes nothing, and beside zero its sign is
/// that of rounding.
//= thesis (6.11)
pub fn opposing_force(row: Vector2<f64>, velocity_m_s: Vector2<f64>) -> Option<Vector2<f64>> {
    let rate_rad_s = joint_rate(row, velocity_m_s);
    if rate_rad_s < 0.0 {
        Some(row)
    } else if rate_rad_s > 0.0 {
        Some(-row)
    } else {
        None
    }
}
