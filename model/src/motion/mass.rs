//! This file says what the mass matrix of the ten coordinates is: (5.53) to (5.58).

use nalgebra::{Matrix2, SMatrix};
use rigproof_spec::inertia::{ArmInertia, Inertia};

use super::coordinates::{COORDINATES, Ten};

/// The mass matrix M, 10×10, rows and columns as (5.42), kg and kg·m² (5.53), (A.22).
///
/// ```text
/// M = diag(M_D, M_AE, M_ED, M_BC, M_CD)
/// M_AE = [ I_AE + m_AE·l_AE² + I_ED   I_ED ]        M_BC likewise of BC and CD
///        [ I_ED                       I_ED ]
/// M_D = m_D·I   M_ED = m_ED·I   M_CD = m_CD·I
/// ```
///
/// It does not depend on q. With table 5.1's `m_D` = 0 it has no inverse; (5.66) has a solution all the same.
//= thesis (5.53)
//= thesis (A.22)
//= thesis (A.12)
//= thesis (A.13)
//= thesis (A.14)
//= thesis (A.15)
//= thesis (A.16)
//= thesis (A.17)
//= thesis (A.18)
//= thesis (A.19)
//= thesis (A.20)
//= thesis (A.21)
pub fn mass_matrix(inertia: &Inertia) -> SMatrix<f64, COORDINATES, COORDINATES> {
    let blocks = [
        point(inertia.payload_kg),
        two_arms(inertia.ae, inertia.ed),
        point(inertia.ed.mass_kg),
        two_arms(inertia.bc, inertia.cd),
        point(inertia.cd.mass_kg),
    ];
    let mut mass = SMatrix::<f64, COORDINATES, COORDINATES>::zeros();
    for (place, block) in blocks.iter().enumerate() {
        mass.fixed_view_mut::<2, 2>(2 * place, 2 * place)
            .copy_from(block);
    }
    mass
}

/// `M_AE` or `M_BC`: a base arm and the arm it carries, whose angle is relative to it.
//= thesis (5.55)
//= thesis (5.57)
//= thesis (A.24)
//= thesis (A.26)
fn two_arms(base: ArmInertia, carried: ArmInertia) -> Matrix2<f64> {
    let i_base = base.inertia_kg_m2;
    let i_carried = carried.inertia_kg_m2;
    let m_l2 = base.mass_kg * base.centre_m * base.centre_m;
    Matrix2::new(i_base + m_l2 + i_carried, i_carried, i_carried, i_carried)
}

/// `M_D`, `M_ED` or `M_CD`: a mass that moves in x and y.
//= thesis (5.54)
//= thesis (5.56)
//= thesis (5.58)
//= thesis (A.23)
//= thesis (A.25)
//= thesis (A.27)
fn point(mass_kg: f64) -> Matrix2<f64> {
    Matrix2::from_diagonal_element(mass_kg)
}

/// Kinetic energy, J: the sum of (A.7) to (A.11), which is ½·q̇ᵀ·M·q̇.
//= thesis (A.7)
//= thesis (A.8)
//= thesis (A.9)
//= thesis (A.10)
//= thesis (A.11)
pub fn kinetic_energy_j(inertia: &Inertia, q_dot: &Ten) -> f64 {
    let [
        [
            x,
            y,
            theta_a,
            theta_e,
            x_ed,
            y_ed,
            theta_b,
            theta_c,
            x_cd,
            y_cd,
        ],
    ] = q_dot.data.0;
    let Inertia { ae, ed, bc, cd, .. } = inertia;
    let turning = |arm: &ArmInertia, rate: f64| 0.5 * arm.inertia_kg_m2 * rate * rate;
    let moving = |mass_kg: f64, x: f64, y: f64| 0.5 * mass_kg * (x * x + y * y);
    let t_ae = turning(ae, theta_a) + moving(ae.mass_kg, ae.centre_m * theta_a, 0.0);
    let t_bc = turning(bc, theta_b) + moving(bc.mass_kg, bc.centre_m * theta_b, 0.0);
    let t_ed = turning(ed, theta_e + theta_a) + moving(ed.mass_kg, x_ed, y_ed);
    let t_cd = turning(cd, theta_c + theta_b) + moving(cd.mass_kg, x_cd, y_cd);
    t_ae + t_bc + t_ed + t_cd + moving(inertia.payload_kg, x, y)
}
