//! This file spoils the clock.

use super::made::{self, Noise};
use super::{assert_consistent, assert_fault, diagnosed};
use rigproof_diagnose::report::{Remark, Verdict};

#[test]
fn a_clock_that_is_set_is_told_from_missing_samples() {
    for (made, start, by_s) in [
        (made::axis(), 3000, 0.03),
        (made::bench(), 2600, 0.05),
        (made::five_bar(), 4300, 0.06),
    ] {
        let spoilt = made.at(|t| t[start..].iter_mut().for_each(|t| *t += by_s));
        assert_fault(
            &spoilt,
            "time",
            Some(start as f64 / made::RATE_HZ),
            "the clock was set",
        );
    }
}

#[test]
fn a_clock_that_jumps_far_or_back_is_a_fault_at_its_time() {
    for (made, by_s) in [
        (made::axis(), 0.8),
        (made::bench(), -0.5),
        (made::five_bar(), 1.4),
    ] {
        let spoilt = made.at(|t| t[3500..].iter_mut().for_each(|t| *t += by_s));
        assert_fault(&spoilt, "time", Some(3.5), "cut the recording there");
    }
}

#[test]
fn missing_samples_are_missing_and_no_fault() {
    let spoilt = |mut made: made::Made| {
        made.trace.time_s.drain(3000..3030);
        made.with_all(|x| drop(x.drain(3000..3030)))
    };
    for made in [made::axis(), made::bench(), made::five_bar()] {
        assert_consistent(&diagnosed(&spoilt(made)));
    }
}

#[test]
fn jitter_of_the_stamps_is_measured_and_alone_is_named() {
    for (made, share) in [
        (made::axis(), 0.05),
        (made::bench(), 0.05),
        (made::five_bar(), 0.02),
    ] {
        let mut noise = Noise::new();
        let spoilt = made.at(|t| {
            t.iter_mut()
                .for_each(|t| *t += noise.draw(share / made::RATE_HZ))
        });
        let report = diagnosed(&spoilt);
        let named: Vec<&str> = report.effects.iter().map(|own| own.mechanism).collect();
        assert_eq!(named, ["clock_jitter"], "{}", report.summary);
        assert_eq!(report.verdict, Verdict::Explained);
        let jitter_s = report.effects[0].parameters["jitter"].value;
        assert!(
            (jitter_s / (share / made::RATE_HZ) - 1.0).abs() < 0.1,
            "{jitter_s}"
        );
        let said = |own: &&Remark| own.what == "jitter" && own.channel == "time";
        assert!(
            report.remarks.iter().any(|own| said(&own)),
            "{:?}",
            report.remarks
        );
    }
}

#[test]
fn samples_that_were_taken_at_uneven_times_are_carried_to_the_grid() {
    // The motion of the bench, read when the stamps say.
    let mut noise = Noise::new();
    let angle = |t: f64| 1.9 + 0.9 * libm::sin(1.7 * t + 0.2) + 0.3 * libm::sin(6.1 * t + 1.3);
    let made = made::bench().at(|t| t.iter_mut().for_each(|t| *t += noise.draw(1e-4)));
    let times = made.trace.time_s.clone();
    let spoilt = made.with("angle", |x| {
        x.iter_mut()
            .zip(&times)
            .for_each(|(x, t)| *x = (angle(*t) / 2e-5).round() * 2e-5);
    });
    let report = diagnosed(&spoilt);
    assert_consistent(&report);
    assert!(
        report.remarks[0].words.contains("when its stamp says"),
        "{:?}",
        report.remarks
    );
}
