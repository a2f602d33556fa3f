//! This file says that pages stay short and that their lines are wrapped.

use crate::tidy::assert_tidy;
use crate::tidy::workspace::{Text, numbered, texts};

/// The most words of a page.
const MOST_WORDS: usize = 900;
const LONGEST_LINE: usize = 100;

/// Pages that are longer, and why.
const LONGER: [(&str, &str); 3] = [
    ("docs/CHANGELOG.md", "the history: nobody reads it whole"),
    ("proofs/LEDGER.md", "written by the proofs"),
    (
        "spec/thesis/equations.md",
        "a transcription, a line for each equation",
    ),
];

/// Pages to look something up in, of which only the words outside of tables count, and what the tables hold.
const TABLES: [(&str, &str); 4] = [
    ("docs/dependencies.md", "the crates, held to the manifest"),
    ("docs/faults.md", "the faults of files and their messages"),
    ("docs/mechanisms.md", "the library, held to it by a test"),
    ("docs/rules.md", "the rules, held to them by a test"),
];

/// Pages whose lines are as long as they are written, and why.
const UNWRAPPED: [(&str, &str); 2] = [
    ("docs/CHANGELOG.md", "one change is one line"),
    ("docs/results.md", "measured figures: a line is a claim"),
];

/// Whether a page is held to these rules. Decisions have rules of their own.
fn is_living(path: &str) -> bool {
    path.ends_with(".md") && !path.starts_with("docs/decisions/")
}

fn is_listed(list: &[(&str, &str)], path: &str) -> bool {
    list.iter().any(|(own, _)| *own == path)
}

/// The words of a page that count.
fn words(page: &Text) -> usize {
    let whole = !is_listed(&TABLES, &page.path);
    let lines = page.content.lines();
    let counted = lines.filter(|line| whole || !line.starts_with('|'));
    counted.map(|line| line.split_whitespace().count()).sum()
}

fn too_long(page: &Text) -> Option<String> {
    let words = words(page);
    let is_held = is_living(&page.path) && !is_listed(&LONGER, &page.path);
    (is_held && words > MOST_WORDS).then(|| {
        format!(
            "{}: {words} words, at most {MOST_WORDS}: say less, or move a part to a page of its own",
            page.path
        )
    })
}

/// The lines of prose that are too long: not those of tables and code.
fn unwrapped(page: &Text) -> Vec<String> {
    let is_held = page.path.starts_with("docs/") && is_living(&page.path);
    if !is_held || is_listed(&UNWRAPPED, &page.path) {
        return Vec::new();
    }
    let mut is_code = false;
    let mut long = Vec::new();
    for (number, line) in numbered(&page.content) {
        is_code ^= line.starts_with("```");
        let is_prose = !is_code && !line.starts_with('|') && !line.starts_with("    ");
        if is_prose && line.chars().count() > LONGEST_LINE {
            long.push(format!("{}:{number}: wrap at {LONGEST_LINE}", page.path));
        }
    }
    long
}

#[test]
fn pages_are_short() {
    let all = texts();
    let seen = all.iter().filter(|text| is_living(&text.path));
    assert!(seen.count() > 40);
    assert_tidy("long pages", all.iter().filter_map(too_long).collect());
}

#[test]
fn lines_of_pages_are_wrapped() {
    assert_tidy("long lines", texts().iter().flat_map(unwrapped).collect());
}

/// An exception that is not needed hides the next long page.
#[test]
fn every_longer_page_is_there_and_is_longer() {
    let all = texts();
    let idle = LONGER.iter().chain(&TABLES).filter(|(path, _)| {
        let page = all.iter().find(|text| text.path == *path);
        page.is_none_or(|page| page.content.split_whitespace().count() <= MOST_WORDS)
    });
    assert_tidy(
        "idle exceptions",
        idle.map(|(path, _)| format!("{path}: hold it to the rule"))
            .collect(),
    );
}

#[test]
fn a_long_page_and_a_long_line_are_noticed() {
    let page = |path: &str, content: String| Text {
        path: path.to_owned(),
        content,
    };
    let of = |path: &str, words: usize| page(path, "word ".repeat(words));
    assert!(too_long(&of("docs/limits.md", 901)).is_some());
    assert!(too_long(&of("docs/limits.md", 900)).is_none());
    assert!(too_long(&of("docs/new/page.md", 901)).is_some());
    assert!(too_long(&of("docs/rules.md", 901)).is_some());
    let table = page("docs/rules.md", "| word word word |\n".repeat(900));
    assert!(too_long(&table).is_none());
    let long = "word ".repeat(21);
    let found = |text: String| unwrapped(&page("docs/limits.md", text)).len();
    assert_eq!(found(format!("{long}\n")), 1);
    assert_eq!(
        found(format!("| {long}\n    {long}\n```\n{long}\n```\n")),
        0
    );
    assert_eq!(found(format!("```\n```\n{long}\n")), 1);
}
