//! This file says how near two arms are to being parallel, where the linkage loses a direction.

use rigproof_spec::geometry::Angle;
use rigproof_spec::units::RAD_PER_DEG;

use super::Pose;
use crate::error::ModelError;

/// Two arms that are parallel at a singularity (§4.5).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Pair {
    /// AE and ED: the determinant of `J_θ` is zero, an inverse singularity, the reach of the left side.
    AeEd,
    /// BC and CD: the determinant of `J_θ` is zero, an inverse singularity, the reach of the right side.
    BcCd,
    /// ED and CD: the determinant of `J_x` is zero, a forward singularity.
    EdCd,
}

impl Pair {
    /// All pairs.
    pub const ALL: [Pair; 3] = [Pair::AeEd, Pair::BcCd, Pair::EdCd];

    /// The names of the two arms.
    pub const fn arms(self) -> [&'static str; 2] {
        match self {
            Pair::AeEd => ["AE", "ED"],
            Pair::BcCd => ["BC", "CD"],
            Pair::EdCd => ["ED", "CD"],
        }
    }

    /// The angle between them.
    pub const fn angle(self) -> Angle {
        match self {
            Pair::AeEd => Angle::E,
            Pair::BcCd => Angle::C,
            Pair::EdCd => Angle::D,
        }
    }

    /// Between which two angles, themselves not allowed, the thesis's assembly lies, degrees.
    pub const fn range_deg(self) -> [f64; 2] {
        match self {
            Pair::AeEd => [180.0, 360.0],
            Pair::BcCd | Pair::EdCd => [0.0, 180.0],
        }
    }
}

/// Least [`measure`] at which a pose is computed: below it a tip position in f64 no longer gives the base angles to
/// 1e-10 rad.
pub const LEAST_MEASURE: f64 = 1e-5;

/// How far a pose is from the singularity of a pair: the sine of the angle between the two arms, 0 at the singularity, 1
/// at a right angle, negative in another assembly than the thesis's.
pub fn measure(pose: &Pose, pair: Pair) -> f64 {
    let sine = libm::sin(pose.angle_rad(pair.angle()));
    match pair {
        Pair::AeEd => -sine,
        Pair::BcCd | Pair::EdCd => sine,
    }
}

/// Checks that a pose is away from its singularities.
///
/// # Errors
/// [`ModelError::Singular`]: a [`measure`] is below [`LEAST_MEASURE`].
pub fn check(pose: &Pose) -> Result<(), ModelError> {
    for pair in Pair::ALL {
        let measure = measure(pose, pair);
        if measure.is_nan() || measure < LEAST_MEASURE {
            let [least_deg, greatest_deg] = pair.range_deg();
            return Err(ModelError::Singular {
                pair,
                value_deg: pose.angle_rad(pair.angle()) / RAD_PER_DEG,
                least_deg,
                greatest_deg,
            });
        }
    }
    Ok(())
}
