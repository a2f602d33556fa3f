//! This file is what differs between plants in how names are judged: each set was chosen on recordings of its own.

use crate::rules::{
    LEAST_RIVAL_SHARE_FIVE_BAR, LEAST_RIVAL_SHARE_JOINT, LEAST_TRAVEL_SIGMAS_FIVE_BAR,
    LEAST_TRAVEL_SIGMAS_JOINT, OWN_TO_UNEXPLAINED_FIVE_BAR, OWN_TO_UNEXPLAINED_JOINT,
    RELEVANT_FIVE_BAR, RELEVANT_JOINT,
};

/// How names are judged.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rules {
    /// Share of an effect's gain below which nothing counts as explaining as much, however the blocks scatter.
    pub least_rival_share: f64,
    /// Multiple of the unexplained energy (beyond the floor) that a mechanism must explain by itself to be named.
    pub own_to_unexplained: f64,
    /// Share of the effort below which nothing matters.
    pub relevant: f64,
    /// Multiple of the position's noise that the motion must travel for anything to be told.
    pub least_travel: f64,
    /// Whether a name must explain more where each has one form only, or where it stands alone.
    pub by_form: bool,
    /// Whether what decides if more than noise is left counts however small it is, and rivals are told apart by that noise.
    pub by_floor: bool,
    /// Whether friction that bends stands for what is plain beside it: laws that mask each other, forms of one law, bristles of unequal limits.
    pub by_family: bool,
    /// Whether one mechanism that shows in few windows is looked for where blocks show none.
    pub by_window: bool,
    /// Whether a name is withdrawn whose number is not constant along the recording.
    pub constancy: bool,
    /// Whether a name is withdrawn where a free curve over its own variable takes much of what is left.
    pub curves: bool,
    /// Whether many places may lack something at once: names are then added one by one to one explanation and taken out again, not weighed in small sets.
    pub many: bool,
}

impl Rules {
    /// Chosen on recordings of plants with one equation.
    pub const ONE_EQUATION: Rules = Rules {
        least_rival_share: LEAST_RIVAL_SHARE_JOINT,
        relevant: RELEVANT_JOINT,
        own_to_unexplained: OWN_TO_UNEXPLAINED_JOINT,
        least_travel: LEAST_TRAVEL_SIGMAS_JOINT,
        by_form: false,
        by_floor: false,
        by_family: false,
        by_window: false,
        constancy: false,
        curves: true,
        many: false,
    };

    /// As for one equation; an arm lacks something at every joint.
    pub const ARM: Rules = Rules {
        many: true,
        ..Rules::ONE_EQUATION
    };

    /// Chosen on recordings of a linkage: an effect often lives in few blocks.
    pub const LINKAGE: Rules = Rules {
        least_rival_share: LEAST_RIVAL_SHARE_FIVE_BAR,
        relevant: RELEVANT_FIVE_BAR,
        own_to_unexplained: OWN_TO_UNEXPLAINED_FIVE_BAR,
        least_travel: LEAST_TRAVEL_SIGMAS_FIVE_BAR,
        by_form: true,
        by_floor: true,
        by_family: true,
        by_window: true,
        constancy: true,
        curves: false,
        many: false,
    };
}
