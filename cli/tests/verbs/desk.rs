//! This file is a folder to work in, with the program at hand.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;
use tempfile::TempDir;

/// A folder that the program runs in.
pub struct Desk {
    folder: TempDir,
}

impl Desk {
    pub fn new() -> Desk {
        Desk {
            folder: tempfile::tempdir().unwrap(),
        }
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub fn read(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).unwrap()
    }

    pub fn put(&self, name: &str, text: &str) {
        fs::write(self.path(name), text).unwrap();
    }

    /// Everything in a folder, hidden files too.
    pub fn names(&self, folder: &str) -> Vec<String> {
        let entries = fs::read_dir(self.path(folder)).unwrap();
        let names = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap());
        let mut names: Vec<String> = names.collect();
        names.sort();
        names
    }

    /// Runs the program with the words of a command line.
    pub fn rigproof(&self, line: &str) -> Output {
        self.rigproof_in(self.folder.path(), line)
    }

    /// The same in a folder of its own.
    pub fn rigproof_in(&self, folder: &Path, line: &str) -> Output {
        self.run(folder, &line.split_whitespace().collect::<Vec<_>>())
    }

    /// Runs the program with these words, which may hold spaces.
    pub fn runs(&self, words: &[&str]) -> Output {
        self.run(self.folder.path(), words)
    }

    fn run(&self, folder: &Path, words: &[&str]) -> Output {
        let mut command = Command::new(env!("CARGO_BIN_EXE_rigproof"));
        command.args(words).current_dir(folder).output().unwrap()
    }

    /// Runs it and gives what it prints; nothing may stand on the error stream of a pipe.
    pub fn prints(&self, line: &str, code: i32) -> String {
        let answer = self.rigproof(line);
        let message = String::from_utf8(answer.stderr).unwrap();
        assert_eq!(answer.status.code(), Some(code), "{line}: {message}");
        assert!(message.is_empty(), "{line}: {message}");
        String::from_utf8(answer.stdout).unwrap()
    }

    /// Runs it and reads its JSON.
    pub fn json(&self, line: &str, code: i32) -> Value {
        let printed = self.prints(line, code);
        serde_json::from_str(&printed).unwrap_or_else(|error| panic!("{line}: {error}: {printed}"))
    }
}

/// Holds a report to the published shape.
pub fn assert_shape(report: &Value) {
    assert_shape_of(report, include_str!("../../../docs/report.schema.json"));
}

/// Holds a result to a published shape.
pub fn assert_shape_of(report: &Value, schema: &str) {
    let schema = jsonschema::validator_for(&serde_json::from_str(schema).unwrap()).unwrap();
    let faults: Vec<String> = schema
        .iter_errors(report)
        .map(|fault| format!("{}: {fault}", fault.instance_path()))
        .collect();
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}
