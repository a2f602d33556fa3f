//! This file says what a diagnosis does not explain and what it could not have seen.

use rigproof_diagnose::report::{Report, Unknown};

use super::found::at;
use super::number::{percent, significant, with_unit};
use super::section;

/// What stays beyond sensor noise, and what the recording cannot tell.
pub fn left_over(report: &Report) -> Vec<String> {
    let mut lines = Vec::new();
    lines.extend(report.floor.as_ref().map(|floor| {
        format!(
            "  the residual falls from {} to {} times what sensor noise predicts ({})",
            significant(floor.ratio_before, 3),
            significant(floor.ratio_after, 3),
            with_unit(floor.predicted, &floor.unit),
        )
    }));
    if !report.too_small_to_name.is_empty() {
        let names = report.too_small_to_name.join(", ");
        lines.push(format!("  too small to name: {names}"));
    }
    if !report.withdrawn.is_empty() {
        let names = report.withdrawn.join(", ");
        lines.push(format!(
            "  not named, because they only stand in for another law: {names}"
        ));
    }
    lines.extend(report.null_directions.iter().map(|null| {
        format!(
            "  the recording does not tell apart within {}: {}",
            null.mechanism, null.meaning
        )
    }));
    lines.extend(report.unknown.iter().flat_map(shape));
    section("What stays", lines)
}

fn shape(unknown: &Unknown) -> Vec<String> {
    let branches = if unknown.memory {
        "the rising and the falling branch differ"
    } else {
        "both branches agree"
    };
    let unit = match unknown.variable_unit.as_str() {
        "" | "1" => String::new(),
        unit => format!(" ({unit})"),
    };
    vec![
        format!(
            "  a {} over {}{unit} takes away {} of it, {} in that variable, {branches}",
            if unknown.along_motion {
                "friction level"
            } else {
                "curve"
            },
            unknown.variable,
            percent(unknown.share),
            match unknown.parity {
                "neither" => "neither odd nor even",
                parity => parity,
            },
        ),
        format!("  {}", unknown.suggestion),
    ]
}

/// From which size on each mechanism would have been named.
pub fn not_seen(report: &Report) -> Vec<String> {
    let lines = report.not_seen.iter().map(|bound| {
        format!(
            "  {:<34} from {}",
            format!("{} {}", at(bound.mechanism, bound.joint), bound.parameter),
            with_unit(bound.minimum_detectable, &bound.unit),
        )
    });
    section(
        "Not named, and from which size on each would have been",
        lines,
    )
}
