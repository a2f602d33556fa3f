//! This file runs every command of the guide, page by page, each page in a folder of its own.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

const GUIDE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/guide/src");

/// The pages, by name.
fn pages() -> Vec<(String, String)> {
    let mut pages: Vec<_> = fs::read_dir(GUIDE)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .map(|path| {
            let name = path.file_name().unwrap().to_string_lossy().into_owned();
            (name, fs::read_to_string(path).unwrap())
        })
        .collect();
    pages.sort();
    pages
}

/// The lines of the blocks that are marked `sh`.
fn commands(page: &str) -> Vec<&str> {
    let blocks = page.split("```sh\n").skip(1);
    let blocks = blocks.map(|block| block.split_once("```").unwrap().0);
    blocks.flat_map(str::lines).collect()
}

/// Runs a line; what stands behind `>` takes its output.
fn run(folder: &Path, line: &str) -> Output {
    let (words, into) = match line.split_once(" > ") {
        Some((words, into)) => (words, Some(into)),
        None => (line, None),
    };
    let words = words
        .strip_prefix("rigproof ")
        .unwrap_or_else(|| panic!("{line}"));
    let mut command = Command::new(env!("CARGO_BIN_EXE_rigproof"));
    let command = command.args(words.split_whitespace()).current_dir(folder);
    let answer = command.output().unwrap();
    if let Some(into) = into {
        fs::write(folder.join(into), &answer.stdout).unwrap();
    }
    answer
}

#[test]
fn every_page_is_in_the_summary_and_marks_its_commands() {
    let pages = pages();
    let (_, summary) = pages.iter().find(|(name, _)| name == "SUMMARY.md").unwrap();
    let mut count = 0;
    for (name, page) in &pages {
        let listed = name == "SUMMARY.md" || summary.contains(&format!("({name})"));
        assert!(listed, "{name} is not in SUMMARY.md");
        let blocks = page.matches("```").count();
        // What is Python is run by `python/tests/test_guide.py`.
        let run = ["```sh\n", "```python\n"].map(|mark| page.matches(mark).count());
        assert_eq!(
            blocks,
            2 * (run[0] + run[1]),
            "{name}: a block that is not run"
        );
        count += commands(page).len();
    }
    assert!(count > 20, "{count}");
}

/// The page that is run with every test; all are with `RIGPROOF_GUIDE=all`, as `.ci/run` has it: most of a minute.
const ALWAYS: &str = "thesis.md";

#[test]
fn every_command_of_the_guide_does_what_the_page_says() {
    let all = std::env::var("RIGPROOF_GUIDE").is_ok_and(|pages| pages == "all");
    let pages = pages().into_iter();
    for (name, page) in pages.filter(|(name, _)| all || name == ALWAYS) {
        let folder = tempfile::tempdir().unwrap();
        for line in commands(&page) {
            let answer = run(folder.path(), line);
            let said = String::from_utf8_lossy(&answer.stderr);
            assert_eq!(answer.status.code(), Some(0), "{name}: {line}: {said}");
        }
    }
}

#[test]
fn what_a_page_includes_is_there() {
    for (name, page) in pages() {
        for part in page.split("{{#include ").skip(1) {
            let file: PathBuf = Path::new(GUIDE).join(part.split_once("}}").unwrap().0);
            assert!(file.is_file(), "{name}: {}", file.display());
        }
    }
}
