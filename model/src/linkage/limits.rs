//! This file says whether a pose lies inside the ranges of its angles.

use rigproof_spec::geometry::{Angle, AngleRanges};
use rigproof_spec::units::RAD_PER_DEG;

use super::Pose;
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
