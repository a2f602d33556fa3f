//! This file reads what a report names and offers.

use crate::answer::key;
use crate::error::Error;
use crate::plant::Plant;
use serde_json::{Map, Value};

/// One named effect of a report.
pub struct Found<'a> {
    /// The mechanism, on a five-bar with its joint, such as `viscous at E`.
    pub name: String,
    pub mechanism: &'a str,
    /// The joint that is named, if one is.
    pub joint: Option<&'a str>,
    /// How sure the report is; 1 where it does not say.
    pub probability: f64,
    pub onset: Option<Onset>,
    pub parameters: Option<&'a Map<String, Value>>,
    pub alternatives: Vec<String>,
}

/// When an effect is said to begin.
#[derive(Clone, Copy)]
pub struct Onset {
    /// The time, s.
    pub value_s: f64,
    /// Its 95 % interval, s, where there is one.
    pub interval_s: Option<[f64; 2]>,
}

/// The named effects of a report.
///
/// # Errors
/// [`Error::Report`] when `effects` or the mechanism of one is missing.
pub fn found_effects(plant: Plant, report: &Value) -> Result<Vec<Found<'_>>, Error> {
    effects_that_are(plant, report, |status| {
        status.is_none_or(|status| status == "named")
    })
}

/// The suspected effects of a report: they are offered, not named.
///
/// # Errors
/// As [`found_effects`].
pub fn suspected_effects(plant: Plant, report: &Value) -> Result<Vec<Found<'_>>, Error> {
    effects_that_are(plant, report, |status| status == Some("suspected"))
}

fn effects_that_are(
    plant: Plant,
    report: &Value,
    are: impl Fn(Option<&str>) -> bool,
) -> Result<Vec<Found<'_>>, Error> {
    let effects = report
        .get("effects")
        .and_then(Value::as_array)
        .ok_or(Error::Report("array \"effects\""))?;
    let those = effects
        .iter()
        .enumerate()
        .filter(|(_, effect)| are(effect.get("status").and_then(Value::as_str)));
    those
        .map(|(index, effect)| {
            let mut alternatives = Vec::new();
            let of_report = report
                .get("ambiguous_with")
                .and_then(|list| list.get(index));
            for list in [of_report, effect.get("ambiguous_with")]
                .into_iter()
                .flatten()
            {
                collect_names(plant, list, &mut alternatives);
            }
            let mechanism = effect
                .get("mechanism")
                .and_then(Value::as_str)
                .ok_or(Error::Report("string \"mechanism\" in an effect"))?;
            Ok(Found {
                name: name(plant, mechanism, effect),
                mechanism,
                joint: joint(effect),
                probability: effect
                    .get("probability")
                    .and_then(Value::as_f64)
                    .unwrap_or(1.0),
                onset: onset(effect),
                parameters: effect.get("parameters").and_then(Value::as_object),
                alternatives,
            })
        })
        .collect()
}

/// On axis and bench there is one joint, which no report has to name.
fn name(plant: Plant, mechanism: &str, effect: &Value) -> String {
    match plant {
        Plant::Rig | Plant::Chain => key(mechanism, joint(effect)),
        Plant::Axis | Plant::Bench => mechanism.to_owned(),
    }
}

/// The joint that an effect is said to be at: its `joint`, or its `at` where that is the letter of one.
fn joint(effect: &Value) -> Option<&str> {
    let text = |key| effect.get(key).and_then(Value::as_str);
    text("joint").or_else(|| text("at").filter(|at| ["A", "E", "B", "C"].contains(at)))
}

fn onset(effect: &Value) -> Option<Onset> {
    let number = |key| effect.get(key).and_then(Value::as_f64);
    let ends = number("onset_low95_s").zip(number("onset_high95_s"));
    Some(Onset {
        value_s: number("onset_s")?,
        interval_s: ends.map(|(low_s, high_s)| [low_s, high_s]),
    })
}

fn collect_names(plant: Plant, value: &Value, into: &mut Vec<String>) {
    match value {
        Value::String(text) => into.extend(text.split(" with ").map(str::to_owned)),
        Value::Array(items) => items
            .iter()
            .for_each(|item| collect_names(plant, item, into)),
        Value::Object(entries) => {
            if let Some(mechanism) = entries.get("mechanism").and_then(Value::as_str) {
                into.push(name(plant, mechanism, value));
            }
        }
        _ => {}
    }
}
