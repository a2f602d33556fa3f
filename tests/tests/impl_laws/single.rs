//! This file says how far the laws in single precision are from the same laws in double precision.

use rigproof_impl::law::Law as _;
use rigproof_impl::number::Real;
use rigproof_model::control::Sensed;
use rigproof_model::linkage::singularity::{Pair, measure};
use rigproof_spec::command::Command;

use crate::agree::{quantiles, ticks};
use crate::both::{rig_law, sensed, situation};
use crate::budget::assert_within_budget;
use crate::permitted::apart_a;
use crate::sample::{Sampler, Tick};

/// Ticks that may decide otherwise, or whose currents differ by more than [`ROUNDING_A`], as a share of all; each is checked: double precision
/// does the same when the tick is nudged.
const GREATEST_SHARE: f64 = 1e-4;
/// Currents that differ by no more than this differ by rounding, A.
const ROUNDING_A: f64 = 1e-4;
/// Least sine between two arms at which ticks are compared: 2°, where table 4.2 stops at 10°.
const LEAST_SINE: f64 = 0.035;
/// Size of the nudges, relative: some digits of a float, which a pose near a singularity multiplies.
const NUDGES: [f64; 3] = [2e-7, 4e-6, 1e-4];
/// Nudges of each size that are tried.
const TRIES: u32 = 300;

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

#[test]
fn single_precision_decides_as_double_precision_but_for_ties_of_its_own() {
    let (mut sampler, mut nudger) = (Sampler::new(2_003), Sampler::new(2_011));
    let (mut rounding_a, mut amplified_a, mut ties) = (Vec::new(), Vec::new(), 0_u64);
    let ticks = ticks() / 2;
    let mut compared = 0;
    while compared < ticks {
        let tick = sampler.plain();
        if !sensed(&tick).is_some_and(|sensed| is_away(&sensed)) {
            continue;
        }
        compared += 1;
        let (double, single) = (command::<f64>(&tick), command::<f32>(&tick));
        let apart_a = apart_a(&double, &single);
        let same = double.reason == single.reason;
        if same && apart_a <= ROUNDING_A {
            rounding_a.push(apart_a);
            continue;
        }
        let turns = NUDGES.into_iter().any(|size| {
            (0..TRIES).any(|_| {
                let other = command::<f64>(&nudged(&tick, size, &mut nudger));
                let reached = self::apart_a(&other, &single) <= ROUNDING_A;
                let moved = self::apart_a(&double, &other) >= apart_a;
                other.reason == single.reason && (!same || reached || moved)
            })
        });
        assert!(
            turns,
            "{double:?}, in single precision {single:?}, in {tick:?}"
        );
        if same {
            amplified_a.push(apart_a);
        } else {
            ties += 1;
        }
    }
    println!("{ticks} ticks: {}", quantiles(&rounding_a));
    let amplified = amplified_a.len() as u64;
    println!(
        "{amplified} amplified: {}, {ties} ties",
        quantiles(&amplified_a)
    );
    assert!((ties + amplified) as f64 <= GREATEST_SHARE * ticks as f64);
    assert_within_budget("rig_law_current_single", rounding_a);
}

fn is_away(sensed: &Sensed) -> bool {
    let sines = Pair::ALL.map(|pair| measure(&sensed.pose, pair));
    sines.iter().all(|sine| *sine > LEAST_SINE)
}
