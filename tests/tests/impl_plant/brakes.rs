//! This file holds the plant's brakes against the reference's: yield torque, time constant and backlash.

use rigproof_impl::plant::backlash::Backlash as OwnBacklash;
use rigproof_impl::plant::brake::{Brake as OwnBrake, Characteristic, Turn};
use rigproof_model::brake::{Backlash, Brake, bounded_time_constant};
use rigproof_spec::joint::Joint;
use rigproof_spec::tables::{Edge, backlash_width_deg, brake_table};

use crate::budget::assert_within_budget;
use crate::impl_plant::rigs::{Draw, campaign};

#[test]
fn the_time_constant_is_the_references() {
    let mut draw = Draw::new(3307);
    let mut off = Vec::new();
    for k in 0..campaign(100_000) {
        let joint = Joint::ALL[k % 4];
        let edge = Edge::ALL[(k / 4) % 2];
        let (current_a, speed) = (draw.between(-0.1, 1.2), draw.between(-0.51, 0.51));
        let expected_s = bounded_time_constant(joint, current_a, speed, edge);
        let own = Characteristic::new(&brake_table(joint));
        off.push((own.time_constant_s(current_a, speed, edge) / expected_s - 1.0).abs());
    }
    assert_within_budget("plant_time_constant", off);
}

#[test]
fn the_backlash_is_the_references_on_random_walks() {
    let mut draw = Draw::new(5501);
    let mut inside = 0;
    let walks = campaign(2_000);
    for k in 0..walks {
        let joint = Joint::ALL[k % 4];
        let mut theta = draw.between(-3.1, 3.1);
        let mut expected = Backlash::new(joint, theta);
        let mut own = OwnBacklash::new(backlash_width_deg(joint), theta);
        for _ in 0..200 {
            let from = theta;
            let reach = libm::pow(10.0, draw.between(-5.0, -1.7));
            theta += draw.between(-reach, reach);
            let before = own.is_inside();
            let crossing = own.turn(from, theta);
            assert_eq!(expected.update(theta), own.is_inside());
            assert_eq!(crossing.is_some(), before != own.is_inside());
            assert!(crossing.is_none_or(|crossing| (0.0..=1.0).contains(&crossing.part)));
            let (one, other) = expected.boundaries_rad();
            assert_eq!(own.boundaries_rad(), [one, other]);
            inside += usize::from(own.is_inside());
        }
    }
    assert!(inside > walks * 20, "{inside}");
}

/// A brake turned at a constant speed through changes of current, in the reference and in the plant.
#[test]
fn the_yield_torque_is_the_references_through_changes_of_current() {
    let mut draw = Draw::new(8837);
    let mut off = Vec::new();
    for k in 0..campaign(2_000) {
        let joint = Joint::ALL[k % 4];
        let speed = draw.between(-0.7, 0.7);
        // Out of the backlash first.
        let clear = 0.047 * speed.signum();
        let mut theta = draw.between(-3.1, 3.1);
        let table = brake_table(joint);
        let of = Characteristic::new(&table);
        let (mut expected, mut own) = (Brake::new(joint, theta), OwnBrake::new(&table, theta));
        let mut current_a = draw.between(0.0, 1.0);
        expected.step(current_a, theta + clear, speed, 1e-9);
        let out = Turn {
            way_rad: [theta, theta + clear],
            around_s: [0.0; 2],
            speed_rad_s: speed,
            step_s: 1e-9,
        };
        own.step(&of, current_a, &out);
        theta += clear;
        for _ in 0..150 {
            if draw.one_in(17) {
                current_a = draw.between(0.0, 1.0);
            }
            let step_s = draw.between(2e-4, 4e-3);
            let to = theta + speed * step_s;
            expected.step(current_a, to, speed, step_s);
            let turn = Turn {
                way_rad: [theta, to],
                around_s: [0.5 * step_s, 0.5 * step_s],
                speed_rad_s: speed,
                step_s,
            };
            let before_nm = own.yield_nm();
            let mean_nm = own.step(&of, current_a, &turn);
            let (low, high) = (before_nm.min(own.yield_nm()), before_nm.max(own.yield_nm()));
            assert!(mean_nm >= low - 1e-12 && mean_nm <= high + 1e-12);
            off.push((own.yield_nm() - expected.yield_torque()).abs());
            theta = to;
        }
    }
    assert_within_budget("plant_yield", off);
}
