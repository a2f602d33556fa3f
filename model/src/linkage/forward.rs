//! This file says where the tip is when the base joints are turned: (5.1) to (5.17).

use rigproof_spec::geometry::Arms;

use super::circles::{apex, beside};
use super::{
    Pair, Pose, along, check_arms, from_to, point_a_m, point_b_m, pose_of_points, singularity,
};
use crate::error::ModelError;

/// The pose that belongs to two base angles.
///
/// Joints E and C follow from the base angles; the tip is the point at `L_ED` from E and `L_CD` from C, to the left of the
/// way from E to C, which is what (5.1) to (5.15) compute by the law of cosines.
///
/// | symbol | here | unit |
/// |---|---|---|
/// | θA, θB | `theta_a_rad`, `theta_b_rad` | rad, any finite number |
/// | θE, θC, θD | [`Pose`] | rad |
/// | x, y | `tip_m` | m |
///
/// # Errors
/// [`ModelError::ArmLength`]; [`ModelError::NotFinite`]; [`ModelError::CannotClose`] when the outer arms do not reach each
/// other; [`ModelError::Singular`] at a singularity and in every assembly that lies beyond one.
///
/// ```
/// use rigproof_model::linkage::forward;
/// use rigproof_spec::geometry::arms;
/// use rigproof_spec::layout::Layout;
/// use rigproof_spec::units::rad_from_deg;
/// // The 3-brake arms of table 4.1 with AE straight to the left and BC straight up: the tip is at (−30.5 cm, 30.5 cm).
/// let arms = arms(Layout::ThreeBrake);
/// let pose = forward::pose(&arms, rad_from_deg(180.0), rad_from_deg(90.0))?;
/// let [x_m, y_m] = pose.tip_m;
/// assert!((x_m + 0.305).abs() < 1e-15 && (y_m - 0.305).abs() < 1e-15);
/// # Ok::<(), rigproof_model::ModelError>(())
/// ```
pub fn pose(arms: &Arms, theta_a_rad: f64, theta_b_rad: f64) -> Result<Pose, ModelError> {
    check_arms(arms)?;
    for (quantity, value) in [("θA", theta_a_rad), ("θB", theta_b_rad)] {
        if !value.is_finite() {
            let unit = "rad";
            return Err(ModelError::NotFinite {
                quantity,
                value,
                unit,
            });
        }
    }
    let point_e_m = along(point_a_m(arms), arms.l_ae_m, theta_a_rad);
    let point_c_m = along(point_b_m(arms), arms.l_bc_m, theta_b_rad);
    let [l_ce_x, l_ce_y] = from_to(point_e_m, point_c_m);
    let l_ce = libm::hypot(l_ce_x, l_ce_y);
    let Some(place) = apex(l_ce, arms.l_ed_m, arms.l_cd_m) else {
        if l_ce == 0.0 && arms.l_ed_m == arms.l_cd_m {
            return Err(singularity::at(Pair::EdCd, 0.0));
        }
        return Err(ModelError::CannotClose {
            distance_m: l_ce,
            least_m: (arms.l_ed_m - arms.l_cd_m).abs(),
            greatest_m: arms.l_ed_m + arms.l_cd_m,
        });
    };
    let tip_m = beside(point_e_m, point_c_m, l_ce, place);
    let points = [point_e_m, point_c_m, tip_m];
    pose_of_points(arms, [theta_a_rad, theta_b_rad], points)
}
