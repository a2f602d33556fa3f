//! This file lists the runs of a folder: what `diagnose` and `certify` wrote there.

use std::collections::BTreeMap;
use std::ffi::OsStr;
use std::fs;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::io::Read;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use rigproof_certify::axis::certificate::Certificate as OfAxis;
use rigproof_certify::certificate::Certificate;
use rigproof_trace::store;
use serde_json::Value;

use crate::certify::CERTIFICATE;
use crate::folder::REPORT;

/// Files of a run that are shown; anything else is not there.
pub const SHOWN: [(&str, &str); 9] = [
    ("report.html", "text/html; charset=utf-8"),
    ("certificate.html", "text/html; charset=utf-8"),
    ("report.json", "application/json"),
    ("certificate.json", "application/json"),
    ("calibration.toml", "text/plain; charset=utf-8"),
    ("next-experiment.csv", "text/csv; charset=utf-8"),
    ("before-after.svg", "image/svg+xml"),
    ("residual.svg", "image/svg+xml"),
    ("recording.csv", "text/csv; charset=utf-8"),
];

/// The longest report that is read for the list, bytes.
pub const LONGEST: u64 = 16 << 20;

/// What is kept of a result: what the list and the comparison show.
const KEPT: [&str; 14] = [
    "effects",
    "fit",
    "floor",
    "inputs",
    "laws",
    "may_go_on_the_rig",
    "name",
    "plan",
    "reasons",
    "samples",
    "sha256",
    "summary",
    "tool",
    "verdict",
];

/// A run.
pub struct Run {
    /// The folder's name.
    pub name: String,
    /// When its result was written.
    pub written: SystemTime,
    /// Its report or certificate.
    pub result: Value,
}

impl Run {
    /// Whether it is a certificate and not a diagnosis.
    pub fn is_certificate(&self) -> bool {
        self.result.get("may_go_on_the_rig").is_some()
    }

    /// The page that shows it.
    pub const fn page(is_certificate: bool) -> &'static str {
        if is_certificate {
            "certificate.html"
        } else {
            "report.html"
        }
    }

    /// A text of its result; a dash where there is none.
    pub fn text(&self, pointer: &str) -> String {
        match self.result.pointer(pointer) {
            Some(Value::String(text)) => text.clone(),
            Some(Value::Number(number)) => number.as_f64().map_or_else(
                || number.to_string(),
                |x| crate::text::number::significant(x, 4),
            ),
            Some(Value::Bool(yes)) => if *yes { "yes" } else { "no" }.to_owned(),
            _ => "–".to_owned(),
        }
    }
}

/// The runs of a folder, the latest first. Links are not followed, and what cannot be read is no run.
pub fn runs(folder: &Path) -> Vec<Run> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let mut runs: Vec<Run> = entries.filter_map(|entry| run(&entry)).collect();
    runs.sort_by(|a, b| b.written.cmp(&a.written).then_with(|| a.name.cmp(&b.name)));
    runs
}

/// What the list of a folder is made from, in a word that changes with it. No result is read: a page asks every few seconds.
pub fn revision(folder: &Path, failed: &BTreeMap<String, String>) -> String {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let stamp = |entry: &fs::DirEntry| {
        let is_folder = entry.file_type().ok()?.is_dir();
        let path = entry.path();
        let result = [REPORT, CERTIFICATE].map(|file| regular(&path.join(file)));
        let result = result.into_iter().flatten().next()?;
        let stamp = (entry.file_name(), content_stamp(&result)?);
        (is_folder && !is_part(&entry.file_name())).then_some(stamp)
    };
    let mut stamps: Vec<_> = entries.filter_map(|entry| stamp(&entry)).collect();
    stamps.sort();
    let mut hasher = DefaultHasher::new();
    (stamps, failed).hash(&mut hasher);
    format!("{:016x}", hasher.finish())
}

/// Whether a folder is one that the program has not finished, or not taken away.
fn is_part(name: &OsStr) -> bool {
    name.to_str().is_some_and(store::is_part)
}

/// What changes with every write of a file, whatever its owner sets its time to.
pub fn content_stamp(metadata: &fs::Metadata) -> Option<Stamp> {
    #[cfg(unix)]
    let changed = {
        use std::os::unix::fs::MetadataExt;
        [
            metadata.ctime(),
            metadata.ctime_nsec(),
            metadata.ino() as i64,
        ]
    };
    #[cfg(not(unix))]
    let changed = [0; 3];
    Some((metadata.len(), metadata.modified().ok()?, changed))
}

/// Length, time, and on Unix when anything of it was changed and which file it is.
pub type Stamp = (u64, SystemTime, [i64; 3]);

/// The folder of a name among those that are there.
pub fn path_of(folder: &Path, name: &str) -> Option<PathBuf> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let mut named = entries.filter(|entry| entry.file_name() == *name);
    let entry = named.next()?;
    let is_run = entry.file_type().ok()?.is_dir() && !is_part(&entry.file_name());
    let path = entry.path();
    let holds = |file: &str| regular(&path.join(file)).is_some();
    (is_run && (holds(REPORT) || holds(CERTIFICATE))).then_some(path)
}

fn run(entry: &fs::DirEntry) -> Option<Run> {
    // The type of a link is that of the link.
    if !entry.file_type().ok()?.is_dir() || is_part(&entry.file_name()) {
        return None;
    }
    let name = entry.file_name().into_string().ok()?;
    let path = entry.path();
    let of = |file: &str| {
        let path = path.join(file);
        let metadata = regular(&path).filter(|metadata| metadata.len() <= LONGEST)?;
        let mut text = String::new();
        let opened = fs::File::open(&path).ok()?;
        opened.take(LONGEST).read_to_string(&mut text).ok()?;
        let mut result: Value = serde_json::from_str(&text).ok()?;
        if let Value::Object(map) = &mut result {
            map.retain(|key, _| KEPT.contains(&key.as_str()));
        }
        // What a certificate says of itself is not read: it has to follow from the rest of it.
        if result.get("may_go_on_the_rig").is_some() {
            let may = match OfAxis::is_one(&text) {
                true => OfAxis::parse(&text, &path).map(|own| own.may_go()),
                false => Certificate::parse(&text, &path).map(|own| own.may_go()),
            };
            let may = may.map_or(Value::Null, Value::Bool);
            *result.get_mut("may_go_on_the_rig")? = may;
        }
        Some((result, metadata.modified().ok()?))
    };
    let (result, written) = of(REPORT).or_else(|| of(CERTIFICATE))?;
    Some(Run {
        name,
        written,
        result,
    })
}

/// What is known of a file that is no link.
pub fn regular(path: &Path) -> Option<fs::Metadata> {
    fs::symlink_metadata(path)
        .ok()
        .filter(fs::Metadata::is_file)
}
