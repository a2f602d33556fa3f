//! This file writes the description of a driven joint as a laboratory has it.

use super::setup::Setup;
use crate::draw::{Draw, rounded};
use crate::plant::Plant;
use rigproof_trace::rig::SCHEMA_LINE;
use std::fmt::Write;

/// The description, TOML: a number that is not known is off by a factor of 0.4 to 2.
pub fn toml(seed: u64, setup: &Setup) -> String {
    let mut draw = Draw::new(Plant::Axis, seed, "other nominal values");
    let mut number = |value: f64, unit: &str, known: bool| {
        let (value, status) = match known {
            true => (value, "known"),
            false => (rounded(value * draw.uniform(0.4, 2.0)), "unknown"),
        };
        format!("{{ value = {value}, unit = \"{unit}\", status = \"{status}\" }}")
    };
    let unit = setup.command_unit();
    let gain_unit = match unit {
        "V" => "N·m/V",
        _ => "1",
    };
    let mut text = format!(
        "{SCHEMA_LINE}\nname = \"blind axis {seed}, other forms\"\nplant = \"axis\"\nmotion = \"rotary\"\n\n[channels]\n\
         position = {{ channel = \"position\", unit = \"rad\", quantum = {} }}\n\
         command = {{ channel = \"command\", unit = \"{unit}\", noise = {} }}\n\n[parameters]\n\
         inertia = {}\ncommand_gain = {}\n",
        setup.quantum(),
        setup.command_noise,
        number(setup.inertia, "kg·m^2/rad", setup.stated.inertia),
        number(setup.gain, gain_unit, true),
    );
    let laws = [
        ("dry_offset", "level", setup.dry, "N·m", setup.stated.dry),
        (
            "viscous",
            "coefficient",
            setup.viscous,
            "N·m·s/rad",
            setup.stated.viscous,
        ),
    ];
    for (mechanism, name, value, unit, known) in laws {
        if let Some(known) = known {
            // Writing to a string cannot fail.
            let _ = write!(
                text,
                "\n[[effect]]\nmechanism = \"{mechanism}\"\n{name} = {}\n",
                number(value, unit, known)
            );
        }
    }
    text + "\n[protocol]\ndrive = \"held\"\n"
}
