//! This file says where the numbers stand that decide, and that no room keeps a list of mechanisms of its own.

use crate::tidy::assert_tidy;
use crate::tidy::workspace::{Text, numbered, sources};

/// Numbers of `diagnose` that decide nothing, by file and name, with the reason.
const NO_RULES: [(&str, &str, &str); 28] = [
    ("joint/sweep.rs", "ROW_S", "a time that no law reads"),
    ("chain/run.rs", "SAME", "rounding of a difference"),
    ("joint/columns.rs", "SMALL", "a difference step"),
    ("evidence.rs", "SHAPE_STEP", "a difference step"),
    ("evidence.rs", "NULL_RATIO", "rounding of an eigenvalue"),
    ("evidence/intervals.rs", "NORMAL", "a quantile"),
    (
        "inverse.rs",
        "FILTER_ORDER",
        "a published way, shown beside ours",
    ),
    (
        "inverse.rs",
        "CUTOFF_HZ",
        "a published way, shown beside ours",
    ),
    (
        "inverse.rs",
        "DECIMATION",
        "a published way, shown beside ours",
    ),
    ("inverse.rs", "BORDER", "a published way, shown beside ours"),
    ("refit.rs", "STEP", "a difference step"),
    ("joint/columns.rs", "SUBSTEPS", "steps of an integration"),
    ("explain/fitted.rs", "RIDGE", "rounding of an inverse"),
    ("five_bar/encoder.rs", "LEAST_STEP", "a difference step"),
    ("five_bar/encoder.rs", "AMIDST_M", "a place to start from"),
    ("five_bar/encoder.rs", "SIGNALS", "a count of signals"),
    ("plant/replayed.rs", "RESTART_S", "a picture"),
    ("five_bar/replay.rs", "RATE_HZ", "a picture"),
    ("five_bar/replay.rs", "LONGEST_S", "a picture"),
    ("continuity/jumps.rs", "BITS", "widths of counters"),
    ("continuity/straight.rs", "ROUNDING", "rounding of a text"),
    ("five_bar/free_run.rs", "MIDDLE_M", "a place to start from"),
    ("joint/agreement.rs", "NORMAL", "a quantile"),
    ("joint/encoder.rs", "ROUNDS", "steps of an iteration"),
    ("joint/laws.rs", "FAR", "as good as infinite"),
    ("joint/own_calibration.rs", "COUNT", "a test"),
    (
        "joint/simulate.rs",
        "LEAST_INERTIA",
        "keeps a division finite",
    ),
    ("joint/start.rs", "ROUNDS", "steps of an iteration"),
];

/// Files of `diagnose` that are compiled for tests only.
const TESTS: [&str; 3] = ["tests.rs", "recorded.rs", "mechanisms.rs"];

#[test]
fn no_number_that_decides_stands_outside_the_rules() {
    let mut violations = Vec::new();
    for source in sources() {
        let Some(file) = source.path.strip_prefix("diagnose/src/") else {
            continue;
        };
        if file.starts_with("rules/") || TESTS.iter().any(|own| file.ends_with(own)) {
            continue;
        }
        for (line, name) in numbers(&source) {
            if !NO_RULES
                .iter()
                .any(|(at, own, _)| file.ends_with(at) && name == *own)
            {
                violations.push(format!(
                    "{}:{line}: `{name}` belongs into diagnose/src/rules, or, if it decides nothing, with a reason into NO_RULES",
                    source.path
                ));
            }
        }
    }
    assert_tidy("numbers that decide", violations);
}

/// Constants that are numbers or lists of numbers, up to the tests at the end of a file.
fn numbers(source: &Text) -> Vec<(usize, String)> {
    let code = source.content.split("#[cfg(test)]\nmod tests {").next();
    numbered(code.unwrap_or_default())
        .filter_map(|(line, text)| {
            let (before, after) = text.split_once("const ")?;
            let starts = ["", "pub ", "pub(crate) ", "pub(super) "];
            let (name, rest) = after.split_once(": ")?;
            let kind = rest.split_once(" =")?.0.trim_start_matches('[');
            let is_number = ["f64", "usize", "i32", "u32", "core::ops::Range"]
                .iter()
                .any(|number| kind.starts_with(number));
            (starts.contains(&before.trim_start()) && is_number).then(|| (line, name.to_owned()))
        })
        .collect()
}

#[test]
fn a_number_that_decides_is_noticed() {
    let content = "pub const LEAST: f64 = 0.1;\nconst WIDTHS_S: [f64; 2] = [0.1, 0.2];\nconst NAME: &str = \"a\";\nconst fn f(x: f64) -> f64 { x }\n#[cfg(test)]\nmod tests {\nconst IN_TEST: f64 = 1.0;\n}\n";
    let found = numbers(&Text {
        path: "diagnose/src/example.rs".to_owned(),
        content: content.to_owned(),
    });
    let names: Vec<&str> = found.iter().map(|(_, name)| name.as_str()).collect();
    assert_eq!(names, ["LEAST", "WIDTHS_S"]);
    let left: Vec<&str> = NO_RULES.iter().map(|(_, name, _)| *name).collect();
    let source = sources().into_iter();
    let all: Vec<String> = source
        .filter(|source| source.path.starts_with("diagnose/src/"))
        .flat_map(|source| numbers(&source))
        .map(|(_, name)| name)
        .collect();
    for name in left {
        assert!(
            all.iter().any(|own| own == name),
            "{name} is gone: take it out of NO_RULES"
        );
    }
}

/// Rooms that look facts of a mechanism up and keep no list of their own. `impl` and `blind` are written without the library on purpose.
const LOOK_UP: [&str; 6] = [
    "diagnose/src/",
    "model/src/rig",
    "report/src/",
    "certify/src/",
    "trace/src/",
    "cli/src/",
];

/// Most mechanisms that a file of these rooms may name outside its tests: a list needs three.
const MOST_NAMED: usize = 3;

#[test]
fn no_room_keeps_a_list_of_mechanisms() {
    let mut violations = Vec::new();
    for source in sources() {
        let is_test = TESTS.iter().any(|own| source.path.ends_with(own));
        if is_test || !LOOK_UP.iter().any(|room| source.path.starts_with(room)) {
            continue;
        }
        let named = named(&source.content);
        if named.len() > MOST_NAMED {
            violations.push(format!(
                "{}: it names {}: make what they share a fact of the library (model/src/effects/facts.rs)",
                source.path,
                named.join(", ")
            ));
        }
    }
    assert_tidy("lists of mechanisms", violations);
}

/// The mechanisms that a source names before its tests, each once.
fn named(content: &str) -> Vec<&str> {
    let before = |opening: &str| content.split(opening).next().unwrap_or_default();
    let code = ["", "pub(super) ", "pub(crate) "]
        .map(|seen| before(&format!("#[cfg(test)]\n{seen}mod tests {{")))
        .into_iter()
        .min_by_key(|code| code.len())
        .unwrap_or_default();
    let after = code.split("Mechanism::").skip(1);
    let mut named: Vec<&str> = after
        .filter_map(|rest| {
            rest.split(|c: char| !c.is_alphanumeric() && c != '_')
                .next()
        })
        .filter(|name| name.starts_with(char::is_uppercase) && *name != "ALL")
        .collect();
    named.sort_unstable();
    named.dedup();
    named
}

#[test]
fn a_list_of_mechanisms_is_noticed() {
    let list = "const A: [Mechanism; 2] = [Mechanism::Lag, Mechanism::Viscous]; Mechanism::ALL; Mechanism::from_name(x); Mechanism::Lag\n#[cfg(test)]\nmod tests { Mechanism::Spring }";
    assert_eq!(named(list), ["Lag", "Viscous"]);
    let seen = list.replace("mod tests", "pub(super) mod tests");
    assert_eq!(named(&seen), ["Lag", "Viscous"]);
}
