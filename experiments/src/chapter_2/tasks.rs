//! This file says what a display is tried on: a corner without its help, a virtual wall, a line.

use rigproof_model::ModelError;
use rigproof_model::control::Side;
use rigproof_model::control::path::{Line, Path, Polyline};
use rigproof_model::trial::LINES;

/// One of the three tasks (decision 0240).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Task {
    /// The operator follows a corner and the display is to be felt as little as it can.
    Free,
    /// The operator runs into a virtual wall and pushes on.
    Wall,
    /// The operator follows a line and the display is to lead along it.
    Line,
}

/// All three.
pub const TASKS: [Task; 3] = [Task::Free, Task::Wall, Task::Line];

/// The corner: to the right, then away from the base, m.
const CORNER: [[f64; 2]; 3] = [[-0.09, 0.33], [0.03, 0.33], [0.03, 0.41]];
/// Distance of the wall from the base, m; it lies along x and is solid beyond.
const WALL_M: f64 = 0.37;
/// Where the operator comes from and aims at, m: 20° off the wall's normal, so that there is a way along the wall.
const APPROACH: [[f64; 2]; 2] = [[-0.05, 0.32], [-0.013_603, 0.42]];
/// Time at the wall, s.
const WALL_S: f64 = 2.5;
/// Depth at which a wall is given up, m.
const THROUGH_M: f64 = 0.06;
/// Longest time for a path, s: as in the trials of chapter 6.
const LONGEST_S: f64 = 20.0;

impl Task {
    /// In a word.
    pub const fn name(self) -> &'static str {
        match self {
            Task::Free => "free motion",
            Task::Wall => "virtual wall",
            Task::Line => "line",
        }
    }

    /// Where the tip starts, m.
    pub const fn start_m(self) -> [f64; 2] {
        match self {
            Task::Free => CORNER[0],
            Task::Wall => APPROACH[0],
            Task::Line => LINES[1].from_m,
        }
    }

    /// What the operator means to follow.
    pub fn path(self) -> Result<Box<dyn Path>, ModelError> {
        Ok(match self {
            Task::Free => Box::new(Polyline::open(&CORNER)?),
            Task::Wall => Box::new(Line::through(APPROACH[0], APPROACH[1])?),
            Task::Line => Box::new(Line::through(LINES[1].from_m, LINES[1].to_m)?),
        })
    }

    /// Whether the task is over with the tip at a point.
    pub fn is_over(self, [x_m, y_m]: [f64; 2]) -> bool {
        match self {
            Task::Free => y_m >= CORNER[2][1],
            Task::Wall => y_m >= WALL_M + THROUGH_M,
            Task::Line => {
                let [to_x, to_y] = LINES[1].to_m;
                let [from_x, from_y] = LINES[1].from_m;
                (x_m - to_x) * (to_x - from_x) + (y_m - to_y) * (to_y - from_y) >= 0.0
            }
        }
    }

    /// Longest time, s.
    pub const fn longest_s(self) -> f64 {
        match self {
            Task::Wall => WALL_S,
            Task::Free | Task::Line => LONGEST_S,
        }
    }

    /// The distances by which a run is judged, m: from the path, or inside the wall.
    pub fn off_m(self, tips_m: &[[f64; 2]]) -> Result<Vec<f64>, ModelError> {
        if self == Task::Wall {
            let depth = |[_, y_m]: &[f64; 2]| (y_m - WALL_M).max(0.0);
            return Ok(tips_m.iter().map(depth).collect());
        }
        let path = self.path()?;
        Ok(tips_m
            .iter()
            .map(|tip_m| path.nearest(*tip_m).distance_m())
            .collect())
    }
}

/// The wall: its boundary and its solid side.
pub fn wall() -> Result<(Line, Side), ModelError> {
    Ok((Line::through([-0.2, WALL_M], [0.2, WALL_M])?, Side::Left))
}
