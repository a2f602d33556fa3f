//! This file writes a calibration as URDF, and lists in a table what a URDF cannot hold.

use super::align::arm;
use rigproof_model::chain::{Chain, Changes, INERTIAL, Inertial};
use rigproof_model::effects::{Drive, Form, OfJoint, OfLinkage, form};
use rigproof_spec::effect::{Mechanism, Motion};
use rigproof_trace::rig::RigEffect;
use rigproof_trace::rig::chain::{AtJoint, ChainRig};

/// The calibrated URDF.
const URDF: &str = "calibrated.urdf";
/// The table of what the URDF cannot hold.
const TABLE: &str = "not-in-urdf.csv";

/// The files to write beside the calibration.
pub(super) fn beside(rig: &ChainRig) -> Vec<(&'static str, String)> {
    let Ok(chain) = arm(rig) else {
        return Vec::new();
    };
    let mut changes = Changes::default();
    let mut left: Vec<(&AtJoint, &str)> = Vec::new();
    let masses: Vec<&AtJoint> = rig.effects.iter().filter(|own| is_of_masses(own)).collect();
    match chain.possible(&moved(&chain, &masses)) {
        Some(links) if !masses.is_empty() => changes.links = named(&chain, links),
        Some(_) => {}
        None => left.extend(masses.iter().map(|own| (*own, NO_BODY))),
    }
    for own in rig.effects.iter().filter(|own| !is_of_masses(own)) {
        let joint = chain.joints.iter().find(|joint| joint.name == own.joint);
        let friction = joint.map(|joint| [joint.friction, joint.damping]);
        match (own.effect.mechanism, friction) {
            (Mechanism::DryOffset, Some(stated)) => {
                let [dry, _] = put(&mut changes, own, stated);
                *dry = (*dry + first(&own.effect)).max(0.0);
            }
            (Mechanism::Viscous, Some(stated)) => {
                let [_, viscous] = put(&mut changes, own, stated);
                *viscous = (*viscous + first(&own.effect)).max(0.0);
            }
            (mechanism, _) => left.push((own, reason(mechanism))),
        }
    }
    let mut files = Vec::new();
    if !changes.links.is_empty() || !changes.joints.is_empty() {
        changes.said = said(rig, &left);
        files.extend(changes.written(&rig.model).ok().map(|text| (URDF, text)));
    }
    if !left.is_empty() {
        files.push((TABLE, table(rig, &left)));
    }
    files
}

/// The Coulomb and viscous friction of an effect's joint, to be changed in place.
fn put<'a>(changes: &'a mut Changes, own: &AtJoint, stated: [f64; 2]) -> &'a mut [f64; 2] {
    changes.joints.entry(own.joint.clone()).or_insert(stated)
}

const NO_BODY: &str =
    "no links that bodies can be were found with these groups of inertial numbers";

fn is_of_masses(own: &AtJoint) -> bool {
    matches!(
        form(own.effect.mechanism),
        Some(Form::Joint(OfJoint::Link) | Form::Linkage(OfLinkage::Payload))
    )
}

fn first(effect: &RigEffect) -> f64 {
    effect.values.first().map_or(0.0, |own| own.value)
}

/// The change of all inertial parameters, ten a link.
fn moved(chain: &Chain, masses: &[&AtJoint]) -> Vec<f64> {
    let mut all = vec![0.0; INERTIAL * chain.joints.len()];
    for own in masses {
        let link = chain
            .joints
            .iter()
            .position(|joint| joint.name == own.joint);
        let values: Vec<f64> = match form(own.effect.mechanism) {
            Some(Form::Linkage(OfLinkage::Payload)) => {
                let mass = first(&own.effect);
                chain.of_a_payload().iter().map(|x| mass * x).collect()
            }
            _ => {
                let before = vec![0.0; INERTIAL * link.unwrap_or(0)];
                let own = own.effect.values.iter().map(|value| value.value);
                before.into_iter().chain(own).collect()
            }
        };
        all.iter_mut().zip(values).for_each(|(slot, x)| *slot += x);
    }
    all
}

/// The links whose inertial parameters changed, by name.
fn named(chain: &Chain, links: Vec<Inertial>) -> std::collections::BTreeMap<String, Inertial> {
    let each = chain.joints.iter().zip(links);
    let changed = each.filter(|(joint, own)| {
        let pairs = own.numbers().into_iter().zip(joint.own.numbers());
        let scale = joint.own.mass.abs().max(1e-9);
        pairs.into_iter().any(|(a, b)| (a - b).abs() > 1e-9 * scale)
    });
    changed
        .map(|(joint, own)| (joint.link.clone(), own))
        .collect()
}

/// Why a URDF cannot hold this mechanism.
fn reason(mechanism: Mechanism) -> &'static str {
    match form(mechanism) {
        Some(Form::Joint(OfJoint::Inertia)) => {
            "a URDF has no inertia of a rotor; an MJCF's `armature` is one"
        }
        Some(Form::Drive(Drive::Gain)) => {
            "a URDF has no torque constant; scale the effort that is recorded or sent"
        }
        Some(Form::Drive(Drive::Skew)) => "a URDF has no time; shift the recorded effort",
        _ if mechanism == Mechanism::ConstantBias => {
            "a URDF has no constant effort; take it off the recorded one"
        }
        _ => "a URDF's friction is a Coulomb level and a damping only",
    }
}

fn said(rig: &ChainRig, left: &[(&AtJoint, &str)]) -> Vec<String> {
    let head = format!(
        "{} with what a diagnosis found: inertial numbers and friction. Links stand near the described ones among all that give the same efforts.",
        rig.name
    );
    let lacks = left.iter().map(|(own, why)| {
        format!(
            "not in it: {} at {}: {why}",
            own.effect.mechanism.name(),
            own.joint
        )
    });
    core::iter::once(head).chain(lacks).collect()
}

fn table(rig: &ChainRig, left: &[(&AtJoint, &str)]) -> String {
    let mut text = "joint,mechanism,number,value,unit,why\n".to_owned();
    for (own, why) in left {
        let joint = rig.joints.iter().find(|joint| joint.name == own.joint);
        let motion = joint.map_or(Motion::Rotary, |joint| joint.motion);
        let mechanism = own.effect.mechanism;
        for (number, value) in mechanism.parameters().iter().zip(&own.effect.values) {
            text += &format!(
                "{},{},{},{},{},\"{why}\"\n",
                own.joint,
                mechanism.name(),
                number.name,
                value.value,
                number.quantity.dimension(motion),
            );
        }
    }
    text
}
