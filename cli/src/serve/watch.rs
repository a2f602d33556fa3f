//! This file diagnoses recordings as they come into a folder, one at a time.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant, SystemTime};

use crate::outcome::Failure;
use crate::{diagnose, input};

use super::listing::regular;

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

/// Length and time of a file: when neither changes, nobody writes.
type Stamp = (u64, SystemTime);

/// Looks at a folder until the end; what has a diagnosis already is left alone.
pub fn watched(folder: &Path, rig: &Path, watch: &Watch, ends: &AtomicBool) {
    let mut seen: BTreeMap<PathBuf, Stamp> = BTreeMap::new();
    let mut done: BTreeMap<PathBuf, Stamp> = BTreeMap::new();
    while !ends.load(Ordering::Relaxed) {
        let files: BTreeMap<PathBuf, Stamp> = recordings(folder)
            .into_iter()
            .filter_map(|file| Some((file.clone(), stamp(&file)?)))
            .collect();
        let is_new = |file: &PathBuf, stamp: &Stamp| {
            done.get(file) != Some(stamp) && !is_diagnosed(file, stamp)
        };
        let new: Vec<(PathBuf, Stamp)> = files
            .iter()
            .filter(|(file, stamp)| is_new(file, stamp))
            .map(|(file, stamp)| (file.clone(), *stamp))
            .collect();
        let whole = new
            .iter()
            .find(|(file, stamp)| seen.get(file) == Some(stamp))
            .cloned();
        watch.inside().waiting = new.len().saturating_sub(usize::from(whole.is_some()));
        seen = files;
        match whole {
            Some((file, stamp)) => {
                one(&file, rig, watch);
                done.insert(file, stamp);
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
    let metadata = regular(file)?;
    Some((metadata.len(), metadata.modified().ok()?))
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

/// Whether a diagnosis stands there that is younger than the recording.
fn is_diagnosed(file: &Path, (_, modified): &Stamp) -> bool {
    let report = place(file).join(crate::folder::REPORT);
    regular(&report)
        .and_then(|metadata| metadata.modified().ok())
        .is_some_and(|written| written >= *modified)
}
