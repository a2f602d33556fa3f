//! This file spoils the continuity of a position.

use super::made::{self, Made};
use super::{assert_fault, assert_mended};
use core::f64::consts::{PI, TAU};

/// The first sample after a time share at which the angle moves by a count a sample at least.
fn moving(made: &Made, name: &str, from: usize) -> usize {
    let angle = made.samples(name);
    let moves = |k: &usize| (angle[k + 5] - angle[k - 5]).abs() > 60.0 * 2e-5;
    (from..angle.len() - 400).find(moves).unwrap()
}

#[test]
fn a_position_that_is_set_to_another_zero_is_at_fault_where_it_jumps() {
    for (made, name, channel) in [
        (made::axis(), "angle", "position"),
        (made::bench(), "angle", "position"),
        (made::five_bar(), "theta_b", "theta_b"),
    ] {
        for (start, by) in [(2500, -1.0), (4100, 0.37)] {
            let at_s = start as f64 / made::RATE_HZ;
            let spoilt = made
                .clone()
                .with(name, |x| x[start..].iter_mut().for_each(|x| *x += by));
            assert_fault(&spoilt, channel, Some(at_s), "jumps");
        }
    }
}

#[test]
fn lost_counts_are_told_with_their_number() {
    for (made, lost) in [
        (made::axis(), 500.0),
        (made::bench(), 300.0),
        (made::bench(), -80.0),
    ] {
        let start = moving(&made, "angle", 3000);
        let spoilt = made.with("angle", |x| {
            x[start..].iter_mut().for_each(|x| *x -= 2e-5 * lost)
        });
        assert_fault(
            &spoilt,
            "position",
            Some(start as f64 / made::RATE_HZ),
            "counts",
        );
    }
}

#[test]
fn an_angle_that_wraps_is_unwrapped() {
    // At a turn, at half a turn either way, and after 16 bits of counts.
    let wraps: [fn(f64) -> f64; 3] = [
        |x| (x - 1.7).rem_euclid(TAU),
        |x| x - TAU * ((x + PI - 2.0) / TAU).round(),
        |x| (x - 2.1).rem_euclid(65_536.0 * 2e-5),
    ];
    for wrap in wraps {
        let spoilt = made::bench().with("angle", |x| {
            // Where the motion reaches over a half turn and more of the smallest period.
            x.iter_mut().for_each(|x| *x = wrap(*x));
        });
        assert!(assert_mended(&spoilt, "position", "wrapped") > 0);
    }
}

#[test]
fn a_few_dropouts_are_left_out_and_counted() {
    let at = [900, 1700, 2600, 3111, 4502, 5210, 6003, 7001];
    for (value, longest) in [(0.0, 1), (-3.0, 1), (9.9, 3)] {
        let spoilt = made::bench().with("angle", |x| {
            at.iter().for_each(|k| x[*k..k + longest].fill(value));
        });
        assert_eq!(assert_mended(&spoilt, "position", "dropouts"), 8 * longest);
    }
}

#[test]
fn many_dropouts_are_a_fault() {
    let spoilt = made::bench().with("angle", |x| {
        x.iter_mut().skip(40).step_by(31).for_each(|x| *x = 0.0)
    });
    assert_fault(&spoilt, "position", Some(0.04), "neighbours");
}

/// Every channel repeats the sample before a run.
fn repeated(made: Made, runs: &[(usize, usize)]) -> Made {
    made.with_all(|x| {
        for (start, count) in runs {
            let held = x[start - 1];
            x[*start..start + count].fill(held);
        }
    })
}

#[test]
fn a_few_repeated_bursts_are_left_out_and_many_are_a_fault() {
    for made in [made::axis(), made::bench(), made::five_bar()] {
        let few: Vec<(usize, usize)> = (1..6).map(|k| (1300 * k, 8)).collect();
        let count = assert_mended(&repeated(made.clone(), &few), "every channel", "repeated");
        assert!((8..=40).contains(&count), "{count}");
        let many: Vec<(usize, usize)> = (1..70).map(|k| (110 * k, 9)).collect();
        assert_fault(&repeated(made, &many), "every channel", None, "repeat");
    }
}

#[test]
fn three_in_a_hundred_repeated_samples_are_a_fault() {
    for made in [made::axis(), made::bench(), made::five_bar()] {
        let single: Vec<(usize, usize)> = (1..240).map(|k| (33 * k, 1)).collect();
        assert_fault(&repeated(made, &single), "every channel", None, "repeat");
    }
}

#[test]
fn a_stretch_that_is_filled_in_by_a_straight_line_is_a_fault() {
    for (made, name, channel) in [
        (made::axis(), "angle", "position"),
        (made::bench(), "angle", "position"),
        (made::five_bar(), "theta_a", "theta_a"),
    ] {
        let start = moving(&made, name, 2000);
        let spoilt = made.with(name, |x| {
            let (from, to) = (x[start], x[start + 300]);
            (1..300).for_each(|k| x[start + k] = from + (to - from) * k as f64 / 300.0);
        });
        assert_fault(
            &spoilt,
            channel,
            Some(start as f64 / made::RATE_HZ),
            "straight",
        );
    }
}

#[test]
fn a_position_that_is_refreshed_too_seldom_is_a_fault() {
    for (made, name, channel, every) in [
        (made::axis(), "angle", "position", 20),
        (made::bench(), "angle", "position", 10),
        (made::five_bar(), "theta_b", "theta_b", 20),
    ] {
        let spoilt = made.with(name, |x| {
            (0..x.len()).for_each(|k| x[k] = x[k - k % every]);
        });
        assert_fault(&spoilt, channel, None, &format!("every {every} samples"));
    }
}
