//! This file says which kinds of case there are and which one a seed draws.

use crate::draw::Draw;
use crate::error::Error;
use crate::forms::Forms;
use crate::plant::Plant;
use serde::{Deserialize, Serialize};

/// The kind of a case.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Stratum {
    /// The nominal model is right.
    Nothing,
    /// One effect, clearly detectable.
    Single,
    /// Two effects that each look like less of the other.
    Masked,
    /// One effect that begins in the middle third of the recording.
    LateOnset,
    /// One effect below what the noise lets anybody see.
    TooSmall,
    /// One effect that no library entry describes.
    NotInLibrary,
    /// A recording that a careful technician throws away.
    DataFault,
    /// One effect, with five times the noise on the force.
    Noisy,
    /// One effect, with a controller that looks at the encoders.
    InLoop,
    /// One effect that the experiment cannot tell from another.
    Unidentifiable,
    /// Masses and inertias up to 5 % away from the nominal ones.
    WrongInertia,
    /// Two effects of unlike kinds, in other forms.
    Two,
    /// Three effects of unlike kinds, in other forms.
    Three,
}

impl Stratum {
    /// Every stratum, in the order of the table.
    pub const ALL: [Stratum; 13] = [
        Stratum::Nothing,
        Stratum::Single,
        Stratum::Masked,
        Stratum::LateOnset,
        Stratum::TooSmall,
        Stratum::NotInLibrary,
        Stratum::DataFault,
        Stratum::Noisy,
        Stratum::InLoop,
        Stratum::Unidentifiable,
        Stratum::WrongInertia,
        Stratum::Two,
        Stratum::Three,
    ];

    /// The name used in files and on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Stratum::Nothing => "nothing",
            Stratum::Single => "single",
            Stratum::Masked => "masked",
            Stratum::LateOnset => "late_onset",
            Stratum::TooSmall => "too_small",
            Stratum::NotInLibrary => "not_in_library",
            Stratum::DataFault => "data_fault",
            Stratum::Noisy => "noisy",
            Stratum::InLoop => "in_loop",
            Stratum::Unidentifiable => "unidentifiable",
            Stratum::WrongInertia => "wrong_inertia",
            Stratum::Two => "two",
            Stratum::Three => "three",
        }
    }

    /// The stratum of a name.
    ///
    /// # Errors
    /// [`Error::UnknownStratum`] for any other text.
    pub fn from_name(name: &str) -> Result<Stratum, Error> {
        Stratum::ALL
            .into_iter()
            .find(|stratum| stratum.name() == name)
            .ok_or_else(|| Error::UnknownStratum {
                name: name.to_owned(),
                known: Stratum::ALL.map(Stratum::name).join(", "),
            })
    }

    /// How many of 20 consecutive seeds of a plant, counted from a multiple of 20, hold this stratum.
    pub const fn of_twenty(self, plant: Plant) -> usize {
        let [joint, rig] = match self {
            Stratum::Single => [6, 5],
            Stratum::Nothing => [3, 3],
            Stratum::Masked => [3, 2],
            Stratum::LateOnset => [2, 2],
            Stratum::TooSmall | Stratum::NotInLibrary | Stratum::DataFault => [2, 1],
            Stratum::InLoop => [0, 2],
            Stratum::Noisy | Stratum::Unidentifiable | Stratum::WrongInertia => [0, 1],
            Stratum::Two | Stratum::Three => [0, 0],
        };
        match plant {
            Plant::Rig => rig,
            Plant::Axis | Plant::Bench => joint,
            Plant::Chain => match self {
                Stratum::Single => 7,
                Stratum::Two => 6,
                Stratum::Nothing => 4,
                Stratum::Three => 3,
                _ => 0,
            },
        }
    }

    /// The same for a family of forms.
    pub const fn of_twenty_in(self, forms: Forms, plant: Plant) -> usize {
        match (forms, self) {
            _ if matches!(plant, Plant::Chain) => self.of_twenty(plant),
            (Forms::Usual, _) => self.of_twenty(plant),
            (Forms::Other, Stratum::Single) => 9,
            (Forms::Other, Stratum::Nothing | Stratum::Two) => 3,
            (Forms::Other, Stratum::Three | Stratum::NotInLibrary) => 2,
            (Forms::Other, Stratum::LateOnset) => 1,
            (Forms::Other, _) => 0,
        }
    }

    /// The stratum a seed draws: every block of 20 seeds is the same multiset in an order of its own.
    pub fn of_seed(plant: Plant, seed: u64) -> Stratum {
        Stratum::of_seed_in(Forms::Usual, plant, seed)
    }

    /// The same for a family of forms.
    pub fn of_seed_in(forms: Forms, plant: Plant, seed: u64) -> Stratum {
        let mut deck: Vec<Stratum> = Stratum::ALL
            .into_iter()
            .flat_map(|stratum| std::iter::repeat_n(stratum, stratum.of_twenty_in(forms, plant)))
            .collect();
        let purpose = match forms {
            Forms::Usual => "stratum",
            Forms::Other => "other stratum",
        };
        let mut draw = Draw::new(plant, seed / 20, purpose);
        let mut dealt = Stratum::Nothing;
        for _ in 0..=seed % 20 {
            dealt = deck.swap_remove(draw.below(deck.len()));
        }
        dealt
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_block_of_twenty_seeds_holds_the_stated_proportions() {
        for plant in Plant::ALL {
            for block in [0, 3, 17] {
                let drawn: Vec<Stratum> = (20 * block..20 * block + 20)
                    .map(|seed| Stratum::of_seed(plant, seed))
                    .collect();
                for stratum in Stratum::ALL {
                    let count = drawn.iter().filter(|s| **s == stratum).count();
                    assert_eq!(count, stratum.of_twenty(plant), "{}", stratum.name());
                }
            }
        }
        let order = |block: u64| -> Vec<Stratum> {
            (20 * block..20 * block + 20)
                .map(|seed| Stratum::of_seed(Plant::Axis, seed))
                .collect()
        };
        assert_ne!(order(0), order(1));
    }

    #[test]
    fn names_read_back() {
        for stratum in Stratum::ALL {
            assert_eq!(Stratum::from_name(stratum.name()).unwrap(), stratum);
        }
        let refusal = Stratum::from_name("easy").unwrap_err().to_string();
        assert!(refusal.contains("late_onset"), "{refusal}");
    }
}
