//! This file aligns a recording of a five-bar with its description.

use super::checks::{check_mended, check_recorded, check_sign};
use super::equations::{forms, levers};
use super::run::{FiveBarRun, place, place_of};
use super::sensors::{angle_noise, noise_of_force, quantum_of};
use super::stops::{forget_sense_at_stops, switched};
use crate::align::{
    Fault, band_hz, check_clock, cutoff_hz, forget_sense_at_rest, forget_sense_at_reversals,
    median_step, regular_count, resample, smoothed_motion,
};
use crate::cause::{Cause, Place, Scales};
use crate::continuity::{Position, Remark, Stamps, mend, settle};
use crate::doubt::{Smoothing, a_sample_late, greatest_change, turning};
use crate::effect::Effect;
use crate::plants::brake::Braked;
use crate::rules::{KINEMATIC_DOUBT, MOST_OF_AN_ENCODER, STILL_QUANTA, STILL_SIGMAS};
use core::f64::consts::TAU;
use rigproof_model::brake::{Brake, ENTRY_TRAVEL_DEG};
use rigproof_model::effects::Instant;
use rigproof_model::error::ModelError;
use rigproof_model::rig::Parameters;
use rigproof_spec::effect::Mechanism;
use rigproof_spec::joint::Joint;
use rigproof_spec::tables::{BrakeTable, brake_table};
use rigproof_spec::units::RAD_PER_DEG;
use rigproof_trace::rig::five_bar::{FiveBar, FiveBarRecording, JointEffect};
use rigproof_trace::rig::{Signal, Status};

/// Aligns a recording of a five-bar.
///
/// # Errors
/// The fault that makes any conclusion meaningless.
pub fn aligned(rig: &FiveBar, recording: &FiveBarRecording) -> Result<FiveBarRun, Fault> {
    let step_s = median_step(&recording.time_s);
    check_clock(&recording.time_s, step_s)?;
    check_recorded(recording)?;
    let (recording, mended, jitter) = &mended(recording, step_s)?;
    let time_s = &recording.time_s;
    let count = regular_count(time_s, step_s);
    let mut recorded = vec![true; count];
    let mut regular = |samples: &[f64]| {
        let (values, own) = resample(time_s, samples, step_s, count);
        recorded
            .iter_mut()
            .zip(own)
            .for_each(|(all, own)| *all &= own);
        values
    };
    let [theta_a, theta_b] = &recording.theta;
    let [force_x, force_y] = &recording.force;
    let theta = [regular(&theta_a.samples), regular(&theta_b.samples)];
    let force = [regular(&force_x.samples), regular(&force_y.samples)];
    let mut currents = [const { None }; 4];
    for (slot, signal) in currents.iter_mut().zip(&recording.currents) {
        if let Some(signal) = signal {
            *slot = Some(regular(&signal.samples));
        }
    }
    check_mended(recording, step_s)?;
    // One value stands for both channels: the greater.
    let greater = |of: fn(&Signal) -> f64, [one, other]: [&Signal; 2]| of(one).max(of(other));
    let quantum = greater(quantum_of, [theta_a, theta_b]);
    let theta_noise = greater(angle_noise, [theta_a, theta_b]).hypot(*jitter);
    let force_noise = greater(noise_of_force, [force_x, force_y]);
    let switched = switched(&currents, step_s, count);
    let run = FiveBarRun {
        parameters: Parameters::of(rig.layout),
        step_s,
        start_s: 0.0,
        theta: [const { Vec::new() }; 2],
        joints: [const { Vec::new() }; 4],
        poses: Vec::new(),
        forms: Vec::new(),
        levers: Default::default(),
        cutoff_hz: cutoff_hz(
            step_s,
            force.iter().map(|f| band_hz(f, step_s)).fold(0.0, f64::max),
        ),
        force,
        currents,
        yields: [const { Vec::new() }; 4],
        yield_errors: [const { Vec::new() }; 4],
        stated_gaps_rad: Joint::ALL.map(|joint| stated_gap_rad(rig, joint)),
        theta_noise,
        still_rad: (STILL_QUANTA * quantum).max(STILL_SIGMAS * theta_noise),
        force_noise,
        recorded,
        switched,
        speed_floor: 0.0,
        parts: Vec::new(),
        remarks: mended.clone(),
    };
    let run = match realigned(&run, theta.clone()) {
        Ok(run) => run,
        Err(found) => return Err(unassembled(run, theta, found)),
    };
    check_sign(&run)?;
    Ok(run)
}

/// The run with other angles, and with the uncertainty of its brakes recomputed.
///
/// # Errors
/// The linkage cannot be assembled at some sample: its index, and why.
pub fn realigned(
    run: &FiveBarRun,
    theta: [Vec<f64>; 2],
) -> Result<FiveBarRun, (usize, ModelError)> {
    let (mut run, untold) = moved_by(run, theta)?;
    run.yield_errors = Joint::ALL.map(|joint| yield_errors(&run, joint, &untold));
    Ok(run)
}

/// The fault of angles at which the linkage cannot be assembled, with a likely reading of the
/// channels.
fn unassembled(
    run: FiveBarRun,
    theta: [Vec<f64>; 2],
    (sample, error): (usize, ModelError),
) -> Fault {
    let at_s = sample as f64 * run.step_s;
    let turned_round = theta.iter().flatten().any(|angle| angle.abs() > TAU);
    let [theta_a, theta_b] = theta;
    let cure = if turned_round {
        "the angles go beyond a whole turn: if they are degrees, say so in the description (`unit = \"deg\"`)"
    } else if moved_by(&run, [theta_b, theta_a]).is_ok() {
        "with theta_a and theta_b swapped it can: give each its own column in the description"
    } else {
        "an encoder has lost counts, or its zero or sign is wrong"
    };
    Fault {
        channel: "theta_a",
        from_s: at_s,
        to_s: at_s,
        reason: format!("the linkage cannot stand at the recorded angles: {error}; {cure}"),
    }
}

/// The run with other angles. Its motion, equations and brakes are recomputed.
///
/// # Errors
/// The linkage cannot be assembled at some sample: its index, and why.
pub fn with_angles(
    run: &FiveBarRun,
    theta: [Vec<f64>; 2],
) -> Result<FiveBarRun, (usize, ModelError)> {
    moved_by(run, theta).map(|(run, _)| run)
}

/// The speeds of θA and θB below which their direction cannot be told, one value per sample, rad/s.
type Untold = [Vec<f64>; 2];

/// The run with other angles, and the speeds below which directions cannot be told.
fn moved_by(
    run: &FiveBarRun,
    theta: [Vec<f64>; 2],
) -> Result<(FiveBarRun, Untold), (usize, ModelError)> {
    let smoothed = theta
        .each_ref()
        .map(|theta| smoothed_motion(theta, run.step_s, run.cutoff_hz, run.theta_noise));
    let floors = smoothed.each_ref().map(|(_, floor)| *floor);
    let base = smoothed.map(|(motion, _)| motion);
    let (poses, forms) = forms(&run.parameters, &base)?;
    let mut run = FiveBarRun {
        theta,
        poses,
        levers: levers(&forms),
        forms,
        speed_floor: floors.into_iter().fold(0.0, f64::max),
        ..run.without_motion()
    };
    let untold = untold_speeds(&run, &base);
    run.joints = Joint::ALL.map(|joint| joint_motion(&run, &base, joint, &untold));
    run.yields = Joint::ALL.map(|joint| {
        let none = || vec![0.0; run.motion_of(joint).len()];
        nominal_yields(&run, joint).unwrap_or_else(none)
    });
    Ok((run, untold))
}

/// The recording with its angles repaired and its samples moved to the grid of their time stamps.
/// Also the remarks, and the angle noise that jitter adds.
fn mended(
    recording: &FiveBarRecording,
    step_s: f64,
) -> Result<(FiveBarRecording, Vec<Remark>, f64), Fault> {
    let mut own = recording.clone();
    let stamps = Stamps {
        time_s: &recording.time_s,
        step_s,
    };
    let names = ["theta_a", "theta_b"].into_iter();
    let mut angles: Vec<Position> = names
        .zip(&recording.theta)
        .map(|(channel, angle)| Position {
            channel,
            samples: angle.samples.clone(),
            stated_quantum: angle.quantum,
            quantum: quantum_of(angle),
            noise: angle.noise.unwrap_or(0.0),
            is_angle: true,
            slip: MOST_OF_AN_ENCODER,
        })
        .collect();
    let forces = own.force.iter_mut();
    let others = forces.chain(own.currents.iter_mut().flatten());
    let mut others: Vec<&mut Vec<f64>> = others.map(|signal| &mut signal.samples).collect();
    let mut mended = mend(stamps, &mut angles, &mut others)?;
    let settled = settle(stamps, &mut angles);
    for (slot, angle) in own.theta.iter_mut().zip(angles) {
        slot.samples = angle.samples;
    }
    let mut noise = 0.0;
    if let Some(settled) = settled {
        mended.push(settled.said);
        own.time_s = settled.time_s;
        noise = settled.noise;
    }
    Ok((own, mended, noise))
}

/// The speeds of θA and θB below which their direction cannot be told, one value per sample, rad/s.
/// While a brake switches, a joint may swing at twice the cut-off of the low-pass and more.
fn untold_speeds(run: &FiveBarRun, base: &[Vec<Instant>; 2]) -> Untold {
    let smoothing = Smoothing {
        step_s: run.step_s,
        cutoff_hz: run.cutoff_hz,
        noise: run.theta_noise,
        speed_floor: run.speed_floor,
    };
    let octaves = run
        .switched
        .iter()
        .map(|&switched| if switched { 2.0 } else { 1.0 });
    let octaves: Vec<f64> = octaves.collect();
    let [theta_a, theta_b] = &run.theta;
    let [a, b] = base;
    [(theta_a, a), (theta_b, b)].map(|(theta, own)| smoothing.untold_speeds(theta, own, &octaves))
}

/// The motion of a joint that follows from the angles and rates of A and B.
fn joint_motion(
    run: &FiveBarRun,
    base: &[Vec<Instant>; 2],
    joint: Joint,
    untold: &Untold,
) -> Vec<Instant> {
    let [a, b] = base;
    let [untold_a, untold_b] = untold;
    let pairs = a.iter().zip(b).zip(&run.poses).zip(run.joint_rows(joint));
    let pairs = pairs.zip(untold_a.iter().zip(untold_b));
    let mut motion: Vec<Instant> = pairs
        .map(|((((a, b), pose), [by_a, by_b]), (untold_a, untold_b))| {
            let floor = by_a.abs() * (untold_a + KINEMATIC_DOUBT * a.speed.abs())
                + by_b.abs() * (untold_b + KINEMATIC_DOUBT * b.speed.abs());
            let speed = by_a * a.speed + by_b * b.speed;
            Instant {
                time_s: a.time_s,
                position: match joint {
                    Joint::A => pose.theta_a_rad,
                    Joint::E => pose.theta_e_rad,
                    Joint::B => pose.theta_b_rad,
                    Joint::C => pose.theta_c_rad,
                },
                speed,
                sense: (speed / floor.max(1e-300)).clamp(-1.0, 1.0),
            }
        })
        .collect();
    let position: Vec<f64> = motion.iter().map(|now| now.position).collect();
    let still = run.still_rad_at(joint);
    let recorded = run
        .recorded_angle(joint, [a, b], &motion)
        .collect::<Vec<f64>>();
    forget_sense_at_rest(&mut motion, &position, run.step_s, still);
    forget_sense_at_stops(&mut motion, &recorded, (run.step_s, still), &run.switched);
    forget_sense_at_reversals(&mut motion);
    motion
}

/// The yield torque of a joint's nominal brake along the motion, N·m; `None` without a brake.
pub fn nominal_yields(run: &FiveBarRun, joint: Joint) -> Option<Vec<f64>> {
    run.motion_of(joint).first()?;
    Some(run.braked(joint)?.yields())
}

/// The uncertainty of the yield torque of a joint's brake, N·m.
///
/// It is the change of the torque if the speed, the start and end of the backlash, or the initial
/// position in the backlash differ by what the recording leaves open.
fn yield_errors(run: &FiveBarRun, joint: Joint, untold: &Untold) -> Vec<f64> {
    let none = || vec![0.0; run.motion_of(joint).len()];
    errors_of_brake(run, joint, untold).unwrap_or_else(none)
}

fn errors_of_brake(run: &FiveBarRun, joint: Joint, untold: &Untold) -> Option<Vec<f64>> {
    let table = brake_table(joint);
    let own = errors_with(run, joint, untold, table)?;
    let Some(gap_rad) = *run.stated_gaps_rad.get(place(joint))? else {
        return Some(own);
    };
    // It may have the stated width from an onset on only.
    let stated = BrakeTable {
        backlash_width_deg: gap_rad / RAD_PER_DEG,
        ..table
    };
    let stated = errors_with(run, joint, untold, stated)?;
    Some(own.iter().zip(&stated).map(|(a, b)| a.max(*b)).collect())
}

/// The width of the backlash that a description states for a joint, rad.
fn stated_gap_rad(rig: &FiveBar, joint: Joint) -> Option<f64> {
    let mut effects = rig.effects.iter();
    let is_gap = |own: &&JointEffect| {
        own.joint == Some(joint) && own.effect.mechanism == Mechanism::BacklashWidth
    };
    Some(effects.find(is_gap)?.effect.values.first()?.value)
}

/// The uncertainty of the yield torque of a brake, N·m, with the numbers of a table.
fn errors_with(
    run: &FiveBarRun,
    joint: Joint,
    untold: &Untold,
    table: BrakeTable,
) -> Option<Vec<f64>> {
    let motion = run.motion_of(joint);
    let braked = run.braked(joint)?;
    let start = motion.first()?.position;
    let along = |brake, motion: &[Instant]| Braked { motion, ..braked }.yields_of(brake);
    let untold = untold_of_joint(run, joint, untold);
    let turned = [1.0, -1.0].map(|sign| turning(motion, &untold, sign));
    let nominal = || Brake::of(table, start);
    let own = along(nominal(), motion);
    let mut others: Vec<Vec<f64>> = turned.map(|motion| along(nominal(), &motion)).into();
    if table.backlash_width_deg == 0.0 {
        return Some(greatest_change(&own, &others));
    }
    others.push(along(nominal(), &a_sample_late(motion)));
    let angle_deg = turning_point_error(run, joint, &untold) / RAD_PER_DEG;
    let half = 0.5 * table.backlash_width_deg * RAD_PER_DEG;
    for (by_deg, start) in [
        (angle_deg, start),
        (-angle_deg, start),
        (0.0, start - half),
        (0.0, start + half),
    ] {
        let changed = BrakeTable {
            backlash_width_deg: (table.backlash_width_deg + 2.0 * by_deg).max(0.0),
            ..table
        };
        let entry_deg = (ENTRY_TRAVEL_DEG + by_deg).max(0.0);
        let brake = Brake::of(changed, start).with_backlash_entry(start, entry_deg);
        others.push(along(brake, motion));
    }
    Some(greatest_change(&own, &others))
}

/// The speed of a joint below which its direction cannot be told, one value per sample, rad/s.
fn untold_of_joint(run: &FiveBarRun, joint: Joint, [untold_a, untold_b]: &Untold) -> Vec<f64> {
    let rows = run.joint_rows(joint).zip(untold_a.iter().zip(untold_b));
    rows.map(|([by_a, by_b], (a, b))| by_a.abs() * a + by_b.abs() * b)
        .collect()
}

/// The uncertainty of the angle at which a joint reverses, rad, from counts and from the low-pass
/// that rounds the reversal.
fn turning_point_error(run: &FiveBarRun, joint: Joint, untold: &[f64]) -> f64 {
    let pairs = run
        .joint_rows(joint)
        .zip(run.motion_of(joint).iter().zip(untold));
    let errors = pairs.map(|([by_a, by_b], (now, untold))| {
        let turns = now.sense.abs() < 1.0;
        let rounded = if turns {
            untold / (TAU * run.cutoff_hz)
        } else {
            0.0
        };
        (by_a.abs() + by_b.abs()) * run.still_rad + rounded
    });
    errors.fold(0.0, f64::max)
}

/// The effects that the nominal model has beyond the thesis's.
pub fn nominal(rig: &FiveBar) -> Vec<Effect> {
    rig.effects
        .iter()
        .map(|own| Effect {
            cause: Cause {
                mechanism: own.effect.mechanism,
                at: own.axis.map_or(place_of(own.joint), Place::Axis),
                scales: match own.effect.of_torque {
                    true => Scales::Torque,
                    false => Scales::Nothing,
                },
            },
            parameters: own.effect.values.iter().map(|v| v.value).collect(),
            unknown: own.effect.values.iter().any(|v| v.status != Status::Known),
            onset_s: own.effect.onset.map(|v| v.value),
        })
        .collect()
}
