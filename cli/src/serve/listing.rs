//! This file lists the runs of a folder: what `diagnose` and `certify` wrote there.

use std::collections::BTreeMap;
use std::fs;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};
use std::time::SystemTime;

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
const LONGEST: u64 = 64 << 20;

/// A run.
pub struct Run {
    /// The folder's name.
    pub name: String,
    /// The folder.
    pub path: PathBuf,
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
        let stamp = (entry.file_name(), result.len(), result.modified().ok()?);
        is_folder.then_some(stamp)
    };
    let mut stamps: Vec<_> = entries.filter_map(|entry| stamp(&entry)).collect();
    stamps.sort();
    let mut hasher = DefaultHasher::new();
    (stamps, failed).hash(&mut hasher);
    format!("{:016x}", hasher.finish())
}

fn run(entry: &fs::DirEntry) -> Option<Run> {
    // The type of a link is that of the link.
    if !entry.file_type().ok()?.is_dir() {
        return None;
    }
    let name = entry.file_name().into_string().ok()?;
    let path = entry.path();
    let of = |file: &str| {
        let metadata = regular(&path.join(file)).filter(|metadata| metadata.len() <= LONGEST)?;
        let result = serde_json::from_slice(&fs::read(path.join(file)).ok()?).ok()?;
        Some((result, metadata.modified().ok()?))
    };
    let (result, written) = of(REPORT).or_else(|| of(CERTIFICATE))?;
    Some(Run {
        name,
        path,
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
