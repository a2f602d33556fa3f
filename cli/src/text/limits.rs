//! This file says what a diagnosis does not explain and what it could not have seen.

use rigproof_diagnose::report::{HeldJoint, Report, Unknown};
use rigproof_report::words::at_rest;

use super::found::at;
use super::number::{percent, significant, with_unit};
use super::section;

/// What stays beyond sensor noise, and what the recording cannot tell.
pub fn left_over(report: &Report) -> Vec<String> {
    let mut lines = Vec::new();
    lines.extend(report.floor.as_ref().map(|floor| {
        format!(
            "  the residual is {} times the sensor noise before and {} times after (noise: {})",
            significant(floor.ratio_before, 3),
            significant(floor.ratio_after, 3),
            with_unit(floor.predicted, &floor.unit),
        )
    }));
    if !report.withdrawn.is_empty() {
        let names = report.withdrawn.join(", ");
        lines.push(format!(
            "  not named, because no real plant has such a value: {names}"
        ));
    }
    lines.extend(report.null_directions.iter().map(|null| {
        format!(
            "  not identifiable within {}: {}",
            null.mechanism, null.meaning
        )
    }));
    lines.extend(report.unknown.iter().flat_map(shape));
    section("What is still unexplained", lines)
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
            "  a {} over {}{unit} removes {} of it; it is {} in that variable, and {branches}",
            if unknown.along_motion {
                "friction level"
            } else {
                "curve"
            },
            match unknown.joint {
                Some(joint) => format!("{} of {joint}", unknown.variable),
                None => unknown.variable.to_owned(),
            },
            percent(unknown.share),
            match unknown.parity {
                "neither" => "neither odd nor even",
                parity => parity,
            },
        ),
        format!("  {}", unknown.suggestion),
    ]
}

/// What brakes at rest were pushed with, beside what they can hold.
pub fn held(report: &Report) -> Vec<String> {
    let Some(held) = &report.held else {
        return Vec::new();
    };
    let joints = held.joints.iter().map(|own| pushed(own, &held.unit));
    let all = (held.all_seen_s > 0.0).then(|| {
        format!(
            "  all brakes at rest for {}: their holding torques cannot be told apart",
            with_unit(held.all_seen_s, "s")
        )
    });
    section("Pushed and did not move (not fitted)", joints.chain(all))
}

fn pushed(own: &HeldJoint, unit: &str) -> String {
    let torque = |size: f64| with_unit(size, unit);
    let holds = match own.holds == own.holds_nominal {
        true => format!("holds up to {}", torque(own.holds)),
        false => format!(
            "holds up to {}, {} with what is named",
            torque(own.holds_nominal),
            torque(own.holds)
        ),
    };
    format!(
        "  {}, alone at rest for {}: pushed with {} ± {} at {}; {holds}: {}",
        own.joint,
        with_unit(own.seen_s, "s"),
        significant(own.pushed, 3),
        with_unit(own.pushed_deviation, unit),
        with_unit(own.at_s, "s"),
        at_rest(own, unit),
    )
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
        "Not seen: an effect smaller than this could hide in the recording",
        lines,
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_missing_is_said_of_the_names_first() {
        let said = |holds: f64, named_at_least: f64, missing: f64| {
            let own = HeldJoint {
                joint: "E",
                seen_s: 0.34,
                at_s: 2.7,
                pushed: 0.61,
                pushed_deviation: 0.004,
                holds_nominal: 0.21,
                holds,
                named_at_least,
                missing,
            };
            pushed(&own, "N·m")
        };
        let line = said(0.21, 0.0, 0.0);
        assert!(
            line.ends_with(
                "pushed with 0.610 ± 0.00400 N·m at 2.70 s; holds up to 0.210 N·m: agrees"
            ),
            "{line}"
        );
        let line = said(0.67, 0.38, 0.0);
        assert!(
            line.ends_with("0.670 N·m with what is named: agrees, and of this what is named has to hold at least 0.380 N·m"),
            "{line}"
        );
        let line = said(0.33, 0.38, 0.26);
        assert!(
            line.ends_with("at least 0.260 N·m of what holds it is not named"),
            "{line}"
        );
    }
}
