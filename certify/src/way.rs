//! This file turns a task into a path: to be followed by a hand, kept to by a law, and measured against.

mod remembered;

use rigproof_impl::path::{AnyPath, Arc, Line, Path as _, Polyline, Spline};
use rigproof_impl::vector::Vector;
use rigproof_model::control::path::{Nearest, Path};

use crate::controller::Task;

pub use remembered::Remembered;

/// Most pieces of a chain or a spline.
pub const MOST_PIECES: usize = 8;

/// The path of a task in the rig's own code.
#[derive(Clone, Debug)]
pub struct Way {
    /// The path.
    pub path: Remembered,
    end_m: Vector<f64>,
    end_tangent: Vector<f64>,
}

/// How far beside its end a path still counts as followed to the end, m.
const END_REACH_M: f64 = 0.06;

impl Way {
    /// The path of a task; `None` where its points are too many, too close or no numbers.
    pub fn new(task: &Task) -> Option<Way> {
        let path = match task {
            Task::Chain(points) => match points.as_slice() {
                [from_m, to_m] => AnyPath::Line(Line::through(*from_m, *to_m)?),
                points => AnyPath::Polyline(Polyline::open(points)?),
            },
            Task::Arc {
                centre_m,
                radius_m,
                from_rad,
                to_rad,
            } => AnyPath::Arc(Arc::new(
                *centre_m,
                *radius_m,
                *from_rad,
                to_rad - from_rad,
            )?),
            Task::Spline(points) => AnyPath::Spline(Spline::through(points)?),
        };
        let [_, end_m] = ends_m(task)?.map(Vector::from);
        let path = Remembered::new(path, task);
        let nearest = path.nearest(end_m);
        nearest.is_defined().then_some(Way {
            path,
            end_m,
            end_tangent: nearest.tangent,
        })
    }

    /// Whether a tip, m, has come to the end: past it, and not far beside it.
    pub fn has_ended(&self, tip_m: Vector<f64>) -> bool {
        let past = tip_m - self.end_m;
        past.dot(self.end_tangent) >= 0.0 && past.norm_squared() <= END_REACH_M * END_REACH_M
    }
}

/// Where a task begins and where it ends, m.
pub fn ends_m(task: &Task) -> Option<[[f64; 2]; 2]> {
    match task {
        Task::Chain(points) | Task::Spline(points) => {
            Some([points.first().copied()?, points.last().copied()?])
        }
        Task::Arc {
            centre_m: [x, y],
            radius_m,
            from_rad,
            to_rad,
        } => Some([*from_rad, *to_rad].map(|angle_rad| {
            let (sine, cosine) = libm::sincos(angle_rad);
            [x + radius_m * cosine, y + radius_m * sine]
        })),
    }
}

/// The same task, from its end to its start.
pub fn reversed(task: &Task) -> Task {
    let backwards = |points: &[[f64; 2]]| points.iter().rev().copied().collect();
    match task {
        Task::Chain(points) => Task::Chain(backwards(points)),
        Task::Spline(points) => Task::Spline(backwards(points)),
        Task::Arc {
            centre_m,
            radius_m,
            from_rad,
            to_rad,
        } => Task::Arc {
            centre_m: *centre_m,
            radius_m: *radius_m,
            from_rad: *to_rad,
            to_rad: *from_rad,
        },
    }
}

/// For the reference's metrics and simulated operator: what they know of a path.
impl Path for Way {
    fn nearest(&self, point_m: [f64; 2]) -> Nearest {
        let nearest = self.path.nearest(point_m.into());
        let foot = Vector::from(point_m) - nearest.tangent.left() * nearest.offset_m;
        Nearest {
            foot_m: [foot.x, foot.y].into(),
            tangent: [nearest.tangent.x, nearest.tangent.y].into(),
            offset_m: nearest.offset_m,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_reversed_task_runs_the_same_way_back() {
        let task = Task::Arc {
            centre_m: [0.013, 0.297],
            radius_m: 0.083,
            from_rad: 0.31,
            to_rad: 1.97,
        };
        let (there, back) = (
            Way::new(&task).unwrap(),
            Way::new(&reversed(&task)).unwrap(),
        );
        let point = Vector::new(0.061, 0.401);
        let (one, other) = (there.path.nearest(point), back.path.nearest(point));
        assert!((one.tangent + other.tangent).norm() < 1e-12);
        assert!((one.offset_m + other.offset_m).abs() < 1e-12);
        assert_eq!(reversed(&reversed(&task)), task);
    }

    #[test]
    fn a_path_has_ended_past_its_end_and_near_it_only() {
        let way = Way::new(&Task::Chain(vec![[-0.11, 0.38], [0.11, 0.38]])).unwrap();
        assert!(way.has_ended(Vector::new(0.113, 0.387)));
        assert!(!way.has_ended(Vector::new(0.107, 0.38)));
        assert!(!way.has_ended(Vector::new(0.113, 0.45)));
    }
}
