//! This file says that page and code stay tied: every equation is obeyed and witnessed, or its defect is written down.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;

use toml::{Table, Value};

use crate::tidy::assert_tidy;
use crate::tidy::rust::test_names;
use crate::tidy::workspace::{numbered, root, sources};

/// One `//= thesis (3.3)` line.
struct Citation {
    place: String,
    room: String,
    equation: String,
    /// Nothing above code; `test` or `proof` above a witness.
    witness: String,
}

#[test]
fn every_cited_equation_is_known() {
    assert_tidy("unknown citations", unknown(&citations(), &equations()));
}

fn unknown(citations: &[Citation], known: &BTreeSet<String>) -> Vec<String> {
    citations
        .iter()
        .filter(|citation| {
            !known.contains(&citation.equation)
                || !["", "test", "proof"].contains(&citation.witness.as_str())
        })
        .map(|citation| {
            format!(
                "{}: cite a number of spec/thesis/equations.md, alone or followed by `test` or `proof`",
                citation.place
            )
        })
        .collect()
}

#[test]
fn every_equation_is_obeyed_and_witnessed_or_accounted_for() {
    let citations = citations();
    let accounted: BTreeSet<String> = [records("errata", "erratum"), records("gaps", "gap")]
        .concat()
        .iter()
        .filter_map(|record| record.get("equation"))
        .map(|equation| equation.as_str().unwrap().to_owned())
        .collect();
    let violations = untied(equations(), &citations, &accounted);
    assert_tidy("equations without code or witness", violations);
}

fn untied(
    equations: BTreeSet<String>,
    citations: &[Citation],
    accounted: &BTreeSet<String>,
) -> Vec<String> {
    let mut violations = Vec::new();
    for equation in equations {
        let of = |citation: &&Citation| citation.equation == equation;
        let obeyed = citations
            .iter()
            .filter(of)
            .any(|c| c.room == "model" && c.witness.is_empty());
        let witnessed = citations.iter().filter(of).any(|c| c.witness == "test");
        let tied = obeyed && witnessed;
        if !tied && !accounted.contains(&equation) {
            violations.push(format!(
                "spec/thesis/equations.md: ({equation}): cite it in model and above a test, or account for it in \
                 errata.toml or gaps.toml"
            ));
        }
    }
    violations
}

#[test]
fn an_equation_without_code_or_witness_is_noticed() {
    let cited = |room: &str, equation: &str, witness: &str| Citation {
        place: format!("{room}/src/example.rs:7"),
        room: room.to_owned(),
        equation: equation.to_owned(),
        witness: witness.to_owned(),
    };
    let set =
        |numbers: &[&str]| -> BTreeSet<String> { numbers.iter().map(|&n| n.to_owned()).collect() };
    let citations = [
        cited("model", "3.3", ""),
        cited("tests", "3.3", "test"),
        cited("model", "3.4", ""),
        cited("impl", "3.5", ""),
        cited("tests", "3.5", "test"),
        cited("model", "9.9", "claim"),
    ];
    let all = set(&["3.3", "3.4", "3.5", "3.6"]);
    assert_eq!(untied(all.clone(), &citations, &set(&["3.6"])).len(), 2);
    assert_eq!(
        untied(all.clone(), &citations, &set(&["3.4", "3.5", "3.6"])).len(),
        0
    );
    assert_eq!(unknown(&citations, &all).len(), 1);
    assert_eq!(unknown(&citations, &set(&["3.4", "3.5"])).len(), 3);
}

#[test]
fn every_erratum_and_gap_is_whole() {
    let (tests, known) = (test_names(), equations());
    let mut violations = Vec::new();
    for (file, kind, keys) in [("errata", "erratum", ERRATUM), ("gaps", "gap", GAP)] {
        for (id, advice) in broken(&records(file, kind), keys, &tests, &known) {
            violations.push(format!(
                "spec/thesis/{file}.toml: [[{kind}]] `{id}`: {advice}"
            ));
        }
    }
    assert_tidy("errata and gaps", violations);
}

/// What an erratum and a gap have to say.
const ERRATUM: [&str; 4] = ["printed", "intended", "reason", "evidence"];
const GAP: [&str; 4] = ["where", "open", "chosen", "decision"];

/// Each record's id and what it lacks.
fn broken(
    records: &[Table],
    keys: [&str; 4],
    tests: &BTreeSet<String>,
    known: &BTreeSet<String>,
) -> Vec<(String, String)> {
    let (mut ids, mut broken) = (BTreeSet::new(), Vec::new());
    for record in records {
        let id = text(record, "id").unwrap_or_default();
        let mut fail = |advice: String| broken.push((id.clone(), advice));
        if !ids.insert(id.clone()) || id.is_empty() {
            fail("give it an id of its own".to_owned());
        }
        for key in keys {
            if text(record, key).is_none_or(|value| value.is_empty()) {
                fail(format!("say `{key}`"));
            }
        }
        if let Some(evidence) = text(record, "evidence")
            && !tests.contains(&evidence)
        {
            fail(format!("no test is named `{evidence}`"));
        }
        if let Some(decision) = text(record, "decision")
            && !root().join(&decision).is_file()
        {
            fail(format!("no file `{decision}`"));
        }
        match text(record, "equation") {
            Some(equation) if !known.contains(&equation) => {
                fail(format!("({equation}) is not in spec/thesis/equations.md"));
            }
            None if text(record, "where").is_none() => {
                fail("say `equation` or `where`".to_owned());
            }
            _ => {}
        }
    }
    broken
}

#[test]
fn an_erratum_that_says_too_little_is_noticed() {
    let record = |text: &str| -> Table { text.parse().unwrap() };
    let set = |name: &str| BTreeSet::from([name.to_owned()]);
    let whole = "printed = \"a\"\nintended = \"b\"\nreason = \"c\"\nevidence = \"it_is_so\"\n";
    let broken = |records: &[Table]| {
        let found = broken(records, ERRATUM, &set("it_is_so"), &set("3.3"));
        found.into_iter().map(|(id, _)| id).collect::<Vec<_>>()
    };
    let fine = record(&format!("id = \"fine\"\nequation = \"3.3\"\n{whole}"));
    assert!(broken(std::slice::from_ref(&fine)).is_empty());
    assert_eq!(broken(&[fine.clone(), fine]), ["fine"]);
    for (id, text) in [
        ("elsewhere", format!("equation = \"9.9\"\n{whole}")),
        ("nowhere", whole.to_owned()),
        (
            "unseen",
            whole.replace("it_is_so", "is_it") + "where = \"4.1\"\n",
        ),
        (
            "undecided",
            format!("where = \"4.1\"\ndecision = \"docs/none.md\"\n{whole}"),
        ),
        (
            "silent",
            whole.replace("\"b\"", "\"\"") + "where = \"4.1\"\n",
        ),
    ] {
        assert_eq!(broken(&[record(&format!("id = \"{id}\"\n{text}"))]), [id]);
    }
}

#[test]
fn every_erratum_or_gap_named_in_a_comment_exists() {
    let ids: BTreeSet<String> = [records("errata", "erratum"), records("gaps", "gap")]
        .concat()
        .iter()
        .filter_map(|record| text(record, "id"))
        .collect();
    let mut violations = Vec::new();
    for source in sources() {
        for (number, line) in numbered(&source.content) {
            let missing = named(line).filter(|id| !ids.contains(*id));
            violations.extend(
                missing.map(|id| format!("{}:{number}: `{id}` is in neither file", source.path)),
            );
        }
    }
    assert_tidy("errata and gaps named in comments", violations);
}

/// The errata and gaps that a comment names.
fn named(line: &str) -> impl Iterator<Item = &str> {
    let is_comment = line.trim().starts_with("//");
    let named = ["(erratum `", "(gap `"].into_iter().flat_map(|kind| {
        let after = line.split(kind).skip(1);
        after.map(|rest| rest.split('`').next().unwrap())
    });
    named.filter(move |_| is_comment)
}

#[test]
fn an_erratum_named_in_a_comment_is_read() {
    let line = "    /// As printed (erratum `one`), but (gap `two`) for (gap `three`).";
    assert_eq!(named(line).collect::<Vec<_>>(), ["one", "two", "three"]);
    assert_eq!(named("let text = \"(gap `two`)\";").count(), 0);
}

#[test]
fn every_cited_section_is_known_and_has_code_and_a_witness() {
    let table = fs::read_to_string(root().join("spec/thesis/sections.md")).unwrap();
    let known: BTreeSet<&str> = table
        .lines()
        .filter_map(|line| line.strip_prefix("| §"))
        .filter_map(|line| line.split_once(" |"))
        .map(|(number, _)| number)
        .collect();
    let mut cited: BTreeMap<String, [bool; 2]> = BTreeMap::new();
    let mut violations = Vec::new();
    for source in sources() {
        for (number, line) in numbered(&source.content) {
            let Some(rest) = line.trim().strip_prefix("//= thesis section ") else {
                continue;
            };
            let (section, witness) = rest.split_once(' ').unwrap_or((rest, ""));
            if !known.contains(section) || !["", "test", "proof"].contains(&witness) {
                violations.push(format!(
                    "{}:{number}: cite a section of spec/thesis/sections.md, alone or followed by `test` or `proof`",
                    source.path
                ));
            }
            let found = cited.entry(section.to_owned()).or_default();
            found[usize::from(witness == "test")] = true;
        }
    }
    for (section, found) in cited {
        if found != [true; 2] {
            violations.push(format!(
                "section {section}: cite it above code and above a test"
            ));
        }
    }
    assert!(
        known.contains("2.2.1"),
        "spec/thesis/sections.md is not read"
    );
    assert_tidy("citations of sections", violations);
}

/// The numbers in the first column of `spec/thesis/equations.md`.
fn equations() -> BTreeSet<String> {
    let table = fs::read_to_string(root().join("spec/thesis/equations.md")).unwrap();
    let numbers: BTreeSet<String> = table
        .lines()
        .filter_map(|line| line.strip_prefix("| ("))
        .filter_map(|line| line.split_once(") |"))
        .map(|(number, _)| number.to_owned())
        .collect();
    assert!(
        numbers.contains("3.3"),
        "spec/thesis/equations.md is not read"
    );
    numbers
}

fn citations() -> Vec<Citation> {
    let mut citations = Vec::new();
    for source in sources() {
        for (number, line) in numbered(&source.content) {
            let Some(cited) = line.trim().strip_prefix("//= thesis") else {
                continue;
            };
            if cited.starts_with(" section ") {
                continue;
            }
            let (equation, witness) = cited.trim().split_once(')').unwrap_or_default();
            citations.push(Citation {
                place: format!("{}:{number}", source.path),
                room: source.path.split('/').next().unwrap().to_owned(),
                equation: equation.trim_start_matches('(').to_owned(),
                witness: witness.trim().to_owned(),
            });
        }
    }
    assert!(
        citations.len() > 7,
        "only {} citations are read",
        citations.len()
    );
    citations
}

fn records(file: &str, kind: &str) -> Vec<Table> {
    let path = format!("spec/thesis/{file}.toml");
    let content = fs::read_to_string(root().join(&path)).unwrap();
    let table: Table = content
        .parse()
        .unwrap_or_else(|error| panic!("{path}: {error}"));
    let records = table[kind].as_array().unwrap();
    records
        .iter()
        .map(|record| record.as_table().unwrap().clone())
        .collect()
}

fn text(record: &Table, key: &str) -> Option<String> {
    record.get(key).and_then(Value::as_str).map(str::to_owned)
}
