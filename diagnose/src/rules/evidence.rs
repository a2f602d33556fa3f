//! This file is the rules by which a name is doubted, bounded or withdrawn, and by which what stays is shown.

use super::{AXIS_BENCH, REASON};

rules! {
    /// Bootstrap replicates of the inclusion frequency.
    INCLUSION_REPLICATES: usize = 500, "1", REASON;
    /// z a coefficient must have to be seen with 80 % power at the gates' z.
    POWER_Z: f64 = 0.84, "z", REASON;
    /// Share of a column that must stand out of the named ones for a bound on it to mean anything.
    TELLABLE: f64 = 0.02, "share", REASON;
    /// Fewest degrees of freedom: a number that lives in one or two blocks is not believed to be without any scatter, nor to have none but theirs.
    LEAST_FREEDOM: f64 = 3.0, "freedoms", "five-bar (decision 0149)";
    /// Most times by which an interval is wider because the law is another form of the true one.
    TIMES_BY_FORM: f64 = 3.0, "times", "axis and bench, other forms, seeds 2100 to 2130 (decision 0233)";
    /// Standard deviations of its noise by which a reaction must be beyond what holds the joint before something is said to be missing: several thousand windows are looked at.
    BEYOND_SIGMAS: f64 = 5.0, "deviations", "five-bar, 28 recordings of seeds 7201 to 7261 (decision 0156)";
    /// Share of the remaining loss that a curve must take away on left-out blocks to be drawn.
    CURVE_SHARE: f64 = 0.02, "share", AXIS_BENCH;
    /// Knots of a curve.
    KNOTS: usize = 20, "knots", AXIS_BENCH;
    /// Blocks between two knots of a curve over time: a block that is left out must leave something of each hat.
    BLOCKS_A_KNOT: usize = 2, "blocks", AXIS_BENCH;
    /// Energy of one part of a curve over the other's from which on it is called odd or even.
    PARITY_TIMES: f64 = 3.0, "times", REASON;
    /// Share of the free run's squared error that a slow drift must take away on the fitted part to be named.
    DRIFT_SHARE: f64 = 0.5, "share", "axis (decision 0012)";
    /// Horizons at which the error of a free run is shown.
    HORIZONS_S: [f64; 4] = [0.01, 0.05, 0.2, 1.0], "s", REASON;
    /// Axis and bench: starts of a figure at a horizon.
    HORIZON_STARTS: usize = 60, "runs", REASON;
    /// Five-bar: free runs of a part of a recording from which the errors at the horizons are taken.
    SHOTS: usize = 24, "runs", "five-bar (decision 0115)";
    /// Five-bar: a horizon is asked for where it is at most this share of the part.
    MOST_OF_PART: f64 = 0.5, "share", REASON;
    /// Time since a reversal below which a window belongs to it, in the table of where the residual is.
    REVERSAL_S: f64 = 0.1, "s", REASON;
    /// Bootstrap replicates of the shares of that table.
    LOCATE_REPLICATES: usize = 200, "1", REASON;
    /// Blocks that they draw from.
    LOCATE_BLOCKS: usize = 20, "blocks", REASON;
    /// Current above which a brake counts as on, in that table.
    ON_A: f64 = 0.05, "A", REASON;
    /// Axis and bench: a held-out free run agrees with the windows where its error is within so many deviations of what noise, the windows and the intervals of the numbers predict.
    AGREES_WITHIN: f64 = 3.0, "deviations", REASON;
    /// Held-out windows agree with the fitted ones where they leave at most so many times the noise, times what the fitted ones leave over it: intervals of the numbers are in it.
    HELD_OUT_TIMES: f64 = 2.0, "times", REASON;
}
