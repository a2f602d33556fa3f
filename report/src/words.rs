//! This file says physics in the words of somebody who mends machines.

use rigproof_diagnose::report::HeldJoint;
use rigproof_spec::effect::Mechanism;

use crate::number::with_unit;

/// A mechanism in plain words: what it is, to stand after "the model leaves out", and what one would look for on the rig.
pub fn plain(mechanism: Mechanism) -> [&'static str; 2] {
    friction(mechanism)
        .or_else(|| drive(mechanism))
        .or_else(|| body(mechanism))
        .or_else(|| sensor(mechanism))
        .unwrap_or(["an effect of the library", "its entry in the library"])
}

/// Friction and what resembles it.
const fn friction(mechanism: Mechanism) -> Option<[&'static str; 2]> {
    Some(match mechanism {
        Mechanism::DryOffset => [
            "dry friction (a drag of the same size at every speed)",
            "seals, bearings, a brake that does not let go fully",
        ],
        Mechanism::Viscous => [
            "drag that grows with speed",
            "grease, fluid in a gap, eddy currents",
        ],
        Mechanism::DirectionAsymmetry => [
            "friction that differs between the two directions",
            "preload, a worn or tilted bearing, a seal that lies over",
        ],
        Mechanism::Stribeck => [
            "extra friction at low speed that lets go as the motion gets faster",
            "lubrication that only builds up with speed; it makes slow motion jerk",
        ],
        Mechanism::Presliding => [
            "springy give before sliding begins",
            "friction surfaces that bend before they slip: seals, belts, brakes that hold",
        ],
        Mechanism::AsymmetricPresliding => [
            "springy give before sliding begins, and sliding friction that differs between the two directions",
            "friction surfaces that bend before they slip, and what loads them to one side",
        ],
        Mechanism::Hysteresis => [
            "a force that depends on the way it came (hysteresis)",
            "rubber, belts, wire rope, fluid that has to yield",
        ],
        Mechanism::LoadDependent => [
            "friction that grows with the load",
            "bearings under side load",
        ],
        Mechanism::BearingFriction => [
            "friction in a joint without a brake",
            "its bearing: preload, dirt, a seal",
        ],
        Mechanism::VelocityPower => [
            "drag that grows with a power of the speed",
            "air or fluid that is pushed through a gap",
        ],
        Mechanism::Settling => [
            "a brake that changes after it has rested",
            "particles that settle in the fluid: run it in and repeat",
        ],
        Mechanism::Ripple => [
            "a force that comes and goes with the position",
            "cogging, a bent shaft, teeth, a coupling out of line",
        ],
        _ => return None,
    })
}

/// What a drive or a brake does with its command.
const fn drive(mechanism: Mechanism) -> Option<[&'static str; 2]> {
    Some(match mechanism {
        Mechanism::GainError => [
            "a drive or brake that is stronger or weaker than its table says",
            "the amplifier's scale, the brake's age, its gap and its fluid",
        ],
        Mechanism::ReversalOvershoot => [
            "a brake that grips harder just after each reversal",
            "the brake's fluid, which has to yield anew",
        ],
        Mechanism::BacklashWidth => [
            "play at reversals that is wider or narrower than the model's",
            "couplings, keys and gears beside the brake",
        ],
        Mechanism::CurrentHysteresis => [
            "a brake that remembers its earlier current",
            "steel that stays magnetised after the current was higher",
        ],
        Mechanism::Lag => [
            "a drive or brake that answers slowly",
            "the coil's inductance, the amplifier, a filter",
        ],
        Mechanism::DeadTime => [
            "a drive or brake that answers late",
            "a bus, a buffer, a sample taken too late",
        ],
        Mechanism::Saturation => [
            "a command that is cut off at a limit",
            "the amplifier's limit or its supply",
        ],
        Mechanism::ThermalFade => [
            "a brake that weakens as it warms up",
            "its temperature: let it cool and repeat",
        ],
        _ => return None,
    })
}

/// Masses, springs and weight.
const fn body(mechanism: Mechanism) -> Option<[&'static str; 2]> {
    Some(match mechanism {
        Mechanism::Gravity => [
            "weight, because the mechanism is not level",
            "a spirit level on the base",
        ],
        Mechanism::Spring => [
            "a spring that pulls it back",
            "cables, hoses, a belt that is stretched",
        ],
        Mechanism::NonlinearSpring => [
            "a spring that gets stiffer with the deflection",
            "stops, rubber, cables drawn taut",
        ],
        Mechanism::InertiaError => [
            "moving parts that are heavier or lighter than the model's",
            "parts that were changed, their masses and lengths",
        ],
        Mechanism::Payload => [
            "extra weight at the tip",
            "a handle or a sensor that the model does not know",
        ],
        Mechanism::Compliance => [
            "parts that bend",
            "arms, couplings, the clamping of the base",
        ],
        Mechanism::ConstantBias => [
            "a steady pull to one side",
            "a sensor's zero, a cable that pulls, a tilt",
        ],
        _ => return None,
    })
}

/// What the sensors and the logger do.
const fn sensor(mechanism: Mechanism) -> Option<[&'static str; 2]> {
    Some(match mechanism {
        Mechanism::BiasDrift => [
            "a pull to one side that grows with time",
            "a sensor's zero that drifts with temperature",
        ],
        Mechanism::ChannelSkew => [
            "two recorded signals that are shifted in time",
            "how the logger stamps its channels",
        ],
        Mechanism::EncoderScale => [
            "an angle or position that is measured too large or too small",
            "counts per turn, gear ratio",
        ],
        Mechanism::EncoderOffset => [
            "an angle or position with the wrong zero",
            "the homing of the encoder",
        ],
        Mechanism::ForceGain => [
            "a force sensor that reads too much or too little",
            "its calibration, its range setting",
        ],
        Mechanism::ForceBias => [
            "a force sensor whose zero is off",
            "tare it with nothing attached",
        ],
        Mechanism::ForceRotation => [
            "a force sensor that is mounted turned",
            "its axes against those of the rig",
        ],
        _ => return None,
    })
}

/// A cause as a report names it (`viscous`, `viscous at E`, or two of them with ` with ` between) in plain words.
pub fn plain_cause(cause: &str) -> String {
    let plain = |one: &str| match one.split_once(" at ") {
        Some((name, joint)) => plain_at(name, Some(joint)),
        None => plain_at(one, None),
    };
    let all: Vec<String> = cause.split(" with ").map(plain).collect();
    all.join(" with ")
}

/// A mechanism's name and its joint in plain words; a name that is not in the vocabulary stands as it is.
pub fn plain_at(name: &str, joint: Option<&str>) -> String {
    let what = Mechanism::from_name(name).map_or_else(
        || name.to_owned(),
        |mechanism| {
            let [what, _] = plain(mechanism);
            what.to_owned()
        },
    );
    match joint {
        Some(joint) => format!("{what}, at joint {joint}"),
        None => what,
    }
}

/// What to look for on the rig; nothing for a name that is not in the vocabulary.
pub fn look_for(name: &str) -> Option<&'static str> {
    let [_, look] = plain(Mechanism::from_name(name)?);
    Some(look)
}

/// With a capital at its beginning.
pub fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| {
        first.to_uppercase().chain(letters).collect()
    })
}

/// Words with commas and an "and".
pub fn list(words: &[String]) -> String {
    match words {
        [] => String::new(),
        [one] => one.clone(),
        [first @ .., last] => format!("{}, and {last}", first.join("; ")),
    }
}

/// Whether a brake at rest held no more than it can, in words.
pub fn at_rest(own: &HeldJoint, unit: &str) -> String {
    let torque = |size: f64| with_unit(size, unit);
    match (own.missing > 0.0, own.named_at_least > 0.0) {
        (true, _) => format!(
            "at least {} of what holds it is not named",
            torque(own.missing)
        ),
        (false, true) => format!(
            "agrees, and of this what is named has to hold at least {}",
            torque(own.named_at_least)
        ),
        (false, false) => "agrees".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_mechanism_has_words_of_its_own() {
        let mut seen: Vec<&str> = Mechanism::ALL
            .into_iter()
            .map(|mechanism| plain(mechanism)[0])
            .collect();
        seen.sort_unstable();
        assert!(seen.windows(2).all(|pair| pair[0] != pair[1]));
        assert!(!seen.contains(&"an effect of the library"));
        assert_eq!(
            plain_cause("viscous at E"),
            "drag that grows with speed, at joint E"
        );
        assert_eq!(plain_cause("unheard_of"), "unheard_of");
        assert_eq!(
            plain_cause("viscous at E with unheard_of"),
            "drag that grows with speed, at joint E with unheard_of"
        );
        assert_eq!(
            list(&["a".to_owned(), "b".to_owned(), "c".to_owned()]),
            "a; b, and c"
        );
    }
}
