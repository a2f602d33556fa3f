//! This file is the rules by which a name is doubted, bounded or withdrawn, and by which what stays is shown.

use super::{AXIS_BENCH, REASON};

rules! {
    /// Bootstrap replicates behind the inclusion frequency of a name.
    INCLUSION_REPLICATES: usize = 500, "1", REASON;
    /// Added to the detection z, so that a coefficient of that size would be detected with a power of 80 %.
    POWER_Z: f64 = 0.84, "z", REASON;
    /// Share of a column that must remain once the named ones are projected out for a bound on its coefficient to mean anything.
    TELLABLE: f64 = 0.02, "share", REASON;
    /// Fewest degrees of freedom of an interval: the scatter between one or two blocks is no estimate of a variance.
    LEAST_FREEDOM: f64 = 3.0, "freedoms", "five-bar (decision 0149)";
    /// Greatest factor by which an interval is widened because the true law may have another form.
    TIMES_BY_FORM: f64 = 3.0, "times", "axis and bench, other forms, seeds 2100 to 2130 (decision 0233)";
    /// How far the torque on a joint at rest must exceed what holds it, in standard deviations of its noise, before something is said to be missing. Several thousand windows are examined, so the limit is high.
    BEYOND_SIGMAS: f64 = 5.0, "deviations", "five-bar, 28 recordings of seeds 7201 to 7261 (decision 0156)";
    /// A curve of the residual is drawn if it removes this share of the remaining loss on left-out blocks.
    CURVE_SHARE: f64 = 0.02, "share", AXIS_BENCH;
    /// Knots of such a curve.
    KNOTS: usize = 20, "knots", AXIS_BENCH;
    /// Blocks between two knots of a curve over time, so that every basis function keeps data when a block is left out.
    BLOCKS_A_KNOT: usize = 2, "blocks", AXIS_BENCH;
    /// A curve is called odd or even if that part of it has this many times the energy of the other part.
    PARITY_TIMES: f64 = 3.0, "times", REASON;
    /// A slow drift is named if it removes this share of the free run's squared error on the fitted part.
    DRIFT_SHARE: f64 = 0.5, "share", "axis (decision 0012)";
    /// Horizons at which the error of a free run is shown.
    HORIZONS_S: [f64; 4] = [0.01, 0.05, 0.2, 1.0], "s", REASON;
    /// Axis and bench: free runs that are started for the error at one horizon.
    HORIZON_STARTS: usize = 60, "runs", REASON;
    /// Five-bar: free runs within a part of a recording from which the errors at the horizons are computed.
    SHOTS: usize = 24, "runs", "five-bar (decision 0115)";
    /// Five-bar: a horizon is reported if it is at most this share of the part.
    MOST_OF_PART: f64 = 0.5, "share", REASON;
    /// In the table of where the residual is, a window belongs to a reversal up to this time after it.
    REVERSAL_S: f64 = 0.1, "s", REASON;
    /// Bootstrap replicates of the shares of that table.
    LOCATE_REPLICATES: usize = 200, "1", REASON;
    /// Blocks of time that these replicates draw from.
    LOCATE_BLOCKS: usize = 20, "blocks", REASON;
    /// Current above which a brake counts as on, in that table.
    ON_A: f64 = 0.05, "A", REASON;
    /// Axis and bench: a held-out free run agrees with the windows if its error is within this many standard deviations of what noise, windows and the intervals of the numbers predict.
    AGREES_WITHIN: f64 = 3.0, "deviations", REASON;
    /// Held-out windows agree with the fitted ones if their ratio of residual to noise is at most this many times that of the fitted ones. The uncertainty of the numbers is included in it.
    HELD_OUT_TIMES: f64 = 2.0, "times", REASON;
}
