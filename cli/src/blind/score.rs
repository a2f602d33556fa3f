//! This file opens a sealed answer and says how a report did.

use std::path::PathBuf;

use rigproof_blind::{Answer, Forms, Judgement, Score, judge, open, score};
use rigproof_trace::store::read_text;
use serde_json::{Value, json};

use super::truth;
use crate::outcome::{Failure, Outcome, print};
use crate::text::number::{percent, significant};
use crate::text::{join, section};

/// What is to be scored.
#[derive(clap::Args)]
#[command(after_help = AFTER_HELP)]
pub struct Args {
    /// The sealed answer
    answer: PathBuf,
    /// The report.json of a diagnosis
    report: PathBuf,
    /// Print the result as JSON
    #[arg(long)]
    json: bool,
}

const AFTER_HELP: &str = "\
Example:
  rigproof blind score case/answer.sealed found/report.json";

/// Scores a report.
pub fn run(args: &Args) -> Result<Outcome, Failure> {
    let sealed = read_text(&args.answer)?;
    let answer =
        open(&sealed).map_err(|error| Failure::unusable(&args.answer, error.to_string()))?;
    let text = read_text(&args.report)?;
    let report: Value = serde_json::from_str(&text).map_err(|error| {
        Failure::unusable(
            &args.report,
            format!("{error}; give the report.json that a diagnosis wrote"),
        )
    })?;
    let score = score(&answer, &report)
        .map_err(|error| Failure::unusable(&args.report, error.to_string()))?;
    let judgement = match answer.forms {
        Forms::Usual => None,
        Forms::Other => Some(
            judge(&answer, &report)
                .map_err(|error| Failure::unusable(&args.report, error.to_string()))?,
        ),
    };
    if args.json {
        return print(
            &match judgement {
                None => json!({ "answer": answer, "score": score }),
                Some(judgement) => json!({ "answer": answer, "judgement": judgement }),
            }
            .to_string(),
        );
    }
    print(&match judgement {
        None => in_words(&answer, &report, &score),
        Some(judgement) => judged_in_words(&answer, &report, &judgement),
    })
}

/// The same for physics in other forms.
fn judged_in_words(answer: &Answer, report: &Value, judgement: &Judgement) -> String {
    let effects = answer.effects.iter();
    let right = effects.map(|effect| format!("  {}: {}", effect.form, effect.right.join(" or ")));
    join([
        section(
            &format!("Hidden ({}, other forms)", answer.stratum.name()),
            truth(answer),
        ),
        section("Right names", right),
        section("Named", named(report)),
        section("Judgement", [format!("  {}", judgement.outcome.words())]),
    ])
}

/// What was hidden beside what was named.
pub fn in_words(answer: &Answer, report: &Value, score: &Score) -> String {
    join([
        section(
            &format!("Hidden ({})", answer.stratum.name()),
            truth(answer),
        ),
        section(&format!("Named ({})", score.verdict), named(report)),
        section("Score", lines(score)),
    ])
}

/// The mechanisms that a report names.
pub fn named(report: &Value) -> Vec<String> {
    let effects = report.get("effects").and_then(Value::as_array);
    let effects = effects.into_iter().flatten();
    let lines = effects.map(|effect| {
        let name = effect.get("mechanism").and_then(Value::as_str);
        let parameters = effect.get("parameters").and_then(Value::as_object);
        let numbers = parameters.into_iter().flatten().map(|(name, number)| {
            let value = number.get("value").and_then(Value::as_f64);
            let unit = number.get("unit").and_then(Value::as_str);
            let unit = unit.unwrap_or_default();
            format!(
                "{name} = {}",
                crate::text::number::stated(value.unwrap_or(f64::NAN), unit)
            )
        });
        let numbers: Vec<String> = numbers.collect();
        let onset = effect.get("onset_s").and_then(Value::as_f64);
        let onset = onset.map_or_else(String::new, |onset_s| {
            format!(", beginning at {} s", significant(onset_s, 4))
        });
        let joint = effect.get("joint").and_then(Value::as_str);
        let joint = joint.map_or_else(String::new, |joint| format!(" at {joint}"));
        format!(
            "  {}{joint}: {}{onset}",
            name.unwrap_or("?"),
            numbers.join(", ")
        )
    });
    let lines: Vec<String> = lines.collect();
    if lines.is_empty() {
        vec!["  nothing".to_owned()]
    } else {
        lines
    }
}

fn lines(score: &Score) -> Vec<String> {
    let yes = |holds: bool| if holds { "yes" } else { "no" };
    let mut lines = vec![
        format!("  the names are the true ones: {}", yes(score.exact)),
        format!(
            "  the mechanisms are, at any joint: {}",
            yes(score.mechanism_exact)
        ),
        format!(
            "  the truth is named, ambiguous with a name, or equivalent: {}",
            yes(score.inside)
        ),
        match score.false_names.as_slice() {
            [] => "  false names: none".to_owned(),
            names => format!("  false names: {}", names.join(", ")),
        },
        format!("  says that no name can be given: {}", yes(score.flagged)),
    ];
    lines.extend(
        score
            .onset_error_s
            .map(|error_s| format!("  onset is off by {} s", significant(error_s, 3))),
    );
    lines.extend(score.parameters.iter().map(|error| {
        let covered = match error.covered {
            Some(true) => "; its interval holds the truth",
            Some(false) => "; its interval misses the truth",
            None => "",
        };
        let relative = if error.relative < 0.1 {
            format!("{} %", significant(100.0 * error.relative, 2))
        } else {
            percent(error.relative)
        };
        format!(
            "  {} {} is off by {relative}{covered}",
            error.mechanism, error.name
        )
    }));
    lines
}
