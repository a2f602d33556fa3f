//! This file says how far the laws in single precision are from the same laws in double precision.

use std::collections::BTreeMap;

use nalgebra::Vector2;
use rayon::prelude::*;
use rigproof_certify::differential::answer::apart_a;
use rigproof_certify::differential::both::{
    View, reference_command, reference_path, rig_law, rig_path, sensed, situation,
};
use rigproof_certify::differential::level::cost_the_same;
use rigproof_certify::differential::nudger::Nudger;
use rigproof_certify::differential::tick::Tick;
use rigproof_impl::law::Law as _;
use rigproof_impl::number::Real;
use rigproof_impl::path::Path as _;
use rigproof_model::control::Sensed;
use rigproof_model::control::path::Nearest;
use rigproof_model::linkage::singularity::{Pair, measure};
use rigproof_spec::command::{Command, Reason};

use crate::budget::assert_within_budget;
use crate::impl_laws::agree::ticks;
use crate::impl_laws::sample::Sampler;
use crate::impl_laws::tally::quantiles;

/// Ticks that may decide otherwise, or take another foot or level, as a share of all; each has a [`Cause`] that was checked. Of five million 55.
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
/// What rounding to floats makes of a cost, relative to what it is made of.
const SINGLE: f64 = f32::EPSILON as f64;
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
fn nudged(tick: &Tick, size: f64, nudger: &mut Nudger) -> Tick {
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
    fn add(&mut self, tick: &Tick, nudger: &mut Nudger, place: &str) {
        let (double, single) = (command::<f64>(tick), command::<f32>(tick));
        let apart_a = apart_a(double.currents_a, single.currents_a);
        let same = double.reason == single.reason;
        if same && apart_a <= ROUNDING_A {
            return self.rounding_a.push(apart_a);
        }
        match cause(tick, &double, &single, nudger) {
            Some(cause) => *self.causes.entry(cause).or_default() += 1,
            None if same && apart_a <= EQUAL_A => self.rounding_a.push(apart_a),
            None => self.wrong.push(format!(
                "{place}: {double:?}, in single precision {single:?}, in {tick:?}"
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
fn cause(tick: &Tick, double: &Command, single: &Command, nudger: &mut Nudger) -> Option<Cause> {
    let apart_a = apart_a(double.currents_a, single.currents_a);
    let same = double.reason == single.reason;
    let takes = |other: Command| {
        let reached = self::apart_a(other.currents_a, single.currents_a) <= 0.1 * apart_a;
        let moved = self::apart_a(double.currents_a, other.currents_a) >= apart_a;
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
            other.reason == single.reason
                && self::apart_a(other.currents_a, single.currents_a) <= EQUAL_A
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
    cost_the_same(tick, double, *single, SINGLE).then_some(Cause::Level)
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

/// The ticks of a seed that are compared.
fn compared(seed: u64) -> impl Iterator<Item = Tick> {
    let mut sampler = Sampler::new(seed);
    let ticks = core::iter::repeat_with(move || sampler.plain());
    ticks.filter(|tick| sensed(tick).is_some_and(|sensed| is_away(&sensed)))
}

#[test]
fn single_precision_decides_as_double_precision_but_for_ties_of_its_own() {
    let ticks = ticks() / 2;
    let seeds = 2_003_000..2_003_000 + ticks.div_ceil(CHUNK);
    let all = seeds.into_par_iter().map(|seed| {
        let mut nudger = Nudger::new(!seed);
        let mut tally = Tally::default();
        for (number, tick) in (0..CHUNK).zip(compared(seed)) {
            let place = format!("seed {seed}, tick {number}");
            tally.add(&tick, &mut nudger, &place);
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
