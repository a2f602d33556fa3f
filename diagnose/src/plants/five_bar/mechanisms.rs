//! This file claims that the regression column of each mechanism equals what the mechanism does on
//! the reference rig.

use super::columns::{driving, fixed, free, known};
use super::equations::levers;
use super::run::{FiveBarRun, place_of};
use crate::cause::Cause;
use crate::filter::rms;
use crate::plant::Run;
use crate::problem::{add, less};
use rigproof_model::brake::Brake;
use rigproof_model::effects::{Instant, entry};
use rigproof_model::motion::two_coordinate::two_coordinate;
use rigproof_model::rig::{Contact, JointEffect, Parameters, Rig};
use rigproof_spec::effect::Mechanism;
use rigproof_spec::joint::Joint;
use rigproof_spec::layout::Layout;

const STEP_S: f64 = 1e-4;
const COUNT: usize = 9000;

/// The tip position to which a hand leads, m.
fn goal(time_s: f64) -> [f64; 2] {
    let sine = |rate: f64, phase: f64| libm::sin(rate * time_s + phase);
    [
        0.021 + 0.083 * sine(4.31, 0.3) + 0.037 * sine(7.13, 1.1),
        0.402 + 0.061 * sine(5.07, 2.1) + 0.029 * sine(8.71, 0.7),
    ]
}

/// A smoothly varying current, different for each brake, A.
fn current(place: usize, time_s: f64) -> f64 {
    0.19 + 0.13 * libm::sin(7.3 * time_s + 1.3 * place as f64)
}

/// An empty recording.
fn blank(layout: Layout) -> FiveBarRun {
    let braked = |joint| layout.brakes().contains(&joint);
    FiveBarRun {
        parameters: Parameters::of(layout),
        step_s: STEP_S,
        start_s: 0.0,
        theta: Default::default(),
        joints: Default::default(),
        poses: Vec::new(),
        forms: Vec::new(),
        levers: Default::default(),
        force: Default::default(),
        currents: Joint::ALL.map(|joint| braked(joint).then(Vec::new)),
        yields: Default::default(),
        yield_errors: Default::default(),
        stated_gaps_rad: [None; 4],
        theta_noise: 1e-9,
        still_rad: 1e-9,
        cutoff_hz: 1e3,
        force_noise: 1e-9,
        recorded: vec![true; COUNT],
        switched: vec![false; COUNT],
        speed_floor: 0.0,
        parts: Vec::new(),
        remarks: Vec::new(),
    }
}

/// Records the state of the rig exactly, with the masses of the nominal model.
fn record(run: &mut FiveBarRun, rig: &Rig, force: [f64; 2], currents: [f64; 4]) {
    let theta = rig.base_angles_rad();
    run.theta
        .iter_mut()
        .zip(theta)
        .for_each(|(own, x)| own.push(x));
    run.force
        .iter_mut()
        .zip(force)
        .for_each(|(own, x)| own.push(x));
    let (angles, rates) = (rig.joint_angles_rad(), rig.joint_rates_rad_s());
    for i in 0..4 {
        run.joints[i].push(Instant {
            time_s: rig.time_s(),
            position: angles[i],
            speed: rates[i],
            sense: match rig.contacts()[i] {
                Contact::Held => 0.0,
                Contact::Slips(sense) => sense,
                Contact::Absent => rates[i].signum(),
            },
        });
        run.currents[i]
            .iter_mut()
            .for_each(|own| own.push(currents[i]));
    }
    let Parameters { arms, inertia, .. } = &run.parameters;
    let form = two_coordinate(arms, inertia, rig.pose(), rig.base_rates_rad_s());
    run.poses.push(*rig.pose());
    run.forms.push(form);
}

/// Where the backlash begins or ends.
fn turned(mut brake: Brake, motion: &[Instant]) -> Vec<bool> {
    let along = motion.iter().skip(1).map(|now| {
        let was_inside = brake.backlash().is_inside();
        brake.step(0.0, now.position, now.speed, STEP_S);
        brake.backlash().is_inside() != was_inside
    });
    core::iter::once(false).chain(along).collect()
}

/// Computes the nominal brakes along the recording. Returns the samples around which no joint
/// reverses and no brake enters or leaves its backlash.
fn counted(run: &mut FiveBarRun) -> Vec<bool> {
    let mut counts = vec![true; COUNT];
    for i in 0..4 {
        let motion = &run.joints[i];
        let (own, turned) = match &run.currents[i] {
            Some(_) => {
                let brake = Brake::new(Joint::ALL[i], motion[0].position);
                (
                    run.braked(Joint::ALL[i]).unwrap().yields(),
                    turned(brake, motion),
                )
            }
            None => (vec![0.0; COUNT], vec![false; COUNT]),
        };
        run.yields[i] = own;
        for k in 0..COUNT {
            let around = k.saturating_sub(3)..(k + 4).min(COUNT);
            let sense = motion[k].sense;
            let steady = motion[around.clone()].iter().all(|now| now.sense == sense);
            counts[k] &=
                around.len() == 7 && sense != 0.0 && steady && !turned[around].contains(&true);
        }
    }
    counts
}

/// An exact recording of the rig with effects, and the samples that count.
fn exact(layout: Layout, effects: &[JointEffect]) -> (FiveBarRun, Vec<bool>) {
    let mut run = blank(layout);
    let rig = Rig::new(layout, goal(0.0)).unwrap();
    let mut rig = rig.with_effects(effects).unwrap();
    for k in 0..COUNT {
        let time_s = k as f64 * STEP_S;
        let hand = |at_s: f64, tip: [f64; 2], speed: [f64; 2]| {
            let to = goal(at_s);
            [0, 1].map(|i| 420.0 * (to[i] - tip[i]) - 11.0 * speed[i])
        };
        let currents = [0, 1, 2, 3].map(|i| match run.currents[i] {
            Some(_) => current(i, time_s),
            None => 0.0,
        });
        let force = hand(time_s, rig.tip_m(), rig.tip_velocity_m_s());
        record(&mut run, &rig, force, currents);
        // The goal is constant within a step. Its midpoint gives the right mean.
        let middle_s = time_s + 0.5 * STEP_S;
        let force = |tip: [f64; 2], speed: [f64; 2]| hand(middle_s, tip, speed);
        rig.step_under(&force, currents, STEP_S).unwrap();
    }
    run.levers = levers(&run.forms);
    let counts = counted(&mut run);
    (run, counts)
}

/// The regression columns of a mechanism, times its parameters.
fn column(run: &FiveBarRun, effect: &JointEffect) -> Vec<f64> {
    let cause = Cause::at(effect.mechanism, place_of(effect.joint));
    let cause = match effect.of_torque {
        true => cause.of_torque(),
        false => cause,
    };
    let linear = entry(effect.mechanism).unwrap().linear;
    let (own, shape) = effect.parameters.split_at(linear);
    let mut sum = vec![0.0; 2 * run.len()];
    match free(run, cause, shape) {
        Some(columns) => {
            for (column, coefficient) in columns.iter().zip(own) {
                add(&mut sum, column, *coefficient);
            }
        }
        None => sum = fixed(run, cause, shape).unwrap(),
    }
    if let Some(onset_s) = effect.onset_s {
        let first = run.clock().sample_at(onset_s);
        let half = sum.len() / 2;
        for output in sum.chunks_mut(half) {
            output[..first].fill(0.0);
        }
    }
    sum
}

/// Over the samples that count: the third quartile of the residual with the column, the root mean
/// square of the column, both N·m, and the number of samples.
fn apart(layout: Layout, effect: &JointEffect) -> (f64, f64, usize) {
    let (run, counts) = exact(layout, std::slice::from_ref(effect));
    let residual = less(&driving(&run, run.forces()), &known(&run));
    let column = column(&run, effect);
    let twice = || counts.iter().chain(&counts);
    let kept = |values: &[f64]| -> Vec<f64> {
        let pairs = values.iter().zip(twice());
        pairs.filter(|(_, c)| **c).map(|(v, _)| *v).collect()
    };
    let mut left = kept(&less(&residual, &column));
    left.iter_mut().for_each(|x| *x = x.abs());
    left.sort_by(f64::total_cmp);
    let unexplained = left[left.len() * 3 / 4];
    let counted = counts.iter().filter(|c| **c).count();
    (unexplained, rms(&kept(&column)), counted)
}

fn of_torque(effect: JointEffect) -> JointEffect {
    JointEffect {
        of_torque: true,
        ..effect
    }
}

/// At a joint, from the start.
fn at(mechanism: Mechanism, joint: Joint, parameters: &[f64]) -> JointEffect {
    JointEffect {
        mechanism,
        joint: Some(joint),
        of_torque: false,
        parameters: parameters.to_vec(),
        onset_s: None,
    }
}

#[test]
fn everything_that_a_brake_does_with_its_current_is_what_its_column_says() {
    use Mechanism::*;
    for (effect, onset_s) in [
        (at(Lag, Joint::E, &[0.037]), None),
        (at(DeadTime, Joint::A, &[0.0237]), None),
        (at(Saturation, Joint::B, &[0.213]), None),
        (at(Saturation, Joint::B, &[0.313, 2.1]), None),
        (at(CurrentHysteresis, Joint::C, &[0.071, 0.3]), None),
        (at(CurrentHysteresis, Joint::C, &[0.071, 0.3, 0.31]), None),
        (at(ThermalFade, Joint::A, &[0.31, 7.3]), None),
        (at(TorqueDrift, Joint::A, &[-0.13]), None),
        (at(TorqueDrift, Joint::E, &[-0.31, 0.7]), None),
        (at(BacklashWidth, Joint::A, &[0.031]), None),
        (at(TimeConstant, Joint::E, &[2.3]), None),
        (at(CurrentGain, Joint::B, &[1.31]), None),
        (at(CurrentGain, Joint::B, &[0.71]), Some(0.43)),
    ] {
        assert_meets(Layout::FourBrake, &JointEffect { onset_s, ..effect });
    }
}

#[test]
fn every_mechanism_does_along_a_motion_what_its_column_says() {
    use Mechanism::*;
    let whole = |mechanism, parameters: &[f64]| JointEffect {
        joint: None,
        ..at(mechanism, Joint::A, parameters)
    };
    for (effect, onset_s) in [
        (at(DryOffset, Joint::E, &[0.137]), None),
        (at(DryOffset, Joint::C, &[0.137]), Some(0.43)),
        (at(ConstantBias, Joint::C, &[-0.113]), None),
        (at(Viscous, Joint::A, &[0.077]), None),
        (at(Viscous, Joint::E, &[0.077]), Some(0.43)),
        (at(VelocityPower, Joint::E, &[0.137, 0.5]), None),
        (at(VelocityPower, Joint::A, &[0.31, 2.0]), Some(0.43)),
        (at(GainError, Joint::B, &[0.17]), None),
        (at(DirectionAsymmetry, Joint::E, &[0.031, 0.071]), None),
        (at(Stribeck, Joint::A, &[0.23, 0.37, 1.3]), None),
        (at(Stribeck, Joint::E, &[0.31, 0.53, 1.7, 0.029]), None),
        (at(Presliding, Joint::C, &[0.19, 0.013]), None),
        (
            at(AsymmetricPresliding, Joint::B, &[0.07, 0.29, 0.017]),
            None,
        ),
        (at(Hysteresis, Joint::E, &[3.1, 11.3, 4.7]), None),
        (at(ReversalOvershoot, Joint::B, &[0.37, 0.083]), None),
        (at(FrictionOvershoot, Joint::B, &[0.31, 0.083]), None),
        (at(Settling, Joint::E, &[0.41, 0.53]), None),
        (at(Ripple, Joint::A, &[0.091, -0.053, 0.113]), None),
        (at(UnevenFriction, Joint::A, &[0.083, -0.047, 0.37]), None),
        (at(Spring, Joint::B, &[0.171]), None),
        (at(NonlinearSpring, Joint::C, &[0.071]), None),
        (at(BiasDrift, Joint::A, &[0.31]), None),
        (at(BiasDrift, Joint::E, &[0.71, 0.37]), None),
        (at(LoadDependent, Joint::E, &[0.0071]), None),
        (of_torque(at(DryOffset, Joint::A, &[0.17])), None),
        (of_torque(at(Stribeck, Joint::E, &[0.31, 0.53, 1.7])), None),
        (of_torque(at(Ripple, Joint::B, &[0.13, -0.07, 0.31])), None),
        (of_torque(at(Presliding, Joint::C, &[0.23, 0.013])), None),
        (whole(PlaneSpring, &[17.0, 1.3, 0.113, 0.271]), None),
        (whole(Gravity, &[0.071, -0.113]), None),
        (whole(Gravity, &[0.071, -0.113]), Some(0.43)),
        (whole(Payload, &[0.37]), None),
        (whole(Payload, &[0.37]), Some(0.43)),
        (whole(InertiaScale, &[-0.11]), Some(0.43)),
        (
            whole(InertiaError, &[0.0137, -0.0071, 0.0053, 0.0047, 0.071]),
            None,
        ),
    ] {
        assert_meets(Layout::FourBrake, &JointEffect { onset_s, ..effect });
    }
    assert_meets(Layout::ThreeBrake, &at(BearingFriction, Joint::C, &[0.107]));
}

/// Measured: a residual of at most 1.2e-4 N·m (other backlash) for columns of 0.053 to 0.64 N·m,
/// over at least 6700 samples. The last quarter of samples holds jumps of a brake's time constant.
fn assert_meets(layout: Layout, effect: &JointEffect) {
    let (unexplained, size, counted) = apart(layout, effect);
    assert!(
        unexplained < 1.5e-4 && size > 0.05 && counted > 6000,
        "{effect:?}: {unexplained} of {size} N·m over {counted} samples"
    );
}

#[test]
fn what_a_sensor_does_is_the_whole_of_it_and_not_its_slope() {
    let (run, _) = exact(Layout::FourBrake, &[]);
    let balance = |run: &FiveBarRun| less(&driving(run, run.forces()), &known(run));
    let own = balance(&run);
    let assert_is = |cause: Cause, told: &[f64], slope: &[f64], shown: &FiveBarRun| {
        // The diagnosis sees the shown angles. Subtracting the cause's column must leave the
        // balance of the true ones.
        let there = less(&balance(shown), told);
        let [off, by_slope, size] = [&there, &less(&balance(shown), slope), &balance(shown)]
            .map(|values| rms(&less(values, &own)));
        assert!(
            off < 1e-9 * size,
            "{}: {off} of {size} N·m",
            run.cause_name(cause)
        );
        assert!(
            by_slope > 0.01 * size,
            "{}: {by_slope}",
            run.cause_name(cause)
        );
    };
    let times = |column: &[f64], by: f64| -> Vec<f64> { column.iter().map(|x| by * x).collect() };
    let turned = Cause::of(Mechanism::ForceRotation);
    let mut shown = run.clone();
    let (sine, cosine) = libm::sincos(0.137);
    let [x, y] = &mut shown.force;
    for (x, y) in x.iter_mut().zip(y) {
        (*x, *y) = (cosine * *x - sine * *y, sine * *x + cosine * *y);
    }
    let told = fixed(&shown, turned, &[0.137]).unwrap();
    let slope = times(&fixed(&shown, turned, &[1e-6]).unwrap(), 0.137e6);
    assert_is(turned, &told, &slope, &shown);
}
