//! This file is the rules by which the equation of motion is averaged over windows, and windows are put into blocks.

use super::{AXIS_BENCH, BOTH, DRIVEN, FIVE_BAR, REASON};

rules! {
    /// Order of the bump (1 − x²)⁴: three continuous derivatives at its ends.
    BUMP_ORDER: i32 = 4, "1", REASON;
    /// Widths of windows that are tried; the last is taken where no narrower one is quiet enough.
    WIDTHS_S: [f64; 3] = [0.040, 0.080, 0.160], "s", BOTH;
    /// Axis: a width is quiet enough when the floor is below this share of the effort.
    QUIET: f64 = 0.003, "share", AXIS_BENCH;
    /// Axis: a fast effort narrows the window where the floor is below this share of the effort: one that is fed back from the position is as fast as its noise.
    MOST_NOISE: f64 = 0.05, "share", DRIVEN;
    /// Five-bar: a width is quiet enough when the floor is below this: contributions of 0.01 N·m are to be seen in a few windows.
    QUIET_NM: f64 = 0.0075, "N·m", FIVE_BAR;
    /// Axis: the narrowest window.
    LEAST_STEPS_AXIS: f64 = 8.0, "samples", AXIS_BENCH;
    /// Bench: the narrowest window.
    LEAST_STEPS_BENCH: f64 = 5.0, "samples", AXIS_BENCH;
    /// A window is no wider than this many periods of the highest frequency of the effort.
    PERIODS_A_WIDTH: f64 = 2.0, "periods", AXIS_BENCH;
    /// Share of the power of an effort that lies within its band.
    BAND_SHARE: f64 = 0.95, "share", REASON;
    /// Share of a window's weight that may lie where the sense of motion cannot be told.
    MOST_AMBIGUOUS: f64 = 0.002, "share", AXIS_BENCH;
    /// What a friction as large as the whole effort (axis, bench) or what the brakes (five-bar) may do where the sense of motion cannot be told.
    MOST_UNTOLD: f64 = 0.5, "floors", BOTH;
    /// Averaged change of a predicted effort from sample to sample up to which a window is used.
    MOST_STEP: f64 = 0.5, "floors", AXIS_BENCH;
    /// What a predicted effort may be mistaken by on average in a window that is used.
    MOST_DOUBT: f64 = 0.5, "floors", "bench, brakes that change as foreseen (decision 0153)";
    /// Fewest windows from which anything can be said.
    FEWEST_WINDOWS: usize = 40, "windows", AXIS_BENCH;
    /// Order of the autoregression of the noise: two window widths at a hop of a quarter.
    NOISE_ORDER: usize = 8, "windows", REASON;
    /// Length of one block that is left out.
    BLOCK_S: f64 = 1.25, "s", AXIS_BENCH;
    /// Fewest blocks of a recording.
    FEWEST_BLOCKS: usize = 8, "blocks", AXIS_BENCH;
    /// Most blocks of a recording.
    MOST_BLOCKS: usize = 24, "blocks", AXIS_BENCH;
    /// Windows between blocks that belong to neither: the reach of a window plus that of the noise model.
    PURGE: usize = 8, "windows", REASON;
    /// Share of a column's length that must stand out of the earlier columns for it to count as its own.
    OWN_OF_COLUMN: f64 = 0.02, "share", AXIS_BENCH;
    /// Share of the mean weight below which a block says nothing.
    LEAST_WEIGHT: f64 = 0.05, "share", AXIS_BENCH;
}
