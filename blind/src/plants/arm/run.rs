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

/// Steps between two samples over which a law's memory moves.
const STEPS: usize = 5;

/// The efforts of each joint along the recording.
pub fn run(setup: &Setup, hidden: &[Effect]) -> Run {
    let mut efforts = late_by(setup, hidden, 0.0);
    // An effort that is recorded late is that of a time before.
    for late in hidden.iter().filter(|own| own.form == Form::Skew) {
        let At::Arm(joint) = late.at else { continue };
        let then = late_by(setup, hidden, late.first()).into_iter().nth(joint);
        if let (Some(own), Some(then)) = (efforts.get_mut(joint), then) {
            *own = then;
        }
    }
    Run { efforts }
}

/// The efforts of a time before.
fn late_by(setup: &Setup, hidden: &[Effect], delay_s: f64) -> Vec<Vec<f64>> {
    let body = changed(&setup.body, hidden);
    let step_s = 1.0 / setup.rate_hz / STEPS as f64;
    let mut laws: Vec<Element> = hidden.iter().map(|own| Element::new(*own)).collect();
    let mut before = setup.states(-delay_s);
    let mut efforts = vec![Vec::with_capacity(setup.samples()); body.joints.len()];
    for k in 0..setup.samples() * STEPS {
        let now = setup.states(k as f64 * step_s - delay_s);
        for law in &mut laws {
            let At::Arm(joint) = law.effect.at else {
                continue;
            };
            if let (Some(now), Some([then, ..])) = (now.get(joint), before.get(joint)) {
                law.advance(&instant(now, 0.0), now[0] - then, step_s);
            }
        }
        if k % STEPS == 0 {
            let shown = shown(&body, &now, &laws);
            let signals = efforts.iter_mut().zip(shown);
            signals.for_each(|(signal, effort)| signal.push(effort));
        }
        before = now;
    }
    efforts
}

/// Where a joint is under an effort.
fn instant([position, speed, _]: &State, load: f64) -> Instant {
    Instant {
        time_s: 0.0,
        position: *position,
        velocity: *speed,
        direction: match *speed {
            0.0 => 0.0,
            _ => speed.signum(),
        },
        load,
        brake: 0.0,
    }
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
fn shown(body: &Body, states: &[State], laws: &[Element]) -> Vec<f64> {
    let rigid = efforts(body, states).into_iter();
    let each = rigid.zip(&body.joints).zip(states).enumerate();
    each.map(|(joint, ((rigid, member), state))| {
        let at = instant(state, rigid);
        let [_, speed, acceleration] = *state;
        let here = || laws.iter().filter(|own| own.effect.at == At::Arm(joint));
        let more = here().map(|own| match own.effect.form {
            Form::Rotor => own.effect.first() * acceleration,
            _ => own.bound(&at) * at.direction + own.force(&at, 0.0, 0.0),
        });
        let described = member.dry * at.direction + member.viscous * speed;
        let whole = rigid + described + more.sum::<f64>();
        // The true effort is so much more than what the current says.
        let gains = here().filter(|own| own.effect.form == Form::Gain);
        gains.fold(whole, |effort, own| effort / (1.0 + own.effect.first()))
    })
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
