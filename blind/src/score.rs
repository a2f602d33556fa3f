//! This file scores a diagnosis against the answer, from the report's JSON alone.

use crate::answer::{Answer, HiddenEffect};
use crate::error::Error;
use crate::found::{Found, Onset, found_effects, suspected_effects};
use crate::plant::Plant;
use crate::stratum::Stratum;
use crate::told::told;
use rigproof_spec::units::Unit;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::collections::BTreeSet;

/// The error with which an onset is still right, s; on either side of it an effect has to show within this time.
pub const ONSET_S: f64 = 0.3;

/// How one diagnosis did.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Score {
    /// The kind of case.
    pub stratum: Stratum,
    /// The report's verdict.
    pub verdict: String,
    /// The named set is the true set, or one that physics makes identical to a single true effect; for an effect too small to see, naming nothing is right as well; for a data
    /// fault nothing may be named, and the verdict must be `data_fault` or the fault said with its place as mended.
    pub exact: bool,
    /// The mechanisms are the true ones, wherever they are said to be; what else `exact` asks is asked here as well.
    #[serde(default)]
    pub mechanism_exact: bool,
    /// What was hidden, and what was named: mechanisms, on a five-bar with their joints.
    #[serde(default)]
    pub hidden: Vec<String>,
    /// What was named.
    #[serde(default)]
    pub named: Vec<String>,
    /// Every true effect is named, ambiguous with a named one, or replaced by a physical equivalent. An effect too
    /// small to see is not asked for.
    pub inside: bool,
    /// Names that are neither true, nor equivalent, nor declared ambiguous with a true one.
    pub false_names: Vec<String>,
    /// The verdict says that the library or the data do not allow a name.
    pub flagged: bool,
    /// Mechanisms named or offered as ambiguous: a diagnosis that offers everything is inside of everything.
    pub offered: usize,
    /// Of these, what is neither hidden nor, by physics, the same as what is hidden.
    #[serde(default)]
    pub open: usize,
    /// Distance between the true onset and the named one, s, where both are there.
    pub onset_error_s: Option<f64>,
    /// Whether the recording tells the onset of what is hidden to 0.3 s; absent where nothing begins late.
    #[serde(default)]
    pub onset_told: Option<bool>,
    /// Whether the report's 95 % interval of the onset holds it; absent where it gives none.
    #[serde(default)]
    pub onset_covered: Option<bool>,
    /// Errors of the parameters that truth and report both have.
    pub parameters: Vec<ParameterError>,
    /// Share of the achievable improvement on the held-out part, (before − after)/(before − noise), as the report measured it: where an effect
    /// that can be named is hidden and a part was held out.
    #[serde(default)]
    pub recovered_share: Option<f64>,
}

/// How far one parameter is from the truth.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ParameterError {
    /// The mechanism's name.
    pub mechanism: String,
    /// The parameter's name.
    pub name: String,
    /// |found − true| / |true|.
    pub relative: f64,
    /// Whether the report's 95 % interval holds the truth; absent when it gives none.
    pub covered: Option<bool>,
}

/// Scores a report.
///
/// # Errors
/// [`Error::Report`] when `verdict` or `effects` is missing.
pub fn score(answer: &Answer, report: &Value) -> Result<Score, Error> {
    let verdict = report
        .get("verdict")
        .and_then(Value::as_str)
        .ok_or(Error::Report("string \"verdict\""))?;
    let found = found_effects(answer.plant, report)?;
    let named: BTreeSet<&str> = found.iter().map(|effect| effect.name.as_str()).collect();
    let suspected = suspected_effects(answer.plant, report)?;
    let suspected_names = suspected.iter().map(|effect| &effect.name);
    let alternatives = found.iter().chain(&suspected);
    let alternatives = alternatives.flat_map(|effect| &effect.alternatives);
    let offered: BTreeSet<&str> = alternatives
        .chain(suspected_names)
        .map(String::as_str)
        .chain(named.iter().copied())
        .collect();
    let keys: Vec<String> = answer.effects.iter().map(HiddenEffect::key).collect();
    let truth: BTreeSet<&str> = keys.iter().map(String::as_str).collect();
    let flagged = match verdict {
        "data_fault" => answer.stratum == Stratum::DataFault,
        "none_of_library" => answer.stratum != Stratum::DataFault,
        "partly_explained" => answer.stratum == Stratum::NotInLibrary && named.is_empty(),
        // A fault that is said with its place and mended is no less told.
        _ => answer.stratum == Stratum::DataFault && told(answer, report)?.is_right,
    };
    let right = |same: bool| match answer.stratum {
        Stratum::DataFault => flagged && named.is_empty(),
        Stratum::TooSmall => named.is_empty() || same,
        Stratum::Unidentifiable => says_the_tie(answer, &offered),
        _ => same || is_twin(answer, &named),
    };
    let mechanisms = |names: &BTreeSet<&str>| -> BTreeSet<String> {
        names.iter().map(|name| mechanism_of(name)).collect()
    };
    let too_small = answer.stratum == Stratum::TooSmall;
    let late = answer.effects.iter().find(|e| e.onset_s.is_some());
    let onset = late.and_then(|truth| onset(truth, &found));
    Ok(Score {
        stratum: answer.stratum,
        verdict: verdict.to_owned(),
        exact: right(named == truth),
        mechanism_exact: right(mechanisms(&named) == mechanisms(&truth)),
        inside: too_small || answer.effects.iter().all(|e| is_inside(e, &offered)),
        false_names: found
            .iter()
            .filter(|effect| !is_defensible(effect, answer, &truth))
            .map(|effect| effect.name.clone())
            .collect(),
        flagged,
        offered: offered.len(),
        open: offered
            .iter()
            .filter(|name| !is_hidden(answer, name))
            .count(),
        onset_error_s: onset.map(|(truth_s, named)| (named.value_s - truth_s).abs()),
        onset_told: late.map(HiddenEffect::tells_onset),
        onset_covered: onset.and_then(|(truth_s, named)| {
            named
                .interval_s
                .map(|[low_s, high_s]| (low_s..=high_s).contains(&truth_s))
        }),
        parameters: parameter_errors(answer, &found),
        recovered_share: recovered_share(answer, report),
        hidden: truth.iter().map(|name| (*name).to_owned()).collect(),
        named: named.iter().map(|name| (*name).to_owned()).collect(),
    })
}

impl Score {
    /// Whether the diagnosis failed: it is not what the stratum calls right, or a name is false.
    pub fn is_miss(&self) -> bool {
        let right = match self.stratum {
            Stratum::NotInLibrary => self.flagged && self.named.is_empty() || self.exact,
            _ => self.exact,
        };
        !right || !self.false_names.is_empty()
    }
}

/// A name without its joint.
pub(crate) fn mechanism_of(name: &str) -> String {
    name.split(" at ").next().unwrap_or(name).to_owned()
}

/// Whether the truth and at least one of its twins are offered.
fn says_the_tie(answer: &Answer, offered: &BTreeSet<&str>) -> bool {
    answer.effects.iter().all(|effect| {
        let twins = effect.equivalent.iter().flatten().map(String::as_str);
        let told = twins.filter(|twin| offered.contains(twin)).count();
        let own = usize::from(offered.contains(effect.key().as_str()));
        told + own >= 2
    })
}

fn is_inside(truth: &HiddenEffect, offered: &BTreeSet<&str>) -> bool {
    offered.contains(truth.key().as_str())
        || truth
            .equivalent
            .iter()
            .any(|set| set.iter().all(|name| offered.contains(name.as_str())))
}

/// Whether the names are a set that no recording could tell from the only true effect.
fn is_twin(answer: &Answer, named: &BTreeSet<&str>) -> bool {
    let [only] = answer.effects.as_slice() else {
        return false;
    };
    let mut twins = only.equivalent.iter();
    twins.any(|set| set.iter().map(String::as_str).collect::<BTreeSet<_>>() == *named)
}

fn is_defensible(found: &Found<'_>, answer: &Answer, truth: &BTreeSet<&str>) -> bool {
    is_hidden(answer, &found.name)
        || found
            .alternatives
            .iter()
            .any(|name| truth.contains(name.as_str()))
}

/// The true onset, s, and the one that is named for the same mechanism.
fn onset(truth: &HiddenEffect, found: &[Found<'_>]) -> Option<(f64, Onset)> {
    let named = found.iter().find(|f| f.mechanism == truth.mechanism)?;
    truth.onset_s.zip(named.onset)
}

/// Whether a name is a hidden effect's, or in a set that is the same by physics.
fn is_hidden(answer: &Answer, name: &str) -> bool {
    answer.effects.iter().any(|effect| {
        let mut twins = effect.equivalent.iter().flatten();
        effect.key() == name || twins.any(|twin| twin == name)
    })
}

fn recovered_share(answer: &Answer, report: &Value) -> Option<f64> {
    let nameless = [Stratum::TooSmall, Stratum::NotInLibrary, Stratum::DataFault];
    if answer.effects.is_empty() || nameless.contains(&answer.stratum) {
        return None;
    }
    report.get("fit")?.get("recovered_share")?.as_f64()
}

/// Errors of the numbers that truth and report both have.
pub(crate) fn parameter_errors(answer: &Answer, found: &[Found<'_>]) -> Vec<ParameterError> {
    let mut errors = Vec::new();
    for truth in &answer.effects {
        let same = |f: &&Found<'_>| f.mechanism == truth.mechanism;
        let here = |f: &&Found<'_>| same(f) && f.joint == truth.joint.as_deref();
        // An arm has one mechanism at many joints.
        let anywhere = || {
            found
                .iter()
                .find(same)
                .filter(|_| answer.plant != Plant::Chain)
        };
        let Some(parameters) = found
            .iter()
            .find(here)
            .or_else(anywhere)
            .and_then(|f| f.parameters)
        else {
            continue;
        };
        for parameter in &truth.parameters {
            let Some(estimate) = parameters.get(&parameter.name) else {
                continue;
            };
            let unit = estimate.get("unit").and_then(Value::as_str).unwrap_or("1");
            let (Some(stated), Some(true_unit)) = (Unit::parse(unit), Unit::parse(&parameter.unit))
            else {
                continue;
            };
            if stated.dimension != true_unit.dimension {
                continue;
            }
            let number = |key| Some(estimate.get(key)?.as_f64()? * stated.to_si);
            let Some(value) = number("value") else {
                continue;
            };
            // The sign of a delay is a convention of the reader, not of the recording.
            let is_delay = truth.mechanism == "channel_skew";
            let sign = if is_delay && value * parameter.value < 0.0 {
                -1.0
            } else {
                1.0
            };
            let true_value = sign * parameter.value * true_unit.to_si;
            if true_value != 0.0 {
                errors.push(ParameterError {
                    mechanism: truth.mechanism.clone(),
                    name: parameter.name.clone(),
                    relative: ((value - true_value) / true_value).abs(),
                    covered: number("low95")
                        .zip(number("high95"))
                        .map(|(low, high)| (low..=high).contains(&true_value)),
                });
            }
        }
    }
    errors
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::answer::TrueParameter;
    use crate::forms::Forms;
    use crate::plant::Plant;
    use serde_json::json;

    fn effect(mechanism: &str, equivalent: &[&[&str]]) -> HiddenEffect {
        HiddenEffect {
            mechanism: mechanism.to_owned(),
            joint: None,
            onset_s: Some(8.25),
            parameters: vec![TrueParameter {
                name: "level".to_owned(),
                value: 0.02,
                unit: "N·m".to_owned(),
            }],
            size: 7.0,
            distinctness: 3.0,
            strength: 90.0,
            onset_strength: None,
            equivalent: equivalent
                .iter()
                .map(|set| set.iter().map(|n| (*n).to_owned()).collect())
                .collect(),
            form: String::new(),
            right: Vec::new(),
            companions: Vec::new(),
            scope: None,
        }
    }

    fn answer(stratum: Stratum, effects: Vec<HiddenEffect>) -> Answer {
        Answer {
            seed: 3,
            plant: Plant::Axis,
            stratum,
            effects,
            fault: None,
            spoilt: None,
            block_noise: 0.01,
            residual_ratio: None,
            forms: Forms::Usual,
        }
    }

    #[test]
    fn the_true_name_is_exact_and_its_parameter_is_compared_in_si() {
        let answer = answer(Stratum::LateOnset, vec![effect("dry_offset", &[])]);
        let report = json!({"verdict": "explained", "effects": [{
            "mechanism": "dry_offset", "onset_s": 8.0, "onset_low95_s": 7.9, "onset_high95_s": 8.1,
            "parameters": {"level": {"value": 21.0, "unit": "mN·m", "low95": 19.0, "high95": 23.0}}}]});
        let score = score(&answer, &report).unwrap();
        assert!(score.exact && score.inside && score.false_names.is_empty());
        assert_eq!(score.onset_error_s, Some(0.25));
        assert_eq!(
            (score.onset_covered, score.onset_told),
            (Some(false), Some(false))
        );
        assert!((score.parameters[0].relative - 0.05).abs() < 1e-12);
        assert_eq!(score.parameters[0].covered, Some(true));
    }

    #[test]
    fn a_declared_ambiguity_is_inside_but_not_exact() {
        let answer = answer(
            Stratum::Single,
            vec![effect("presliding", &[&["hysteresis"]])],
        );
        let report = |with: Value| {
            json!({"verdict": "ambiguous", "ambiguous_with": [with],
                   "effects": [{"mechanism": "stribeck"}]})
        };
        let good = score(&answer, &report(json!([["presliding"]]))).unwrap();
        assert!(!good.exact && good.inside && good.false_names.is_empty());
        assert_eq!((good.offered, good.open), (2, 1));
        let both = score(&answer, &report(json!([["presliding with constant_bias"]])));
        assert_eq!(both.unwrap().offered, 3);
        let twin = score(&answer, &report(json!([["hysteresis"]]))).unwrap();
        assert!(twin.inside);
        assert_eq!(twin.false_names, ["stribeck"]);
        let bad = score(&answer, &report(json!([]))).unwrap();
        assert!(!bad.inside);
        assert_eq!(bad.false_names, ["stribeck"]);
    }

    #[test]
    fn on_a_rig_the_joint_belongs_to_the_name() {
        let mut hidden = effect("viscous", &[&["bearing_friction at C"]]);
        hidden.joint = Some("E".to_owned());
        let answer = Answer {
            plant: Plant::Rig,
            ..answer(Stratum::Single, vec![hidden])
        };
        let with = |joint: Value, ties: Value| {
            let report = json!({"verdict": "explained",
                "effects": [{"mechanism": "viscous", "joint": joint, "ambiguous_with": ties}]});
            score(&answer, &report).unwrap()
        };
        let right = with(json!("E"), json!([]));
        assert!(right.exact && right.mechanism_exact && !right.is_miss());
        for joint in [json!("B"), json!(null)] {
            let wrong = with(joint, json!([]));
            assert!(!wrong.exact && wrong.mechanism_exact && !wrong.inside && wrong.is_miss());
            assert_eq!(wrong.false_names.len(), 1);
        }
        for tie in [
            json!([{"mechanism": "viscous", "joint": "E"}]),
            json!("viscous at E"),
        ] {
            let tied = with(json!("B"), tie);
            assert!(!tied.exact && tied.inside && tied.false_names.is_empty());
        }
        let twin = json!({"verdict": "explained",
            "effects": [{"mechanism": "bearing_friction", "joint": "C"}]});
        assert!(score(&answer, &twin).unwrap().exact);
    }

    #[test]
    fn what_cannot_be_told_apart_has_to_be_called_a_tie() {
        let mut hidden = effect("gain_error", &[&["dry_offset at A"]]);
        hidden.joint = Some("A".to_owned());
        let answer = Answer {
            plant: Plant::Rig,
            ..answer(Stratum::Unidentifiable, vec![hidden])
        };
        let with = |ties: Value| {
            let report = json!({"verdict": "ambiguous",
                "effects": [{"mechanism": "gain_error", "joint": "A", "ambiguous_with": ties}]});
            score(&answer, &report).unwrap()
        };
        let lucky = with(json!([]));
        assert!(!lucky.exact && lucky.inside && lucky.false_names.is_empty());
        assert!(with(json!(["dry_offset at A"])).exact);
    }

    #[test]
    fn what_was_recovered_is_asked_where_something_can_be_named() {
        let report =
            json!({"verdict": "explained", "effects": [], "fit": {"recovered_share": 0.9}});
        let of = |stratum, effects| {
            score(&answer(stratum, effects), &report)
                .unwrap()
                .recovered_share
        };
        assert_eq!(of(Stratum::Single, vec![effect("viscous", &[])]), Some(0.9));
        assert_eq!(of(Stratum::TooSmall, vec![effect("viscous", &[])]), None);
        assert_eq!(of(Stratum::Nothing, vec![]), None);
        let without = json!({"verdict": "explained", "effects": [], "fit": null});
        let single = answer(Stratum::Single, vec![effect("viscous", &[])]);
        assert_eq!(score(&single, &without).unwrap().recovered_share, None);
    }

    #[test]
    fn flags_belong_to_their_strata() {
        let verdict = |stratum, verdict: &str, effects: Value| {
            score(
                &answer(stratum, vec![]),
                &json!({"verdict": verdict, "effects": effects}),
            )
            .unwrap()
        };
        assert!(verdict(Stratum::DataFault, "data_fault", json!([])).exact);
        assert!(!verdict(Stratum::DataFault, "consistent", json!([])).exact);
        assert!(verdict(Stratum::NotInLibrary, "partly_explained", json!([])).flagged);
        let named = json!([{"mechanism": "spring"}]);
        let partly = verdict(Stratum::NotInLibrary, "partly_explained", named.clone());
        assert!(!partly.flagged && partly.false_names == ["spring"]);
        assert!(verdict(Stratum::Nothing, "consistent", json!([])).exact);
        assert!(!verdict(Stratum::Nothing, "explained", named).exact);
    }

    #[test]
    fn silence_about_an_effect_too_small_to_see_is_right() {
        let answer = answer(Stratum::TooSmall, vec![effect("spring", &[])]);
        let quiet = score(&answer, &json!({"verdict": "consistent", "effects": []})).unwrap();
        assert!(quiet.exact && quiet.inside);
        let loud = json!({"verdict": "explained", "effects": [{"mechanism": "ripple"}]});
        let loud = score(&answer, &loud).unwrap();
        assert!(!loud.exact && loud.false_names == ["ripple"]);
    }

    #[test]
    fn a_report_without_a_verdict_is_refused() {
        let answer = answer(Stratum::Nothing, vec![]);
        let message = score(&answer, &json!({"effects": []}))
            .unwrap_err()
            .to_string();
        assert!(message.contains("verdict"), "{message}");
    }
}
