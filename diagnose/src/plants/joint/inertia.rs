//! This file is the inertia of a plant of one joint, as a diagnosis knows it.

/// The inertia of an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Inertia {
    /// A bench: none.
    None,
    /// Known, kg or kg·m².
    Known(f64),
    /// To be estimated, with a start value.
    Unknown(f64),
}

impl Inertia {
    /// The value that is known or started from, kg or kg·m²; 0 on a bench.
    pub fn start(self) -> f64 {
        match self {
            Inertia::None => 0.0,
            Inertia::Known(value) | Inertia::Unknown(value) => value,
        }
    }
}
