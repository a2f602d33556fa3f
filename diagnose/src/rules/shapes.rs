//! This file is the rules by which a plant lays its grids of shapes over its own motion. Grids that need no recording stand with the mechanism.

use super::{AXIS_BENCH, BOTH, DRIVEN, FIVE_BAR, REASON};

rules! {
    /// Share of the upper end of a range from which a shape counts as being at its edge.
    EDGE: f64 = 0.98, "share", AXIS_BENCH;
    /// Highest spatial frequency looked at, over the travel.
    MOST_CYCLES: f64 = 200.0, "cycles", AXIS_BENCH;
    /// Lowest spatial frequency looked at, over the travel.
    FEWEST_CYCLES: f64 = 2.0, "cycles", AXIS_BENCH;
    /// Spacing of these frequencies.
    SPACING: f64 = 0.35, "cycles", AXIS_BENCH;
    /// Peaks of the residual's spectrum over position that are tried.
    PEAKS: usize = 4, "peaks", AXIS_BENCH;
    /// How far apart they are at least.
    PEAKS_APART: f64 = 2.0, "cycles", AXIS_BENCH;
    /// Speed of the narrowest peak near standstill, in speeds below which the sign is noise.
    SLOWEST_PEAK_FLOORS: f64 = 2.0, "floors", AXIS_BENCH;
    /// The same as a share of the fastest speed.
    SLOWEST_PEAK: f64 = 0.005, "share", AXIS_BENCH;
    /// Speed of the widest peak that is tried, as a share of the fastest speed.
    FASTEST_PEAK: f64 = 0.3, "share", AXIS_BENCH;
    /// Speeds of a peak that are tried.
    PEAK_SPEEDS: usize = 8, "speeds", AXIS_BENCH;
    /// Axis and bench: exponents of a peak that are tried.
    PEAK_EXPONENTS_JOINT: [f64; 3] = [0.7, 1.0, 2.0], "1", DRIVEN;
    /// Five-bar: the same.
    PEAK_EXPONENTS_FIVE_BAR: [f64; 2] = [1.0, 2.0], "1", "as published: Tustin 1947, Bo and Pavelescu 1982";
    /// Five-bar: share of the fastest speed up to which a peak near standstill is one: at the fastest a sixteenth of it is left.
    WIDEST_PEAK: f64 = 0.6, "share", FIVE_BAR;
    /// Five-bar: travels within which friction comes to the level of its speed.
    DELAYS_RAD: [f64; 4] = [0.001, 0.01, 0.05, 0.2], "rad", "five-bar, seeds 1060 to 1109 (decision 0116)";
    /// Least travel over which a bristle is seen to bend, in deviations of the noise of the position.
    LEAST_BEND_SIGMAS: f64 = 3.0, "deviations", BOTH;
    /// The same as a share of the travel.
    LEAST_BEND: f64 = 1e-4, "share", BOTH;
    /// Greatest travel over which a bristle bends that is tried, as a share of the whole.
    MOST_BEND: f64 = 0.2, "share", BOTH;
    /// Axis and bench: travels that are tried.
    BENDS_JOINT: usize = 12, "travels", AXIS_BENCH;
    /// Five-bar: travels that are tried.
    BENDS_FIVE_BAR: usize = 10, "travels", FIVE_BAR;
    /// Five-bar: share of the travel over which a bristle may bend: over the whole of it all but a twentieth of its level is reached.
    SOFTEST_BRISTLE: f64 = 0.33, "share", "five-bar, seeds below 10 000 (decision 0155)";
    /// Axis and bench: least and greatest rate of a memory of the displacement, over the inverse of the travel.
    MEMORY_RATES: [f64; 2] = [0.2, 40.0], "1/travel", AXIS_BENCH;
    /// Rates that are tried.
    MEMORY_COUNT: usize = 8, "rates", AXIS_BENCH;
    /// Ratios of the two rates that are tried.
    MEMORY_RATIOS: [f64; 4] = [-1.4, -0.5, 0.5, 1.4], "1", AXIS_BENCH;
    /// Least time constant of a lag that is tried.
    LEAST_LAG_STEPS: f64 = 0.5, "samples", BOTH;
    /// Axis and bench: greatest time constant of a lag that is tried.
    MOST_LAG_S_JOINT: f64 = 0.1, "s", DRIVEN;
    /// Five-bar: the same.
    MOST_LAG_S_FIVE_BAR: f64 = 0.25, "s", BOTH;
    /// Axis and bench: time constants that are tried.
    LAGS_JOINT: usize = 12, "times", DRIVEN;
    /// Five-bar: time constants that are tried.
    LAGS_FIVE_BAR: usize = 12, "times", FIVE_BAR;
    /// Axis and bench: shifts in time that are tried, each with both signs.
    SHIFTS_JOINT: usize = 12, "times", AXIS_BENCH;
    /// Five-bar: the same.
    SHIFTS_FIVE_BAR: usize = 10, "times", FIVE_BAR;
    /// Axis and bench: the least shift.
    LEAST_SHIFT_STEPS_JOINT: f64 = 0.5, "samples", AXIS_BENCH;
    /// Five-bar: the least shift.
    LEAST_SHIFT_STEPS_FIVE_BAR: f64 = 0.25, "samples", FIVE_BAR;
    /// Axis and bench: the greatest shift.
    MOST_SHIFT_S_JOINT: f64 = 0.08, "s", AXIS_BENCH;
    /// Five-bar: the greatest shift.
    MOST_SHIFT_S_FIVE_BAR: f64 = 0.04, "s", FIVE_BAR;
    /// On a slow clock the greatest shift is as long as this many samples.
    MOST_SHIFT_STEPS: f64 = 4.0, "samples", BOTH;
    /// A brake: the greatest delay; the least is one sample.
    MOST_DELAY_S: f64 = 0.08, "s", FIVE_BAR;
    /// A brake: delays that are tried.
    DELAYS: usize = 8, "times", FIVE_BAR;
    /// A brake that was never given more has no limit to find.
    LEAST_LIMITED_A: f64 = 0.05, "A", FIVE_BAR;
    /// A brake: the lowest and the highest limit of its current, over the greatest that was given.
    LIMIT_SHARES: [f64; 2] = [0.3, 0.97], "share", FIVE_BAR;
    /// A brake: limits that are tried.
    LIMITS: usize = 8, "currents", FIVE_BAR;
    /// Axis: the lowest and the highest limit of a drive's effort, over the greatest that was asked for: a loop that winds up asks for many times what it gets.
    EFFORT_LIMIT_SHARES: [f64; 2] = [0.02, 0.97], "share", DRIVEN;
    /// Most periods in one turn that are tried whatever the spectrum says: what repeats with a turn has whole numbers.
    MOST_A_TURN: u32 = 36, "periods", DRIVEN;
    /// Axis and bench: exponents of the curve on which a bristle bends.
    BRISTLE_EXPONENTS: [f64; 3] = [0.5, 1.5, 2.5], "1", DRIVEN;
    /// Five-bar: a change of an arm's length that is small beside it.
    SMALL_LENGTH_M: f64 = 0.0005, "m", REASON;
    /// Five-bar: how far beyond where the tip moved a spring may be anchored, over its travel.
    ANCHOR_REACH: f64 = 0.7, "share", REASON;
    /// Five-bar: anchors that are tried along each axis.
    ANCHORS: usize = 5, "anchors", REASON;
    /// Axis: limits of the drive's effort that are tried.
    EFFORT_LIMITS: usize = 24, "efforts", DRIVEN;
    /// Axis and bench: least width of a gap that is seen to be crossed, in deviations of the noise of the position.
    LEAST_GAP_SIGMAS: f64 = 6.0, "deviations", DRIVEN;
    /// The same as a share of the travel.
    LEAST_GAP: f64 = 1e-3, "share", DRIVEN;
    /// Greatest width of a gap that is tried, as a share of the travel.
    MOST_GAP: f64 = 0.1, "share", DRIVEN;
    /// Widths of a gap that are tried.
    GAPS: usize = 12, "widths", DRIVEN;
    /// Axis: the lowest resonance of what bends.
    SLOWEST_RESONANCE: f64 = 30.0, "rad/s", DRIVEN;
    /// Axis: the highest resonance, over the inverse of a sample interval.
    RESONANCE_STEPS: f64 = 0.3, "1/sample", DRIVEN;
    /// Axis: least and greatest that the highest resonance may be.
    FASTEST_RESONANCE: [f64; 2] = [40.0, 300.0], "rad/s", DRIVEN;
    /// Axis: resonances that are tried.
    RESONANCES: usize = 12, "resonances", DRIVEN;
    /// Axis: damping ratios of a resonance that are tried.
    RESONANCE_DAMPINGS: [f64; 2] = [0.03, 0.12], "1", DRIVEN;
    /// Shares of a brake's current that go through a play that are tried.
    PLAYED_SHARES: [f64; 2] = [0.3, 0.7], "share", REASON;
    /// Five-bar: currents below which the sides of a play come together: a little, most of the range, and beyond all that flows.
    CLOSING_A: [f64; 3] = [0.1, 0.4, 1.5], "A", "five-bar, seeds below 10 000 (decision 0151)";
    /// Five-bar: an encoder's scale may be off by this share, its zero by this angle: what more it was is seen before anything is recorded.
    MOST_OF_AN_ENCODER: f64 = 0.1, "share, rad", "five-bar, seeds below 10 000 (decision 0150)";
}
