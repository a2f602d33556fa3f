//! This file resamples a recording of an arm to a regular clock and sets up the equations of its
//! joints.

use super::parts::{ArmPlace, stated};
use super::run::ChainRun;
use crate::align::{
    Fault, check_clock, check_missing, cutoff_hz, forget_sense_at_rest, forget_sense_at_reversals,
    median_step, quiet_cutoff_hz, regular_count, resample, smallest_step, smoothed_motion,
};
use crate::filter::{deviation, gradient};
use crate::rules::{ARM_PERIODS, ARM_WIDTH_S, MOTOR_FOLLOWS, STILL_QUANTA, STILL_SIGMAS};
use core::f64::consts::TAU;
use rigproof_model::chain::{Chain, INERTIAL, Inertial, Joint, Kind};
use rigproof_model::effects::Instant;
use rigproof_spec::effect::{Mechanism, Motion};
use rigproof_trace::rig::Signal;
use rigproof_trace::rig::chain::{ChainRecording, ChainRig, ModelFormat};
use rigproof_trace::rig::transmission::Part;
use std::collections::BTreeSet;
use std::sync::{Mutex, PoisonError};

/// A fault of a channel that concerns the whole recording.
pub(super) fn fault(channel: &'static str, reason: String) -> Fault {
    Fault {
        channel,
        from_s: 0.0,
        to_s: 0.0,
        reason,
    }
}

/// A name with a static lifetime. Reports hold the names of joints as `&'static str`.
pub(super) fn lasting(name: &str) -> &'static str {
    static NAMES: Mutex<BTreeSet<&'static str>> = Mutex::new(BTreeSet::new());
    let mut names = NAMES.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(own) = names.get(name) {
        return own;
    }
    let own: &'static str = Box::leak(name.to_owned().into_boxed_str());
    names.insert(own);
    own
}

/// The arm of a description, from its model. Every joint that moves needs a channel.
pub(super) fn arm(rig: &ChainRig) -> Result<Chain, String> {
    let read = match rig.format {
        ModelFormat::Urdf => Chain::from_urdf,
        ModelFormat::Mjcf => Chain::from_mjcf,
    };
    let chain = read(&rig.model, rig.tip.as_deref());
    let chain = chain.map_err(|error| format!("{}: {error}", rig.file))?;
    let known: Vec<&str> = chain.joints.iter().map(|own| own.name.as_str()).collect();
    for joint in &rig.joints {
        if !known.contains(&joint.name.as_str()) {
            return Err(format!(
                "`{}` is no moving joint of {}; it has {}",
                joint.name,
                rig.file,
                known.join(", ")
            ));
        }
    }
    for own in &chain.joints {
        let Some(joint) = rig.joint(&own.name) else {
            return Err(format!(
                "joint `{}` of {} has no `[[joint]]`: its position and effort are needed, or end the arm before it (`tip`)",
                own.name, rig.file
            ));
        };
        let slides = own.kind == Kind::Prismatic;
        if slides != (joint.motion == Motion::Linear) {
            let word = if slides { "linear" } else { "rotary" };
            return Err(format!("joint `{}` needs `motion = \"{word}\"`", own.name));
        }
    }
    Ok(chain)
}

/// A position on regular samples, with its smoothed motion.
pub(super) struct Moving {
    position: Vec<f64>,
    pub(super) motion: Vec<Instant>,
    floor: f64,
    pub(super) noise: f64,
}

/// An effort on regular samples.
pub(super) struct Metered {
    pub(super) signal: Vec<f64>,
    pub(super) noise: f64,
}

/// The channels of one joint on regular samples.
pub(super) struct Aligned {
    pub(super) link: Moving,
    pub(super) effort: Metered,
    pub(super) motor: Option<Moving>,
    pub(super) torque: Option<Metered>,
    recorded: Vec<bool>,
}

/// Aligns a recording.
///
/// # Errors
/// The fault that makes any conclusion meaningless.
pub(super) fn aligned(rig: &ChainRig, recording: &ChainRecording) -> Result<ChainRun, Fault> {
    let chain = arm(rig).map_err(|reason| fault(rig.format.key(), reason))?;
    let step_s = median_step(&recording.time_s);
    check_clock(&recording.time_s, step_s)?;
    let place = |name: &str| rig.joints.iter().position(|joint| joint.name == name);
    let each = chain.joints.iter().filter_map(|own| place(&own.name));
    let each = each.map(|k| joint(recording, k, step_s));
    let joints: Vec<Aligned> = each.collect::<Result<_, Fault>>()?;
    for (own, joint) in chain.joints.iter().zip(&joints) {
        check_position(own, joint)?;
        check_motor(own, joint)?;
    }
    Ok(equations(rig, &chain, &joints, step_s))
}

fn check_position(of: &Joint, own: &Aligned) -> Result<(), Fault> {
    let positions = own.link.position.iter();
    let most = positions.fold(0.0, |most: f64, q| most.max(q.abs()));
    if of.kind == Kind::Prismatic || most <= 4.0 * TAU {
        return Ok(());
    }
    let reason = format!(
        "joint `{}` goes to {most:.0} rad, beyond four turns: are these degrees? say `unit = \"deg\"`",
        of.name
    );
    Err(fault("position", reason))
}

/// A motor goes as far as its link and in the same sense, but for the twist.
fn check_motor(of: &Joint, own: &Aligned) -> Result<(), Fault> {
    let Some(motor) = &own.motor else {
        return Ok(());
    };
    let slope = slope(&own.link.position, &motor.position);
    if slope.is_nan() || MOTOR_FOLLOWS.contains(&slope) {
        return Ok(());
    }
    let reason = format!(
        "the motor of joint `{}` moves {slope:.4} times as far as its link: give the gear ratio as `scale` of `motor`, a motor that counts the other way `sign = -1`, and check both units",
        of.name
    );
    Err(fault("motor", reason))
}

/// The slope of the straight line through the points of one signal over another; NaN if that one
/// does not change.
fn slope(of: &[f64], over: &[f64]) -> f64 {
    let mean = |own: &[f64]| own.iter().sum::<f64>() / own.len().max(1) as f64;
    let means = [mean(of), mean(over)];
    let pairs = of
        .iter()
        .zip(over)
        .map(|(x, y)| [x - means[0], y - means[1]]);
    let [square, both] = pairs.fold([0.0; 2], |[square, both], [x, y]| {
        [square + x * x, both + x * y]
    });
    both / square
}

fn joint(recording: &ChainRecording, k: usize, step_s: f64) -> Result<Aligned, Fault> {
    let (Some(position), Some(effort)) = (recording.position.get(k), recording.effort.get(k))
    else {
        return Err(fault("position", "a joint has no channel".to_owned()));
    };
    let (motor, torque) = (recording.motor.get(k), recording.torque.get(k));
    let (motor, torque) = (
        motor.and_then(Option::as_ref),
        torque.and_then(Option::as_ref),
    );
    let mut recorded = vec![true; regular_count(&recording.time_s, step_s)];
    let mut regular = |channel, own: &Signal| -> Result<Vec<f64>, Fault> {
        check_missing(channel, &recording.time_s, &own.samples)?;
        let (signal, told) = resample(&recording.time_s, &own.samples, step_s, recorded.len());
        recorded
            .iter_mut()
            .zip(told)
            .for_each(|(a, b)| *a = *a && b);
        Ok(signal)
    };
    let link = moving(regular("position", position)?, position, step_s);
    let effort = metered(regular("effort", effort)?, effort);
    let motor = motor.map(|own| Ok(moving(regular("motor", own)?, own, step_s)));
    let torque = torque.map(|own| Ok(metered(regular("torque", own)?, own)));
    Ok(Aligned {
        link,
        effort,
        motor: motor.transpose()?,
        torque: torque.transpose()?,
        recorded,
    })
}

fn moving(position: Vec<f64>, of: &Signal, step_s: f64) -> Moving {
    let quantum = of.quantum.unwrap_or_else(|| smallest_step(&position));
    let noise = (quantum / 12f64.sqrt()).hypot(of.noise.unwrap_or(0.0));
    moved(position, step_s, noise, STILL_QUANTA * quantum)
}

/// A position with this noise that may rest within this distance.
fn moved(position: Vec<f64>, step_s: f64, noise: f64, rest: f64) -> Moving {
    let most_hz = cutoff_hz(step_s, ARM_PERIODS / ARM_WIDTH_S);
    let cutoff_hz = quiet_cutoff_hz(&position, step_s, most_hz, noise);
    let (mut motion, floor) = smoothed_motion(&position, step_s, cutoff_hz, noise);
    forget_sense_at_rest(
        &mut motion,
        &position,
        step_s,
        rest.max(STILL_SIGMAS * noise),
    );
    forget_sense_at_reversals(&mut motion);
    Moving {
        position,
        motion,
        floor,
        noise,
    }
}

fn metered(signal: Vec<f64>, of: &Signal) -> Metered {
    let seen = || (smallest_step(&signal) / 12f64.sqrt()).max(scatter(&signal));
    let noise = of.noise.unwrap_or_else(seen);
    Metered { signal, noise }
}

impl Aligned {
    /// The position of the motor less that of the link.
    pub(super) fn twist(&self, step_s: f64) -> Option<Moving> {
        let motor = self.motor.as_ref()?;
        let pairs = motor.position.iter().zip(&self.link.position);
        let position: Vec<f64> = pairs.map(|(motor, link)| motor - link).collect();
        let noise = motor.noise.hypot(self.link.noise);
        Some(moved(position, step_s, noise, 0.0))
    }

    /// The motor's position where no encoder shows it: that of the link, and the twist of a
    /// transmission of this stiffness under the torque that a sensor shows.
    pub(super) fn wound(&self, stiffness: f64, step_s: f64) -> Option<Moving> {
        let torque = self.torque.as_ref().filter(|_| stiffness > 0.0)?;
        let pairs = self.link.position.iter().zip(&torque.signal);
        let position = pairs
            .map(|(link, torque)| link + torque / stiffness)
            .collect();
        let noise = self.link.noise.hypot(torque.noise / stiffness);
        Some(moved(position, step_s, noise, 0.0))
    }
}

impl Moving {
    /// The torque of a spring of this deflection.
    pub(super) fn sprung(&self, stiffness: f64) -> Metered {
        Metered {
            signal: self.position.iter().map(|own| stiffness * own).collect(),
            noise: stiffness * self.noise,
        }
    }
}

/// The standard deviation of a signal's noise, from the median of its second differences. Motion
/// adds little to these at the usual sample rates.
fn scatter(signal: &[f64]) -> f64 {
    let second = signal.windows(3).map(|own| match own {
        [a, b, c] => a - 2.0 * b + c,
        _ => 0.0,
    });
    deviation(second.collect()).unwrap_or(0.0) / 6f64.sqrt()
}

/// The effort of every joint, one joint after another, per unit of each
/// inertial parameter of each link. The last
/// signals are the efforts of the given parameter `sets`.
fn efforts(chain: &Chain, joints: &[Aligned], step_s: f64, sets: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let (count, samples) = (
        joints.len(),
        joints.first().map_or(0, |own| own.link.motion.len()),
    );
    let columns = chain.of_each_link();
    let all = columns.len();
    let mut momentum = vec![vec![0.0; count * samples]; all + sets.len()];
    let mut rest = momentum.clone();
    for k in 0..samples {
        let at = |of: fn(&Instant) -> f64| -> Vec<f64> {
            let each = joints.iter();
            each.map(|own| own.link.motion.get(k).map_or(0.0, of))
                .collect()
        };
        let own = chain.momentum(&at(|now| now.position), &at(|now| now.speed));
        for (from, to) in [(&own.momentum, &mut momentum), (&own.rest, &mut rest)] {
            for joint in 0..count {
                let row = from.row(joint);
                let numbers = columns.iter().map(|&c| row.get(c).copied().unwrap_or(0.0));
                let whole = |set: &Vec<f64>| row.iter().zip(set).map(|(x, p)| x * p).sum();
                let wholes = sets.iter().map(whole);
                for (signal, value) in to.iter_mut().zip(numbers.chain(wholes)) {
                    if let Some(slot) = signal.get_mut(joint * samples + k) {
                        *slot = value;
                    }
                }
            }
        }
    }
    let signals = momentum.into_iter().zip(rest).map(|(momentum, rest)| {
        let stretches = momentum.chunks(samples.max(1));
        let rates = stretches.flat_map(|own| gradient(own, step_s));
        rates.zip(rest).map(|(rate, rest)| rate + rest).collect()
    });
    signals.collect()
}

/// The mass of a link and its radius of gyration about its joint: the root of half the trace of its
/// tensor over its mass, 0 without mass.
fn body(link: &Inertial) -> [f64; 2] {
    let square = 0.5 * link.second.trace() / link.mass;
    [link.mass, if square > 0.0 { square.sqrt() } else { 0.0 }]
}

/// The equations along a motion: the effort of the described inertias, and the effort per unit of
/// each inertial parameter.
fn equations(rig: &ChainRig, chain: &Chain, joints: &[Aligned], step_s: f64) -> ChainRun {
    let samples = joints.first().map_or(0, |own| own.link.motion.len());
    let sets = [chain.of_a_payload(), chain.parameters()];
    let mut signals = efforts(chain, joints, step_s, &sets);
    let mut known = signals.pop().unwrap_or_default();
    let payload = signals.pop().unwrap_or_default();
    let bare = chain.joints.iter().zip(joints);
    for (stretch, (own, joint)) in known.chunks_mut(samples.max(1)).zip(bare) {
        let motion = &joint.link.motion;
        let rotor = rotor_at_link(rig, own);
        let faster = accelerations(motion, step_s);
        for ((slot, now), faster) in stretch.iter_mut().zip(motion).zip(faster) {
            let friction = own.damping * now.speed + own.friction * now.sense;
            *slot += friction + rotor * faster;
        }
    }
    let mut recorded = vec![true; samples];
    for joint in joints {
        recorded
            .iter_mut()
            .zip(&joint.recorded)
            .for_each(|(a, b)| *a = *a && *b);
    }
    let middle = joints.iter();
    let middle = middle.map(|own| own.link.position.get(samples / 2).copied().unwrap_or(0.0));
    let masses = chain.mass_matrix(&middle.collect::<Vec<_>>()).diagonal();
    let mut run = ChainRun {
        step_s,
        start_s: 0.0,
        equations: (0..joints.len()).collect(),
        places: each_link(rig, chain),
        motions: joints.iter().map(|own| own.link.motion.clone()).collect(),
        effort: joints
            .iter()
            .flat_map(|own| own.effort.signal.iter().copied())
            .collect(),
        known,
        payload,
        bodies: chain.joints.iter().map(|own| body(&own.inertial)).collect(),
        links: chain
            .of_each_link()
            .iter()
            .map(|c| (c / INERTIAL, c % INERTIAL))
            .zip(signals)
            .collect(),
        noise: joints
            .iter()
            .map(|own| [own.link.noise, own.effort.noise])
            .collect(),
        masses: masses.iter().copied().collect(),
        speed_floor: joints.iter().map(|own| own.link.floor).fold(0.0, f64::max),
        recorded,
        seams: Vec::new(),
    };
    run.split_joints(rig, chain, joints);
    run
}

/// The described inertia of the motor that moves with a link: none where the motor has an equation
/// of its own.
fn rotor_at_link(rig: &ChainRig, joint: &Joint) -> f64 {
    match stated(rig, joint) {
        Some(_) => 0.0,
        None => joint.armature,
    }
}

fn each_link(rig: &ChainRig, chain: &Chain) -> Vec<ArmPlace> {
    let each = chain.joints.iter().enumerate();
    let links = each.map(|(joint, own)| ArmPlace {
        name: lasting(&own.name),
        part: Part::Link,
        is_split: stated(rig, own).is_some(),
        described: vec![
            (Mechanism::DryOffset, own.friction),
            (Mechanism::Viscous, own.damping),
            (Mechanism::AddedInertia, rotor_at_link(rig, own)),
        ],
        rows: vec![(joint, 1.0)],
    });
    links.collect()
}

pub(super) fn accelerations(motion: &[Instant], step_s: f64) -> Vec<f64> {
    let speeds: Vec<f64> = motion.iter().map(|now| now.speed).collect();
    gradient(&speeds, step_s)
}
