//! This file says which words and names have no place in the workspace.

use crate::tidy::assert_tidy;
use crate::tidy::workspace::{folders, numbered, texts};

/// Written apart, so that this file passes its own rules.
const UNFINISHED: [&str; 2] = [concat!("TO", "DO"), concat!("FIX", "ME")];
const ABSOLUTE: [&str; 4] = [
    concat!("/", "work"),
    concat!("/", "home"),
    concat!("/", "root"),
    concat!("/", "tmp"),
];
const FORBIDDEN_FOLDERS: [&str; 6] = ["utils", "common", "core", "helpers", "xtask", "scripts"];

#[test]
fn no_text_is_marked_unfinished() {
    let violations = find(|line| {
        UNFINISHED
            .into_iter()
            .find(|word| has_word(line, word))
            .map(|word| format!("finish what {word} stands for, or delete it"))
    });
    assert_tidy("unfinished work", violations);
}

#[test]
fn no_text_holds_an_absolute_path() {
    let violations = find(|line| {
        ABSOLUTE
            .into_iter()
            .find(|root| has_root(line, root))
            .map(|root| format!("write the path relative to the workspace, not below {root}"))
    });
    assert_tidy("absolute paths", violations);
}

#[test]
fn no_folder_is_named_after_nothing() {
    assert_tidy("folder names", named_after_nothing(folders()));
}

fn named_after_nothing(folders: Vec<String>) -> Vec<String> {
    let forbidden = |folder: &String| {
        let mut parts = folder.split('/');
        parts.any(|part| FORBIDDEN_FOLDERS.contains(&part))
    };
    folders
        .into_iter()
        .filter(forbidden)
        .map(|folder| format!("{folder}: name the folder after the question it answers"))
        .collect()
}

#[test]
fn a_folder_named_after_nothing_is_noticed() {
    let folders = ["model/src", "model/src/utils", "tests/core/a", "score"].map(str::to_owned);
    assert_eq!(named_after_nothing(folders.into()).len(), 2);
}

#[test]
fn word_search_finds_what_it_should() {
    let [unfinished, _] = UNFINISHED;
    assert!(has_word(&format!("// {unfinished}: later"), unfinished));
    assert!(!has_word(&format!("{unfinished}S_PER_DAY"), unfinished));
    let [.., temporary] = ABSOLUTE;
    assert!(has_root(
        &format!("read \"{temporary}/run.csv\""),
        temporary
    ));
    assert!(!has_root(&format!("docs{temporary}"), temporary));
    assert!(!has_root(&format!("{temporary}late"), temporary));
}

fn find(violation: impl Fn(&str) -> Option<String>) -> Vec<String> {
    let mut violations = Vec::new();
    for text in texts() {
        for (number, line) in numbered(&text.content) {
            if let Some(advice) = violation(line) {
                violations.push(format!("{}:{number}: {advice}", text.path));
            }
        }
    }
    violations
}

fn has_word(line: &str, word: &str) -> bool {
    occurrences(line, word).any(|(before, after)| !is_word(before) && !is_word(after))
}

/// A root folder of a path: not the end of a longer path before it, nor the start of a longer name.
fn has_root(line: &str, root: &str) -> bool {
    occurrences(line, root).any(|(before, after)| {
        let follows_path =
            is_word(before) || matches!(before, Some('.' | '/' | '}' | '>' | ')' | '*'));
        !follows_path && !is_word(after) && after != Some('-')
    })
}

/// The characters before and after each occurrence.
fn occurrences<'a>(
    line: &'a str,
    needle: &'a str,
) -> impl Iterator<Item = (Option<char>, Option<char>)> + 'a {
    line.match_indices(needle).map(move |(start, _)| {
        let (before, rest) = line.split_at(start);
        (
            before.chars().next_back(),
            rest.chars().nth(needle.chars().count()),
        )
    })
}

fn is_word(character: Option<char>) -> bool {
    character.is_some_and(|c| c.is_alphanumeric() || c == '_')
}
