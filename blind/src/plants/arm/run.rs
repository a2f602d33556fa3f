//! This file says what efforts the arm takes along its motion, with what is hidden, and how visible each hidden effect is.

use super::body::Body;
use super::dynamics::{State, efforts};
use super::setup::Setup;
use crate::effect::{At, Effect};
use crate::element::{Element, Instant};
use crate::form::Form;
use crate::size::{BLOCK_S, Size, Sizes, remainder};

/// The efforts, a list of samples for each joint.
pub struct Run {
    pub efforts: Vec<Vec<f64>>,
}

/// The efforts of each joint along the recording.
pub fn run(setup: &Setup, hidden: &[Effect]) -> Run {
    let body = changed(&setup.body, hidden);
    let mut efforts = vec![Vec::with_capacity(setup.samples()); body.joints.len()];
    for k in 0..setup.samples() {
        let time_s = k as f64 / setup.rate_hz;
        let now = shown(&body, &setup.states(time_s), hidden);
        for (signal, effort) in efforts.iter_mut().zip(now) {
            signal.push(effort);
        }
        // An effort that is recorded late is that of a time before.
        for late in hidden.iter().filter(|own| own.form == Form::Skew) {
            let At::Arm(joint) = late.at else { continue };
            let then = shown(&body, &setup.states(time_s - late.first()), hidden);
            let last = efforts.get_mut(joint).and_then(|own| own.last_mut());
            if let (Some(last), Some(then)) = (last, then.get(joint)) {
                *last = *then;
            }
        }
    }
    Run { efforts }
}

/// The arm with its hidden masses.
fn changed(body: &Body, hidden: &[Effect]) -> Body {
    let mut body = body.clone();
    for effect in hidden {
        let At::Arm(joint) = effect.at else { continue };
        let Some(member) = body.joints.get_mut(joint) else {
            continue;
        };
        match effect.form {
            Form::LinkMass => member.link = member.link.heavier(effect.first()),
            Form::Payload => member.link = member.link.with_ball(effect.first(), body.flange),
            _ => {}
        }
    }
    body
}

/// What the sensors of effort show but for their noise.
fn shown(body: &Body, states: &[State], hidden: &[Effect]) -> Vec<f64> {
    let rigid = efforts(body, states).into_iter();
    let each = rigid.zip(&body.joints).zip(states).enumerate();
    each.map(
        |(joint, ((rigid, member), [position, speed, acceleration]))| {
            let sense = match *speed {
                0.0 => 0.0,
                _ => speed.signum(),
            };
            let at = Instant {
                time_s: 0.0,
                position: *position,
                velocity: *speed,
                direction: sense,
                load: rigid,
                brake: 0.0,
            };
            let here = || hidden.iter().filter(|own| own.at == At::Arm(joint));
            let more = here().map(|own| match own.form {
                Form::Rotor => own.first() * acceleration,
                _ => {
                    let law = Element::new(*own);
                    law.bound(&at) * sense + law.force(&at, 0.0, 0.0)
                }
            });
            let whole = rigid + member.dry * sense + member.viscous * speed + more.sum::<f64>();
            // The true effort is so much more than what the current says.
            let gains = here().filter(|own| own.form == Form::Gain);
            gains.fold(whole, |effort, own| effort / (1.0 + own.first()))
        },
    )
    .collect()
}

/// How visible the effects are: each alone in the arm, in averages of 80 ms over what the noise of the sensors gives there.
pub fn sizes(setup: &Setup, hidden: &[Effect], all: &Run) -> Sizes {
    let bare = run(setup, &[]);
    let size = |own: &Run, plain: bool| {
        let each = (0..setup.body.joints.len()).map(|k| lacking(setup, k, own, &bare, plain));
        let (sum, most) = each.fold((0.0f64, 0.0f64), |(sum, most), own| {
            (sum + own, most.max(own))
        });
        (sum, most)
    };
    let each = hidden.iter().map(|effect| {
        let own = run(setup, &[*effect]);
        let ((sum, most), (_, distinct)) = (size(&own, false), size(&own, true));
        Size {
            size: most.sqrt(),
            distinctness: distinct.sqrt(),
            strength: (sum * blocks(setup)).sqrt(),
            onset_strength: None,
        }
    });
    let (total, _) = size(all, false);
    Sizes {
        sizes: each.collect(),
        block_noise: noise(setup, 0),
        sliding: 1.0,
        left: 0.0,
        ratio: Some((1.0 + total / setup.body.joints.len() as f64).sqrt()),
    }
}

fn blocks(setup: &Setup) -> f64 {
    (setup.duration_s / BLOCK_S).floor()
}

/// Mean square of what the description lacks at a joint, in the noise of an average; beside what is plain where that is asked.
fn lacking(setup: &Setup, joint: usize, own: &Run, bare: &Run, plain: bool) -> f64 {
    let length = (BLOCK_S * setup.rate_hz).round().max(1.0) as usize;
    let none = Vec::new();
    let of = |run: &Run| -> Vec<f64> {
        let signal = run.efforts.get(joint).unwrap_or(&none);
        averages(signal, length)
    };
    let rest: Vec<f64> = of(own).iter().zip(of(bare)).map(|(a, b)| a - b).collect();
    let speeds: Vec<f64> = (0..setup.samples())
        .map(|k| {
            let states = setup.states(k as f64 / setup.rate_hz);
            states.get(joint).map_or(0.0, |[_, speed, _]| *speed)
        })
        .collect();
    let senses: Vec<f64> = speeds.iter().map(|v| v.signum()).collect();
    let columns = [
        averages(&senses, length),
        averages(&speeds, length),
        vec![1.0; rest.len()],
    ];
    let columns = columns.iter().filter(|_| plain).map(Vec::as_slice);
    let noise = noise(setup, joint);
    remainder(&rest, &columns.collect::<Vec<_>>()) / rest.len().max(1) as f64 / (noise * noise)
}

fn averages(signal: &[f64], length: usize) -> Vec<f64> {
    let each = signal.chunks_exact(length);
    each.map(|own| own.iter().sum::<f64>() / length as f64)
        .collect()
}

/// Standard deviation of the noise of a joint's effort in an average over 80 ms: of its sensor, and of its position's second derivative, a parabola's over
/// that time.
fn noise(setup: &Setup, joint: usize) -> f64 {
    let samples = (BLOCK_S * setup.rate_hz).max(1.0);
    let [count, effort] = setup.sensors.get(joint).copied().unwrap_or([0.0; 2]);
    let curved = (720.0 / samples).sqrt() * count / 12_f64.sqrt() / (BLOCK_S * BLOCK_S);
    (effort / samples.sqrt()).hypot(setup.inertia(joint) * curved)
}

impl Setup {
    /// What a joint alone moves in the middle of its way, kg·m² or kg.
    pub fn inertia(&self, joint: usize) -> f64 {
        let mut states = self.states(0.0);
        states.iter_mut().for_each(|state| {
            let [q, ..] = *state;
            *state = [q, 0.0, 0.0];
        });
        let held = efforts(&self.body, &states);
        if let Some([_, _, acceleration]) = states.get_mut(joint) {
            *acceleration = 1.0;
        }
        let moved = efforts(&self.body, &states);
        let of = |all: &[f64]| all.get(joint).copied().unwrap_or(0.0);
        of(&moved) - of(&held)
    }
}
