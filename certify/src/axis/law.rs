//! This file names the laws that every sample of a controller of an axis is held to.

use serde::{Deserialize, Serialize};

/// A law.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[expect(missing_docs, reason = "`words` says what each is")]
pub enum Law {
    Answers,
    EffortLimit,
    Travel,
    Repeats,
    Chatter,
    Passivity,
}

/// How many laws there are.
pub const LAWS: usize = 6;

impl Law {
    /// Every law.
    pub const ALL: [Law; LAWS] = [
        Law::Answers,
        Law::EffortLimit,
        Law::Travel,
        Law::Repeats,
        Law::Chatter,
        Law::Passivity,
    ];

    /// Its name in files.
    pub const fn name(self) -> &'static str {
        match self {
            Law::Answers => "answers",
            Law::EffortLimit => "effort_limit",
            Law::Travel => "travel",
            Law::Repeats => "repeats",
            Law::Chatter => "chatter",
            Law::Passivity => "passivity",
        }
    }

    /// What it says.
    pub const fn words(self) -> &'static str {
        match self {
            Law::Answers => "the controller answers every sample in time, and ends when it is told",
            Law::EffortLimit => "every effort is a number and within its limit",
            Law::Travel => "the axis stays between its stops",
            Law::Repeats => {
                "the same samples get the same efforts, bit for bit, in the same process and in another"
            }
            Law::Chatter => {
                "in any second the effort turns back, by more than a fiftieth of its limit, no more often than is allowed"
            }
            Law::Passivity => {
                "while its target rests it gives out no more energy than a spring of the declared stiffness held"
            }
        }
    }

    /// The unit of its margin, on an axis whose units of travel and effort these are.
    pub const fn unit(self, [travel, effort]: [&'static str; 2]) -> &'static str {
        match self {
            Law::Answers => "samples",
            Law::EffortLimit | Law::Repeats => effort,
            Law::Travel => travel,
            Law::Chatter => "reversals",
            Law::Passivity => "J",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_law_has_its_place_and_its_name() {
        for (index, law) in Law::ALL.into_iter().enumerate() {
            assert_eq!(law as usize, index);
            let written = serde_json::to_string(&law).unwrap();
            assert_eq!(written, format!("\"{}\"", law.name()));
        }
    }
}
