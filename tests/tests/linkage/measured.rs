//! This file measures how far the kinematics and their other computations lie apart, and holds that to the budgets.

use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;
use rigproof_model::linkage::jacobian::jacobian;
use rigproof_model::linkage::{forward, inverse, printed};
use rigproof_spec::geometry::{Arms, arms};
use rigproof_spec::layout::Layout;

use crate::budget::assert_within_budget;
use crate::linkage::jacobian::{central, complex_step, difference, shortest_m};
use crate::linkage::oracle::{four_brake, is_assembled, linkages, three_brake};
use crate::linkage::round_trip::{distance, gap_m};

/// Values of a strategy, the same in every run.
fn sample<T>(strategy: impl Strategy<Value = T>, count: usize) -> Vec<T> {
    let mut runner = TestRunner::deterministic();
    (0..count)
        .map(|_| strategy.new_tree(&mut runner).unwrap().current())
        .collect()
}

/// Poses of both layouts over their whole joint ranges.
fn layouts() -> Vec<(Arms, [f64; 2])> {
    let three = sample(three_brake(), 10_000);
    let four = sample(four_brake(), 10_000);
    let of = |layout: Layout| move |base: [f64; 2]| (arms(layout), base);
    let three = three.into_iter().map(of(Layout::ThreeBrake));
    three
        .chain(four.into_iter().map(of(Layout::FourBrake)))
        .collect()
}

/// Random linkages, at least 10° from their singularities.
fn random() -> Vec<(Arms, [f64; 2])> {
    let made = sample(linkages(), 60_000);
    let made: Vec<(Arms, [f64; 2])> = made
        .into_iter()
        .filter(is_assembled)
        .map(|made| (made.arms, [made.theta_a_rad, made.theta_b_rad]))
        .collect();
    assert!(made.len() > 10_000, "{}", made.len());
    made
}

fn measure(name: &str, mut values: Vec<f64>) {
    values.sort_by(f64::total_cmp);
    let at = |share: f64| values[((values.len() - 1) as f64 * share) as usize];
    println!(
        "{name}: {} values, q75 {:e}, q99 {:e}, max {:e}",
        values.len(),
        at(0.75),
        at(0.99),
        at(1.0)
    );
    assert_within_budget(name, values);
}

#[test]
fn round_trips_and_closure_are_within_their_budgets() {
    for (name, poses) in [("layouts", layouts()), ("random", random())] {
        let (mut trips, mut gaps) = (Vec::new(), Vec::new());
        for (arms, [a, b]) in poses {
            let there = forward::pose(&arms, a, b).unwrap();
            let back = inverse::pose(&arms, there.tip_m).unwrap();
            let turn = 2.0 * core::f64::consts::PI;
            let off = [a - back.theta_a_rad, b - back.theta_b_rad]
                .map(|off| (off - turn * (off / turn).round()).abs());
            trips.push(off[0].max(off[1]));
            gaps.push(gap_m(&arms, &there).max(gap_m(&arms, &back)));
        }
        measure(&format!("linkage_round_trip_{name}"), trips);
        measure(&format!("linkage_closure_{name}"), gaps);
    }
}

#[test]
fn differences_of_the_jacobian_are_within_their_budgets() {
    for (name, poses) in [("layouts", layouts()), ("random", random())] {
        let (mut complex, mut differences) = (Vec::new(), Vec::new());
        for (arms, base) in poses {
            let pose = forward::pose(&arms, base[0], base[1]).unwrap();
            let j = jacobian(&arms, &pose).unwrap();
            complex.push(difference(&j, &complex_step(&arms, base)));
            let step_m = 4e-5 * shortest_m(&arms);
            differences.push(difference(&j, &central(&arms, pose.tip_m, step_m)));
        }
        measure(&format!("linkage_jacobian_complex_step_{name}"), complex);
        measure(&format!("linkage_jacobian_central_{name}"), differences);
    }
}

#[test]
fn the_printed_forms_are_within_their_budgets() {
    let (mut tips, mut angles) = (Vec::new(), Vec::new());
    for (arms, [a, b]) in layouts() {
        let pose = forward::pose(&arms, a, b).unwrap();
        let tip_m = printed::forward(&arms, a, b).tip_m;
        tips.push(distance(tip_m, pose.tip_m));
        let [printed_a, printed_b] = match arms.l_ab_m {
            0.0 => printed::inverse_of_shared_axis(&arms, pose.tip_m),
            _ => printed::inverse(&arms, pose.tip_m),
        };
        angles.push((printed_a - a).abs().max((printed_b - b).abs()));
    }
    measure("linkage_printed_forward", tips);
    measure("linkage_printed_inverse", angles);
}
