//! This file runs a finding again.

use std::path::Path;

use rigproof_certify::finding::Finding;
use rigproof_certify::search::Worst;
use rigproof_spec::methods::SAMPLE_STEP_S;
use rigproof_trace::store::read_text;
use serde_json::json;

use super::Args;
use super::compiled::subject;
use crate::outcome::{Failure, Outcome, print};
use crate::text::number::significant;

/// Runs it, and says what broke.
pub fn run(args: &Args, file: &Path) -> Result<Outcome, Failure> {
    args.without_old()?;
    let text = read_text(file)?;
    // A worst case has a target where a finding has a law.
    if let Ok(worst) = Worst::parse(&text, file) {
        return worst_case(args, &worst);
    }
    let finding = Finding::parse(&text, file)?;
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

/// Runs a worst case again, and says what it comes to.
fn worst_case(args: &Args, worst: &Worst) -> Result<Outcome, Failure> {
    let compiled = args.compiled.opened_again(&worst.controller)?;
    let source = subject(&worst.controller, compiled.as_ref())?;
    let again = worst.replayed(source)?;
    let is_same = again.is_same;
    let (name, unit) = (worst.target.name(), worst.target.unit());
    if args.json {
        let result = json!({
            "target": name, "unit": unit, "found": worst.found, "again": again.value, "same": is_same,
        });
        print(&result.to_string())?;
    } else {
        let again = again
            .value
            .map_or("nothing".to_owned(), |again| significant(again, 6));
        let end = match is_same {
            true => "to the bit what was found",
            false => "it does NOT come out as it was found",
        };
        print(&format!("{name} is {again} {unit}: {end}."))?;
    }
    Ok(Outcome {
        checks_hold: is_same,
    })
}
