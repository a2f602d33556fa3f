//! This file finds the repository around a folder, and reads its texts.

use std::fs;
use std::path::{Path, PathBuf};

use crate::outcome::Failure;

/// A repository of this project.
pub struct Repository {
    root: PathBuf,
}

/// A Rust source: its path below the root, with forward slashes, and its text.
pub struct Source {
    /// The path.
    pub path: String,
    /// The text.
    pub text: String,
}

impl Source {
    /// The line on which a function of that name begins, from one.
    pub fn line_of_function(&self, name: &str) -> Option<usize> {
        let begins = format!("fn {name}(");
        let line = self.text.lines().position(|line| line.contains(&begins))?;
        Some(line + 1)
    }
}

/// By this file a repository is known.
const MARK: &str = super::equation::FILE;

impl Repository {
    /// The repository that a folder is, or lies in.
    ///
    /// # Errors
    /// There is none.
    pub fn around(start: &Path) -> Result<Repository, Failure> {
        let whole = start.canonicalize().map_err(|error| {
            let start = start.display();
            Failure::Input(format!(
                "the folder `{start}` cannot be opened: {error}; give a folder of the repository with --root"
            ))
        })?;
        let root = whole.ancestors().find(|folder| folder.join(MARK).is_file());
        let root = root.ok_or_else(|| {
            let start = start.display();
            Failure::Input(format!(
                "there is no repository in `{start}` or above it: no `{MARK}`; citations stand in the sources, so go to them or \
                 name their folder with --root"
            ))
        })?;
        Ok(Repository {
            root: root.to_path_buf(),
        })
    }

    /// The text of a file; bytes that are no UTF-8 are replaced.
    ///
    /// # Errors
    /// It cannot be read.
    pub fn read(&self, path: &str) -> Result<String, Failure> {
        let bytes = fs::read(self.root.join(path)).map_err(|error| unreadable(path, &error))?;
        Ok(String::from_utf8_lossy(&bytes).into_owned())
    }

    /// Its Rust sources, by path.
    ///
    /// # Errors
    /// A folder or a source cannot be read.
    pub fn sources(&self) -> Result<Vec<Source>, Failure> {
        let paths = self.paths()?.into_iter();
        let read = paths.map(|path| {
            let text = self.read(&path)?;
            Ok(Source { path, text })
        });
        read.collect()
    }

    /// The paths of its Rust sources, sorted; no build output and nothing hidden.
    fn paths(&self) -> Result<Vec<String>, Failure> {
        let mut found = Vec::new();
        let mut waiting = vec![String::new()];
        while let Some(folder) = waiting.pop() {
            let failed = |error: &std::io::Error| unreadable(&folder, error);
            let place = self.root.join(&folder);
            // Cargo marks a folder of build output so.
            if place.join("CACHEDIR.TAG").is_file() {
                continue;
            }
            for entry in fs::read_dir(place).map_err(|e| failed(&e))? {
                let entry = entry.map_err(|e| failed(&e))?;
                let kind = entry.file_type().map_err(|e| failed(&e))?;
                let name = entry.file_name();
                let Some(name) = name.to_str().filter(|name| !name.starts_with('.')) else {
                    continue;
                };
                let path = match folder.as_str() {
                    "" => name.to_owned(),
                    folder => format!("{folder}/{name}"),
                };
                if kind.is_dir() && name != "target" {
                    waiting.push(path);
                } else if kind.is_file() && name.ends_with(".rs") {
                    found.push(path);
                }
            }
        }
        found.sort();
        Ok(found)
    }
}

fn unreadable(path: &str, error: &std::io::Error) -> Failure {
    let path = if path.is_empty() { "." } else { path };
    Failure::Input(format!(
        "`{path}` of the repository cannot be read: {error}"
    ))
}
