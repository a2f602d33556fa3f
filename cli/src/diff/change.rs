//! This file finds what two diagnoses or calibrations say differently, and says it.

use std::collections::BTreeSet;

use rigproof_report::number::probability;
use serde_json::{Value, json};

use super::side::{File, Number, Side};
use crate::text::summary::rounded;

/// Numbers that differ by a smaller share of the greater are one: what is printed has so many digits.
const SAME: f64 = 1e-9;

/// One thing that the two say differently.
pub enum Change {
    /// Words: what they are of, the first, the second.
    Words(&'static str, String, String),
    /// A name that only the first says, or only the second, and how sure it is.
    Named(String, bool, Option<f64>),
    /// A number of both: what it belongs to, its name, the first, the second.
    Number(String, String, Number, Number),
}

/// Everything that differs, the most important first.
pub fn changes(one: &Side, other: &Side) -> Vec<Change> {
    let mut all = Vec::new();
    for (what, own) in &one.words {
        let new = other.words.get(what).cloned().unwrap_or_default();
        if *own != new {
            all.push(Change::Words(what, own.clone(), new));
        }
    }
    all.sort_by_key(|own| !matches!(own, Change::Words("verdict", ..)));
    let names = |side: &Side| side.named.keys().cloned().collect::<BTreeSet<_>>();
    let (own, new) = (names(one), names(other));
    let sure = |side: &Side, name: &str| side.named.get(name).copied().flatten();
    let lost = own.difference(&new);
    all.extend(lost.map(|name| Change::Named(name.clone(), false, sure(one, name))));
    let come = new.difference(&own);
    all.extend(come.map(|name| Change::Named(name.clone(), true, sure(other, name))));
    for ((of, name), number) in &one.numbers {
        let Some(new) = other.numbers.get(&(of.clone(), name.clone())) else {
            continue;
        };
        let size = number.value.abs().max(new.value.abs());
        if (number.value - new.value).abs() > SAME * size || number.unit != new.unit {
            all.push(Change::Number(
                of.clone(),
                name.clone(),
                number.clone(),
                new.clone(),
            ));
        }
    }
    // Other findings come from other files: they are last.
    all.extend(files(one, other));
    all
}

/// The files that only one of the two read. What a file holds counts, and not where it lies or what it is called.
fn files(one: &Side, other: &Side) -> Option<Change> {
    let only = |own: &Side, other: &Side| -> String {
        let read = |file: &File| other.files.iter().any(|one| one.sha256 == file.sha256);
        let only = own.files.iter().filter(|file| !read(file));
        let only: Vec<String> = only.map(File::words).collect();
        match only.is_empty() {
            true => "–".to_owned(),
            false => only.join(", "),
        }
    };
    let (own, new) = (only(one, other), only(other, one));
    (own != new).then_some(Change::Words("files", own, new))
}

/// Whether the intervals of two numbers do not meet; nothing where one has none.
fn is_certain(one: &Number, other: &Number) -> Option<bool> {
    let [low, high] = one.interval?;
    let [other_low, other_high] = other.interval?;
    Some(high < other_low || other_high < low)
}

impl Change {
    /// In words, on one line.
    pub fn words(&self) -> String {
        match self {
            Change::Words(what, one, other) => format!("{what}: {one} → {other}"),
            Change::Named(name, is_new, sure) => {
                let which = if *is_new { "second" } else { "first" };
                let sure = sure.map_or_else(String::new, |sure| {
                    format!(", probability {}", probability(sure))
                });
                format!("only the {which} names {name}{sure}")
            }
            Change::Number(of, name, one, other) => {
                let unit = match other.unit.as_str() {
                    "" | "1" => String::new(),
                    unit => format!(" {unit}"),
                };
                let share = (other.value - one.value) / one.value.abs();
                let by = match share.is_finite() {
                    true => {
                        let more = if share > 0.0 { "more" } else { "less" };
                        format!(" ({} % {more})", rounded(100.0 * share.abs()))
                    }
                    false => String::new(),
                };
                let certain = match is_certain(one, other) {
                    Some(true) => "; the 95 % intervals do not meet",
                    Some(false) => "; within the 95 % intervals",
                    None => "",
                };
                let (old, new) = (rounded(one.value), rounded(other.value));
                format!("{of}, {name}: {old} → {new}{unit}{by}{certain}")
            }
        }
    }

    /// What changed, from what, to what.
    pub fn cells(&self) -> Vec<String> {
        let with_unit = |number: &Number| match number.unit.as_str() {
            "" | "1" => rounded(number.value),
            unit => format!("{} {unit}", rounded(number.value)),
        };
        match self {
            Change::Words(what, one, other) => {
                vec![(*what).to_owned(), one.clone(), other.clone()]
            }
            Change::Named(name, is_new, _) => {
                let [one, other] = if *is_new {
                    ["–", "named"]
                } else {
                    ["named", "–"]
                };
                vec![name.clone(), one.to_owned(), other.to_owned()]
            }
            Change::Number(of, name, one, other) => {
                vec![format!("{of}, {name}"), with_unit(one), with_unit(other)]
            }
        }
    }

    /// For a program.
    pub fn json(&self) -> Value {
        let number = |own: &Number| json!({ "value": own.value, "unit": own.unit, "interval95": own.interval });
        let mut result = match self {
            Change::Words(what, one, other) => {
                json!({ "kind": "words", "what": what, "one": one, "other": other })
            }
            Change::Named(name, is_new, sure) => {
                json!({ "kind": "name", "what": name, "in": if *is_new { "other" } else { "one" }, "probability": sure })
            }
            Change::Number(of, name, one, other) => json!({
                "kind": "number", "what": of, "name": name, "one": number(one), "other": number(other),
                "beyond_intervals": is_certain(one, other),
            }),
        };
        result["in_words"] = json!(self.words());
        result
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn number(value: f64, half: f64) -> Number {
        Number {
            value,
            unit: "N".to_owned(),
            interval: Some([value - half, value + half]),
        }
    }

    #[test]
    fn a_file_is_another_by_what_it_holds_and_not_by_its_path() {
        let side = |files: [(&str, &str); 2]| {
            let inputs: Vec<Value> = files
                .iter()
                .map(|(path, hash)| json!({ "path": path, "sha256": hash.repeat(32) }))
                .collect();
            Side::of_report(&json!({ "verdict": "explained", "inputs": inputs }))
        };
        let own = side([("monday/run.csv", "a7"), ("rig.toml", "19")]);
        let moved = side([("friday/run-2.csv", "a7"), ("old/rig.toml", "19")]);
        assert!(changes(&own, &moved).is_empty());
        let other = side([("monday/run.csv", "a7"), ("rig.toml", "2b")]);
        let said: Vec<String> = changes(&own, &other).iter().map(Change::words).collect();
        assert_eq!(
            said,
            ["files: rig.toml (191919191919) → rig.toml (2b2b2b2b2b2b)"]
        );
    }

    #[test]
    fn a_number_changed_for_certain_where_the_intervals_do_not_meet() {
        let change = |half| {
            Change::Number(
                "drag".into(),
                "level".into(),
                number(4.0, half),
                number(5.0, half),
            )
        };
        let said = change(0.2).words();
        assert_eq!(
            said,
            "drag, level: 4.00 → 5.00 N (25.0 % more); the 95 % intervals do not meet"
        );
        assert!(change(0.7).words().ends_with("within the 95 % intervals"));
        assert_eq!(change(0.2).json()["beyond_intervals"], true);
    }
}
