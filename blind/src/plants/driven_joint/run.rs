//! This file runs a driven joint through a recording: stick and slip on a fine grid, a held command, and what the encoder shows.

use super::chain::Chain;
use super::setup::Setup;
use crate::effect::Effect;
use crate::form::{Form, Stage};
use crate::plants::one_joint::{Delay, Joint};
use std::f64::consts::TAU;

/// Fine steps a second, at least.
pub const FINE_HZ: f64 = 20_000.0;
/// Samples over which the servo's speed is averaged.
const SPEED_SAMPLES: f64 = 3.0;
/// Damping ratio of a spring between two masses.
const SPRING_DAMPING: f64 = 0.04;

/// The signals of a recording, one value a sample: as they are shown before counts and noise, and the true sense of motion.
#[derive(Clone, Debug, Default)]
pub struct Run {
    pub position: Vec<f64>,
    pub command: Vec<f64>,
    /// Mean of the sense of motion from this sample to the next, weighted by a rising and by a falling ramp; `None` where the joint rests.
    pub sense: Vec<Option<[f64; 2]>>,
    /// The true angle.
    pub angle: Vec<f64>,
}

/// Runs the joint; `None` where the servo loses it.
pub fn run(setup: &Setup, hidden: &[Effect], fine_hz: f64) -> Option<Run> {
    let clock = Clock::new(setup, hidden);
    let fine = (fine_hz / setup.rate_hz).ceil();
    let step_s = clock.sample_s / fine;
    let amount = |form: Form| {
        let effect = hidden.iter().find(|effect| effect.form == form);
        effect.map_or(0.0, Effect::first)
    };
    let inertia = setup.inertia * (1.0 + amount(Form::Inertia));
    let mut tail = Tail::of(hidden, inertia);
    let share = tail.as_ref().map_or(0.0, |tail| tail.inertia / inertia);
    let mut joint = Joint::new((1.0 - share) * inertia, &setup.friction(), hidden);
    let mut chain = Chain::new(setup.gain, hidden);
    let mut sensor = Sensor::new(hidden, step_s);
    let mut servo = ServoState::default();
    let mut run = Run::default();
    for k in 0..(setup.duration_s * setup.rate_hz) as usize {
        let sample_s = k as f64 * clock.sample_s;
        let shown = sensor.shown(clock.jitter(k));
        let seen = setup.counted(shown);
        let command = servo.command(setup, sample_s, seen);
        if joint.position().abs() > 20.0 * setup.travel || !command.is_finite() {
            return None;
        }
        run.position.push(shown);
        run.command.push(command);
        run.angle.push(joint.position());
        let mut sense = Some([0.0; 2]);
        for step in 0..fine as usize {
            let time_s = sample_s + step as f64 * step_s;
            let effort = chain.step(time_s, command, step_s);
            let coupling = tail.as_mut().map_or(0.0, |tail| tail.step(&joint, step_s));
            let before = joint.position();
            joint.step(time_s, effort - coupling, step_s);
            sensor.push(joint.position());
            let travel = joint.position() - before;
            let ramp = (step as f64 + 0.5) / fine;
            sense = sense.filter(|_| travel != 0.0).map(|[rising, falling]| {
                let part = travel.signum() / fine;
                [rising + ramp * part, falling + (1.0 - ramp) * part]
            });
        }
        run.sense.push(sense);
    }
    if let Some(effect) = hidden.iter().find(|effect| effect.form == Form::Repeated) {
        run.repeat(effect.values, setup.rate_hz);
    }
    Some(run)
}

impl Run {
    /// Bursts in which both channels repeat their last value: so many a second on average, of so many samples.
    fn repeat(&mut self, [a_second, samples, ..]: [f64; 4], rate_hz: f64) {
        let mut start = 0.0;
        for burst in 0_u32.. {
            start += rate_hz / a_second * (0.3 + 1.4 * (f64::from(burst) * GOLDEN).fract());
            for channel in [&mut self.position, &mut self.command] {
                let Some(last) = channel.get(start as usize).copied() else {
                    return;
                };
                let repeated = channel
                    .iter_mut()
                    .skip(start as usize)
                    .take(samples as usize);
                repeated.for_each(|x| *x = last);
            }
        }
    }
}

/// Evenly scattered numbers without a draw.
const GOLDEN: f64 = 0.618_033_988_749_895;

/// The recorder's clock against the true one.
struct Clock {
    sample_s: f64,
    jitter_s: f64,
}

impl Clock {
    fn new(setup: &Setup, hidden: &[Effect]) -> Clock {
        let effect = hidden.iter().find(|effect| effect.form == Form::Clock);
        let [skew, jitter_s, ..] = effect.map_or([0.0; 4], |effect| effect.values);
        Clock {
            sample_s: (1.0 + skew) / setup.rate_hz,
            jitter_s,
        }
    }

    /// How late a sample is taken, s: low-discrepancy numbers, so that the clock draws nothing.
    fn jitter(&self, sample: usize) -> f64 {
        2.0 * self.jitter_s * (sample as f64 * GOLDEN * 7.0).fract()
    }
}

/// The counts and their filtered rate.
#[derive(Default)]
struct ServoState {
    before: Option<f64>,
    rate: f64,
}

impl ServoState {
    /// The command that is held to the next sample.
    fn command(&mut self, setup: &Setup, time_s: f64, seen: f64) -> f64 {
        let before = self.before.replace(seen).unwrap_or(seen);
        self.rate += ((seen - before) * setup.rate_hz - self.rate) / SPEED_SAMPLES;
        let servo = &setup.servo;
        let (reference, reference_rate) = setup.path.at(time_s);
        let (target, target_rate) = match servo.tracks {
            true => (reference, reference_rate),
            false => (0.0, 0.0),
        };
        let command = servo.feedforward * reference
            + servo.proportional * (target - seen)
            + servo.derivative * (target_rate - self.rate);
        command.clamp(-servo.limit, servo.limit)
    }
}

/// A part of the inertia behind a spring, with play or without.
struct Tail {
    inertia: f64,
    stiffness: f64,
    damping: f64,
    half_gap: f64,
    position: f64,
    velocity: f64,
}

impl Tail {
    fn of(hidden: &[Effect], inertia: f64) -> Option<Tail> {
        let found = |effect: &&Effect| matches!(effect.form, Form::TwoMass | Form::ImpactGap);
        let [share, frequency_hz, gap, _] = hidden.iter().find(found)?.values;
        let omega = TAU * frequency_hz;
        let own = share * inertia;
        Some(Tail {
            inertia: own,
            stiffness: own * omega * omega,
            damping: 2.0 * SPRING_DAMPING * own * omega,
            half_gap: 0.5 * gap,
            position: 0.0,
            velocity: 0.0,
        })
    }

    /// Moves the part; returns what it takes from the joint, N·m. A gap's end pushes and never pulls.
    fn step(&mut self, joint: &Joint, step_s: f64) -> f64 {
        let twist = joint.position() - self.position;
        let past = (twist.abs() - self.half_gap).max(0.0) * twist.signum();
        let rate = joint.velocity() - self.velocity;
        let torque = match (past != 0.0, self.half_gap > 0.0) {
            (false, true) => 0.0,
            (true, true) => {
                let push = self.stiffness * past + self.damping * rate;
                if push * past > 0.0 { push } else { 0.0 }
            }
            _ => self.stiffness * twist + self.damping * rate,
        };
        self.velocity += step_s * torque / self.inertia;
        self.position += step_s * self.velocity;
        torque
    }
}

/// The encoder before it counts.
struct Sensor<'a> {
    hidden: Vec<&'a Effect>,
    late: Delay,
    rate: f64,
    before: f64,
    step_s: f64,
}

impl<'a> Sensor<'a> {
    fn new(hidden: &'a [Effect], step_s: f64) -> Sensor<'a> {
        let skew = hidden.iter().find(|effect| effect.form == Form::Skew);
        let delay_s = skew.map_or(0.0, Effect::first);
        Sensor {
            hidden: hidden
                .iter()
                .filter(|effect| effect.stage() == Stage::Sensor)
                .collect(),
            late: Delay::new(delay_s, step_s),
            rate: 0.0,
            before: 0.0,
            step_s,
        }
    }

    /// Takes the angle at the end of a fine step.
    fn push(&mut self, angle: f64) {
        self.late.push(angle);
        self.rate = (angle - self.before) / self.step_s;
        self.before = angle;
    }

    /// What the encoder shows at a sample that is taken so late, s.
    fn shown(&self, late_s: f64) -> f64 {
        let taken = self.late.value() + late_s * self.rate;
        self.hidden.iter().fold(taken, |angle, effect| {
            let [a, b, ..] = effect.values;
            match effect.form {
                Form::EncoderScale => (1.0 + a) * angle,
                Form::EncoderOffset => angle + a,
                Form::Eccentric => angle + a * (libm::sin(angle + b) - libm::sin(b)),
                Form::Interpolation => angle + a * libm::sin(TAU * angle / b),
                _ => angle,
            }
        })
    }
}
