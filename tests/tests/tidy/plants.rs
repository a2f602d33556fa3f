//! This file says how many places may ask which plant they have before them: few outside its folder and the registry.

use crate::tidy::assert_tidy;
use crate::tidy::workspace::{Text, numbered, sources};

/// The most branches on a kind of plant in rooms that get a plant from the registry.
const MOST: usize = 12;

/// The rooms that get their plant from the registry. `trace` reads what a description says, `blind` makes plants of its own.
const ROOMS: [&str; 4] = ["diagnose/src/", "report/src/", "certify/src/", "cli/src/"];

/// What must not know any plant.
const KNOWS_NONE: [&str; 11] = [
    "diagnose/src/select",
    "diagnose/src/evidence",
    "diagnose/src/regression",
    "diagnose/src/weak",
    "diagnose/src/whiten",
    "diagnose/src/locate",
    "diagnose/src/unknown",
    "diagnose/src/candidates",
    "diagnose/src/problem",
    "diagnose/src/diagnose/",
    "diagnose/src/plant",
];

/// Types whose values are kinds of plants, and what they may be.
const TYPES: [&str; 4] = ["Plant", "PlantKind", "Description", "Measured"];
const KINDS: [&str; 5] = ["Axis", "Bench", "Rig", "FiveBar", "Joint"];

/// Kinds of plants as reports name them.
const NAMES: [&str; 3] = ["\"axis\"", "\"bench\"", "\"rig\""];

/// The lines of a source before its unit tests.
fn own_lines(source: &Text) -> impl Iterator<Item = (usize, &str)> {
    let lines = numbered(&source.content);
    lines.take_while(|(_, line)| !line.starts_with("#[cfg(test)]"))
}

/// Whether a line does one thing or another by the kind of a plant.
fn branches(line: &str) -> bool {
    let code = line.split("//").next().unwrap_or_default();
    let mut kinds = TYPES
        .iter()
        .flat_map(|of| KINDS.map(|kind| format!("{of}::{kind}")));
    let by_value = kinds.any(|kind| {
        let Some(at) = code.find(&kind) else {
            return false;
        };
        let (before, after) = code.split_at(at);
        let is_pattern = after.contains("=>") || after.contains(") =") || after.contains(") |");
        let is_compared = before.ends_with("== ") || before.ends_with("!= ");
        is_pattern || is_compared || before.contains("matches!")
    });
    let by_name = NAMES.iter().any(|name| {
        code.contains(&format!("{name} =>"))
            || code.contains(&format!("{name} |"))
            || code.contains(&format!("== {name}"))
            || code.contains(&format!("!= {name}"))
    });
    by_value || by_name || code.contains("FiveBar::describes")
}

fn is_of_a_plant(path: &str) -> bool {
    path.starts_with("diagnose/src/plants")
}

fn asked(sources: &[Text]) -> Vec<String> {
    let own = sources.iter().filter(|source| {
        let in_room = ROOMS.iter().any(|room| source.path.starts_with(room));
        in_room && !is_of_a_plant(&source.path) && !source.path.ends_with("tests.rs")
    });
    own.flat_map(|source| {
        let lines = own_lines(source).filter(|(_, line)| branches(line));
        lines.map(|(number, line)| format!("{}:{number}: {}", source.path, line.trim()))
    })
    .collect()
}

#[test]
fn few_places_ask_which_plant_they_have() {
    let found = asked(&sources());
    println!("{}", found.join("\n"));
    assert!(
        found.len() <= MOST,
        "{} branches on a kind of plant, at most {MOST}: ask the run or the description instead\n{}",
        found.len(),
        found.join("\n")
    );
}

#[test]
fn what_judges_knows_no_plant() {
    assert_tidy("plants known", known(&sources()));
}

fn known(sources: &[Text]) -> Vec<String> {
    let own = sources.iter().filter(|source| {
        let judges = KNOWS_NONE.iter().any(|part| source.path.starts_with(part));
        judges && !is_of_a_plant(&source.path) && !source.path.ends_with("tests.rs")
    });
    own.flat_map(|source| {
        let lines = own_lines(source).filter(|(_, line)| {
            let code = line.split("//").next().unwrap_or_default();
            [
                "five_bar",
                "FiveBar",
                "plants::joint",
                "JointRun",
                "PlantKind",
            ]
            .iter()
            .any(|word| code.contains(word))
        });
        lines.map(|(number, _)| {
            format!(
                "{}:{number}: names a plant; what it needs of one stands in diagnose/src/plant.rs",
                source.path
            )
        })
    })
    .collect()
}

#[test]
fn a_branch_and_a_named_plant_are_found() {
    for line in [
        "        PlantKind::Axis => 8.0,",
        "    if plant == Plant::Bench {",
        "    let Description::FiveBar(own) = rig else {",
        "        \"rig\" => five_bar(),",
    ] {
        assert!(branches(line), "{line}");
    }
    for line in [
        "    plant: PlantKind::Axis,",
        "    // Plant::Axis => none",
        "    \"axis\",",
    ] {
        assert!(!branches(line), "{line}");
    }
    let text = |path: &str, content: &str| Text {
        path: path.to_owned(),
        content: content.to_owned(),
    };
    let bad = text(
        "diagnose/src/select/new.rs",
        "//! New.\n\nuse crate::plants::five_bar;\n",
    );
    assert_eq!(known(&[bad]).len(), 1);
    let own = text(
        "diagnose/src/plants/five_bar/new.rs",
        "//! New.\n\nuse crate::plants::five_bar;\n",
    );
    assert_eq!(known(&[own]).len(), 0);
}
