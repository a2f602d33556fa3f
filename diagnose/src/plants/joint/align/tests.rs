//! This file tests alignment on recordings with one fault each, and on healthy ones.

use super::*;

use crate::plants::joint::recorded::{NOMINAL, STEP_S, exact_axis, exact_bench, signals};
use rigproof_spec::effect::Mechanism;

fn healthy_axis() -> Signals {
    let mut laws = NOMINAL.to_vec();
    laws.push((Mechanism::DryOffset, &[1.73]));
    signals(&exact_axis(&laws, 6100, true), 5)
}

fn healthy_bench() -> Signals {
    let laws: [(Mechanism, &[f64]); 2] =
        [(Mechanism::Viscous, &[2.3]), (Mechanism::DryOffset, &[3.1])];
    signals(&exact_bench(&laws, 6100), 6)
}

/// The channel and the reason of the fault that a change of a healthy recording causes.
fn fault(mut signals: Signals, change: impl Fn(&mut Signals)) -> (&'static str, String) {
    change(&mut signals);
    let fault = align(&signals).unwrap_err();
    (fault.channel, fault.reason)
}

#[test]
fn a_healthy_recording_has_no_fault() {
    for signals in [healthy_axis(), healthy_bench()] {
        let run = align(&signals).unwrap();
        assert_eq!(run.len(), 6100);
        assert_eq!(run.position, signals.position);
        assert!((run.step_s - STEP_S).abs() < 1e-12);
    }
}

#[test]
fn a_gap_and_a_backward_clock_are_faults_of_the_time() {
    let late = |signals: &mut Signals| {
        signals
            .time_s
            .iter_mut()
            .skip(2311)
            .for_each(|t| *t += 0.37)
    };
    let (channel, reason) = fault(healthy_axis(), late);
    assert_eq!(channel, "time");
    assert!(reason.starts_with("0.371 s without a sample"), "{reason}");
    let early = |signals: &mut Signals| {
        signals
            .time_s
            .iter_mut()
            .skip(2311)
            .for_each(|t| *t -= 0.37)
    };
    let (channel, reason) = fault(healthy_axis(), early);
    assert_eq!(channel, "time");
    assert!(reason.contains("backward"), "{reason}");
}

#[test]
fn missing_values_are_a_fault_when_long_or_many() {
    let burst = |signals: &mut Signals| signals.position[1207..1377].fill(f64::NAN);
    let (channel, reason) = fault(healthy_axis(), burst);
    assert_eq!(channel, "position");
    assert!(reason.contains("no value for"), "{reason}");
    let scattered = |signals: &mut Signals| {
        signals
            .effort
            .iter_mut()
            .step_by(37)
            .for_each(|x| *x = f64::NAN)
    };
    let (channel, reason) = fault(healthy_axis(), scattered);
    assert_eq!(
        (channel, reason.as_str()),
        ("effort", "165 of 6100 values are missing")
    );
    let mut few = healthy_axis();
    few.effort
        .iter_mut()
        .step_by(73)
        .for_each(|x| *x = f64::NAN);
    assert!(align(&few).is_ok());
}

#[test]
fn a_frozen_channel_is_a_fault() {
    let stuck = |values: &mut [f64]| {
        let value = values[2411];
        values[2411..3111].fill(value);
    };
    let (channel, reason) = fault(healthy_axis(), |s| stuck(&mut s.position));
    assert_eq!(channel, "position");
    assert!(reason.contains("the same value"), "{reason}");
    let (channel, _) = fault(healthy_bench(), |s| stuck(&mut s.effort));
    assert_eq!(channel, "effort");
}

#[test]
fn a_clipped_drive_is_a_fault_unless_the_rig_states_the_limit() {
    let clip = |signals: &mut Signals| {
        signals
            .effort
            .iter_mut()
            .for_each(|x| *x = x.clamp(-6.31, 6.31))
    };
    let (channel, reason) = fault(healthy_axis(), clip);
    assert_eq!(channel, "effort");
    assert!(reason.contains("clipped"), "{reason}");
    let mut stated = healthy_axis();
    clip(&mut stated);
    stated.effort_limit = Some(6.31);
    assert!(align(&stated).is_ok());
}

#[test]
fn a_resistance_of_the_wrong_sign_is_a_fault() {
    let (channel, reason) = fault(healthy_bench(), |s| {
        s.effort.iter_mut().for_each(|x| *x = -*x)
    });
    assert_eq!(channel, "effort");
    assert!(reason.contains("wrong sign"), "{reason}");
}

#[test]
fn the_smallest_step_is_the_quantum_of_a_quantised_channel() {
    let quantum = 0.0037;
    let values: Vec<f64> = (0..900)
        .map(|k| quantum * (libm::sin(0.0173 * k as f64) / quantum).round())
        .collect();
    assert!((smallest_step(&values) - quantum).abs() < 1e-9);
}

#[test]
fn resampling_keeps_what_was_recorded_and_fills_what_was_lost() {
    let (step_s, lost) = (0.0013, 7);
    let time_s: Vec<f64> = (0..20)
        .filter(|k| *k != lost)
        .map(|k| 0.31 + k as f64 * step_s)
        .collect();
    let value = |t: f64| 1.7 + 23.0 * t;
    let values: Vec<f64> = time_s.iter().map(|t| value(*t)).collect();
    let (out, recorded) = resample(&time_s, &values, step_s, regular_count(&time_s, step_s));
    assert_eq!(out.len(), 20);
    let kept: Vec<f64> = out
        .iter()
        .enumerate()
        .filter(|(k, _)| *k != lost)
        .map(|(_, x)| *x)
        .collect();
    assert_eq!(kept, values);
    assert!((out[lost] - value(0.31 + lost as f64 * step_s)).abs() < 1e-12);
    assert!(recorded.iter().all(|r| *r), "one lost sample is bridged");
    let sparse: Vec<f64> = time_s
        .iter()
        .copied()
        .filter(|t| !(0.3155..0.3275).contains(t))
        .collect();
    let values: Vec<f64> = sparse.iter().map(|t| value(*t)).collect();
    let (_, recorded) = resample(&sparse, &values, step_s, 20);
    assert!(!recorded[9] && recorded[2], "many lost samples are not");
}

#[test]
fn the_band_holds_the_slow_part_of_an_effort() {
    let effort: Vec<f64> = (0..4000)
        .map(|k| 3.1 * libm::sin(0.0171 * k as f64) + 0.1 * libm::sin(0.9 * k as f64))
        .collect();
    let band = band_hz(&effort, 1.3e-3);
    let slow_hz = 0.0171 / (core::f64::consts::TAU * 1.3e-3);
    assert!((slow_hz..1.3 * slow_hz).contains(&band), "{band} {slow_hz}");
}
