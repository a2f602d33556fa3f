//! This file draws what a driven joint hides: every mechanism in two forms or more.

use super::setup::Setup;
use crate::draw::Draw;
use crate::effect::Effect;
use crate::form::{Form, Stage};
use crate::stratum::Stratum;
use std::f64::consts::TAU;

/// The mechanisms, each with its forms: first a mechanism is drawn, then one of them.
pub const MECHANISMS: &[&[Form]] = &[
    &[Form::Coulomb],
    &[Form::Viscous],
    &[Form::Inertia],
    &[Form::Stribeck, Form::Rational, Form::Travelled],
    &[
        Form::DahlPower,
        Form::Bristle,
        Form::MaxwellSlip,
        Form::ElastoPlastic,
        Form::BoucWen,
    ],
    &[Form::Root, Form::Square, Form::Power, Form::Tanh],
    &[Form::Asymmetric],
    &[Form::LoadShare, Form::LoadSided, Form::LoadSquare],
    &[Form::Lag, Form::LagSecond, Form::RateLimit],
    &[Form::DeadTime, Form::Skew],
    &[Form::Gain],
    &[Form::Saturation, Form::SoftSaturation],
    &[Form::Bias, Form::Drift, Form::Creep],
    &[Form::FadeLinear, Form::FadeExponential, Form::FadeByWay],
    &[Form::Ripple, Form::TwoOrders, Form::Toothed, Form::Uneven],
    &[Form::Anchored, Form::Hardening, Form::Cubic],
    &[Form::TwoMass],
    &[Form::Gap, Form::ImpactGap],
    &[Form::EncoderScale, Form::Eccentric, Form::Interpolation],
    &[Form::Overshoot, Form::OvershootLinear],
    &[Form::Repeated, Form::Clock],
];

/// Physics outside the library, but for the tether, which has a name since 0305 and stays where it was drawn.
pub const FOREIGN: &[Form] = &[
    Form::Disturbance,
    Form::DeadZone,
    Form::Tether,
    Form::Settling,
];

/// Draws the hidden effects of a stratum: none, one, two or three of different mechanisms, at most one in the drive and one that moves masses.
pub fn draw(setup: &Setup, stratum: Stratum, draw: &mut Draw) -> Vec<Effect> {
    let count = match stratum {
        Stratum::Single | Stratum::LateOnset => 1,
        Stratum::Two => 2,
        Stratum::Three => 3,
        Stratum::NotInLibrary => return vec![effect(setup, draw.pick(FOREIGN), draw)],
        _ => 0,
    };
    let mut left: Vec<&[Form]> = MECHANISMS.to_vec();
    left.retain(|forms| forms.iter().all(|form| can(setup, *form)));
    let mut hidden: Vec<Effect> = Vec::new();
    while hidden.len() < count {
        let forms = left.swap_remove(draw.below(left.len()));
        let drawn = effect(setup, draw.pick(forms), draw);
        let stage = drawn.stage();
        let alike = hidden.iter().any(|other| other.stage() == stage);
        let late = stratum == Stratum::LateOnset;
        if (stage != Stage::Joint && (alike || late)) || (late && !begins(drawn.form)) {
            continue;
        }
        hidden.push(drawn);
    }
    hidden
}

/// Whether a form can begin in mid-recording.
fn begins(form: Form) -> bool {
    form.facts().mechanism != "thermal_fade" && form.facts().mechanism != "bias_drift"
}

/// What fades, is missing in a gap or differs between directions needs a friction that is there.
fn can(setup: &Setup, form: Form) -> bool {
    match form {
        Form::FadeLinear | Form::FadeExponential | Form::FadeByWay | Form::Gap => setup.dry > 0.0,
        Form::Asymmetric => setup.dry > 0.0 && setup.viscous > 0.0,
        _ => true,
    }
}

/// An effect of a form in this laboratory.
pub fn effect(setup: &Setup, form: Form, draw: &mut Draw) -> Effect {
    match form.facts().stage {
        Stage::Joint => setup.typical().force(form, draw),
        Stage::Drive => of_drive(setup, form, draw),
        _ => elsewhere(setup, form, draw),
    }
}

fn of_drive(setup: &Setup, form: Form, draw: &mut Draw) -> Effect {
    let effort = setup.effort;
    let values = match form {
        Form::Lag => [draw.log_uniform(0.003, 0.025), 0.0, 0.0, 0.0],
        Form::LagSecond => [
            draw.log_uniform(0.003, 0.015),
            draw.uniform(0.5, 1.0),
            0.0,
            0.0,
        ],
        Form::RateLimit => [effort * draw.log_uniform(8.0, 30.0), 0.0, 0.0, 0.0],
        Form::DeadTime => {
            let samples = draw.log_uniform(1.0, 20.0) * setup.rate_hz / 1000.0;
            let samples = if draw.chance(0.5) {
                samples.ceil()
            } else {
                samples
            };
            [samples / setup.rate_hz, 0.0, 0.0, 0.0]
        }
        Form::Gain => [draw.sign() * draw.uniform(0.06, 0.3), 0.0, 0.0, 0.0],
        Form::Saturation | Form::SoftSaturation => [effort * draw.uniform(0.6, 1.4), 0.0, 0.0, 0.0],
        _ => [effort * draw.uniform(0.08, 0.3), 0.0, 0.0, 0.0],
    };
    form.of(values)
}

fn elsewhere(setup: &Setup, form: Form, draw: &mut Draw) -> Effect {
    let values = match form {
        Form::Inertia => {
            let more = draw.uniform(0.08, 0.6);
            [
                if draw.chance(0.7) { more } else { -0.5 * more },
                0.0,
                0.0,
                0.0,
            ]
        }
        Form::TwoMass => {
            let gap = if draw.chance(0.4) {
                setup.travel * draw.uniform(0.005, 0.03)
            } else {
                0.0
            };
            [
                draw.uniform(0.3, 0.7),
                draw.log_uniform(6.0, 25.0),
                gap,
                0.0,
            ]
        }
        Form::ImpactGap => [
            draw.uniform(0.3, 0.7),
            draw.uniform(60.0, 150.0),
            setup.travel * draw.log_uniform(0.01, 0.06),
            0.0,
        ],
        Form::Skew => [draw.log_uniform(0.003, 0.02), 0.0, 0.0, 0.0],
        Form::EncoderScale => [draw.sign() * draw.uniform(0.03, 0.2), 0.0, 0.0, 0.0],
        Form::Eccentric => [
            draw.log_uniform(0.02, 0.12),
            draw.uniform(0.0, TAU),
            0.0,
            0.0,
        ],
        Form::Interpolation => {
            let line = TAU / draw.pick(&[16.0, 32.0, 64.0]);
            [line * draw.uniform(0.01, 0.06), line, 0.0, 0.0]
        }
        Form::Repeated => [
            draw.uniform(0.5, 2.0),
            draw.uniform(3.0, 12.0).floor(),
            0.0,
            0.0,
        ],
        Form::Clock if draw.chance(0.5) => [draw.sign() * draw.uniform(0.02, 0.06), 0.0, 0.0, 0.0],
        Form::Clock => [0.0, draw.uniform(0.1, 0.4) / setup.rate_hz, 0.0, 0.0],
        _ => [0.0; 4],
    };
    form.of(values)
}
