//! This file is what differs between plants in how names are judged: each set was chosen on recordings of its own.

/// How names are judged.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rules {
    /// Share of an effect's gain below which nothing counts as explaining as much, however the blocks scatter.
    pub least_rival_share: f64,
    /// Multiple of the unexplained energy (beyond the floor) that a mechanism must explain by itself to be named.
    pub own_to_unexplained: f64,
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
}

impl Rules {
    /// Chosen on recordings of plants with one equation.
    pub const ONE_EQUATION: Rules = Rules {
        least_rival_share: f64::NEG_INFINITY,
        own_to_unexplained: 1.0,
        least_travel: 20.0,
        by_form: false,
        by_floor: false,
        by_family: false,
        by_window: false,
        constancy: false,
        curves: true,
    };

    /// Chosen on recordings of a linkage: an effect often lives in few blocks. One of two cogging periods alone comes to 1.7 times what is
    /// unexplained, and laws of another family than the one that is there to 4 and more.
    pub const LINKAGE: Rules = Rules {
        least_rival_share: 0.5,
        own_to_unexplained: 2.5,
        least_travel: 0.0,
        by_form: true,
        by_floor: true,
        by_family: true,
        by_window: true,
        constancy: true,
        curves: false,
    };
}
