//! This file says how far a diagnosis can be believed, by simulated recordings whose causes are known.

use rigproof_diagnose::report::{NamedRate, Report};

use super::number::rate;
use super::section;

/// What the diagnosis said of simulated recordings.
pub fn simulated(report: &Report) -> Vec<String> {
    let Some(own) = &report.self_calibration else {
        return Vec::new();
    };
    let mut lines = vec![format!(
        "  nothing left out: something named in {}",
        rate(own.false_alarms)
    )];
    let exact = own.exact.iter();
    lines.extend(exact.map(|exact| {
        format!(
            "  what was found left out: named, and nothing else, in {}",
            rate(*exact)
        )
    }));
    let each = |own: &NamedRate| format!("{} named in {}", own.name, rate(own.rate));
    lines.extend(own.found_again.iter().map(|own| {
        let doubt = match 2 * own.rate.count < own.rate.of {
            true => "; it stands in for something else: do not believe it",
            false => "",
        };
        format!("  {}{doubt}", each(own))
    }));
    let wrong = own.false_names.iter();
    lines.extend(wrong.map(|own| format!("  without being there: {}", each(own))));
    lines.push(format!("  simulated: {}", own.protocol));
    section("How far to believe it", lines)
}
