//! This file is the rules by which a brake's numbers are read off its recordings (`identify`).

use super::IDENTIFY;

rules! {
    /// Currents closer than this are one level.
    SAME_CURRENT_A: f64 = 0.03, "A", IDENTIFY;
    /// Speeds whose ratio is closer to one than this are one level.
    SAME_SPEED: f64 = 0.1, "share", IDENTIFY;
    /// Travel before and after a reversal below which it is not read.
    LEAST_TRAVEL_DEG: f64 = 3.0, "degrees", IDENTIFY;
    /// Samples at off-state torque that make a backlash: fewer may be the torquemeter's own passage through zero.
    LEAST_DWELL: usize = 3, "samples", IDENTIFY;
    /// Time that the torque needs to fall far enough to be seen: a backlash that is passed in less stays hidden.
    UNSEEN_S: f64 = 0.02, "s", IDENTIFY;
    /// The part of the returning torque that tells when it began: the speed, and with it the time constant, changes on.
    BEGINNING: [f64; 2] = [0.97, 0.5], "share", IDENTIFY;
    /// Share of the torque below which the brake counts as free.
    FREE_SHARE: f64 = 0.25, "share", IDENTIFY;
    /// Current over that of the break in the gain from which on a reversal is read.
    BEYOND_BREAK: f64 = 1.5, "times", IDENTIFY;
    /// Greatest distance from the mean of a stretch at which a current still belongs to it.
    LEAST_TOLERANCE_A: f64 = 0.02, "A", IDENTIFY;
    /// The same in standard deviations of its noise.
    TOLERANCE_SIGMAS: f64 = 6.0, "deviations", IDENTIFY;
    /// The shortest stretch that counts.
    SHORTEST_S: f64 = 0.1, "s", IDENTIFY;
    /// The fewest samples that are of use.
    LEAST_SAMPLES: usize = 100, "samples", IDENTIFY;
    /// Share of the moving samples in which the torque may drive the shaft, by noise or by what turns behind the meter.
    MOST_DRIVING: f64 = 0.4, "share", IDENTIFY;
    /// The torque of a plateau counts over its last part, when it has settled.
    SETTLED_SHARE: f64 = 0.4, "share", IDENTIFY;
    /// Time that must have passed before the torque counts as settled.
    SETTLING: f64 = 4.0, "time constants", IDENTIFY;
    /// Greatest distance of a position from the straight line of constant speed, of the plateau's travel.
    LINE_SHARE: f64 = 0.02, "share", IDENTIFY;
    /// Greatest difference between the speeds before and after a step.
    SPEED_SHARE: f64 = 0.05, "share", IDENTIFY;
    /// The longest pause between two plateaus of a step.
    LONGEST_EDGE_S: f64 = 0.02, "s", IDENTIFY;
    /// The smallest step of current that is read.
    LEAST_STEP_A: f64 = 0.1, "A", IDENTIFY;
    /// Share of the threshold speed from which on a time constant counts as a fast one.
    FAST_SHARE: f64 = 0.95, "share", IDENTIFY;
}
