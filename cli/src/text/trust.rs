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
        "  with nothing left out, something was named in {}",
        rate(own.false_alarms)
    )];
    let exact = own.exact.iter();
    lines.extend(exact.map(|exact| {
        format!(
            "  with what was found left out, exactly that was named in {}",
            rate(*exact)
        )
    }));
    let each = |own: &NamedRate| format!("{} named in {}", own.name, rate(own.rate));
    lines.extend(own.found_again.iter().map(|own| {
        let doubt = match 2 * own.rate.count < own.rate.of {
            true => "; it imitates something else: do not believe it",
            false => "",
        };
        format!("  {}{doubt}", each(own))
    }));
    let wrong = own.false_names.iter();
    lines.extend(wrong.map(|own| format!("  named without being there: {}", each(own))));
    lines.push(format!("  simulated: {}", own.protocol));
    section("Tried on simulated recordings", lines)
}
