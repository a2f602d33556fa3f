//! This file is the rules by which a recording is taken or refused, and by which the sense of a motion is known.

use super::{AXIS_BENCH, DRIVEN, REASON};

rules! {
    /// A gap longer than this ends the diagnosis: the widest window would lie in it.
    LONGEST_GAP_S: f64 = 0.1, "s", REASON;
    /// On a slow clock a gap may be as long as this many samples.
    LONGEST_GAP_STEPS: f64 = 8.0, "samples", REASON;
    /// Share of samples that may be missing.
    MOST_MISSING: f64 = 0.02, "share", REASON;
    /// Rows of a static sweep are of about one speed within this share of the greatest.
    SPEEDS_ALIKE: f64 = 0.05, "share", REASON;
    /// Time for which a working channel may repeat one value to the bit.
    LONGEST_FREEZE_S: f64 = 0.25, "s", REASON;
    /// A constant position is a fault if it ends in a jump of more than this many of the usual steps around it.
    JUMP_TIMES: f64 = 6.0, "times", REASON;
    /// Samples before and after a constant position from which its usual steps are taken.
    JUMP_AROUND: usize = 400, "samples", REASON;
    /// A step of a position is a jump if it differs from what its neighbours predict by more than this many times the spread of the neighbours.
    STEP_TIMES: f64 = 6.0, "times", REASON;
    /// The same limit in counts: both ends of a step, and of its neighbours, are off by up to half a count.
    JUMP_QUANTA: f64 = 5.0, "counts", REASON;
    /// The same limit in standard deviations of the position noise.
    JUMP_SIGMAS: f64 = 10.0, "deviations", REASON;
    /// The same limit as a share of the step: a sample may be taken late by this share of the interval.
    LATE_SAMPLE: f64 = 0.1, "share", "by its reason; EMPS, whose greatest is 0.01";
    /// Steps over which the usual difference from that prediction is taken, with as many before and after.
    BLOCK_STEPS: usize = 200, "samples", REASON;
    /// Quantile of these differences that counts as usual: jumps are rarer.
    USUAL_QUANTILE: f64 = 0.9, "share", REASON;
    /// A wrapped position stays within its period: its range may exceed the jump by this factor, for rounding.
    WRAP_RANGE: f64 = 1.01, "times", REASON;
    /// Relative difference up to which a jump counts as a known period.
    WRAP_NEAR: f64 = 0.002, "share", REASON;
    /// Samples before and after a held one within which a position must have moved.
    MOVED_WITHIN: usize = 10, "samples", REASON;
    /// Steps before and after a step that predict its size.
    STEPS_AROUND: usize = 3, "steps", REASON;
    /// Stretch on which the start state of a free run is fitted, in lengths of the first parabola.
    FITTED_TIMES: usize = 5, "times", REASON;
    /// Greatest share of an inertia that can sit behind a spring: with all of it behind the spring nothing would be driven.
    MOST_TRAILING: f64 = 0.99, "share", REASON;
    /// Samples in a row that may be left out as a dropout.
    LONGEST_DROPOUT: usize = 5, "samples", REASON;
    /// After repeated samples: relative difference allowed between the step that catches up and the motion that was missed.
    CATCH_UP: f64 = 0.35, "share", REASON;
    /// Above this many counts a step is no flicker: a sensor that moves so fast repeats no sample.
    HELD_QUANTA: f64 = 3.0, "counts", REASON;
    /// Fewest large steps from which the refresh rate of a sensor is estimated.
    FEWEST_REFRESHED: usize = 30, "steps", REASON;
    /// A sensor is refreshed more slowly than it is written if this share of its large steps follow a repeated sample.
    REFRESHED: f64 = 0.5, "share", REASON;
    /// Share of samples that a channel may repeat by chance for its repetitions to be evidence.
    MOST_REPEATED_BY_CHANCE: f64 = 0.01, "share", REASON;
    /// Equal steps in a row, to the last digit, that are not chance.
    LEAST_STRAIGHT: usize = 8, "samples", REASON;
    /// Share of a motion that may lie on straight lines for these to count as filled in.
    MOST_STRAIGHT: f64 = 0.3, "share", REASON;
    /// Samples at one extreme that may be chance.
    MOST_CLIPPED: usize = 20, "samples", REASON;
    /// Share of the samples at one extreme that may be chance.
    MOST_CLIPPED_SHARE: f64 = 0.005, "share", REASON;
    /// An effort that reaches its extreme by more than this share of its range in one sample jumps there; a clipped effort runs into its limit.
    JUMP_SHARE: f64 = 0.2, "share", REASON;
    /// An effort was commanded in steps if this share of its ways to the extreme are jumps.
    STEPPED: f64 = 0.8, "share", REASON;
    /// Equal samples in a row that are one level of a stepped command.
    LEVEL_SAMPLES: usize = 5, "samples", REASON;
    /// Share of the stated limit above which an extreme is that limit.
    AT_LIMIT: f64 = 0.999, "share", REASON;
    /// Share of the total work to and fro by which a bench's resistance may give more than it takes: with the right sign a resistance takes work.
    MOST_GIVEN: f64 = 0.2, "share", REASON;
    /// Share of the total work to and fro that the hand may take out of the five-bar beyond what it put in: kinetic energy, and where the recording ends.
    MOST_TAKEN: f64 = 0.2, "share", REASON;
    /// Range of currents that the brakes were measured at.
    CURRENTS_A: core::ops::RangeInclusive<f64> = -0.01..=1.5, "A", REASON;
    /// A sample interval longer than this leaves fewer than four samples to the widest window.
    LONGEST_STEP_S: f64 = 0.04, "s", REASON;
    /// Relative difference allowed between the sample intervals of two recordings.
    SAME_STEP: f64 = 1e-6, "share", REASON;
    /// From this many recordings on the last is held out whole. The second of two may be the experiment that the first asked for: it is needed to name, and its end is enough to show the result.
    MANY_RECORDINGS: usize = 3, "recordings", "by its reason (decision 0143)";
    /// Share at the end of a recording that is held out where nothing else is said.
    HOLD_OUT_SHARE: f64 = 0.25, "share", REASON;
    /// Axis and bench: a travel of less than this many standard deviations of the position noise is no excitation.
    LEAST_TRAVEL_SIGMAS_JOINT: f64 = 20.0, "deviations", REASON;
    /// Five-bar: the same. There is no such limit: the windows say whether enough has moved.
    LEAST_TRAVEL_SIGMAS_FIVE_BAR: f64 = 0.0, "deviations", REASON;
    /// Relative difference up to which the smallest step is the stated one in another unit.
    NEAR_UNIT: f64 = 0.005, "share", REASON;
    /// A scatter of this many times the stated noise means samples in thousandths of the unit.
    THOUSANDFOLD: core::ops::RangeInclusive<f64> = 500.0..=2000.0, "times", REASON;
    /// An arm: how far a motor goes, in travels of its link. A gear takes up less than it passes; a gear ratio that was forgotten, or a wrong sign, is far outside.
    MOTOR_FOLLOWS: core::ops::RangeInclusive<f64> = 0.5..=2.0, "times", REASON;
    /// The most that a sensor's noise is of what it measures: what scatters more is a signal.
    MOST_SCATTER: f64 = 0.1, "share", REASON;
    /// A gain is taken for a wrong unit, and laws stand against a gain for every trial, if they leave at most this share of the nominal model's residual; a round of search that leaves at most this share of its noise is followed by another.
    EXPLAINED_LEFT: f64 = 0.25, "share", REASON;
    /// A nominal friction is negative, and so drives the plant, if it is below zero by this many half widths of its 95 % interval.
    DRAG_HALVES: f64 = 3.0, "half widths", REASON;
    /// An unknown inertia that is this many times as large, or as small, as its start value has another unit.
    ANOTHER_INERTIA: f64 = 20.0, "times", REASON;
    /// A plant under a constant command that reverses this often or more is driven by something else.
    MOST_TURNS: usize = 3, "reversals", REASON;
    /// A free motion dies away if its speed in the second half is below this share of that in the first.
    DIES_AWAY: f64 = 0.7, "share", REASON;
    /// A free motion dies away if in no twentieth of the recording it travels this many times as far as in an earlier one.
    GROWS: f64 = 3.0, "times", "axis with faults, blind seed 20004 (decision 0193)";
    /// Such a twentieth counts if its travel is at least this share of the greatest.
    LEAST_WAY: f64 = 0.2, "share", REASON;
    /// A residual below this share of the predicted noise says that the stated noise or resolution is too great.
    FAR_BELOW_FLOOR: f64 = 0.3, "share", REASON;
    /// A gain that is wrong by more than this factor is a wrong unit and no physics.
    ANOTHER_UNIT: f64 = 5.0, "times", REASON;
    /// Another assignment of the channels is believed if it leaves at most this share of the unexplained effort. With the right sign, turning a component around adds twice its effort.
    READING_LEFT: f64 = 0.5, "share", "five-bar, channels taken for others (decision 0141)";
    /// Share of the effort that must be unexplained before it is tested whether brakes have each other's current.
    READING_ODD: f64 = 0.2, "share", "five-bar, channels taken for others (decision 0141)";
    /// Greatest distance of a time stamp from the even grid of the median step, up to which that median is the step.
    EVEN: f64 = 1e-3, "steps", REASON;
    /// Axis and bench: noise of the speed, as a share of its root mean square, that is negligible.
    QUIET_SPEED: f64 = 0.005, "share", DRIVEN;
    /// Axis and bench: noise of the speed, as a share of the speed, up to which the low-pass keeps the band of the effort.
    LOUD_SPEED: f64 = 0.05, "share", DRIVEN;
    /// Axis and bench: lowest cut-off of the low-pass.
    LEAST_CUTOFF_HZ: f64 = 25.0, "Hz", DRIVEN;
    /// Half the span of time over which a joint must have moved for its direction to be known.
    REST_S: f64 = 0.025, "s", AXIS_BENCH;
    /// Travel, in counts, that a joint at rest may seem to make.
    STILL_QUANTA: f64 = 2.0, "counts", REASON;
    /// The same in standard deviations of the position noise.
    STILL_SIGMAS: f64 = 6.0, "deviations", REASON;
    /// Travel, in standard deviations of its noise, within which the shaft of a bench that reverses may be at rest: two counts.
    STILL_NOISES: f64 = 7.0, "deviations", REASON;
    /// Below this many standard deviations of its noise the sign of the smoothed speed is noise.
    SENSE_SIGMAS: f64 = 4.0, "deviations", AXIS_BENCH;
    /// Half the span of time over which the curvature of a smoothed position is taken.
    BEND_S: f64 = 0.02, "s", "bench and five-bar, brakes that change as foreseen (decision 0153)";
    /// Uncertainty of the rate of E or C, as a share of the rates of θA and θB: an encoder's zero that is off by some hundredths of a radian, or an arm's length by some per cent, makes a held joint seem to creep.
    KINEMATIC_DOUBT: f64 = 0.05, "share", "five-bar, seeds below 10 000 (decision 0116)";
    /// Half the span of time over which a slow joint must have moved for its direction to be known while brakes switch.
    STOP_S: f64 = 0.003, "s", "five-bar, golden cases and seeds 8300 to 8339 (decision 0153)";
    /// Time before and after a change of current in which the brake counts as switching.
    SWITCHED_S: f64 = 0.025, "s", "five-bar, golden cases and seeds 8300 to 8339 (decision 0153)";
    /// Change of current within that time that may stop a joint or release it.
    SWITCHED_A: f64 = 0.02, "A", "five-bar, golden cases and seeds 8300 to 8339 (decision 0153)";
    /// A trial of a brake begins with a change of current of at least this share of the greatest one between two samples.
    TRIAL_JUMP: f64 = 0.05, "share", REASON;
    /// Fewest trials from which a spread of their gains is estimated.
    FEWEST_TRIALS: usize = 8, "trials", REASON;
    /// Fewest usable windows in each of these trials.
    WINDOWS_A_TRIAL: usize = 4, "windows", REASON;
    /// Share of the residual that one gain for each trial must remove for the gains to differ.
    TRIALS_SHARE: f64 = 0.7, "share", REASON;
}
