//! This file draws the laboratory of a driven joint: its machine, its loop, its sensors, and what its description states.

use crate::draw::{Draw, rounded};
use crate::effect::Effect;
use crate::form::Form;
use crate::path::Path;
use crate::typical::Typical;
use std::f64::consts::TAU;

/// One laboratory; efforts are N·m at the joint.
#[derive(Clone, Debug)]
pub struct Setup {
    pub rate_hz: f64,
    pub duration_s: f64,
    pub travel: f64,
    pub speed: f64,
    pub effort: f64,
    /// What the description states of them; the truth where nothing is hidden.
    pub inertia: f64,
    pub dry: f64,
    pub viscous: f64,
    /// N·m in a unit of the command.
    pub gain: f64,
    pub counts: f64,
    /// Where between two counts the joint starts.
    pub zero: f64,
    /// Standard deviation of the recorded command, in its unit.
    pub command_noise: f64,
    pub servo: Servo,
    pub path: Path,
    pub stated: Stated,
}

/// The controller, which sees the counts once a sample and holds its command.
#[derive(Clone, Copy, Debug)]
pub struct Servo {
    /// Whether the path is tracked; otherwise it shapes an open-loop command about a soft centring.
    pub tracks: bool,
    /// Units of the command a radian, and a radian a second.
    pub proportional: f64,
    pub derivative: f64,
    pub feedforward: f64,
    pub limit: f64,
}

/// Whether the description says that it knows a number; `None` where it has no such number at all.
#[derive(Clone, Copy, Debug)]
pub struct Stated {
    pub inertia: bool,
    pub dry: Option<bool>,
    pub viscous: Option<bool>,
}

impl Stated {
    /// Whether every number of the nominal model is left open.
    pub fn is_free(&self) -> bool {
        !self.inertia && self.dry != Some(true) && self.viscous != Some(true)
    }
}

impl Setup {
    /// A laboratory.
    pub fn draw(draw: &mut Draw) -> Setup {
        let rate_hz = draw.pick(&[200.0, 250.0, 500.0, 1000.0, 1000.0, 2000.0]);
        let duration_s = draw.uniform(14.0, 22.0).floor();
        let travel = draw.uniform(0.4, 1.8);
        let frequency_hz = draw.uniform(0.5, 1.1);
        let omega = TAU * frequency_hz;
        let inertia = rounded(draw.log_uniform(0.002, 0.2));
        let effort = inertia * travel * omega * omega;
        let speed = 0.5 * travel * omega;
        // A drive in volts or amperes, or one whose command is the torque itself.
        let gain = match draw.chance(0.5) {
            true => 1.0,
            false => rounded(effort / draw.uniform(0.8, 3.0)),
        };
        let share = |draw: &mut Draw| draw.log_uniform(0.06, 0.35);
        let (dry, viscous) = (share(draw), share(draw));
        let stated = Stated {
            inertia: draw.chance(0.6),
            dry: draw.chance(0.9).then(|| draw.chance(0.5)),
            viscous: draw.chance(0.9).then(|| draw.chance(0.5)),
        };
        let tracks = draw.chance(0.7);
        let servo = servo(draw, tracks, rate_hz, frequency_hz, inertia / gain);
        let has = |stated: Option<bool>, x: f64| if stated.is_some() { rounded(x) } else { 0.0 };
        Setup {
            rate_hz,
            duration_s,
            travel,
            speed,
            effort,
            inertia,
            dry: has(stated.dry, dry * effort),
            viscous: has(stated.viscous, viscous * effort / speed),
            gain,
            counts: draw.pick(&[
                4096.0, 8192.0, 16384.0, 20000.0, 40000.0, 65536.0, 100_000.0,
            ]),
            zero: draw.uniform(0.0, 1.0),
            command_noise: rounded(effort / gain * draw.log_uniform(0.001, 0.01)),
            servo,
            path: Path::draw(draw, travel, frequency_hz, duration_s, true),
            stated,
        }
    }

    /// What is typical of the joint.
    pub fn typical(&self) -> Typical {
        Typical {
            travel: self.travel,
            speed: self.speed,
            effort: self.effort,
            duration_s: self.duration_s,
            dry: self.dry,
            viscous: self.viscous,
        }
    }

    /// The friction that the description knows of.
    pub fn friction(&self) -> Vec<Effect> {
        let laws = [(Form::Viscous, self.viscous), (Form::Coulomb, self.dry)];
        let there = laws.into_iter().filter(|(_, level)| *level > 0.0);
        there.map(|(form, level)| form.of([level])).collect()
    }

    /// An angle as the encoder has it, rad.
    pub fn counted(&self, angle: f64) -> f64 {
        (angle / self.quantum() + self.zero).floor() * self.quantum()
    }

    /// A count, rad.
    pub fn quantum(&self) -> f64 {
        TAU / self.counts
    }

    pub fn command_unit(&self) -> &'static str {
        match self.gain == 1.0 {
            true => "N·m",
            false => "V",
        }
    }
}

/// A servo no faster than its rate allows.
fn servo(draw: &mut Draw, tracks: bool, rate_hz: f64, frequency_hz: f64, mass: f64) -> Servo {
    let (bandwidth_hz, damping) = match tracks {
        true => (
            draw.uniform(2.5, 6.0).min(rate_hz / 60.0),
            draw.uniform(0.7, 1.1),
        ),
        false => (
            frequency_hz * draw.uniform(0.9, 1.3),
            draw.uniform(0.3, 0.6),
        ),
    };
    let natural = TAU * bandwidth_hz;
    let omega = TAU * frequency_hz;
    Servo {
        tracks,
        proportional: mass * natural * natural,
        derivative: 2.0 * damping * natural * mass,
        feedforward: match tracks {
            true => 0.0,
            false => draw.uniform(0.8, 1.4) * mass * omega * omega,
        },
        limit: 40.0 * mass * omega * omega,
    }
}
