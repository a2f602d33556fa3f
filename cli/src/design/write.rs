//! This file writes what a design leaves behind: pictures, tables and the report.

use std::fmt::Write;

use rigproof_experiments::chapter_4::limit;
use rigproof_model::linkage::paths::directions_rad;
use rigproof_spec::joint::Joint;
use rigproof_trace::store::Folder;

use super::tables::{deg, json};
use super::{Design, Drawn};
use crate::outcome::Failure;
use crate::picture::linkage as picture;

/// A tip and the tip force of each of its brakes.
type Spot = ([f64; 2], Vec<[f64; 2]>);

/// Paths are drawn at this many places along the longer side.
const SPOTS: usize = 22;

/// Writes every file of the folder and gives their names.
///
/// # Errors
/// The system refuses.
pub fn files(folder: &Folder, design: &Design) -> Result<Vec<String>, Failure> {
    let mut contents = Vec::new();
    for drawn in &design.drawn {
        contents.extend(of_one(drawn));
    }
    let outlined: Vec<_> = design
        .drawn
        .iter()
        .filter(|drawn| drawn.shape.is_layout || design.drawn.len() == 1)
        .map(|drawn| (drawn.shape.name.as_str(), &drawn.boundary))
        .collect();
    let widest = design
        .drawn
        .iter()
        .max_by(|a, b| a.figures.area_m2.total_cmp(&b.figures.area_m2));
    contents.extend(widest.map(|drawn| {
        let page = picture::workspaces(&drawn.map, &outlined);
        ("workspaces.svg".to_owned(), page.to_string())
    }));
    contents.push(("concepts.csv".to_owned(), concepts(design)));
    if !design.ranked.is_empty() {
        contents.push(("sweep.csv".to_owned(), sweep(design)));
        contents.push((
            "sweep.svg".to_owned(),
            picture::sweep(&design.ranked).to_string(),
        ));
    }
    contents.push(("report.json".to_owned(), json(design).to_string() + "\n"));
    for (name, text) in &contents {
        folder.write(name, text.as_bytes())?;
    }
    Ok(contents.into_iter().map(|(name, _)| name).collect())
}

fn of_one(drawn: &Drawn) -> Vec<(String, String)> {
    let name = &drawn.shape.name;
    let title = |what: &str| format!("{what}, {name}");
    let spots = spots(drawn);
    let arms = &drawn.shape.arms;
    let (map, boundary, joints) = (&drawn.map, &drawn.boundary, drawn.shape.brakes);
    let length_m = 0.8 * map.grid.step_m * stride(drawn) as f64;
    let angles = picture::angle_map(&title("Spread of the local paths"), arms, map, boundary);
    let paths = picture::Paths {
        joints,
        spots: &spots,
        length_m,
    };
    let paths = picture::path_map(&title("Local paths"), arms, map, boundary, &paths);
    vec![
        (format!("{name}-angles.svg"), angles.to_string()),
        (format!("{name}-angles.csv"), angle_table(drawn)),
        (format!("{name}-paths.svg"), paths.to_string()),
        (format!("{name}-paths.csv"), path_table(joints, &spots)),
        (format!("{name}-boundary.csv"), boundary_table(drawn)),
    ]
}

/// Cells between two places where paths are drawn.
fn stride(drawn: &Drawn) -> usize {
    (drawn.map.grid.columns.max(drawn.map.grid.rows) / (2 * SPOTS)).max(1)
}

fn spots(drawn: &Drawn) -> Vec<Spot> {
    let (grid, device) = (drawn.map.grid, drawn.shape.device());
    let every = stride(drawn);
    let rows = (every / 2..grid.rows).step_by(every);
    let tips = rows.flat_map(|row| {
        let columns = (every / 2..grid.columns).step_by(every);
        columns.map(move |column| grid.middle_m(column, row))
    });
    tips.filter_map(|tip_m| Some((tip_m, device.tip_forces(tip_m).ok()?)))
        .collect()
}

fn angle_table(drawn: &Drawn) -> String {
    let mut table = "x_m,y_m,greatest_angle_deg\n".to_owned();
    let columns = drawn.map.grid.columns.max(1);
    for (index, angle) in drawn.map.angles_rad.iter().enumerate() {
        if let Some(angle) = angle {
            let [x, y] = drawn.map.grid.middle_m(index % columns, index / columns);
            row(&mut table, format_args!("{x:.6},{y:.6},{:.6}", deg(*angle)));
        }
    }
    table
}

fn path_table(joints: &[Joint], spots: &[Spot]) -> String {
    let mut table = "x_m,y_m,locked,path_deg,force_x_per_m,force_y_per_m\n".to_owned();
    for ([x, y], forces) in spots {
        let paths = joints.iter().zip(forces).zip(directions_rad(forces));
        for ((joint, [force_x, force_y]), path) in paths {
            let (joint, path) = (joint.letter(), deg(path));
            row(
                &mut table,
                format_args!("{x:.6},{y:.6},{joint},{path:.6},{force_x:.6},{force_y:.6}"),
            );
        }
    }
    table
}

fn boundary_table(drawn: &Drawn) -> String {
    let mut table = "loop,x_m,y_m,limit,limit_deg\n".to_owned();
    for (number, points) in drawn.boundary.loops.iter().enumerate() {
        for ([x, y], error) in points {
            let (word, at) = limit(error);
            let at = at.map_or(String::new(), |at| at.to_string());
            row(
                &mut table,
                format_args!("{number},{x:.9},{y:.9},{word},{at}"),
            );
        }
    }
    table
}

fn concepts(design: &Design) -> String {
    let mut table = "concept,area_m2,well_spaced_m2,least_deg,mean_deg,greatest_deg\n".to_owned();
    for compared in &design.concepts {
        if let Some(figures) = compared.figures {
            row(
                &mut table,
                format_args!(
                    "{},{:.6},{:.6},{:.4},{:.4},{:.4}",
                    compared.concept.name(),
                    figures.area_m2,
                    figures.well_spaced_m2,
                    deg(figures.least_rad),
                    deg(figures.mean_rad),
                    deg(figures.greatest_rad)
                ),
            );
        }
    }
    table
}

fn sweep(design: &Design) -> String {
    let mut table =
        "place,l_ae,l_ab,score,area,well_spaced,fill,least_deg,mean_deg,greatest_deg\n".to_owned();
    for (place, candidate) in design.ranked.iter().enumerate() {
        let (l_ae, l_ab, score) = (candidate.l_ae, candidate.l_ab, candidate.score());
        let figures = candidate.figures.map_or(",,,,,".to_owned(), |figures| {
            format!(
                "{:.6},{:.6},{:.4},{:.4},{:.4},{:.4}",
                figures.area_m2,
                figures.well_spaced_m2,
                figures.fill,
                deg(figures.least_rad),
                deg(figures.mean_rad),
                deg(figures.greatest_rad)
            )
        });
        row(
            &mut table,
            format_args!("{},{l_ae},{l_ab},{score:.6},{figures}", place + 1),
        );
    }
    table
}

/// Adds a line; writing to text cannot fail.
fn row(table: &mut String, line: std::fmt::Arguments<'_>) {
    let _ = table.write_fmt(line);
    table.push('\n');
}
