//! This file is what differs between plants in how names are judged: each set was chosen on recordings of its own.

use crate::rules::{
    LEAST_TRAVEL_SIGMAS_FIVE_BAR, LEAST_TRAVEL_SIGMAS_JOINT, RELEVANT_FIVE_BAR, RELEVANT_JOINT,
};

/// How names are judged.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rules {
    /// Share of the effort below which nothing matters.
    pub relevant: f64,
    /// Multiple of the position's noise that the motion must travel for anything to be told.
    pub least_travel: f64,
    /// Whether many places may lack something at once: names are then added one by one to one explanation and taken out again, not weighed in small sets.
    pub many: bool,
}

impl Rules {
    /// Chosen on recordings of plants with one equation.
    pub const ONE_EQUATION: Rules = Rules {
        relevant: RELEVANT_JOINT,
        least_travel: LEAST_TRAVEL_SIGMAS_JOINT,
        many: false,
    };

    /// As for one equation; an arm lacks something at every joint.
    pub const ARM: Rules = Rules {
        many: true,
        ..Rules::ONE_EQUATION
    };

    /// Chosen on recordings of a linkage: an effect often lives in few blocks.
    pub const LINKAGE: Rules = Rules {
        relevant: RELEVANT_FIVE_BAR,
        least_travel: LEAST_TRAVEL_SIGMAS_FIVE_BAR,
        many: false,
    };
}
