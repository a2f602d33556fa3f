//! This file says that each record of a decision can be read alone, and that what is superseded is set apart.

use std::collections::BTreeSet;
use std::path::{Component, Path, PathBuf};

use crate::tidy::assert_tidy;
use crate::tidy::workspace::{Text, numbered, root, texts};

const IN_FORCE: &str = "docs/decisions/";
const ARCHIVE: &str = "docs/decisions/archive/";
/// The most words of a record in force.
const MOST_WORDS: usize = 400;
const LONGEST_LINE: usize = 100;

/// The number that a record's file name begins with.
fn number(path: &str) -> Option<&str> {
    let name = path.rsplit('/').next()?;
    name.get(..4)
        .filter(|own| own.bytes().all(|byte| byte.is_ascii_digit()))
}

fn records(folder: &str) -> Vec<Text> {
    let mut own = texts();
    own.retain(|text| {
        let name = text.path.strip_prefix(folder);
        name.is_some_and(|name| name.ends_with(".md") && !name.contains('/'))
    });
    own
}

#[test]
fn every_record_in_force_says_so_and_is_short() {
    let all = records(IN_FORCE);
    assert!(all.len() > 100, "{} records", all.len());
    assert_tidy("decisions", all.iter().flat_map(in_force).collect());
}

fn in_force(record: &Text) -> Vec<String> {
    let path = &record.path;
    let mut violations = Vec::new();
    let title = number(path).map(|number| format!("# {number}: "));
    if !title.is_some_and(|title| record.content.starts_with(&title)) {
        violations.push(format!("{path}:1: begin with `# ` and the file's number"));
    }
    if !record.content.contains("\n\n**In force.**\n") {
        violations.push(format!(
            "{path}: say **In force.** below the title, or move it to {ARCHIVE}"
        ));
    }
    let words = record.content.split_whitespace().count();
    if words > MOST_WORDS {
        violations.push(format!("{path}: {words} words, at most {MOST_WORDS}"));
    }
    let long = numbered(&record.content).filter(|(_, line)| {
        line.chars().count() > LONGEST_LINE && !line.starts_with('|') && !line.starts_with("    ")
    });
    violations.extend(long.map(|(line, _)| format!("{path}:{line}: wrap at {LONGEST_LINE}")));
    violations
}

#[test]
fn every_archived_record_names_what_replaced_it() {
    let all = records(ARCHIVE);
    assert!(!all.is_empty());
    assert_tidy(
        "superseded decisions",
        all.iter().filter_map(archived).collect(),
    );
}

fn archived(record: &Text) -> Option<String> {
    let third = record.content.lines().nth(2).unwrap_or_default();
    let says = third.starts_with("**Superseded by [0");
    (!says).then(|| {
        format!(
            "{}:3: say `**Superseded by [number](../record.md).**`",
            record.path
        )
    })
}

#[test]
fn every_decision_that_is_named_exists_once() {
    let mut all = records(IN_FORCE);
    all.extend(records(ARCHIVE));
    let mut numbers = BTreeSet::new();
    let twice = all
        .iter()
        .filter_map(|record| number(&record.path))
        .filter(|number| !numbers.insert((*number).to_owned()));
    let mut violations: Vec<String> = twice
        .map(|number| format!("{number} stands twice"))
        .collect();
    for text in texts() {
        violations.extend(unknown(&text, &numbers));
    }
    assert_tidy("decisions that are named", violations);
}

/// The decisions that a text names by a number that no record has.
fn unknown(text: &Text, numbers: &BTreeSet<String>) -> Vec<String> {
    let mut violations = Vec::new();
    for (line, content) in numbered(&text.content) {
        for word in ["decision ", "decisions "] {
            let named = content.split(word).skip(1).filter_map(|rest| rest.get(..4));
            let named = named.filter(|own| own.bytes().all(|byte| byte.is_ascii_digit()));
            let missing = named.filter(|own| !numbers.contains(*own));
            violations.extend(
                missing.map(|own| format!("{}:{line}: there is no decision {own}", text.path)),
            );
        }
    }
    violations
}

#[test]
fn every_link_between_pages_leads_to_one() {
    let pages = texts()
        .into_iter()
        .filter(|text| text.path.ends_with(".md"));
    let broken = pages.flat_map(|page| broken_links(&page, |path| root().join(path).exists()));
    assert_tidy("links", broken.collect());
}

fn broken_links(page: &Text, exists: impl Fn(&Path) -> bool) -> Vec<String> {
    let folder = Path::new(&page.path).parent().unwrap();
    let mut broken = Vec::new();
    for (line, content) in numbered(&page.content) {
        for rest in content.split("](").skip(1) {
            let Some((target, _)) = rest.split_once(')') else {
                continue;
            };
            let target = target.split('#').next().unwrap_or_default();
            if target.ends_with(".md")
                && !target.contains("://")
                && !exists(&flattened(&folder.join(target)))
            {
                broken.push(format!("{}:{line}: {target} is not there", page.path));
            }
        }
    }
    broken
}

/// A path without its `..`, as a reader of the page follows it.
fn flattened(path: &Path) -> PathBuf {
    let mut flat = PathBuf::new();
    for part in path.components() {
        match part {
            Component::ParentDir => {
                flat.pop();
            }
            part => flat.push(part),
        }
    }
    flat
}

#[test]
fn a_record_that_breaks_a_rule_is_noticed() {
    let text = |path: &str, content: &str| Text {
        path: path.to_owned(),
        content: content.to_owned(),
    };
    let good = "# 0001: a title\n\n**In force.**\n\n**Choice.** This.\n";
    assert!(in_force(&text("docs/decisions/0001-a.md", good)).is_empty());
    assert_eq!(in_force(&text("docs/decisions/0002-a.md", good)).len(), 1);
    let silent = "# 0001: a title\n\n**Choice.** This.\n";
    assert_eq!(in_force(&text("docs/decisions/0001-a.md", silent)).len(), 1);
    let long = format!("{good}\n{}\n", "word ".repeat(MOST_WORDS));
    assert_eq!(in_force(&text("docs/decisions/0001-a.md", &long)).len(), 2);
    assert!(archived(&text("a/0001-a.md", silent)).is_some());
    let replaced = "# 0001: a title\n\n**Superseded by [0002](../0002-b.md).**\n";
    assert!(archived(&text("a/0001-a.md", replaced)).is_none());
    let numbers = BTreeSet::from(["0001".to_owned()]);
    assert!(unknown(&text("a.md", "as in decision 0001"), &numbers).is_empty());
    let other = format!("as in {} 0002", "decision");
    assert_eq!(unknown(&text("a.md", &other), &numbers).len(), 1);
    let page = text(
        "docs/a/page.md",
        "see [one](../b.md#part) and [two](c.md)\n",
    );
    let found = broken_links(&page, |path| path == Path::new("docs/b.md"));
    assert_eq!(found, ["docs/a/page.md:1: c.md is not there"]);
}
