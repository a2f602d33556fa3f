//! This file asks what the nominal model lacks along a recording: generalised forces that its equations leave over.

use super::linkage::{Pair, Pose, cross, dot, plus, turned};
use super::mass::Dynamics;
use super::run::{Sample, shown_theta};
use super::setup::Setup;
use crate::effect::Effect;
use crate::form::Form;
use rigproof_spec::geometry::arms;
use rigproof_spec::inertia::inertia;

/// One sample in the eyes of the nominal model.
pub struct Seen {
    pub pose: Pose,
    /// Rates of the joints A, E, B, C, rad/s; 0 where one sticks.
    pub joint_rates: [f64; 4],
    /// What the equations lack along θA and θB, N·m, as a resistance.
    pub lacking_nm: Pair,
    /// What each hidden effect resists with, N·m.
    pub hidden_nm: Vec<Pair>,
    /// The direction of (θA, θB) that stuck joints leave free: `None` for both, the vector for one.
    pub free: Option<Pair>,
}

/// The samples at which something slides; the others, and those at which a joint begins or ceases to stick, are `None`.
pub fn seen(setup: &Setup, hidden: &[Effect], samples: &[Sample]) -> Vec<Option<Seen>> {
    samples
        .iter()
        .map(|sample| see(setup, hidden, sample))
        .collect()
}

fn see(setup: &Setup, hidden: &[Effect], sample: &Sample) -> Option<Seen> {
    if sample.changes {
        return None;
    }
    let arms = arms(setup.layout);
    // An encoder's scale acts on rates and accelerations as on angles; its offset does not.
    let shown = |x: Pair| {
        let moved = shown_theta(setup, hidden, plus(setup.start, 1.0, x));
        plus(moved, -1.0, shown_theta(setup, hidden, setup.start))
    };
    let theta = shown_theta(setup, hidden, sample.theta);
    let (mut rates, mut acceleration) = (shown(sample.rates), shown(sample.acceleration));
    if hidden.iter().any(|effect| effect.form == Form::Eccentric) {
        (rates, acceleration) = shown_motion(setup, hidden, sample);
    }
    let pose = Pose::at(&arms, theta)?;
    let free = free_direction(&pose, sample.stuck)?;
    let mut joint_rates = pose.rows.map(|row| dot(row, rates));
    for (rate, stuck) in joint_rates.iter_mut().zip(sample.stuck) {
        if stuck {
            *rate = 0.0;
        }
    }
    let form = Dynamics::new(&arms, &inertia(setup.layout), &pose, rates);
    let pushed = pose.tip_force_along(&arms, sample.shown_force_n);
    let mut lacking_nm = plus(
        plus(pushed, -1.0, form.bias),
        -1.0,
        form.times(acceleration),
    );
    for ((row, rate), yield_nm) in pose
        .rows
        .into_iter()
        .zip(joint_rates)
        .zip(sample.nominal_yields_nm)
    {
        if rate != 0.0 {
            lacking_nm = plus(lacking_nm, -yield_nm * rate.signum(), row);
        }
    }
    // What has no torque of its own is what the others leave.
    let mut hidden_nm = sample.hidden_nm.clone();
    let own = hidden_nm
        .iter()
        .fold([0.0; 2], |sum, force| plus(sum, 1.0, *force));
    for (effect, force) in hidden.iter().zip(&mut hidden_nm) {
        if effect.is_residual() {
            *force = plus(lacking_nm, -1.0, own);
        }
    }
    Some(Seen {
        pose,
        joint_rates,
        lacking_nm,
        hidden_nm,
        free: free.direction(),
    })
}

/// Rates and accelerations that an encoder shows whose error is no straight line: from what it shows a moment before and after.
fn shown_motion(setup: &Setup, hidden: &[Effect], sample: &Sample) -> (Pair, Pair) {
    const MOMENT_S: f64 = 1e-3;
    let at = |moment_s: f64| {
        let moved = plus(sample.theta, moment_s, sample.rates);
        shown_theta(
            setup,
            hidden,
            plus(moved, 0.5 * moment_s * moment_s, sample.acceleration),
        )
    };
    let (before, now, after) = (at(-MOMENT_S), at(0.0), at(MOMENT_S));
    let rates = plus(after, -1.0, before).map(|x| x / (2.0 * MOMENT_S));
    let bend = plus(plus(after, 1.0, before), -2.0, now);
    (rates, bend.map(|x| x / (MOMENT_S * MOMENT_S)))
}

/// How much of the plane is free of stuck joints.
enum Free {
    Both,
    One(Pair),
}

impl Free {
    fn direction(self) -> Option<Pair> {
        match self {
            Free::Both => None,
            Free::One(direction) => Some(direction),
        }
    }
}

fn free_direction(pose: &Pose, stuck: [bool; 4]) -> Option<Free> {
    let mut held: Option<Pair> = None;
    for (row, stuck) in pose.rows.into_iter().zip(stuck) {
        match (stuck, held) {
            (false, _) => {}
            (true, None) => held = Some(row),
            (true, Some(first)) if cross(first, row).abs() < 1e-6 => {}
            (true, Some(_)) => return None,
        }
    }
    Some(held.map_or(Free::Both, |row| {
        let length = dot(row, row).sqrt();
        Free::One(turned(row).map(|x| x / length))
    }))
}

impl Seen {
    /// The part of generalised forces, N·m, that stuck joints do not take.
    pub fn told(&self, force: Pair) -> Pair {
        self.free
            .map_or(force, |free| free.map(|x| x * dot(free, force)))
    }
}
