//! This file says how two coordinates move where two rates have a least and a greatest value: the exact solution in nine cases.
#![expect(
    clippy::indexing_slicing,
    reason = "indices run over the two limited rates"
)]

use nalgebra::{Matrix2, Vector2};

use super::two_coordinate::solve;

/// Two rates of two coordinates, each held between two values by a pair of overrunning clutches.
///
/// Such a clutch is a dry row whose rest is its motor's speed and whose bound is one-sided: it gives nothing on one side of
/// that speed, and whatever is needed on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LimitedRates {
    /// G, 2×2: the rates by the two coordinates' rates; it has an inverse.
    pub rows: Matrix2<f64>,
    /// Least and greatest value of each rate, rad/s.
    pub limits_rad_s: [[f64; 2]; 2],
}

/// What the clutches let happen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limited {
    /// v: the motion of the two coordinates.
    pub motion: [f64; 2],
    /// The two rates: exactly the limit where a clutch is engaged.
    pub rates: [f64; 2],
    /// λ on the two rates: 0 or less at a greatest value, 0 or more at a least one, 0 between.
    pub loads: [f64; 2],
}

/// Solves M·v = r + Gᵀ·λ with G·v inside its limits, λ pushing back from a limit that is reached and zero elsewhere.
///
/// In the rates w = G·v this is a convex quadratic over a box, which has one least point: between the limits, on a side or in
/// a corner. The first of the nine cases without contradiction is it; where rounding leaves none, the one with the smallest.
pub fn limited_motion(
    mass: &Matrix2<f64>,
    drive: &Vector2<f64>,
    clutches: &LimitedRates,
) -> Limited {
    let inverse = inverse(&clutches.rows);
    let mass = inverse.transpose() * mass * inverse;
    let drive = inverse.transpose() * drive;
    let ends = clutches
        .limits_rad_s
        .map(|[least, greatest]| [None, Some(least), Some(greatest)]);
    let mut best: Option<(f64, Vector2<f64>, Vector2<f64>)> = None;
    for (first, second) in ends[0].into_iter().flat_map(|a| ends[1].map(|b| (a, b))) {
        let rates = at([first, second], &mass, &drive);
        let loads = mass * rates - drive;
        let contradiction = [0, 1].map(|i| {
            let [least, greatest] = clutches.limits_rad_s[i];
            let held = [first, second][i].is_some();
            match held {
                false => (least - rates[i]).max(rates[i] - greatest),
                // A limit that is both ends holds either way.
                true if least == greatest => 0.0,
                true if rates[i] == greatest => loads[i],
                true => -loads[i],
            }
        });
        let contradiction = contradiction[0].max(contradiction[1]);
        if best.is_none_or(|(least, ..)| contradiction < least) {
            best = Some((contradiction, rates, loads));
        }
        if contradiction <= 0.0 {
            break;
        }
    }
    let (_, rates, loads) = best.unwrap_or((0.0, Vector2::zeros(), Vector2::zeros()));
    limited(clutches, &inverse, rates, loads)
}

/// The rates and loads without what rounding left beyond a limit or on the wrong side of it.
fn limited(
    clutches: &LimitedRates,
    inverse: &Matrix2<f64>,
    rates: Vector2<f64>,
    loads: Vector2<f64>,
) -> Limited {
    let rates = [0, 1].map(|i| {
        let [least, greatest] = clutches.limits_rad_s[i];
        rates[i].max(least).min(greatest)
    });
    let loads = [0, 1].map(|i| {
        let [least, greatest] = clutches.limits_rad_s[i];
        match (rates[i] == least, rates[i] == greatest) {
            (true, true) => loads[i],
            (true, false) => loads[i].max(0.0),
            (false, true) => loads[i].min(0.0),
            (false, false) => 0.0,
        }
    });
    Limited {
        motion: (inverse * Vector2::from(rates)).into(),
        rates,
        loads,
    }
}

/// The rates where some are given and no load acts on the others.
fn at(given: [Option<f64>; 2], mass: &Matrix2<f64>, drive: &Vector2<f64>) -> Vector2<f64> {
    match given {
        [None, None] => solve(mass, drive),
        [Some(w), None] => Vector2::new(w, (drive.y - mass.m21 * w) / mass.m22),
        [None, Some(w)] => Vector2::new((drive.x - mass.m12 * w) / mass.m11, w),
        [Some(w_1), Some(w_2)] => Vector2::new(w_1, w_2),
    }
}

fn inverse(matrix: &Matrix2<f64>) -> Matrix2<f64> {
    let determinant = matrix.m11 * matrix.m22 - matrix.m12 * matrix.m21;
    Matrix2::new(matrix.m22, -matrix.m12, -matrix.m21, matrix.m11) / determinant
}
