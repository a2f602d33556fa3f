//! This file says where a recording disagrees, how the cause was named, and what it is.

use rigproof_diagnose::report::{EffectReport, Located, Number, Report};

use rigproof_report::words::called_at;

use super::number::{percent, probability, significant, with_interval};
use super::section;

/// Regimes that are printed; the report holds all.
const PLACES: usize = 3;

/// Where the nominal model fails most.
pub fn place(report: &Report) -> Vec<String> {
    let lines = report.located.iter().take(PLACES).map(|place| {
        format!(
            "  {:<38} {} of the unexplained energy (95 %: {} to {}), in {} of the time",
            regime(place),
            percent(place.share),
            percent(place.share_low95),
            percent(place.share_high95),
            percent(place.share_of_time),
        )
    });
    section("Where the model is wrong", lines)
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
    let mut lines = vec![line(
        "model as described",
        floor.measured_before,
        String::new(),
    )];
    lines.extend(report.stages.iter().map(|stage| {
        let standing = format!("   with {}", stage.standing.join(", "));
        let entered = at(stage.entered, stage.joint);
        line(&format!("+ {entered}"), stage.residual, standing)
    }));
    if !report.stages.is_empty() {
        lines.push(line(
            "with all that is named",
            floor.measured_after,
            String::new(),
        ));
    }
    lines.push(line("sensor noise alone", floor.predicted, String::new()));
    let heading = format!(
        "How the residual fell as names were added (root mean square, {})",
        floor.unit
    );
    section(&heading, lines)
}

/// The inverse model of each stage, for comparison with published figures.
pub fn inverse(report: &Report) -> Vec<String> {
    let Some(inverse) = &report.inverse_model else {
        return Vec::new();
    };
    let line = |what: &str, percent: f64| format!("  {what:<26} {percent:>11.4} %");
    let mut lines = vec![line("model as described", inverse.nominal_error_percent)];
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
        "Inverse model, filtered as published, for comparison with figures of others",
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
        called_at(effect.mechanism, effect.joint),
        effect.equation
    )];
    let parameters = effect.parameters.iter();
    lines
        .extend(parameters.map(|(name, number)| format!("    {name} = {}", with_interval(number))));
    lines.extend(onset(effect));
    lines.push(format!(
        "    probability {}; without it left-out blocks are predicted worse by {:.1} standard errors; named again in {} of the resampled recordings",
        probability(effect.probability),
        effect.z,
        percent(effect.inclusion),
    ));
    if !rivals.is_empty() {
        lines.push(format!(
            "    this recording cannot rule out in its place: {}",
            rivals.join(", ")
        ));
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
    section("The model's own numbers after the fit", lines)
}
