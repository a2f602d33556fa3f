//! This file is the inertia of a plant of one joint, as the description gives it.

/// The inertia of an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Inertia {
    /// A bench has none in its equation.
    None,
    /// Known, kg or kg·m².
    Known(f64),
    /// To be estimated, with this start value, kg or kg·m².
    Unknown(f64),
}

impl Inertia {
    /// The known or start value, kg or kg·m²; 0 on a bench.
    pub fn start(self) -> f64 {
        match self {
            Inertia::None => 0.0,
            Inertia::Known(value) | Inertia::Unknown(value) => value,
        }
    }
}
