//! This file is the rules by which the leading explanation is polished, and by which a mechanism would be seen.

use super::{AXIS_BENCH, BOTH, REASON};

rules! {
    /// z at which a mechanism would be seen: the least sizes that are told of what was not named go by it.
    GATE_Z: f64 = 2.5, "z", BOTH;
    /// Share of the left-out loss that goes away where a mechanism is seen, and where a name holds on a resampled recording.
    GATE_SHARE: f64 = 0.02, "share", BOTH;
    /// Residual over floor up to which nothing counts as unexplained.
    FLOOR_RATIO: f64 = 1.3, "floors", BOTH;
    /// Of few windows noise alone may be above that: so many deviations of what it comes to are allowed.
    FLOOR_SIGMAS: f64 = 3.0, "deviations", REASON;
    /// Usable windows that tell as much as one that shares no sample with the others: they overlap by three quarters.
    WINDOWS_A_FREEDOM: f64 = 1.5, "windows", REASON;
    /// From how many standard deviations of the sensors' noise on two explanations count as told apart.
    LEAST_SIGMAS: f64 = 10.0, "deviations", "five-bar, twelve experiments, seeds 0 to 11 (decisions 0119, 0134)";
    /// Parts of the recording at whose ends an onset is tried first, the two at each end left out.
    ONSET_GRID: usize = 12, "parts", AXIS_BENCH;
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
}
