//! This file is the rules by which sets of mechanisms are weighed against one another as explanations of a recording.

use super::{DRIVEN, LINKAGE, REASON};

rules! {
    /// Axis and bench: effects below this share of the effort do not matter: no model and no discretisation is that exact.
    RELEVANT_JOINT: f64 = 0.003, "share", DRIVEN;
    /// Five-bar: the same share. It is smaller because the hand's effort is many times the torque of brakes without current.
    RELEVANT_FIVE_BAR: f64 = 0.001, "share", LINKAGE;
    /// The same limit as a share of the residual that sensor noise alone leaves: smaller effects cannot be told from errors of the noise model.
    RELEVANT_NOISE: f64 = 0.7, "share", DRIVEN;
    /// Autocorrelations of the residual below this count as zero.
    LEAST_CORRELATION: f64 = 0.05, "1", REASON;
    /// Rows for each independent sample, times the integrated autocorrelation of the residual. It is above one because that autocorrelation is an estimate itself.
    ROWS_A_SAMPLE: f64 = 2.5, "rows", DRIVEN;
    /// Fewest repetitions of a periodic motion from which its period is detected.
    FEWEST_REPEATS: usize = 3, "times", REASON;
    /// What every parameter beyond a mechanism's first costs an explanation, in natural logarithms of odds.
    A_NUMBER: f64 = 2.4, "ln odds", DRIVEN;
    /// Prior odds of a mechanism, in natural logarithms, from those that models leave out most often to the rarest. Each mechanism says which of these it has.
    USUAL_ODDS: [f64; 6] = [-3.2, -4.0, -4.8, -5.6, -6.4, -8.0], "ln odds", DRIVEN;
    /// Two explanations count as one if their odds differ by no more than this, which is rounding between places that move alike, and between causes that no motion tells apart.
    AS_ONE: f64 = 0.01, "ln odds", REASON;
    /// The least weight of an explanation that is listed.
    LISTED: f64 = 1e-4, "share", DRIVEN;
    /// Probability from which on a mechanism is named.
    NAMED: f64 = 0.9, "probability", REASON;
    /// Probability from which on a mechanism is suspected.
    SUSPECTED: f64 = 0.5, "probability", REASON;
    /// A periodic law whose period is known to no better than this share of itself, half its 95 % interval, is withdrawn: a part of one period is a spring or a friction as well.
    PERIOD_KNOWN: f64 = 0.2, "share", "one joint, seeds 2700 to 3099 in other forms: true periods are known to 0.035 or better, two false ones to 0.28 and 0.7";
    /// A friction whose effort keeps less than this share of its variance beside a function of the position is suspected at most: on such a motion it is a spring or a ripple as well.
    LEAST_BESIDE_POSITION: f64 = 0.15, "share", "one sine: 0.07 and 0.08 (surgical drive); varied motions: 0.31 (EMPS) and 0.67 to 0.95 (one joint in other forms, ten seeds of 2759 to 3189)";
    /// Bins of the position whose means are that function.
    POSITION_BINS: usize = 20, "bins", REASON;
    /// Least weight of an alternative that is printed beside a name.
    OFFERED: f64 = 0.03, "probability", REASON;
    /// The most explanations that are listed.
    MOST_LISTED: usize = 8, "explanations", REASON;
    /// Rounds in which each term of the leading explanations is exchanged for every other.
    EXCHANGES: usize = 2, "rounds", DRIVEN;
    /// Leading explanations whose terms are tried with an onset, beside all explanations of one term.
    LATE: usize = 2, "explanations", REASON;
    /// The most terms of one explanation that every search tries. More join as long as one more makes the most probable explanation more probable.
    MOST_TERMS: usize = 3, "terms", DRIVEN;
    /// An arm: the most terms of its explanation.
    MOST_OF_MANY: usize = 48, "terms", REASON;
    /// An arm: random walks over sets of terms, which find those that are weighed.
    WALKS: usize = 4, "walks", REASON;
    /// An arm: steps of each walk.
    WALK_STEPS: usize = 1500, "steps", REASON;
    /// An arm: all inertial parameters of a link cost as much as this many parameters: one description gets them wrong together, and that is rarer than a single wrong mass.
    A_LINK: usize = 3, "numbers", "thirty concealed arms, seeds 0 to 29";
    /// An arm: standard deviation of a described inertial number about the true one, as a share of the link's mass, of mass times radius of gyration, or of mass times its square: a ridge towards the description, since a motion that leaves numbers of links open would give them any size.
    DESCRIBED_WITHIN: f64 = 0.3, "share", "public Panda recording, held-out half (0.1 to 0.4 name the same); reported on concealed arms and arms in MuJoCo (decision 0297)";
    /// An arm: greatest share of a described friction that may be removed again. It is above one because a fit has an error.
    GIVEN_BACK: f64 = 1.2, "share", REASON;
    /// An arm: width of a window. A test function of this width passes half of the amplitude at 8 Hz, like the forward and backward low-pass behind which arms are usually fitted.
    ARM_WIDTH_S: f64 = 0.155, "s", REASON;
    /// An arm: the band of a motion, in periods within the width of a window. Positions are smoothed at twice that, so that what the smoothing spreads around a reversal does not reach windows beside it.
    ARM_PERIODS: f64 = 4.0, "periods", "three arms in MuJoCo with described friction and nothing hidden, seeds 108 to 110";
    /// Explanations of each size from which the search goes on (beam search).
    BEAM: usize = 6, "explanations", DRIVEN;
    /// Explanations of each size that are kept and weighed.
    KEPT: usize = 40, "explanations", DRIVEN;
    /// Energy of the effort that acts, over that of the recorded one, above which a gain is impossible: ten times the effort is a wrong unit, which is a fault of the data.
    MOST_ACTING: f64 = 100.0, "1", REASON;
    /// Strides of the pattern search for a shape, as shares of a shape parameter.
    STRIDES: [f64; 4] = [0.15, 0.06, 0.025, 0.01], "share", DRIVEN;
    /// Strides to both sides of a shape parameter that was found; it is put at the top of the parabola through them. The second is for forces that are hundreds of times the noise.
    TOP_STRIDES: [f64; 2] = [0.01, 0.001], "share", REASON;
    /// Most moves of one parameter at one stride.
    MOST_MOVES: usize = 4, "moves", DRIVEN;
    /// Fewest usable rows with which a block counts.
    FEWEST_ROWS: usize = 5, "rows", REASON;
}
