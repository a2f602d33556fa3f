//! This file is the rules by which the next experiment is chosen and refused.

use super::REASON;

rules! {
    /// The most explanations that an experiment is to separate.
    MOST_EXPLANATIONS: usize = 8, "explanations", REASON;
    /// How many experiments are simulated for every explanation.
    FINALISTS: usize = 2, "experiments", REASON;
    /// How long an experiment takes.
    DURATION_S: f64 = 12.0, "s", REASON;
    /// The greatest current that is asked for.
    STRONGEST_A: f64 = 0.6, "A", REASON;
    /// Centre of the hand's motion, x and y: the middle of what both layouts reach.
    MIDDLE_M: [f64; 2] = [0.02, 0.40], "m", REASON;
    /// The stiffness with which a hand leads the tip.
    STIFFNESS_N_M: f64 = 420.0, "N/m", REASON;
    /// The damping of a hand.
    DAMPING_NS_M: f64 = 11.0, "N·s/m", REASON;
    /// Distance that an angle keeps from the ends of its range (table 4.2): another hand, or a rig that differs from the model, goes further.
    LEAST_ROOM_DEG: f64 = 8.0, "degrees", "five-bar, forced strata of seeds 9000 to 9300 (decision 0155)";
    /// Every so many samples that distance is checked.
    ROOM_EVERY: usize = 10, "samples", REASON;
    /// Share of a step by which a time stamp of an experiment may be off.
    JITTER: f64 = 0.01, "share", REASON;
}
