//! This file is the rules by which a mechanism is named, replaced and taken out.

use super::{AXIS_BENCH, BOTH, FIVE_BAR, REASON};

rules! {
    /// Paired z over blocks, weighted by the mechanism's excitation, that a name needs.
    GATE_Z: f64 = 2.5, "z", BOTH;
    /// Share of the left-out loss that must go away.
    GATE_SHARE: f64 = 0.02, "share", BOTH;
    /// Contribution over the effort, root mean square, that a name needs.
    GATE_RELEVANCE: f64 = 0.002, "share", BOTH;
    /// Residual over floor up to which nothing counts as unexplained.
    FLOOR_RATIO: f64 = 1.3, "floors", BOTH;
    /// Of few windows noise alone may be above that: so many deviations of what it comes to are allowed.
    FLOOR_SIGMAS: f64 = 3.0, "deviations", REASON;
    /// Usable windows that tell as much as one that shares no sample with the others: they overlap by three quarters.
    WINDOWS_A_FREEDOM: f64 = 1.5, "windows", REASON;
    /// z below which two explanations are not told apart.
    TIE_Z: f64 = 2.0, "z", AXIS_BENCH;
    /// From how many standard deviations of the sensors' noise on two explanations count as told apart.
    LEAST_SIGMAS: f64 = 10.0, "deviations", "five-bar, twelve experiments, seeds 0 to 11 (decisions 0119, 0134)";
    /// The most mechanisms that are named on one recording.
    MOST_FOUND: usize = 8, "names", AXIS_BENCH;
    /// The most mechanisms that are taken in, those that go again included.
    MOST_STAGES: usize = 14, "names", AXIS_BENCH;
    /// Share of the best gain that an elementary mechanism must reach to be named first.
    ELEMENTARY_SHARE: f64 = 0.5, "share", AXIS_BENCH;
    /// Share of the best gain that a mechanism from the start must reach to be preferred to one that begins later.
    EARLY_SHARE: f64 = 0.8, "share", AXIS_BENCH;
    /// Parts of the recording at whose ends an onset is tried first, the two at each end left out.
    ONSET_GRID: usize = 12, "parts", AXIS_BENCH;
    /// z that one more mechanism needs beside others which leave nothing but noise: what the form of a law lacks is there too.
    MORE_Z: f64 = 4.0, "z", "five-bar, seeds below 10 000 (decision 0150)";
    /// A simpler mechanism is taken when it explains at least this share of what the best one does.
    SIMPLER_SHARE: f64 = 0.9, "share", AXIS_BENCH;
    /// Share of the best gain that a mechanism must reach on its grid to have its shape refined and be judged.
    PROMISING_SHARE: f64 = 0.3, "share", AXIS_BENCH;
    /// Axis and bench: multiple of the unexplained energy (beyond the floor) that a mechanism must explain by itself to be named.
    OWN_TO_UNEXPLAINED_JOINT: f64 = 1.0, "times", AXIS_BENCH;
    /// Five-bar: the same. One of two cogging periods alone comes to 1.7, and laws of another family than the one that is there to 4 and more.
    OWN_TO_UNEXPLAINED_FIVE_BAR: f64 = 2.5, "times", FIVE_BAR;
    /// Five-bar: the same for a name whose law has several forms, if it is the only one.
    LONE_TO_UNEXPLAINED: f64 = 6.0, "times", "five-bar, 140 recordings of seeds below 10 000 (decision 0151)";
    /// Five-bar: the same for names of which each has one form only: what is left is then none of theirs. Compliance comes to 3 as a payload; where a name is right nothing is left.
    EXACT_TO_UNEXPLAINED: f64 = 20.0, "times", "five-bar, seeds below 10 000 (decisions 0133, 0151)";
    /// Share of what a law at a joint explains up to which a second one there is its form: friction of another family is not met exactly.
    OF_ITS_FORM: f64 = 0.1, "share", "five-bar, forced strata of seeds 9000 to 9300 (decision 0155)";
    /// Share of the loss that one mechanism takes away which leaves nothing but noise: what is little above the floor is no loud event.
    SOLE_SHARE: f64 = 0.85, "share", "five-bar, seeds below 10 000 (decision 0151)";
    /// The same for one that leaves more, as a law of another family does.
    SOLE_SHARE_WITH_REST: f64 = 0.95, "share", "five-bar, seeds below 10 000 (decision 0151)";
    /// Share that one takes away before its shape and its onset are refined, if it is to leave nothing but noise.
    SOLE_NEAR: f64 = 0.5, "share", "five-bar, seeds below 10 000 (decision 0155)";
    /// Causes whose shape is refined, those that explain most.
    SOLE_PROMISING: usize = 4, "causes", "five-bar, seeds below 10 000 (decision 0151)";
    /// What an onset may leave more and explain the recording alike: 95 % of χ² with one degree of freedom.
    ALIKE: f64 = 3.84, "loss", "by its reason (decision 0150)";
    /// How far from an onset what is left tells how well one there can be known.
    NEAR_S: f64 = 0.1, "s", REASON;
    /// The first step away from an onset.
    FIRST_STEP_S: f64 = 0.005, "s", REASON;
    /// Halvings between a time that explains the recording alike and one that does not.
    ONSET_INTERVAL_HALVINGS: usize = 6, "1", REASON;
    /// Times between the ends at which the best onset is looked for.
    LOOKED_AT: usize = 16, "times", REASON;
    /// Share of the recording at each end in which no onset is placed: one that begins there is no onset.
    ONSET_MARGIN: f64 = 0.08, "share", AXIS_BENCH;
    /// Most rounds of a pattern search for a shape.
    MOST_ROUNDS: usize = 30, "rounds", REASON;
    /// Halvings of its stride that end it.
    STRIDE_HALVINGS: usize = 6, "1", REASON;
    /// Halvings that place an onset to about a sample.
    ONSET_HALVINGS: usize = 11, "1", REASON;
    /// The first stride, as a share of a shape parameter.
    STRIDE: f64 = 0.3, "share", AXIS_BENCH;
    /// The first stride of an onset, as a share of the recording, over that of a shape.
    ONSET_STRIDE: f64 = 0.15, "share", AXIS_BENCH;
    /// A period is known to a small share of it before, and its neighbours are other periods: its stride beside that of others.
    PERIOD_STRIDE: f64 = 0.004 / STRIDE, "share", AXIS_BENCH;
    /// Share of the loss that a round must take away for its stride to stay.
    LEAST_IMPROVEMENT: f64 = 1e-4, "share", REASON;
    /// Rounds in which the columns of what moves the linkage are taken again, over the change that their coefficients say.
    TAKEN_AGAIN: usize = 3, "rounds", REASON;
    /// Loss beside the one before up to which columns that were taken again are kept: they are the truer ones even where they fit no better.
    NO_WORSE: f64 = 1.1, "times", "five-bar, seeds below 10 000 (decision 0150)";
    /// Rounds in which a change of the drive is linearised again about the fit it gave.
    RELINEARISE: usize = 3, "rounds", REASON;
    /// Share of a current that hysteresis is linearised with: the torque is not linear in the current.
    USUAL_SHARE: f64 = 0.3, "share", REASON;
}
