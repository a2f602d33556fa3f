//! This file makes the monitor of a certificate that holds: numbers in Rust, C and JSON that say when the rig has left it.

use std::path::PathBuf;

use rigproof_certify::monitor::{self, FILES, Made};
use rigproof_trace::store::{Folder, read_text};

use super::check;
use super::compiled::{Compiled, sources};
use crate::outcome::{Failure, Outcome, print};
use crate::text::number::significant;
use crate::threads;

/// What a monitor is made of.
#[derive(clap::Args)]
#[command(after_help = AFTER_HELP)]
pub struct Args {
    /// The certificate
    #[arg(value_name = "CERTIFICATE.JSON")]
    certificate: PathBuf,
    /// The folder for the monitor's files
    #[arg(long, value_name = "FOLDER")]
    out: PathBuf,
    /// Trials of the certificate that are run again at most: what they cover is covered
    #[arg(long, value_name = "N", default_value_t = 1000, value_parser = clap::value_parser!(u64).range(1..))]
    sample: u64,
    /// Trials that run at once; 0 takes every processor. The result does not depend on it
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = threads::parse)]
    jobs: usize,
    #[command(flatten)]
    compiled: Compiled,
    /// Print what the monitor says and rests on as JSON
    #[arg(long)]
    json: bool,
}

const AFTER_HELP: &str = "\
The certificate is checked first. One that does not hold, or says that the controller must not go on the rig, gets no monitor: exit code 1.
rigproof_monitor.rs is for `rigproof_impl::monitor::Monitor`, rigproof_monitor_constants.h for `rigproof_monitor_create` of rigproof_tick.h.

Example:
  rigproof certify monitor certified/certificate.json --out monitor";

/// Makes it.
pub fn run(args: &Args) -> Result<Outcome, Failure> {
    let threads = threads::pool(args.jobs)?;
    let (text, seed) = (read_text(&args.certificate)?, check::unforeseen()?);
    let (file, compiled) = (&args.certificate, &args.compiled);
    let sample = args.sample.min(SAMPLE);
    let looked = || check::looked_through(&text, file, compiled, sample, seed);
    let (certificate, checked) = threads.install(looked)?;
    if !checked.wrong.is_empty() {
        let wrong = checked.wrong.join("; ");
        return refused(&format!(
            "the certificate does not hold, and gets no monitor: {wrong}"
        ));
    }
    if !certificate.may_go() {
        let reasons = certificate.reasons.join("; ");
        return refused(&format!(
            "by the certificate the controller must not go on the rig, and gets no monitor: {reasons}"
        ));
    }
    let opened = compiled.opened_again(&certificate.plan.controller)?;
    let sources = sources(&certificate.plan, opened.as_ref())?;
    let made = threads.install(|| monitor::made(&certificate, sources.controller, args.sample));
    let made = made.map_err(|why| Failure::unusable(file, why.to_string()))?;
    let said = monitor::json(&certificate, &made);
    let json = serde_json::to_string_pretty(&said)
        .map_err(|error| Failure::Input(format!("cannot write the monitor as JSON: {error}")))?;
    let folder = Folder::begin(&args.out)?;
    let texts = [
        monitor::source(&certificate, &made),
        monitor::header(&certificate, &made),
        json.clone() + "\n",
    ];
    for (name, text) in FILES.into_iter().zip(texts) {
        folder.write(name, text.as_bytes())?;
    }
    folder.finish()?;
    if args.json {
        return print(&json);
    }
    let lines: Vec<String> = made.iter().map(words).collect();
    print(&format!(
        "{}\nWritten to {}: {}.",
        lines.join("\n"),
        args.out.display(),
        FILES.join(", ")
    ))
}

/// Scenarios that the check runs again before: as of `--check`. Those that the monitor rests on are run besides.
const SAMPLE: u64 = 64;

/// Says why there is no monitor.
fn refused(why: &str) -> Result<Outcome, Failure> {
    print(&format!("No monitor: {why}."))?;
    Ok(Outcome { checks_hold: false })
}

/// What a monitor watches, in a sentence.
fn words(made: &Made) -> String {
    let (of, basis) = (&made.constants, &made.basis);
    let [from_x, to_x, from_y, to_y] = of.tip_m.map(|m| significant(100.0 * m, 3));
    format!(
        "{} brakes: tip within x {from_x} to {to_x} cm and y {from_y} to {to_y} cm, up to {} m/s and {} N, as in {} trials ({} samples). It lets go {} ms after the rig left that.",
        made.rig.layout().brakes().len(),
        significant(of.speed_m_s, 3),
        significant(of.force_n, 3),
        basis.trials,
        basis.samples,
        of.hold
    )
}
