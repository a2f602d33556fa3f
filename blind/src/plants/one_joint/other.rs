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
use rigproof_spec::units::RAD_PER_DEG;
use std::f64::consts::TAU;

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
    &[Form::Ripple, Form::TwoOrders, Form::Toothed],
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

/// Physics outside the library.
const FOREIGN: &[Form] = &[Form::Disturbance, Form::Uneven];

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
        let share = setup.brake().is_some() && SHARES.contains(&form) && draw.chance(0.5);
        let drawn = match share {
            true => as_share(form, draw),
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

/// A share of the brake's torque.
fn as_share(form: Form, draw: &mut Draw) -> Effect {
    let share = draw.log_uniform(0.06, 0.3);
    let period = TAU / draw.uniform(6.0, 30.0);
    let values = match form {
        Form::Stribeck => [share, draw.log_uniform(0.05, 0.4), 1.0, 0.0],
        Form::Rational => [share, draw.log_uniform(0.05, 0.4), 0.0, 0.0],
        Form::MaxwellSlip => [share, draw.log_uniform(0.03, 0.2), 0.0, 0.0],
        Form::Toothed => [share, period, draw.uniform(1.0, 4.0), 0.0],
        Form::TwoOrders => [share, period, draw.uniform(0.3, 0.8), 0.0],
        _ => [draw.sign() * share, 0.0, 0.0, 0.0],
    };
    Effect::new(form, values).of_drive()
}

fn effect(setup: &Setup, form: Form, draw: &mut Draw) -> Effect {
    let (travel, speed, effort) = (setup.scale.travel, setup.scale.speed, setup.scale.effort);
    let level = effort * draw.log_uniform(0.05, 0.35);
    let yields = travel * draw.log_uniform(0.02, 0.2);
    let stiff = level / (travel * travel * travel);
    let share = draw.log_uniform(0.08, 0.35);
    let values = match form {
        Form::Viscous => [level / speed, 0.0, 0.0, 0.0],
        Form::Stribeck => [level, speed * draw.log_uniform(0.05, 0.3), 1.0, 0.0],
        Form::Rational => [level, speed * draw.log_uniform(0.05, 0.3), 0.0, 0.0],
        Form::Travelled => [
            level,
            speed * draw.log_uniform(0.05, 0.3),
            0.2 * yields,
            0.0,
        ],
        Form::DahlPower => [level, yields, draw.pick(&[0.5, 1.5, 2.0]), 0.0],
        Form::ElastoPlastic => [level, yields, draw.uniform(0.3, 0.8), 0.0],
        Form::MaxwellSlip => [level, 3.0 * yields, 0.0, 0.0],
        Form::BoucWen => [
            level / yields,
            1.0 / yields,
            0.5 * draw.sign() / yields,
            0.0,
        ],
        Form::Root | Form::Square => [level, speed, 0.0, 0.0],
        Form::Power => [level, speed, draw.pick(&[1.3, 1.6]), 0.0],
        Form::Tanh => [level, 0.5 * speed, 0.0, 0.0],
        Form::Asymmetric => [0.0, draw.sign() * level / speed, 0.0, 0.0],
        Form::Drift => [draw.sign() * level / setup.duration_s, 0.0, 0.0, 0.0],
        Form::Creep => [
            draw.sign() * level,
            setup.duration_s * draw.uniform(0.15, 0.4),
            0.0,
            0.0,
        ],
        Form::Ripple => [level, 0.5 * level, travel / draw.uniform(1.5, 6.0), 0.0],
        Form::TwoOrders => [
            level,
            travel / draw.uniform(1.5, 6.0),
            draw.uniform(0.3, 0.8),
            0.0,
        ],
        Form::Toothed => [
            level,
            travel / draw.uniform(1.5, 6.0),
            draw.uniform(1.0, 4.0),
            0.0,
        ],
        Form::Anchored => [
            level / travel,
            draw.sign() * travel * draw.uniform(0.3, 1.2),
            0.0,
            0.0,
        ],
        Form::Hardening => [0.6 * level / travel, 2.0 * stiff, 0.0, 0.0],
        Form::Cubic => [2.0 * stiff, 0.0, 0.0, 0.0],
        Form::Overshoot | Form::OvershootLinear => {
            [level, travel * draw.uniform(0.08, 0.3), 0.0, 0.0]
        }
        Form::Skew => [draw.log_uniform(0.003, 0.02), 0.0, 0.0, 0.0],
        Form::Disturbance => [level, draw.log_uniform(0.25, 3.0), 0.0, 0.0],
        Form::Uneven => [
            level,
            draw.uniform(0.6, 1.0),
            travel / draw.uniform(0.8, 3.0),
            0.0,
        ],
        Form::Lag => [draw.log_uniform(0.015, 0.08), 0.0, 0.0, 0.0],
        Form::LagSecond => [
            draw.log_uniform(0.01, 0.04),
            draw.uniform(0.5, 1.0),
            0.0,
            0.0,
        ],
        Form::Saturation | Form::SoftSaturation => [draw.uniform(2.0, 5.0), 0.0, 0.0, 0.0],
        Form::Preisach => [draw.uniform(0.12, 0.4), 0.0, 0.0, 0.0],
        Form::Plays => [draw.uniform(0.4, 1.0), draw.uniform(0.1, 0.3), 0.0, 0.0],
        Form::BoucWenCurrent => [draw.uniform(0.4, 0.9), draw.uniform(0.05, 0.2), 0.0, 0.0],
        Form::Thermal => [draw.log_uniform(0.02, 0.12), 0.0, 0.0, 0.0],
        Form::YieldFade => [draw.uniform(0.08, 0.3), setup.duration_s, 0.0, 0.0],
        Form::YieldOvershoot | Form::YieldOvershootLinear => {
            [share, draw.log_uniform(0.05, 0.3), 0.0, 0.0]
        }
        Form::TimeConstants => [draw.uniform(0.5, 3.0), draw.uniform(0.0, 3.0), 0.0, 0.0],
        Form::OffState => [draw.uniform(0.04, 0.25), 0.0, 0.0, 0.0],
        Form::Backlash => [draw.uniform(2.5, 6.0) * RAD_PER_DEG, 0.0, 0.0, 0.0],
        Form::Gain => [draw.sign() * share, 0.0, 0.0, 0.0],
        _ => [level, 0.0, 0.0, 0.0],
    };
    Effect::new(form, values)
}
