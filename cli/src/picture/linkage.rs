//! This file draws linkages: how evenly their paths are spread, where the paths point, and where their workspaces end.

use rigproof_experiments::chapter_4::spread;
use rigproof_model::linkage::paths::directions_rad;
use rigproof_model::linkage::sweep::Candidate;
use rigproof_model::linkage::workspace::{Boundary, Map};
use rigproof_spec::geometry::Arms;
use rigproof_spec::joint::Joint;
use svg::Document;

use super::plane::Plane;
use super::{INK, NAMED, NOISE, NOMINAL, RECORDED, field, legend, page};

/// Where a page's frame begins.
const TOP: f64 = 88.0;

/// A colour for the path of each braked joint.
const fn joint_colour(joint: Joint) -> &'static str {
    match joint {
        Joint::A => NOMINAL,
        Joint::E => NAMED,
        Joint::B => NOISE,
        Joint::C => RECORDED,
    }
}

/// The contour map of the greatest angle between adjacent local paths (figures 4.8 and 4.9).
pub fn angle_map(title: &str, arms: &Arms, map: &Map, boundary: &Boundary) -> Document {
    let mut plane = frame(map);
    let spread = spread(map);
    for run in field::runs(&spread) {
        plane.fill(run.low, run.high, run.colour, None);
    }
    outlines(&mut plane, boundary, INK);
    base(&mut plane, arms);
    let names = field::bands(&spread);
    let entries: Vec<(&str, &str, f64)> =
        names.iter().map(|(n, c)| (n.as_str(), *c, 12.0)).collect();
    let subtitle =
        "greatest angle between adjacent single-degree-of-freedom paths, over the workspace";
    finish(plane, title, subtitle, &entries)
}

/// Local paths to be drawn.
pub struct Paths<'a> {
    /// The braked joints.
    pub joints: &'a [Joint],
    /// Tips, each with the tip force of each braked joint.
    pub spots: &'a [([f64; 2], Vec<[f64; 2]>)],
    /// Length of a stroke, m.
    pub length_m: f64,
}

/// The directions of the local paths on a coarse grid (figures 4.7, 4.10 and 4.11).
pub fn path_map(
    title: &str,
    arms: &Arms,
    map: &Map,
    boundary: &Boundary,
    paths: &Paths<'_>,
) -> Document {
    let Paths {
        joints,
        spots,
        length_m,
    } = *paths;
    let mut plane = frame(map);
    outlines(&mut plane, boundary, INK);
    base(&mut plane, arms);
    for ([x, y], forces) in spots {
        for (direction, joint) in directions_rad(forces).into_iter().zip(joints) {
            let (dx, dy) = (
                0.5 * length_m * libm::cos(direction),
                0.5 * length_m * libm::sin(direction),
            );
            plane.line(
                [x - dx, y - dy],
                [x + dx, y + dy],
                joint_colour(*joint),
                1.6,
            );
        }
    }
    let names: Vec<String> = joints
        .iter()
        .map(|joint| format!("{} locked", joint.letter()))
        .collect();
    let entries: Vec<(&str, &str, f64)> = names
        .iter()
        .zip(joints)
        .map(|(name, joint)| (name.as_str(), joint_colour(*joint), 3.0))
        .collect();
    finish(
        plane,
        title,
        "the way the tip can go while one brake is locked",
        &entries,
    )
}

/// The outlines of workspaces on one another (figure 4.17), with the names that stand for them.
pub fn workspaces(map: &Map, outlined: &[(&str, &Boundary)]) -> Document {
    let mut plane = frame(map);
    let colours = [NOMINAL, NAMED];
    let mut entries = Vec::new();
    for ((name, boundary), colour) in outlined.iter().zip(colours.into_iter().cycle()) {
        outlines(&mut plane, boundary, colour);
        entries.push((*name, colour, 3.0));
    }
    let subtitle = "which limit each piece is stands in the CSV files";
    finish(plane, "Workspace boundaries", subtitle, &entries)
}

/// The score of every pair of arm lengths of a sweep, as a share of the best.
pub fn sweep(ranked: &[Candidate]) -> Document {
    let mut plane = Plane::new(
        TOP,
        [-0.05, 0.05],
        [2.05, 2.05],
        ["L_AB / L_ED", "L_AE / L_ED"],
        "",
    );
    let best = ranked.first().map_or(1.0, Candidate::score);
    let shares = [
        (0.5, "#2b0a3d"),
        (0.7, "#46327e"),
        (0.8, "#277f8e"),
        (0.9, "#1fa187"),
        (0.95, "#a0da39"),
    ];
    let top = "#fde725";
    for candidate in ranked {
        let share = candidate.score() / best;
        let band = shares.iter().find(|(limit, _)| share < *limit);
        let colour = if share > 0.0 {
            band.map_or(top, |(_, colour)| colour)
        } else {
            "#eeeeee"
        };
        let (x, y) = (candidate.l_ab, candidate.l_ae);
        let title = format!("L_AE {y}, L_AB {x}: {share:.3} of the best score");
        plane.fill(
            [x - 0.05, y - 0.05],
            [x + 0.05, y + 0.05],
            colour,
            Some(&title),
        );
    }
    plane.word([0.9, 0.9], "0.9");
    plane.word([0.267 / 0.305, 0.264 / 0.305 - 0.06], "+");
    let mut entries = vec![("no workspace", "#eeeeee", 12.0)];
    let names = [
        "below 50 %",
        "50 to 70 %",
        "70 to 80 %",
        "80 to 90 %",
        "90 to 95 %",
    ];
    entries.extend(
        names
            .into_iter()
            .zip(shares)
            .map(|(name, (_, colour))| (name, colour, 12.0)),
    );
    entries.push(("above", top, 12.0));
    let subtitle = "share of the best score; 0.9 is the pair the thesis found, + the arms it built";
    finish(plane, "Sweep of the arm lengths", subtitle, &entries)
}

/// A frame around the cells of a workspace, with the base in it.
fn frame(map: &Map) -> Plane {
    let columns = map.grid.columns.max(1);
    let inside = || {
        let cells = map.angles_rad.iter().enumerate();
        cells
            .filter(|(_, angle)| angle.is_some())
            .map(move |(index, _)| map.grid.corner_m(index % columns, index / columns))
    };
    let margin = 8.0 * map.grid.step_m;
    let least = |axis: usize| inside().map(|p| p[axis]).fold(0.0, f64::min) - margin;
    let greatest = |axis: usize| inside().map(|p| p[axis]).fold(0.0, f64::max) + margin;
    let (low, high) = ([least(0), least(1)], [greatest(0), greatest(1)]);
    Plane::new(TOP, low, high, ["x", "y"], "m")
}

fn outlines(plane: &mut Plane, boundary: &Boundary, colour: &str) {
    for points in &boundary.loops {
        plane.outline(points.iter().map(|(point, _)| *point), colour, 1.4);
    }
}

fn base(plane: &mut Plane, arms: &Arms) {
    let half = arms.l_ab_m / 2.0;
    if half > 0.0 {
        plane.word([-half, 0.0], "A");
        plane.word([half, 0.0], "B");
    } else {
        plane.word([0.0, 0.0], "A, B");
    }
}

fn finish(plane: Plane, title: &str, subtitle: &str, entries: &[(&str, &str, f64)]) -> Document {
    let height = plane.bottom() + 8.0;
    legend(page(height, title, subtitle), 72.0, entries).add(plane.finish())
}
