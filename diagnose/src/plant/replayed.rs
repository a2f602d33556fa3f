//! This file is what a replay shows: the places of a linkage's joints over time, as recorded and as two models move them.

/// How long the models run freely before they start from the recorded state again, s.
pub const RESTART_S: f64 = 1.0;
/// Points E, D (the tip) and C, x and y of each, m; nothing where there is no pose.
pub type Frame = Option<[f64; 6]>;

/// Frames of a recording and of two models beside it.
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
    /// As the first model moves it.
    pub before: Vec<Frame>,
    /// As the second model moves it.
    pub after: Vec<Frame>,
}
