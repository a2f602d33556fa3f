//! This file runs every engine on every claim and writes down what came out.

use std::path::{Path, PathBuf};
use std::time::Instant;

use rigproof_impl::claim::{Claim, Domain};

use crate::classes::Classes;
use crate::engine::enumeration::{Enumerator, enumerate};
use crate::engine::random::{Sampler, sample};
use crate::engine::smt::{self, Outcome, Walker, examine};
use crate::ledger::{Entry, Ledger, Mutant, Verdict, Word};
use crate::mutation::examine_mutants;
use crate::planted::IS_PLANTED;
use crate::replay::Replay;
use crate::solver::{Solver, VERSION};
use crate::width::Number;
use crate::work::on_every_core;
use crate::{campaign, claims, false_claims, fingerprint, kani};

/// Draws for one claim.
pub const DRAWS: u64 = 400_000;
/// Seed of the draws.
pub const SEED: u64 = 20_031_117;

/// Where things are.
#[derive(Clone, Debug)]
pub struct Place {
    /// The workspace's root.
    pub root: PathBuf,
    /// Where build output goes.
    pub target: PathBuf,
    /// The Python that has the solver.
    pub python: PathBuf,
}

/// One claim in the hands of every engine.
struct Subject {
    enumerated: Claim<Enumerator>,
    sampled: Claim<Sampler>,
    walked: Claim<Walker>,
    again: Claim<Replay>,
    /// On f32.
    single: Single,
}

/// One claim on f32.
struct Single {
    sampled: Claim<Sampler<f32>>,
    again: Claim<Replay<f32>>,
}

/// Runs every engine that is there; only on claims whose name contains `only`, and then on no mutant.
///
/// # Errors
/// What cannot be read; a build without the mutants, where they are to be examined.
pub fn prove(place: &Place, only: Option<&str>) -> Result<Ledger, String> {
    if only.is_none() && !IS_PLANTED {
        return Err("this build has no planted mutants: run `cargo run --release -p rigproof-proofs -- prove`, or ask for some claims with --only".to_owned());
    }
    let solver = Solver::find(&place.python);
    let proved_by_kani = kani::is_set_up(&place.root).then(|| kani::proves(&place.root));
    let double = claims().into_iter().zip(claims());
    let double = double.zip(claims().into_iter().zip(claims()));
    let subjects: Vec<Subject> = double
        .zip(claims().into_iter().zip(claims()))
        .map(
            |(((enumerated, sampled), (walked, again)), (of_single, again_single))| Subject {
                enumerated,
                sampled,
                walked,
                again,
                single: Single {
                    sampled: of_single,
                    again: again_single,
                },
            },
        )
        .filter(|subject| only.is_none_or(|text| subject.sampled.name.contains(text)))
        .collect();
    let mut entries = on_every_core(&subjects, |subject| entry(subject, solver.as_ref().ok()));
    for entry in &mut entries {
        entry.verdicts.push(kani_verdict(proved_by_kani));
    }
    let (mutants, false_claims) = match only {
        Some(_) => (Vec::new(), Vec::new()),
        None => (
            examine_mutants(solver.as_ref().ok(), SEED),
            false_entries(solver.as_ref().ok()),
        ),
    };
    let code =
        fingerprint::fingerprint(&place.root).map_err(|error| format!("the code: {error}"))?;
    Ok(Ledger {
        code,
        engines: engines(place, &solver, proved_by_kani.is_some()),
        claims: entries,
        false_claims,
        campaigns: campaign::campaigns(&place.root)?,
        mutants: mutants
            .into_iter()
            .map(|mutant| Mutant {
                mutant: mutant.name,
                file: format!("impl/src/{}", mutant.file),
                claim: mutant.refuted.map(|(claim, _)| claim),
                engine: mutant.refuted.map(|(_, engine)| engine),
            })
            .collect(),
    })
}

/// Each engine, and how to get it where it is not there.
fn engines(
    place: &Place,
    solver: &Result<Solver, String>,
    with_kani: bool,
) -> Vec<(&'static str, String)> {
    let smt = match solver {
        Ok(_) => format!("bitwuzla {VERSION} on IEEE 754 binary64 and binary32, over a pipe"),
        Err(_) => format!(
            "NOT RUN: `python3 -m venv .venv-proofs && .venv-proofs/bin/pip install bitwuzla=={VERSION}`, then `--solver-python \
             .venv-proofs/bin/python`"
        ),
    };
    let shim = if kani::harnesses_type_check(&place.root, &place.target.join("kani-shim")) {
        "every Kani harness type-checks against the types of Kani's functions"
    } else {
        "NOT RUN: the harnesses do not compile with `--cfg kani --cfg kani_shim`"
    };
    let kani = if with_kani {
        format!("`{}`", kani::COMMAND)
    } else {
        format!(
            "NOT RUN: `cargo kani --version` fails here; `{}` proves every harness where Kani is",
            kani::COMMAND
        )
    };
    vec![
        ("smt", smt),
        ("enumeration", "every choice of a finite claim".to_owned()),
        ("random", format!("{DRAWS} draws a claim, seed {SEED}")),
        ("shim", shim.to_owned()),
        ("kani", kani),
    ]
}

fn entry(subject: &Subject, solver: Option<&Solver>) -> Entry {
    let claim = &subject.sampled;
    let (sampled, classes) = random_verdict(claim, "random");
    let mut entry = Entry {
        claim: claim.name,
        statement: claim.statement.trim().to_owned(),
        verdicts: Vec::new(),
        classes: classes.0,
    };
    match claim.domain {
        Domain::Finite => entry
            .verdicts
            .extend(enumeration_verdict(&subject.enumerated)),
        Domain::Numbers => {
            let (walked, single) = (&subject.walked, &subject.single);
            let verdicts = &mut entry.verdicts;
            verdicts.push(smt_verdict("smt", walked, &subject.again, solver));
            verdicts.push(smt_verdict("smt, f32", walked, &single.again, solver));
        }
        Domain::Sampled => {}
    }
    entry.verdicts.push(sampled);
    if claim.domain != Domain::Finite {
        let (verdict, classes) = random_verdict(&subject.single.sampled, "random, f32");
        entry.verdicts.push(verdict);
        for (of_double, of_single) in entry.classes.iter_mut().zip(classes.0) {
            // A class has to be met on both widths.
            of_double.1 = of_double.1.min(of_single.1);
        }
    }
    entry
}

/// The claims that are false, in the hands of the solver.
fn false_entries(solver: Option<&Solver>) -> Vec<Entry> {
    let again = false_claims::claims()
        .into_iter()
        .zip(false_claims::claims());
    let claims = false_claims::claims::<Walker>().into_iter().zip(again);
    claims
        .map(|(walked, (double, single))| Entry {
            claim: walked.name,
            statement: walked.statement.trim().to_owned(),
            verdicts: vec![
                smt_verdict::<f64>("smt", &walked, &double, solver),
                smt_verdict::<f32>("smt, f32", &walked, &single, solver),
            ],
            classes: Vec::new(),
        })
        .collect()
}

fn enumeration_verdict(claim: &Claim<Enumerator>) -> Option<Verdict> {
    let start = Instant::now();
    let found = enumerate(claim)?;
    Some(Verdict {
        engine: "enumeration",
        word: if found.refuted {
            Word::Refuted
        } else {
            Word::Proved
        },
        how: format!("{} cases", found.cases),
        seconds: start.elapsed().as_secs_f64(),
    })
}

fn random_verdict<N: Number>(
    claim: &Claim<Sampler<N>>,
    engine: &'static str,
) -> (Verdict, Classes) {
    let start = Instant::now();
    let found = sample(claim, SEED, DRAWS);
    let verdict = Verdict {
        engine,
        word: if found.refuted_by.is_some() {
            Word::Refuted
        } else {
            Word::Tested
        },
        how: match &found.refuted_by {
            Some(numbers) => format!("by {numbers:?}"),
            None => format!("{} of {} draws", found.kept, found.draws),
        },
        seconds: start.elapsed().as_secs_f64(),
    };
    (verdict, found.classes)
}

fn smt_verdict<N: Number>(
    engine: &'static str,
    walked: &Claim<Walker>,
    again: &Claim<Replay<N>>,
    solver: Option<&Solver>,
) -> Verdict {
    let Some(solver) = solver else {
        return Verdict {
            engine,
            word: Word::NotRun,
            how: "the solver is not there".to_owned(),
            seconds: 0.0,
        };
    };
    let found: smt::Examined = examine(walked, again, solver, smt::LONGEST_WALK);
    let walked = format!("{} paths, {} questions", found.paths, found.queries);
    let (word, how) = match found.outcome {
        Outcome::Proved => (Word::Proved, walked),
        Outcome::Refuted(numbers) => (Word::Refuted, format!("by {numbers:?}")),
        Outcome::Undecided(why) => (Word::Undecided, format!("{walked}: {why}")),
    };
    Verdict {
        engine,
        word,
        how,
        seconds: found.seconds,
    }
}

fn kani_verdict(proved: Option<bool>) -> Verdict {
    let (word, how) = match proved {
        Some(true) => (Word::Proved, "every harness"),
        Some(false) => (Word::Undecided, "`cargo kani` failed: read its log"),
        None => (Word::NotRun, "`cargo kani --version` fails here"),
    };
    Verdict {
        engine: "kani",
        word,
        how: how.to_owned(),
        seconds: 0.0,
    }
}

/// Engines that were required and did not run.
pub fn missing(ledger: &Ledger, required: &[String]) -> Vec<String> {
    let state = |engine: &String| ledger.engines.iter().find(|(name, _)| name == engine);
    required
        .iter()
        .filter(|engine| state(engine).is_none_or(|(_, state)| state.starts_with("NOT RUN")))
        .map(|engine| format!("engine {engine}: required, and not run"))
        .collect()
}

/// The folder above `proofs`.
pub fn root() -> PathBuf {
    let room = Path::new(env!("CARGO_MANIFEST_DIR"));
    room.parent().unwrap_or(room).to_owned()
}
