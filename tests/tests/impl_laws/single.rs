//! This file says how far the laws in single precision are from the same laws in double precision.

use std::collections::BTreeMap;

use rigproof_impl::law::Law as _;
use rigproof_impl::number::Real;
use rigproof_model::control::Sensed;
use rigproof_model::linkage::singularity::{Pair, measure};
use rigproof_spec::command::{Command, Reason};

use crate::agree::quantiles;
use crate::both::{rig_law, sensed, situation};
use crate::budget::assert_within_budget;
use crate::sample::{Sampler, Tick};

/// Ticks that are compared.
const TICKS: u32 = 100_000;
/// Decisions that may differ, as a share of all ticks: measured 0.0, and each checked to be a tie of single precision.
const GREATEST_SHARE: f64 = 1e-3;
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
    let (mut apart_a, mut ties) = (Vec::new(), BTreeMap::<u64, u64>::new());
    let mut compared = 0_u32;
    while compared < TICKS {
        let tick = sampler.plain();
        let well = |sensed: Sensed| {
            Pair::ALL
                .iter()
                .all(|pair| measure(&sensed.pose, *pair) > LEAST_SINE)
        };
        if !sensed(&tick).is_some_and(well) {
            continue;
        }
        compared += 1;
        let (double, single) = (command::<f64>(&tick), command::<f32>(&tick));
        if double.reason == single.reason {
            let pairs = double.currents_a.iter().zip(single.currents_a);
            let apart = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            if matches!(double.reason, Reason::Chosen(_) | Reason::ChosenPair(..)) {
                apart_a.push(apart);
            }
            continue;
        }
        let size = NUDGES.into_iter().find(|size| {
            (0..TRIES)
                .any(|_| command::<f64>(&nudged(&tick, *size, &mut nudger)).reason == single.reason)
        });
        let size = size
            .unwrap_or_else(|| panic!("{double:?}, in single precision {single:?}, in {tick:?}"));
        *ties.entry(size.to_bits()).or_default() += 1;
    }
    let sizes: Vec<_> = ties
        .iter()
        .map(|(bits, count)| (f64::from_bits(*bits), count))
        .collect();
    println!(
        "decisions that differ, by size of the nudge: {sizes:?} of {TICKS}; {}",
        quantiles(&apart_a)
    );
    let differing: u64 = ties.values().sum();
    assert!(
        differing as f64 <= GREATEST_SHARE * f64::from(TICKS),
        "{sizes:?}"
    );
    assert_within_budget("rig_law_current_single", apart_a);
}
