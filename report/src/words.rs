//! This file says physics in the words of somebody who mends machines.

use rigproof_diagnose::report::{EffectReport, HeldJoint, Report};
use rigproof_model::effects::words;
use rigproof_spec::effect::Mechanism;

use crate::number::with_unit;

/// A cause as a report names it (`viscous`, `viscous at E`, or two of them with ` with ` between) in plain words.
pub fn plain_cause(cause: &str) -> String {
    let plain = |one: &str| match one.split_once(" at ") {
        Some((name, joint)) => plain_at(name, Some(joint)),
        None => plain_at(one, None),
    };
    let all: Vec<String> = cause.split(" with ").map(plain).collect();
    all.join(" with ")
}

/// A mechanism's name and its place in plain words; a name that is not in the vocabulary stands as it is.
pub fn plain_at(name: &str, joint: Option<&str>) -> String {
    placed(plain(name).to_owned(), name, joint)
}

/// A mechanism in plain words; a name that is not in the vocabulary stands as it is.
fn plain(name: &str) -> &str {
    Mechanism::from_name(name).map_or(name, |mechanism| words(mechanism).what)
}

fn placed(what: String, name: &str, joint: Option<&str>) -> String {
    match joint {
        Some("every brake") => format!("{what}, the same at every brake"),
        Some(axis) if is_axis(name, axis) => format!("{what}, along {axis}"),
        Some(joint) => format!("{what}, at joint {joint}"),
        None => what,
    }
}

/// Mechanisms with their places in plain words, one at several joints once: "viscous friction, at joints A and C".
///
/// Each has its name, its place and what is added to it; one with an addition stands by itself. What
/// enters with several periods is said once.
pub fn plain_each<'a>(
    all: impl IntoIterator<Item = (&'a str, Option<&'a str>, String)>,
) -> Vec<String> {
    let mut groups: Vec<(&str, Vec<Option<&str>>, String)> = Vec::new();
    for (name, place, added) in all {
        let same = groups.iter_mut().find(|(own, places, more)| {
            let are_joints = places.iter().chain([&place]).all(|at| is_joint(name, *at));
            let is_again = places.contains(&place) || are_joints;
            is_again && *own == name && added.is_empty() && more.is_empty()
        });
        match same {
            Some((_, places, _)) if places.contains(&place) => {}
            Some((_, places, _)) => places.push(place),
            None => groups.push((name, vec![place], added)),
        }
    }
    let are_many = groups.len() > KINDS;
    let said = groups.into_iter().map(|(name, places, added)| {
        let whole = plain(name);
        let what = match whole.split_once(" (") {
            Some((brief, _)) if are_many => brief,
            _ => whole,
        };
        let joints: Vec<&str> = places.iter().flatten().copied().collect();
        match joints.as_slice() {
            [first @ .., last] if !first.is_empty() => {
                let names = format!("joints {} and {last}", first.join(", "));
                match names.len() > ROOM {
                    true => format!("{what}, at {} joints", joints.len()),
                    false => format!("{what}, at {names}"),
                }
            }
            _ => placed(what.to_owned(), name, places.first().copied().flatten()) + &added,
        }
    });
    said.collect()
}

/// Kinds of mechanisms that are explained in one sentence.
const KINDS: usize = 2;
/// Letters for the joints of a mechanism; more joints are counted.
const ROOM: usize = 40;

/// What a report names and what it suspects, each in one phrase. Beside names, many suspicions are counted.
pub fn named_and_suspected(
    report: &Report,
    added: impl Fn(&EffectReport) -> String,
) -> [String; 2] {
    let [named, suspected] = report.by_status();
    let each = |effects: &[&EffectReport]| {
        let effects = effects.iter();
        plain_each(effects.map(|own| (own.mechanism, own.joint, added(own))))
    };
    let perhaps = each(&suspected);
    let are_counted = !named.is_empty() && perhaps.len() > KINDS;
    let perhaps = match are_counted {
        true => format!("{} more that are less sure", suspected.len()),
        false => list(&perhaps),
    };
    [list(&each(&named)), perhaps]
}

fn is_joint(name: &str, place: Option<&str>) -> bool {
    place.is_some_and(|at| at != "every brake" && !is_axis(name, at))
}

/// Whether a place is an axis of the force sensor.
fn is_axis(name: &str, place: &str) -> bool {
    name.starts_with("force_") && matches!(place, "x" | "y")
}

/// What the field calls a mechanism; a name that is not in the vocabulary stands as it is.
pub fn called(name: &str) -> &str {
    Mechanism::from_name(name).map_or(name, |mechanism| mechanism.called())
}

/// What the field calls a mechanism, with its name in files where the one does not hold the other: `Coulomb friction (dry_offset) at 3`.
pub fn called_at(name: &str, joint: Option<&str>) -> String {
    let called = Mechanism::from_name(name).map(Mechanism::called);
    let what = match called {
        Some(called) if called.to_lowercase().contains(&name.replace('_', " ")) => {
            called.to_owned()
        }
        Some(called) => format!("{called} ({name})"),
        None => name.to_owned(),
    };
    match joint {
        Some(joint) => format!("{what} at {joint}"),
        None => what,
    }
}

/// What to look for on the rig; nothing for a name that is not in the vocabulary.
pub fn look_for(name: &str) -> Option<&'static str> {
    Some(words(Mechanism::from_name(name)?).look_for)
}

/// With a capital at its beginning.
pub fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| {
        first.to_uppercase().chain(letters).collect()
    })
}

/// Words with commas and an "and".
pub fn list(words: &[String]) -> String {
    match words {
        [] => String::new(),
        [one] => one.clone(),
        [first @ .., last] => format!("{}, and {last}", first.join("; ")),
    }
}

/// Whether a brake at rest held no more than it can, in words.
pub fn at_rest(own: &HeldJoint, unit: &str) -> String {
    let torque = |size: f64| with_unit(size, unit);
    match (own.missing > 0.0, own.named_at_least > 0.0) {
        (true, _) => format!(
            "at least {} of what holds it is not named",
            torque(own.missing)
        ),
        (false, true) => format!(
            "agrees, and of this what is named has to hold at least {}",
            torque(own.named_at_least)
        ),
        (false, false) => "agrees".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mechanism_at_several_joints_is_said_once() {
        let all = [
            ("viscous", Some("A"), String::new()),
            ("gain_error", Some("A"), " (+3 %)".to_owned()),
            ("viscous", Some("every brake"), String::new()),
            ("viscous", Some("E"), String::new()),
            ("viscous", Some("C"), String::new()),
            ("payload", None, String::new()),
        ];
        let said = plain_each(all);
        assert_eq!(said.len(), 4);
        assert!(said[0].ends_with(", at joints A, E and C"), "{}", said[0]);
        assert!(said[1].ends_with(", at joint A (+3 %)"), "{}", said[1]);
        assert!(said[2].ends_with("the same at every brake"), "{}", said[2]);
        assert_eq!(said[3], plain_at("payload", None));
        let twice = plain_each(["B", "B"].map(|at| ("ripple", Some(at), String::new())));
        assert_eq!(twice, [plain_at("ripple", Some("B"))]);
        let long = ["upper_arm_roll", "lower_arm_roll", "wrist_flex"];
        let said = plain_each(long.map(|at| ("dry_offset", Some(at), String::new())));
        assert!(said[0].ends_with("speed), at 3 joints"), "{}", said[0]);
    }

    #[test]
    fn the_word_of_the_field_stands_beside_a_name_that_is_another_one() {
        let at_three = called_at("dry_offset", Some("3"));
        assert_eq!(at_three, "Coulomb friction (dry_offset) at 3");
        assert_eq!(called_at("viscous", None), "viscous friction");
        assert_eq!(
            called_at("stribeck", None),
            "breakaway (Stribeck) friction peak"
        );
        assert_eq!(called_at("unheard_of", None), "unheard_of");
    }

    #[test]
    fn a_cause_is_said_in_plain_words_and_a_name_of_none_stands_as_it_is() {
        assert_eq!(
            plain_cause("viscous at E"),
            "drag that grows with speed, at joint E"
        );
        assert_eq!(plain_cause("unheard_of"), "unheard_of");
        assert_eq!(
            plain_cause("viscous at E with unheard_of"),
            "drag that grows with speed, at joint E with unheard_of"
        );
        assert_eq!(
            list(&["a".to_owned(), "b".to_owned(), "c".to_owned()]),
            "a; b, and c"
        );
    }
}
