//! This file derives the range that each angle takes from the stops: what table 4.2 says of the 4-brake layout.

use core::f64::consts::PI;

use rigproof_spec::geometry::{Angle, AngleRange, AngleRanges, Arms};
use rigproof_spec::units::{RAD_PER_DEG, rad_from_deg};

use crate::error::ModelError;
use crate::linkage::{Pose, forward, limits};

/// Points along each side of a search window.
const POINTS: usize = 61;
/// How often a window shrinks to a quarter around its best point.
const ROUNDS: usize = 22;

/// The range that each angle takes between the stops, degrees; `None` if no pose lies between them.
///
/// θA and θB are searched over the half turn above the base, first everywhere, then ever closer around the best pose of
/// each end; what is found is a pose, so a range is never too wide, and by the last round the window is below 1e-9°.
///
/// # Errors
/// [`ModelError::ArmLength`]; [`ModelError::AngleRangeCrossed`].
pub fn attained_ranges(
    arms: &Arms,
    stops: &AngleRanges,
) -> Result<Option<AngleRanges>, ModelError> {
    crate::linkage::check_arms(arms)?;
    limits::check_ranges(stops)?;
    let ends = Angle::ALL.map(|angle| {
        let least = extreme(arms, stops, |pose| -pose.angle_rad(angle));
        let greatest = extreme(arms, stops, |pose| pose.angle_rad(angle));
        let (least_rad, greatest_rad) = (-least?, greatest?);
        Some(AngleRange::new(
            least_rad / RAD_PER_DEG,
            greatest_rad / RAD_PER_DEG,
        ))
    });
    let [Some(a), Some(e), Some(b), Some(c), Some(d)] = ends else {
        return Ok(None);
    };
    Ok(Some(AngleRanges { a, e, b, c, d }))
}

/// The greatest value of a quantity over the poses between the stops.
fn extreme(arms: &Arms, stops: &AngleRanges, value: impl Fn(&Pose) -> f64) -> Option<f64> {
    let mut middle = [PI / 2.0, PI / 2.0];
    let mut half_rad = PI / 2.0;
    let mut best: Option<f64> = None;
    for _ in 0..ROUNDS {
        for [theta_a_rad, theta_b_rad] in window(middle, half_rad) {
            let Ok(pose) = forward::pose(arms, theta_a_rad, theta_b_rad) else {
                continue;
            };
            if limits::inside(stops, &pose).is_err() {
                continue;
            }
            let here = value(&pose);
            if best.is_none_or(|best| here > best) {
                best = Some(here);
                middle = [theta_a_rad, theta_b_rad];
            }
        }
        half_rad /= 4.0;
    }
    best
}

/// The points of a square window, those outside the half turn above the base moved to its edge, where a stop may be.
fn window([a_rad, b_rad]: [f64; 2], half_rad: f64) -> impl Iterator<Item = [f64; 2]> {
    let offset = move |k: usize| half_rad * (2.0 * k as f64 / (POINTS - 1) as f64 - 1.0);
    let half_turn_rad = rad_from_deg(180.0);
    let at = move |middle: f64, k: usize| (middle + offset(k)).clamp(0.0, half_turn_rad);
    (0..POINTS).flat_map(move |i| (0..POINTS).map(move |k| [at(a_rad, i), at(b_rad, k)]))
}
