//! This file draws what a five-bar hides in other forms: at one joint, at every joint of a kind, as a share of the brake's torque, in the sensors' axes.

use super::setup::Setup;
use crate::draw::Draw;
use crate::effect::{At, Effect};
use crate::form::{Form, Stage};
use crate::stratum::Stratum;
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
    &[Form::TwoOrders, Form::Toothed],
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
const FOREIGN: &[Form] = &[Form::TwoRipples, Form::Uneven];

/// Draws the hidden effects of a stratum. At most one of them is known only by what the equations lack.
pub fn draw(setup: &Setup, stratum: Stratum, draw: &mut Draw) -> Vec<Effect> {
    let joint = draw.pick(setup.layout.brakes());
    let count = match stratum {
        Stratum::Single | Stratum::LateOnset => 1,
        Stratum::Two => 2,
        Stratum::Three => 3,
        Stratum::NotInLibrary => {
            return vec![foreign(draw.pick(FOREIGN), draw).joint(joint)];
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
            1 => pick(SHARE, draw, as_share).of_drive().at(place),
            2 => pick(BRAKE, draw, in_brake).at(place),
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

fn at_joint(form: Form, draw: &mut Draw) -> Effect {
    let level = draw.log_uniform(0.06, 0.4);
    let slow = draw.log_uniform(0.06, 0.4);
    let yields = draw.log_uniform(0.01, 0.08);
    let period = TAU / draw.uniform(12.0, 50.0);
    let values = match form {
        Form::Viscous => [0.3 * level, 0.0, 0.0, 0.0],
        Form::Stribeck => [level, slow, 1.0, 0.0],
        Form::Rational => [level, slow, 0.0, 0.0],
        Form::Travelled => [level, slow, 0.2 * yields, 0.0],
        Form::DahlPower => [level, yields, draw.pick(&[0.5, 1.5, 2.0]), 0.0],
        Form::Bristle => [level, yields, 1e-3, 0.0],
        Form::ElastoPlastic => [level, yields, draw.uniform(0.3, 0.8), 0.0],
        Form::BoucWen => [
            level / yields,
            1.0 / yields,
            0.5 * draw.sign() / yields,
            0.0,
        ],
        Form::Root | Form::Square => [level, 1.0, 0.0, 0.0],
        Form::Power => [level, 1.0, draw.pick(&[1.3, 1.6]), 0.0],
        Form::Tanh => [level, 0.5, 0.0, 0.0],
        Form::LoadArm => [draw.log_uniform(0.004, 0.03), 0.0, 0.0, 0.0],
        Form::LoadSquare => [level, 12.0, 0.0, 0.0],
        Form::TwoOrders => [level, period, draw.uniform(0.3, 0.8), 0.0],
        Form::Toothed => [level, period, draw.uniform(1.0, 4.0), 0.0],
        Form::Anchored => [2.0 * level, draw.sign() * draw.uniform(0.2, 0.8), 0.0, 0.0],
        Form::Hardening => [level, 6.0 * level, 0.0, 0.0],
        Form::OvershootLinear => [level, draw.log_uniform(0.05, 0.25), 0.0, 0.0],
        _ => [level, 0.0, 0.0, 0.0],
    };
    Effect::new(form, values)
}

fn as_share(form: Form, draw: &mut Draw) -> Effect {
    let share = draw.log_uniform(0.08, 0.35);
    let period = TAU / draw.uniform(12.0, 50.0);
    let values = match form {
        Form::Stribeck => [share, draw.log_uniform(0.06, 0.4), 1.0, 0.0],
        Form::Rational => [share, draw.log_uniform(0.06, 0.4), 0.0, 0.0],
        Form::MaxwellSlip => [share, draw.log_uniform(0.03, 0.2), 0.0, 0.0],
        Form::TwoOrders => [share, period, draw.uniform(0.3, 0.8), 0.0],
        Form::Toothed => [share, period, draw.uniform(1.0, 4.0), 0.0],
        _ => [draw.sign() * share, 0.0, 0.0, 0.0],
    };
    Effect::new(form, values)
}

fn in_brake(form: Form, draw: &mut Draw) -> Effect {
    let share = draw.log_uniform(0.06, 0.3);
    let values = match form {
        Form::LagSecond => [
            draw.log_uniform(0.008, 0.04),
            draw.uniform(0.5, 1.0),
            0.0,
            0.0,
        ],
        Form::Gain => [draw.sign() * share, 0.0, 0.0, 0.0],
        Form::Saturation | Form::SoftSaturation => [draw.uniform(0.5, 1.6), 0.0, 0.0, 0.0],
        Form::Plays => [draw.uniform(0.4, 1.0), draw.uniform(0.08, 0.25), 0.0, 0.0],
        Form::BoucWenCurrent => [draw.uniform(0.4, 0.9), draw.uniform(0.05, 0.2), 0.0, 0.0],
        Form::YieldFade => [draw.uniform(0.1, 0.3), 30.0, 0.0, 0.0],
        Form::TimeConstants => [draw.uniform(0.5, 3.0), draw.uniform(0.0, 3.0), 0.0, 0.0],
        Form::OffState => [draw.uniform(0.04, 0.25), 0.0, 0.0, 0.0],
        _ => [share, draw.log_uniform(0.05, 0.25), 0.0, 0.0],
    };
    Effect::new(form, values)
}

fn of_whole(form: Form, draw: &mut Draw) -> Effect {
    let (s, c) = libm::sincos(draw.uniform(0.0, TAU));
    let base = draw.pick(&[Joint::A, Joint::B]);
    let axis = At::Sensor(draw.below(2));
    match form {
        Form::Payload => Effect::new(form, [draw.log_uniform(0.15, 1.0)]),
        Form::Gravity => {
            let field = 9.81 * libm::sin(RAD_PER_DEG * draw.log_uniform(0.5, 4.0));
            Effect::new(form, [field * c, field * s])
        }
        Form::PlaneSpring => {
            let anchor_m = [0.25 * c, 0.4 + 0.25 * s];
            Effect::new(
                form,
                [
                    draw.log_uniform(8.0, 60.0),
                    anchor_m[0],
                    anchor_m[1],
                    draw.uniform(0.05, 0.2),
                ],
            )
        }
        Form::LinkLength => {
            let joint = draw.pick(&Joint::ALL);
            Effect::new(form, [draw.sign() * draw.log_uniform(0.002, 0.012)]).joint(joint)
        }
        Form::Drift => Effect::new(form, [draw.sign() * draw.log_uniform(0.004, 0.02)]).joint(base),
        Form::Creep => {
            let level = draw.sign() * draw.log_uniform(0.06, 0.3);
            Effect::new(form, [level, draw.uniform(3.0, 10.0)]).joint(base)
        }
        Form::Skew => Effect::new(form, [draw.sign() * draw.log_uniform(0.003, 0.02)]),
        Form::Eccentric => {
            let phase = draw.uniform(0.0, TAU);
            Effect::new(form, [draw.log_uniform(0.01, 0.06), phase]).joint(base)
        }
        Form::ForceGain => Effect::new(form, [draw.sign() * draw.log_uniform(0.05, 0.25)]).at(axis),
        Form::Crosstalk => Effect::new(form, [draw.sign() * draw.log_uniform(0.05, 0.25)]).at(axis),
        _ => Effect::new(
            form,
            [draw.sign() * RAD_PER_DEG * draw.log_uniform(2.0, 10.0)],
        ),
    }
}

fn foreign(form: Form, draw: &mut Draw) -> Effect {
    let level = draw.log_uniform(0.1, 0.4);
    match form {
        Form::TwoRipples => {
            let first = TAU / draw.uniform(12.0, 25.0);
            Effect::new(form, [level, first, first / draw.uniform(1.8, 2.9)])
        }
        _ => Effect::new(
            form,
            [level, draw.uniform(0.5, 1.0), draw.log_uniform(0.2, 1.5)],
        ),
    }
}

/// One effect of every form that is drawn here.
#[cfg(test)]
pub fn every(draw: &mut Draw) -> Vec<Effect> {
    let mut all = Vec::new();
    for (mechanisms, of) in [
        (JOINT, at_joint as fn(Form, &mut Draw) -> Effect),
        (SHARE, |form, draw| as_share(form, draw).of_drive()),
        (BRAKE, in_brake),
    ] {
        for form in mechanisms.iter().copied().flatten() {
            all.push(of(*form, draw).at(At::Every));
            all.push(of(*form, draw).joint(Joint::B));
        }
    }
    let whole = WHOLE.iter().copied().flatten();
    all.extend(whole.map(|form| of_whole(*form, draw)));
    all
}
