//! This file claims that the diagnosis of the five-bar names what was left out, where it was left
//! out, and nothing else.

use super::columns::{driving, free};
use super::from_rig::aligned;
use super::mapping;
use super::recorded::{DRAG, LeftOut, nothing, recording, rig};
use super::replica::replica;
use super::run::{FiveBarRun, at};
use crate::align::Fault;
use crate::filter::rms;
use crate::plant::Run;
use crate::plants::joined::joined;
use crate::problem::{Problem, less};
use crate::report::{Report, Verdict};
use crate::weak::Windows;
use crate::{Diagnosis, Options, diagnose};
use rigproof_model::linkage::Pose;
use rigproof_spec::effect::Mechanism;
use rigproof_spec::joint::Joint;
use rigproof_spec::layout::Layout;
use rigproof_trace::rig::five_bar::{FiveBar, FiveBarRecording, JointEffect};
use rigproof_trace::rig::{RigEffect, Signal, Value};

/// Long enough for a name, s.
const SECONDS: f64 = 6.0;
/// Long enough for free runs of all horizons, and for the name of what begins late, s.
const LONGER: f64 = 9.0;

/// The next experiment has tests of its own and is switched off here.
fn options() -> Options {
    Options {
        next_experiment: false,
        ..Options::default()
    }
}

/// Without a free run, where a test looks at names and coefficients alone.
fn naming() -> Options {
    Options {
        refit: false,
        ..options()
    }
}

fn diagnosed(layout: Layout, seconds: f64, seed: u64, left_out: LeftOut) -> Diagnosis<FiveBar> {
    let recording = recording(layout, seconds, seed, left_out);
    diagnose(&rig(layout), &[&recording], None, &options())
}

fn named(report: &Report) -> Vec<(&'static str, Option<&'static str>)> {
    let effects = report.effects.iter();
    effects.map(|e| (e.mechanism, e.joint)).collect()
}

#[test]
fn a_recording_of_the_model_itself_is_consistent() {
    for (layout, seed) in [(Layout::FourBrake, 3), (Layout::ThreeBrake, 5)] {
        let report = diagnosed(layout, LONGER, seed, &nothing).report;
        let floor = report.floor.as_ref().unwrap();
        assert_eq!(
            report.verdict,
            Verdict::Consistent,
            "{layout:?}: {:?}, {} times the floor, {:?}",
            named(&report),
            floor.ratio_after,
            report.protocol
        );
        let fit = report.fit.unwrap();
        assert_eq!(fit.horizon.len(), 8);
        for horizon in &fit.horizon {
            assert_eq!(horizon.before, horizon.after);
            // Measured: at most 0.50 mm after 1 s.
            assert!(horizon.tip_after_mm.unwrap() < 0.7, "{horizon:?}");
        }
    }
}

#[test]
fn drag_at_one_joint_is_named_there_with_its_coefficient() {
    let drag = |_: &_, rates: [f64; 4], _: f64| [-DRAG * rates[0], 0.0, 0.0, 0.0];
    // Long enough for free runs of a second on the held-out part.
    let report = diagnosed(Layout::ThreeBrake, 16.0, 9, &drag).report;
    let expected = [("viscous", Some("A"))];
    assert_eq!(named(&report), expected, "{}", report.summary);
    let found = report.effects[0].parameters["coefficient"].value;
    assert!((found / DRAG - 1.0).abs() < 0.05, "{found} {DRAG}");
    let fit = report.fit.unwrap();
    assert!(fit.improved);
    // Measured on the held-out part: 5.3 times after 0.2 s, 16 times after 1 s.
    for (horizon_s, least) in [(0.2, 4.5), (1.0, 13.0)] {
        for horizon in fit.horizon.iter().filter(|h| h.horizon_s == horizon_s) {
            let tip = horizon.tip_before_mm.unwrap() / horizon.tip_after_mm.unwrap();
            assert!(tip > least, "{horizon:?}");
            assert!(horizon.before > least * horizon.after, "{horizon:?}");
        }
    }
}

#[test]
fn where_one_joint_is_held_or_turns_back_the_other_equation_still_balances() {
    for (layout, seed) in [(Layout::FourBrake, 11), (Layout::ThreeBrake, 12)] {
        let recording = recording(layout, SECONDS, seed, &nothing);
        let run = aligned(&rig(layout), &recording).unwrap();
        let problem = Problem::new(&run, run.windows_of(0.080));
        let Windows {
            combined, usable, ..
        } = &problem.windows;
        let single: Vec<usize> = (0..usable.len())
            .filter(|&row| usable[row] && combined[row].is_some())
            .collect();
        assert!(single.len() > 50, "{layout:?}: {}", single.len());
        let white: Vec<f64> = single
            .iter()
            .map(|&row| problem.target.white[row])
            .collect();
        assert!(rms(&white) < 1.2, "{layout:?}: {} deviations", rms(&white));
        // Neither equation balances on its own: the reaction of a held brake is in both.
        let [own, other] = [0, 1].map(|output| {
            let mut whole = problem.windows.clone();
            whole.combined.fill(None);
            let raw = whole.average(&less(&driving(&run, run.forces()), &problem.known));
            rms(&single
                .iter()
                .map(|&row| raw[row + output])
                .collect::<Vec<f64>>())
        });
        let floor = problem.floor;
        assert!(own.max(other) > 5.0 * floor, "{own} {other} {floor} N·m");
    }
}

#[test]
fn a_joint_turns_back_where_its_angle_does_and_not_where_it_wavers_by_counts() {
    let layout = Layout::FourBrake;
    let recording = recording(layout, 2.0, 7, &nothing);
    let mut run = aligned(&rig(layout), &recording).unwrap();
    let still = run.still_rad;
    let senses = |run: &FiveBarRun| {
        let mut senses: Vec<f64> = run.known_travel(Joint::A);
        senses.retain(|travel| *travel != 0.0);
        senses.dedup_by(|now, before| *now * *before > 0.0);
        senses.len()
    };
    // Forward at 0.4 rad/s, back for 0.2 s at a thousandth of that, forward again.
    let at = |by_rad: f64| (by_rad / (0.1 * still)).round() * 0.1 * still;
    let path = |k: usize, back: f64| {
        let (on, slow) = (4e-4 * k as f64, k.clamp(700, 900) as f64 - 700.0);
        at(on.min(0.28) - back * slow + (on - 0.36).max(0.0))
    };
    let count = run.len();
    run.theta[0] = (0..count).map(|k| path(k, 0.02 * still)).collect();
    assert_eq!(senses(&run), 3);
    let whole: f64 = run.known_travel(Joint::A).iter().sum();
    assert!((whole - (run.theta[0][count - 1] - run.theta[0][0])).abs() < 1.1 * still);
    run.theta[0] = (0..count).map(|k| path(k, 0.002 * still)).collect();
    assert_eq!(senses(&run), 1);
}

/// The fault that is found before any fit, after a mistake in the recording.
fn fault(
    layout: Layout,
    recording: &FiveBarRecording,
    mistake: impl Fn(&mut FiveBarRecording),
) -> Option<Fault> {
    let mut recording = recording.clone();
    mistake(&mut recording);
    let run = match aligned(&rig(layout), &recording) {
        Ok(run) => run,
        Err(fault) => return Some(fault),
    };
    mapping::check(&run, &Problem::new(&run, run.windows_of(0.080))).err()
}

#[test]
fn a_channel_taken_for_another_or_with_the_wrong_sign_is_a_fault_and_friction_left_out_is_none() {
    let drag = |_: &_, rates: [f64; 4], _: f64| rates.map(|rate| -5.0 * DRAG * rate);
    for layout in [Layout::FourBrake, Layout::ThreeBrake] {
        let dragged = recording(layout, 0.5 * SECONDS, 13, &drag);
        assert_eq!(fault(layout, &dragged, |_| ()), None, "{layout:?}");
        for (axis, channel) in ["force_x", "force_y"].into_iter().enumerate() {
            let turned = |recording: &mut FiveBarRecording| {
                for force in &mut recording.force[axis].samples {
                    *force = -*force;
                }
            };
            assert_eq!(fault(layout, &dragged, turned).unwrap().channel, channel);
        }
        let swapped = fault(layout, &dragged, |recording| recording.force.reverse());
        let reason = swapped.unwrap().reason;
        assert!(reason.contains("swapped"), "{layout:?}: {reason}");
        // The channels of A, E, B hold the currents of B, A, E.
        let exact = recording(layout, 0.5 * SECONDS, 13, &nothing);
        let turned = |recording: &mut FiveBarRecording| recording.currents[..3].rotate_right(1);
        let reason = fault(layout, &exact, turned).unwrap().reason;
        assert!(reason.contains("those of B, A, E"), "{layout:?}: {reason}");
    }
}

#[test]
fn a_rig_that_is_led_again_along_its_recording_repeats_it() {
    for (layout, seed) in [(Layout::FourBrake, 3), (Layout::ThreeBrake, 5)] {
        let recording = recording(layout, SECONDS, seed, &nothing);
        let own = rig(layout);
        let again = replica(&own, &own, &recording).unwrap().recording;
        assert_eq!(again.time_s.len(), recording.time_s.len());
        let apart = |one: &[Signal; 2], other: &[Signal; 2]| {
            let pairs = one.iter().zip(other);
            let all = pairs.flat_map(|(one, other)| one.samples.iter().zip(&other.samples));
            rms(&all.map(|(x, y)| x - y).collect::<Vec<f64>>())
        };
        let angle_rad = apart(&again.theta, &recording.theta);
        let force_n = apart(&again.force, &recording.force);
        println!("{layout:?}: {angle_rad:e} rad, {force_n:e} N");
        assert!(angle_rad < 1e-4, "{angle_rad}");
        assert!(force_n < 0.1, "{force_n}");
        assert_eq!(again.currents, recording.currents);
    }
}

fn viscous_at_e(_: &Pose, rates: [f64; 4], _: f64) -> [f64; 4] {
    [0.0, -DRAG * rates[1], 0.0, 0.0]
}

#[test]
fn several_recordings_are_one_problem_and_no_window_lies_across_a_seam() {
    let own = rig(Layout::ThreeBrake);
    let runs: Vec<FiveBarRun> = [21, 22]
        .map(|seed| {
            let recording = recording(Layout::ThreeBrake, 3.0, seed, &nothing);
            aligned(&own, &recording).unwrap()
        })
        .into();
    let whole = joined(runs.clone()).unwrap();
    let seam = runs[0].len();
    assert_eq!(whole.len(), seam + runs[1].len());
    let cause = at(Mechanism::Presliding, Joint::E);
    let signal = |run: &FiveBarRun| free(run, cause, &[0.013]).unwrap().swap_remove(0);
    let (both, one, other) = (signal(&whole), signal(&runs[0]), signal(&runs[1]));
    let (one_a, one_b) = one.split_at(seam);
    let (other_a, other_b) = other.split_at(runs[1].len());
    assert_eq!(both, [one_a, other_a, one_b, other_b].concat());
    let problem = Problem::new(&whole, whole.windows_of(0.080));
    let half = problem.windows.bump.len() / 2;
    let across = |centre: usize| centre - half < seam && centre + half >= seam;
    let rows = problem.windows.centres.iter().zip(&problem.windows.usable);
    let across: Vec<bool> = rows
        .filter(|(centre, _)| across(**centre))
        .map(|(_, usable)| *usable)
        .collect();
    assert!(across.len() >= 8, "{}", across.len());
    assert!(!across.contains(&true));
    let mut slow = runs[1].clone();
    slow.step_s *= 2.0;
    let (place, fault) = joined(vec![runs[0].clone(), slow]).unwrap_err();
    assert_eq!((place, fault.channel), (1, "time"));
}

#[test]
fn what_several_short_recordings_share_is_named_and_shown_on_the_last() {
    let layout = Layout::FourBrake;
    let recordings = [31, 32, 33].map(|seed| recording(layout, 7.0, seed, &viscous_at_e));
    let all: Vec<&FiveBarRecording> = recordings.iter().collect();
    let report = diagnose(&rig(layout), &all, None, &options()).report;
    let expected = [("viscous", Some("E"))];
    assert_eq!(named(&report), expected, "{}", report.summary);
    let found = report.effects[0].parameters["coefficient"].value;
    assert!((found / DRAG - 1.0).abs() < 0.05, "{found} {DRAG}");
    let fit = report.fit.unwrap();
    let held_out = fit.held_out.unwrap();
    // Measured: 27.6 times.
    assert!(held_out.before > 10.0 * held_out.after, "{held_out:?}");
    assert!(report.protocol[0].starts_with("2 recordings one after another"));
}

#[test]
fn a_turned_force_sensor_is_turned_and_has_no_other_gain() {
    let mut recording = recording(Layout::FourBrake, SECONDS, 15, &nothing);
    let (sine, cosine) = libm::sincos(0.137);
    let [x, y] = &mut recording.force;
    for (x, y) in x.samples.iter_mut().zip(&mut y.samples) {
        (*x, *y) = (cosine * *x - sine * *y, sine * *x + cosine * *y);
    }
    let rig = rig(Layout::FourBrake);
    let report = diagnose(&rig, &[&recording], None, &naming()).report;
    assert_eq!(
        named(&report),
        [("force_rotation", None)],
        "{}",
        report.summary
    );
    let found = report.effects[0].parameters["angle"].value;
    assert!((found / 0.137 - 1.0).abs() < 0.02, "{found} rad");
}

#[test]
fn an_encoder_with_its_zero_off_is_named_so_and_not_as_a_scale() {
    let mut recording = recording(Layout::FourBrake, SECONDS, 16, &nothing);
    let [theta_a, _] = &mut recording.theta;
    for angle in &mut theta_a.samples {
        *angle -= 0.037;
    }
    let rig = rig(Layout::FourBrake);
    let report = diagnose(&rig, &[&recording], None, &naming()).report;
    assert_eq!(
        named(&report),
        [("encoder_offset", Some("A"))],
        "{}",
        report.summary
    );
    let found = report.effects[0].parameters["angle"].value;
    assert!((found / -0.037 - 1.0).abs() < 0.02, "{found} rad");
}

#[test]
fn a_scale_far_off_is_named_with_its_number_and_its_calibration_leaves_nothing() {
    let mut recording = recording(Layout::FourBrake, SECONDS, 18, &nothing);
    let [_, theta_b] = &mut recording.theta;
    let start = theta_b.samples[0];
    for angle in &mut theta_b.samples {
        *angle = start + (1.0 - 0.061) * (*angle - start);
    }
    let rig = rig(Layout::FourBrake);
    let found = diagnose(&rig, &[&recording], None, &options());
    let report = &found.report;
    let expected = [("encoder_scale", Some("B"))];
    assert_eq!(named(report), expected, "{}", report.summary);
    let fraction = report.effects[0].parameters["fraction"].value;
    assert!((fraction / -0.061 - 1.0).abs() < 0.003, "{fraction}");
    let held_out = report.fit.as_ref().unwrap().held_out.unwrap();
    assert!(held_out.before > 5.0 * held_out.after, "{held_out:?}");
    assert_calibrated(&found, &recording);
}

#[test]
fn a_disc_off_its_centre_is_named_with_its_numbers_and_its_calibration_leaves_nothing() {
    let mut recording = recording(Layout::FourBrake, SECONDS, 19, &nothing);
    let [theta_a, _] = &mut recording.theta;
    let off = |angle: f64| 0.041 * libm::sin(angle) - 0.023 * libm::cos(angle);
    let start = off(theta_a.samples[0]);
    for angle in &mut theta_a.samples {
        *angle += off(*angle) - start;
    }
    let rig = rig(Layout::FourBrake);
    let found = diagnose(&rig, &[&recording], None, &options());
    let report = &found.report;
    let expected = [("eccentric_encoder", Some("A"))];
    assert_eq!(named(report), expected, "{}", report.summary);
    let [sine, cosine] = ["sine", "cosine"].map(|name| report.effects[0].parameters[name].value);
    assert!(!report.effects[0].parameters.contains_key("period"));
    // What is wrong at the start turns the phase by that angle.
    assert!(
        (sine.hypot(cosine) / 0.0470 - 1.0).abs() < 0.02,
        "{sine} {cosine}"
    );
    assert_calibrated(&found, &recording);
}

#[test]
fn an_encoder_error_is_refused_at_a_joint_without_an_encoder() {
    let recording = recording(Layout::FourBrake, SECONDS, 19, &nothing);
    let mut rig = rig(Layout::FourBrake);
    rig.effects.push(JointEffect {
        joint: Some(Joint::E),
        axis: None,
        effect: RigEffect {
            mechanism: Mechanism::EncoderScale,
            values: vec![Value::known(0.01)],
            onset: None,
            of_torque: false,
        },
    });
    let report = diagnose(&rig, &[&recording], None, &naming()).report;
    let reason = report.fault.expect("E has no encoder").reason;
    assert!(reason.contains("only A and B have one"), "{reason}");
}

#[test]
fn an_encoder_that_slips_is_named_with_when_and_its_calibration_leaves_nothing() {
    let mut recording = recording(Layout::FourBrake, LONGER, 21, &nothing);
    let [theta_a, _] = &mut recording.theta;
    for angle in theta_a.samples.iter_mut().skip(3700) {
        *angle += 0.043;
    }
    let rig = rig(Layout::FourBrake);
    let found = diagnose(&rig, &[&recording], None, &options());
    let report = &found.report;
    let expected = [("encoder_offset", Some("A"))];
    assert_eq!(named(report), expected, "{}", report.summary);
    let onset_s = report.effects[0].onset_s.unwrap();
    assert!((onset_s - 3.7).abs() < 0.3, "{onset_s} s");
    let told = &report.remarks[0];
    assert_eq!((told.channel, told.what), ("theta_a", "jumped"));
    assert!((told.to_s - 3.7).abs() < 0.002, "{told:?}");
    assert_calibrated(&found, &recording);
}

#[test]
fn a_force_that_reads_one_value_is_dead() {
    for (axis, level) in [(0, 0.0), (1, 0.0), (1, -0.731)] {
        let mut recording = recording(Layout::FourBrake, SECONDS, 22, &nothing);
        recording.force[axis].samples.fill(level);
        let rig = rig(Layout::FourBrake);
        let report = diagnose(&rig, &[&recording], None, &naming()).report;
        let fault = report.fault.expect("a dead force");
        assert_eq!(
            fault.channel,
            ["force_x", "force_y"][axis],
            "{}",
            report.summary
        );
        assert!(fault.reason.contains("check the cable"), "{}", fault.reason);
    }
}

/// A recording diagnosed with its own calibration is consistent, and the stated effects keep their
/// parameters.
fn assert_calibrated(found: &Diagnosis<FiveBar>, recording: &FiveBarRecording) {
    let calibrated = &found.calibration;
    let again = diagnose(calibrated, &[recording], None, &options());
    let floor = again.report.floor.as_ref().unwrap();
    assert_eq!(again.report.verdict, Verdict::Consistent, "{floor:?}");
    assert_eq!(again.calibration.effects, calibrated.effects);
}

#[test]
fn a_delay_that_swings_is_a_delay_and_more() {
    let mut recording = recording(Layout::FourBrake, SECONDS, 17, &nothing);
    for force in &mut recording.force {
        let now = force.samples.clone();
        for (k, sample) in force.samples.iter_mut().enumerate() {
            // Late by 8 ms ± 5 ms within 2.1 s, interpolated linearly between samples.
            let late = 8.0 + 5.0 * libm::sin(2.99e-3 * k as f64);
            let at = (k as f64 - late).max(0.0);
            let (before, share) = (at as usize, at.fract());
            *sample = (1.0 - share) * now[before] + share * now[(before + 1).min(now.len() - 1)];
        }
    }
    let rig = rig(Layout::FourBrake);
    let report = diagnose(&rig, &[&recording], None, &naming()).report;
    let only = [("channel_skew", None)];
    assert_eq!(named(&report), only, "{}", report.summary);
    assert_eq!(report.verdict, Verdict::PartlyExplained);
}

/// A spring at A of the four-brake layout, N·m/rad, and its rest angle, rad.
const SPRING: [f64; 2] = [0.47, 1.63];

#[test]
fn a_spring_rests_where_it_likes_and_may_push_at_angle_0() {
    let spring = |pose: &Pose, _: [f64; 4], _: f64| {
        let [stiffness, rest] = SPRING;
        [-stiffness * (pose.theta_a_rad - rest), 0.0, 0.0, 0.0]
    };
    let recording = recording(Layout::FourBrake, 3.0, 23, &spring);
    let rig = rig(Layout::FourBrake);
    let report = diagnose(&rig, &[&recording], None, &naming()).report;
    let expected = [("spring", Some("A"))];
    assert_eq!(named(&report), expected, "{}", report.summary);
    let found = report.effects[0].parameters["stiffness"].value;
    assert!((found / SPRING[0] - 1.0).abs() < 0.05, "{found} N·m/rad");
}
