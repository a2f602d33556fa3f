//! This file is the rules by which a plant lays its grids of shapes over its own motion. Grids that need no recording stand with the mechanism.

use super::{AXIS_BENCH, BOTH, DRIVEN, FIVE_BAR, REASON};

rules! {
    /// A ripple of a brake's torque by a whole number of periods a turn is tried where the travel shows this much of one: a rise or a fall, which no other law has.
    LEAST_OF_A_PERIOD: f64 = 0.5, "periods", REASON;
    /// A shape counts as at the edge of its range from this share of the upper end on.
    EDGE: f64 = 0.98, "share", AXIS_BENCH;
    /// Highest spatial frequency that is examined, in cycles over the travel.
    MOST_CYCLES: f64 = 200.0, "cycles", AXIS_BENCH;
    /// Lowest spatial frequency that is examined, in cycles over the travel.
    FEWEST_CYCLES: f64 = 2.0, "cycles", AXIS_BENCH;
    /// Spacing of these frequencies.
    SPACING: f64 = 0.35, "cycles", AXIS_BENCH;
    /// Peaks in the residual's spectrum over position that are tried.
    PEAKS: usize = 4, "peaks", AXIS_BENCH;
    /// Least distance between these peaks, and between two periods of a cause at one place.
    PEAKS_APART: f64 = 2.0, "cycles", AXIS_BENCH;
    /// Smallest Stribeck speed that is tried, in speeds below which the direction of motion is noise.
    SLOWEST_PEAK_FLOORS: f64 = 2.0, "floors", AXIS_BENCH;
    /// The same as a share of the greatest speed.
    SLOWEST_PEAK: f64 = 0.005, "share", AXIS_BENCH;
    /// Largest Stribeck speed that is tried, as a share of the greatest speed.
    FASTEST_PEAK: f64 = 0.3, "share", AXIS_BENCH;
    /// Stribeck speeds that are tried.
    PEAK_SPEEDS: usize = 8, "speeds", AXIS_BENCH;
    /// Axis and bench: exponents of the breakaway peak that are tried.
    PEAK_EXPONENTS_JOINT: [f64; 3] = [0.7, 1.0, 2.0], "1", DRIVEN;
    /// Five-bar: the same.
    PEAK_EXPONENTS_FIVE_BAR: [f64; 2] = [1.0, 2.0], "1", "as published: Tustin 1947, Bo and Pavelescu 1982";
    /// Five-bar: Stribeck speed, as a share of the greatest speed, up to which a peak is one: at the greatest speed a sixteenth of it is left.
    WIDEST_PEAK: f64 = 0.6, "share", FIVE_BAR;
    /// Five-bar: travels within which friction reaches the level that belongs to its speed, besides none.
    DELAYS_RAD: [f64; 3] = [0.004, 0.03, 0.2], "rad", "five-bar, seeds 1060 to 1109 (decision 0116)";
    /// Smallest presliding travel that can be seen, in standard deviations of the position noise.
    LEAST_BEND_SIGMAS: f64 = 3.0, "deviations", BOTH;
    /// The same as a share of the travel.
    LEAST_BEND: f64 = 1e-4, "share", BOTH;
    /// Greatest presliding travel that is tried, as a share of the whole travel.
    MOST_BEND: f64 = 0.2, "share", BOTH;
    /// Axis and bench: presliding travels that are tried.
    BENDS_JOINT: usize = 12, "travels", AXIS_BENCH;
    /// Five-bar: presliding travels that are tried.
    BENDS_FIVE_BAR: usize = 10, "travels", FIVE_BAR;
    /// Five-bar: greatest presliding travel, as a share of the whole: over the whole travel all but a twentieth of its level is reached.
    SOFTEST_BRISTLE: f64 = 0.33, "share", "five-bar, seeds below 10 000 (decision 0155)";
    /// Axis and bench: least and greatest rate of a hysteresis in the displacement, in inverse travels.
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
    /// A brake whose current never reached this share of its greatest one has no current limit to find.
    LEAST_LIMITED: f64 = 0.05, "share", FIVE_BAR;
    /// A brake: lowest and highest current limit that is tried, as shares of the greatest current.
    LIMIT_SHARES: [f64; 2] = [0.3, 0.97], "share", FIVE_BAR;
    /// A brake: sharp limits of the current that are tried; on every plant limits to which a command bends.
    LIMITS: usize = 8, "currents", FIVE_BAR;
    /// Axis: lowest and highest limit of the drive's effort that is tried, as shares of the greatest that was commanded: a loop that winds up commands many times what it gets.
    EFFORT_LIMIT_SHARES: [f64; 2] = [0.02, 0.97], "share", DRIVEN;
    /// The same of limits to which the effort bends: it feels them before it reaches them.
    ROUND_LIMIT_SHARES: [f64; 2] = [0.1, 2.0], "share", REASON;
    /// How sharply an effort or a current bends towards its limit: about as an arctangent does, and more sharply than a hyperbolic tangent.
    SHARPNESSES: [f64; 2] = [1.5, 3.0], "1", REASON;
    /// Axis: longest and shortest time in which a drive of limited rate reaches the greatest effort: beyond them it answers never or at once.
    RISE_TIMES_S: [f64; 2] = [3.0, 0.005], "s", REASON;
    /// Whole numbers of periods in a turn, up to this, are tried whatever the spectrum says.
    MOST_A_TURN: u32 = 36, "periods", DRIVEN;
    /// Axis and bench: exponents of the presliding curve.
    BRISTLE_EXPONENTS: [f64; 3] = [0.5, 1.5, 2.5], "1", DRIVEN;
    /// Axis: exponents of a friction by a power of the load, of rolling balls (Hertz) and of the gears of servos (Duclusaud et al. 2024).
    LOAD_EXPONENTS: [f64; 2] = [4.0 / 3.0, 2.0], "1", REASON;
    /// Five-bar: a change of an arm's length for which the columns are linear.
    SMALL_LENGTH_M: f64 = 0.0005, "m", REASON;
    /// Five-bar: the nearest anchor of a spring that is tried, from the middle of the tip's motion, as a share of its travel; the farthest is two arms away.
    NEAREST_ANCHOR: f64 = 0.15, "share", REASON;
    /// Five-bar: distances and directions of the anchors that are tried.
    ANCHORS: [usize; 2] = [6, 8], "anchors", REASON;
    /// Axis: limits of the drive's effort that are tried.
    EFFORT_LIMITS: usize = 24, "efforts", DRIVEN;
    /// Axis and bench: smallest backlash that can be seen, in standard deviations of the position noise.
    LEAST_GAP_SIGMAS: f64 = 6.0, "deviations", DRIVEN;
    /// The same as a share of the travel.
    LEAST_GAP: f64 = 1e-3, "share", DRIVEN;
    /// Greatest backlash that is tried, as a share of the travel.
    MOST_GAP: f64 = 0.1, "share", DRIVEN;
    /// Widths of a backlash that are tried.
    GAPS: usize = 12, "widths", DRIVEN;
    /// Axis: lowest resonance of a compliant drive that is tried.
    SLOWEST_RESONANCE: f64 = 30.0, "rad/s", DRIVEN;
    /// Axis: highest resonance that is tried, relative to the sampling rate.
    RESONANCE_STEPS: f64 = 1.0, "1/sample", "axis in other forms, seed 44001; reported on 45000 to 45059 (decision 0316)";
    /// Axis: bounds of that highest resonance.
    FASTEST_RESONANCE: [f64; 2] = [40.0, 300.0], "rad/s", DRIVEN;
    /// Axis: resonances that are tried.
    RESONANCES: usize = 12, "resonances", DRIVEN;
    /// Axis: damping ratios of a resonance that are tried.
    RESONANCE_DAMPINGS: [f64; 2] = [0.03, 0.12], "1", DRIVEN;
    /// Axis: of the widths of a backlash, the step to the next one that a compliance with play is tried with.
    GAPS_OF_A_SPRING: usize = 3, "widths", "axis in other forms, seeds 42045, 44032 and 44049; reported on 45000 to 45059 (decision 0316)";
    /// Positions of a stop that are tried, as shares of half the travel from its middle: closer where a stop touches seldom.
    STOP_SHARES: [f64; 9] = [0.0, 0.15, 0.3, 0.45, 0.6, 0.7, 0.8, 0.87, 0.93], "share", REASON;
    /// Shares of a brake's current that go through a play (hysteresis) that are tried.
    PLAYED_SHARES: [f64; 2] = [0.3, 0.7], "share", REASON;
    /// Five-bar: currents below which the two branches of a hysteresis meet: a small one, most of the range, and one beyond all that flows.
    CLOSING_A: [f64; 3] = [0.1, 0.4, 1.5], "A", "five-bar, seeds below 10 000 (decision 0151)";
    /// Five-bar: greatest error of an encoder's scale, as a share, and of its zero, as an angle: a larger one is noticed before anything is recorded.
    MOST_OF_AN_ENCODER: f64 = 0.1, "share, rad", "five-bar, seeds below 10 000 (decision 0150)";
}
