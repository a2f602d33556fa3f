//! This file traverses the workspace of a device point by point, as §4.3 did, and says how large and how good it is.

mod boundary;
mod extremes;

use core::f64::consts::FRAC_PI_2;

pub use boundary::{Boundary, boundary};
pub use extremes::attained_ranges;

use super::device::Device;
use super::paths;
use crate::error::ModelError;

/// A grid of square cells over the box that a workspace lies in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    /// Side of a cell, m.
    pub step_m: f64,
    /// The lower left corner of the first cell, m.
    pub origin_m: [f64; 2],
    /// Cells along x.
    pub columns: usize,
    /// Cells along y.
    pub rows: usize,
}

/// Most cells along the longer side of the box.
const MOST_CELLS: f64 = 4000.0;
/// Fewest cells along the longer side of the box.
const FEWEST_CELLS: f64 = 10.0;

impl Grid {
    /// The grid over a device's box.
    ///
    /// # Errors
    /// [`ModelError::Step`]: fewer than 10 or more than 4000 cells along the longer side; [`ModelError::ArmLength`];
    /// [`ModelError::AngleRangeCrossed`].
    pub fn over(device: &Device, step_m: f64) -> Result<Grid, ModelError> {
        if let Device::Linkage { arms, ranges, .. } = device {
            super::check_arms(arms)?;
            super::limits::check_ranges(ranges)?;
        }
        let [[left, low], [right, high]] = device.box_m();
        let longer_m = (right - left).max(high - low);
        let (least_m, greatest_m) = (longer_m / MOST_CELLS, longer_m / FEWEST_CELLS);
        if !(least_m..=greatest_m).contains(&step_m) {
            return Err(ModelError::Step {
                step_m,
                least_m,
                greatest_m,
            });
        }
        let cells = |length_m: f64| (length_m.max(0.0) / step_m).ceil() as usize;
        Ok(Grid {
            step_m,
            origin_m: [left, low],
            columns: cells(right - left),
            rows: cells(high - low),
        })
    }

    /// The middle of a cell, m.
    pub fn middle_m(&self, column: usize, row: usize) -> [f64; 2] {
        let [x, y] = self.corner_m(column, row);
        [x + 0.5 * self.step_m, y + 0.5 * self.step_m]
    }

    /// The lower left corner of a cell, m.
    pub fn corner_m(&self, column: usize, row: usize) -> [f64; 2] {
        let [x, y] = self.origin_m;
        [
            x + column as f64 * self.step_m,
            y + row as f64 * self.step_m,
        ]
    }
}

/// The greatest angle between adjacent local paths in the middle of every cell of a workspace.
#[derive(Clone, Debug, PartialEq)]
pub struct Map {
    /// The cells.
    pub grid: Grid,
    /// The angle in each cell, row by row from below, rad; `None` outside the workspace.
    pub angles_rad: Vec<Option<f64>>,
}

/// Traverses the workspace of a device (§4.3).
///
/// # Errors
/// Those of [`Grid::over`].
pub fn map(device: &Device, step_m: f64) -> Result<Map, ModelError> {
    let grid = Grid::over(device, step_m)?;
    let angle = |(row, column): (usize, usize)| {
        let tip_forces = device.tip_forces(grid.middle_m(column, row)).ok()?;
        Some(paths::greatest_angle_rad(&tip_forces))
    };
    let cells = (0..grid.rows).flat_map(|row| (0..grid.columns).map(move |column| (row, column)));
    Ok(Map {
        grid,
        angles_rad: cells.map(angle).collect(),
    })
}

/// How large a workspace is and how evenly its paths are spread.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Figures {
    /// Area, m².
    pub area_m2: f64,
    /// Area in which the greatest angle between adjacent paths is at most 90°, m².
    pub well_spaced_m2: f64,
    /// Share of the rectangle around the workspace that it fills.
    pub fill: f64,
    /// Least of the angles, rad.
    pub least_rad: f64,
    /// Mean of the angles over the area, rad.
    pub mean_rad: f64,
    /// Greatest of the angles, rad.
    pub greatest_rad: f64,
}

impl Map {
    /// The figures of a map; `None` if no cell is in the workspace.
    pub fn figures(&self) -> Option<Figures> {
        let inside: Vec<f64> = self.angles_rad.iter().copied().flatten().collect();
        let count = inside.len() as f64;
        let cell_m2 = self.grid.step_m * self.grid.step_m;
        let well_spaced = inside.iter().filter(|angle| **angle <= FRAC_PI_2).count();
        Some(Figures {
            area_m2: count * cell_m2,
            well_spaced_m2: well_spaced as f64 * cell_m2,
            fill: count / self.cells_around()?,
            least_rad: inside.iter().copied().reduce(f64::min)?,
            mean_rad: inside.iter().sum::<f64>() / count,
            greatest_rad: inside.iter().copied().reduce(f64::max)?,
        })
    }

    /// Cells of the rectangle around the workspace.
    fn cells_around(&self) -> Option<f64> {
        let columns = self.grid.columns.max(1);
        let cells = self.angles_rad.iter().enumerate();
        let inside = cells.filter(|(_, angle)| angle.is_some());
        let places = inside.map(|(index, _)| (index % columns, index / columns));
        let (mut left, mut right, mut low, mut high) = (usize::MAX, 0, usize::MAX, 0);
        for (column, row) in places {
            (left, right) = (left.min(column), right.max(column));
            (low, high) = (low.min(row), high.max(row));
        }
        let width = (right + 1).checked_sub(left)?;
        let height = (high + 1).checked_sub(low)?;
        Some(width as f64 * height as f64)
    }
}
