//! This file draws the lab: the plant's size, its sensors and how it is moved.

use crate::draw::{Draw, rounded};
use crate::effect::Effect;
use crate::form::Form;
use crate::forms::Forms;
use crate::path::Path;
use crate::plant::Plant;
use rigproof_spec::effect::Motion;
use rigproof_spec::joint::Joint;
use std::f64::consts::TAU;

/// One lab. Travel is m or rad, effort N or N·m.
#[derive(Clone, Debug)]
pub struct Setup {
    pub motion: Motion,
    pub rate_hz: f64,
    pub duration_s: f64,
    /// Travel, speed and effort that are typical of the recording; every effect is drawn as a share of them.
    pub scale: Scale,
    /// Encoder step.
    pub quantum: f64,
    /// Standard deviation of the command (V) or of the metered effort (N or N·m).
    pub noise: f64,
    pub path: Path,
    pub kind: Kind,
    /// The dry friction and the damping that the plant has when the nominal model knows of them.
    pub dry: Effect,
    pub viscous: Effect,
    pub bias: Effect,
    /// The forms of what is hidden.
    pub forms: Forms,
    /// Whether the description says that it knows its numbers; it does so in other forms only.
    pub known: bool,
}

/// Typical magnitudes.
#[derive(Clone, Copy, Debug)]
pub struct Scale {
    pub travel: f64,
    pub speed: f64,
    pub effort: f64,
}

/// What only one plant has.
#[derive(Clone, Debug)]
pub enum Kind {
    Axis(Drive),
    /// The brake on the bench, with its current; `None` for a damper.
    Bench(Option<(Joint, Currents)>),
}

/// The axis's inertia, amplifier and servo.
#[derive(Clone, Copy, Debug)]
pub struct Drive {
    /// kg or kg·m²/rad.
    pub inertia: f64,
    /// N/V or N·m/V, as the rig description has it.
    pub gain: f64,
    /// Servo gains, V/travel and V·s/travel.
    pub proportional: f64,
    pub derivative: f64,
    /// Open-loop command at full path, V/travel.
    pub feedforward: f64,
    /// Whether the path is tracked by the servo or only shapes the open-loop command.
    pub tracks: bool,
    /// Command limit, V.
    pub limit_v: f64,
}

/// The current of a brake: levels that change at fixed times.
#[derive(Clone, Debug)]
pub struct Currents {
    /// Seconds each level lasts.
    dwell_s: f64,
    /// A.
    levels_a: Vec<f64>,
}

impl Currents {
    /// Current at a time, A.
    pub fn at(&self, time_s: f64) -> f64 {
        let index = (time_s / self.dwell_s) as usize % self.levels_a.len().max(1);
        self.levels_a.get(index).copied().unwrap_or(0.0)
    }
}

impl Setup {
    /// The lab of an axis or of a bench.
    pub fn draw(plant: Plant, draw: &mut Draw) -> Setup {
        let rate_hz = draw.pick(&[500.0, 1000.0]);
        let duration_s = draw.uniform(16.0, 30.0).floor();
        match plant {
            Plant::Axis => axis(draw, rate_hz, duration_s),
            _ => bench(draw, rate_hz, duration_s),
        }
    }

    /// The brake on the bench, if there is one.
    pub fn brake(&self) -> Option<(Joint, &Currents)> {
        match &self.kind {
            Kind::Bench(Some((joint, currents))) => Some((*joint, currents)),
            _ => None,
        }
    }
}

fn axis(draw: &mut Draw, rate_hz: f64, duration_s: f64) -> Setup {
    let rotary = draw.chance(0.6);
    let (motion, travel, inertia, quantum) = if rotary {
        let counts = draw.log_uniform(2e4, 1e6).round();
        (
            Motion::Rotary,
            draw.uniform(0.4, 1.5),
            draw.log_uniform(0.002, 0.05),
            TAU / counts,
        )
    } else {
        (
            Motion::Linear,
            draw.uniform(0.02, 0.1),
            draw.log_uniform(0.3, 6.0),
            draw.log_uniform(1e-7, 5e-6),
        )
    };
    let inertia = rounded(inertia);
    let frequency_hz = draw.uniform(0.6, 1.4);
    let omega = TAU * frequency_hz;
    let effort = inertia * travel * omega * omega;
    let gain = rounded(effort / draw.uniform(0.8, 2.0));
    let tracks = draw.chance(0.65);
    let (bandwidth_hz, damping) = if tracks {
        (draw.uniform(4.0, 9.0), draw.uniform(0.7, 1.0))
    } else {
        (
            frequency_hz * draw.uniform(0.9, 1.3),
            draw.uniform(0.3, 0.6),
        )
    };
    let natural = TAU * bandwidth_hz;
    let drive = Drive {
        inertia,
        gain,
        proportional: inertia * natural * natural / gain,
        derivative: 2.0 * damping * natural * inertia / gain,
        feedforward: if tracks {
            0.0
        } else {
            draw.uniform(0.8, 1.4) * effort / gain / travel
        },
        tracks,
        limit_v: 10.0,
    };
    let scale = Scale {
        travel,
        speed: 0.5 * travel * omega,
        effort,
    };
    Setup {
        motion,
        rate_hz,
        duration_s,
        scale,
        quantum: rounded(quantum),
        noise: rounded(draw.log_uniform(0.0005, 0.004)),
        path: Path::draw(draw, travel, frequency_hz, duration_s, true),
        kind: Kind::Axis(drive),
        dry: dry(draw, scale),
        viscous: viscous(draw, scale),
        bias: bias(draw, scale),
        forms: Forms::Usual,
        known: false,
    }
}

fn bench(draw: &mut Draw, rate_hz: f64, duration_s: f64) -> Setup {
    let brake = draw.chance(0.5);
    let rotary = brake || draw.chance(0.6);
    let (motion, travel, quantum, effort) = if rotary {
        let counts = draw.log_uniform(2e4, 1e6).round();
        let effort = if brake {
            draw.uniform(1.5, 3.0)
        } else {
            draw.log_uniform(0.1, 3.0)
        };
        (Motion::Rotary, draw.uniform(0.4, 1.2), TAU / counts, effort)
    } else {
        (
            Motion::Linear,
            draw.uniform(0.02, 0.1),
            draw.log_uniform(1e-7, 5e-6),
            draw.log_uniform(1.0, 30.0),
        )
    };
    let frequency_hz = draw.uniform(0.3, 0.8);
    let scale = Scale {
        travel,
        speed: 0.5 * travel * TAU * frequency_hz,
        effort,
    };
    let kind = Kind::Bench(brake.then(|| (draw.pick(&Joint::ALL), currents(draw, duration_s))));
    Setup {
        motion,
        rate_hz,
        duration_s,
        scale,
        quantum: rounded(quantum),
        noise: rounded(effort * draw.log_uniform(0.004, 0.02)),
        path: Path::draw(draw, travel, frequency_hz, duration_s, false),
        kind,
        dry: dry(draw, scale),
        viscous: viscous(draw, scale),
        bias: bias(draw, scale),
        forms: Forms::Usual,
        known: false,
    }
}

/// Steps between random levels in the first half, a staircase up and down in the second.
fn currents(draw: &mut Draw, duration_s: f64) -> Currents {
    let dwell_s = draw.uniform(0.5, 0.9);
    let count = (duration_s / dwell_s).ceil() as usize;
    let stair = [0.0, 0.2, 0.4, 0.6, 0.8, 1.0, 0.8, 0.6, 0.4, 0.2];
    let mut levels_a: Vec<f64> = (0..count / 2)
        .map(|_| rounded(draw.uniform(0.0, 1.0)))
        .collect();
    levels_a.extend(stair.into_iter().cycle().take(count - count / 2));
    Currents { dwell_s, levels_a }
}

fn dry(draw: &mut Draw, scale: Scale) -> Effect {
    Form::Coulomb.of([scale.effort * draw.uniform(0.1, 0.3)])
}

fn viscous(draw: &mut Draw, scale: Scale) -> Effect {
    Form::Viscous.of([scale.effort / scale.speed * draw.uniform(0.1, 0.3)])
}

fn bias(draw: &mut Draw, scale: Scale) -> Effect {
    Form::Bias.of([scale.effort * draw.sign() * draw.uniform(0.05, 0.15)])
}
