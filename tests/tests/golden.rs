//! This file says that the checked-in cases are what the model computes, that they show something, and that nothing lacks one.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use rayon::prelude::*;
use rigproof_golden::{Case, Manifest, Table, Value, cases, check, orphans};
use rigproof_spec::joint::Joint;
use rigproof_spec::methods::Method;
use sha2::{Digest, Sha256};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../golden/cases")
}

fn read(case: &Case, name: &str) -> Vec<u8> {
    fs::read(folder().join(&case.name).join(name)).unwrap()
}

fn manifest(case: &Case) -> Manifest {
    toml::from_slice(&read(case, "manifest.toml")).unwrap()
}

fn table(case: &Case, name: &str) -> Table {
    Table::parse(&read(case, name)).unwrap()
}

#[test]
fn every_case_is_what_the_model_computes() {
    let cases = cases();
    let found = cases.par_iter().with_max_len(1).map(|case| {
        let differences = check(case, &folder()).unwrap();
        differences.into_iter().map(|d| format!("{d:?}")).collect()
    });
    let found: Vec<Vec<String>> = found.collect();
    assert!(found.concat().is_empty(), "{}", found.concat().join("\n"));
}

#[test]
fn what_is_expected_follows_from_the_input_file_alone() {
    for case in cases().iter().filter(|case| case.name.starts_with("brake")) {
        let computed = case.expected(&table(case, "input.csv")).unwrap();
        assert!(computed == table(case, "expected.csv"), "{}", case.name);
    }
}

#[test]
fn the_bytes_of_every_file_have_the_hash_of_its_manifest() {
    for case in cases() {
        let files = manifest(&case).files;
        let names: Vec<&str> = files.iter().map(|file| file.name.as_str()).collect();
        assert_eq!(names, ["input.csv", "expected.csv"]);
        for file in &files {
            let digest = Sha256::digest(read(&case, &file.name));
            let digest: String = digest.iter().map(|byte| format!("{byte:02x}")).collect();
            assert_eq!(digest, file.sha256, "{}/{}", case.name, file.name);
        }
    }
}

#[test]
fn nothing_lies_there_that_no_case_writes() {
    assert_eq!(orphans(&cases(), &folder()).unwrap(), []);
    let desk = tempfile::tempdir().unwrap();
    fs::create_dir_all(desk.path().join("brake_step_a")).unwrap();
    fs::write(desk.path().join("brake_step_a/notes.txt"), "mine").unwrap();
    fs::create_dir_all(desk.path().join("brake_step_d")).unwrap();
    let found = orphans(&cases(), desk.path()).unwrap();
    let names: Vec<(&str, &str)> = found.iter().map(|d| (&*d.case, &*d.file)).collect();
    assert_eq!(names, [("brake_step_a", "notes.txt"), ("brake_step_d", "")]);
}

#[test]
fn every_run_that_stands_still_breaks_a_claim() {
    for case in cases() {
        let manifest = manifest(&case);
        let (input, expected) = (table(&case, "input.csv"), table(&case, "expected.csv"));
        let runs = case.runs.len();
        let missing = |expected: &Table| -> usize {
            let claims = manifest.must_show.iter();
            claims
                .map(|claim| claim.missing(runs, &input, expected).len())
                .sum()
        };
        assert_eq!(missing(&expected), 0, "{}", case.name);
        for run in 1..=runs {
            let still = frozen(&expected, run);
            assert!(
                missing(&still) > 0,
                "{}: run {run} may stand still",
                case.name
            );
            let mut absent = expected.clone();
            absent.rows.retain(|row| row[0] != run.to_string());
            assert!(
                missing(&absent) > 0,
                "{}: run {run} may be absent",
                case.name
            );
        }
    }
}

/// The table with every row of a run made like its first.
fn frozen(table: &Table, run: usize) -> Table {
    let mut still = table.clone();
    let run = run.to_string();
    let first = table.rows.iter().find(|row| row[0] == run).unwrap();
    for row in still.rows.iter_mut().filter(|row| row[0] == run) {
        row.clone_from(first);
    }
    still
}

#[test]
fn every_number_of_the_cases_stands_in_ten_digits() {
    for case in cases() {
        for name in ["input.csv", "expected.csv"] {
            let table = table(&case, name);
            assert!(table.rows.len() > 3, "{}/{name}", case.name);
            for row in &table.rows {
                for ((column, unit), cell) in table.columns.iter().zip(row) {
                    if !unit.is_empty() {
                        let digits = cell.trim_start_matches('-').split('e').next().unwrap();
                        assert_eq!(digits.len(), 11, "{}/{name} {column}: {cell}", case.name);
                        assert!(cell.parse::<f64>().unwrap().is_finite());
                    }
                }
            }
        }
    }
}

/// The words of one parameter in all cases.
fn words(name: &str) -> BTreeSet<String> {
    let cases = cases();
    let parameters = cases.iter().flat_map(|case| {
        let of_runs = case.runs.iter().flat_map(|run| &run.parameters);
        case.parameters.iter().chain(of_runs)
    });
    let named = parameters.filter(|parameter| parameter.name == name);
    named
        .map(|parameter| match &parameter.value {
            Value::Word(word) => word.clone(),
            Value::Number(number) => panic!("{name} is {number}"),
        })
        .collect()
}

fn set(names: &[&str]) -> BTreeSet<String> {
    names.iter().map(|name| (*name).to_owned()).collect()
}

#[test]
fn every_brake_layout_and_locked_brake_has_a_case() {
    let names: BTreeSet<String> = cases().into_iter().map(|case| case.name).collect();
    for joint in Joint::ALL {
        for kind in ["step", "sinusoid", "current"] {
            let name = format!("brake_{kind}_{}", joint.letter().to_lowercase());
            assert!(names.contains(&name), "{name}");
        }
    }
    assert_eq!(words("brake"), set(&["A", "E", "B", "C"]));
    assert_eq!(words("layout"), set(&["three_brake", "four_brake"]));
    for case in cases() {
        let locked: Vec<&Value> = case
            .runs
            .iter()
            .flat_map(|run| &run.parameters)
            .filter(|parameter| parameter.name == "locked brake")
            .map(|parameter| &parameter.value)
            .collect();
        match case.name.as_str() {
            "release_three_brake" => assert_eq!(locked.len(), 4),
            "release_four_brake" => assert_eq!(locked.len(), 5),
            _ => assert!(locked.is_empty(), "{}", case.name),
        }
    }
    assert_eq!(words("locked brake"), set(&["none", "A", "E", "B", "C"]));
}

#[test]
fn every_controller_of_the_model_has_a_run_on_both_layouts() {
    let sources = Path::new(env!("CARGO_MANIFEST_DIR")).join("../model/src/control");
    let mut laws = BTreeSet::new();
    for entry in fs::read_dir(sources).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|extension| extension == "rs") {
            let text = fs::read_to_string(path).unwrap();
            for (_, rest) in text.match_indices(" Controller for ").map(|(at, found)| {
                let end = at + found.len();
                text.split_at(end)
            }) {
                let name = rest.split(|c: char| !c.is_alphanumeric()).next().unwrap();
                laws.insert(name.to_owned());
            }
        }
    }
    assert!(laws.contains("Sdof") && laws.len() >= 7, "{laws:?}");
    assert_eq!(words("controller"), laws);
    for case in cases().iter().filter(|case| case.name.starts_with("path_")) {
        let controllers = case.runs.iter().flat_map(|run| &run.parameters);
        let controllers = controllers.filter(|parameter| parameter.name == "controller");
        // Each row of table 6.1, and the laws that are none of its rows: velocity ratio, optimal, impedance, obstacle.
        assert_eq!(controllers.count(), Method::ALL.len() + 4, "{}", case.name);
    }
}

#[test]
fn every_equation_that_a_case_cites_is_one_of_the_thesis() {
    let list = include_str!("../../spec/thesis/equations.md");
    for case in cases() {
        let numbered = case.citations.iter().filter(|place| place.starts_with('('));
        let mut count = 0;
        for place in numbered {
            let row = format!("| {place} |");
            assert!(list.contains(&row), "{}: {place}", case.name);
            count += 1;
        }
        assert!(count > 0, "{} cites no equation", case.name);
    }
}

#[test]
fn the_cases_stay_small() {
    let size = |case: &Case| -> usize {
        let names = ["manifest.toml", "input.csv", "expected.csv"];
        names.iter().map(|name| read(case, name).len()).sum()
    };
    let total: usize = cases().iter().map(size).sum();
    println!("{total} bytes in all");
    assert!(total < 3_000_000, "{total} bytes");
}
