//! This file says whether a pose lies inside the ranges of its angles.

use rigproof_spec::geometry::{Angle, AngleRanges, Arms};
use rigproof_spec::units::RAD_PER_DEG;

use super::{Pose, inverse};
use crate::error::ModelError;

/// Checks that every angle of a pose lies in its range, both ends included (table 4.2).
///
/// # Errors
/// [`ModelError::AngleRange`]: the first angle, in the order A, E, B, C, D, that does not.
pub fn check(ranges: &AngleRanges, pose: &Pose) -> Result<(), ModelError> {
    for angle in Angle::ALL {
        let range = ranges.of(angle);
        let value_deg = pose.angle_rad(angle) / RAD_PER_DEG;
        if !(range.least_deg..=range.greatest_deg).contains(&value_deg) {
            return Err(ModelError::AngleRange {
                angle,
                value_deg,
                least_deg: range.least_deg,
                greatest_deg: range.greatest_deg,
            });
        }
    }
    Ok(())
}

/// Checks that every range has an inside; an infinite end leaves that side open.
///
/// # Errors
/// [`ModelError::AngleRangeCrossed`].
pub fn check_ranges(ranges: &AngleRanges) -> Result<(), ModelError> {
    for angle in Angle::ALL {
        let range = ranges.of(angle);
        let ends = range.least_deg.partial_cmp(&range.greatest_deg);
        if ends != Some(core::cmp::Ordering::Less) {
            return Err(ModelError::AngleRangeCrossed {
                angle,
                least_deg: range.least_deg,
                greatest_deg: range.greatest_deg,
            });
        }
    }
    Ok(())
}

/// The pose of a tip position inside the workspace: it is reached, every angle is in its range, and arms AE and BC have not
/// passed each other.
///
/// θA ≥ θB stands in no stop that the thesis names, but without it the least θD of the 4-brake layout is 36.5°, not the 51°
/// of table 4.2 (gap `base-order`).
///
/// # Errors
/// Those of [`inverse::pose`] and [`check`]; [`ModelError::BaseArmsCrossed`].
pub fn reach(arms: &Arms, ranges: &AngleRanges, tip_m: [f64; 2]) -> Result<Pose, ModelError> {
    let pose = inverse::pose(arms, tip_m)?;
    inside(ranges, &pose)?;
    Ok(pose)
}

/// Checks that a pose is inside the workspace, as [`reach`] has it.
///
/// # Errors
/// Those of [`check`]; [`ModelError::BaseArmsCrossed`].
pub fn inside(ranges: &AngleRanges, pose: &Pose) -> Result<(), ModelError> {
    check(ranges, pose)?;
    if pose.theta_a_rad < pose.theta_b_rad {
        return Err(ModelError::BaseArmsCrossed {
            theta_a_deg: pose.theta_a_rad / RAD_PER_DEG,
            theta_b_deg: pose.theta_b_rad / RAD_PER_DEG,
        });
    }
    Ok(())
}
