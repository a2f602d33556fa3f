//! This file says how far the laws in single precision are from the same laws in double precision.

use std::collections::BTreeMap;

use nalgebra::Vector2;
use rayon::prelude::*;
use rigproof_impl::law::Law as _;
use rigproof_impl::number::Real;
use rigproof_impl::path::Path as _;
use rigproof_model::brake::torque_gain;
use rigproof_model::control::desired_velocity::desired_velocity;
use rigproof_model::control::path::Nearest;
use rigproof_model::control::{Sensed, tip_mass};
use rigproof_model::linkage::singularity::{Pair, measure};
use rigproof_model::rig::Parameters;
use rigproof_spec::command::{Command, Reason};
use rigproof_spec::inertia::inertia;

use crate::agree::ticks;
use crate::both::{
    View, reference_command, reference_nearest, reference_path, reference_rows, rig_law, rig_path,
    sensed, situation,
};
use crate::budget::assert_within_budget;
use crate::permitted::apart_a;
use crate::sample::{LawKind, Sampler, Tick};
use crate::tally::quantiles;

/// Ticks that may decide otherwise, or take another foot or level, as a share of all; each has a [`Cause`] that was checked. Of five million 54.
const GREATEST_SHARE_OF_TIES: f64 = 1.3e-5;
/// Ticks whose currents may differ by more than [`ROUNDING_A`], as a share of all; each is checked: nudging the tick moves the currents in double
/// precision as much, or nine tenths of the way to these.
const GREATEST_SHARE_AMPLIFIED: f64 = 3e-4;
/// Currents that differ by no more than this differ by rounding, A. What differs by more has to be amplified.
const ROUNDING_A: f64 = 1e-5;
/// Currents that may at all count as equal, A. What is neither amplified nor beyond this goes to the budget of `tests/budgets.toml`, which is
/// nearer to [`ROUNDING_A`].
const EQUAL_A: f64 = 1e-3;
/// Least sine between two arms at which ticks are compared: 2°, where table 4.2 stops at 10°.
const LEAST_SINE: f64 = 0.035;
/// Size of the nudges, relative: some digits of a float, which a pose near a singularity multiplies.
const NUDGES: [f64; 3] = [2e-7, 4e-6, 1e-4];
/// Nudges of each size that are tried.
const TRIES: usize = 300;
/// Ticks of one seed.
const CHUNK: u64 = 1000;
/// Wrong ones that are shown.
const SHOWN: usize = 30;
/// What rounding to floats makes of a cost, relative to what it is made of; some of it multiplied by the mass of a pose near a singularity.
const SINGLE: f64 = 5e-6;
/// The least of the nudges.
const LEAST_NUDGE: f64 = NUDGES[0];
/// Sine up to which a tangent counts as that of a point.
const PARALLEL: f64 = 0.01;
/// How much further one point of a path may be that is as near in single precision, m.
const AS_NEAR_M: f64 = 1e-6;

fn command<R: Real>(tick: &Tick) -> Command {
    let mut law = rig_law::<R>(tick).expect("plain settings");
    law.command(&situation(tick)).into()
}

/// The tick with everything that is measured moved by a share of itself, the angles by rad.
fn nudged(tick: &Tick, size: f64, nudger: &mut Sampler) -> Tick {
    let mut tick = tick.clone();
    let mut moved = |[x, y]: [f64; 2]| {
        let length = libm::hypot(x, y);
        [x, y].map(|component| component + size * length * nudger.nudge())
    };
    tick.velocity_m_s = moved(tick.velocity_m_s);
    tick.force_n = moved(tick.force_n);
    tick.base_rad = tick
        .base_rad
        .map(|angle_rad| angle_rad + size * nudger.nudge());
    tick
}

/// Why single precision answers otherwise than double precision.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Cause {
    /// The currents differ, and nudging the tick moves them as much in double precision.
    Amplified,
    /// Double precision decides so when the tick is nudged.
    Nudge,
    /// Of points of the path that are as near in single precision it takes another, and the reference answers so when it is given that one.
    Foot,
    /// The same currents; only a brake that gets none is named otherwise.
    Name,
    /// Optimal control takes another brake or level, which costs as much in single precision.
    Level,
}

/// What became of many ticks.
#[derive(Default)]
struct Tally {
    rounding_a: Vec<f64>,
    causes: BTreeMap<Cause, u64>,
    wrong: Vec<String>,
}

impl Tally {
    fn add(&mut self, tick: &Tick, nudger: &mut Sampler) {
        let (double, single) = (command::<f64>(tick), command::<f32>(tick));
        let apart_a = apart_a(&double, &single);
        let same = double.reason == single.reason;
        if same && apart_a <= ROUNDING_A {
            return self.rounding_a.push(apart_a);
        }
        match cause(tick, &double, &single, nudger) {
            Some(cause) => *self.causes.entry(cause).or_default() += 1,
            None if same && apart_a <= EQUAL_A => self.rounding_a.push(apart_a),
            None => self.wrong.push(format!(
                "{double:?}, in single precision {single:?}, in {tick:?}"
            )),
        }
    }

    fn join(mut self, other: Tally) -> Tally {
        self.rounding_a.extend(other.rounding_a);
        self.wrong.extend(other.wrong);
        for (cause, count) in other.causes {
            *self.causes.entry(cause).or_default() += count;
        }
        self
    }
}

/// The first cause that is found.
fn cause(tick: &Tick, double: &Command, single: &Command, nudger: &mut Sampler) -> Option<Cause> {
    let apart_a = apart_a(double, single);
    let same = double.reason == single.reason;
    let takes = |other: Command| {
        let reached = self::apart_a(&other, single) <= 0.1 * apart_a;
        let moved = self::apart_a(double, &other) >= apart_a;
        other.reason == single.reason && (!same || reached || moved)
    };
    let mut nudges = NUDGES.into_iter().flat_map(|size| [size; TRIES]);
    if nudges.any(|size| takes(command::<f64>(&nudged(tick, size, nudger)))) {
        return Some(if same { Cause::Amplified } else { Cause::Nudge });
    }
    let of_pairs = [double, single].map(|command| matches!(command.reason, Reason::ChosenPair(..)));
    if of_pairs == [true; 2] && apart_a <= ROUNDING_A {
        return Some(Cause::Name);
    }
    if let Some(seen) = as_seen(tick) {
        let given = |tick: &Tick| reference_command(tick, View::Given(seen));
        let reached = |other: Command| {
            other.reason == single.reason && self::apart_a(&other, single) <= EQUAL_A
        };
        let near = [0.0; TRIES].map(|_| nudged(tick, LEAST_NUDGE, nudger));
        if core::iter::once(tick)
            .chain(&near)
            .filter_map(given)
            .any(reached)
        {
            return Some(Cause::Foot);
        }
    }
    is_another_level(tick, double, single).then_some(Cause::Level)
}

/// The nearest point of the path as single precision sees it, if it is one of the path, and as near as any, to a float.
fn as_seen(tick: &Tick) -> Option<Nearest> {
    let path = reference_path(&tick.path).ok()?;
    let narrow = rig_path::<f32>(&tick.path)?.nearest(situation::<f32>(tick).linkage.tip_m);
    let tip_m = <[f64; 2]>::from(situation::<f64>(tick).linkage.tip_m);
    let tangent = Vector2::from(<[f32; 2]>::from(narrow.tangent).map(f64::from)).normalize();
    let offset_m = f64::from(narrow.offset_m);
    let seen = Nearest {
        foot_m: Vector2::from(tip_m) - Vector2::new(-tangent.y, tangent.x) * offset_m,
        tangent,
        offset_m,
    };
    let nearest = path.nearest(tip_m);
    let as_near = |foot_m: Vector2<f64>| {
        let away_m = (Vector2::from(tip_m) - foot_m).norm();
        (away_m - nearest.distance_m()).abs() <= AS_NEAR_M
    };
    let on_path = path.nearest(seen.foot_m.into()).distance_m() <= AS_NEAR_M;
    if as_near(seen.foot_m) && on_path {
        return Some(seen);
    }
    // In a bend that is tighter than a float the tangent is that of another point of it: the one beside which the path runs so.
    let left = Vector2::new(-tangent.y, tangent.x);
    let beside = [1e-4, -1e-4, 1e-3, -1e-3].map(|off_m| nearest.foot_m + left * off_m);
    beside.into_iter().find_map(|point_m| {
        let other = path.nearest(point_m.into());
        let is_parallel = other.tangent.perp(&tangent).abs() <= PARALLEL;
        (is_parallel && as_near(other.foot_m)).then_some(seen)
    })
}

/// Whether the two commands are those of optimal control for forces that cost the same to [`SINGLE`] of what the cost is made of.
fn is_another_level(tick: &Tick, double: &Command, single: &Command) -> bool {
    let LawKind::Optimal(_) = tick.law else {
        return false;
    };
    let costs = [double, single].map(|command| least_cost(tick, command));
    matches!(costs, [Some([one, slack]), Some([other, more])] if (one - other).abs() <= SINGLE * (slack + more))
}

/// What a command of optimal control costs, and the sum of the magnitudes that rounding acts on; the least of the forces that it may mean.
fn least_cost(tick: &Tick, command: &Command) -> Option<[f64; 2]> {
    let LawKind::Optimal([angle, energy, horizon_s]) = tick.law else {
        return None;
    };
    let sensed = sensed(tick)?;
    let parameters = Parameters {
        layout: tick.layout,
        arms: tick.arms,
        inertia: inertia(tick.layout),
    };
    let mass = tip_mass(&parameters, &sensed.pose)?;
    let (v, push) = (
        Vector2::from(tick.velocity_m_s),
        Vector2::from(tick.force_n),
    );
    let nearest = reference_nearest(tick)?;
    let desired = desired_velocity(&nearest, push, tick.boundary_m).direction;
    let kinetic = |v: Vector2<f64>| v.dot(&(mass * v));
    let mobility = mass.try_inverse()?;
    let cost = |brake_n: Vector2<f64>| {
        let after = v + mobility * (push + brake_n) * horizon_s;
        let off = libm::atan2(desired.perp(&after), desired.dot(&after));
        let ratio = kinetic(after) / kinetic(v);
        let change = ratio - 1.0;
        // An angle is rounded by as much as the velocity that it is of.
        let turned = (v.norm() + (mobility * push).norm() * horizon_s) / after.norm();
        [
            angle * off * off + energy * change * change,
            angle * off.abs() * (off.abs() + turned)
                + energy * change.abs() * (ratio + turned + 1.0),
        ]
    };
    let Reason::Chosen(joint) = command.reason else {
        return Some(cost(Vector2::zeros()));
    };
    let row = *reference_rows(tick)?.get(joint as usize)?;
    let against = row * (-row.dot(&v).signum() / row.norm());
    let current_a = command.currents_a[joint as usize];
    let most_n = torque_gain(joint, current_a) * row.norm();
    // Below the off-state torque no current tells which force was meant.
    let levels = (1..=20).map(|level| tick.limit_n * f64::from(level) / 20.0);
    let forces: Vec<f64> = if current_a > 0.0 {
        vec![most_n]
    } else {
        levels
            .filter(|force_n| *force_n <= most_n * (1.0 + SINGLE))
            .collect()
    };
    let costs = forces.into_iter().map(|force_n| cost(against * force_n));
    costs.min_by(|[one, _], [other, _]| one.total_cmp(other))
}

#[test]
fn single_precision_decides_as_double_precision_but_for_ties_of_its_own() {
    let ticks = ticks() / 2;
    let seeds = 2_003_000..2_003_000 + ticks.div_ceil(CHUNK);
    let all = seeds.into_par_iter().map(|seed| {
        let (mut sampler, mut nudger) = (Sampler::new(seed), Sampler::new(!seed));
        let mut tally = Tally::default();
        let mut compared = 0;
        while compared < CHUNK {
            let tick = sampler.plain();
            if sensed(&tick).is_some_and(|sensed| is_away(&sensed)) {
                compared += 1;
                tally.add(&tick, &mut nudger);
            }
        }
        tally
    });
    let all = all.reduce(Tally::default, Tally::join);
    println!("{ticks} ticks: {}", quantiles(&all.rounding_a));
    println!("{:?}, {} wrong", all.causes, all.wrong.len());
    let wrong: Vec<_> = all.wrong.iter().take(SHOWN).cloned().collect();
    assert!(
        wrong.is_empty(),
        "{} wrong: {}",
        all.wrong.len(),
        wrong.join("\n")
    );
    let count = |cause| all.causes.get(&cause).copied().unwrap_or(0) as f64;
    let ties: f64 = [Cause::Nudge, Cause::Foot, Cause::Name, Cause::Level]
        .into_iter()
        .map(count)
        .sum();
    assert!(ties <= GREATEST_SHARE_OF_TIES * ticks as f64);
    assert!(count(Cause::Amplified) <= GREATEST_SHARE_AMPLIFIED * ticks as f64);
    assert_within_budget("rig_law_current_single", all.rounding_a);
}

fn is_away(sensed: &Sensed) -> bool {
    let sines = Pair::ALL.map(|pair| measure(&sensed.pose, pair));
    sines.iter().all(|sine| *sine > LEAST_SINE)
}
