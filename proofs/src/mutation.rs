//! This file examines the planted mutants: an engine has to refute each.

use std::time::Duration;

use rigproof_impl::claim::{Claim, Domain};

use crate::engine::enumeration::{Enumerator, enumerate};
use crate::engine::random::{Sampler, sample};
use crate::engine::smt::{Outcome, Walker, examine};
use crate::planted::{Planted, planted};
use crate::replay::Replay;
use crate::solver::Solver;
use crate::work::on_every_core;

/// Draws for one claim of a mutant.
const DRAWS: u64 = 30_000;
/// Longest walk over the paths of one claim of a mutant.
const LONGEST_WALK: Duration = Duration::from_secs(20);

/// What became of a mutant.
#[derive(Clone, Debug)]
pub struct Examined {
    /// Its name.
    pub name: &'static str,
    /// The file below `impl/src` that it changes.
    pub file: &'static str,
    /// The claim and the engine that refuted it.
    pub refuted: Option<(&'static str, &'static str)>,
}

/// The claims of one mutant, in the hands of every engine.
struct Mutant {
    enumerated: Planted<Enumerator>,
    sampled: Planted<Sampler>,
    walked: Vec<(Claim<Walker>, Claim<Replay<f64>>)>,
}

/// Every planted mutant, by enumeration, then by sampling, and by the solver, if there is one, where neither refutes it.
pub fn examine_mutants(solver: Option<&Solver>, seed: u64) -> Vec<Examined> {
    let walked = planted::<Walker>()
        .into_iter()
        .zip(planted::<Replay<f64>>());
    let walked =
        walked.map(|(walked, again)| walked.claims.into_iter().zip(again.claims).collect());
    let mutants: Vec<Mutant> = planted()
        .into_iter()
        .zip(planted())
        .zip(walked)
        .map(|((enumerated, sampled), walked)| Mutant {
            enumerated,
            sampled,
            walked,
        })
        .collect();
    on_every_core(&mutants, |mutant| Examined {
        name: mutant.sampled.name,
        file: mutant.sampled.file,
        refuted: refutation(mutant, solver, seed),
    })
}

fn refutation(
    mutant: &Mutant,
    solver: Option<&Solver>,
    seed: u64,
) -> Option<(&'static str, &'static str)> {
    for claim in &mutant.enumerated.claims {
        if enumerate(claim).is_some_and(|found| found.refuted) {
            return Some((claim.name, "enumeration"));
        }
    }
    for claim in &mutant.sampled.claims {
        if sample(claim, seed, DRAWS).refuted_by.is_some() {
            return Some((claim.name, "random"));
        }
    }
    let solver = solver?;
    for (claim, again) in &mutant.walked {
        let is_number = claim.domain == Domain::Numbers;
        if is_number
            && matches!(
                examine(claim, again, solver, LONGEST_WALK).outcome,
                Outcome::Refuted(_)
            )
        {
            return Some((claim.name, "smt"));
        }
    }
    None
}
