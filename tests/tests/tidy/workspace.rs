//! This file finds the texts of the workspace.

use std::fs;
use std::path::{Path, PathBuf};

/// One text file: its path below the workspace root, with forward slashes, and its content.
pub struct Text {
    pub path: String,
    pub content: String,
}

/// The workspace root.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .parent()
        .unwrap()
        .to_path_buf()
}

/// Every UTF-8 file below the root, except version control and build output.
pub fn texts() -> Vec<Text> {
    let mut texts = Vec::new();
    for path in files(&root()) {
        if let Ok(content) = fs::read_to_string(root().join(&path)) {
            texts.push(Text { path, content });
        }
    }
    assert!(
        texts.len() > 30,
        "only {} texts found: the rules would hold for nothing",
        texts.len()
    );
    texts
}

/// Every Rust source below the root.
pub fn sources() -> Vec<Text> {
    let mut sources = texts();
    sources.retain(|text| text.path.ends_with(".rs"));
    sources
}

/// The lines of a text, numbered from one.
pub fn numbered(content: &str) -> impl Iterator<Item = (usize, &str)> {
    content.lines().enumerate().map(|(i, line)| (i + 1, line))
}

/// Every folder below the root that holds a file, except version control and build output.
pub fn folders() -> Vec<String> {
    let mut folders: Vec<String> = files(&root())
        .iter()
        .filter_map(|path| path.rsplit_once('/'))
        .map(|(folder, _)| folder.to_owned())
        .collect();
    folders.dedup();
    folders
}

/// Whether a name is what the last part of a pattern of ignored files says, with one `*` at most.
fn matches(pattern: &str, name: &str) -> bool {
    let last = pattern.rsplit('/').next().unwrap_or(pattern);
    match last.split_once('*') {
        Some((before, after)) => name.starts_with(before) && name.ends_with(after),
        None => last == name,
    }
}

fn files(folder: &Path) -> Vec<String> {
    let ignored = fs::read_to_string(root().join(".gitignore")).unwrap();
    let mut found = Vec::new();
    let mut waiting = vec![folder.to_path_buf()];
    while let Some(folder) = waiting.pop() {
        for entry in fs::read_dir(&folder).unwrap() {
            let entry = entry.unwrap();
            let name = entry.file_name().into_string().unwrap();
            let kind = entry.file_type().unwrap();
            // What the program, the proofs or a package write may change while it is read here.
            let is_output = ignored.lines().any(|pattern| matches(pattern, &name));
            if is_output || name == ".git" {
                continue;
            }
            if kind.is_dir() {
                waiting.push(entry.path());
            } else if kind.is_file() {
                found.push(entry.path());
            }
        }
    }
    let mut relative: Vec<String> = found
        .iter()
        .map(|path| path.strip_prefix(root()).unwrap())
        .map(|path| path.to_str().unwrap().replace('\\', "/"))
        .collect();
    relative.sort();
    relative
}
