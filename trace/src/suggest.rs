//! This file finds the name somebody most likely meant.

/// The candidate nearest to `name`, or `None` when every one is far off.
///
/// The distance is Damerau and Levenshtein's, in characters, letter case left out; a third of the name may differ, but not all of
/// it.
pub fn nearest<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let wanted = name.to_lowercase();
    let length = wanted.chars().count();
    let allowed = (length / 3).max(1);
    candidates
        .into_iter()
        .map(|candidate| {
            let distance = strsim::damerau_levenshtein(&wanted, &candidate.to_lowercase());
            (distance, candidate)
        })
        .filter(|(distance, _)| *distance <= allowed && *distance < length)
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, candidate)| candidate)
}

/// The names in backticks, separated by commas.
pub fn quoted<'a>(names: impl IntoIterator<Item = &'a str>) -> String {
    let names: Vec<String> = names.into_iter().map(|name| format!("`{name}`")).collect();
    names.join(", ")
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
    fn a_slip_of_the_finger_is_understood_and_another_word_is_not() {
        let keys = ["channel", "quantum", "scale", "sign"];
        assert_eq!(nearest("chanel", keys), Some("channel"));
        assert_eq!(nearest("Sclae", keys), Some("scale"));
        assert_eq!(nearest("temperature", keys), None);
        assert_eq!(nearest("D", ["A", "d"]), Some("d"));
        assert_eq!(nearest("D", ["A", "B"]), None);
    }
}
