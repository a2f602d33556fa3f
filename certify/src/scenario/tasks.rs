//! This file draws paths, and where the tip stands at the start.

use core::f64::consts::PI;

use rigproof_impl::path::Path as _;
use rigproof_impl::vector::Vector;
use rigproof_model::linkage::{inverse, singularity};
use rigproof_spec::geometry::arms;
use rigproof_spec::layout::Layout;

use super::Draw;
use crate::controller::Task;
use crate::trial::LEAST_SINE;
use crate::way::{Way, ends_m};

/// The box in which the points of paths lie, m: around the two lines of decision 0047.
const FROM_M: [f64; 2] = [-0.13, 0.28];
const TO_M: [f64; 2] = [0.13, 0.46];

fn point(draw: &mut Draw) -> [f64; 2] {
    let ([x_0, y_0], [x_1, y_1]) = (FROM_M, TO_M);
    [draw.between(x_0, x_1), draw.between(y_0, y_1)]
}

/// Points of which each is at least 3 cm from the one before.
fn points(draw: &mut Draw, count: u32) -> Vec<[f64; 2]> {
    let mut points: Vec<[f64; 2]> = Vec::new();
    while points.len() < count as usize {
        let next = point(draw);
        let apart = points
            .last()
            .is_none_or(|[x, y]| libm::hypot(next[0] - x, next[1] - y) > 0.03);
        if apart {
            points.push(next);
        }
    }
    points
}

/// A path: a line (every fourth through the origin or along an axis), an arc, a chain or a spline.
pub fn task(draw: &mut Draw) -> Task {
    match draw.below(16) {
        0..4 => Task::Chain(points(draw, 2)),
        4..6 => Task::Chain(special(draw)),
        6..10 => arc(draw),
        10..13 => {
            let count = 3 + draw.below(4);
            Task::Chain(points(draw, count))
        }
        _ => {
            let count = 3 + draw.below(4);
            Task::Spline(points(draw, count))
        }
    }
}

/// A line through the origin, along x or along y.
fn special(draw: &mut Draw) -> Vec<[f64; 2]> {
    let [x, y] = point(draw);
    let ends = match draw.below(4) {
        0 => [[0.0, 0.29], [0.0, 0.45]],
        1 => [[x, 0.29], [x, 0.45]],
        2 => [[-0.12, y], [0.12, y]],
        _ => [[x, y], [x * 1.3, y * 1.3]],
    };
    let [from, to] = ends;
    if draw.one_in(2) {
        vec![from, to]
    } else {
        vec![to, from]
    }
}

fn arc(draw: &mut Draw) -> Task {
    let from_rad = draw.between(-PI, PI);
    Task::Arc {
        centre_m: point(draw),
        radius_m: draw.between(0.02, 0.09),
        from_rad,
        to_rad: from_rad + draw.sign() * draw.between(0.7, 5.2),
    }
}

/// Base angles, rad, of a start on or beside the path's beginning; `None` where the path or the start leaves the workspace.
pub fn start(draw: &mut Draw, layout: Layout, task: &Task) -> Option<[f64; 2]> {
    let way = Way::new(task)?;
    let [first, _] = ends_m(task)?;
    let off = if draw.one_in(3) {
        Vector::zero()
    } else {
        Vector::new(draw.between(-0.04, 0.04), draw.between(-0.04, 0.04))
    };
    let points: &[[f64; 2]] = match task {
        Task::Chain(points) | Task::Spline(points) => points,
        Task::Arc { .. } => &[],
    };
    for point in points {
        base_rad(layout, *point)?;
    }
    if let Task::Arc {
        centre_m: [x, y],
        radius_m,
        ..
    } = task
    {
        for [across, along] in [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]] {
            base_rad(layout, [x + across * radius_m, y + along * radius_m])?;
        }
    }
    let start = Vector::from(first) + off;
    way.path.nearest(start).is_defined().then_some(())?;
    base_rad(layout, [start.x, start.y])
}

/// θA and θB, rad, of a tip, away from every singularity.
fn base_rad(layout: Layout, tip_m: [f64; 2]) -> Option<[f64; 2]> {
    let pose = inverse::pose(&arms(layout), tip_m).ok()?;
    let away = singularity::Pair::ALL
        .into_iter()
        .all(|pair| singularity::measure(&pose, pair) >= LEAST_SINE);
    away.then_some([pose.theta_a_rad, pose.theta_b_rad])
}
