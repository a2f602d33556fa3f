//! This file says which joints carry a brake in each of the two layouts.

use crate::joint::Joint;

/// One of the two brake layouts of thesis chapter 4.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Layout {
    /// Brakes at A, B and E; A and B share one axis (`L_AB` = 0), so that E and C are redundant.
    ThreeBrake,
    /// Brakes at A, E, B and C.
    FourBrake,
}

impl Layout {
    /// The braked joints, in house order.
    pub const fn brakes(self) -> &'static [Joint] {
        match self {
            Layout::ThreeBrake => &[Joint::A, Joint::E, Joint::B],
            Layout::FourBrake => &Joint::ALL,
        }
    }
}
