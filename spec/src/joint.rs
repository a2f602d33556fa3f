//! This file names the joints that can carry a brake.

/// A joint of the five-bar linkage that can carry a brake (thesis figure 4.5). Order is A, E, B, C
/// everywhere.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Joint {
    /// Grounded joint of arm AE.
    A,
    /// Joint between arm AE and arm ED.
    E,
    /// Grounded joint of arm BC.
    B,
    /// Joint between arm BC and arm CD.
    C,
}

impl Joint {
    /// All joints in the house order.
    pub const ALL: [Joint; 4] = [Joint::A, Joint::E, Joint::B, Joint::C];

    /// The letter the thesis prints.
    pub const fn letter(self) -> &'static str {
        match self {
            Joint::A => "A",
            Joint::E => "E",
            Joint::B => "B",
            Joint::C => "C",
        }
    }

    /// The joint of a letter, or `None` for any other text.
    pub fn from_letter(letter: &str) -> Option<Joint> {
        Joint::ALL
            .into_iter()
            .find(|joint| joint.letter() == letter)
    }
}
