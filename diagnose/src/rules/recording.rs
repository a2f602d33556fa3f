//! This file is the rules by which a recording is taken or refused, and by which the sense of a motion is known.

use super::{AXIS_BENCH, DRIVEN, REASON};

rules! {
    /// A gap longer than this ends the diagnosis: the widest window would lie in it.
    LONGEST_GAP_S: f64 = 0.1, "s", REASON;
    /// On a slow clock a gap may be as long as this many samples.
    LONGEST_GAP_STEPS: f64 = 8.0, "samples", REASON;
    /// Share of samples that may be missing.
    MOST_MISSING: f64 = 0.02, "share", REASON;
    /// Time for which a live channel may repeat one value to the bit.
    LONGEST_FREEZE_S: f64 = 0.25, "s", REASON;
    /// A constant position is a fault if it ends in a jump greater than the usual steps around it by this factor.
    JUMP_TIMES: f64 = 6.0, "times", REASON;
    /// How far before and after a constant position its usual steps are looked for.
    JUMP_AROUND: usize = 400, "samples", REASON;
    /// A step of a position is a jump if it exceeds what its neighbours let expect by more than they differ, times this.
    STEP_TIMES: f64 = 6.0, "times", REASON;
    /// The same in counts: each end of a step is off by half a count, and so are its neighbours.
    JUMP_QUANTA: f64 = 5.0, "counts", REASON;
    /// The same in deviations of the noise of the position.
    JUMP_SIGMAS: f64 = 10.0, "deviations", REASON;
    /// The same as a share of the step: so much of a step a sample may be taken too late.
    LATE_SAMPLE: f64 = 0.1, "share", "by its reason; EMPS, whose greatest is 0.01";
    /// Steps over which the usual excess of a step is taken, with those before and after.
    BLOCK_STEPS: usize = 200, "samples", REASON;
    /// The share of steps that exceed less than the usual excess: more than that are not jumps.
    USUAL_QUANTILE: f64 = 0.9, "share", REASON;
    /// A position that wraps stays within its period: its range may exceed a jump by rounding only.
    WRAP_RANGE: f64 = 1.01, "times", REASON;
    /// How far a jump may be off a known period.
    WRAP_NEAR: f64 = 0.002, "share", REASON;
    /// Samples before and after a held one within which a position must have moved.
    MOVED_WITHIN: usize = 10, "samples", REASON;
    /// Steps before and after one that say how large it should be.
    STEPS_AROUND: usize = 3, "steps", REASON;
    /// What the start state is fitted on, over what the first parabola goes through.
    FITTED_TIMES: usize = 5, "times", REASON;
    /// The greatest share of an inertia that can hang behind a spring: with all of it nothing is left to drive.
    MOST_TRAILING: f64 = 0.99, "share", REASON;
    /// Samples in a row that may be left out as a dropout.
    LONGEST_DROPOUT: usize = 5, "samples", REASON;
    /// By how much the step that catches up may differ from all that a repeated sample missed.
    CATCH_UP: f64 = 0.35, "share", REASON;
    /// Steps of more counts are no flicker: a sensor that moves so fast repeats no sample.
    HELD_QUANTA: f64 = 3.0, "counts", REASON;
    /// Fewer large steps do not say how often a sensor is refreshed.
    FEWEST_REFRESHED: usize = 30, "steps", REASON;
    /// Share of the large steps that follow a repeated sample from which on a sensor is refreshed more slowly than it is written.
    REFRESHED: f64 = 0.5, "share", REASON;
    /// Share of samples that a channel may repeat by chance if its repetitions are to tell anything.
    MOST_REPEATED_BY_CHANCE: f64 = 0.01, "share", REASON;
    /// Steps in a row that are the same to the last digit by no chance.
    LEAST_STRAIGHT: usize = 8, "samples", REASON;
    /// Share of a motion that may lie on straight lines if these are to be something that was filled in.
    MOST_STRAIGHT: f64 = 0.3, "share", REASON;
    /// Samples at one extreme that may be chance.
    MOST_CLIPPED: usize = 20, "samples", REASON;
    /// Share of the samples at one extreme that may be chance.
    MOST_CLIPPED_SHARE: f64 = 0.005, "share", REASON;
    /// An effort that comes to its extreme by more than this share of its range within one sample jumps there; what is clipped runs into it.
    JUMP_SHARE: f64 = 0.2, "share", REASON;
    /// Share of the ways to the extreme that are jumps from which on the effort was commanded in steps.
    STEPPED: f64 = 0.8, "share", REASON;
    /// Equal samples in a row that are a level of a command in steps.
    LEVEL_SAMPLES: usize = 5, "samples", REASON;
    /// Share of the stated limit from which on an extreme is that limit.
    AT_LIMIT: f64 = 0.999, "share", REASON;
    /// Share of the work to and fro by which a resistance may give more than it takes: a bench whose sign is right always takes.
    MOST_GIVEN: f64 = 0.2, "share", REASON;
    /// Share of the work to and fro by which the hand may take more out of the five-bar than it puts in: kinetic energy, and where the recording ends.
    MOST_TAKEN: f64 = 0.2, "share", REASON;
    /// Outside of this a current is none that the brakes were measured at.
    CURRENTS_A: core::ops::RangeInclusive<f64> = -0.01..=1.5, "A", REASON;
    /// A sample interval longer than this leaves fewer than four samples to the widest window.
    LONGEST_STEP_S: f64 = 0.04, "s", REASON;
    /// Share of a sample interval by which those of two recordings may differ.
    SAME_STEP: f64 = 1e-6, "share", REASON;
    /// From how many recordings on the last is held out whole. The second of two may be the experiment that the first one asked for: it is needed for the naming, and its end is enough to show the result.
    MANY_RECORDINGS: usize = 3, "recordings", "by its reason (decision 0143)";
    /// Share at the end of a recording that is held out where nothing else is said.
    HOLD_OUT_SHARE: f64 = 0.25, "share", REASON;
    /// Axis and bench: a travel of fewer deviations of the noise of the position is no excitation.
    LEAST_TRAVEL_SIGMAS_JOINT: f64 = 20.0, "deviations", REASON;
    /// Five-bar: the same. There is none: its windows say whether enough has moved.
    LEAST_TRAVEL_SIGMAS_FIVE_BAR: f64 = 0.0, "deviations", REASON;
    /// How close the smallest step must be to the stated one in another unit to be that.
    NEAR_UNIT: f64 = 0.005, "share", REASON;
    /// A scatter of so many times the stated noise is that of thousandths of the unit.
    THOUSANDFOLD: core::ops::RangeInclusive<f64> = 500.0..=2000.0, "times", REASON;
    /// The most that a sensor's noise is of what it measures: what scatters more is a signal.
    MOST_SCATTER: f64 = 0.1, "share", REASON;
    /// What a gain that is a unit leaves of what the nominal model leaves: with the right unit the model is right.
    UNIT_LEFT: f64 = 0.25, "share", REASON;
    /// A nominal friction that is below zero by so many half widths of its 95 % interval drives the plant.
    DRAG_HALVES: f64 = 3.0, "half widths", REASON;
    /// An unknown inertia that comes out so many times as large, or as small, as the value to start from is another unit.
    ANOTHER_INERTIA: f64 = 20.0, "times", REASON;
    /// A plant under a constant command that turns back so often is driven by something else.
    MOST_TURNS: usize = 3, "reversals", REASON;
    /// The speed of a free motion dies away: in its second half it is below this share of that in the first.
    DIES_AWAY: f64 = 0.7, "share", REASON;
    /// A free motion dies away: it never travels farther in a twentieth of the recording than in one before, times this.
    GROWS: f64 = 3.0, "times", "axis with faults, blind seed 20004 (decision 0193)";
    /// A twentieth counts there from this share of the greatest way on.
    LEAST_WAY: f64 = 0.2, "share", REASON;
    /// A residual below this share of the predicted noise says that noise or resolution are stated too great.
    FAR_BELOW_FLOOR: f64 = 0.3, "share", REASON;
    /// A gain that is wrong by more than this factor is no physics: a unit is.
    ANOTHER_UNIT: f64 = 5.0, "times", REASON;
    /// What another reading of the channels must leave of the unexplained effort to be believed. With the right sign, turning a component adds twice its effort.
    READING_LEFT: f64 = 0.5, "share", "five-bar, channels taken for others (decision 0141)";
    /// Share of the effort that must stay unexplained before brakes are asked whether they got each other's current.
    READING_ODD: f64 = 0.2, "share", "five-bar, channels taken for others (decision 0141)";
    /// How far a stamp may lie off the steps counted from the first one where the median is the step.
    EVEN: f64 = 1e-3, "steps", REASON;
    /// Axis and bench: noise of the speed that is not noticed beside its root mean square.
    QUIET_SPEED: f64 = 0.005, "share", DRIVEN;
    /// Axis and bench: noise of the speed up to which the low-pass ends where the effort's band asks, as a share of the speed.
    LOUD_SPEED: f64 = 0.05, "share", DRIVEN;
    /// Axis and bench: the lowest end of the low-pass.
    LEAST_CUTOFF_HZ: f64 = 25.0, "Hz", DRIVEN;
    /// Half the stretch of time over which a joint must have moved for its sense to be known.
    REST_S: f64 = 0.025, "s", AXIS_BENCH;
    /// Travel within which a joint at rest seems to move, in counts.
    STILL_QUANTA: f64 = 2.0, "counts", REASON;
    /// The same in deviations of the noise of the position.
    STILL_SIGMAS: f64 = 6.0, "deviations", REASON;
    /// Travel within which the shaft of a bench that turns back may also stand, in deviations of its noise: two counts.
    STILL_NOISES: f64 = 7.0, "deviations", REASON;
    /// Deviations of the noise of the smoothed speed below which its sign is noise.
    SENSE_SIGMAS: f64 = 4.0, "deviations", AXIS_BENCH;
    /// Half the stretch of time over which the bend of a smoothed position counts.
    BEND_S: f64 = 0.02, "s", "bench and five-bar, brakes that change as foreseen (decision 0153)";
    /// Share of the rates of θA and θB by which the rate of E or C is in doubt: an encoder's zero a few hundredths of a radian off, or an arm's length a few per cent, makes a held joint seem to creep.
    KINEMATIC_DOUBT: f64 = 0.05, "share", "five-bar, seeds below 10 000 (decision 0116)";
    /// Half the stretch of time over which a slow joint must have moved for its sense to be known while brakes are switched.
    STOP_S: f64 = 0.003, "s", "five-bar, golden cases and seeds 8300 to 8339 (decision 0153)";
    /// How long before and after a current has changed its brake counts as switched.
    SWITCHED_S: f64 = 0.025, "s", "five-bar, golden cases and seeds 8300 to 8339 (decision 0153)";
    /// Change of a current within that time that may stop a joint or let it go.
    SWITCHED_A: f64 = 0.02, "A", "five-bar, golden cases and seeds 8300 to 8339 (decision 0153)";
    /// Change of the current between two samples with which a trial of a brake begins.
    TRIAL_JUMP_A: f64 = 0.05, "A", REASON;
    /// Fewest trials that tell a spread of their gains.
    FEWEST_TRIALS: usize = 8, "trials", REASON;
    /// Fewest usable windows for each of these trials.
    WINDOWS_A_TRIAL: usize = 4, "windows", REASON;
    /// Share of what is left that a gain for every trial must take away for the gains to differ.
    TRIALS_SHARE: f64 = 0.7, "share", REASON;
}
