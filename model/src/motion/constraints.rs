//! This file says what holds the ten coordinates together: (5.44) to (5.51), (5.59) to (5.65), (A.42) to (A.46).

use nalgebra::{Matrix2, SMatrix};
use rigproof_spec::geometry::Arms;
use rigproof_spec::inertia::Inertia;

use super::coordinates::{CONSTRAINTS, COORDINATES, Eight, Ten};

/// A or Ȧ: 8×10, rows constraints, columns coordinates.
pub type ConstraintMatrix = SMatrix<f64, CONSTRAINTS, COORDINATES>;

/// How far each constraint is from being met, C₁ to C₈, m: zero on the linkage.
///
/// ```text
/// C₁ = L_AE·cos θA + L_ED·cos(θA + θE) − L_AB/2 − x          C₂ with sin, without L_AB, − y
/// C₃ = L_BC·cos θB + L_CD·cos(θB + θC) + L_AB/2 − x          C₄ likewise
/// C₅ = L_AE·cos θA + l_ED·cos(θA + θE) − L_AB/2 − x_ED       C₆ likewise
/// C₇ = L_BC·cos θB + l_CD·cos(θB + θC) + L_AB/2 − x_CD       C₈ likewise
/// ```
//= thesis (5.44)
//= thesis (5.45)
//= thesis (5.46)
//= thesis (5.47)
//= thesis (5.48)
//= thesis (5.49)
//= thesis (5.50)
//= thesis (5.51)
//= thesis (A.28)
//= thesis (A.29)
//= thesis (A.30)
//= thesis (A.31)
//= thesis (A.32)
//= thesis (A.33)
//= thesis (A.34)
//= thesis (A.35)
pub fn constraints(arms: &Arms, inertia: &Inertia, q: &Ten) -> Eight {
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
    ] = q.data.0;
    let (l_ed, l_cd) = (inertia.ed.centre_m, inertia.cd.centre_m);
    let (sin_a, cos_a) = libm::sincos(theta_a);
    let (sin_ae, cos_ae) = libm::sincos(theta_a + theta_e);
    let (sin_b, cos_b) = libm::sincos(theta_b);
    let (sin_bc, cos_bc) = libm::sincos(theta_b + theta_c);
    let half_ab = arms.l_ab_m / 2.0;
    Eight::from([
        arms.l_ae_m * cos_a + arms.l_ed_m * cos_ae - half_ab - x,
        arms.l_ae_m * sin_a + arms.l_ed_m * sin_ae - y,
        arms.l_bc_m * cos_b + arms.l_cd_m * cos_bc + half_ab - x,
        arms.l_bc_m * sin_b + arms.l_cd_m * sin_bc - y,
        arms.l_ae_m * cos_a + l_ed * cos_ae - half_ab - x_ed,
        arms.l_ae_m * sin_a + l_ed * sin_ae - y_ed,
        arms.l_bc_m * cos_b + l_cd * cos_bc + half_ab - x_cd,
        arms.l_bc_m * sin_b + l_cd * sin_bc - y_cd,
    ])
}

/// The constraint matrix A, 8×10: `A_ij` = ∂C_i/∂q_j (5.59), in the blocks of (5.60), m/rad and 1.
///
/// ```text
///     [ −I   A_xy1    0      0      0 ]
/// A = [ −I     0      0    A_xy2    0 ]
///     [  0   A_ED    −I      0      0 ]
///     [  0     0      0    A_CD    −I ]
/// ```
///
/// # Differs from the thesis
///
/// (5.59) exchanges h and g: there are 8 constraints and 10 coordinates (erratum `constraint-matrix-size`).
//= thesis (5.59)
//= thesis (5.60)
//= thesis (A.36)
pub fn constraint_matrix(arms: &Arms, inertia: &Inertia, q: &Ten) -> ConstraintMatrix {
    let [_, _, theta_a, theta_e, _, _, theta_b, theta_c, _, _] = q.data.0[0];
    let (l_ed, l_cd) = (inertia.ed.centre_m, inertia.cd.centre_m);
    //= thesis (5.62)
    //= thesis (A.38)
    let a_xy1 = turn(arms.l_ae_m, arms.l_ed_m, theta_a, theta_e);
    //= thesis (5.63)
    //= thesis (A.39)
    let a_xy2 = turn(arms.l_bc_m, arms.l_cd_m, theta_b, theta_c);
    //= thesis (5.64)
    //= thesis (A.40)
    let a_ed = turn(arms.l_ae_m, l_ed, theta_a, theta_e);
    //= thesis (5.65)
    //= thesis (A.41)
    let a_cd = turn(arms.l_bc_m, l_cd, theta_b, theta_c);
    //= thesis (5.61)
    //= thesis (A.37)
    let minus_i = -Matrix2::identity();
    let mut a = blocks(a_xy1, a_xy2, a_ed, a_cd);
    for (row, column) in [(0, 0), (2, 0), (4, 4), (6, 8)] {
        a.fixed_view_mut::<2, 2>(row, column).copy_from(&minus_i);
    }
    a
}

/// The rate Ȧ of the constraint matrix, 8×10, m/s and 1/s (A.42) to (A.46).
//= thesis (A.42)
pub fn constraint_matrix_rate(
    arms: &Arms,
    inertia: &Inertia,
    q: &Ten,
    q_dot: &Ten,
) -> ConstraintMatrix {
    let [_, _, theta_a, theta_e, _, _, theta_b, theta_c, _, _] = q.data.0[0];
    let [_, _, rate_a, rate_e, _, _, rate_b, rate_c, _, _] = q_dot.data.0[0];
    let (l_ed, l_cd) = (inertia.ed.centre_m, inertia.cd.centre_m);
    let (left, left_rate) = ([theta_a, theta_e], [rate_a, rate_e]);
    let (right, right_rate) = ([theta_b, theta_c], [rate_b, rate_c]);
    //= thesis (A.43)
    let a_xy1 = turn_rate(arms.l_ae_m, arms.l_ed_m, left, left_rate);
    //= thesis (A.44)
    let a_xy2 = turn_rate(arms.l_bc_m, arms.l_cd_m, right, right_rate);
    //= thesis (A.45)
    let a_ed = turn_rate(arms.l_ae_m, l_ed, left, left_rate);
    //= thesis (A.46)
    let a_cd = turn_rate(arms.l_bc_m, l_cd, right, right_rate);
    blocks(a_xy1, a_xy2, a_ed, a_cd)
}

fn blocks(
    a_xy1: Matrix2<f64>,
    a_xy2: Matrix2<f64>,
    a_ed: Matrix2<f64>,
    a_cd: Matrix2<f64>,
) -> ConstraintMatrix {
    let mut a = ConstraintMatrix::zeros();
    for (row, column, block) in [(0, 2, a_xy1), (2, 6, a_xy2), (4, 2, a_ed), (6, 6, a_cd)] {
        a.fixed_view_mut::<2, 2>(row, column).copy_from(&block);
    }
    a
}

/// How a point at `outer` along the second of two arms moves with their two angles.
fn turn(inner: f64, outer: f64, base: f64, elbow: f64) -> Matrix2<f64> {
    let (sin_base, cos_base) = libm::sincos(base);
    let (sin_sum, cos_sum) = libm::sincos(base + elbow);
    Matrix2::new(
        -inner * sin_base - outer * sin_sum,
        -outer * sin_sum,
        inner * cos_base + outer * cos_sum,
        outer * cos_sum,
    )
}

/// The rate of [`turn`].
fn turn_rate(
    inner: f64,
    outer: f64,
    [base, elbow]: [f64; 2],
    [rate_base, rate_elbow]: [f64; 2],
) -> Matrix2<f64> {
    let (sin_base, cos_base) = libm::sincos(base);
    let (sin_sum, cos_sum) = libm::sincos(base + elbow);
    let rate_sum = rate_base + rate_elbow;
    Matrix2::new(
        -inner * rate_base * cos_base - outer * rate_sum * cos_sum,
        -outer * rate_sum * cos_sum,
        -inner * rate_base * sin_base - outer * rate_sum * sin_sum,
        -outer * rate_sum * sin_sum,
    )
}
