//! This file says how strong each brake is at the tip, and so how much force to ask for: (6.1) to (6.8).

use nalgebra::{SMatrix, Vector2, Vector4};
use rigproof_spec::geometry::{AngleRange, Arms, angle_ranges, arms};
use rigproof_spec::joint::Joint;
use rigproof_spec::layout::Layout;
use rigproof_spec::tables::GREATEST_CURRENT_A;
use rigproof_spec::units::rad_from_deg;

use crate::brake::torque_gain;

/// Force at the tip of the torques of joints A, E, B and C, x and y, N (6.1), (6.2).
///
/// ```text
/// (F_x, F_y) = Jᵀ·(τ_A, τ_E, τ_B, τ_C)
/// ```
//= thesis (6.1)
//= thesis (6.2)
pub fn tip_force(j: &SMatrix<f64, 4, 2>, torques_nm: &Vector4<f64>) -> Vector2<f64> {
    j.tr_mul(torques_nm)
}

/// Magnitude of the force at the tip of one joint's torque, N (6.3).
///
/// ```text
/// |F_i| = |τ_i|·√(J_ix² + J_iy²)
/// ```
//= thesis (6.3)
pub fn force_magnitude(row: Vector2<f64>, torque_nm: f64) -> f64 {
    torque_nm.abs() * libm::sqrt(row.x * row.x + row.y * row.y)
}

/// Magnitude of the force of a joint's torque from the elbow angle on its side alone, N (6.4) to (6.7).
///
/// ```text
/// |F_A| = |τ_A| / (L_AE·cos(θ_E + 90°))                                                    (6.4)
/// |F_E| = |τ_E|·√(L_ED² + L_AE² + 2·L_ED·L_AE·cos θ_E) / (L_ED·L_AE·sin θ_E)               (6.5)
/// |F_B| = |τ_B| / (L_BC·cos(θ_B + 90°))                                                    (6.6)
/// |F_C| = |τ_C|·√(L_CD² + L_BC² + 2·L_CD·L_BC·cos θ_C) / (L_CD·L_BC·sin θ_C)               (6.7)
/// ```
///
/// `elbow_rad` is θE for joints A and E, θC for joints B and C.
///
/// # Differs from the thesis
///
/// The magnitude of each denominator is taken: as printed (6.5) and (6.6) are negative throughout (erratum
/// `force-magnitude-sign`). (6.6) takes θC (erratum `force-of-b-angle`).
//= thesis (6.4)
//= thesis (6.5)
//= thesis (6.6)
//= thesis (6.7)
pub fn force_from_elbow(arms: &Arms, joint: Joint, elbow_rad: f64, torque_nm: f64) -> f64 {
    let [inner, outer] = side(arms, joint);
    let (sine, cosine) = libm::sincos(elbow_rad);
    match joint {
        Joint::A | Joint::B => torque_nm.abs() / (inner * sine.abs()),
        Joint::E | Joint::C => {
            let across = outer * outer + inner * inner + 2.0 * outer * inner * cosine;
            torque_nm.abs() * libm::sqrt(across) / (outer * inner * sine.abs())
        }
    }
}

/// The least force that a joint's brake gives at 1 A anywhere in a range of its elbow angle, N, with τ_i = K_i(I) (6.8).
///
/// A and B are weakest where their arms are at a right angle; E and C where cos θ is minus the shorter arm over the
/// longer, so that the arm to the base is at a right angle to the way to the tip; or at the end of the range nearest to
/// that.
//= thesis (6.8)
pub fn least_force(arms: &Arms, joint: Joint, range: AngleRange) -> f64 {
    let [inner, outer] = side(arms, joint);
    let weakest_cosine = match joint {
        Joint::A | Joint::B => 0.0,
        Joint::E | Joint::C => -(inner / outer).min(outer / inner),
    };
    // θC lies in the upper half turn, θE in the lower.
    let weakest_rad = libm::acos(weakest_cosine);
    let weakest_rad = match joint {
        Joint::A | Joint::E => 2.0 * core::f64::consts::PI - weakest_rad,
        Joint::B | Joint::C => weakest_rad,
    };
    let elbow_rad = weakest_rad
        .max(rad_from_deg(range.least_deg))
        .min(rad_from_deg(range.greatest_deg));
    let torque_nm = torque_gain(joint, GREATEST_CURRENT_A);
    force_from_elbow(arms, joint, elbow_rad, torque_nm)
}

/// The least force among a layout's brakes at 1 A over the joint ranges of table 4.2, N (§6.1.2).
///
/// 19.55 N (brake E at 190°) and 22.27 N (brake C at 150°); the thesis rounds down to 19.5 and 22.0 N.
pub fn greatest_common_force(layout: Layout) -> f64 {
    let ranges = angle_ranges(layout);
    layout
        .brakes()
        .iter()
        .map(|joint| {
            let range = match joint {
                Joint::A | Joint::E => ranges.e,
                Joint::B | Joint::C => ranges.c,
            };
            least_force(&arms(layout), *joint, range)
        })
        .fold(f64::INFINITY, f64::min)
}

/// The arm to the base and the arm to the tip on a joint's side, m.
fn side(arms: &Arms, joint: Joint) -> [f64; 2] {
    match joint {
        Joint::A | Joint::E => [arms.l_ae_m, arms.l_ed_m],
        Joint::B | Joint::C => [arms.l_bc_m, arms.l_cd_m],
    }
}
