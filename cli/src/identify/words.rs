//! This file says what was identified: for a person and as JSON.

use std::path::Path;

use rigproof_diagnose::identify::Identified;
use rigproof_spec::units::{deg_from_rad, rpm_from_rad_s};
use rigproof_trace::rig::{Gain, Surface, Value as Number};
use serde_json::{Value, json};

use crate::text::number::{significant, with_unit};
use crate::text::section;

/// The brake's table in sections.
pub fn sections(found: &Identified, recordings: usize) -> Vec<Vec<String>> {
    let brake = &found.brake;
    let head = format!(
        "{} steps, {} settled torques and {} reversals in {recordings} recordings",
        found.steps.len(),
        found.steady.len(),
        found.reversals.len()
    );
    let scatter = found
        .scatter
        .iter()
        .map(|(current_a, deviation_nm, count)| {
            let deviation = with_unit(*deviation_nm, "N·m");
            format!("  at {current_a:.2} A {deviation} over {count}")
        });
    let width = brake.backlash_width.as_ref().map(|width| {
        let line = interval(width, deg_from_rad, "°");
        format!("  {line}")
    });
    vec![
        vec![head],
        section(
            &heading(
                "Torque gain (3.3)",
                brake.torque_gain.as_ref().and_then(|g| g.r_squared),
            ),
            gain(brake.torque_gain.as_ref()),
        ),
        section(
            &heading(
                "Rising time constant (3.5)",
                r_squared(brake.rising.as_ref()),
            ),
            surface(brake.rising.as_ref()),
        ),
        section(
            &heading(
                "Falling time constant (3.6)",
                r_squared(brake.falling.as_ref()),
            ),
            surface(brake.falling.as_ref()),
        ),
        section("Backlash width", width),
        section("Standard deviation of the settled torque", scatter),
        section(
            "Not identified",
            found.missing.iter().map(|line| format!("  {line}")),
        ),
        section(
            "Left out",
            found.left_out.iter().map(|line| format!("  {line}")),
        ),
    ]
}

fn r_squared(surface: Option<&Surface>) -> Option<f64> {
    surface.and_then(|surface| surface.r_squared)
}

fn heading(what: &str, r_squared: Option<f64>) -> String {
    match r_squared {
        Some(r_squared) => format!("{what}, R² {r_squared:.4}"),
        None => what.to_owned(),
    }
}

const GAIN_UNITS: [&str; 5] = ["N·m/A", "N·m", "N·m/A²", "N·m/A", "N·m"];
const SURFACE_UNITS: [&str; 6] = ["ms/A", "ms", "ms/A", "ms", "ms/A", "ms"];

fn gain(gain: Option<&Gain>) -> Vec<String> {
    let named = gain
        .iter()
        .flat_map(|gain| gain.k.iter().zip(GAIN_UNITS))
        .enumerate();
    named
        .map(|(index, (k, unit))| format!("  k{}  {}", index + 1, interval(k, |x| x, unit)))
        .collect()
}

fn surface(surface: Option<&Surface>) -> Vec<String> {
    let Some(surface) = surface else {
        return Vec::new();
    };
    let milli = |seconds: f64| 1e3 * seconds;
    let mut lines = vec![format!(
        "  a_avg {}",
        interval(&surface.average, milli, "ms")
    )];
    let named = surface.a.iter().flatten().zip(SURFACE_UNITS).enumerate();
    lines.extend(
        named.map(|(index, (a, unit))| format!("  a{}    {}", index + 1, interval(a, milli, unit))),
    );
    lines
}

fn interval(number: &Number, turn: impl Fn(f64) -> f64, unit: &str) -> String {
    let value = with_unit(turn(number.value), unit);
    match (number.low95, number.high95) {
        (Some(low), Some(high)) => format!(
            "{value}   (95 %: {} to {})",
            significant(turn(low), 4),
            significant(turn(high), 4)
        ),
        _ => format!("{value}   (no interval)"),
    }
}

/// The result as JSON, in SI units.
pub fn json(found: &Identified, file: Option<&Path>, refused: Option<&str>) -> Value {
    let brake = &found.brake;
    let gain = brake.torque_gain.as_ref().map(|gain| {
        json!({ "k": gain.k.each_ref().map(number), "r_squared": gain.r_squared, "greatest_current_a": gain.greatest_current.value })
    });
    let surface = |surface: &Option<Surface>| {
        surface.as_ref().map(|s| {
            json!({
                "average_s": number(&s.average), "a": s.a.as_ref().map(|a| a.each_ref().map(number)),
                "r_squared": s.r_squared, "speed_range_rad_s": s.speed_range.map(|v| v.value),
            })
        })
    };
    let steps = found.steps.iter().map(|s| {
        json!({
            "recording": s.recording, "edge": s.edge.name(), "current_a": s.current_a,
            "speed_rpm": rpm_from_rad_s(s.omega_rad_s), "start_s": s.start_s, "time_constant_s": s.time_constant_s,
        })
    });
    let scatter = found.scatter.iter().map(|(current_a, deviation_nm, count)| {
        json!({ "current_a": current_a, "deviation_nm": deviation_nm, "count": count })
    });
    json!({
        "torque_gain": gain, "rising": surface(&brake.rising), "falling": surface(&brake.falling),
        "backlash_width_rad": brake.backlash_width.as_ref().map(number),
        "scatter": scatter.collect::<Vec<_>>(), "steps": steps.collect::<Vec<_>>(),
        "reversals": found.reversals.len(), "missing": found.missing, "left_out": found.left_out,
        "file": file.map(|file| file.display().to_string()), "refused": refused,
    })
}

fn number(number: &Number) -> Value {
    json!({ "value": number.value, "low95": number.low95, "high95": number.high95 })
}
