//! This file draws what a five-bar hides in other forms: at one joint, at every joint of a kind, as a share of the brake's torque, in the sensors' axes.

use super::setup::Setup;
use crate::draw::Draw;
use crate::effect::{At, Effect};
use crate::form::{Form, Stage};
use crate::stratum::Stratum;
use crate::typical::{Typical, in_brake, share};
use rigproof_spec::joint::Joint;
use rigproof_spec::units::RAD_PER_DEG;
use std::f64::consts::TAU;

/// At a joint, N·m: a mechanism is drawn first, then one of its forms.
const JOINT: &[&[Form]] = &[
    &[Form::Coulomb],
    &[Form::Viscous],
    &[Form::Stribeck, Form::Rational, Form::Travelled],
    &[
        Form::DahlPower,
        Form::Bristle,
        Form::ElastoPlastic,
        Form::BoucWen,
    ],
    &[Form::Root, Form::Square, Form::Power, Form::Tanh],
    &[Form::LoadArm, Form::LoadSquare],
    &[Form::TwoOrders, Form::Toothed, Form::Uneven],
    &[Form::Anchored, Form::Hardening],
    &[Form::OvershootLinear],
];

/// As a share of the torque of the brake at the joint.
const SHARE: &[&[Form]] = &[
    &[Form::Stribeck, Form::Rational],
    &[Form::MaxwellSlip],
    &[Form::Asymmetric],
    &[Form::TwoOrders, Form::Toothed],
];

/// In the brakes.
const BRAKE: &[&[Form]] = &[
    &[Form::LagSecond],
    &[Form::Gain],
    &[Form::SoftSaturation, Form::Saturation],
    &[Form::Plays, Form::BoucWenCurrent],
    &[Form::YieldFade],
    &[Form::YieldOvershoot, Form::YieldOvershootLinear],
    &[Form::TimeConstants],
    &[Form::OffState],
];

/// Of the whole and of its sensors.
const WHOLE: &[&[Form]] = &[
    &[Form::Payload],
    &[Form::Gravity],
    &[Form::PlaneSpring],
    &[Form::LinkLength],
    &[Form::Drift, Form::Creep],
    &[Form::Skew],
    &[Form::Eccentric],
    &[Form::ForceGain],
    &[Form::Crosstalk, Form::ForceRotation],
];

/// Physics outside the library.
const FOREIGN: &[Form] = &[Form::TwoRipples, Form::Tether];

/// Draws the hidden effects of a stratum. At most one of them is known only by what the equations lack.
pub fn draw(setup: &Setup, stratum: Stratum, draw: &mut Draw) -> Vec<Effect> {
    let joint = draw.pick(setup.layout.brakes());
    let count = match stratum {
        Stratum::Single | Stratum::LateOnset => 1,
        Stratum::Two => 2,
        Stratum::Three => 3,
        Stratum::NotInLibrary => {
            return vec![TYPICAL.force(draw.pick(FOREIGN), draw).joint(joint)];
        }
        _ => 0,
    };
    let mut hidden: Vec<Effect> = Vec::new();
    while hidden.len() < count {
        let joint = draw.pick(setup.layout.brakes());
        let place = match draw.chance(0.5) {
            true => At::Joint(joint),
            false => At::Every,
        };
        let late = stratum == Stratum::LateOnset;
        let drawn = match draw.below(if late { 2 } else { 4 }) {
            0 => pick(JOINT, draw, at_joint).at(place),
            1 => pick(SHARE, draw, share).at(place),
            2 => pick(BRAKE, draw, of_brake).at(place),
            _ => pick(WHOLE, draw, of_whole),
        };
        let same = |other: &Effect| {
            let both = |is: fn(&Effect) -> bool| is(other) && is(&drawn);
            other.name() == drawn.name()
                || both(Effect::is_residual)
                || both(|effect| effect.stage() == Stage::Drive)
        };
        if !hidden.iter().any(same) {
            hidden.push(drawn);
        }
    }
    if stratum == Stratum::LateOnset {
        let onset_s = setup.duration_s * draw.uniform(1.0 / 3.0, 2.0 / 3.0);
        hidden
            .iter_mut()
            .for_each(|effect| effect.onset_s = Some(onset_s));
    }
    hidden
}

fn pick(mechanisms: &[&[Form]], draw: &mut Draw, of: fn(Form, &mut Draw) -> Effect) -> Effect {
    let forms = draw.pick(mechanisms);
    of(draw.pick(forms), draw)
}

/// A joint of the five-bar: it turns by some 0.4 rad, at some 1 rad/s, under some 1 N·m.
const TYPICAL: Typical = Typical {
    travel: 0.4,
    speed: 1.0,
    effort: 1.0,
    duration_s: 25.0,
    dry: 0.0,
    viscous: 0.0,
};
/// The most that a brake gives in an experiment, N·m.
const GREATEST_NM: f64 = 2.5;

fn at_joint(form: Form, draw: &mut Draw) -> Effect {
    match form {
        Form::LoadArm => form.of([draw.log_uniform(0.004, 0.03)]),
        // The load is the force on the tip, N.
        Form::LoadSquare => form.of([draw.log_uniform(0.06, 0.4), 12.0]),
        _ => TYPICAL.force(form, draw),
    }
}

fn of_brake(form: Form, draw: &mut Draw) -> Effect {
    in_brake(form, GREATEST_NM, TYPICAL.duration_s, draw)
}

fn of_whole(form: Form, draw: &mut Draw) -> Effect {
    let (s, c) = libm::sincos(draw.uniform(0.0, TAU));
    let base = draw.pick(&[Joint::A, Joint::B]);
    let axis = At::Sensor(draw.below(2));
    match form {
        Form::Payload => form.of([draw.log_uniform(0.15, 1.0)]),
        Form::Gravity => {
            let field = 9.81 * libm::sin(RAD_PER_DEG * draw.log_uniform(0.5, 4.0));
            form.of([field * c, field * s])
        }
        Form::PlaneSpring => {
            let anchor_m = [0.25 * c, 0.4 + 0.25 * s];
            form.of([
                draw.log_uniform(8.0, 60.0),
                anchor_m[0],
                anchor_m[1],
                draw.uniform(0.05, 0.2),
            ])
        }
        Form::LinkLength => {
            let joint = draw.pick(&Joint::ALL);
            form.of([draw.sign() * draw.log_uniform(0.002, 0.012)])
                .joint(joint)
        }
        Form::Drift => form
            .of([draw.sign() * draw.log_uniform(0.004, 0.02)])
            .joint(base),
        Form::Creep => {
            let level = draw.sign() * draw.log_uniform(0.06, 0.3);
            form.of([level, draw.uniform(3.0, 10.0)]).joint(base)
        }
        Form::Skew => form.of([draw.sign() * draw.log_uniform(0.003, 0.02)]),
        Form::Eccentric => {
            let phase = draw.uniform(0.0, TAU);
            form.of([draw.log_uniform(0.01, 0.06), phase]).joint(base)
        }
        Form::ForceGain => form
            .of([draw.sign() * draw.log_uniform(0.05, 0.25)])
            .at(axis),
        Form::Crosstalk => form
            .of([draw.sign() * draw.log_uniform(0.05, 0.25)])
            .at(axis),
        _ => form.of([draw.sign() * RAD_PER_DEG * draw.log_uniform(2.0, 10.0)]),
    }
}

/// One effect of every form that is drawn here.
#[cfg(test)]
pub fn every(draw: &mut Draw) -> Vec<Effect> {
    let mut all = Vec::new();
    for (mechanisms, of) in [
        (JOINT, at_joint as fn(Form, &mut Draw) -> Effect),
        (SHARE, share),
        (BRAKE, of_brake),
    ] {
        for form in mechanisms.iter().copied().flatten() {
            all.push(of(*form, draw).at(At::Every));
        }
    }
    let whole = WHOLE.iter().copied().flatten();
    all.extend(whole.map(|form| of_whole(*form, draw)));
    all
}
