//! This file says which braking force costs least in direction and energy: Swanson's optimal control (§2.2.2).

use rigproof_spec::command::Reason;
use rigproof_spec::joint::Joint;
use rigproof_spec::settings::{HORIZON_RANGE_S, WEIGHT_RANGE};

use super::{Field, Law, Situation};
use crate::actuation::Actuation;
use crate::command::Command;
use crate::number::{Real, least};
use crate::path::Path;
use crate::select::proportional::opposing;
use crate::setting::setting;
use crate::tip_mass::{Bodies, TipMass};
use crate::vector::Vector;

/// Levels of force that are tried on each brake, besides none.
const LEVELS: u8 = 20;

/// What the law weighs, and how far it looks ahead.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weights<R> {
    /// Cost of the squared angle between velocity and desired velocity, 1/rad².
    pub angle: R,
    /// Cost of the squared change of kinetic energy as a share of the kinetic energy.
    pub energy: R,
    /// How long a force is imagined to act, s.
    pub horizon_s: R,
}

/// Optimal control (§2.2.2; gap `optimal-control`): of twenty levels of force on each brake, and none, the one that costs least.
///
/// Greatest work of a tick: 81 costs, of one angle each.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Optimal<R, P> {
    actuation: Actuation<R>,
    path: P,
    field: Field<R>,
    weights: Weights<R>,
    bodies: Bodies<R>,
}

impl<R: Real, P: Path<R>> Optimal<R, P> {
    /// The law on a path, with the boundary of the velocity field, m ([`rigproof_spec::settings::BOUNDARY_RANGE_M`]); the weights inside
    /// [`WEIGHT_RANGE`], the horizon inside [`HORIZON_RANGE_S`].
    pub fn new(
        actuation: Actuation<R>,
        path: P,
        boundary_m: f64,
        weights: Weights<f64>,
        bodies: Bodies<R>,
    ) -> Option<Optimal<R, P>> {
        Some(Optimal {
            actuation,
            path,
            field: Field::new(boundary_m)?,
            weights: Weights {
                angle: setting(weights.angle, WEIGHT_RANGE)?,
                energy: setting(weights.energy, WEIGHT_RANGE)?,
                horizon_s: setting(weights.horizon_s, HORIZON_RANGE_S)?,
            },
            bodies,
        })
    }
}

/// What a velocity costs.
struct Cost<R> {
    weights: Weights<R>,
    mass: TipMass<R>,
    energy_before: R,
    desired: Vector<R>,
}

impl<R: Real> Cost<R> {
    fn of(&self, velocity_m_s: Vector<R>) -> R {
        let across = self.desired.cross(velocity_m_s);
        let angle_rad = across.atan2(self.desired.dot(velocity_m_s));
        let energy = self.mass.square(velocity_m_s);
        let change = (energy - self.energy_before) / self.energy_before;
        self.weights.angle * angle_rad * angle_rad + self.weights.energy * change * change
    }
}

impl<R: Real, P: Path<R>> Law<R> for Optimal<R, P> {
    fn command(&mut self, now: &Situation<R>) -> Command<R> {
        let (rows, nearest) = match self.actuation.situation_of_sound_rows(&self.path, now) {
            Ok(situation) => situation,
            Err(reason) => return Command::none(reason),
        };
        let mass = self.bodies.tip_mass(&now.linkage, &now.rows);
        if !mass.is_definite() {
            return Command::none(Reason::SingularPose);
        }
        let velocity_m_s = now.decisive_velocity_m_s();
        if velocity_m_s == Vector::zero() {
            return Command::none(Reason::NothingToDo);
        }
        let gained = |force_n: Vector<R>| mass.acceleration_m_s2(force_n) * self.weights.horizon_s;
        let cost = Cost {
            weights: self.weights,
            mass,
            energy_before: mass.square(velocity_m_s),
            desired: self.field.desired(&nearest, now.tip_force_n).direction,
        };
        let pushed_m_s = velocity_m_s + gained(now.tip_force_n);
        let mut lowest = cost.of(pushed_m_s);
        let mut best: Option<(Joint, Option<Vector<R>>, R)> = None;
        for (joint, row) in Joint::ALL.into_iter().zip(rows) {
            let Some((slowed_m_s, stop_n)) = row.and_then(|row| {
                let against = opposing(row, velocity_m_s)? * (R::of(1.0) / row.norm());
                let slowed_m_s = gained(against);
                let stop_n = -row.dot(pushed_m_s) / row.dot(slowed_m_s);
                // A joint that the push stops or turns round needs no brake, and a brake never turns its joint round.
                (stop_n > R::zero()).then_some((slowed_m_s, stop_n))
            }) else {
                continue;
            };
            for level in 1..=LEVELS {
                let share = R::of(f64::from(level) / f64::from(LEVELS));
                let force_n = least(share * self.actuation.greatest_force_n(), stop_n);
                let cost = cost.of(pushed_m_s + slowed_m_s * force_n);
                if cost < lowest {
                    lowest = cost;
                    best = Some((joint, row, force_n));
                }
            }
        }
        match best {
            Some((joint, row, force_n)) => {
                let torque_nm = self.actuation.torque_nm(&row, force_n);
                self.actuation.one(joint, torque_nm)
            }
            None => Command::none(Reason::NoneHelps),
        }
    }

    fn actuation(&self) -> Option<&Actuation<R>> {
        Some(&self.actuation)
    }
}
