//! This file says what may stand in a rig description as a JSON Schema, for editors that complete and check while somebody writes.
//!
//! Tests hold it to the readers: both know the same keys and need the same ones.
#![expect(
    clippy::indexing_slicing,
    reason = "a member of a JSON object that was made here is set"
)]

pub mod shape;
mod tables;

use rigproof_spec::joint::Joint;
use serde_json::{Value, json};

use shape::{above_zero, defined, list, not_below_zero, object, one_of, text};
use tables::{brake, channel, channels, characteristic, common, effect, effects, protocol, value};

/// One driven joint, or one brake or damper at an imposed motion.
fn one_joint(is_axis: bool) -> Value {
    let mut keys = common(if is_axis { "axis" } else { "bench" });
    let of_torque = [of_torque()];
    keys.extend([
        (
            "motion",
            one_of("Whether it slides or turns.", ["linear", "rotary"]),
        ),
        (
            "effect",
            effects(
                "The physics that the model has already.",
                if is_axis { &[] } else { &of_torque },
                &[],
            ),
        ),
        ("protocol", protocol()),
    ]);
    let mut required = vec!["name", "plant", "motion", "channels"];
    if is_axis {
        let roles = ["position", "command", "enabled"];
        keys.push((
            "channels",
            channels("What the channels mean.", &roles, &["position", "command"]),
        ));
        let parameters = vec![
            ("inertia", defined("value")),
            ("command_gain", defined("value")),
        ];
        keys.push((
            "parameters",
            object(
                Some("Mass or moment of inertia, and what one unit of the command gives."),
                parameters,
                &["inertia", "command_gain"],
            ),
        ));
        keys.push(("servo", servo()));
        keys.push(("recording", recordings()));
        required.push("parameters");
    } else {
        let roles = [
            "position",
            "speed",
            "force",
            "torque",
            "command",
            "current",
            "simulated",
        ];
        let mut own = channels("What the channels mean.", &roles, &[]);
        own["oneOf"] = json!([{ "required": ["force"] }, { "required": ["torque"] }]);
        own["dependentSchemas"] = json!({ "command": { "properties": { "current": false } } });
        keys.push(("channels", own));
        keys.push(("brake", brake()));
        keys.push(("characteristic", characteristic()));
    }
    let mut whole = object(None, keys, &required);
    if !is_axis {
        whole["allOf"] = json!([of_commanded(), of_sweep()]);
        whole["dependentSchemas"] =
            json!({ "characteristic": { "properties": { "brake": false } } });
    }
    whole
}

/// A command of a bench acts through a characteristic.
fn of_commanded() -> Value {
    json!({
        "if": { "properties": { "channels": { "required": ["command"] } } },
        "then": { "required": ["characteristic"] }
    })
}

/// A static sweep is over a speed, or over what a characteristic is over; other benches record the
/// position.
fn of_sweep() -> Value {
    let has = |role: &str| json!({ "required": [role] });
    let over = json!({ "anyOf": [has("speed"), has("command"), has("current")] });
    let of_current = json!({ "properties": { "channels": has("current") } });
    let sweep = json!({ "drive": { "const": "static" } });
    json!({
        "if": {
            "properties": { "protocol": { "properties": sweep, "required": ["drive"] } },
            "required": ["protocol"]
        },
        "then": {
            "properties": { "brake": false, "channels": over },
            "if": of_current,
            "then": { "required": ["characteristic"] }
        },
        "else": { "properties": { "channels": has("position") } }
    })
}

/// A position servo as the drive of a joint.
fn servo() -> Value {
    let keys = vec![
        ("gain", above_zero("Voltage for an error, V/rad or V/m.")),
        (
            "supply_v",
            above_zero("The supply, at which the voltage saturates, V."),
        ),
        (
            "dead_band",
            not_below_zero("Error within which no voltage is given, rad or m."),
        ),
        (
            "back_emf",
            not_below_zero("Voltage that motion induces, V·s/rad or V·s/m."),
        ),
    ];
    object(
        Some("A position servo: the command is a goal."),
        keys,
        &["gain", "supply_v"],
    )
}

/// What single recordings of a servo state.
fn recordings() -> Value {
    let keys = vec![
        ("file", text("The name of its file, without folders.")),
        ("gain", above_zero("The gain of the servo in it.")),
    ];
    list(
        "What single recordings state of their own.",
        object(None, keys, &["file", "gain"]),
    )
}

fn of_torque() -> (&'static str, Value) {
    let about = "`torque`: its efforts are shares of the torque of the brake.";
    ("of", one_of(about, ["torque"]))
}

fn five_bar() -> Value {
    let letters = Joint::ALL.map(Joint::letter);
    let more = [
        ("joint", one_of("The joint at which it acts.", letters)),
        ("axis", one_of("The axis of the force sensor.", ["x", "y"])),
        of_torque(),
    ];
    let roles = [
        "theta_a",
        "theta_b",
        "force_x",
        "force_y",
        "current_a",
        "current_e",
        "current_b",
        "current_c",
    ];
    let mut keys = common("rig");
    keys.extend([
        (
            "layout",
            one_of("Which joints carry a brake.", ["three_brake", "four_brake"]),
        ),
        (
            "channels",
            channels(
                "What the channels mean.",
                &roles,
                &[
                    "theta_a",
                    "theta_b",
                    "force_x",
                    "force_y",
                    "current_a",
                    "current_e",
                    "current_b",
                ],
            ),
        ),
        (
            "effect",
            effects(
                "The physics that the model has beyond the thesis's.",
                &more,
                &[],
            ),
        ),
        ("protocol", protocol()),
    ]);
    let mut whole = object(None, keys, &["name", "plant", "layout", "channels"]);
    whole["if"] = json!({ "properties": { "layout": { "const": "four_brake" } } });
    whole["then"] = json!({ "properties": { "channels": { "required": ["current_c"] } } });
    whole["else"] =
        json!({ "properties": { "channels": { "properties": { "current_c": false } } } });
    whole
}

fn chain() -> Value {
    let joint = vec![
        ("name", text("Its name in the model.")),
        (
            "motion",
            one_of(
                "Whether it turns (where nothing is said) or slides.",
                ["rotary", "linear"],
            ),
        ),
        ("position", defined("channel")),
        ("effort", defined("channel")),
        ("motor", defined("channel")),
        ("torque", defined("channel")),
        ("stiffness", defined("value")),
        ("rotor", defined("value")),
    ];
    let mut joints = list(
        "The moving joints, each with what is recorded of it.",
        object(None, joint, &["name", "position", "effort"]),
    );
    joints["minItems"] = json!(1);
    let more = [(
        "joint",
        text(
            "The joint at which it acts, of a link the joint that moves it; of a part of a joint `elbow.motor` or `elbow.transmission`.",
        ),
    )];
    let mut keys = common("chain");
    keys.extend([
        (
            "urdf",
            text("The file of the arm's URDF, from the folder of this file."),
        ),
        (
            "mjcf",
            text("Instead of `urdf`: the file of the arm's MJCF, its inertias written out."),
        ),
        (
            "tip",
            text(
                "The link (of MJCF a body or site) beyond which nothing is attached; the only end where nothing is said.",
            ),
        ),
        (
            "channels",
            channels("The time, where the header does not say it.", &[], &[]),
        ),
        ("joint", joints),
        (
            "effect",
            effects(
                "The physics that the arm has beyond its model's.",
                &more,
                &["joint"],
            ),
        ),
    ]);
    let mut whole = object(None, keys, &["name", "plant", "joint"]);
    whole["oneOf"] = json!([{ "required": ["urdf"] }, { "required": ["mjcf"] }]);
    whole
}

/// The JSON Schema of a rig description.
pub fn schema() -> Value {
    json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "rigproof rig",
        "description": "A rig: what it is, what is known of it, and what the channels of its recordings mean.",
        "type": "object",
        "oneOf": [one_joint(true), one_joint(false), chain(), five_bar()],
        "$defs": { "channel": channel(), "effect": effect(), "value": value() },
    })
}

/// The same as the text of a file.
pub fn schema_text() -> String {
    format!("{:#}\n", schema())
}

#[cfg(test)]
mod tests;
