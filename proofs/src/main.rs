//! This file is the command line of the proofs.

use std::fs;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Parser, Subcommand};
use rigproof_proofs::ledger::Ledger;
use rigproof_proofs::prove::{Place, missing, prove, root};

/// What holds for every input.
#[derive(Parser)]
#[command(name = "rigproof-proofs")]
struct Arguments {
    #[command(subcommand)]
    verb: Verb,
}

#[derive(Subcommand)]
enum Verb {
    /// Runs every engine on every claim, and every planted mutant; writes proofs/LEDGER.md and proofs/ledger.json.
    ///
    /// Example: rigproof-proofs prove --require smt,enumeration,random,shim
    Prove {
        /// Engines that have to run: smt, enumeration, random, shim, kani.
        #[arg(long, value_delimiter = ',')]
        require: Vec<String>,
        /// Examines the claims whose name contains this, no mutants, and writes nothing.
        #[arg(long)]
        only: Option<String>,
        /// Prints the ledger as JSON.
        #[arg(long)]
        json: bool,
        /// The Python that has bitwuzla; else that of RIGPROOF_SOLVER_PYTHON, else that of .venv-proofs in the target folder.
        #[arg(long)]
        solver_python: Option<PathBuf>,
    },
}

fn main() -> ExitCode {
    let Verb::Prove {
        require,
        only,
        json,
        solver_python,
    } = Arguments::parse().verb;
    let target = target();
    let python = solver_python
        .or_else(|| std::env::var_os("RIGPROOF_SOLVER_PYTHON").map(PathBuf::from))
        .unwrap_or_else(|| target.join(".venv-proofs/bin/python"));
    let place = Place {
        root: root(),
        target,
        python,
    };
    let written = prove(&place, only.as_deref()).and_then(|ledger| match only {
        Some(_) => Ok(ledger),
        None => write(&place, &ledger).map(|()| ledger),
    });
    match written {
        Ok(ledger) => report(&ledger, &require, json),
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(3)
        }
    }
}

/// The folder of the build that this program came from.
fn target() -> PathBuf {
    let program = std::env::current_exe().unwrap_or_default();
    program
        .ancestors()
        .nth(2)
        .map(PathBuf::from)
        .unwrap_or_default()
}

fn write(place: &Place, ledger: &Ledger) -> Result<(), String> {
    let room = place.root.join("proofs");
    let json = serde_json::to_string_pretty(ledger).map_err(|error| error.to_string())?;
    for (name, text) in [
        ("LEDGER.md", ledger.markdown()),
        ("ledger.json", json + "\n"),
    ] {
        fs::write(room.join(name), text).map_err(|error| format!("proofs/{name}: {error}"))?;
    }
    Ok(())
}

fn report(ledger: &Ledger, require: &[String], json: bool) -> ExitCode {
    if json {
        println!(
            "{}",
            serde_json::to_string_pretty(ledger).unwrap_or_default()
        );
    } else {
        for entry in &ledger.claims {
            println!("{}", entry.claim);
            for verdict in &entry.verdicts {
                println!(
                    "  {:<12} {:<9} {} ({:.1} s)",
                    verdict.engine,
                    verdict.word.text(),
                    verdict.how,
                    verdict.seconds
                );
            }
        }
        let refuted = ledger
            .mutants
            .iter()
            .filter(|mutant| mutant.engine.is_some())
            .count();
        println!(
            "planted mutants refuted: {refuted} of {}",
            ledger.mutants.len()
        );
        for (engine, state) in &ledger.engines {
            println!("{engine}: {state}");
        }
    }
    let mut failures = ledger.failures();
    failures.extend(missing(ledger, require));
    for failure in &failures {
        eprintln!("{failure}");
    }
    ExitCode::from(u8::from(!failures.is_empty()))
}
