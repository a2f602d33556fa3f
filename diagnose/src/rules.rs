//! This file is the table of rules: every number that decides a name, a verdict or a fault, with
//! its unit, its reason and the recordings it was chosen on.
//!
//! The five-bar and the plants of one joint have separate values where each was chosen on
//! recordings of its own plants.

/// A number that decides.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rule {
    /// Its name in the source.
    pub name: &'static str,
    /// Its value as the source writes it.
    pub value: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// Why there is such a number, and where it may be seen why it is this one.
    pub reason: &'static str,
    /// The recordings that it was chosen on.
    pub chosen_on: &'static str,
}

/// Declares rules: constants, and a table of them.
macro_rules! rules {
    ($($(#[doc = $reason:literal])+ $name:ident: $type:ty = $value:expr, $unit:literal, $chosen_on:expr;)+) => {
        $($(#[doc = $reason])+ pub const $name: $type = $value;)+

        /// The rules of this file.
        pub(super) const TABLE: &[super::Rule] = &[$(super::Rule {
            name: stringify!($name),
            value: stringify!($value),
            unit: $unit,
            reason: concat!($($reason),+),
            chosen_on: $chosen_on,
        }),+];
    };
}

mod evidence;
mod experiment;
mod explain;
mod identify;
mod recording;
mod search;
mod shapes;
mod windows;

pub use evidence::*;
pub use experiment::*;
pub use explain::*;
pub use identify::*;
pub use recording::*;
pub use search::*;
pub use shapes::*;
pub use windows::*;

const AXIS_BENCH: &str = "axis and bench, blind seeds 1000 to 1999 (decision 0011)";
const FIVE_BAR: &str = "five-bar, blind seeds below 10 000 (decision 0110)";
const BOTH: &str = "axis and bench, blind seeds 1000 to 1999 (decision 0011); kept for the five-bar, seeds below 10 000 (decision 0110)";
const DRIVEN: &str = "axis, fourteen recordings of one joint by an independent simulation and sixty by another (development); reported on others";
const LINKAGE: &str = "five-bar, sixteen recordings by an independent simulation (development)";
const REASON: &str = "by its reason; no recordings on record";
const IDENTIFY: &str = "by its reason; looked at on simulated brakes (decision 0053)";

/// The rules, in groups with a title.
pub const RULES: [(&str, &[Rule]); 8] = [
    ("What a recording must hold", recording::TABLE),
    ("Windows, blocks and noise", windows::TABLE),
    ("The search for names", search::TABLE),
    ("Explanations side by side", explain::TABLE),
    ("The shapes that are tried", shapes::TABLE),
    ("Rivals, bounds and what stays", evidence::TABLE),
    ("The next experiment", experiment::TABLE),
    ("The numbers of a brake", identify::TABLE),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_page_prints_every_rule_in_its_group_and_its_order() {
        let page = include_str!("../../docs/rules.md");
        let printed: Vec<&str> = page
            .lines()
            .filter(|line| line.starts_with("## ") || line.starts_with("| `"))
            .collect();
        let mut expected: Vec<String> = Vec::new();
        for (title, rules) in RULES {
            expected.push(format!("## {title}"));
            expected.extend(rules.iter().map(|rule| {
                format!(
                    "| `{}` | {} | {} | {} | {} |",
                    rule.name,
                    rule.value,
                    rule.unit,
                    rule.reason.trim(),
                    rule.chosen_on
                )
            }));
        }
        assert_eq!(printed, expected);
    }

    #[test]
    fn every_rule_has_a_name_of_its_own_and_says_why() {
        let rules: Vec<Rule> = RULES
            .iter()
            .flat_map(|(_, rules)| rules.iter().copied())
            .collect();
        let mut names: Vec<&str> = rules.iter().map(|rule| rule.name).collect();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), rules.len());
        for rule in rules {
            assert!(
                rule.reason.trim().len() > 10 && rule.reason.ends_with('.'),
                "{}",
                rule.name
            );
            assert!(
                !rule.unit.is_empty() && rule.chosen_on.len() > 10,
                "{}",
                rule.name
            );
        }
    }
}
