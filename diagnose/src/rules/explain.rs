//! This file is the rules by which sets of mechanisms are weighed against one another as explanations of a recording.

use super::{DRIVEN, LINKAGE, REASON};

rules! {
    /// Axis and bench: share of the effort below which nothing matters to anybody: what a model and its discretisation leave open anyhow.
    RELEVANT_JOINT: f64 = 0.003, "share", DRIVEN;
    /// Five-bar: the same. The hand's effort is many times what its brakes do at rest.
    RELEVANT_FIVE_BAR: f64 = 0.001, "share", LINKAGE;
    /// The same as a share of what sensor noise leaves: below it nothing can be told from what the noise model lacks.
    RELEVANT_NOISE: f64 = 0.7, "share", DRIVEN;
    /// The least autocorrelation of what is left that counts.
    LEAST_CORRELATION: f64 = 0.05, "1", REASON;
    /// Rows that say as much as one that is independent of all others, times the integrated autocorrelation of what the best explanation leaves: that is an estimate itself.
    ROWS_A_SAMPLE: f64 = 2.5, "rows", DRIVEN;
    /// Fewest times that a motion repeats itself in a recording for its period to be seen.
    FEWEST_REPEATS: usize = 3, "times", REASON;
    /// What each number beyond the first costs an explanation, in natural logarithms of odds.
    A_NUMBER: f64 = 2.4, "ln odds", DRIVEN;
    /// How common a mechanism is among those that models leave out, from the plainest to the most seldom, in natural logarithms of odds: which it is stands with the mechanism.
    USUAL_ODDS: [f64; 6] = [-3.2, -4.0, -4.8, -5.6, -6.4, -8.0], "ln odds", DRIVEN;
    /// Explanations with one mechanism at two places are one where their odds differ by no more: what rounding leaves between places that move alike.
    AS_ONE: f64 = 0.01, "ln odds", REASON;
    /// The least weight of an explanation that is listed.
    LISTED: f64 = 1e-4, "share", DRIVEN;
    /// The probability from which on something is named.
    NAMED: f64 = 0.9, "probability", REASON;
    /// The probability from which on something is suspected.
    SUSPECTED: f64 = 0.5, "probability", REASON;
    /// The least weight of what is offered in the place of a name.
    OFFERED: f64 = 0.03, "probability", REASON;
    /// The most explanations that are listed.
    MOST_LISTED: usize = 8, "explanations", REASON;
    /// Rounds in which each term of the leading explanations is exchanged for every other.
    EXCHANGES: usize = 2, "rounds", DRIVEN;
    /// Leading explanations of which each term is tried from an onset on, beside all those of one term.
    LATE: usize = 2, "explanations", REASON;
    /// The most terms of one explanation.
    MOST_TERMS: usize = 3, "terms", DRIVEN;
    /// An arm: the most terms of its explanation.
    MOST_OF_MANY: usize = 48, "terms", REASON;
    /// An arm: how many numbers the inertial numbers of a link count as: wrong together, as one description gives them, and less plain than a single mass.
    A_LINK: usize = 3, "numbers", "thirty concealed arms, seeds 0 to 29";
    /// An arm: how much of a described friction may be taken away again, where a fit may be off by some.
    GIVEN_BACK: f64 = 1.2, "share", REASON;
    /// An arm: the width of a window. A test function of this width lets pass half of the amplitude at 8 Hz, as a low-pass run forward and backward that arms are fitted behind.
    ARM_WIDTH_S: f64 = 0.155, "s", REASON;
    /// An arm: cut-off of the positions' smoothing, periods in a width of a window.
    ARM_PERIODS: f64 = 3.0, "periods", REASON;
    /// Explanations of each size that are gone on from.
    BEAM: usize = 6, "explanations", DRIVEN;
    /// Explanations of each size that are kept to be weighed.
    KEPT: usize = 40, "explanations", DRIVEN;
    /// Strides of the search for a shape, as shares of a shape parameter.
    STRIDES: [f64; 4] = [0.15, 0.06, 0.025, 0.01], "share", DRIVEN;
    /// Moves of one parameter by one stride.
    MOST_MOVES: usize = 4, "moves", DRIVEN;
    /// Fewest usable rows of a block that is counted.
    FEWEST_ROWS: usize = 5, "rows", REASON;
}
