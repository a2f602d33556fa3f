//! This file draws the physics that a case hides.

use super::setup::{Kind, Setup};
use crate::draw::Draw;
use crate::effect::Effect;
use crate::form::{Form, Stage};
use crate::stratum::Stratum;
use rigproof_spec::joint::Joint;
use std::f64::consts::TAU;

/// How a law's parameters are drawn in a lab.
type Recipe = fn(&Setup, &mut Draw) -> Effect;

/// What a damper on a bench can hide; the axis and the brake can hide the drive's laws as well.
const MECHANICAL: [Recipe; 11] = [
    dry, viscous, asymmetry, stribeck, dahl, bouc_wen, bias, spring, cubic, ripple, skew,
];
const DRIVE: [Recipe; 2] = [lag, gain];

/// Laws outside the library.
const FOREIGN_ANYWHERE: [Recipe; 4] = [
    quadratic_drag,
    thermal_fade,
    reversal_overshoot,
    disturbance,
];
const FOREIGN_AXIS: [Recipe; 4] = [load_friction, settling, dead_zone, saturation];
const FOREIGN_BRAKE: [Recipe; 2] = [current_hysteresis, backlash_width];

/// Pairs of which each looks like less of the other.
const PAIRS_ANYWHERE: [[Recipe; 2]; 4] = [
    [dry, stribeck],
    [bias, viscous_asymmetry],
    [hard_spring, softening],
    [viscous, stribeck],
];
const PAIRS_AXIS: [[Recipe; 2]; 2] = [[viscous, lag], [viscous, gain]];
const PAIRS_BRAKE: [[Recipe; 2]; 2] = [[dry, gain], [viscous, lag]];

/// Draws the hidden laws of a stratum: none, one or two.
pub fn draw(setup: &Setup, stratum: Stratum, draw: &mut Draw) -> Vec<Effect> {
    let driven = !matches!(setup.kind, Kind::Bench(None));
    match stratum {
        Stratum::Masked => {
            let mut pairs = PAIRS_ANYWHERE.to_vec();
            match setup.kind {
                Kind::Axis(_) => pairs.extend(PAIRS_AXIS),
                Kind::Bench(Some(_)) => pairs.extend(PAIRS_BRAKE),
                Kind::Bench(None) => {}
            }
            draw.pick(&pairs)
                .into_iter()
                .map(|recipe| recipe(setup, draw))
                .collect()
        }
        Stratum::NotInLibrary => {
            let mut recipes = FOREIGN_ANYWHERE.to_vec();
            match setup.kind {
                Kind::Axis(_) => recipes.extend(FOREIGN_AXIS),
                Kind::Bench(Some(_)) => recipes.extend(FOREIGN_BRAKE),
                Kind::Bench(None) => {}
            }
            vec![draw.pick(&recipes)(setup, draw)]
        }
        Stratum::Single | Stratum::LateOnset | Stratum::TooSmall => {
            let mut recipes = MECHANICAL.to_vec();
            if driven {
                recipes.extend(DRIVE);
            }
            // A cable slips or a spring breaks in mid-recording; clocks do not part there.
            if stratum == Stratum::LateOnset {
                recipes.retain(|recipe| !std::ptr::fn_addr_eq(*recipe, skew as Recipe));
            }
            let law = draw.pick(&recipes)(setup, draw);
            let is_effort = law.stage() == Stage::Joint;
            let share = draw.log_uniform(0.15, 1.0);
            vec![if is_effort { law.scaled(share) } else { law }]
        }
        // Nothing, a fault of the data, or a stratum of the five-bar.
        _ => Vec::new(),
    }
}

fn dry(setup: &Setup, draw: &mut Draw) -> Effect {
    Form::Coulomb.of([setup.scale.effort * draw.uniform(0.08, 0.4)])
}

fn viscous(setup: &Setup, draw: &mut Draw) -> Effect {
    Form::Viscous.of([setup.scale.effort / setup.scale.speed * draw.uniform(0.08, 0.4)])
}

fn bias(setup: &Setup, draw: &mut Draw) -> Effect {
    Form::Bias.of([setup.scale.effort * draw.sign() * draw.uniform(0.06, 0.25)])
}

/// Asymmetry of the dry friction, of the damping, or of both; a share of what the nominal plant has.
fn asymmetry(setup: &Setup, draw: &mut Draw) -> Effect {
    let which = draw.below(3);
    let mut share = |of: Effect, left_out| match which == left_out {
        true => 0.0,
        false => of.first() * (draw.sign() * draw.uniform(0.3, 0.7)),
    };
    let dry = share(setup.dry, 1);
    Form::Asymmetric.of([dry, share(setup.viscous, 0)])
}

fn viscous_asymmetry(setup: &Setup, draw: &mut Draw) -> Effect {
    let viscous = setup.viscous.first() * draw.sign() * draw.uniform(0.4, 0.8);
    Form::Asymmetric.of([0.0, viscous])
}

fn stribeck(setup: &Setup, draw: &mut Draw) -> Effect {
    Form::Stribeck.of([
        setup.scale.effort * draw.uniform(0.1, 0.35),
        setup.scale.speed * draw.log_uniform(0.05, 0.3),
        draw.pick(&[1.0, 2.0, 2.0]),
    ])
}

fn dahl(setup: &Setup, draw: &mut Draw) -> Effect {
    Form::Dahl.of([
        setup.scale.effort * draw.uniform(0.1, 0.4),
        setup.scale.travel * draw.log_uniform(0.02, 0.2),
    ])
}

/// Admissible when beta_gamma exceeds |beta_delta| (Ikhouane and Rodellar 2007).
fn bouc_wen(setup: &Setup, draw: &mut Draw) -> Effect {
    let level = setup.scale.effort * draw.uniform(0.12, 0.4);
    let rate = 1.0 / (setup.scale.travel * draw.log_uniform(0.05, 0.3));
    let ratio = draw.sign() * draw.uniform(0.3, 0.8);
    Form::BoucWen.of([level * rate, rate, rate * ratio])
}

fn spring(setup: &Setup, draw: &mut Draw) -> Effect {
    Form::Spring.of([setup.scale.effort / setup.scale.travel * draw.uniform(0.12, 0.5)])
}

fn cubic(setup: &Setup, draw: &mut Draw) -> Effect {
    let travel = setup.scale.travel;
    Form::Cubic.of([setup.scale.effort / (travel * travel * travel) * draw.uniform(0.15, 0.6)])
}

fn hard_spring(setup: &Setup, draw: &mut Draw) -> Effect {
    spring(setup, draw).scaled(1.4)
}

/// A cubic that takes the spring's force back at large travel.
fn softening(setup: &Setup, draw: &mut Draw) -> Effect {
    cubic(setup, draw).scaled(-0.6)
}

fn ripple(setup: &Setup, draw: &mut Draw) -> Effect {
    let amplitude = setup.scale.effort * draw.uniform(0.08, 0.3);
    let (s, c) = libm::sincos(draw.uniform(0.0, TAU));
    Form::Ripple.of([
        amplitude * s,
        amplitude * c,
        setup.scale.travel / draw.uniform(1.5, 6.0),
    ])
}

fn lag(setup: &Setup, draw: &mut Draw) -> Effect {
    let (low_s, high_s) = match setup.kind {
        Kind::Axis(_) => (0.003, 0.012),
        Kind::Bench(_) => (0.015, 0.08),
    };
    Form::Lag.of([draw.log_uniform(low_s, high_s)])
}

fn gain(_: &Setup, draw: &mut Draw) -> Effect {
    Form::Gain.of([draw.sign() * draw.uniform(0.08, 0.3)])
}

fn skew(_: &Setup, draw: &mut Draw) -> Effect {
    Form::Skew.of([draw.sign() * draw.log_uniform(0.002, 0.015)])
}

fn quadratic_drag(setup: &Setup, draw: &mut Draw) -> Effect {
    Form::Square.of([
        setup.scale.effort * draw.uniform(0.1, 0.35),
        setup.scale.speed,
    ])
}

fn thermal_fade(setup: &Setup, draw: &mut Draw) -> Effect {
    Form::WorkFade.of([
        setup.scale.effort * draw.uniform(0.25, 0.5),
        setup.scale.travel * draw.uniform(4.0, 12.0),
    ])
}

fn reversal_overshoot(setup: &Setup, draw: &mut Draw) -> Effect {
    Form::Overshoot.of([
        setup.scale.effort * draw.uniform(0.2, 0.5),
        setup.scale.travel * draw.uniform(0.1, 0.35),
    ])
}

fn disturbance(setup: &Setup, draw: &mut Draw) -> Effect {
    Form::Disturbance.of([
        setup.scale.effort * draw.uniform(0.1, 0.35),
        draw.log_uniform(0.25, 3.0),
    ])
}

fn load_friction(_: &Setup, draw: &mut Draw) -> Effect {
    Form::LoadShare.of([draw.uniform(0.1, 0.35)])
}

fn settling(setup: &Setup, draw: &mut Draw) -> Effect {
    Form::Settling.of([
        setup.scale.effort * draw.uniform(0.3, 0.6),
        draw.uniform(0.15, 0.5),
        setup.scale.travel * draw.uniform(0.1, 0.3),
    ])
}

fn dead_zone(setup: &Setup, draw: &mut Draw) -> Effect {
    Form::DeadZone.of([setup.scale.effort * draw.uniform(0.1, 0.3)])
}

fn saturation(setup: &Setup, draw: &mut Draw) -> Effect {
    Form::Saturation.of([setup.scale.effort * draw.uniform(0.5, 0.9)])
}

fn current_hysteresis(_: &Setup, draw: &mut Draw) -> Effect {
    Form::Play.of([draw.uniform(0.06, 0.2)])
}

/// Narrower or wider than the table's window, of 1.5° to 1.8°; brake A has none.
fn backlash_width(setup: &Setup, draw: &mut Draw) -> Effect {
    let printed_deg = match setup.brake() {
        Some((Joint::A, _)) | None => 0.0,
        Some((joint, _)) => rigproof_spec::tables::backlash_width_deg(joint),
    };
    let width_deg = if printed_deg > 0.0 && draw.chance(0.4) {
        printed_deg * draw.uniform(0.1, 0.5)
    } else {
        printed_deg + draw.uniform(1.0, 4.0)
    };
    Form::Backlash.of([width_deg * rigproof_spec::units::RAD_PER_DEG])
}
