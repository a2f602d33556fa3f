//! This file simulates an experiment on the reference rig: what encoders, force sensor and
//! amplifiers would record.

use super::super::free_run::{Model, of_axis, parts_of};
use super::super::run::joint_at;
use super::plan::Plan;
use crate::effect::Effect;
pub(crate) use crate::rules::{DAMPING_NS_M, STIFFNESS_N_M};
use crate::sensor::normal;
use crate::signals::shifted;
use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::SeedableRng;
use rigproof_model::effects::{Drive, Form, OfSensor, form};
use rigproof_model::error::ModelError;
use rigproof_model::linkage::inverse;
use rigproof_model::rig::{JointEffect, Parameters, Rig};
use rigproof_spec::joint::Joint;
use rigproof_spec::layout::Layout;
use rigproof_spec::methods::greatest_desired_force_n;
use rigproof_spec::units::{Dimension, Unit};
use rigproof_trace::rig::Signal;
use rigproof_trace::rig::five_bar::{FiveBar, FiveBarRecording};

/// The recording of an experiment, before quantisation and noise.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Played {
    /// Time stamps, s.
    pub time_s: Vec<f64>,
    /// θA and θB as their encoders show them, rad.
    pub theta_rad: [Vec<f64>; 2],
    /// The force of the hand on the tip as its sensor shows it, x and y, N.
    pub force_n: [Vec<f64>; 2],
    /// Commanded currents of A, E, B, C, A.
    pub currents_a: [Vec<f64>; 4],
}

/// The force of a hand that leads the tip to a point, N, at most what the thesis's controllers
/// request at the tip.
fn hand_n(layout: Layout, to_m: [f64; 2], tip_m: [f64; 2], velocity_m_s: [f64; 2]) -> [f64; 2] {
    let mut force = [0.0; 2];
    let pairs = to_m.iter().zip(tip_m).zip(velocity_m_s);
    for (own, ((to, tip), speed)) in force.iter_mut().zip(pairs) {
        *own = STIFFNESS_N_M * (to - tip) - DAMPING_NS_M * speed;
    }
    let [x, y] = force;
    let share = (greatest_desired_force_n(layout) / libm::hypot(x, y)).min(1.0);
    force.map(|f| share * f)
}

/// The rig of a model at rest with its tip at a point, m. Effects with an onset act from the start.
///
/// # Errors
/// The rig cannot be given the model's effects, or the tip cannot reach the point.
pub fn with_effects(model: &Model, layout: Layout, tip_m: [f64; 2]) -> Result<Rig, ModelError> {
    let begun = |effect: &JointEffect| JointEffect {
        onset_s: None,
        ..effect.clone()
    };
    let effects: Vec<JointEffect> = model.rig.iter().map(begun).collect();
    let parameters = model.parameters(&Parameters::of(layout));
    let pose = inverse::pose(&parameters.arms, tip_m)?;
    let theta_rad = [pose.theta_a_rad, pose.theta_b_rad];
    Rig::moving(parameters, theta_rad, [0.0; 2])?.with_effects(&effects)
}

/// Simulates a plan on the rig of a model, which starts at rest.
///
/// # Errors
/// Those of [`with_effects`], or the rig is driven out of its assembly.
pub fn play(model: &Model, layout: Layout, plan: &Plan) -> Result<Played, ModelError> {
    let start = plan.hand_m.first().copied().unwrap_or_default();
    let mut rig = with_effects(model, layout, start)?;
    let parts = parts_of(plan.step_s);
    let step_s = plan.step_s / parts;
    let mut played = Played::default();
    let next = plan.hand_m.iter().skip(1).chain(plan.hand_m.last());
    for (k, (from, to)) in plan.hand_m.iter().zip(next).enumerate() {
        let force = hand_n(layout, *from, rig.tip_m(), rig.tip_velocity_m_s());
        let currents = plan
            .currents_a
            .each_ref()
            .map(|current| current.get(k).copied().unwrap_or(0.0));
        let time_s = k as f64 * plan.step_s;
        played.record(time_s, rig.base_angles_rad(), force, currents);
        for part in 0..parts as usize {
            // The hand is constant within a part. Its midpoint gives the right mean.
            let share = (part as f64 + 0.5) / parts;
            let ([f_x, f_y], [t_x, t_y]) = (*from, *to);
            let at = [f_x + share * (t_x - f_x), f_y + share * (t_y - f_y)];
            rig.step_under(
                &|tip, speed| hand_n(layout, at, tip, speed),
                currents,
                step_s,
            )?;
        }
    }
    for effect in model.sensors.iter().rev() {
        shown(effect, &mut played, plan.step_s, 0);
    }
    Ok(played)
}

fn push<const N: usize>(signals: &mut [Vec<f64>; N], values: [f64; N]) {
    signals.iter_mut().zip(values).for_each(|(s, x)| s.push(x));
}

/// Applies a sensor's effect to angles and forces from sample `first` on.
pub fn shown(effect: &Effect, played: &mut Played, step_s: f64, first: usize) {
    let value = |k: usize| effect.value(k);
    let [a, b] = &mut played.theta_rad;
    let angle = match joint_at(effect.cause.at) {
        Some(Joint::A) => a,
        _ => b,
    };
    let angle = angle.iter_mut().skip(first);
    let [force_x, force_y] = &mut played.force_n;
    match form(effect.mechanism()) {
        Some(Form::Sensor(
            of @ (OfSensor::EncoderScale | OfSensor::EncoderOffset | OfSensor::Eccentric),
        )) => {
            angle.for_each(|x| *x = of.shown(*x, &effect.parameters));
        }
        Some(Form::Drive(Drive::Skew)) => {
            for force in [force_x, force_y] {
                let late = shifted(force, -value(0) / step_s);
                let pairs = force.iter_mut().zip(late).skip(first);
                pairs.for_each(|(f, l)| *f = l);
            }
        }
        Some(Form::Sensor(
            own @ (OfSensor::ForceGain | OfSensor::ForceBias | OfSensor::ForceRotation),
        )) => {
            for (x, y) in force_x.iter_mut().zip(force_y).skip(first) {
                let shown = force_shown(own, [value(0), value(1)], [*x, *y]);
                (*x, *y) = of_axis(effect.cause.at, shown, [*x, *y]);
            }
        }
        Some(
            Form::Drive(Drive::Lag | Drive::Gain | Drive::Limit | Drive::Rate)
            | Form::Joint(_)
            | Form::Sensor(OfSensor::Clock)
            | Form::Resistance(_)
            | Form::ShareOfBrake(_)
            | Form::Brake(_)
            | Form::Linkage(_),
        )
        | None => {}
    }
}

/// The force that a sensor shows.
fn force_shown(own: OfSensor, [a, b]: [f64; 2], [x, y]: [f64; 2]) -> (f64, f64) {
    match own {
        OfSensor::ForceGain => (x * (1.0 + a), y * (1.0 + a)),
        OfSensor::ForceBias => (x + a, y + b),
        OfSensor::ForceRotation => {
            let (sine, cosine) = libm::sincos(a);
            (cosine * x - sine * y, sine * x + cosine * y)
        }
        OfSensor::EncoderScale
        | OfSensor::EncoderOffset
        | OfSensor::Eccentric
        | OfSensor::Clock => (x, y),
    }
}

/// The resolution and noise of the sensors, as far as they are known.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sensors {
    /// An encoder's count, rad.
    pub count_rad: Option<f64>,
    /// Standard deviation of a force sample, N.
    pub force_noise_n: Option<f64>,
}

impl Played {
    /// Appends a sample.
    pub fn record(
        &mut self,
        time_s: f64,
        theta_rad: [f64; 2],
        force_n: [f64; 2],
        currents_a: [f64; 4],
    ) {
        self.time_s.push(time_s);
        push(&mut self.theta_rad, theta_rad);
        push(&mut self.force_n, force_n);
        push(&mut self.currents_a, currents_a);
    }

    /// The recording with the quantisation and the noise that a description states.
    pub fn sensed(mut self, rig: &FiveBar, seed: u64) -> Played {
        let mut random = Pcg64Mcg::seed_from_u64(seed);
        let maps = rig.channels.theta.iter().chain(&rig.channels.force);
        let signals = self.theta_rad.iter_mut().chain(&mut self.force_n);
        for (samples, map) in signals.zip(maps) {
            let to_si = Unit::parse(&map.unit).map_or(1.0, |unit| unit.to_si * map.scale.abs());
            for x in samples {
                *x += map
                    .noise
                    .map_or(0.0, |noise| noise * to_si * normal(&mut random));
                *x = map.quantum.map_or(*x, |quantum| {
                    (*x / (quantum * to_si)).round() * quantum * to_si
                });
            }
        }
        self
    }

    /// As a recording with these sensors stated. Missing brakes have no channel.
    pub fn recording(self, layout: Layout, sensors: Sensors) -> FiveBarRecording {
        let signal = |dimension, samples, quantum, noise| Signal {
            channel: String::new(),
            dimension,
            samples,
            quantum,
            noise,
            limit: None,
        };
        let angle = |samples| signal(Dimension::ANGLE, samples, sensors.count_rad, None);
        let force = |samples| signal(Dimension::FORCE, samples, None, sensors.force_noise_n);
        let [a, e, b, c] = self.currents_a;
        let current = |joint, samples| {
            let braked = layout.brakes().contains(&joint);
            braked.then(|| signal(Dimension::CURRENT, samples, None, None))
        };
        FiveBarRecording {
            time_s: self.time_s,
            theta: self.theta_rad.map(angle),
            force: self.force_n.map(force),
            currents: [
                current(Joint::A, a),
                current(Joint::E, e),
                current(Joint::B, b),
                current(Joint::C, c),
            ],
        }
    }
}
