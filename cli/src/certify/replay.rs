//! This file runs a finding again.

use std::path::Path;

use rigproof_certify::finding::Finding;
use rigproof_spec::methods::SAMPLE_STEP_S;
use rigproof_trace::store::read_text;
use serde_json::json;

use super::Args;
use super::compiled::subject;
use crate::outcome::{Failure, Outcome, print};
use crate::text::number::significant;

/// Runs it, and says what broke.
pub fn run(args: &Args, file: &Path) -> Result<Outcome, Failure> {
    let finding = Finding::parse(&read_text(file)?, file)?;
    let compiled = args.compiled.opened_again(&finding.controller)?;
    let source = subject(&finding.controller, compiled.as_ref())?;
    let ran = finding.replayed(source)?;
    let again = ran.broken().find(|(law, _)| *law == finding.law);
    let law = finding.law;
    if args.json {
        let result = json!({
            "law": law, "words": law.words(), "broken_again": again.is_some(),
            "tick": again.and_then(|(_, fared)| fared.first),
            "margin": again.map(|(_, fared)| fared.worst), "unit": law.unit(),
            "failure": ran.failure.as_ref().map(ToString::to_string),
        });
        print(&result.to_string())?;
    } else {
        print(&match again {
            Some((_, fared)) => {
                let tick = fared.first.unwrap_or_default();
                let told = ran.told.get(tick as usize);
                let broke = ran.failure.as_ref();
                let broke = broke.map_or_else(String::new, |failure| format!("\n{failure}."));
                let currents = told.map_or_else(String::new, |(_, currents_a)| {
                    format!("; currents A, E, B, C: {currents_a:?} A")
                });
                format!(
                    "The law {} is broken again: {}.\nAt {} s, sample {tick}, margin {} {}{currents}.{broke}",
                    law.name(),
                    law.words(),
                    significant(f64::from(tick) * SAMPLE_STEP_S, 4),
                    significant(fared.worst, 3),
                    law.unit(),
                )
            }
            None => format!("The law {} holds this time.", law.name()),
        })?;
    }
    Ok(Outcome {
        checks_hold: again.is_none(),
    })
}
