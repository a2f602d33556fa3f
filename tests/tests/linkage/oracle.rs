//! This file builds linkages from their angles, by a way that the model does not take, and differentiates them with complex
//! steps.

use nalgebra::Complex;
use proptest::prelude::*;
use rigproof_spec::geometry::Arms;

/// A linkage made from the tip backwards: its lengths, and the pose it must have.
#[derive(Clone, Copy, Debug)]
pub struct Made {
    pub arms: Arms,
    pub tip_m: [f64; 2],
    pub theta_a_rad: f64,
    pub theta_e_rad: f64,
    pub theta_b_rad: f64,
    pub theta_c_rad: f64,
    pub theta_d_rad: f64,
}

pub fn rad(deg: f64) -> f64 {
    deg * core::f64::consts::PI / 180.0
}

/// Two arms of the lengths `inner` and `outer` with the turn `elbow` between them: how far the end is, and the angles of
/// both arms from the way to the end.
fn chain(inner: f64, outer: f64, elbow: f64) -> (f64, f64, f64) {
    let x = inner + outer * libm::cos(elbow);
    let y = outer * libm::sin(elbow);
    let to_end = libm::atan2(y, x);
    (libm::hypot(x, y), -to_end, elbow - to_end)
}

/// A linkage from its arm lengths, its elbow turns and the angle ADB at the tip; `L_AB` follows.
pub fn make([l_ae_m, l_ed_m, l_bc_m, l_cd_m]: [f64; 4], [e, c, at_tip]: [f64; 3]) -> Made {
    let (from_a, ae_rad, ed_rad) = chain(l_ae_m, l_ed_m, e);
    let (from_b, bc_rad, cd_rad) = chain(l_bc_m, l_cd_m, c);
    // The triangle ABD: D is the apex over the base AB.
    let (x, y) = (
        from_a - from_b * libm::cos(at_tip),
        from_b * libm::sin(at_tip),
    );
    let l_ab_m = libm::hypot(x, y);
    let at_a = libm::atan2(y, x);
    let to_tip_from_b = at_a + at_tip;
    let tip_m = [
        from_a * libm::cos(at_a) - l_ab_m / 2.0,
        from_a * libm::sin(at_a),
    ];
    let arms = Arms {
        l_ae_m,
        l_ed_m,
        l_bc_m,
        l_cd_m,
        l_ab_m,
    };
    Made {
        arms,
        tip_m,
        theta_a_rad: at_a + ae_rad,
        theta_e_rad: e,
        theta_b_rad: to_tip_from_b + bc_rad,
        theta_c_rad: c,
        theta_d_rad: to_tip_from_b + cd_rad - (at_a + ed_rad),
    }
}

/// Any angle as the one from `-π/2` on, below `3π/2`.
pub fn from_down(angle_rad: f64) -> f64 {
    let turn = 2.0 * core::f64::consts::PI;
    let down = -core::f64::consts::FRAC_PI_2;
    angle_rad - turn * ((angle_rad - down) / turn).floor()
}

/// Random lengths between 0.07 and 1.9 m with elbows at least 10° away from straight and folded.
pub fn linkages() -> impl Strategy<Value = Made> {
    let length = 0.07..1.9_f64;
    let lengths = [length.clone(), length.clone(), length.clone(), length];
    let angles = (
        rad(190.0)..rad(350.0),
        rad(10.0)..rad(170.0),
        rad(1.0)..rad(179.0),
    );
    (lengths, angles).prop_map(|(lengths, (e, c, at_tip))| make(lengths, [e, c, at_tip]))
}

/// Whether ED and CD are at least 10° away from parallel, in the thesis's assembly.
pub fn is_assembled(made: &Made) -> bool {
    let d = from_down(made.theta_d_rad);
    (rad(10.0)..rad(170.0)).contains(&d)
}

/// Base angles over the whole range of table 4.2 of the 3-brake layout.
pub fn three_brake() -> impl Strategy<Value = [f64; 2]> {
    (10.0..170.0_f64, 0.0..1.0_f64).prop_map(|(between, share)| {
        let b = share * (180.0 - between);
        [rad(b + between), rad(b)]
    })
}

/// Base angles over the whole range of table 4.2 of the 4-brake layout.
pub fn four_brake() -> impl Strategy<Value = [f64; 2]> {
    let base = (37.0..180.0_f64, 0.0..143.0_f64).prop_map(|(a, b)| [rad(a), rad(b)]);
    base.prop_filter("the other angles are in the range of table 4.2", |base| {
        in_four_brake_ranges(*base)
    })
}

/// Whether θE, θC and θD are in the 4-brake ranges of table 4.2.
pub fn in_four_brake_ranges(base: [f64; 2]) -> bool {
    let arms = rigproof_spec::geometry::arms(rigproof_spec::layout::Layout::FourBrake);
    let tip = moved(&arms, base, [0.0, 0.0]).tip.map(|c| c.re);
    let half = arms.l_ab_m / 2.0;
    let e = [
        arms.l_ae_m * libm::cos(base[0]) - half,
        arms.l_ae_m * libm::sin(base[0]),
    ];
    let c = [
        arms.l_bc_m * libm::cos(base[1]) + half,
        arms.l_bc_m * libm::sin(base[1]),
    ];
    let direction = |[x, y]: [f64; 2]| libm::atan2(tip[1] - y, tip[0] - x);
    let turn = |angle: f64| libm::fmod(angle + rad(720.0), rad(360.0));
    let (ed, cd) = (direction(e), direction(c));
    (rad(210.0)..rad(350.0)).contains(&turn(ed - base[0]))
        && (rad(10.0)..rad(150.0)).contains(&turn(cd - base[1]))
        && (rad(51.0)..rad(170.0)).contains(&turn(cd - ed))
}

type C = Complex<f64>;

/// The tip, θE and θC for complex base angles near real ones, all closed by the vector loop: real parts are values,
/// imaginary parts derivatives.
pub struct Moved {
    pub tip: [C; 2],
    pub theta_e_rate: f64,
    pub theta_c_rate: f64,
}

/// Moves the base angles by `i·rate·step` and returns first derivatives along `rate`.
pub fn moved(arms: &Arms, [a, b]: [f64; 2], [a_rate, b_rate]: [f64; 2]) -> Moved {
    let step = 1e-40;
    let (a, b) = (C::new(a, a_rate * step), C::new(b, b_rate * step));
    let half = arms.l_ab_m / 2.0;
    let e = [a.cos() * arms.l_ae_m - half, a.sin() * arms.l_ae_m];
    let c = [b.cos() * arms.l_bc_m + half, b.sin() * arms.l_bc_m];
    // D = E + p·(C − E) + q·left of it, with p and q² rational in the square of the distance.
    let (x, y) = (c[0] - e[0], c[1] - e[1]);
    let squared = x * x + y * y;
    let (ed, cd) = (arms.l_ed_m, arms.l_cd_m);
    let p = (squared + (ed * ed - cd * cd)) / (squared * 2.0);
    let q = ((squared.inv() * (ed * ed)) - p * p).sqrt();
    let tip = [e[0] + p * x - q * y, e[1] + p * y + q * x];
    let direction_rate = |from: [C; 2], length: f64| {
        let (x, y) = (tip[0] - from[0], tip[1] - from[1]);
        (x.re * y.im - y.re * x.im) / (length * length * step)
    };
    let rate = |value: C| C::new(value.re, value.im / step);
    Moved {
        tip: tip.map(rate),
        theta_e_rate: direction_rate(e, ed) - a_rate,
        theta_c_rate: direction_rate(c, cd) - b_rate,
    }
}
