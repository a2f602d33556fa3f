//! This file judges a report about physics in other forms: right and complete, incomplete, false, or silent although something shows.

use crate::answer::{Answer, HiddenEffect};
use crate::error::Error;
use crate::found::{Found, found_effects};
use crate::score::{ParameterError, parameter_errors};
use crate::stratum::Stratum;
use serde::Serialize;
use serde_json::Value;

/// From this multiple of the residual that the noise of the sensors explains an effect is called detectable.
pub const DETECTABLE_RATIO: f64 = 1.5;

/// How a report did.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// Every detectable effect is named, and nothing false; where nothing is hidden, nothing is named; outside the library the flag.
    Right,
    /// Something true is named, something detectable is not, and nothing is false.
    Incomplete,
    /// A name is neither right nor an acceptable companion.
    FalseName,
    /// Nothing is named although something is detectable.
    Silent,
    /// Nothing is named, and what is hidden is not detectable.
    Unseen,
}

impl Outcome {
    /// Every outcome, in the order of the table.
    pub const ALL: [Outcome; 5] = [
        Outcome::Right,
        Outcome::Incomplete,
        Outcome::FalseName,
        Outcome::Silent,
        Outcome::Unseen,
    ];

    /// The words of the table.
    pub const fn words(self) -> &'static str {
        match self {
            Outcome::Right => "right",
            Outcome::Incomplete => "incomplete",
            Outcome::FalseName => "false name",
            Outcome::Silent => "silent",
            Outcome::Unseen => "unseen",
        }
    }
}

/// The judgement of one report.
#[derive(Clone, Debug, Serialize)]
pub struct Judgement {
    /// The kind of case.
    pub stratum: Stratum,
    /// How the report did.
    pub outcome: Outcome,
    /// What is hidden, with its form, such as `stribeck at E (Rational)`.
    pub hidden: Vec<String>,
    /// Every name with its probability, 1 where the report gives none, and whether it is right or an acceptable companion.
    pub names: Vec<(String, f64, bool)>,
    /// Errors of the numbers that truth and report both have.
    pub parameters: Vec<ParameterError>,
}

/// Judges a report about a case in other forms.
///
/// # Errors
/// [`Error::Report`] when `verdict` or `effects` is missing.
pub fn judge(answer: &Answer, report: &Value) -> Result<Judgement, Error> {
    let verdict = report
        .get("verdict")
        .and_then(Value::as_str)
        .ok_or(Error::Report("string \"verdict\""))?;
    let found = found_effects(answer.plant, report)?;
    let hidden = &answer.effects;
    let is_right = |effect: &HiddenEffect| said(effect, &found);
    let is_fine = |found: &Found<'_>| hidden.iter().any(|effect| allows(effect, found));
    let any_false = !found.iter().all(is_fine);
    let (mut due, mut due_and_right) = (0, 0);
    for effect in hidden.iter().filter(|effect| is_detectable(effect)) {
        due += 1;
        due_and_right += usize::from(is_right(effect));
    }
    let foreign = answer.stratum == Stratum::NotInLibrary;
    let refuses = matches!(
        verdict,
        "none_of_library" | "partly_explained" | "data_fault"
    );
    let of_recorder = |effect: &HiddenEffect| {
        effect
            .right
            .iter()
            .any(|name| name == "repeated_samples" || name == "clock")
    };
    let fault = verdict == "data_fault" && hidden.iter().any(of_recorder);
    let outcome = if any_false {
        Outcome::FalseName
    } else if foreign && refuses || fault || due > 0 && due_and_right == due {
        Outcome::Right
    } else if found.is_empty() && due > 0 {
        Outcome::Silent
    } else if found.is_empty() && !hidden.is_empty() {
        Outcome::Unseen
    } else if due == 0 {
        Outcome::Right
    } else {
        Outcome::Incomplete
    };
    Ok(Judgement {
        stratum: answer.stratum,
        outcome,
        hidden: hidden
            .iter()
            .map(|effect| format!("{} ({})", place(effect), effect.form))
            .collect(),
        names: found
            .iter()
            .map(|name| (name.name.clone(), name.probability, is_fine(name)))
            .collect(),
        parameters: parameter_errors(answer, &found),
    })
}

/// Whether the recording shows the effect: alone it leaves so much more than the noise of the sensors explains.
fn is_detectable(effect: &HiddenEffect) -> bool {
    (1.0 + effect.size * effect.size).sqrt() >= DETECTABLE_RATIO
}

/// Mechanism and place.
fn place(effect: &HiddenEffect) -> String {
    match &effect.scope {
        Some(scope) => format!("{} at {scope}", effect.mechanism),
        None => effect.key(),
    }
}

/// Whether the report has a right name of the effect at its place; an effect at every joint may be named once for all of them, or at each of three.
fn said(effect: &HiddenEffect, found: &[Found<'_>]) -> bool {
    let right = |found: &&Found<'_>| effect.right.iter().any(|name| name == found.mechanism);
    let mut named = found.iter().filter(right);
    match (effect.scope.as_deref(), &effect.joint) {
        (Some("every"), _) => {
            let (mut all, mut single) = (false, 0);
            for name in named {
                match name.joint {
                    None => all = true,
                    Some(joint) if joint.starts_with("every") => all = true,
                    Some(_) => single += 1,
                }
            }
            all || single >= 3
        }
        (_, Some(joint)) => {
            let here = |name: &Found<'_>| name.joint == Some(joint.as_str());
            named.any(|name| here(name) || twin(effect, name))
        }
        _ => named.next().is_some(),
    }
}

/// Whether a name says what physics makes the same, where it does.
fn twin(effect: &HiddenEffect, found: &Found<'_>) -> bool {
    effect
        .equivalent
        .iter()
        .flatten()
        .any(|name| *name == found.name)
}

/// Whether a name is right about an effect, or fine beside a right one.
fn allows(effect: &HiddenEffect, found: &Found<'_>) -> bool {
    let among = |names: &[String]| names.iter().any(|name| name == found.mechanism);
    let here = match (&effect.joint, found.joint) {
        (Some(true_joint), Some(joint)) => true_joint == joint,
        (Some(_), None) | (None, _) => true,
    };
    twin(effect, found) || here && (among(&effect.right) || among(&effect.companions))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effect::{At, Effect};
    use crate::form::Form;
    use crate::forms::Forms;
    use crate::plant::Plant;
    use crate::size::Size;
    use rigproof_spec::effect::Motion;
    use rigproof_spec::joint::Joint;
    use serde_json::json;

    fn answer(effects: &[(Effect, f64)], stratum: Stratum) -> Answer {
        let effects = effects.iter().map(|(effect, size)| {
            let size = Size {
                size: *size,
                ..Size::default()
            };
            HiddenEffect::new(effect, size, Motion::Rotary, Vec::new()).named(effect)
        });
        Answer {
            seed: 3,
            plant: Plant::Rig,
            forms: Forms::Other,
            stratum,
            effects: effects.collect(),
            fault: None,
            spoilt: None,
            block_noise: 0.01,
            residual_ratio: None,
        }
    }

    fn outcome(answer: &Answer, names: Value) -> Outcome {
        let report = json!({ "verdict": "explained", "effects": names });
        judge(answer, &report).unwrap().outcome
    }

    #[test]
    fn a_name_is_right_incomplete_false_or_missing() {
        let peak = Form::Rational.of([0.2, 0.1]).joint(Joint::E);
        let drag = Form::Root.of([0.2, 1.0]).joint(Joint::B);
        let two = answer(&[(peak, 7.0), (drag, 5.0)], Stratum::Two);
        let name = |mechanism: &str, joint: &str| json!({ "mechanism": mechanism, "joint": joint });
        let (right, other) = (name("stribeck", "E"), name("velocity_power", "B"));
        assert_eq!(outcome(&two, json!([right, other])), Outcome::Right);
        assert_eq!(outcome(&two, json!([right])), Outcome::Incomplete);
        assert_eq!(
            outcome(&two, json!([right, other, name("dry_offset", "E")])),
            Outcome::Right
        );
        assert_eq!(
            outcome(&two, json!([right, other, name("ripple", "E")])),
            Outcome::FalseName
        );
        assert_eq!(
            outcome(&two, json!([name("stribeck", "A")])),
            Outcome::FalseName
        );
        assert_eq!(outcome(&two, json!([])), Outcome::Silent);
        let faint = answer(&[(peak, 0.3)], Stratum::Single);
        assert_eq!(outcome(&faint, json!([])), Outcome::Unseen);
        assert_eq!(outcome(&faint, json!([right])), Outcome::Right);
    }

    #[test]
    fn a_shared_effect_is_named_for_all_or_at_each() {
        let shared = Form::Rational.of([0.2, 0.1]).of_drive().at(At::Every);
        let case = answer(&[(shared, 9.0)], Stratum::Single);
        let at = |joint: &str| json!({ "mechanism": "stribeck", "joint": joint });
        assert_eq!(
            outcome(&case, json!([{ "mechanism": "stribeck" }])),
            Outcome::Right
        );
        assert_eq!(outcome(&case, json!([at("every brake")])), Outcome::Right);
        assert_eq!(
            outcome(&case, json!([at("A"), at("E"), at("B")])),
            Outcome::Right
        );
        assert_eq!(outcome(&case, json!([at("A")])), Outcome::Incomplete);
    }

    #[test]
    fn nothing_and_the_unknown_are_right_without_a_name() {
        let nothing = answer(&[], Stratum::Nothing);
        assert_eq!(outcome(&nothing, json!([])), Outcome::Right);
        assert_eq!(
            outcome(&nothing, json!([{ "mechanism": "spring" }])),
            Outcome::FalseName
        );
        let foreign = answer(
            &[(Form::Disturbance.of([0.1, 1.0]), 5.0)],
            Stratum::NotInLibrary,
        );
        assert_eq!(outcome(&foreign, json!([])), Outcome::Silent);
        let flagged = json!({ "verdict": "none_of_library", "effects": [] });
        assert_eq!(judge(&foreign, &flagged).unwrap().outcome, Outcome::Right);
    }

    #[test]
    fn cogging_with_two_periods_is_a_ripple() {
        let hidden = Form::TwoRipples.of([0.1, 0.8, 0.2]).joint(Joint::A);
        let cogging = answer(&[(hidden, 5.0)], Stratum::NotInLibrary);
        let outcome = |verdict: &str, mechanism: &str| {
            let effects = json!([{ "mechanism": mechanism, "joint": "A" }]);
            let report = json!({ "verdict": verdict, "effects": effects });
            judge(&cogging, &report).unwrap().outcome
        };
        assert_eq!(outcome("partly_explained", "ripple"), Outcome::Right);
        assert_eq!(outcome("explained", "ripple"), Outcome::Right);
        assert_eq!(outcome("partly_explained", "viscous"), Outcome::FalseName);
    }
}
