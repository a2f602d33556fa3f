//! This file writes a calibration into the URDF or MJCF of an arm, and lists in a table what that
//! format cannot hold.

use super::align::arm;
use rigproof_model::chain::{Chain, Changes, INERTIAL, Inertial, Joint, Stated};
use rigproof_model::effects::facts::Family;
use rigproof_model::effects::{Drive, Form, OfJoint, OfLinkage, facts, form};
use rigproof_spec::effect::Mechanism;
use rigproof_trace::rig::RigEffect;
use rigproof_trace::rig::chain::{AtJoint, ChainRig, ModelFormat};
use std::collections::BTreeMap;

/// The calibrated model, and the table of what it cannot hold.
const fn files(format: ModelFormat) -> [&'static str; 2] {
    match format {
        ModelFormat::Urdf => ["calibrated.urdf", "not-in-urdf.csv"],
        ModelFormat::Mjcf => ["calibrated.xml", "not-in-mjcf.csv"],
    }
}

/// The files to write beside the calibration.
pub(super) fn beside(rig: &ChainRig) -> Vec<(&'static str, String)> {
    let Ok(chain) = arm(rig) else {
        return Vec::new();
    };
    let mut changes = Changes::default();
    let mut left: Vec<(&AtJoint, String)> = Vec::new();
    let (late, always): (Vec<&AtJoint>, Vec<&AtJoint>) = rig
        .effects
        .iter()
        .partition(|own| own.effect.onset.is_some());
    let (masses, others): (Vec<&AtJoint>, Vec<&AtJoint>) =
        always.into_iter().partition(|own| is_of_masses(own));
    match links(&chain, &masses) {
        Ok(links) => changes.links = links,
        Err(why) => left.extend(masses.iter().map(|own| (*own, why.to_owned()))),
    }
    for own in others {
        let joint = chain.joints.iter().find(|joint| joint.name == own.joint);
        let slot = joint.and_then(|joint| {
            let stated = changes.joints.entry(own.joint.clone());
            stated_by(own, rig.format, stated.or_insert(stated_of(joint)))
        });
        match slot {
            Some(slot) => *slot = (*slot + first(&own.effect)).max(0.0),
            None if joint.is_none() => left.push((own, no_part(rig.format))),
            None => left.push((own, reason(own.effect.mechanism, rig.format))),
        }
    }
    let is_changed = |joint: &Joint| changes.joints.get(&joint.name) != Some(&stated_of(joint));
    let kept = chain.joints.iter().filter(|own| is_changed(own));
    let kept: Vec<&str> = kept.map(|own| own.name.as_str()).collect();
    changes
        .joints
        .retain(|name, _| kept.contains(&name.as_str()));
    let begins = "a model is the same at all times, and this begins during the recording";
    left.extend(late.into_iter().map(|own| (own, begins.to_owned())));
    let [model, lacks] = files(rig.format);
    let mut files = Vec::new();
    if !changes.links.is_empty() || !changes.joints.is_empty() {
        changes.said = said(rig, &left);
        let written = match rig.format {
            ModelFormat::Urdf => changes.in_urdf(&rig.model),
            ModelFormat::Mjcf => changes.in_mjcf(&rig.model),
        };
        files.extend(written.ok().map(|text| (model, text)));
    }
    if !left.is_empty() {
        files.push((lacks, table(rig, &left)));
    }
    files
}

fn stated_of(joint: &Joint) -> Stated {
    Stated {
        friction: joint.friction,
        damping: joint.damping,
        armature: joint.armature,
    }
}

/// The number of a joint that a mechanism changes, where the format has it.
fn stated_by<'a>(
    own: &AtJoint,
    format: ModelFormat,
    stated: &'a mut Stated,
) -> Option<&'a mut f64> {
    match (own.effect.mechanism, form(own.effect.mechanism)) {
        (Mechanism::DryOffset, _) => Some(&mut stated.friction),
        (Mechanism::Viscous, _) => Some(&mut stated.damping),
        (_, Some(Form::Joint(OfJoint::Inertia))) if format == ModelFormat::Mjcf => {
            Some(&mut stated.armature)
        }
        _ => None,
    }
}

/// The links whose inertial numbers change, by name, or why none are written.
fn links(chain: &Chain, masses: &[&AtJoint]) -> Result<BTreeMap<String, Inertial>, &'static str> {
    if masses.is_empty() {
        return Ok(BTreeMap::new());
    }
    let links = chain.possible(&moved(chain, masses)).ok_or(NO_BODY)?;
    let links = named(chain, links);
    match links.contains_key("") {
        true => Err(NO_PLACE),
        false => Ok(links),
    }
}

const NO_PLACE: &str = "it moves between two joints of one body, where MJCF has no inertia";
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
fn named(chain: &Chain, links: Vec<Inertial>) -> BTreeMap<String, Inertial> {
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

/// Why a format cannot hold what is before the link of a joint.
fn no_part(format: ModelFormat) -> String {
    let format = format.name();
    format!(
        "a joint of {format} has no motor behind a transmission; keep it in your own simulation"
    )
}

/// Why a format cannot hold this mechanism.
fn reason(mechanism: Mechanism, format: ModelFormat) -> String {
    let format = format.name();
    match form(mechanism) {
        Some(Form::Joint(OfJoint::Inertia)) => {
            format!("{format} has no inertia of a rotor; MJCF has: its `armature`")
        }
        Some(Form::Drive(Drive::Gain)) => {
            format!("{format} has no torque constant; scale the effort that is recorded or sent")
        }
        Some(Form::Drive(Drive::Skew)) => {
            format!("{format} has no delay; shift the recorded effort")
        }
        _ if mechanism == Mechanism::ConstantBias => {
            format!("{format} has no constant effort; take it off the recorded one")
        }
        _ if facts(mechanism).is_some_and(|own| own.family == Family::Position) => format!(
            "{format} has no effort over a joint's position, but for a spring in MJCF: its `stiffness` and `springref`, to be written by hand"
        ),
        _ => format!("friction of {format} is a Coulomb level and a damping only"),
    }
}

fn said(rig: &ChainRig, left: &[(&AtJoint, String)]) -> Vec<String> {
    let head = format!(
        "{} with what a diagnosis found: inertial numbers and what joints state. Links stand near the described ones among all that give the same efforts.",
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

fn table(rig: &ChainRig, left: &[(&AtJoint, String)]) -> String {
    let mut text = "joint,mechanism,number,value,unit,why\n".to_owned();
    for (own, why) in left {
        let motion = rig.motion_at(&own.joint);
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
