//! This file says which ten coordinates and forces the thesis moves the linkage in: (5.42), (5.43).

use nalgebra::SVector;
use rigproof_spec::geometry::Arms;
use rigproof_spec::inertia::Inertia;

use super::two_coordinate::TwoCoordinate;
use crate::linkage::Pose;

/// Number n of generalised coordinates.
pub const COORDINATES: usize = 10;
/// Number k of constraints.
pub const CONSTRAINTS: usize = 8;

/// The generalised coordinates q, their rates, accelerations or forces: 10, in the order of (5.42).
pub type Ten = SVector<f64, COORDINATES>;
/// One number a constraint: 8, in the order of (5.44) to (5.51).
pub type Eight = SVector<f64, CONSTRAINTS>;

/// Where θA, θE, θB and θC stand among the ten, in the order A, E, B, C.
pub const JOINTS: [usize; 4] = [2, 3, 6, 7];

/// The generalised coordinates q of a pose (5.42), (A.5).
///
/// ```text
/// q = [x  y  θA  θE  x_ED  y_ED  θB  θC  x_CD  y_CD]ᵀ
/// ```
///
/// | symbol | here | unit |
/// |---|---|---|
/// | x, y | `pose.tip_m` | m |
/// | θA, θE, θB, θC | `pose` | rad |
/// | `x_ED` … `y_CD` | centres of mass of arms ED and CD | m |
//= thesis (5.42)
//= thesis (A.5)
pub fn coordinates(arms: &Arms, inertia: &Inertia, pose: &Pose) -> Ten {
    let [x, y] = pose.tip_m;
    let [x_ed, y_ed] = between(
        pose.point_e_m,
        pose.tip_m,
        inertia.ed.centre_m / arms.l_ed_m,
    );
    let [x_cd, y_cd] = between(
        pose.point_c_m,
        pose.tip_m,
        inertia.cd.centre_m / arms.l_cd_m,
    );
    Ten::from([
        x,
        y,
        pose.theta_a_rad,
        pose.theta_e_rad,
        x_ed,
        y_ed,
        pose.theta_b_rad,
        pose.theta_c_rad,
        x_cd,
        y_cd,
    ])
}

/// The rates q̇ that belong to the rates of the base joints, `rates_rad_s` = (θ̇A, θ̇B).
pub fn rates(form: &TwoCoordinate, rates_rad_s: [f64; 2]) -> Ten {
    let [x, y] = form.tip_velocity_m_s(rates_rad_s);
    let [theta_a, theta_e, theta_b, theta_c] = form.joint_rates_rad_s(rates_rad_s);
    let [[x_ed, y_ed], [x_cd, y_cd]] = form.centre_velocities_m_s(rates_rad_s);
    Ten::from([
        x, y, theta_a, theta_e, x_ed, y_ed, theta_b, theta_c, x_cd, y_cd,
    ])
}

/// The generalised forces Q (5.43), (A.6).
///
/// ```text
/// Q = [F_x  F_y  τA  τE  0  0  τB  τC  0  0]ᵀ
/// ```
///
/// | symbol | here | unit |
/// |---|---|---|
/// | `F_x`, `F_y` | `tip_force_n`, on the tip | N |
/// | τA, τE, τB, τC | `torques_nm`, on the joints in the sense of their angles, A, E, B, C | N·m |
//= thesis (5.43)
//= thesis (A.6)
pub fn forces(tip_force_n: [f64; 2], torques_nm: [f64; 4]) -> Ten {
    let [f_x, f_y] = tip_force_n;
    let [tau_a, tau_e, tau_b, tau_c] = torques_nm;
    Ten::from([f_x, f_y, tau_a, tau_e, 0.0, 0.0, tau_b, tau_c, 0.0, 0.0])
}

fn between([x_1, y_1]: [f64; 2], [x_2, y_2]: [f64; 2], share: f64) -> [f64; 2] {
    [x_1 + share * (x_2 - x_1), y_1 + share * (y_2 - y_1)]
}
