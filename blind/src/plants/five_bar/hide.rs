//! This file draws the physics that a five-bar recording hides.

use super::setup::Setup;
use crate::draw::Draw;
use crate::effect::Effect;
use crate::form::Form;
use crate::stratum::Stratum;
use rigproof_spec::joint::Joint;
use rigproof_spec::layout::Layout;
use rigproof_spec::tables::backlash_width_deg;
use rigproof_spec::units::RAD_PER_DEG;
use std::f64::consts::TAU;

/// How an effect at a joint is drawn; one that has no joint leaves it.
pub type Recipe = fn(Joint, &mut Draw) -> Effect;

/// At a joint with a brake.
const JOINT: [Recipe; 8] = [
    dry, viscous, stribeck, presliding, spring, ripple, uneven, load,
];
const BRAKE: [Recipe; 6] = [gain, lag, backlash, preisach, thermal, overshoot];
const WHOLE: [Recipe; 4] = [payload, gravity, inertia, bias];
const SENSOR: [Recipe; 6] = [
    skew,
    encoder_scale,
    encoder_offset,
    force_gain,
    force_bias,
    force_rotation,
];
/// What can begin in mid-recording.
const LATE: [Recipe; 8] = [
    dry, viscous, stribeck, presliding, spring, ripple, gain, gravity,
];
/// What can be made as small as one likes.
const SCALABLE: [Recipe; 12] = [
    dry, viscous, stribeck, presliding, spring, ripple, load, gain, payload, gravity, force_gain,
    force_bias,
];
/// Physics outside the library, but for the tether, which has a name since 0313 and stays where it was drawn.
const FOREIGN: [Recipe; 4] = [two_ripples, tether, varying_skew, compliance];
/// Sets of which each looks like less of the others, all at one joint.
const MASKED: [&[Recipe]; 10] = [
    &[dry, gain],
    &[dry, viscous],
    &[dry, stribeck],
    &[viscous, stribeck],
    &[thermal, gain],
    &[viscous, lag],
    &[force_gain, gain],
    &[spring, gravity],
    &[payload, viscous],
    &[dry, viscous, gain],
];

/// Every recipe but that of a bearing.
#[cfg(test)]
pub fn every() -> Vec<Recipe> {
    let both: [Recipe; 2] = [two_sided, one_sided];
    let groups: [&[Recipe]; 6] = [&JOINT, &BRAKE, &WHOLE, &SENSOR, &FOREIGN, &both];
    groups.concat()
}

/// Draws the hidden effects of a stratum.
pub fn draw(setup: &Setup, stratum: Stratum, draw: &mut Draw) -> Vec<Effect> {
    let braked = setup.layout.brakes();
    let joint = draw.pick(braked);
    let all = |recipes: &[Recipe], draw: &mut Draw| -> Vec<Effect> {
        recipes.iter().map(|recipe| recipe(joint, draw)).collect()
    };
    match stratum {
        Stratum::Nothing | Stratum::DataFault | Stratum::Two | Stratum::Three => Vec::new(),
        Stratum::Single | Stratum::Noisy | Stratum::InLoop => {
            // A third each at a joint and in a brake, the rest elsewhere.
            let group: &[Recipe] = match draw.below(9) {
                0..=2 => &JOINT,
                3..=5 => &BRAKE,
                6 => &WHOLE,
                _ => &SENSOR,
            };
            vec![draw.pick(group)(joint, draw)]
        }
        Stratum::Masked => {
            let recipes = draw.pick(&MASKED);
            all(recipes, draw)
        }
        Stratum::LateOnset => {
            let onset_s = setup.duration_s * draw.uniform(1.0 / 3.0, 2.0 / 3.0);
            let effect = draw.pick(&LATE)(joint, draw);
            vec![Effect {
                onset_s: Some(onset_s),
                ..effect
            }]
        }
        Stratum::TooSmall => vec![draw.pick(&SCALABLE)(joint, draw)],
        Stratum::NotInLibrary => vec![draw.pick(&FOREIGN)(joint, draw)],
        Stratum::Unidentifiable => vec![unidentifiable(setup, draw)],
        Stratum::WrongInertia => {
            let fraction = draw.sign() * draw.uniform(0.02, 0.05);
            vec![Form::Inertia.of([fraction])]
        }
    }
}

/// A gain or dry friction of brake A, which has no backlash, at a current that never changes; on three brakes also friction at
/// the bearing C, which turns as E does.
fn unidentifiable(setup: &Setup, draw: &mut Draw) -> Effect {
    if setup.layout == Layout::ThreeBrake && draw.chance(0.6) {
        let law = match draw.chance(0.5) {
            true => Form::Bearing.of([draw.uniform(0.08, 0.4), 0.0]),
            false => Form::Bearing.of([0.0, draw.uniform(0.05, 0.2)]),
        };
        return law.joint(Joint::C);
    }
    match draw.chance(0.5) {
        true => gain(Joint::A, draw),
        false => dry(Joint::A, draw),
    }
}

/// A base joint, which has an encoder.
fn base(draw: &mut Draw) -> Joint {
    draw.pick(&[Joint::A, Joint::B])
}

fn dry(joint: Joint, draw: &mut Draw) -> Effect {
    Form::Coulomb.of([draw.log_uniform(0.05, 0.4)]).joint(joint)
}

/// About the 0.078 N·m·s/rad of §3.3.2.
fn viscous(joint: Joint, draw: &mut Draw) -> Effect {
    Form::Viscous
        .of([draw.log_uniform(0.025, 0.16)])
        .joint(joint)
}

/// The bristle bends by 2 to 6 mrad before it slides.
fn stribeck(joint: Joint, draw: &mut Draw) -> Effect {
    let peak = draw.log_uniform(0.15, 0.6);
    Form::Lugre
        .of([
            peak,
            draw.log_uniform(0.06, 0.4),
            2.0,
            peak / draw.uniform(0.002, 0.006),
        ])
        .joint(joint)
}

/// With the same limit in both directions, or in three of ten draws with another in each.
fn presliding(joint: Joint, draw: &mut Draw) -> Effect {
    let same = two_sided(joint, draw);
    match draw.chance(0.3) {
        true => one_sided(joint, draw),
        false => same,
    }
}

fn two_sided(joint: Joint, draw: &mut Draw) -> Effect {
    Form::MaxwellSlip
        .of([draw.log_uniform(0.1, 0.5), draw.log_uniform(0.03, 0.2)])
        .joint(joint)
}

fn spring(joint: Joint, draw: &mut Draw) -> Effect {
    Form::Spring.of([draw.log_uniform(0.2, 1.5)]).joint(joint)
}

/// The teeth and poles of a brake: 12 to 60 a turn.
fn ripple(joint: Joint, draw: &mut Draw) -> Effect {
    let amplitude = draw.log_uniform(0.05, 0.3);
    let (s, c) = libm::sincos(draw.uniform(0.0, TAU));
    Form::Ripple
        .of([amplitude * s, amplitude * c, TAU / draw.uniform(12.0, 60.0)])
        .joint(joint)
}

fn load(joint: Joint, draw: &mut Draw) -> Effect {
    Form::LoadArm
        .of([draw.log_uniform(0.004, 0.03)])
        .joint(joint)
}

fn gain(joint: Joint, draw: &mut Draw) -> Effect {
    Form::Gain
        .of([draw.sign() * draw.log_uniform(0.05, 0.25)])
        .joint(joint)
}

fn lag(joint: Joint, draw: &mut Draw) -> Effect {
    Form::Lag.of([draw.log_uniform(0.012, 0.08)]).joint(joint)
}

/// Narrower or wider than table 3.1; brake A has no backlash to become narrower.
fn backlash(joint: Joint, draw: &mut Draw) -> Effect {
    let printed_deg = backlash_width_deg(joint);
    let narrower = printed_deg > 0.0 && draw.chance(0.4);
    let width_deg = match narrower {
        true => printed_deg * draw.uniform(0.1, 0.5),
        false => printed_deg + draw.uniform(0.8, 3.0),
    };
    Form::Backlash.of([width_deg * RAD_PER_DEG]).joint(joint)
}

fn preisach(joint: Joint, draw: &mut Draw) -> Effect {
    Form::Preisach.of([draw.uniform(0.12, 0.4)]).joint(joint)
}

fn thermal(joint: Joint, draw: &mut Draw) -> Effect {
    Form::Thermal
        .of([draw.log_uniform(0.02, 0.12)])
        .joint(joint)
}

fn overshoot(joint: Joint, draw: &mut Draw) -> Effect {
    Form::YieldOvershoot
        .of([draw.uniform(0.1, 0.4), draw.log_uniform(0.05, 0.25)])
        .joint(joint)
}

fn payload(_: Joint, draw: &mut Draw) -> Effect {
    Form::Payload.of([draw.log_uniform(0.15, 1.0)])
}

fn inertia(_: Joint, draw: &mut Draw) -> Effect {
    Form::Inertia.of([draw.sign() * draw.log_uniform(0.06, 0.2)])
}

/// A base out of level by 0.5° to 4°.
fn gravity(_: Joint, draw: &mut Draw) -> Effect {
    let (s, c) = libm::sincos(draw.uniform(0.0, TAU));
    let field = 9.81 * libm::sin(RAD_PER_DEG * draw.log_uniform(0.5, 4.0));
    Form::Gravity.of([field * c, field * s])
}

fn bias(_: Joint, draw: &mut Draw) -> Effect {
    let level = draw.sign() * draw.log_uniform(0.05, 0.3);
    Form::Bias.of([level]).joint(base(draw))
}

fn skew(_: Joint, draw: &mut Draw) -> Effect {
    Form::Skew.of([draw.sign() * draw.log_uniform(0.003, 0.02)])
}

fn encoder_scale(_: Joint, draw: &mut Draw) -> Effect {
    let fraction = draw.sign() * draw.log_uniform(0.01, 0.06);
    Form::EncoderScale.of([fraction]).joint(base(draw))
}

fn encoder_offset(_: Joint, draw: &mut Draw) -> Effect {
    let angle = draw.sign() * draw.log_uniform(0.01, 0.06);
    Form::EncoderOffset.of([angle]).joint(base(draw))
}

fn force_gain(_: Joint, draw: &mut Draw) -> Effect {
    Form::ForceGain.of([draw.sign() * draw.log_uniform(0.04, 0.2)])
}

fn force_bias(_: Joint, draw: &mut Draw) -> Effect {
    let (s, c) = libm::sincos(draw.uniform(0.0, TAU));
    let force = draw.log_uniform(0.3, 2.0);
    Form::ForceBias.of([force * c, force * s])
}

fn force_rotation(_: Joint, draw: &mut Draw) -> Effect {
    Form::ForceRotation.of([draw.sign() * RAD_PER_DEG * draw.log_uniform(1.5, 10.0)])
}

fn two_ripples(joint: Joint, draw: &mut Draw) -> Effect {
    let first = TAU / draw.uniform(12.0, 25.0);
    Form::TwoRipples
        .of([
            draw.log_uniform(0.1, 0.4),
            first,
            first / draw.uniform(1.8, 2.9),
        ])
        .joint(joint)
}

fn one_sided(joint: Joint, draw: &mut Draw) -> Effect {
    let weak = draw.uniform(0.05, 0.15);
    let strong = weak * draw.uniform(2.5, 5.0);
    let [forward, backward] = if draw.chance(0.5) {
        [weak, strong]
    } else {
        [strong, weak]
    };
    Form::OneSided
        .of([forward, backward, draw.log_uniform(0.03, 0.15)])
        .joint(joint)
}

fn uneven(joint: Joint, draw: &mut Draw) -> Effect {
    Form::Uneven
        .of([
            draw.log_uniform(0.1, 0.4),
            draw.uniform(0.5, 1.0),
            draw.log_uniform(0.2, 1.5),
        ])
        .joint(joint)
}

fn tether(joint: Joint, draw: &mut Draw) -> Effect {
    let beyond = draw.sign() * draw.uniform(0.03, 0.15);
    Form::Tether
        .of([draw.log_uniform(1.0, 5.0), beyond])
        .joint(joint)
}

fn varying_skew(_: Joint, draw: &mut Draw) -> Effect {
    Form::VaryingSkew.of([draw.log_uniform(0.004, 0.02), draw.uniform(0.7, 4.0)])
}

fn compliance(_: Joint, draw: &mut Draw) -> Effect {
    Form::Compliance.of([draw.uniform(0.3, 1.0), draw.uniform(5.0, 14.0)])
}
