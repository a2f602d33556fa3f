//! This file diagnoses recordings as they come into a folder, one at a time.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use serde_json::Value;

use crate::outcome::Failure;
use crate::{diagnose, input};

use super::listing::{LONGEST, Stamp, content_stamp, regular};

/// How often the folder is looked at. A recording is whole when nothing about it changed between two looks.
const PAUSE: Duration = Duration::from_millis(700);

/// What is being done, for the list.
#[derive(Default)]
pub struct Watch(Mutex<Inside>);

#[derive(Default)]
struct Inside {
    now: Option<(String, Instant)>,
    waiting: usize,
    failed: BTreeMap<String, String>,
}

/// What is being done, right now.
pub struct State {
    /// The recording that is diagnosed.
    pub now: Option<String>,
    /// For how long, s.
    pub since_s: u64,
    /// How many wait.
    pub waiting: usize,
    /// What could not be diagnosed, and why.
    pub failed: BTreeMap<String, String>,
}

impl Watch {
    /// A copy of what is known.
    pub fn state(&self) -> State {
        let inside = self.inside();
        State {
            now: inside.now.as_ref().map(|(name, _)| name.clone()),
            since_s: inside
                .now
                .as_ref()
                .map_or(0, |(_, begun)| begun.elapsed().as_secs()),
            waiting: inside.waiting,
            failed: inside.failed.clone(),
        }
    }

    fn inside(&self) -> MutexGuard<'_, Inside> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The SHA-256 of files, each read again only when anything of it was changed.
#[derive(Default)]
struct Contents(BTreeMap<PathBuf, (Stamp, String)>);

impl Contents {
    fn of(&mut self, file: &Path, stamp: Stamp) -> Option<String> {
        if let Some((known, sha256)) = self.0.get(file)
            && *known == stamp
        {
            return Some(sha256.clone());
        }
        let sha256 = input::identity(file, None).ok()?.sha256;
        self.0.insert(file.to_path_buf(), (stamp, sha256.clone()));
        Some(sha256)
    }
}

/// Looks at a folder until the end; what has a diagnosis already is left alone.
pub fn watched(folder: &Path, rig: &Path, watch: &Watch, ends: &AtomicBool) {
    let mut contents = Contents::default();
    let mut seen: BTreeMap<PathBuf, Stamp> = BTreeMap::new();
    let mut done: BTreeMap<PathBuf, [String; 2]> = BTreeMap::new();
    while !ends.load(Ordering::Relaxed) {
        let files: BTreeMap<PathBuf, Stamp> = recordings(folder)
            .into_iter()
            .filter_map(|file| Some((file.clone(), stamp(&file)?)))
            .collect();
        let of_rig = stamp(rig).and_then(|stamp| contents.of(rig, stamp));
        let of_rig = of_rig.unwrap_or_default();
        // What is still being written is not read: it is not whole.
        let mut is_new = |file: &PathBuf, stamp: &Stamp| {
            if seen.get(file) != Some(stamp) {
                return Some(None);
            }
            let own = [contents.of(file, *stamp)?, of_rig.clone()];
            let is_new = done.get(file) != Some(&own) && !is_diagnosed(file, &own);
            is_new.then_some(Some(own))
        };
        let new: Vec<(PathBuf, Option<[String; 2]>)> = files
            .iter()
            .filter_map(|(file, stamp)| Some((file.clone(), is_new(file, stamp)?)))
            .collect();
        let mut whole = new
            .iter()
            .filter_map(|(file, own)| Some((file.clone(), own.clone()?)));
        let whole = whole.next();
        watch.inside().waiting = new.len().saturating_sub(usize::from(whole.is_some()));
        seen = files;
        match whole {
            Some((file, own)) => {
                one(&file, rig, watch);
                done.insert(file, own);
            }
            None => thread::sleep(PAUSE),
        }
    }
}

fn one(file: &Path, rig: &Path, watch: &Watch) {
    let name = file
        .file_name()
        .map_or_else(String::new, |name| name.to_string_lossy().into_owned());
    watch.inside().now = Some((name.clone(), Instant::now()));
    let args = diagnose::Args::of(file, rig, &place(file));
    // One recording that nobody foresaw must not end the watch.
    let made = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| {
        diagnose::made(&args).map(|_| ())
    }));
    let failed = match made {
        Ok(Ok(())) => None,
        Ok(Err(Failure::Usage(why) | Failure::Input(why))) => Some(why),
        Err(_) => Some("the diagnosis broke off: please report this recording".to_owned()),
    };
    let mut inside = watch.inside();
    inside.now = None;
    match failed {
        Some(why) => inside.failed.insert(name, why),
        None => inside.failed.remove(&name),
    };
}

/// The recordings of a folder that are files, no links.
fn recordings(folder: &Path) -> Vec<PathBuf> {
    input::recordings(folder).unwrap_or_default()
}

fn stamp(file: &Path) -> Option<Stamp> {
    content_stamp(&regular(file)?)
}

/// Where the diagnosis of a recording stands: beside it; with its ending in the name where two recordings differ in nothing else.
fn place(file: &Path) -> PathBuf {
    let stem = file.file_stem();
    let folder = file.parent().unwrap_or(Path::new(""));
    let alike = recordings(folder)
        .iter()
        .filter(|own| own.file_stem() == stem)
        .count();
    let name = if alike > 1 { file.file_name() } else { stem };
    let mut name = name.unwrap_or_default().to_os_string();
    name.push("-diagnosis");
    file.with_file_name(name)
}

/// Whether a diagnosis stands there of these bytes, the recording's and the rig's, whatever the files are called and when they were written.
fn is_diagnosed(file: &Path, of: &[String; 2]) -> bool {
    let report = place(file).join(crate::folder::REPORT);
    let inputs = inputs(&report).unwrap_or_default();
    of.iter().all(|sha256| inputs.contains(sha256))
}

/// The SHA-256 of what a report was made from.
fn inputs(report: &Path) -> Option<Vec<String>> {
    regular(report).filter(|metadata| metadata.len() <= LONGEST)?;
    let result: Value = serde_json::from_slice(&std::fs::read(report).ok()?).ok()?;
    let inputs = result.get("inputs")?.as_array()?.iter();
    let sha256 = inputs.filter_map(|input| Some(input.get("sha256")?.as_str()?.to_owned()));
    Some(sha256.collect())
}
