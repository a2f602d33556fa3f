//! This file says along which directions the tip can move while one brake is locked, and how evenly they are spread (§4.3).

use core::f64::consts::{FRAC_PI_2, PI};

/// The directions of the local single-degree-of-freedom paths, rad, in the order of the brakes; each from 0 to below π.
///
/// `tip_forces` holds the tip force of each brake, x and y, of any length: a locked brake lets the tip move at a right
/// angle to its force only. A brake without force has no path and is left out.
pub fn directions_rad(tip_forces: &[[f64; 2]]) -> Vec<f64> {
    let acting = tip_forces.iter().filter(|[x, y]| *x != 0.0 || *y != 0.0);
    acting
        .map(|[x, y]| half_turn(libm::atan2(*y, *x) + FRAC_PI_2))
        .collect()
}

/// The greatest angle between adjacent local paths, rad, π for a single path and without any.
///
/// With n evenly spread paths it is π/n, its least: 45° for four brakes, 60° for three.
pub fn greatest_angle_rad(tip_forces: &[[f64; 2]]) -> f64 {
    let mut directions = directions_rad(tip_forces);
    directions.sort_by(f64::total_cmp);
    let (Some(first), Some(last)) = (directions.first(), directions.last()) else {
        return PI;
    };
    let around = first + PI - last;
    let between = directions
        .iter()
        .zip(directions.iter().skip(1))
        .map(|(direction, next)| next - direction);
    between.fold(around, f64::max)
}

/// A direction without its sense: from 0 to below π, rad.
fn half_turn(direction_rad: f64) -> f64 {
    let rest = libm::fmod(direction_rad, PI);
    let rest = if rest < 0.0 { rest + PI } else { rest };
    if rest >= PI { 0.0 } else { rest }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(angles_deg: &[f64]) -> Vec<[f64; 2]> {
        let unit = |deg: &f64| {
            let (sine, cosine) = libm::sincos(deg * PI / 180.0);
            [2.7 * cosine, 2.7 * sine]
        };
        angles_deg.iter().map(unit).collect()
    }

    #[test]
    fn evenly_spread_paths_are_a_half_turn_over_their_number_apart() {
        for (forces_deg, expected_deg) in [
            (vec![13.0, 58.0, 283.0, -32.0], 45.0),
            (vec![7.0, 67.0, 127.0], 60.0),
            (vec![7.0, 67.0, 127.0, 187.0], 60.0),
            (vec![-151.0, 163.0], 134.0),
            (vec![-151.0], 180.0),
        ] {
            let angle_deg = greatest_angle_rad(&at(&forces_deg)) * 180.0 / PI;
            assert!((angle_deg - expected_deg).abs() < 1e-12, "{angle_deg}");
        }
        assert_eq!(greatest_angle_rad(&[[0.0, 0.0]]), PI);
    }

    #[test]
    fn a_path_is_square_to_its_force_and_has_no_sense() {
        for (force_deg, path_deg) in [(37.0, 127.0), (217.0, 127.0), (-37.0, 53.0), (143.0, 53.0)] {
            let [path] = directions_rad(&at(&[force_deg]))[..] else {
                panic!("one force, one path");
            };
            assert!((path * 180.0 / PI - path_deg).abs() < 1e-12, "{path}");
        }
        assert_eq!(half_turn(-1e-20), 0.0);
    }
}
