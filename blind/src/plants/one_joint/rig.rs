//! This file writes the rig description that goes with a recording: channels, parameters and the nominal physics.

use super::setup::{Kind, Setup};
use crate::draw::{Draw, rounded};
use crate::effect::Effect;
use crate::plant::Plant;
use rigproof_spec::effect::{Motion, Quantity};
use rigproof_trace::rig::SCHEMA_LINE;
use std::fmt::Write;

/// The rig description as TOML. Values of unknown parameters are off by a factor of 0.4 to 2.
pub fn toml(plant: Plant, seed: u64, setup: &Setup, known: &[Effect], draw: &mut Draw) -> String {
    let unit = |quantity: Quantity| quantity.dimension(setup.motion).to_string();
    let motion = match setup.motion {
        Motion::Rotary => "rotary",
        Motion::Linear => "linear",
    };
    let mut text = format!(
        "{SCHEMA_LINE}\nname = \"blind {plant} {seed}\"\nplant = \"{plant}\"\nmotion = \"{motion}\"\n\n[channels]\n\
         position = {{ channel = \"position\", unit = \"{}\", quantum = {} }}\n",
        unit(Quantity::Travel),
        setup.quantum,
        plant = plant.name(),
    );
    let noise = setup.noise;
    match &setup.kind {
        Kind::Axis(drive) => {
            let inertia_unit = match setup.motion {
                Motion::Rotary => unit(Quantity::Inertia),
                Motion::Linear => "kg".to_owned(),
            };
            text += &format!(
                "command = {{ channel = \"command\", unit = \"V\", noise = {noise} }}\n\n[parameters]\n\
                 inertia = {{ value = {}, unit = \"{inertia_unit}\", status = \"known\" }}\n\
                 command_gain = {{ value = {}, unit = \"{}/V\", status = \"known\" }}\n",
                drive.inertia,
                drive.gain,
                unit(Quantity::Effort),
            );
        }
        Kind::Bench(brake) => {
            text += &format!(
                "force = {{ channel = \"{}\", unit = \"{}\", noise = {noise} }}\n",
                effort_channel(setup.motion),
                unit(Quantity::Effort),
            );
            if let Some((joint, _)) = brake {
                text += &format!(
                    "current = {{ channel = \"current\", unit = \"A\" }}\n\n[brake]\njoint = \"{}\"\n",
                    joint.letter()
                );
            }
        }
    }
    for law in known {
        text += &format!("\n[[effect]]\nmechanism = \"{}\"\n", law.name());
        for (name, value, unit) in law.parameters(setup.motion) {
            let (stated, status) = match setup.known {
                true => (value, "known"),
                false => (rounded(value * draw.uniform(0.4, 2.0)), "unknown"),
            };
            // Writing to a string cannot fail.
            let _ = writeln!(
                text,
                "{name} = {{ value = {stated}, unit = \"{unit}\", status = \"{status}\" }}"
            );
        }
    }
    text
}

/// The name of the metered channel.
pub fn effort_channel(motion: Motion) -> &'static str {
    match motion {
        Motion::Rotary => "torque",
        Motion::Linear => "force",
    }
}
