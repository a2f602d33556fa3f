//! This file is the rules by which the leading explanation is polished, and by which a mechanism would be seen.

use super::{AXIS_BENCH, BOTH, REASON};

rules! {
    /// Detection limit: z at which a mechanism would be seen. The smallest detectable sizes of what was not named follow from it.
    GATE_Z: f64 = 2.5, "z", BOTH;
    /// Share of the left-out loss that a mechanism removes where it is detected, and that a name removes where it holds on a resampled recording.
    GATE_SHARE: f64 = 0.02, "share", BOTH;
    /// Ratio of residual to predicted noise up to which nothing counts as unexplained.
    FLOOR_RATIO: f64 = 1.3, "floors", BOTH;
    /// With few windows noise alone may exceed that ratio: this many of its standard deviations are allowed.
    FLOOR_SIGMAS: f64 = 3.0, "deviations", REASON;
    /// Usable windows for each degree of freedom: windows overlap by three quarters.
    WINDOWS_A_FREEDOM: f64 = 1.5, "windows", REASON;
    /// Two explanations count as separated by an experiment from this many standard deviations of the sensor noise on.
    LEAST_SIGMAS: f64 = 10.0, "deviations", "five-bar, twelve experiments, seeds 0 to 11 (decisions 0119, 0134)";
    /// An onset is first tried at the ends of this many parts of the recording, the two at each end left out.
    ONSET_GRID: usize = 12, "parts", AXIS_BENCH;
    /// Two onsets explain the recording equally well if their losses differ by at most this: 95 % of χ² with one degree of freedom.
    ALIKE: f64 = 3.84, "loss", "by its reason (decision 0150)";
    /// Span on each side of an onset whose residual tells how exactly an onset there can be placed.
    NEAR_S: f64 = 0.1, "s", REASON;
    /// First step away from an onset: for its slope, and outward to the ends of its interval.
    FIRST_STEP_S: f64 = 0.005, "s", REASON;
    /// Bisections that place an end of an onset's interval.
    ONSET_INTERVAL_HALVINGS: usize = 6, "1", REASON;
    /// Times between these ends at which a better onset is tried.
    LOOKED_AT: usize = 16, "times", REASON;
    /// Share of the recording at each end in which no onset is placed: an effect that begins there has none.
    ONSET_MARGIN: f64 = 0.08, "share", AXIS_BENCH;
    /// Most rounds of a pattern search for a shape.
    MOST_ROUNDS: usize = 30, "rounds", REASON;
    /// Halvings of its stride after which the search ends.
    STRIDE_HALVINGS: usize = 6, "1", REASON;
    /// Halvings that place an onset to about one sample.
    ONSET_HALVINGS: usize = 11, "1", REASON;
    /// The first stride, as a share of a shape parameter.
    STRIDE: f64 = 0.3, "share", AXIS_BENCH;
    /// First stride of an onset as a share of the recording, relative to that of a shape.
    ONSET_STRIDE: f64 = 0.15, "share", AXIS_BENCH;
    /// First stride of a period, relative to that of other shapes: a period is already known to a small share, and its neighbours are other periods.
    PERIOD_STRIDE: f64 = 0.004 / STRIDE, "share", AXIS_BENCH;
    /// Share of the loss that a round must remove for its stride to stay.
    LEAST_IMPROVEMENT: f64 = 1e-4, "share", REASON;
    /// Rounds in which columns that change the linkage, or what an encoder shows, are computed anew at the fitted change.
    TAKEN_AGAIN: usize = 3, "rounds", REASON;
    /// Such columns are kept if the loss is at most this many times the loss before: they are more accurate even where they fit no better.
    NO_WORSE: f64 = 1.1, "times", "five-bar, seeds below 10 000 (decision 0150)";
    /// Rounds in which a change of the drive is linearised again about its last fit.
    RELINEARISE: usize = 3, "rounds", REASON;
}
