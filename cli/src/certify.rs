//! This file is the verb that says whether a changed controller may go on the rig.

mod axis;
mod campaign;
mod check;
mod compiled;
mod merge;
mod monitor;
mod page;
mod recordings;
mod replay;
mod replayed;
mod sign;
mod words;

pub use campaign::CERTIFICATE;

use std::path::PathBuf;

use clap::Subcommand;
use rigproof_certify::journal::Shard;
use rigproof_trace::store::read_text;

use crate::outcome::{Failure, Outcome};
use crate::threads;

/// What is to be certified.
#[derive(clap::Args)]
#[command(after_help = AFTER_HELP, args_conflicts_with_subcommands = true)]
pub struct Args {
    #[command(subcommand)]
    verb: Option<Verb>,
    /// What is to be certified: controller, baseline, layouts and limits, in TOML
    #[arg(value_name = "CERTIFY.TOML", required_unless_present_any = ["check", "replay"], conflicts_with_all = ["check", "replay"])]
    description: Option<PathBuf>,
    /// The folder for journal, certificate and findings; a campaign that was begun there goes on
    #[arg(long, value_name = "FOLDER", default_value = "certified")]
    out: PathBuf,
    /// Scenarios
    #[arg(long, value_name = "N", default_value_t = 1000, value_parser = clap::value_parser!(u64).range(1..=100_000_000))]
    scenarios: u64,
    /// Length of a trial, s
    #[arg(long, value_name = "S", default_value_t = 10.0, value_parser = parse_seconds)]
    seconds: f64,
    /// Seed of all scenarios; 1 where none is given. Of --check: which scenarios are run again; the clock's where none is given
    #[arg(long, value_name = "K")]
    seed: Option<u64>,
    /// Trials that run at once; 0 takes every processor. The result does not depend on it
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = threads::parse)]
    jobs: usize,
    /// Run the I-th of N parts, counted from 1, and leave the rest to others; `merge` joins them
    #[arg(long, value_name = "I/N", value_parser = parse_shard, default_value = "1/1")]
    shard: Shard,
    /// What `rigproof diagnose` found of this five-bar: the scenarios draw their plant within its intervals
    #[arg(long, value_name = "CALIBRATION.TOML", conflicts_with_all = ["check", "replay"])]
    calibration: Option<PathBuf>,
    /// Trials of a search for a worse case, for every law and metric, after the scenarios; it finds, and proves nothing
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = clap::value_parser!(u32).range(0..=1_000_000), conflicts_with_all = ["check", "replay"])]
    search: u32,
    /// Sign the certificate with this secret key, in PEM: certificate.json.sig beside it
    #[arg(long, value_name = "KEYFILE", conflicts_with_all = ["check", "replay"])]
    sign: Option<PathBuf>,
    /// Of --check: the certificate has to be signed by the owner of this key, in PEM
    #[arg(long, value_name = "FILE", requires = "check")]
    public_key: Option<PathBuf>,
    /// Check a certificate instead: every byte, every hash, every figure that its records allow, and a sample of its scenarios run again
    #[arg(long, value_name = "CERTIFICATE.JSON", conflicts_with = "replay")]
    check: Option<PathBuf>,
    /// Scenarios that are run again by --check, 64 if it is not given: with all of them it is a proof, and else a sample. Those of an axis are always all
    #[arg(long, value_name = "N", requires = "check")]
    sample: Option<u64>,
    /// Run a finding or a worst case again instead
    #[arg(long, value_name = "FINDING.JSON")]
    replay: Option<PathBuf>,
    /// Send recordings through the baseline and the controller instead, sample by sample: a file, or a folder of them
    #[arg(long, value_name = "FOLDER", requires = "rig", conflicts_with_all = ["check", "replay", "calibration", "search", "sign"])]
    recordings: Option<PathBuf>,
    /// Of --recordings: the five-bar that they are of
    #[arg(long, value_name = "RIG.TOML", requires = "recordings")]
    rig: Option<PathBuf>,
    /// Of --recordings, and of an axis: a compiled controller that is on the rig now, in place of the table `baseline`
    #[arg(long, value_name = "LIBRARY")]
    old: Option<PathBuf>,
    #[command(flatten)]
    compiled: compiled::Compiled,
    /// Print the result as JSON
    #[arg(long)]
    json: bool,
}

#[derive(Subcommand)]
enum Verb {
    /// Join the parts of a campaign into one certificate
    Merge(merge::Args),
    /// Make the monitor of a certificate: what says on the rig that it has left what was certified
    Monitor(monitor::Args),
    /// Make a key to sign certificates with
    Key(sign::Key),
    /// Sign a certificate
    Sign(sign::Sign),
}

const AFTER_HELP: &str = "\
Exit code 1 says that a law or a limit is broken, that a certificate does not hold, that a replayed finding breaks its law again, or that commands on recordings differ in what certify.toml does not expect.

Example:
  rigproof certify certify.toml --scenarios 1000 --out certified
  rigproof certify --replay certified/finding-gap.json
  rigproof certify --check certified/certificate.json
  rigproof certify declared.toml --controller mine.so --scenarios 200
  rigproof certify certify.toml --search 200 --sign lab.pem
  rigproof certify --check certified/certificate.json --public-key lab.pem.pub
  rigproof certify certify.toml --recordings runs --rig rig.toml
  rigproof certify monitor certified/certificate.json --out monitor
  rigproof certify axis.toml --controller pd.so --old before.so

certify.toml:
  [controller]
  kind = \"proportional\"
  gain_n_s_per_m = 400
  [baseline]
  named = \"proportional_low\"
  [regressions]
  tip_force_n = 0.5";

/// Runs a campaign, or looks at what one left.
pub fn run(args: &Args) -> Result<Outcome, Failure> {
    if let Some(recordings) = &args.recordings {
        return recordings::run(args, recordings);
    }
    match (&args.verb, &args.check, &args.replay, &args.description) {
        (Some(Verb::Merge(args)), ..) => merge::run(args),
        (Some(Verb::Monitor(args)), ..) => monitor::run(args),
        (Some(Verb::Key(args)), ..) => sign::make_key(args),
        (Some(Verb::Sign(args)), ..) => sign::sign(args),
        (_, Some(file), ..) => check::run(args, file),
        (_, _, Some(file), _) => replay::run(args, file),
        (.., Some(file)) => {
            let text = read_text(file)?;
            match axis::describes(&text, file)? {
                true => axis::run(args, file, &text),
                false => campaign::run(args, file, &text),
            }
        }
        _ => Err(Failure::Usage(
            "say what is to be certified: `rigproof certify certify.toml`".to_owned(),
        )),
    }
}

impl Args {
    /// Refuses a library beside a five-bar's campaign, whose baseline is a law of the rig.
    fn without_old(&self) -> Result<(), Failure> {
        match self.old {
            None => Ok(()),
            Some(_) => Err(Failure::Usage(
                "--old is of --recordings and of an axis; the baseline of a five-bar's campaign is the table [baseline]"
                    .to_owned(),
            )),
        }
    }
}

impl From<rigproof_certify::Error> for Failure {
    fn from(error: rigproof_certify::Error) -> Failure {
        Failure::Input(error.to_string())
    }
}

fn parse_seconds(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(seconds) if (0.05..=3600.0).contains(&seconds) => Ok(seconds),
        _ => Err("give a number of seconds from 0.05 to 3600".to_owned()),
    }
}

fn parse_shard(text: &str) -> Result<Shard, String> {
    let advice = || "write I/N with whole numbers, I from 1 to N, such as 2/8".to_owned();
    let (part, parts) = text.split_once('/').ok_or_else(advice)?;
    let number = |text: &str| text.trim().parse::<u64>().map_err(|_| advice());
    let (part, parts) = (number(part)?, number(parts)?);
    if (1..=parts).contains(&part) {
        Ok([part - 1, parts])
    } else {
        Err(advice())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_part_is_counted_from_one() {
        assert_eq!(parse_shard("2/8"), Ok([1, 8]));
        for text in ["0/8", "9/8", "2", "a/b", "1/0", "-1/2"] {
            assert!(parse_shard(text).is_err(), "{text}");
        }
    }
}
