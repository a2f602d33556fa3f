//! This file draws a bench that hides physics in other forms: in the brake's torque, as shares of it, and beside it.

use super::nominal;
use super::setup::Setup;
use crate::draw::Draw;
use crate::effect::Effect;
use crate::form::{Form, Stage};
use crate::forms::Forms;
use crate::lab::Drawn;
use crate::plant::Plant;
use crate::stratum::Stratum;
use crate::typical::{Typical, in_brake, share};

/// What any bench can hide: a mechanism is drawn first, then one of its forms.
const ANYWHERE: &[&[Form]] = &[
    &[Form::Coulomb],
    &[Form::Viscous],
    &[Form::Stribeck, Form::Rational, Form::Travelled],
    &[
        Form::DahlPower,
        Form::ElastoPlastic,
        Form::MaxwellSlip,
        Form::BoucWen,
    ],
    &[Form::Root, Form::Square, Form::Power, Form::Tanh],
    &[Form::Asymmetric],
    &[Form::Drift, Form::Creep],
    &[Form::Ripple, Form::TwoOrders, Form::Toothed, Form::Uneven],
    &[Form::Anchored, Form::Hardening, Form::Cubic],
    &[Form::Overshoot, Form::OvershootLinear],
    &[Form::Skew],
];

/// What a brake can hide besides.
const BRAKE: &[&[Form]] = &[
    &[Form::Lag, Form::LagSecond],
    &[Form::Gain],
    &[Form::Saturation, Form::SoftSaturation],
    &[Form::Preisach, Form::Plays, Form::BoucWenCurrent],
    &[Form::Thermal, Form::YieldFade],
    &[Form::YieldOvershoot, Form::YieldOvershootLinear],
    &[Form::TimeConstants],
    &[Form::OffState],
    &[Form::Backlash],
];

/// Forms that a brake can have as a share of its torque.
const SHARES: &[Form] = &[
    Form::Stribeck,
    Form::Rational,
    Form::MaxwellSlip,
    Form::Asymmetric,
    Form::Toothed,
    Form::TwoOrders,
];

/// About the torque of a brake at 1 A, N·m.
const GREATEST_NM: f64 = 6.0;

/// Physics outside the library, but for the tether, which has a name since 0305 and stays where it was drawn.
const FOREIGN: &[Form] = &[Form::Disturbance, Form::Tether];

/// A bench with what it hides.
pub fn draw(seed: u64, stratum: Stratum, draw: &mut Draw) -> Drawn<Setup> {
    let drawn = Setup::draw(
        Plant::Bench,
        &mut Draw::new(Plant::Bench, seed, "other setup"),
    );
    let setup = Setup {
        forms: Forms::Other,
        known: draw.chance(0.5),
        ..drawn
    };
    let mut hidden = hidden(&setup, stratum, draw);
    if stratum == Stratum::LateOnset {
        let onset_s = setup.duration_s * draw.uniform(1.0 / 3.0, 2.0 / 3.0);
        hidden
            .iter_mut()
            .for_each(|effect| effect.onset_s = Some(onset_s));
    }
    Drawn {
        known: nominal::draw(&setup, &hidden, draw),
        setup,
        hidden,
    }
}

fn hidden(setup: &Setup, stratum: Stratum, draw: &mut Draw) -> Vec<Effect> {
    let count = match stratum {
        Stratum::Single | Stratum::LateOnset => 1,
        Stratum::Two => 2,
        Stratum::Three => 3,
        Stratum::NotInLibrary => return vec![effect(setup, draw.pick(FOREIGN), draw)],
        _ => 0,
    };
    let mut left: Vec<&[Form]> = ANYWHERE.to_vec();
    if setup.brake().is_some() {
        left.extend(BRAKE);
    }
    let mut hidden: Vec<Effect> = Vec::new();
    while hidden.len() < count && !left.is_empty() {
        let forms = left.swap_remove(draw.below(left.len()));
        let form = draw.pick(forms);
        let shares = setup.brake().is_some() && SHARES.contains(&form) && draw.chance(0.5);
        let drawn = match shares {
            true => share(form, draw),
            false => effect(setup, form, draw),
        };
        let alike = hidden.iter().any(|other| other.stage() == drawn.stage());
        let once = drawn.stage() != Stage::Joint;
        let late = stratum == Stratum::LateOnset;
        if once && (alike || late) || late && drawn.name() == "bias_drift" {
            continue;
        }
        hidden.push(drawn);
    }
    hidden
}

fn effect(setup: &Setup, form: Form, draw: &mut Draw) -> Effect {
    let scale = setup.scale;
    let typical = Typical {
        travel: scale.travel,
        speed: scale.speed,
        effort: scale.effort,
        duration_s: setup.duration_s,
        dry: 0.0,
        // Damping that the bench may not have is not taken away.
        viscous: match form {
            Form::Asymmetric => setup.viscous.first(),
            _ => 0.0,
        },
    };
    match form.facts().stage {
        Stage::Drive => in_brake(form, GREATEST_NM, setup.duration_s, draw),
        Stage::Joint => typical.force(form, draw),
        _ => form.of([draw.log_uniform(0.003, 0.02)]),
    }
}
