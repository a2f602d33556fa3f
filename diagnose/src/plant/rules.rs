//! This file is the set of rules that differ between plants. Each set was chosen on recordings of
//! its own.

use crate::rules::{
    LEAST_TRAVEL_SIGMAS_FIVE_BAR, LEAST_TRAVEL_SIGMAS_JOINT, RELEVANT_FIVE_BAR, RELEVANT_JOINT,
};

/// The rules of naming that depend on the plant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rules {
    /// Share of the effort below which an effect does not matter.
    pub relevant: f64,
    /// The least travel for a diagnosis, as a multiple of the position's noise.
    pub least_travel: f64,
    /// Whether many places may lack something at once. One explanation then grows term by term,
    /// instead of a comparison of small sets.
    pub many: bool,
}

impl Rules {
    /// Chosen on recordings of plants with one equation.
    pub const ONE_EQUATION: Rules = Rules {
        relevant: RELEVANT_JOINT,
        least_travel: LEAST_TRAVEL_SIGMAS_JOINT,
        many: false,
    };

    /// As for one equation, except that an arm may lack something at every joint.
    pub const ARM: Rules = Rules {
        many: true,
        ..Rules::ONE_EQUATION
    };

    /// Chosen on recordings of a linkage, where an effect often acts in few blocks only.
    pub const LINKAGE: Rules = Rules {
        relevant: RELEVANT_FIVE_BAR,
        least_travel: LEAST_TRAVEL_SIGMAS_FIVE_BAR,
        many: false,
    };
}
