//! This file says which links are too fast for the desired direction, and slows them down: Swanson's velocity ratio
//! control (§2.2.2).

use nalgebra::{Matrix2, RowVector2, SMatrix, Vector2};
use rigproof_spec::command::{Command, Reason};
use rigproof_spec::joint::Joint;

use super::desired_velocity::desired_velocity;
use super::force_angle::joint_rate;
use super::path::Path;
use super::{Actuation, Controller, Sensed, setting};
use crate::brake::current_gain;
use crate::error::ModelError;
use rigproof_spec::settings::{BOUNDARY_RANGE_M, RATIO_GAIN_RANGE_NM_S_PER_RAD};
use rigproof_spec::tables::brake_table;

/// Velocity ratio control (§2.2.2; decision 0042).
///
/// "The desired velocity is translated into a set of link velocities. The ratio of desired to actual velocity for each
/// link is computed and normalized by the highest positive term. The links with ratios less than 1 are actuated in order
/// drive their ratio toward 1 by slowing them down. If coupling actuators are used, the velocity ratio controller first
/// checks to see if any coupling actuators produce the desired effect on the link velocities."
///
/// The links are arms AE and BC, slowed by brakes A and B; the coupling actuators are brakes E and C.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VelocityRatio<P> {
    actuation: Actuation,
    path: P,
    boundary_m: f64,
    gain_nm_s_per_rad: f64,
}

impl<P: Path> VelocityRatio<P> {
    /// The controller on a path, with the boundary of the velocity field, m, and its gain, N·m·s/rad.
    ///
    /// # Errors
    /// [`ModelError::SettingRange`]: the boundary is not between 10⁻⁷ m and 0.61 m, or the gain not between 0 and 10⁶
    /// N·m·s/rad.
    pub fn new(
        actuation: Actuation,
        path: P,
        boundary_m: f64,
        gain_nm_s_per_rad: f64,
    ) -> Result<VelocityRatio<P>, ModelError> {
        let gains = RATIO_GAIN_RANGE_NM_S_PER_RAD;
        let unit = "N·m·s/rad";
        Ok(VelocityRatio {
            actuation,
            path,
            boundary_m: setting(
                "the boundary of the velocity field",
                boundary_m,
                BOUNDARY_RANGE_M,
                "m",
            )?,
            gain_nm_s_per_rad: setting("the gain", gain_nm_s_per_rad, gains, unit)?,
        })
    }

    fn current_a(&self, joint: Joint, excess_rad_s: f64) -> f64 {
        current_gain(&brake_table(joint), self.gain_nm_s_per_rad * excess_rad_s)
    }
}

impl<P: Path> Controller for VelocityRatio<P> {
    fn command(&mut self, sensed: &Sensed) -> Command {
        let j = match self.actuation.jacobian(sensed) {
            Ok(j) => j,
            Err(reason) => return Command::none(reason),
        };
        let nearest = match Actuation::nearest(&self.path, sensed) {
            Ok(nearest) => nearest,
            Err(reason) => return Command::none(reason),
        };
        let desired =
            desired_velocity(&nearest, Vector2::from(sensed.tip_force_n), self.boundary_m);
        let links = base_rows(&j);
        let velocity_m_s = sensed.decisive_velocity_m_s();
        let rate = |row: usize| joint_rate(j.row(row).transpose(), velocity_m_s);
        let actual = Vector2::new(rate(0), rate(2));
        let wanted = links * desired.direction;
        let excess = excess_speeds([actual.x, actual.y], [wanted.x, wanted.y]);
        let [excess_a, excess_b] = excess;
        if excess == [0.0, 0.0] {
            return Command::none(Reason::NothingToDo);
        }
        if let Some(joint) = coupling(&self.actuation, &j, velocity_m_s, actual, excess) {
            return Actuation::one(joint, self.current_a(joint, excess_a.max(excess_b)));
        }
        match (excess_a > 0.0, excess_b > 0.0) {
            (true, false) => Actuation::one(Joint::A, self.current_a(Joint::A, excess_a)),
            (false, _) => Actuation::one(Joint::B, self.current_a(Joint::B, excess_b)),
            (true, true) => Actuation::two(
                (Joint::A, self.current_a(Joint::A, excess_a)),
                (Joint::B, self.current_a(Joint::B, excess_b)),
            ),
        }
    }
}

/// The rows of joints A and B: link speeds from the tip's velocity.
fn base_rows(j: &SMatrix<f64, 4, 2>) -> Matrix2<f64> {
    Matrix2::from_rows(&[j.fixed_rows::<1>(0), j.fixed_rows::<1>(2)])
}

/// By how much each link is faster than its share of the desired motion, rad/s: (1 − ratio)·|speed|.
///
/// A link that moves against the desired motion is too fast by all its speed: a brake can do no more than stop it. If no
/// ratio is positive that holds for both.
pub fn excess_speeds(actual_rad_s: [f64; 2], wanted: [f64; 2]) -> [f64; 2] {
    let [actual_a, actual_b] = actual_rad_s;
    let [wanted_a, wanted_b] = wanted;
    let ratio = |wanted: f64, actual: f64| if actual == 0.0 { 0.0 } else { wanted / actual };
    let (ratio_a, ratio_b) = (ratio(wanted_a, actual_a), ratio(wanted_b, actual_b));
    let highest = ratio_a.max(ratio_b);
    let excess = |ratio: f64, actual: f64| {
        if ratio > 0.0 {
            (1.0 - ratio / highest) * actual.abs()
        } else {
            actual.abs()
        }
    };
    [excess(ratio_a, actual_a), excess(ratio_b, actual_b)]
}

/// The coupling brake, if any, that slows the one link that is too fast and speeds up the other; of two, the one that
/// takes more from the fast link.
fn coupling(
    actuation: &Actuation,
    j: &SMatrix<f64, 4, 2>,
    velocity_m_s: Vector2<f64>,
    actual: Vector2<f64>,
    [excess_a, excess_b]: [f64; 2],
) -> Option<Joint> {
    let needed = match (excess_a > 0.0, excess_b > 0.0) {
        (true, false) => [-actual.x, actual.y],
        (false, true) => [actual.x, -actual.y],
        _ => return None,
    };
    let tip_from_links = base_rows(j).try_inverse()?;
    let mut best: Option<(f64, Joint)> = None;
    for (joint, row) in [(Joint::E, 1), (Joint::C, 3)] {
        if !actuation.layout().brakes().contains(&joint) {
            continue;
        }
        let through_links: RowVector2<f64> = j.row(row) * tip_from_links;
        let speed_rad_s = (through_links * actual).x;
        if joint_rate(j.row(row).transpose(), velocity_m_s) == 0.0 {
            continue;
        }
        // A brake takes from the links what its own joint loses.
        let torques = through_links * -speed_rad_s;
        let [needed_a, needed_b] = needed;
        let helps = torques.x * needed_a > 0.0 && torques.y * needed_b > 0.0;
        let taken = if excess_a > 0.0 { torques.x } else { torques.y };
        let taken = taken.abs() / speed_rad_s.abs();
        if helps && best.is_none_or(|(most, _)| taken > most) {
            best = Some((taken, joint));
        }
    }
    best.map(|(_, joint)| joint)
}
