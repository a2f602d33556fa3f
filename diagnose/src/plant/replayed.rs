//! This file is the content of a replay: the joint positions of a linkage over time, as recorded
//! and as two models simulate them.

/// Time after which a free run restarts from the recorded state, s.
pub const RESTART_S: f64 = 1.0;
/// Points E, D (the tip) and C, x and y of each, m; `None` without a pose.
pub type Frame = Option<[f64; 6]>;

/// The frames of a recording and of two models beside it.
#[derive(Clone, Debug, PartialEq)]
pub struct Replayed {
    /// Times of the frames, s.
    pub time_s: Vec<f64>,
    /// Base joint A, m.
    pub point_a_m: [f64; 2],
    /// Base joint B, m.
    pub point_b_m: [f64; 2],
    /// As recorded.
    pub recorded: Vec<Frame>,
    /// As the first model simulates it.
    pub before: Vec<Frame>,
    /// As the second model simulates it.
    pub after: Vec<Frame>,
}
