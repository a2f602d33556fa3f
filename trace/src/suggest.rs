//! This file finds the name somebody most likely meant.

use std::borrow::Cow;

/// The longest name that is compared with others, characters, and the most others.
const LONGEST: usize = 200;
const MOST_COMPARED: usize = 4096;
/// The most of a name that is shown, characters, and the most names.
const SHOWN: usize = 80;
const MOST_SHOWN: usize = 100;

/// A name from a file, cut to what a line can bear.
pub fn short(name: &str) -> Cow<'_, str> {
    match name.char_indices().nth(SHOWN) {
        Some((end, _)) => Cow::Owned(format!("{}…", name.get(..end).unwrap_or_default())),
        None => Cow::Borrowed(name),
    }
}

/// The candidate nearest to `name`, or `None` when every one is far off.
///
/// The distance is Damerau and Levenshtein's, in characters, letter case left out; a third of the name may differ, but not all of
/// it.
pub fn nearest<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let length = name.chars().take(LONGEST + 1).count();
    if length > LONGEST {
        return None;
    }
    let wanted = name.to_lowercase();
    let length = wanted.chars().count();
    let allowed = (length / 3).max(1);
    // Names are that far apart at least by which their lengths differ.
    let is_near = |candidate: &&str| {
        let other = candidate.chars().take(length + allowed + 1).count();
        other.abs_diff(length) <= allowed
    };
    candidates
        .into_iter()
        .take(MOST_COMPARED)
        .filter(is_near)
        .map(|candidate| {
            let distance = strsim::damerau_levenshtein(&wanted, &candidate.to_lowercase());
            (distance, candidate)
        })
        .filter(|(distance, _)| *distance <= allowed && *distance < length)
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, candidate)| candidate)
}

/// The names in backticks, separated by commas; of very many the first ones, and how many more there are.
pub fn quoted<'a>(names: impl IntoIterator<Item = &'a str>) -> String {
    let mut names = names.into_iter();
    let first = names.by_ref().take(MOST_SHOWN);
    let first: Vec<String> = first.map(|name| format!("`{}`", short(name))).collect();
    let more = match names.count() {
        0 => String::new(),
        more => format!(" and {more} more"),
    };
    first.join(", ") + &more
}

/// "; did you mean `x`? …": the nearest name if there is one, and all of them.
pub fn advice(name: &str, what: &str, candidates: &[&str]) -> String {
    let known = match candidates {
        [] => format!("there are no {what}"),
        _ => format!("the {what} are {}", quoted(candidates.iter().copied())),
    };
    match nearest(name, candidates.iter().copied()) {
        Some(near) => format!("did you mean `{near}`? {known}"),
        None => known,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_names_and_long_lists_are_cut_and_cost_little() {
        let long = "ä".repeat(70_000);
        assert_eq!(nearest(&long, [long.as_str()]), None);
        assert_eq!(
            nearest("chanel", [long.as_str(), "channel"]),
            Some("channel")
        );
        let many: Vec<String> = (0..40_000).map(|k| format!("x{k}")).collect();
        let told = advice(
            &long,
            "columns",
            &many.iter().map(String::as_str).collect::<Vec<_>>(),
        );
        assert!(
            told.ends_with("`x99` and 39900 more"),
            "{}",
            &told[told.len() - 40..]
        );
        assert_eq!(short(&long).chars().count(), 81);
    }

    #[test]
    fn a_slip_of_the_finger_is_understood_and_another_word_is_not() {
        let keys = ["channel", "quantum", "scale", "sign"];
        assert_eq!(nearest("chanel", keys), Some("channel"));
        assert_eq!(nearest("Sclae", keys), Some("scale"));
        assert_eq!(nearest("temperature", keys), None);
        assert_eq!(nearest("D", ["A", "d"]), Some("d"));
        assert_eq!(nearest("D", ["A", "B"]), None);
    }
}
