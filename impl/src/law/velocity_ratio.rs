//! This file says which links are too fast for the desired direction, and slows them down: Swanson's velocity ratio
//! control (§2.2.2).

use rigproof_spec::command::Reason;
use rigproof_spec::joint::Joint;
use rigproof_spec::settings::RATIO_GAIN_RANGE_NM_S_PER_RAD;

use super::{Field, Law, Situation};
use crate::actuation::Actuation;
use crate::command::Command;
use crate::number::Real;
use crate::path::Path;
use crate::select::{Rows, joint_rate};
use crate::setting::setting;
use crate::vector::Vector;

/// Velocity ratio control (§2.2.2; gap `velocity-ratio`): the links AE and BC are slowed by brakes A and B, or by a coupling brake, E
/// or C, that slows the one and speeds up the other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VelocityRatio<R, P> {
    actuation: Actuation<R>,
    path: P,
    field: Field<R>,
    gain_nm_s_per_rad: R,
}

impl<R: Real, P: Path<R>> VelocityRatio<R, P> {
    /// The law on a path, with the boundary of the velocity field, m ([`rigproof_spec::settings::BOUNDARY_RANGE_M`]), and its gain, N·m·s/rad,
    /// inside [`RATIO_GAIN_RANGE_NM_S_PER_RAD`].
    pub fn new(
        actuation: Actuation<R>,
        path: P,
        boundary_m: f64,
        gain_nm_s_per_rad: f64,
    ) -> Option<VelocityRatio<R, P>> {
        Some(VelocityRatio {
            actuation,
            path,
            field: Field::new(boundary_m)?,
            gain_nm_s_per_rad: setting(gain_nm_s_per_rad, RATIO_GAIN_RANGE_NM_S_PER_RAD)?,
        })
    }
}

impl<R: Real, P: Path<R>> Law<R> for VelocityRatio<R, P> {
    fn command(&mut self, now: &Situation<R>) -> Command<R> {
        let (rows, nearest) = match self.actuation.situation_of_sound_rows(&self.path, now) {
            Ok(situation) => situation,
            Err(reason) => return Command::none(reason),
        };
        let direction = self.field.desired(&nearest, now.tip_force_n).direction;
        let [row_a, _, row_b, _] = now.rows;
        let velocity_m_s = now.decisive_velocity_m_s();
        let rate = |row| joint_rate(row, velocity_m_s);
        let actual = Vector::new(rate(row_a), rate(row_b));
        let wanted = Vector::new(row_a.dot(direction), row_b.dot(direction));
        let excess = excess_speeds(actual, wanted);
        let torque_nm = |excess_rad_s: R| self.gain_nm_s_per_rad * excess_rad_s;
        let (fast_a, fast_b) = (excess.x > R::zero(), excess.y > R::zero());
        if fast_a != fast_b
            && let Some(joint) = coupling(&rows, [row_a, row_b], velocity_m_s, actual, fast_a)
        {
            let faster = if fast_a { excess.x } else { excess.y };
            return self.actuation.one(joint, torque_nm(faster));
        }
        match (fast_a, fast_b) {
            _ if excess == Vector::zero() => Command::none(Reason::NothingToDo),
            (true, false) => self.actuation.one(Joint::A, torque_nm(excess.x)),
            (false, _) => self.actuation.one(Joint::B, torque_nm(excess.y)),
            (true, true) => self.actuation.two(
                (Joint::A, torque_nm(excess.x)),
                (Joint::B, torque_nm(excess.y)),
            ),
        }
    }

    fn actuation(&self) -> Option<&Actuation<R>> {
        Some(&self.actuation)
    }
}

/// By how much each link is faster than its share of the desired motion, rad/s: (1 − ratio)·|speed|, all its speed where it moves against it.
fn excess_speeds<R: Real>(actual: Vector<R>, wanted: Vector<R>) -> Vector<R> {
    let ratio = |wanted: R, actual: R| {
        if actual == R::zero() {
            R::zero()
        } else {
            wanted / actual
        }
    };
    let (ratio_a, ratio_b) = (ratio(wanted.x, actual.x), ratio(wanted.y, actual.y));
    let highest = if ratio_a > ratio_b { ratio_a } else { ratio_b };
    let excess = |ratio: R, actual: R| {
        if ratio > R::zero() {
            (R::of(1.0) - ratio / highest) * actual.magnitude()
        } else {
            actual.magnitude()
        }
    };
    Vector::new(excess(ratio_a, actual.x), excess(ratio_b, actual.y))
}

/// The coupling brake, if any, that slows the one link that is too fast and speeds up the other; of two, the one that takes more from the
/// fast link.
fn coupling<R: Real>(
    rows: &Rows<R>,
    [row_a, row_b]: [Vector<R>; 2],
    velocity_m_s: Vector<R>,
    actual: Vector<R>,
    fast_a: bool,
) -> Option<Joint> {
    let [_, row_e, _, row_c] = rows;
    let inverse = R::of(1.0) / row_a.cross(row_b);
    let mut best: Option<(R, Joint)> = None;
    for (joint, row) in [(Joint::E, row_e), (Joint::C, row_c)] {
        let Some(row) = row.filter(|row| joint_rate(*row, velocity_m_s) != R::zero()) else {
            continue;
        };
        // The joint's rate is so much of link A's and so much of link B's.
        let shares = Vector::new(row.cross(row_b), row_a.cross(row)) * inverse;
        // A brake takes from the links what its own joint loses.
        let torques = shares * -shares.dot(actual);
        let (fast, other, taken) = if fast_a {
            (torques.x * actual.x, torques.y * actual.y, shares.x)
        } else {
            (torques.y * actual.y, torques.x * actual.x, shares.y)
        };
        let helps = fast < R::zero() && other > R::zero();
        let taken = taken.magnitude();
        if helps && best.is_none_or(|(most, _)| taken > most) {
            best = Some((taken, joint));
        }
    }
    best.map(|(_, joint)| joint)
}

#[cfg(test)]
mod tests {
    use super::*;

    const BASE: [Vector<f64>; 2] = [Vector::new(1.7, 0.0), Vector::new(0.0, 1.3)];

    /// The coupling brake at rates of the links, rad/s, and the tip velocity that goes with them.
    fn coupled(rows: &Rows<f64>, [of_a, of_b]: [f64; 2], fast_a: bool) -> Option<Joint> {
        let velocity_m_s = Vector::new(of_a / 1.7, of_b / 1.3);
        coupling(rows, BASE, velocity_m_s, Vector::new(of_a, of_b), fast_a)
    }

    #[test]
    fn a_link_that_stands_is_not_sped_up_by_a_coupling_brake() {
        // The joint's rate is the difference of the links': its brake slows the one and speeds up the other.
        let rows = [None, Some(Vector::new(1.7, -1.3)), None, None];
        for speed in [0.31, -0.31] {
            for (actual, fast_a) in [([speed, 0.2 * speed], true), ([0.2 * speed, speed], false)] {
                assert_eq!(coupled(&rows, actual, fast_a), Some(Joint::E));
            }
            for (actual, fast_a) in [([speed, 0.0], true), ([0.0, speed], false)] {
                assert_eq!(coupled(&rows, actual, fast_a), None);
            }
        }
    }

    #[test]
    fn of_two_coupling_brakes_the_one_that_takes_more_acts_and_of_two_alike_the_first() {
        let (weak, strong) = (Some(Vector::new(1.7, -1.3)), Some(Vector::new(2.9, -1.9)));
        for (rows, expected) in [
            ([None, weak, None, strong], Joint::C),
            ([None, strong, None, weak], Joint::E),
            ([None, weak, None, weak], Joint::E),
        ] {
            assert_eq!(coupled(&rows, [0.31, 0.07], true), Some(expected));
        }
    }
}
