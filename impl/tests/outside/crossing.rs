//! This file says when a shaft passes a boundary of its backlash and what its brake's yield torque makes of that moment, by closed forms.

use rigproof_impl::plant::backlash::{Backlash, ENTRY_TRAVEL_DEG};
use rigproof_impl::plant::brake::{Brake, Characteristic, Turn};
use rigproof_spec::joint::Joint;
use rigproof_spec::tables::{BrakeTable, Edge, GAIN_BREAK_A, brake_table};
use rigproof_spec::units::rad_from_deg;

/// A speed, rad/s, beyond which the time constants no longer change, and so no logarithm is needed.
const FAST_RAD_S: f64 = 2.7;

fn at(angle_deg: f64) -> f64 {
    rad_from_deg(angle_deg)
}

/// The yield torque at the end of a step and its mean are those expected, N·m.
fn assert_same(own_nm: [f64; 2], expected_nm: [f64; 2], joint: Joint, moment_s: f64) {
    for (own, expected) in own_nm.into_iter().zip(expected_nm) {
        assert!(
            (own - expected).abs() < 1e-12,
            "{joint:?} {moment_s}: {own_nm:?} {expected_nm:?}"
        );
    }
}

#[test]
fn the_moment_of_crossing_downwards_is_on_the_way() {
    let mut backlash = Backlash::new(1.7, at(11.1));
    // The boundary is at 10.25°.
    let out = backlash.turn(at(10.45), at(9.85)).unwrap();
    assert!(!out.inside && (out.part - 1.0 / 3.0).abs() < 1e-9);
    // Inside again from 9.87° upwards.
    let entered = backlash.turn(at(9.85), at(9.95)).unwrap();
    assert!(entered.inside && (entered.part - 0.2).abs() < 1e-9);
}

#[test]
fn with_no_more_than_the_travel_of_entry_a_shaft_stays_outside() {
    // By powers of two, so that the travel is met exactly.
    let entry_rad = rad_from_deg(ENTRY_TRAVEL_DEG);
    let mut backlash = Backlash::new(1.7, at(1.1));
    backlash.turn(at(1.1), entry_rad).unwrap();
    assert_eq!(backlash.turn(entry_rad, 2.0 * entry_rad), None);
    assert!(!backlash.is_inside());
    assert!(backlash.turn(2.0 * entry_rad, 2.001 * entry_rad).is_some());
    // Without a travel beyond the other boundary either: a window of twice the travel holds no inside.
    let mut narrow = Backlash::new(2.0 * ENTRY_TRAVEL_DEG, at(1.1));
    narrow.turn(at(1.1), entry_rad);
    assert_eq!(narrow.turn(entry_rad, 2.0 * entry_rad), None);
}

#[test]
fn the_moment_lies_on_the_way_where_rounding_has_it_before_the_start() {
    let entry_rad = rad_from_deg(ENTRY_TRAVEL_DEG);
    let mut before = 0;
    for k in 1..100_u32 {
        // Near angle zero the shaft's angle is finer than the travel that is left.
        let mut backlash = Backlash::new(0.017 * f64::from(k) + 0.13, -0.1);
        backlash.turn(-0.1, entry_rad);
        let [_, high] = backlash.boundaries_rad();
        let from_rad = high - entry_rad - 1e-21;
        backlash.turn(entry_rad, from_rad);
        if backlash.is_inside() {
            continue;
        }
        let entered = backlash.turn(from_rad, from_rad - 1e-5).unwrap();
        assert!((0.0..=1.0).contains(&entered.part), "{entered:?}");
        before += 1;
    }
    assert!(before > 10, "{before}");
}

fn gain_nm(table: &BrakeTable, current_a: f64) -> f64 {
    let fit = &table.torque_gain;
    fit.k_3 * current_a * current_a + fit.k_4 * current_a + fit.k_5
}

/// A course towards a target, N·m, for a time, s: where it ends and its impulse.
fn course(from_nm: f64, target_nm: f64, a_s: f64, time_s: f64) -> [f64; 2] {
    let decay = libm::exp(-time_s / a_s);
    let end_nm = target_nm + (from_nm - target_nm) * decay;
    [
        end_nm,
        target_nm * time_s + (from_nm - target_nm) * a_s * (1.0 - decay),
    ]
}

fn turn(way_rad: [f64; 2], around_s: [f64; 2], step_s: f64) -> Turn {
    let [from_rad, to_rad] = way_rad;
    let speed_rad_s = FAST_RAD_S * (to_rad - from_rad).signum();
    Turn {
        way_rad,
        around_s,
        speed_rad_s,
        step_s,
    }
}

const STEP_S: f64 = 1.7e-3;
/// The moment is a third of the way: after the start of the step, and before it.
const AROUND_S: [([f64; 2], f64); 2] = [([0.1e-3, 0.8e-3], 0.2e-3), ([0.7e-3, 0.2e-3], -0.4e-3)];

#[test]
fn a_brake_that_comes_out_of_its_backlash_rises_from_that_moment_on() {
    for joint in [Joint::E, Joint::B, Joint::C] {
        let table = brake_table(joint);
        let of = Characteristic::new(&table);
        let off_nm = table.torque_gain.off_state_nm();
        let a_s = of.time_constant_s(0.83, FAST_RAD_S, Edge::Rising);
        for (around_s, moment_s) in AROUND_S {
            let mut brake = Brake::new(&table, 0.31);
            let [_, high] = brake.backlash().boundaries_rad();
            // The last step left another current behind.
            brake.step(&of, 0.61, &turn([0.31, high - 1e-3], [0.0; 2], STEP_S));
            let mean_nm = brake.step(
                &of,
                0.83,
                &turn([high - 1e-3, high + 2e-3], around_s, STEP_S),
            );
            let (before_s, after_s) = (moment_s.min(0.0), moment_s.max(0.0));
            // What it should have done since the moment, at the last current, and in the step.
            let [since_nm, since] = course(off_nm, gain_nm(&table, 0.61), a_s, -before_s);
            let [end_nm, within] = course(since_nm, gain_nm(&table, 0.83), a_s, STEP_S - after_s);
            let missed = since + off_nm * before_s;
            let expected_nm = (missed + off_nm * after_s + within) / STEP_S;
            assert_same(
                [brake.yield_nm(), mean_nm],
                [end_nm, expected_nm],
                joint,
                moment_s,
            );
        }
    }
}

#[test]
fn a_brake_that_comes_into_its_backlash_falls_from_that_moment_on() {
    for joint in [Joint::E, Joint::B, Joint::C] {
        let table = brake_table(joint);
        let of = Characteristic::new(&table);
        let off_nm = table.torque_gain.off_state_nm();
        for (around_s, moment_s) in AROUND_S {
            let mut brake = Brake::new(&table, 0.31);
            for _ in 0..900 {
                brake.step(&of, 0.83, &turn([0.5, 0.5 + 1e-3], [0.0; 2], STEP_S));
            }
            let (full_nm, [_, high]) = (brake.yield_nm(), brake.backlash().boundaries_rad());
            assert!((full_nm - gain_nm(&table, 0.83)).abs() < 1e-12);
            assert_eq!(brake.fall_origin_a(), 0.83);
            let entry_rad = rad_from_deg(ENTRY_TRAVEL_DEG);
            let mean_nm = brake.step(
                &of,
                0.83,
                &turn([high, high - 3.0 * entry_rad], around_s, STEP_S),
            );
            let a_s = of.time_constant_s(0.83, FAST_RAD_S, Edge::Falling);
            let (before_s, after_s) = (moment_s.min(0.0), moment_s.max(0.0));
            let [end_nm, fallen] = course(full_nm, off_nm, a_s, STEP_S - after_s - before_s);
            let expected_nm = (fallen + full_nm * moment_s) / STEP_S;
            assert_same(
                [brake.yield_nm(), mean_nm],
                [end_nm, expected_nm],
                joint,
                moment_s,
            );
            assert_eq!(brake.fall_origin_a(), 0.83);
        }
    }
}

//= thesis (3.3) test
#[test]
fn at_the_break_of_the_gain_the_square_law_holds() {
    for joint in Joint::ALL {
        let table = brake_table(joint);
        let (of, mut brake) = (Characteristic::new(&table), Brake::new(&table, 0.31));
        for _ in 0..900 {
            brake.step(
                &of,
                GAIN_BREAK_A,
                &turn([0.5, 0.5 + 1e-3], [0.0; 2], STEP_S),
            );
        }
        assert!(
            (brake.yield_nm() - gain_nm(&table, GAIN_BREAK_A)).abs() < 1e-12,
            "{joint:?}"
        );
    }
}
