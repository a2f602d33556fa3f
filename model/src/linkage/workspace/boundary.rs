//! This file traces the boundary of a workspace and says which limit each piece of it is (figure 4.17).

use std::collections::BTreeMap;

use super::Grid;
use crate::error::ModelError;
use crate::linkage::device::Device;

/// The boundary of a workspace.
#[derive(Clone, Debug, PartialEq)]
pub struct Boundary {
    /// Closed loops, each with the workspace to its left: points on the boundary, m, and what ends the workspace there.
    pub loops: Vec<Vec<([f64; 2], ModelError)>>,
}

impl Boundary {
    /// The enclosed area, m².
    pub fn area_m2(&self) -> f64 {
        let doubled = self.loops.iter().map(|points| {
            let next = points.iter().cycle().skip(1);
            let cross = points
                .iter()
                .zip(next)
                .map(|(([x_1, y_1], _), ([x_2, y_2], _))| x_1 * y_2 - x_2 * y_1);
            cross.sum::<f64>()
        });
        doubled.sum::<f64>() / 2.0
    }

    /// Share of the upright rectangle around the boundary that it encloses; not a number without a boundary.
    ///
    /// Its points lie on the boundary, so that the rectangle is not tied to a grid as that of a map is.
    pub fn fill(&self) -> f64 {
        let points = || self.loops.iter().flatten().map(|(point, _)| *point);
        let width = |coordinate: fn([f64; 2]) -> f64| {
            let least = points().map(coordinate).fold(f64::INFINITY, f64::min);
            let greatest = points().map(coordinate).fold(f64::NEG_INFINITY, f64::max);
            greatest - least
        };
        self.area_m2() / (width(|[x, _]| x) * width(|[_, y]| y))
    }
}

/// How often the crossing of an edge is halved: a step of 1 m ends below 1e-12 m.
const HALVINGS: usize = 40;

/// An edge of the grid: its lower left corner, and whether it runs along y.
type Edge = (usize, usize, bool);

/// Traces the boundary of a workspace by marching squares over the corners of a grid; each point is halved onto the
/// boundary, so that the area's error is that of the chords between points.
///
/// # Errors
/// Those of [`Grid::over`].
pub fn boundary(device: &Device, step_m: f64) -> Result<Boundary, ModelError> {
    let mut grid = Grid::over(device, step_m)?;
    // A ring of cells around the box, so that every loop closes.
    let [x, y] = grid.origin_m;
    grid.origin_m = [x - step_m, y - step_m];
    grid.columns += 2;
    grid.rows += 2;
    let inside = |column: usize, row: usize| device.tip_forces(grid.corner_m(column, row)).is_ok();
    let corners: Vec<Vec<bool>> = (0..=grid.rows)
        .map(|row| {
            (0..=grid.columns)
                .map(|column| inside(column, row))
                .collect()
        })
        .collect();
    let mut next = BTreeMap::new();
    for (row, pair) in corners.windows(2).enumerate() {
        let [below, above] = pair else { continue };
        let columns = below.windows(2).zip(above.windows(2)).enumerate();
        for (column, (below, above)) in columns {
            if let ([a, b], [d, c]) = (below, above) {
                next.extend(segments([*a, *b, *c, *d], column, row));
            }
        }
    }
    let mut loops = Vec::new();
    while let Some((first, _)) = next.first_key_value() {
        let mut edge = *first;
        let mut points = Vec::new();
        while let Some(following) = next.remove(&edge) {
            points.extend(crossing(device, &grid, edge));
            edge = following;
        }
        loops.push(points);
    }
    Ok(Boundary { loops })
}

/// The pieces of the boundary through a cell, from edge to edge with the inside to the left; corners counter-clockwise
/// from the lower left. Of two opposite corners inside, each keeps its own piece.
fn segments(inside: [bool; 4], column: usize, row: usize) -> Vec<(Edge, Edge)> {
    let bottom = (column, row, false);
    let right = (column + 1, row, true);
    let top = (column, row + 1, false);
    let left = (column, row, true);
    match inside {
        [true, true, true, true] | [false, false, false, false] => vec![],
        [true, false, false, false] => vec![(bottom, left)],
        [false, true, false, false] => vec![(right, bottom)],
        [false, false, true, false] => vec![(top, right)],
        [false, false, false, true] => vec![(left, top)],
        [true, true, false, false] => vec![(right, left)],
        [false, true, true, false] => vec![(top, bottom)],
        [false, false, true, true] => vec![(left, right)],
        [true, false, false, true] => vec![(bottom, top)],
        [false, true, true, true] => vec![(left, bottom)],
        [true, false, true, true] => vec![(bottom, right)],
        [true, true, false, true] => vec![(right, top)],
        [true, true, true, false] => vec![(top, left)],
        [true, false, true, false] => vec![(bottom, left), (top, right)],
        [false, true, false, true] => vec![(right, bottom), (left, top)],
    }
}

/// Where the boundary crosses an edge, on the inner side of it, and what ends the workspace there.
fn crossing(
    device: &Device,
    grid: &Grid,
    (column, row, along_y): Edge,
) -> Option<([f64; 2], ModelError)> {
    let first = grid.corner_m(column, row);
    let second = match along_y {
        true => grid.corner_m(column, row + 1),
        false => grid.corner_m(column + 1, row),
    };
    let (mut within, mut beyond) = match device.tip_forces(first).is_ok() {
        true => (first, second),
        false => (second, first),
    };
    for _ in 0..HALVINGS {
        let [x_1, y_1] = within;
        let [x_2, y_2] = beyond;
        let middle = [0.5 * (x_1 + x_2), 0.5 * (y_1 + y_2)];
        match device.tip_forces(middle) {
            Ok(_) => within = middle,
            Err(_) => beyond = middle,
        }
    }
    Some((within, device.tip_forces(beyond).err()?))
}
