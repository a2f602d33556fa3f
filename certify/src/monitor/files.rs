//! This file writes a monitor down: its numbers as Rust, as C99, and as JSON with what they rest on.

use std::fmt::Write as _;

use rigproof_impl::monitor::constants::{Constants, NUMBERS};
use rigproof_spec::inertia::ArmInertia;
use rigproof_spec::tables::{BrakeTable, TimeConstantFit};
use serde_json::{Value, json};

use super::made::Made;
use crate::certificate::Certificate;
use crate::scenario::Rig;

/// The files of a monitor, in Rust, C and JSON.
pub const FILES: [&str; 3] = [
    "rigproof_monitor.rs",
    "rigproof_monitor_constants.h",
    "monitor.json",
];

/// What each number is called, with its unit.
const NAMES: [(&str, &str); NUMBERS] = [
    ("gain_a", "1"),
    ("gain_e", "1"),
    ("gain_b", "1"),
    ("gain_c", "1"),
    ("friction_a", "N·m"),
    ("friction_e", "N·m"),
    ("friction_b", "N·m"),
    ("friction_c", "N·m"),
    ("bias_a", "N·m"),
    ("bias_b", "N·m"),
    ("slowness_a", "1"),
    ("slowness_e", "1"),
    ("slowness_b", "1"),
    ("slowness_c", "1"),
    ("mass_aed", "1"),
    ("mass_bcd", "1"),
    ("payload", "1"),
];

const fn name(rig: Rig) -> &'static str {
    match rig {
        Rig::ThreeBrake => "THREE_BRAKE",
        Rig::FourBrake => "FOUR_BRAKE",
    }
}

fn of_which(certificate: &Certificate) -> String {
    // What people call a change may hold anything; a comment ends nowhere but at its end.
    let shown = certificate.name.chars().map(|own| match own {
        own if own.is_alphanumeric() || " _-.,".contains(own) => own,
        _ => '_',
    });
    format!(
        "Monitor of the certificate \"{}\", SHA-256 {}. Made by `rigproof certify monitor`.",
        shown.collect::<String>(),
        certificate.digest
    )
}

/// The numbers as Rust, for `rigproof_impl::monitor::Monitor`.
pub fn source(certificate: &Certificate, all: &[Made]) -> String {
    let mut text = format!(
        "//! {}\n\nuse rigproof_impl::monitor::constants::Constants;\nuse rigproof_spec::inertia::{{ArmInertia, Inertia}};\nuse rigproof_spec::tables::{{BrakeTable, TimeConstantFit, TorqueGainFit}};\n",
        of_which(certificate)
    );
    for made in all {
        // Debug of a struct is how it is written, and of a number the shortest text that reads back as it.
        let Made { rig, constants, .. } = made;
        let _ = write!(
            text,
            "\n/// What is certified of this layout.\npub const {}: Constants = {constants:#?};\n",
            name(*rig)
        );
    }
    text
}

/// The numbers as C99, for `rigproof_tick.h`.
pub fn header(certificate: &Certificate, all: &[Made]) -> String {
    let mut text = format!(
        "/* {} */\n\n#ifndef RIGPROOF_MONITOR_CONSTANTS_H\n#define RIGPROOF_MONITOR_CONSTANTS_H\n\n#include \"rigproof_tick.h\"\n",
        of_which(certificate)
    );
    for made in all {
        let _ = write!(
            text,
            "\nstatic const RigproofMonitorConstants RIGPROOF_MONITOR_{} = {{\n{}}};\n",
            name(made.rig),
            fields(made)
        );
    }
    text + "\n#endif\n"
}

fn list(numbers: &[f64]) -> String {
    let each: Vec<String> = numbers.iter().map(|number| format!("{number:?}")).collect();
    format!("{{{}}}", each.join(", "))
}

fn fields(made: &Made) -> String {
    let of = &made.constants;
    let arm = |arm: &ArmInertia| list(&[arm.mass_kg, arm.inertia_kg_m2, arm.centre_m]);
    let inertia = &of.inertia;
    let arms = [&inertia.ae, &inertia.ed, &inertia.bc, &inertia.cd].map(arm);
    let brakes = of.brakes.each_ref().map(brake);
    let missed = of.missed_share;
    let all = [
        ("size", "sizeof(RigproofMonitorConstants)".to_owned()),
        ("version", "RIGPROOF_TICK_VERSION".to_owned()),
        ("brakes", made.rig.layout().brakes().len().to_string()),
        ("hold", of.hold.to_string()),
        ("longest_fault", of.longest_fault.to_string()),
        ("cells", format!("UINT64_C({})", of.cells)),
        ("arms", format!("{{{}}}", arms.join(", "))),
        ("payload_kg", format!("{:?}", inertia.payload_kg)),
        ("brake", format!("{{{}}}", brakes.join(",\n              "))),
        ("viscous_nm_s", list(&of.viscous_nm_s)),
        ("dry_nm", list(&of.dry_nm)),
        ("constant_nm", list(&of.constant_nm)),
        ("backlash_share", format!("{:?}", of.backlash_share)),
        ("low", list(&of.low)),
        ("high", list(&of.high)),
        ("spread", list(&of.spread)),
        ("memory_s", format!("{:?}", of.memory_s)),
        ("missed_share", list(&missed)),
        ("levels", list(&of.levels)),
        ("surprise", format!("{:?}", of.surprise)),
        ("tip_m", list(&of.tip_m)),
        ("speed_m_s", format!("{:?}", of.speed_m_s)),
        ("force_n", format!("{:?}", of.force_n)),
        ("far_m", format!("{:?}", of.far_m)),
        ("speeds_m_s", list(&of.speeds_m_s)),
        ("forces_n", list(&of.forces_n)),
    ];
    let each = all.map(|(field, value)| format!("    .{field} = {value},\n"));
    each.concat()
}

fn brake(table: &BrakeTable) -> String {
    let gain = &table.torque_gain;
    let fit = |fit: &TimeConstantFit| {
        list(&[
            fit.a_avg_s,
            fit.a_1,
            fit.a_2,
            fit.a_3,
            fit.a_4,
            fit.a_5,
            fit.a_6,
        ])
    };
    format!(
        "{{{:?}, {}, {}, {}, {}, {}}}",
        table.backlash_width_deg,
        list(&[gain.k_1, gain.k_2, gain.k_3, gain.k_4, gain.k_5]),
        fit(&table.rising),
        fit(&table.falling),
        list(&table.current_range_a),
        list(&table.speed_range_rpm)
    )
}

/// What a monitor says and rests on.
pub fn json(certificate: &Certificate, all: &[Made]) -> Value {
    let rigs: Vec<Value> = all.iter().map(of_rig).collect();
    json!({ "form": 1, "certificate": certificate.name, "digest": certificate.digest, "rigs": rigs })
}

fn of_rig(made: &Made) -> Value {
    let of: &Constants = &made.constants;
    let ends = of.low.iter().zip(&of.high);
    let basis = ends.zip(&made.basis.tails).zip(NAMES);
    let numbers = basis.map(|(((low, high), tail), (name, unit))| {
        json!({ "name": name, "unit": unit, "low": low, "high": high, "deviations": tail })
    });
    json!({
        "rig": made.rig,
        "numbers": numbers.collect::<Vec<_>>(),
        "surprise": made.basis.surprise,
        "coverage": {
            "tip_m": of.tip_m, "speed_m_s": of.speed_m_s, "force_n": of.force_n, "cells": of.cells.count_ones(),
            "hold_samples": of.hold, "longest_fault_samples": of.longest_fault,
        },
        "trials": made.basis.trials,
        "samples": made.basis.samples,
        "use_samples": made.basis.use_samples,
        "quiet_samples": made.basis.quiet_samples,
    })
}
