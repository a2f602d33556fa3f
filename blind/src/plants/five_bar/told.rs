//! This file tells a hidden effect of the five-bar as the vocabulary has it, and what no recording can tell from it.

use super::setup::Setup;
use crate::effect::{At, Effect};
use crate::form::{Form, Stage};
use rigproof_spec::effect::Mechanism;
use rigproof_spec::joint::Joint;
use rigproof_spec::layout::Layout;
use std::f64::consts::TAU;

/// The effect with its numbers as the vocabulary counts them: a ripple from the zero of the joint's angle instead of from the start, the angle of a
/// sensor as that by which it turns the force.
pub fn in_the_vocabulary(setup: &Setup, effect: &Effect) -> Effect {
    let mut told = *effect;
    let [a, b, period, _] = effect.values;
    match (effect.form, effect.at) {
        (Form::Ripple, At::Joint(joint)) => {
            let (s, c) = libm::sincos(TAU * setup.start_angle_rad(joint) / period);
            told.values = [a * c + b * s, b * c - a * s, period, 0.0];
        }
        (Form::ForceRotation, _) => told.values = [-a, 0.0, 0.0, 0.0],
        _ => {}
    }
    told
}

/// Sets of mechanisms that no recording of this experiment can tell from an effect: single ones; what a joint does whose twin turns alike; and for
/// a bristle with unequal limits, once it has slid, the bristle with the mean of both and a constant of half their difference; for friction that varies
/// about a level, dry friction of that level and what varies about 0; cogging with two periods is cogging twice.
pub fn sets(setup: &Setup, effect: &Effect) -> Vec<Vec<String>> {
    let single = equivalent(setup, effect).iter();
    let mut sets: Vec<Vec<String>> = single.map(|name| vec![(*name).to_owned()]).collect();
    // Arm CD is parallel to AE and ED to BC: what the joint E itself does the joint C could do.
    let of_joint = effect.stage() != Stage::Drive;
    if setup.layout == Layout::ThreeBrake && effect.at == At::Joint(Joint::E) && of_joint {
        sets.push(vec![format!("{} at C", effect.name())]);
    }
    // What varies about a mean is the mean and what varies about 0; two periods are one name.
    let parts = match effect.form {
        Form::OneSided => Some(vec![Mechanism::Presliding, Mechanism::ConstantBias]),
        Form::Uneven => Some(vec![Mechanism::DryOffset, Mechanism::UnevenFriction]),
        Form::TwoRipples => Some(vec![Mechanism::Ripple]),
        _ => None,
    };
    if let (Some(parts), At::Joint(joint)) = (parts, effect.at) {
        let named = parts.iter();
        let named = named.map(|own| format!("{} at {}", own.name(), joint.letter()));
        sets.push(named.collect());
    }
    sets
}

/// Mechanisms that no recording of this experiment can tell from an effect.
///
/// - On three brakes the joints E and C turn alike: friction at one is bearing friction at the other.
/// - Brake A has no backlash: at a constant current a gain error is dry friction.
/// - A payload is inside what the entries of the mass matrix can be; one factor of them all is their scale.
fn equivalent(setup: &Setup, effect: &Effect) -> &'static [&'static str] {
    let three = setup.layout == Layout::ThreeBrake;
    let [_, viscous, ..] = effect.values;
    match (effect.form, effect.at) {
        (Form::Bearing, _) if three && viscous == 0.0 => &["dry_offset at E", "dry_offset at C"],
        (Form::Bearing, _) if three => &["viscous at E", "viscous at C"],
        (Form::Coulomb | Form::Viscous, At::Joint(Joint::E)) if three => &["bearing_friction at C"],
        (Form::Gain, At::Joint(Joint::A)) if setup.is_constant() => &["dry_offset at A"],
        (Form::Coulomb, At::Joint(Joint::A)) if setup.is_constant() => &["gain_error at A"],
        (Form::Payload, _) => &["inertia_error"],
        (Form::Inertia, _) => &["inertia_scale"],
        _ => &[],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::draw::Draw;
    use crate::plant::Plant;
    use crate::stratum::Stratum;

    #[test]
    fn on_three_brakes_what_is_no_brakes_at_e_could_be_at_c() {
        let drawn = Setup::draw(Stratum::Single, &mut Draw::new(Plant::Rig, 3, "twins")).unwrap();
        let twins = |layout, law: Effect| {
            let effect = law.joint(Joint::E);
            let setup = Setup {
                layout,
                ..drawn.clone()
            };
            sets(&setup, &effect).concat()
        };
        let spring = Form::Spring.of([0.7]);
        assert_eq!(twins(Layout::ThreeBrake, spring), ["spring at C"]);
        assert!(twins(Layout::FourBrake, spring).is_empty());
        let gain = Form::Gain.of([0.13]);
        assert!(twins(Layout::ThreeBrake, gain).is_empty());
        let dry = twins(Layout::ThreeBrake, Form::Coulomb.of([0.2]));
        assert_eq!(dry, ["bearing_friction at C", "dry_offset at C"]);
    }
}
