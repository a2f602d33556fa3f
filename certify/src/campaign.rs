//! This file runs many scenarios side by side; what comes out depends on the plan alone.

use std::path::{Path, PathBuf};

use rayon::prelude::*;

use crate::certificate::VERDICT;
use crate::error::Error;
use crate::journal::{self, Chunks, Header, Journal, Shard};
use crate::plan::{Plan, Sources};
use crate::record::Record;
use crate::tool::Tool;

/// Scenarios of a chunk: what is lost at most, on every thread, when a campaign is killed.
pub const CHUNK: u64 = 8;

/// The scenarios of a chunk.
pub fn indices(plan: &Plan, chunk: u64) -> std::ops::Range<u64> {
    let from = chunk.saturating_mul(CHUNK).min(plan.scenarios);
    from..from.saturating_add(CHUNK).min(plan.scenarios)
}

/// The chunks of a part of a campaign.
pub fn chunks(plan: &Plan, [part, parts]: Shard) -> impl Iterator<Item = u64> {
    let all = 0..plan.scenarios.div_ceil(CHUNK);
    all.filter(move |chunk| chunk % parts.max(1) == part)
}

/// Runs what is not in the folder's journal yet, and tells after every chunk how many scenarios were done; gives all chunks.
///
/// # Errors
/// The journal cannot be written, or belongs to another campaign.
pub fn run(
    header: &Header,
    sources: &Sources<'_>,
    folder: &Path,
    done: &(impl Fn(u64) + Sync),
) -> Result<Chunks, Error> {
    let (journal, mut chunks_done) = Journal::open(folder, header)?;
    let plan = &header.plan;
    withdraw(folder)?;
    done(
        chunks_done
            .values()
            .map(|records| records.len() as u64)
            .sum(),
    );
    let missing: Vec<u64> = chunks(plan, header.shard)
        .filter(|chunk| !chunks_done.contains_key(chunk))
        .collect();
    let fresh: Result<Vec<(u64, Vec<Record>)>, Error> = missing
        .into_par_iter()
        .with_max_len(1)
        .map(|chunk| {
            let records = one(plan, sources, chunk)?;
            journal.add(chunk, &records)?;
            done(records.len() as u64);
            Ok((chunk, records))
        })
        .collect();
    chunks_done.extend(fresh?);
    Ok(chunks_done)
}

/// Takes the verdict of an earlier campaign away: until this one has its own, its folder shows none.
///
/// # Errors
/// The system refuses.
pub fn withdraw(folder: &Path) -> Result<(), Error> {
    for name in VERDICT {
        let file = folder.join(name);
        match std::fs::remove_file(&file) {
            Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
                return Err(Error::refused(&file, &error));
            }
            _ => {}
        }
    }
    Ok(())
}

/// The records of a chunk.
///
/// # Errors
/// [`Error::Scenario`].
pub fn one(plan: &Plan, sources: &Sources<'_>, chunk: u64) -> Result<Vec<Record>, Error> {
    indices(plan, chunk)
        .map(|index| Record::of(plan, sources, index))
        .collect()
}

/// The plan and all chunks of the shards in these folders, which this program ran.
///
/// # Errors
/// They are not the shards of one campaign, all of them, whole, or another build of the program ran one of them.
pub fn merge(folders: &[PathBuf], tool: &Tool) -> Result<(Plan, Chunks), Error> {
    let mut merged: Option<(Plan, Chunks)> = None;
    for folder in folders {
        let (header, chunks) = journal::read(folder)?;
        let (plan, all) = merged.get_or_insert_with(|| (header.plan.clone(), Chunks::new()));
        if *plan != header.plan {
            let folder = folder.display();
            return Err(Error::Shards(format!(
                "{folder}: the plan differs from that of the first folder; give the shards of one campaign"
            )));
        }
        if header.tool != *tool {
            let folder = folder.display();
            return Err(Error::Shards(format!(
                "{folder}: another build of this program ran it; join the shards with the build that ran all of them, or run this one again"
            )));
        }
        all.extend(chunks);
    }
    let none = || Error::Shards("no folder was given; give those of every shard".to_owned());
    let (plan, chunks) = merged.ok_or_else(none)?;
    whole(&plan, &chunks)?;
    Ok((plan, chunks))
}

/// Refuses chunks of which one is missing, not whole, or of no scenario of the plan.
pub(crate) fn whole(plan: &Plan, chunks: &Chunks) -> Result<(), Error> {
    let count = plan.scenarios.div_ceil(CHUNK);
    if let Some((beyond, _)) = chunks.range(count..).next() {
        return Err(Error::Shards(format!(
            "there are records of the chunk {beyond}, and the plan has {count}; give the shards of one campaign"
        )));
    }
    for chunk in self::chunks(plan, [0, 1]) {
        let expected = indices(plan, chunk);
        let are = chunks.get(&chunk).is_some_and(|records| {
            records
                .iter()
                .map(|record| record.index)
                .eq(expected.clone())
        });
        if !are {
            return Err(Error::Shards(format!(
                "the scenarios {} to {} are missing; run their shard to its end and give its folder",
                expected.start, expected.end
            )));
        }
    }
    Ok(())
}
