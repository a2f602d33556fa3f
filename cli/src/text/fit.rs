//! This file says how far the model lies from the recording, before and after.

use rigproof_diagnose::report::{BeforeAfter, HELD_OUT_PART, Horizon, Report};

use super::number::{percent, significant};
use super::section;

/// The errors before and after, on what was fitted and on what was not.
pub fn before_after(report: &Report) -> Vec<String> {
    let Some(fit) = &report.fit else {
        return Vec::new();
    };
    let unit = fit.unit.as_str();
    let mut lines = vec![part("fitted data", fit.train, unit)];
    lines.extend(
        fit.held_out
            .map(|errors| part("held-out data", errors, unit)),
    );
    let alone = |error: f64, how: &str| {
        let error = significant(error, 4);
        format!("  {:<26} {error} {unit} {how}", "held-out data")
    };
    let windows = fit.held_out_without_refit;
    lines.extend(windows.map(|error| {
        alone(
            error,
            "with the numbers of the first fit, before free runs refine them",
        )
    }));
    let rest = fit.held_out_from_rest;
    lines.extend(rest.map(|error| alone(error, "started from rest, without a warm-up")));
    lines.extend(fit.horizon.iter().map(ahead));
    if report.changes_the_model() {
        lines.push(if fit.improved {
            let share = percent(fit.recovered_share);
            format!("  {share} of what a perfect model would gain on held-out data is gained")
        } else {
            "  held-out data did not improve: do not use this calibration".to_owned()
        });
    }
    let disagrees = fit.agreement.as_ref().and_then(|own| own.said(unit));
    lines.extend(disagrees.map(|said| format!("  {said}")));
    lines.extend(fit.drift.iter().map(|drift| format!("  {drift}")));
    section(
        "Error of the simulation (model as described → with what is named)",
        lines,
    )
}

/// The error some time after the recorded state; that of the held-out part unless it says otherwise.
fn ahead(horizon: &Horizon) -> String {
    let mut name = format!("{} s ahead", horizon.horizon_s);
    if horizon.part != HELD_OUT_PART {
        name = format!("{name}, {}", horizon.part);
    }
    let mut line = format!(
        "  {name:<26} {} → {} {}",
        significant(horizon.before, 4),
        significant(horizon.after, 4),
        horizon.unit,
    );
    if let (Some(before), Some(after)) = (horizon.tip_before_mm, horizon.tip_after_mm) {
        let (before, after) = (significant(before, 4), significant(after, 4));
        line.push_str(&format!(", tip {before} → {after} mm"));
    }
    line
}

fn part(name: &str, errors: BeforeAfter, unit: &str) -> String {
    format!(
        "  {name:<26} {} → {} {unit}   NRMSE {} % → {} %",
        significant(errors.before, 4),
        significant(errors.after, 4),
        significant(errors.nrmse_before, 3),
        significant(errors.nrmse_after, 3),
    )
}
