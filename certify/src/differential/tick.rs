//! This file is all that both implementations of a law are told in one sample: the rig, the path, the law, and what was sensed.

use rigproof_spec::geometry::{Arms, arms};
use rigproof_spec::layout::Layout;
use rigproof_spec::methods::greatest_desired_force_n;

use crate::built_in::{BuiltIn, Kind};
use crate::controller::Task;
use crate::declared::Solid;

/// Everything that both implementations are told in one sample.
#[derive(Clone, Debug)]
pub struct Tick {
    /// The layout.
    pub layout: Layout,
    /// The arms.
    pub arms: Arms,
    /// The greatest force at the tip, N.
    pub limit_n: f64,
    /// θA and θB, rad.
    pub base_rad: [f64; 2],
    /// Velocity of the tip, x and y, m/s.
    pub velocity_m_s: [f64; 2],
    /// Force of the hand on the tip, x and y, N.
    pub force_n: [f64; 2],
    /// The path.
    pub path: PathKind,
    /// Boundary of the velocity field (§6.1.1), m.
    pub boundary_m: f64,
    /// The law.
    pub law: Kind,
    /// On which side of the path an obstacle lies, if at all.
    pub obstacle: Option<Solid>,
}

/// A path of any kind that the reference has; a campaign's tasks are those that are open.
#[derive(Clone, Debug)]
pub enum PathKind {
    /// From one point to another, m.
    Line([[f64; 2]; 2]),
    /// Centre, m; radius, m, first angle and sweep, rad.
    Arc([f64; 2], [f64; 3]),
    /// Corners, m, and whether the last is joined to the first.
    Polyline(Vec<[f64; 2]>, bool),
    /// Points, m.
    Spline(Vec<[f64; 2]>),
}

impl From<&Task> for PathKind {
    fn from(task: &Task) -> PathKind {
        match task {
            Task::Chain(points) => match points.as_slice() {
                [from_m, to_m] => PathKind::Line([*from_m, *to_m]),
                points => PathKind::Polyline(points.to_vec(), false),
            },
            Task::Arc {
                centre_m,
                radius_m,
                from_rad,
                to_rad,
            } => PathKind::Arc(*centre_m, [*radius_m, *from_rad, to_rad - from_rad]),
            Task::Spline(points) => PathKind::Spline(points.clone()),
        }
    }
}

impl Tick {
    /// A law of the thesis's rig at a task, nothing sensed yet.
    pub fn of(law: &BuiltIn, layout: Layout, task: &Task) -> Tick {
        Tick {
            layout,
            arms: arms(layout),
            limit_n: greatest_desired_force_n(layout),
            base_rad: [f64::NAN; 2],
            velocity_m_s: [f64::NAN; 2],
            force_n: [f64::NAN; 2],
            path: PathKind::from(task),
            boundary_m: law.boundary_m,
            law: law.law,
            obstacle: law.obstacle,
        }
    }
}
