//! This file says where a recording disagrees, how the cause was named, and what it is.

use rigproof_diagnose::report::{EffectReport, Located, Number, Report};

use super::number::{percent, significant, with_interval};
use super::section;

/// Regimes that are printed; the report holds all.
const PLACES: usize = 3;

/// Where the nominal model fails most.
pub fn place(report: &Report) -> Vec<String> {
    let lines = report.located.iter().take(PLACES).map(|place| {
        format!(
            "  {:<38} {} of what is unexplained (95 %: {} to {}), in {} of the time",
            regime(place),
            percent(place.share),
            percent(place.share_low95),
            percent(place.share_high95),
            percent(place.share_of_time),
        )
    });
    section("Where the nominal model fails", lines)
}

/// A name with its joint, where there are several.
pub fn at(name: &str, joint: Option<&str>) -> String {
    match joint {
        Some(joint) => format!("{name} at {joint}"),
        None => name.to_owned(),
    }
}

/// A regime with its joint, where there are several.
pub fn regime(place: &Located) -> String {
    match place.joint {
        Some(joint) => format!("joint {joint}, {}", place.regime),
        None => place.regime.clone(),
    }
}

/// How the mechanisms were named, one after another.
pub fn naming(report: &Report) -> Vec<String> {
    let Some(floor) = &report.floor else {
        return Vec::new();
    };
    let line = |what: &str, residual: f64, standing: String| {
        format!("  {what:<26} {:>11}{standing}", significant(residual, 4))
    };
    let mut lines = vec![line("nominal model", floor.measured_before, String::new())];
    lines.extend(report.stages.iter().map(|stage| {
        let standing = format!("   with {}", stage.standing.join(", "));
        let entered = at(stage.entered, stage.joint);
        line(&format!("+ {entered}"), stage.residual, standing)
    }));
    if !report.stages.is_empty() {
        lines.push(line("what is named", floor.measured_after, String::new()));
    }
    lines.push(line(
        "sensor noise predicts",
        floor.predicted,
        String::new(),
    ));
    let heading = format!("How it was named (residual of the windows, {})", floor.unit);
    section(&heading, lines)
}

/// The inverse model of each stage, for comparison with published figures.
pub fn inverse(report: &Report) -> Vec<String> {
    let Some(inverse) = &report.inverse_model else {
        return Vec::new();
    };
    let line = |what: &str, percent: f64| format!("  {what:<26} {percent:>11.4} %");
    let mut lines = vec![line("nominal model", inverse.nominal_error_percent)];
    lines.extend(report.stages.iter().filter_map(|stage| {
        let percent = stage.inverse_error_percent?;
        let with = stage.standing.join(", ");
        Some(format!(
            "{}   with {with}",
            line(&format!("+ {}", stage.entered), percent)
        ))
    }));
    lines.push(format!("  {}", inverse.protocol));
    section(
        "Inverse model under the published filter protocol (no verdict rests on it)",
        lines,
    )
}

/// The mechanisms that are named.
pub fn effects(report: &Report) -> Vec<String> {
    let none: &[String] = &[];
    let rivals = report.ambiguous_with.iter().map(Vec::as_slice);
    let rivals = rivals.chain(std::iter::repeat(none));
    let lines = report.effects.iter().zip(rivals);
    section(
        "What the model left out",
        lines.flat_map(|(effect, rivals)| one(effect, rivals)),
    )
}

fn one(effect: &EffectReport, rivals: &[String]) -> Vec<String> {
    let mut lines = vec![format!(
        "  {}: {}",
        at(effect.mechanism, effect.joint),
        effect.equation
    )];
    let parameters = effect.parameters.iter();
    lines
        .extend(parameters.map(|(name, number)| format!("    {name} = {}", with_interval(number))));
    lines.extend(onset(effect));
    lines.push(format!(
        "    z = {:.1} against the model without it; stays in {} of the resampled recordings; takes away {} of the loss",
        effect.z,
        percent(effect.inclusion),
        percent(effect.share_explained),
    ));
    if !rivals.is_empty() {
        lines.push(format!("    cannot be told from: {}", rivals.join(", ")));
    }
    lines.push(format!("    would be refuted by: {}", effect.refuted_by));
    lines
}

fn onset(effect: &EffectReport) -> Option<String> {
    let onset = Number {
        value: effect.onset_s?,
        unit: "s".to_owned(),
        low95: effect.onset_low95_s,
        high95: effect.onset_high95_s,
    };
    Some(format!("    begins at {}", with_interval(&onset)))
}

/// The numbers of the nominal model after the fit.
pub fn nominal(report: &Report) -> Vec<String> {
    let numbers = report.nominal.iter();
    let lines = numbers.map(|(name, number)| format!("  {name} = {}", with_interval(number)));
    section("The nominal model's own numbers after the fit", lines)
}
