//! This file says what a command of optimal control costs, and when two commands cost the same to rounding.

use nalgebra::{Matrix2, Vector2};
use rigproof_model::brake::current_gain;
use rigproof_model::control::desired_velocity::desired_velocity;
use rigproof_model::control::force_angle::opposing_force;
use rigproof_model::control::tip_mass;
use rigproof_spec::command::{Command, Reason};
use rigproof_spec::tables::brake_table;

use super::answer::Answer;
use super::both::{parameters, reference_nearest, reference_rows, sensed};
use super::tick::Tick;
use crate::built_in::Kind;

/// How far a command's current may be from that of the level that it means, A for each unit of rounding.
const MEANT_A: f64 = 100.0;

/// A cost, and the sum of the magnitudes of which rounding takes its share.
type Cost = [f64; 2];

/// Whether a command and an answer are those of optimal control for forces that cost the same to `rounding`, relative, of what their costs
/// are made of.
pub fn cost_the_same(tick: &Tick, one: &Command, other: impl Into<Answer>, rounding: f64) -> bool {
    let Some([one, parts]) = least_cost(tick, one, rounding) else {
        return false;
    };
    let mut others = other.into().of_one_brake();
    others.any(|other| {
        let cost = least_cost(tick, &other, rounding);
        cost.is_some_and(|[other, more]| (one - other).abs() <= rounding * (parts + more))
    })
}

/// What optimal control weighs in a tick.
struct Weighing {
    weights: [f64; 2],
    mass: Matrix2<f64>,
    before: Vector2<f64>,
    pushed: Vector2<f64>,
    desired: Vector2<f64>,
}

impl Weighing {
    /// Where the push led and a brake's push, m/s, are added.
    fn cost(&self, braked: Vector2<f64>) -> Cost {
        let [angle, energy] = self.weights;
        let (before, after) = (self.before, self.pushed + braked);
        let off = libm::atan2(self.desired.perp(&after), self.desired.dot(&after));
        let kinetic = |v: Vector2<f64>| v.dot(&(self.mass * v));
        // Near a singularity the products are far greater than what they come to.
        let products = |v: Vector2<f64>| v.abs().dot(&(self.mass.abs() * v.abs()));
        let change = kinetic(after) / kinetic(before) - 1.0;
        // An angle is rounded by as much as the velocity that it is of.
        let gained = self.pushed - before;
        let turned = (before.norm() + gained.norm() + braked.norm()) / after.norm();
        let energies = (products(after) * (1.0 + turned) + products(before)) / kinetic(before);
        [
            angle * off * off + energy * change * change,
            angle * off.abs() * (off.abs() + turned) + energy * change.abs() * energies,
        ]
    }
}

/// What a command costs: the least of the forces that it may mean.
fn least_cost(tick: &Tick, command: &Command, rounding: f64) -> Option<Cost> {
    let Kind::Optimal {
        weight_angle,
        weight_energy,
        horizon_s,
    } = tick.law
    else {
        return None;
    };
    let sensed = sensed(tick)?;
    let mass = tip_mass(&parameters(tick), &sensed.pose)?;
    let mobility = mass.try_inverse()?;
    let before = Vector2::from(tick.velocity_m_s);
    let push = Vector2::from(tick.force_n);
    let weighing = Weighing {
        weights: [weight_angle, weight_energy],
        mass,
        before,
        pushed: before + mobility * push * horizon_s,
        desired: desired_velocity(&reference_nearest(tick)?, push, tick.boundary_m).direction,
    };
    let mut others_a = command.currents_a;
    let chosen = match command.reason {
        Reason::Chosen(joint) => {
            let own_a = others_a.get_mut(joint as usize)?;
            Some((joint, std::mem::take(own_a)))
        }
        Reason::NoneHelps => None,
        _ => return None,
    };
    if others_a != [0.0; 4] {
        return None;
    }
    let Some((joint, current_a)) = chosen else {
        return Some(weighing.cost(Vector2::zeros()));
    };
    let row = *reference_rows(tick)?.get(joint as usize)?;
    let slowed = mobility * (opposing_force(row, before)? / row.norm()) * horizon_s;
    let stop_n = -row.dot(&weighing.pushed) / row.dot(&slowed);
    if stop_n.is_nan() || stop_n <= 0.0 {
        // The push stops the joint or turns it round: no force of its brake is tried, as of a joint that stands.
        return None;
    }
    // A level is meant if the reference asks for the command's current for it; below the off-state torque that is true of several. None
    // turns the joint round.
    let levels = (1..=20).map(|level| (tick.limit_n * f64::from(level) / 20.0).min(stop_n));
    let table = brake_table(joint);
    let meant = levels.filter(|force_n| {
        (current_gain(&table, force_n / row.norm()) - current_a).abs() <= rounding * MEANT_A
    });
    let costs = meant.map(|force_n| weighing.cost(slowed * force_n));
    costs.min_by(|[one, _], [other, _]| one.total_cmp(other))
}
