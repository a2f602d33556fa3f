//! This file says how the base joints are turned when the tip is at a point: (5.18) to (5.32).

use core::f64::consts::{FRAC_PI_2, PI};

use rigproof_spec::geometry::Arms;

use super::circles::{apex, beside};
use super::{Pair, Pose, check_arms, from_to, point_a_m, point_b_m, pose_of_points, singularity};
use crate::error::ModelError;

/// The pose that belongs to a tip position.
///
/// Joint E is the point at `L_AE` from A and `L_ED` from the tip, to the left of the way from A to the tip; joint C
/// likewise from B, to the right, which is what (5.18) to (5.32) compute by the law of cosines.
///
/// | symbol | here | unit |
/// |---|---|---|
/// | x, y | `tip_m` | m |
/// | θA, θB, θE, θC, θD | [`Pose`] | rad |
///
/// # Errors
/// [`ModelError::ArmLength`]; [`ModelError::NotFinite`]; [`ModelError::Unreachable`]; [`ModelError::Singular`] at a
/// singularity and where the outer arms would have to cross over.
///
/// ```
/// use rigproof_model::linkage::inverse;
/// use rigproof_spec::geometry::arms;
/// use rigproof_spec::layout::Layout;
/// // On the y axis the 4-brake linkage of table 4.1 is its own mirror image: θA = 180° − θB.
/// let pose = inverse::pose(&arms(Layout::FourBrake), [0.0, 0.41])?;
/// assert!((pose.theta_a_rad + pose.theta_b_rad - core::f64::consts::PI).abs() < 1e-14);
/// # Ok::<(), rigproof_model::ModelError>(())
/// ```
pub fn pose(arms: &Arms, tip_m: [f64; 2]) -> Result<Pose, ModelError> {
    check_arms(arms)?;
    let [x_m, y_m] = tip_m;
    for (quantity, value) in [("x of the tip", x_m), ("y of the tip", y_m)] {
        if !value.is_finite() {
            let unit = "m";
            return Err(ModelError::NotFinite {
                quantity,
                value,
                unit,
            });
        }
    }
    let left = (point_a_m(arms), Pair::AeEd, [arms.l_ae_m, arms.l_ed_m]);
    let right = (point_b_m(arms), Pair::BcCd, [arms.l_bc_m, arms.l_cd_m]);
    let point_e_m = elbow(left, tip_m)?;
    let point_c_m = elbow(right, tip_m)?;
    let [ae_x, ae_y] = from_to(point_a_m(arms), point_e_m);
    let [bc_x, bc_y] = from_to(point_b_m(arms), point_c_m);
    // Both angles are cut straight down, where neither layout's arms can be.
    let theta_a_rad = PI - from_down(-ae_x, ae_y);
    let theta_b_rad = from_down(bc_x, bc_y);
    let points = [point_e_m, point_c_m, tip_m];
    pose_of_points(arms, [theta_a_rad, theta_b_rad], points)
}

/// The joint between a pair of arms that run from a base joint to the tip: E to the left of that way, C to the right.
fn elbow(
    (base_m, pair, [inner_m, outer_m]): ([f64; 2], Pair, [f64; 2]),
    tip_m: [f64; 2],
) -> Result<[f64; 2], ModelError> {
    let (base, side) = match pair {
        Pair::AeEd => ("A", 1.0),
        Pair::BcCd | Pair::EdCd => ("B", -1.0),
    };
    let [to_tip_x, to_tip_y] = from_to(base_m, tip_m);
    let distance_m = libm::hypot(to_tip_x, to_tip_y);
    let Some([along, height]) = apex(distance_m, inner_m, outer_m) else {
        if distance_m == 0.0 && inner_m == outer_m {
            // The outer arm lies folded back on the inner one.
            return Err(singularity::at(pair, 180.0));
        }
        let [x_m, y_m] = tip_m;
        return Err(ModelError::Unreachable {
            x_m,
            y_m,
            base,
            distance_m,
            least_m: (inner_m - outer_m).abs(),
            greatest_m: inner_m + outer_m,
        });
    };
    Ok(beside(base_m, tip_m, distance_m, [along, side * height]))
}

/// The angle of a vector from the x axis, from −π/2 to below 3π/2, rad.
fn from_down(x: f64, y: f64) -> f64 {
    let angle_rad = libm::atan2(y, x);
    if angle_rad < -FRAC_PI_2 {
        angle_rad + 2.0 * PI
    } else {
        angle_rad
    }
}
