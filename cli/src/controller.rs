//! This file runs what concerns compiled controllers: a try of one, and the process that one lives in.

use std::path::PathBuf;

use rigproof_certify::controller::Failure as Finding;
use rigproof_certify::foreign::{Foreign, Host, Limits};
use rigproof_certify_host::{Role, Tried, try_out};
use rigproof_spec::layout::Layout;
use serde_json::{Value, json};

use crate::outcome::{Failure, Outcome, print};

/// What is done with a compiled controller.
#[derive(clap::Args)]
#[command(after_help = AFTER_HELP, arg_required_else_help = true)]
pub struct Args {
    #[command(subcommand)]
    verb: Verb,
}

#[derive(clap::Subcommand)]
enum Verb {
    /// Open a compiled controller in a process of its own, run it for a moment, and say what happened
    Try(Try),
    /// The process that a compiled controller lives in; started by the program itself
    #[command(hide = true)]
    Host(HostArgs),
}

#[derive(clap::Args)]
#[command(after_help = AFTER_HELP_OF_TRY)]
struct Try {
    /// The shared library that exports the functions of rigproof_controller.h
    #[arg(value_name = "LIBRARY")]
    library: PathBuf,
    /// How many brakes the rig has: 3 (A, E, B) or 4 (A, E, B, C)
    #[arg(long, value_name = "NUMBER", default_value_t = 4, value_parser = clap::value_parser!(u8).range(3..=4))]
    brakes: u8,
    /// How many ticks are run
    #[arg(long, value_name = "NUMBER", default_value_t = 2000, value_parser = clap::value_parser!(u32).range(1..=10_000_000))]
    ticks: u32,
    #[command(flatten)]
    given: Given,
    /// Print the answer as JSON
    #[arg(long)]
    json: bool,
}

/// What a compiled controller is given.
#[derive(clap::Args)]
pub struct Given {
    /// Time for a tick, ms; a thousand samples, but at least 100 ms, if it is not given
    #[arg(long, value_name = "MS", value_parser = clap::value_parser!(u64).range(1..))]
    tick_ms: Option<u64>,
    /// Time for opening the library, for init and for shutdown, ms each; 5000 if it is not given
    #[arg(long, value_name = "MS", value_parser = clap::value_parser!(u64).range(1..))]
    start_ms: Option<u64>,
    /// Memory, and the largest file, MB; 512 if it is not given
    #[arg(long, value_name = "MB", value_parser = clap::value_parser!(u64).range(32..=1 << 20))]
    memory_mb: Option<u64>,
    /// Start a new process for every trial
    #[arg(long)]
    one_trial_a_process: bool,
}

impl Given {
    /// As the limits of a source.
    pub fn limits(&self) -> Limits {
        let usual = Limits::default();
        Limits {
            start_ms: self.start_ms.unwrap_or(usual.start_ms),
            tick_ms: self.tick_ms,
            memory_bytes: self.memory_mb.map_or(usual.memory_bytes, |mb| mb << 20),
            one_trial_a_process: self.one_trial_a_process,
        }
    }

    /// Whether anything was given.
    pub fn is_given(&self) -> bool {
        self.tick_ms.is_some()
            || self.start_ms.is_some()
            || self.memory_mb.is_some()
            || self.one_trial_a_process
    }
}

#[derive(clap::Args)]
#[command(after_help = AFTER_HELP_OF_HOST)]
struct HostArgs {
    /// What it does: watch or work
    #[arg(value_name = "ROLE", value_parser = |name: &str| Role::of(name).ok_or("it is watch or work"))]
    role: Role,
    /// The shared library
    library: PathBuf,
    /// The limit of memory, bytes
    memory_bytes: u64,
}

const AFTER_HELP: &str = "\
Example:
  rigproof controller try target/controllers/damper.so";

const AFTER_HELP_OF_TRY: &str = "\
The library exports the functions of certify/c/include/rigproof_controller.h; docs/controllers.md says how to build one.

Exit codes:
  0  it answered every tick with numbers
  1  it failed, in a tick, in init or in shutdown, or answered what is no number
  2  the command line is wrong
  3  the library cannot be read or used

Examples:
  rigproof controller try target/controllers/damper.so
  rigproof controller try target/controllers/damper.so --brakes 3 --memory-mb 128 --json";

const AFTER_HELP_OF_HOST: &str = "\
Standard input, output and error are the connections of the program that starts it.

Example:
  rigproof controller host watch target/controllers/damper.so 536870912";

/// The program that opens compiled controllers: this one.
///
/// # Errors
/// [`Failure`]: the system does not say where it is.
pub fn host() -> Result<Host, Failure> {
    let program = std::env::current_exe()
        .map_err(|error| Failure::Input(format!("cannot find the program itself: {error}")))?;
    let words = ["controller", "host"].map(Into::into);
    Ok(Host {
        program,
        words: words.into(),
    })
}

/// Runs what is asked. The process of a controller ends here.
pub fn run(args: &Args) -> Result<Outcome, Failure> {
    match &args.verb {
        Verb::Try(args) => tried(args),
        Verb::Host(args) => {
            let library = args.library.clone();
            let code = rigproof_certify_host::run(args.role, library, args.memory_bytes);
            std::process::exit(i32::from(code))
        }
    }
}

fn tried(args: &Try) -> Result<Outcome, Failure> {
    let source = Foreign::new(&args.library, host()?, args.given.limits());
    let source = source.map_err(|finding| Failure::Input(finding.to_string()))?;
    let layout = match args.brakes {
        3 => Layout::ThreeBrake,
        _ => Layout::FourBrake,
    };
    let answer = try_out(&source, layout, args.ticks);
    if let Err(Finding::Unusable(_)) = &answer
        && let Err(finding) = &answer
    {
        return Err(Failure::Input(finding.to_string()));
    }
    source.end();
    let between = source.between_trials();
    let after: Vec<String> = between.into_iter().map(|between| between.what).collect();
    let sound = after.is_empty() && matches!(&answer, Ok(tried) if tried.undefined == 0);
    let text = match args.json {
        true => format!("{:#}", as_json(args, &answer, &after)),
        false => as_text(args, &answer, &after),
    };
    print(&text)?;
    Ok(Outcome { checks_hold: sound })
}

fn as_json(args: &Try, answer: &Result<Tried, Finding>, after: &[String]) -> Value {
    let tried = answer.as_ref().ok().map(|tried| {
        let [median_us, nine_tenths_us, nearly_all_us] = tried.within_us;
        json!({
            "ticks": args.ticks,
            "ticks_braking": tried.braking,
            "ticks_without_a_number": tried.undefined,
            "greatest_current_a": tried.greatest_a,
            "tick_us": {"median": median_us, "nine_tenths": nine_tenths_us, "999_of_1000": nearly_all_us},
        })
    });
    let finding = answer.as_ref().err().map(ToString::to_string);
    json!({"answered": tried, "finding": finding, "after_the_trial": after})
}

fn as_text(args: &Try, answer: &Result<Tried, Finding>, after: &[String]) -> String {
    let mut lines = Vec::new();
    match answer {
        Ok(tried) => {
            let [median_us, _, nearly_all_us] = tried.within_us;
            let greatest_a = tried.greatest_a.map(|a| format!("{a:.3}"));
            lines.push(format!(
                "{} ticks answered, {} of them with current; there and back {median_us:.1} us in the median, {nearly_all_us:.1} us in 99.9 %",
                args.ticks, tried.braking
            ));
            lines.push(format!(
                "greatest currents of A, E, B and C: {} A",
                greatest_a.join(", ")
            ));
            if tried.undefined > 0 {
                lines.push(format!(
                    "{} ticks answered what is no number",
                    tried.undefined
                ));
            }
        }
        Err(finding) => lines.push(finding.to_string()),
    }
    lines.extend(after.iter().map(|what| format!("after the trial: {what}")));
    lines.join("\n")
}
