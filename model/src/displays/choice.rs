//! This file says which of a display's local paths keeps the tip out of a wall, and when a wall lets go.

use nalgebra::Vector2;

use super::Now;
use crate::control::Side;
use crate::control::path::{Line, Path};

/// How a tip lies to a wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// Depth inside the wall, m; negative outside.
    pub depth_m: f64,
    /// The direction into the wall, of length one.
    pub inward: Vector2<f64>,
    /// The direction of its boundary.
    pub along: Vector2<f64>,
}

impl Contact {
    /// What drives the tip deeper while it is inside the wall: the hand's force, or the motion that it came with; `None` where the wall
    /// lets go.
    ///
    /// "When the tip position crosses the obstacle boundary, the controller simply actuates the corresponding clutch"; it lets go
    /// for a "force away from the obstacle" (§2.2.2), once the tip does not go deeper any more.
    pub fn pressed(&self, now: &Now<'_>) -> Option<Vector2<f64>> {
        let deeper = [now.tip_force_n, now.tip_velocity_m_s].map(Vector2::from);
        let into = |way: &Vector2<f64>| way.dot(&self.inward) > 0.0;
        deeper.into_iter().find(into).filter(|_| self.depth_m > 0.0)
    }
}

/// How a point, m, lies to the wall on a side of a line.
pub fn contact(boundary: &Line, solid: Side, point_m: [f64; 2]) -> Contact {
    let nearest = boundary.nearest(point_m);
    let left = Vector2::new(-nearest.tangent.y, nearest.tangent.x);
    let (depth_m, inward) = match solid {
        Side::Left => (nearest.offset_m, left),
        Side::Right => (-nearest.offset_m, -left),
    };
    Contact {
        depth_m,
        inward,
        along: nearest.tangent,
    }
}

/// The direction in which a push moves a tip that one locked row leaves a single path, of length one.
///
/// `row` is the tip force of the row; its local path is at right angles to it (§4.3). `None` without a path.
pub fn path_of(row: Vector2<f64>, push: Vector2<f64>) -> Option<Vector2<f64>> {
    let length = libm::hypot(row.x, row.y);
    if length == 0.0 {
        return None;
    }
    let path = Vector2::new(-row.y, row.x) / length;
    Some(if path.dot(&push) < 0.0 { -path } else { path })
}

/// Which of several rows to lock so that a push moves the tip no deeper: the one whose path runs best along the wall.
pub fn guiding(rows: &[Vector2<f64>], contact: &Contact, push: Vector2<f64>) -> Option<usize> {
    let along = |path: Vector2<f64>| path.dot(&contact.along).abs();
    let paths = rows.iter().enumerate();
    let outward = paths.filter_map(|(index, row)| {
        let path = path_of(*row, push)?;
        (path.dot(&contact.inward) <= 0.0).then_some((index, along(path)))
    });
    let best = outward.fold(None, |best: Option<(usize, f64)>, one| match best {
        Some(best) if best.1 >= one.1 => Some(best),
        _ => Some(one),
    });
    best.map(|(index, _)| index)
}
