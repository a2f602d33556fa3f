//! This file is the verb that tests the diagnosis with recordings whose cause is hidden.

mod claims;
mod faults;
mod make;
mod other;
mod page;
mod score;
mod seeds;
mod trial;

pub use make::{FILES, contents};
pub use score::in_words;

use clap::Subcommand;
use rigproof_blind::{Answer, Forms, HiddenEffect, Plant, Stratum};

use crate::outcome::{Failure, Outcome};

/// What is to be done with hidden causes.
#[derive(clap::Args)]
#[command(after_help = AFTER_HELP)]
pub struct Args {
    #[command(subcommand)]
    verb: Verb,
}

#[derive(Subcommand)]
enum Verb {
    /// Make a recording with a hidden cause and seal the answer
    Make(make::Args),
    /// Open a sealed answer and score a report against it
    Score(score::Args),
    /// Make, diagnose and score many recordings, and check what is claimed
    Trial(trial::Args),
}

const AFTER_HELP: &str = "\
Example:
  rigproof blind make --plant axis --seed 7 --out case
  rigproof diagnose case/recording.csv --rig case/rig.toml --out found
  rigproof blind score case/answer.sealed found/report.json";

/// Runs one of the verbs.
pub fn run(args: &Args) -> Result<Outcome, Failure> {
    match &args.verb {
        Verb::Make(args) => make::run(args),
        Verb::Score(args) => score::run(args),
        Verb::Trial(args) => trial::run(args),
    }
}

pub fn parse_plant(name: &str) -> Result<Plant, String> {
    Plant::from_name(name).map_err(|error| error.to_string())
}

fn parse_forms(name: &str) -> Result<Forms, String> {
    Forms::from_name(name).map_err(|error| error.to_string())
}

fn parse_stratum(name: &str) -> Result<Stratum, String> {
    Stratum::from_name(name).map_err(|error| error.to_string())
}

/// What was hidden, a line an effect.
pub fn truth(answer: &Answer) -> Vec<String> {
    if let Some(fault) = &answer.fault {
        return vec![format!(
            "  a fault of the recording: {}",
            fault.replace('_', " ")
        )];
    }
    if answer.effects.is_empty() {
        return vec!["  nothing".to_owned()];
    }
    answer.effects.iter().map(hidden).collect()
}

fn hidden(effect: &HiddenEffect) -> String {
    use crate::text::number::{significant, stated};
    let numbers = effect.parameters.iter();
    let numbers: Vec<String> = numbers
        .map(|p| format!("{} = {}", p.name, stated(p.value, &p.unit)))
        .collect();
    let onset = effect.onset_s.map_or_else(String::new, |onset_s| {
        format!(", beginning at {} s", significant(onset_s, 4))
    });
    let scope = effect.scope.as_ref();
    let scope = scope.map_or_else(String::new, |scope| format!(" at {scope}"));
    let form = match effect.form.as_str() {
        "" => String::new(),
        form => format!(" ({form})"),
    };
    format!(
        "  {}{scope}{form}: {}{onset}",
        effect.key(),
        numbers.join(", ")
    )
}
