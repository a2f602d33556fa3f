//! This file is what the figures of chapter 4 share: a workspace that is traversed, shaded, outlined and bounded.

use rigproof_model::ModelError;
use rigproof_model::linkage::device::Device;
use rigproof_model::linkage::workspace::{Boundary, Figures, Grid, Map};
use rigproof_model::linkage::{point_a_m, point_b_m};
use rigproof_spec::geometry::Arms;
use rigproof_spec::joint::Joint;
use rigproof_spec::layout::Layout;
use rigproof_spec::units::RAD_PER_DEG;

use crate::table::Column;
use crate::{Curve, Error, Field, Table};

/// Ends of the bands in which the greatest angle between adjacent paths is shaded, degrees.
const BOUNDS_DEG: [f64; 8] = [45.0, 60.0, 75.0, 90.0, 105.0, 120.0, 150.0, 180.0];

/// What a layout is called.
pub const fn name(layout: Layout) -> &'static str {
    match layout {
        Layout::ThreeBrake => "3-brake",
        Layout::FourBrake => "4-brake",
    }
}

/// A tip with the tip force of each brake, 1/m.
pub struct Spot {
    /// The tip, m.
    pub tip_m: [f64; 2],
    /// The forces, in the order of the brakes.
    pub forces: Vec<[f64; 2]>,
}

/// The middles of a grid's cells that lie in the workspace.
pub fn spots(device: &Device, step_m: f64) -> Result<Vec<Spot>, Error> {
    let grid = Grid::over(device, step_m).map_err(|e| Error::model("the workspace", e))?;
    let cells = (0..grid.rows).flat_map(|row| (0..grid.columns).map(move |column| (column, row)));
    let tips = cells.map(|(column, row)| grid.middle_m(column, row));
    let spots = tips.filter_map(|tip_m| {
        let forces = device.tip_forces(tip_m).ok()?;
        Some(Spot { tip_m, forces })
    });
    Ok(spots.collect())
}

/// A map of a workspace as a field, degrees.
pub fn spread(map: &Map) -> Field {
    let degrees = |angle: &Option<f64>| angle.map_or(f64::NAN, deg);
    Field {
        step: map.grid.step_m,
        origin: map.grid.origin_m,
        columns: map.grid.columns.max(1),
        values: map.angles_rad.iter().map(degrees).collect(),
        bounds: BOUNDS_DEG.to_vec(),
        unit: "°".to_owned(),
    }
}

/// What ends a workspace, in words, and the angle's value there, degrees.
pub fn limit(error: &ModelError) -> (String, Option<f64>) {
    match error {
        ModelError::AngleRange {
            angle,
            value_deg,
            least_deg,
            greatest_deg,
        } => {
            let (end, at) = match value_deg < least_deg {
                true => ("least", least_deg),
                false => ("greatest", greatest_deg),
            };
            (format!("{end} angle at {}", angle.letter()), Some(*at))
        }
        ModelError::BaseArmsCrossed { .. } => ("AE and BC parallel".to_owned(), None),
        ModelError::Singular { pair, .. } => {
            let [first, second] = pair.arms();
            (format!("{first} and {second} parallel"), None)
        }
        ModelError::Unreachable { base, .. } => (format!("reach from {base}"), None),
        _ => ("edge".to_owned(), None),
    }
}

/// The figures of a map that is known to hold a workspace.
pub fn figures(map: &Map) -> Result<Figures, Error> {
    map.figures()
        .ok_or_else(|| Error::model("the workspace", "no cell of the grid lies in it"))
}

/// The share of a workspace in which adjacent paths are at most 90° apart, per cent.
pub fn well_spaced_percent(figures: &Figures) -> f64 {
    100.0 * figures.well_spaced_m2 / figures.area_m2
}

/// The middles of the cells of a map and the angle in each, as a table.
pub fn angle_table(map: &Map) -> Table {
    let columns = map.grid.columns.max(1);
    let inside: Vec<([f64; 2], f64)> = map
        .angles_rad
        .iter()
        .enumerate()
        .filter_map(|(index, angle)| {
            let tip_m = map.grid.middle_m(index % columns, index / columns);
            Some((tip_m, deg((*angle)?)))
        })
        .collect();
    let column = |name: &str, unit: &str, of: fn(&([f64; 2], f64)) -> f64| {
        Column::numbers(name, unit, &inside.iter().map(of).collect::<Vec<f64>>())
    };
    Table::new(
        "greatest-angle",
        vec![
            column("x", "m", |([x, _], _)| *x),
            column("y", "m", |([_, y], _)| *y),
            column("greatest_angle", "°", |(_, angle)| *angle),
        ],
    )
}

/// The base joints as dots, on one another where they share an axis.
pub fn base(arms: &Arms) -> Curve {
    let ([a_x, a_y], [b_x, b_y]) = (point_a_m(arms), point_b_m(arms));
    Curve::dots("base joints A, B", &[a_x, b_x], &[a_y, b_y])
}

/// Fewest points of a loop that is drawn: a grid leaves specks where a workspace tapers off.
const FEWEST_POINTS: usize = 25;

/// The loops of a boundary that are more than specks.
pub fn loops(boundary: &Boundary) -> impl Iterator<Item = &Vec<([f64; 2], ModelError)>> {
    let loops = boundary.loops.iter();
    loops.filter(|points| points.len() >= FEWEST_POINTS)
}

/// The loops of a boundary as one interrupted line.
pub fn outline(name: &str, boundary: &Boundary) -> Curve {
    let (mut x, mut y) = (Vec::new(), Vec::new());
    for points in loops(boundary) {
        for ([point_x, point_y], _) in points.iter().chain(points.first()) {
            x.push(*point_x);
            y.push(*point_y);
        }
        x.push(f64::NAN);
        y.push(f64::NAN);
    }
    Curve::line(name, &x, &y)
}

/// What the path of a locked brake is called.
pub fn locked(joint: Joint) -> String {
    format!("{} locked", joint.letter())
}

/// An angle in degrees.
pub fn deg(angle_rad: f64) -> f64 {
    angle_rad / RAD_PER_DEG
}

/// The angle between two directions without sense, rad, from 0 to π/2.
pub fn between_rad(first: f64, second: f64) -> f64 {
    let sine = libm::sin(first - second).abs();
    let cosine = libm::cos(first - second).abs();
    libm::atan2(sine, cosine)
}
