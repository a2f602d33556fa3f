//! This file says how brakes imitate springs and dampers along a path: the impedance control of §2.2.2.

use rigproof_spec::command::Reason;
use rigproof_spec::joint::Joint;
use rigproof_spec::settings::{DAMPING_RANGE_N_S_PER_M, STIFFNESS_RANGE_N_PER_M};

use super::{Law, Situation};
use crate::actuation::Actuation;
use crate::command::Command;
use crate::number::{Real, least};
use crate::path::{Nearest, Path};
use crate::select::Rows;
use crate::select::proportional::opposing;
use crate::setting::setting;
use crate::vector::Vector;

/// The virtual spring and dampers. Gomes's law is a spring alone; Charles's and Davis's have all three.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Virtual<R> {
    /// Spring across the path, N/m.
    pub stiffness_n_per_m: R,
    /// Damper across the path, N·s/m.
    pub damping_across_n_s_per_m: R,
    /// Damper along the path, N·s/m.
    pub damping_along_n_s_per_m: R,
}

/// Impedance control with torque translation (§2.2.2; gap `torque-translation`): the force of a spring and a damper across the path and a
/// damper along it, or only the part across, or only the part along, whichever first two brakes can make.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impedance<R, P> {
    actuation: Actuation<R>,
    path: P,
    elements: Virtual<R>,
}

impl<R: Real, P: Path<R>> Impedance<R, P> {
    /// The law on a path; the elements inside [`STIFFNESS_RANGE_N_PER_M`] and [`DAMPING_RANGE_N_S_PER_M`].
    pub fn new(
        actuation: Actuation<R>,
        path: P,
        elements: Virtual<f64>,
    ) -> Option<Impedance<R, P>> {
        let damping = |value: f64| setting(value, DAMPING_RANGE_N_S_PER_M);
        Some(Impedance {
            actuation,
            path,
            elements: Virtual {
                stiffness_n_per_m: setting(elements.stiffness_n_per_m, STIFFNESS_RANGE_N_PER_M)?,
                damping_across_n_s_per_m: damping(elements.damping_across_n_s_per_m)?,
                damping_along_n_s_per_m: damping(elements.damping_along_n_s_per_m)?,
            },
        })
    }

    /// The wanted force across the path and the one along it, N.
    fn wanted(&self, nearest: &Nearest<R>, velocity_m_s: Vector<R>) -> [Vector<R>; 2] {
        let tangent = nearest.tangent;
        let elements = &self.elements;
        let across_n = elements.stiffness_n_per_m * nearest.offset_m
            + elements.damping_across_n_s_per_m * tangent.cross(velocity_m_s);
        let along_n = elements.damping_along_n_s_per_m * tangent.dot(velocity_m_s);
        [tangent.left() * -across_n, tangent * -along_n]
    }

    /// The two torques, N·m, of a pair within what its brakes can give: both scaled down together, so that the direction of the force is kept.
    fn within_limits(&self, pair: [Share<R>; 2]) -> [Share<R>; 2] {
        let scale = pair
            .iter()
            .filter(|(_, torque_nm)| *torque_nm > R::zero())
            .map(|(joint, torque_nm)| self.actuation.greatest_nm(*joint) / *torque_nm)
            .fold(R::of(1.0), least);
        pair.map(|(joint, torque_nm)| (joint, torque_nm * scale))
    }
}

impl<R: Real, P: Path<R>> Law<R> for Impedance<R, P> {
    fn command(&mut self, now: &Situation<R>) -> Command<R> {
        let (rows, nearest) = match self.actuation.situation_of_sound_rows(&self.path, now) {
            Ok(situation) => situation,
            Err(reason) => return Command::none(reason),
        };
        let velocity_m_s = now.decisive_velocity_m_s();
        let [across, along] = self.wanted(&nearest, velocity_m_s);
        if across == Vector::zero() && along == Vector::zero() {
            return Command::none(Reason::NothingToDo);
        }
        let forces = rows.map(|row| opposing(row?, velocity_m_s));
        match [across + along, across, along]
            .into_iter()
            .find_map(|force_n| translate(&forces, force_n))
        {
            Some(pair) => {
                let [first, second] = self.within_limits(pair);
                self.actuation.two(first, second)
            }
            None => Command::none(Reason::NoneHelps),
        }
    }

    fn actuation(&self) -> Option<&Actuation<R>> {
        Some(&self.actuation)
    }
}

/// A brake and the magnitude of its torque, N·m.
type Share<R> = (Joint, R);

/// Sine of the angle between two brakes' forces below which they count as parallel, squared.
const PARALLEL_SQUARED: f64 = 1e-18;

/// The two brakes, of which one may be idle, that make a force at the tip with the least sum of torques; `None` if no two can.
///
/// `forces` are those of 1 N·m against the joints' motion, N; a joint at rest has none.
fn translate<R: Real>(forces: &Rows<R>, force_n: Vector<R>) -> Option<[Share<R>; 2]> {
    if force_n == Vector::zero() {
        return None;
    }
    let mut best: Option<(R, [Share<R>; 2])> = None;
    for (index, (joint, force)) in Joint::ALL.into_iter().zip(forces).enumerate() {
        for (other_joint, other) in Joint::ALL.into_iter().zip(forces).skip(index + 1) {
            if let (Some(force), Some(other)) = (force, other)
                && let Some([torque_nm, other_nm]) = pair([*force, *other], force_n)
                && best.is_none_or(|(sum_nm, _)| torque_nm + other_nm < sum_nm)
            {
                let shares = [(joint, torque_nm), (other_joint, other_nm)];
                best = Some((torque_nm + other_nm, shares));
            }
        }
    }
    best.map(|(_, shares)| shares)
}

/// Torques of two brakes that make a force together, N·m, if both push.
fn pair<R: Real>([one, other]: [Vector<R>; 2], force_n: Vector<R>) -> Option<[R; 2]> {
    let determinant = one.cross(other);
    let least = R::of(PARALLEL_SQUARED) * one.norm_squared() * other.norm_squared();
    if determinant * determinant < least {
        return None;
    }
    let torques_nm = [
        force_n.cross(other) / determinant,
        one.cross(force_n) / determinant,
    ];
    let [one_nm, other_nm] = torques_nm;
    (one_nm >= R::zero() && other_nm >= R::zero()).then_some(torques_nm)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn brakes_that_push_along_one_line_to_a_billionth_are_no_pair() {
        let between = Vector::new(1.0, 0.4e-9);
        for (sine, is_pair) in [(0.9e-9, false), (1.1e-9, true)] {
            for [one, other] in [[13.0, 0.07], [0.07, 13.0], [17.0, 19.0], [0.03, 0.05]] {
                let forces = [Vector::new(one, 0.0), Vector::new(other, other * sine)];
                assert_eq!(pair(forces, between).is_some(), is_pair, "{forces:?}");
            }
        }
    }
}
