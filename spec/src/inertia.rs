//! This file holds what the thesis prints about the mass of the arms: table 5.1.
//!
//! The table stands a second time as CSV under `thesis/tables/`; a test compares the two.

use crate::layout::Layout;

/// One arm's row of table 5.1, with all components that attach directly to it (§5.2).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ArmInertia {
    /// Mass m, kg.
    pub mass_kg: f64,
    /// Moment of inertia I about the arm's own centre of mass, kg·m².
    pub inertia_kg_m2: f64,
    /// Distance l of the centre of mass from the arm's first joint (A, E, B or C), m.
    pub centre_m: f64,
}

/// The inertial half of table 5.1 for one layout; the lengths are the arms'.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inertia {
    /// Arm AE.
    pub ae: ArmInertia,
    /// Arm ED.
    pub ed: ArmInertia,
    /// Arm BC.
    pub bc: ArmInertia,
    /// Arm CD.
    pub cd: ArmInertia,
    /// Point mass at the tip D, kg.
    pub payload_kg: f64,
}

/// The masses, inertias and centres of mass of a layout (table 5.1).
///
/// ```
/// use rigproof_spec::{inertia::inertia, layout::Layout};
/// assert_eq!(inertia(Layout::FourBrake).cd.mass_kg, 3.48);
/// ```
#[rustfmt::skip]
pub const fn inertia(layout: Layout) -> Inertia {
    match layout {
        Layout::ThreeBrake => Inertia {
            ae: arm(3.70, 0.0661, 0.166),
            ed: arm(2.74, 0.0336, 0.096),
            bc: arm(2.62, 0.0355, 0.109),
            cd: arm(2.59, 0.0355, 0.188),
            payload_kg: 0.0,
        },
        Layout::FourBrake => Inertia {
            ae: arm(3.70, 0.0535, 0.152),
            ed: arm(2.74, 0.0336, 0.096),
            bc: arm(3.70, 0.0535, 0.152),
            cd: arm(3.48, 0.0593, 0.140),
            payload_kg: 0.0,
        },
    }
}

const fn arm(mass_kg: f64, inertia_kg_m2: f64, centre_m: f64) -> ArmInertia {
    ArmInertia {
        mass_kg,
        inertia_kg_m2,
        centre_m,
    }
}
