//! This file is the inverse kinematics as printed: (5.18) to (5.32).

use core::f64::consts::{FRAC_PI_2, PI};

use rigproof_spec::geometry::Arms;

use super::angle;

/// θA and θB of a tip position for `L_AB` ≠ 0, (5.18) to (5.26), rad; not a number where an acos has no value.
///
/// # Differs from the thesis
/// The denominators of (5.22) and (5.24) have the factor 2 of the law of cosines, which the print leaves out (erratum
/// `inverse-factor-two`). The print holds for y > 0 only, where λ1 and λ3 are positive.
pub fn inverse(arms: &Arms, [x, y]: [f64; 2]) -> [f64; 2] {
    let l_ab = arms.l_ab_m;
    //= thesis (5.18)
    let l_od = (x * x + y * y).sqrt();
    let (to_b, to_a) = (x - l_ab / 2.0, x + l_ab / 2.0);
    //= thesis (5.19)
    let l_bd = (to_b * to_b + y * y).sqrt();
    //= thesis (5.20)
    let l_ad = (to_a * to_a + y * y).sqrt();
    // Twice the half of L_AB is the L_AB of the printed denominators.
    //= thesis (5.21)
    let lambda_1 = angle(l_ab / 2.0, l_bd, l_od);
    //= thesis (5.22)
    let lambda_2 = angle(arms.l_bc_m, l_bd, arms.l_cd_m);
    //= thesis (5.23)
    let lambda_3 = angle(l_ab / 2.0, l_ad, l_od);
    //= thesis (5.24)
    let lambda_4 = angle(arms.l_ae_m, l_ad, arms.l_ed_m);
    //= thesis (5.25)
    let theta_a = lambda_3 + lambda_4;
    //= thesis (5.26)
    let theta_b = PI - lambda_1 - lambda_2;
    [theta_a, theta_b]
}

/// λ2 and λ4 exactly as (5.22) and (5.24) print them, without the factor 2, rad; mostly not a number (erratum
/// `inverse-factor-two`).
///
/// ```text
/// λ2 = acos((L_BC² + L_BD² − L_CD²) / (L_BC·L_BD))
/// λ4 = acos((L_AE² + L_AD² − L_ED²) / (L_AE·L_AD))
/// ```
pub fn lambda_2_and_4(arms: &Arms, [x, y]: [f64; 2]) -> [f64; 2] {
    let half = arms.l_ab_m / 2.0;
    let printed = |inner: f64, outer: f64, to_base: f64| {
        let squared = to_base * to_base + y * y;
        libm::acos((inner * inner + squared - outer * outer) / (inner * squared.sqrt()))
    };
    let lambda_2 = printed(arms.l_bc_m, arms.l_cd_m, x - half);
    let lambda_4 = printed(arms.l_ae_m, arms.l_ed_m, x + half);
    [lambda_2, lambda_4]
}

/// θA and θB of a tip position for `L_AB` = 0, (5.27) to (5.32), rad; not a number where an acos has no value.
///
/// # Differs from the thesis
/// As printed. (5.28) divides by zero at y = 0, where it happens to be right for x > 0 alone, and is off by a half turn
/// for y < 0 (erratum `inverse-quadrant`).
pub fn inverse_of_shared_axis(arms: &Arms, [x, y]: [f64; 2]) -> [f64; 2] {
    //= thesis (5.27)
    let l_od = (x * x + y * y).sqrt();
    //= thesis (5.28)
    let psi_1 = FRAC_PI_2 - libm::atan(x / y);
    //= thesis (5.29)
    let psi_2 = angle(arms.l_bc_m, l_od, arms.l_cd_m);
    //= thesis (5.30)
    let psi_3 = angle(arms.l_ae_m, l_od, arms.l_ed_m);
    //= thesis (5.31)
    let theta_a = psi_1 + psi_3;
    //= thesis (5.32)
    let theta_b = psi_1 - psi_2;
    [theta_a, theta_b]
}
