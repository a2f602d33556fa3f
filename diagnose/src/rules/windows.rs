//! This file is the rules by which the equation of motion is averaged over windows, and windows are put into blocks.

use super::{AXIS_BENCH, BOTH, DRIVEN, FIVE_BAR, REASON};

rules! {
    /// Order of the bump (1 − x²)⁴: three continuous derivatives at its ends.
    BUMP_ORDER: i32 = 4, "1", REASON;
    /// Widths of windows that are tried; the last is taken where no narrower one is quiet enough.
    WIDTHS_S: [f64; 3] = [0.040, 0.080, 0.160], "s", BOTH;
    /// Axis: a window is wide enough when the noise floor is below this share of the effort.
    QUIET: f64 = 0.003, "share", AXIS_BENCH;
    /// Axis: a fast effort narrows the window if the noise floor stays below this share of the effort: an effort that is fed back from the position is as fast as its noise.
    MOST_NOISE: f64 = 0.05, "share", DRIVEN;
    /// Five-bar: a window is wide enough when the noise floor is below this, so that contributions of 0.01 N·m show in a few windows.
    QUIET_NM: f64 = 0.0075, "N·m", FIVE_BAR;
    /// Axis: the narrowest window.
    LEAST_STEPS_AXIS: f64 = 8.0, "samples", AXIS_BENCH;
    /// Bench: the narrowest window.
    LEAST_STEPS_BENCH: f64 = 5.0, "samples", AXIS_BENCH;
    /// A window is no wider than this many periods of the highest frequency of the effort.
    PERIODS_A_WIDTH: f64 = 2.0, "periods", AXIS_BENCH;
    /// The band of an effort holds this share of its power.
    BAND_SHARE: f64 = 0.95, "share", REASON;
    /// Share of a window's weight that may lie where the direction of motion is unknown.
    MOST_AMBIGUOUS: f64 = 0.002, "share", AXIS_BENCH;
    /// Greatest contribution, in noise floors, of a friction as large as the whole effort (axis, bench) or of the brakes (five-bar) where the direction of motion is unknown.
    MOST_UNTOLD: f64 = 0.5, "floors", BOTH;
    /// A brake has settled in a window if its predicted effort changes from sample to sample by at most this on average: the windows that are used of the thesis's brake, and of every brake where its trials differ, since in between it is of two of them.
    MOST_STEP: f64 = 0.5, "floors", AXIS_BENCH;
    /// A window is used if the predicted effort may be wrong by at most this on average.
    MOST_DOUBT: f64 = 0.5, "floors", "bench, brakes that change as foreseen (decision 0153)";
    /// Fewest windows from which anything is concluded.
    FEWEST_WINDOWS: usize = 40, "windows", AXIS_BENCH;
    /// Order of the autoregression of the noise: two window widths at a hop of a quarter.
    NOISE_ORDER: usize = 8, "windows", REASON;
    /// Length of a left-out block.
    BLOCK_S: f64 = 1.25, "s", AXIS_BENCH;
    /// Fewest blocks of a recording.
    FEWEST_BLOCKS: usize = 8, "blocks", AXIS_BENCH;
    /// Most blocks of a recording.
    MOST_BLOCKS: usize = 24, "blocks", AXIS_BENCH;
    /// Windows between a left-out block and the others that belong to neither: the reach of a window plus that of the noise model.
    PURGE: usize = 8, "windows", REASON;
    /// A column counts as a new one if this share of its length is orthogonal to the earlier ones.
    OWN_OF_COLUMN: f64 = 0.02, "share", AXIS_BENCH;
    /// A block with less than this share of the mean weight says nothing.
    LEAST_WEIGHT: f64 = 0.05, "share", AXIS_BENCH;
}
