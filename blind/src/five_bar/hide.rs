//! This file draws the physics that a five-bar recording hides.

use super::law::{Effect, Law};
use super::setup::Setup;
use crate::draw::Draw;
use crate::stratum::Stratum;
use rigproof_spec::joint::Joint;
use rigproof_spec::layout::Layout;
use rigproof_spec::tables::backlash_width_deg;
use rigproof_spec::units::RAD_PER_DEG;
use std::f64::consts::TAU;

/// How an effect at a joint is drawn; one that has no joint leaves it.
pub type Recipe = fn(Joint, &mut Draw) -> Effect;

/// At a joint with a brake.
const JOINT: [Recipe; 7] = [dry, viscous, stribeck, presliding, spring, ripple, load];
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
const FOREIGN: [Recipe; 4] = [two_ripples, uneven, varying_skew, compliance];
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
        Stratum::Nothing | Stratum::DataFault => Vec::new(),
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
            vec![whole(Law::Inertia { fraction })]
        }
    }
}

/// A gain or dry friction of brake A, which has no backlash, at a current that never changes; on three brakes also friction at
/// the bearing C, which turns as E does.
fn unidentifiable(setup: &Setup, draw: &mut Draw) -> Effect {
    if setup.layout == Layout::ThreeBrake && draw.chance(0.6) {
        let law = match draw.chance(0.5) {
            true => Law::Bearing {
                dry: draw.uniform(0.08, 0.4),
                viscous: 0.0,
            },
            false => Law::Bearing {
                dry: 0.0,
                viscous: draw.uniform(0.05, 0.2),
            },
        };
        return Effect {
            law,
            joint: Some(Joint::C),
            onset_s: None,
        };
    }
    match draw.chance(0.5) {
        true => gain(Joint::A, draw),
        false => dry(Joint::A, draw),
    }
}

const fn at(joint: Joint, law: Law) -> Effect {
    Effect {
        law,
        joint: Some(joint),
        onset_s: None,
    }
}

const fn whole(law: Law) -> Effect {
    Effect {
        law,
        joint: None,
        onset_s: None,
    }
}

/// A base joint, which has an encoder.
fn base(draw: &mut Draw) -> Joint {
    draw.pick(&[Joint::A, Joint::B])
}

fn dry(joint: Joint, draw: &mut Draw) -> Effect {
    at(
        joint,
        Law::Dry {
            level: draw.log_uniform(0.05, 0.4),
        },
    )
}

/// About the 0.078 N·m·s/rad of §3.3.2.
fn viscous(joint: Joint, draw: &mut Draw) -> Effect {
    at(
        joint,
        Law::Viscous {
            coefficient: draw.log_uniform(0.025, 0.16),
        },
    )
}

/// The bristle bends by 2 to 6 mrad before it slides.
fn stribeck(joint: Joint, draw: &mut Draw) -> Effect {
    let peak = draw.log_uniform(0.15, 0.6);
    at(
        joint,
        Law::LuGre {
            peak,
            speed: draw.log_uniform(0.06, 0.4),
            stiffness: peak / draw.uniform(0.002, 0.006),
        },
    )
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
    at(
        joint,
        Law::MaxwellSlip {
            level: draw.log_uniform(0.1, 0.5),
            travel: draw.log_uniform(0.03, 0.2),
        },
    )
}

fn spring(joint: Joint, draw: &mut Draw) -> Effect {
    at(
        joint,
        Law::Spring {
            stiffness: draw.log_uniform(0.2, 1.5),
        },
    )
}

/// The teeth and poles of a brake: 12 to 60 a turn.
fn ripple(joint: Joint, draw: &mut Draw) -> Effect {
    let amplitude = draw.log_uniform(0.05, 0.3);
    let (s, c) = libm::sincos(draw.uniform(0.0, TAU));
    at(
        joint,
        Law::Ripple {
            sine: amplitude * s,
            cosine: amplitude * c,
            period: TAU / draw.uniform(12.0, 60.0),
        },
    )
}

fn load(joint: Joint, draw: &mut Draw) -> Effect {
    at(
        joint,
        Law::Load {
            arm: draw.log_uniform(0.004, 0.03),
        },
    )
}

fn gain(joint: Joint, draw: &mut Draw) -> Effect {
    at(
        joint,
        Law::Gain {
            fraction: draw.sign() * draw.log_uniform(0.05, 0.25),
        },
    )
}

fn lag(joint: Joint, draw: &mut Draw) -> Effect {
    at(
        joint,
        Law::Lag {
            time_constant: draw.log_uniform(0.012, 0.08),
        },
    )
}

/// Narrower or wider than table 3.1; brake A has no backlash to become narrower.
fn backlash(joint: Joint, draw: &mut Draw) -> Effect {
    let printed_deg = backlash_width_deg(joint);
    let narrower = printed_deg > 0.0 && draw.chance(0.4);
    let width_deg = match narrower {
        true => printed_deg * draw.uniform(0.1, 0.5),
        false => printed_deg + draw.uniform(0.8, 3.0),
    };
    at(
        joint,
        Law::Backlash {
            width: width_deg * RAD_PER_DEG,
        },
    )
}

fn preisach(joint: Joint, draw: &mut Draw) -> Effect {
    at(
        joint,
        Law::Preisach {
            share: draw.uniform(0.12, 0.4),
        },
    )
}

fn thermal(joint: Joint, draw: &mut Draw) -> Effect {
    at(
        joint,
        Law::Thermal {
            loss: draw.log_uniform(0.02, 0.12),
        },
    )
}

fn overshoot(joint: Joint, draw: &mut Draw) -> Effect {
    at(
        joint,
        Law::Overshoot {
            fraction: draw.uniform(0.1, 0.4),
            travel: draw.log_uniform(0.05, 0.25),
        },
    )
}

fn payload(_: Joint, draw: &mut Draw) -> Effect {
    whole(Law::Payload {
        mass: draw.log_uniform(0.15, 1.0),
    })
}

fn inertia(_: Joint, draw: &mut Draw) -> Effect {
    whole(Law::Inertia {
        fraction: draw.sign() * draw.log_uniform(0.06, 0.2),
    })
}

/// A base out of level by 0.5° to 4°.
fn gravity(_: Joint, draw: &mut Draw) -> Effect {
    let (s, c) = libm::sincos(draw.uniform(0.0, TAU));
    let field = 9.81 * libm::sin(RAD_PER_DEG * draw.log_uniform(0.5, 4.0));
    whole(Law::Gravity {
        field: [field * c, field * s],
    })
}

fn bias(_: Joint, draw: &mut Draw) -> Effect {
    let level = draw.sign() * draw.log_uniform(0.05, 0.3);
    at(base(draw), Law::Bias { level })
}

fn skew(_: Joint, draw: &mut Draw) -> Effect {
    whole(Law::Skew {
        delay: draw.sign() * draw.log_uniform(0.003, 0.02),
    })
}

fn encoder_scale(_: Joint, draw: &mut Draw) -> Effect {
    let fraction = draw.sign() * draw.log_uniform(0.01, 0.06);
    at(base(draw), Law::EncoderScale { fraction })
}

fn encoder_offset(_: Joint, draw: &mut Draw) -> Effect {
    let angle = draw.sign() * draw.log_uniform(0.01, 0.06);
    at(base(draw), Law::EncoderOffset { angle })
}

fn force_gain(_: Joint, draw: &mut Draw) -> Effect {
    whole(Law::ForceGain {
        fraction: draw.sign() * draw.log_uniform(0.04, 0.2),
    })
}

fn force_bias(_: Joint, draw: &mut Draw) -> Effect {
    let (s, c) = libm::sincos(draw.uniform(0.0, TAU));
    let force = draw.log_uniform(0.3, 2.0);
    whole(Law::ForceBias {
        force: [force * c, force * s],
    })
}

fn force_rotation(_: Joint, draw: &mut Draw) -> Effect {
    whole(Law::ForceRotation {
        angle: draw.sign() * RAD_PER_DEG * draw.log_uniform(1.5, 10.0),
    })
}

fn two_ripples(joint: Joint, draw: &mut Draw) -> Effect {
    let first = TAU / draw.uniform(12.0, 25.0);
    at(
        joint,
        Law::TwoRipples {
            level: draw.log_uniform(0.1, 0.4),
            periods: [first, first / draw.uniform(1.8, 2.9)],
        },
    )
}

fn one_sided(joint: Joint, draw: &mut Draw) -> Effect {
    let weak = draw.uniform(0.05, 0.15);
    let strong = weak * draw.uniform(2.5, 5.0);
    let [forward, backward] = if draw.chance(0.5) {
        [weak, strong]
    } else {
        [strong, weak]
    };
    at(
        joint,
        Law::OneSided {
            forward,
            backward,
            travel: draw.log_uniform(0.03, 0.15),
        },
    )
}

fn uneven(joint: Joint, draw: &mut Draw) -> Effect {
    at(
        joint,
        Law::Uneven {
            level: draw.log_uniform(0.1, 0.4),
            depth: draw.uniform(0.5, 1.0),
            period: draw.log_uniform(0.2, 1.5),
        },
    )
}

fn varying_skew(_: Joint, draw: &mut Draw) -> Effect {
    whole(Law::VaryingSkew {
        delay: draw.log_uniform(0.004, 0.02),
        period: draw.uniform(0.7, 4.0),
    })
}

fn compliance(_: Joint, draw: &mut Draw) -> Effect {
    whole(Law::Compliance {
        mass: draw.uniform(0.3, 1.0),
        frequency_hz: draw.uniform(5.0, 14.0),
    })
}
