//! This file is the forward kinematics as printed: (5.1) to (5.17).

use core::f64::consts::PI;

use rigproof_spec::geometry::Arms;

use super::angle;

/// What (5.11) to (5.15) give.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Printed {
    /// θE (5.12), rad.
    pub theta_e_rad: f64,
    /// θC (5.13), rad.
    pub theta_c_rad: f64,
    /// φ8 (5.11), which is θD, rad.
    pub phi_8_rad: f64,
    /// The tip (5.14), (5.15), m.
    pub tip_m: [f64; 2],
}

/// The forward kinematics as printed, (5.1) to (5.15).
///
/// Lengths in m, angles in rad. Not a number where an acos has no value.
///
/// # Differs from the thesis
/// The equations lose the signs of φ2 and φ3: they hold for 0 < θA < π while C lies to the right of the way from B to E, on a
/// shared axis for θA > θB (erratum `forward-domain`).
pub fn forward(arms: &Arms, theta_a: f64, theta_b: f64) -> Printed {
    let Arms {
        l_ae_m: l_ae,
        l_ed_m: l_ed,
        l_bc_m: l_bc,
        l_cd_m: l_cd,
        l_ab_m: l_ab,
    } = *arms;
    //= thesis (5.1)
    let l_be = (l_ae * l_ae + l_ab * l_ab - 2.0 * l_ae * l_ab * libm::cos(theta_a)).sqrt();
    let phi_1 = if l_ab == 0.0 {
        //= thesis (5.2)
        PI - theta_a
    } else {
        //= thesis (5.3)
        angle(l_ab, l_be, l_ae)
    };
    //= thesis (5.4)
    let phi_2 = angle(l_ae, l_be, l_ab);
    //= thesis (5.5)
    let phi_3 = PI - theta_b - phi_1;
    //= thesis (5.6)
    let l_ce = (l_bc * l_bc + l_be * l_be - 2.0 * l_bc * l_be * libm::cos(phi_3)).sqrt();
    //= thesis (5.7)
    let phi_4 = angle(l_be, l_ce, l_bc);
    //= thesis (5.8)
    let phi_5 = angle(l_bc, l_ce, l_be);
    //= thesis (5.9)
    let phi_6 = angle(l_cd, l_ce, l_ed);
    //= thesis (5.10)
    let phi_7 = angle(l_ed, l_ce, l_cd);
    //= thesis (5.11)
    let phi_8 = PI - phi_6 - phi_7;
    //= thesis (5.12)
    let theta_e = PI + phi_2 + phi_4 + phi_7;
    //= thesis (5.13)
    let theta_c = PI - phi_5 - phi_6;
    //= thesis (5.14)
    let x = l_ae * libm::cos(theta_a) + l_ed * libm::cos(theta_a + theta_e) - l_ab / 2.0;
    //= thesis (5.15)
    let y = l_ae * libm::sin(theta_a) + l_ed * libm::sin(theta_a + theta_e);
    Printed {
        theta_e_rad: theta_e,
        theta_c_rad: theta_c,
        phi_8_rad: phi_8,
        tip_m: [x, y],
    }
}

/// The tip of a parallelogram (5.16), (5.17), m.
///
/// ```text
/// x = L_BC·cos θB + L_CD·cos θA
/// y = L_BC·sin θB + L_CD·sin θA
/// ```
///
/// It holds where CD is parallel to AE, that is for `L_AB` = 0, `L_AE` = `L_CD` and `L_BC` = `L_ED` only.
pub fn parallelogram(arms: &Arms, theta_a: f64, theta_b: f64) -> [f64; 2] {
    let (l_bc, l_cd) = (arms.l_bc_m, arms.l_cd_m);
    //= thesis (5.16)
    let x = l_bc * libm::cos(theta_b) + l_cd * libm::cos(theta_a);
    //= thesis (5.17)
    let y = l_bc * libm::sin(theta_b) + l_cd * libm::sin(theta_a);
    [x, y]
}
