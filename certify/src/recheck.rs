//! This file checks a certificate by running scenarios again: all of them make a proof, some of them a sample, and what either allows is rebuilt.

use rayon::prelude::*;

use crate::campaign::{self, CHUNK};
use crate::certificate::{Certificate, chunk_digest, records};
use crate::error::Error;
use crate::journal::Chunks;
use crate::plan::Sources;
use crate::record::Record;
use crate::scenario::Draw;

/// What a certificate is checked with.
#[derive(Clone, Copy)]
pub struct Means<'a> {
    /// What makes its controllers.
    pub sources: Sources<'a>,
    /// The records that its campaign kept, if they are at hand.
    pub kept: Option<&'a Chunks>,
    /// How many scenarios are run again, in whole chunks.
    pub sample: u64,
    /// The seed by which they are drawn.
    pub seed: u64,
}

/// What a check came to.
#[derive(Clone, Debug, PartialEq)]
pub struct Checked {
    /// Scenarios that were run again.
    pub again: u64,
    /// The share of the chunks of scenarios that was run again: the chance by which a change in one of them is seen.
    pub share: f64,
    /// Whether all were: then everything that the certificate says of trials was rebuilt.
    pub is_proof: bool,
    /// Whether all figures were rebuilt from the records of all scenarios, run again or kept.
    pub is_rebuilt: bool,
    /// What disagrees, a sentence each.
    pub wrong: Vec<String>,
}

impl Checked {
    /// Whether the controller may go on the rig: it has to follow from figures that hold.
    pub fn may_go(&self, certificate: &Certificate) -> bool {
        self.wrong.is_empty() && certificate.may_go()
    }
}

/// Checks.
///
/// # Errors
/// [`Error::Scenario`].
pub fn recheck(certificate: &Certificate, means: &Means<'_>) -> Result<Checked, Error> {
    let plan = &certificate.plan;
    let all = certificate.chunks.len();
    let count = means.sample.div_ceil(CHUNK).min(all as u64) as usize;
    let drawn = Draw::new(means.seed, 1).some_of(all, count);
    let run = drawn.into_par_iter().with_max_len(1).map(|chunk| {
        let chunk = chunk as u64;
        Ok((chunk, campaign::one(plan, &means.sources, chunk)?))
    });
    let again: Chunks = run.collect::<Result<_, Error>>()?;
    let mut wrong = Vec::new();
    for (chunk, records) in &again {
        if !is_said(certificate, *chunk, records)? {
            wrong.push(otherwise(plan, *chunk, "come out otherwise"));
        }
    }
    let is_proof = again.len() == all;
    let kept = means.kept.filter(|_| !is_proof);
    if is_proof {
        wrong.extend(certificate.unlike(&again)?);
        wrong.extend(certificate.found_otherwise(&again, &means.sources)?);
    } else if let Some(kept) = kept {
        wrong.extend(of_kept(certificate, kept)?);
    } else {
        wrong.extend(certificate.impossible(&records(&again)));
    }
    let run_again = again.values().map(|records| records.len() as u64).sum();
    Ok(Checked {
        again: run_again,
        share: again.len() as f64 / all.max(1) as f64,
        is_proof,
        is_rebuilt: is_proof || kept.is_some(),
        wrong,
    })
}

/// What disagrees with the records that were kept.
fn of_kept(certificate: &Certificate, kept: &Chunks) -> Result<Vec<String>, Error> {
    if let Err(error) = campaign::whole(&certificate.plan, kept) {
        return Ok(vec![format!(
            "the records beside it are not whole: {error}"
        )]);
    }
    let mut wrong = Vec::new();
    for (chunk, records) in kept {
        if !is_said(certificate, *chunk, records)? {
            let what = "stand otherwise in the records beside it";
            wrong.push(otherwise(&certificate.plan, *chunk, what));
        }
    }
    // Of other records everything differs.
    if wrong.is_empty() {
        wrong = certificate.unlike(kept)?;
    }
    Ok(wrong)
}

/// Whether records are those of the certificate.
fn is_said(certificate: &Certificate, chunk: u64, records: &[Record]) -> Result<bool, Error> {
    let said = usize::try_from(chunk).ok();
    let said = said.and_then(|chunk| certificate.chunks.get(chunk));
    Ok(said == Some(&chunk_digest(records)?))
}

fn otherwise(plan: &crate::plan::Plan, chunk: u64, what: &str) -> String {
    let indices = campaign::indices(plan, chunk);
    let last = indices.end.saturating_sub(1);
    format!("scenarios {} to {last} {what}", indices.start)
}
