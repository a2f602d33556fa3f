//! Figures 4.10 and 4.11: the paths that the tip of both layouts is left on while one brake is locked.

use rigproof_model::linkage::device::{Brakes, Device};
use rigproof_model::linkage::paths::directions_rad;
use rigproof_model::linkage::workspace;
use rigproof_model::linkage::{inverse, limits, point_a_m, point_b_m};
use rigproof_spec::geometry::{Angle, Arms, angle_ranges, arms};
use rigproof_spec::joint::Joint;
use rigproof_spec::layout::Layout;
use rigproof_spec::units::rad_from_deg;

use super::layouts::{Spot, base, between_rad, deg, locked, name, outline, spots};
use crate::table::Column;
use crate::{Curve, Error, Experiment, Finding, Outcome, Panel, Picture, Table};

/// The 3-brake layout.
pub const THREE: Experiment = Experiment {
    id: "4.10",
    title: "SDOF paths for 3-brake configuration",
    what: "Each brake locked at every 15° of its angle: the arcs that the tip is left on within the workspace. The text does not say how the map was drawn.",
    run: || run(Layout::ThreeBrake, THREE.title),
};

/// The 4-brake layout.
pub const FOUR: Experiment = Experiment {
    id: "4.11",
    title: "SDOF paths for 4-brake configuration",
    what: "As 4.10, with the layout of four brakes.",
    run: || run(Layout::FourBrake, FOUR.title),
};

/// Angles between the arcs of a brake, and between the points of an arc, degrees.
const ARCS_DEG: f64 = 15.0;
const POINTS_DEG: f64 = 0.5;
/// Side of the cells in whose middles the paths are compared, and of those that the boundary is traced on, m.
const STEP_M: f64 = 0.006;
const TRACED_M: f64 = 0.002;

/// The way of the tip while a joint is locked at an angle.
struct Arc {
    joint: Joint,
    at_deg: f64,
    /// Points, NaN where the circle leaves the workspace.
    points_m: Vec<[f64; 2]>,
    /// Most that its tangent differs from the local path, rad.
    off_rad: f64,
}

fn run(layout: Layout, title: &str) -> Result<Outcome, Error> {
    let device = Device::layout(layout);
    let refused = |problem| Error::model("the map of paths", problem);
    let boundary = workspace::boundary(&device, TRACED_M).map_err(refused)?;
    let arcs: Vec<Arc> = layout
        .brakes()
        .iter()
        .flat_map(|j| arcs_of(layout, *j))
        .collect();
    let mut curves: Vec<Curve> = layout.brakes().iter().map(|j| family(&arcs, *j)).collect();
    curves.push(base(&arms(layout)));
    curves.push(outline("end of the workspace", &boundary));
    let picture = Picture {
        name: "paths".to_owned(),
        title: title.to_owned(),
        subtitle: format!(
            "where the tip can go while one brake is locked, at every {ARCS_DEG}° of its angle"
        ),
        panels: vec![Panel::new(("x", "m"), ("y", "m"), curves).map()],
    };
    let mut findings = vec![distinct(layout)?, square_to_forces(&arcs)];
    if layout == Layout::ThreeBrake {
        findings.push(about_the_base(&arcs));
        findings.push(redundant()?);
    }
    findings.push(Finding::lost(
        "§4.3",
        format!("the map of the paths of the {} layout", name(layout)),
        format!("{} arcs", arcs.len()),
        "the text gives no number beside the figure",
    ));
    Ok(Outcome {
        tables: vec![table(&arcs)],
        pictures: vec![picture],
        findings,
    })
}

fn arcs_of(layout: Layout, joint: Joint) -> Vec<Arc> {
    let range = angle_ranges(layout).of(angle(joint));
    let first = (range.least_deg / ARCS_DEG).ceil() as i32;
    let last = (range.greatest_deg / ARCS_DEG).floor() as i32;
    (first..=last)
        .map(|k| arc(layout, joint, f64::from(k) * ARCS_DEG))
        .filter(|arc| arc.points_m.iter().any(|[x, _]| x.is_finite()))
        .collect()
}

const fn angle(joint: Joint) -> Angle {
    match joint {
        Joint::A => Angle::A,
        Joint::E => Angle::E,
        Joint::B => Angle::B,
        Joint::C => Angle::C,
    }
}

/// The circle that a locked joint leaves to the tip, cut off at the end of the workspace: about E or C while A or B is
/// locked, about A or B while E or C is.
fn arc(layout: Layout, joint: Joint, at_deg: f64) -> Arc {
    let (arms, ranges, device) = (arms(layout), angle_ranges(layout), Device::layout(layout));
    let ([x, y], radius_m) = circle(&arms, joint, rad_from_deg(at_deg));
    let brake = layout.brakes().iter().position(|braked| *braked == joint);
    let mut off_rad: f64 = 0.0;
    let mut points_m = Vec::new();
    for k in 0..=(360.0 / POINTS_DEG) as i32 {
        let direction_rad = rad_from_deg(f64::from(k) * POINTS_DEG);
        let (sine, cosine) = libm::sincos(direction_rad);
        let tip_m = [x + radius_m * cosine, y + radius_m * sine];
        let pose = limits::reach(&arms, &ranges, tip_m);
        // On the rest of the circle the linkage is folded the other way, with the joint at another angle.
        let held = pose.is_ok_and(|p| (deg(p.angle_rad(angle(joint))) - at_deg).abs() < 1e-6);
        points_m.push(if held { tip_m } else { [f64::NAN; 2] });
        if held && let (Ok(forces), Some(brake)) = (device.tip_forces(tip_m), brake) {
            let tangent_rad = direction_rad + rad_from_deg(90.0);
            let path = directions_rad(&forces).get(brake).copied();
            let off = path.map_or(f64::INFINITY, |path| between_rad(path, tangent_rad));
            off_rad = off_rad.max(off);
        }
    }
    Arc {
        joint,
        at_deg,
        points_m,
        off_rad,
    }
}

/// Middle, m, and radius, m.
fn circle(arms: &Arms, joint: Joint, at_rad: f64) -> ([f64; 2], f64) {
    let (sine, cosine) = libm::sincos(at_rad);
    let beyond = |[x, y]: [f64; 2], length_m: f64| [x + length_m * cosine, y + length_m * sine];
    let across = |inner_m: f64, outer_m: f64| {
        libm::sqrt(inner_m * inner_m + outer_m * outer_m + 2.0 * inner_m * outer_m * cosine)
    };
    match joint {
        Joint::A => (beyond(point_a_m(arms), arms.l_ae_m), arms.l_ed_m),
        Joint::E => (point_a_m(arms), across(arms.l_ae_m, arms.l_ed_m)),
        Joint::B => (beyond(point_b_m(arms), arms.l_bc_m), arms.l_cd_m),
        Joint::C => (point_b_m(arms), across(arms.l_bc_m, arms.l_cd_m)),
    }
}

/// All arcs of a brake as one interrupted line.
fn family(arcs: &[Arc], joint: Joint) -> Curve {
    let of = arcs.iter().filter(|arc| arc.joint == joint);
    let points = of.flat_map(|arc| arc.points_m.iter().chain([&[f64::NAN; 2]]));
    let (x, y): (Vec<f64>, Vec<f64>) = points.map(|[x, y]| (*x, *y)).unzip();
    Curve::thin(locked(joint), &x, &y)
}

/// Whether every brake of a layout has a path of its own.
fn distinct(layout: Layout) -> Result<Finding, Error> {
    let mut least_rad = f64::INFINITY;
    for Spot { forces, .. } in spots(&Device::layout(layout), STEP_M)? {
        let paths = directions_rad(&forces);
        for (index, first) in paths.iter().enumerate() {
            for second in paths.iter().skip(index + 1) {
                least_rad = least_rad.min(between_rad(*first, *second));
            }
        }
    }
    let (place, stated) = match layout {
        Layout::ThreeBrake => ("§4.2.3", "three"),
        Layout::FourBrake => (
            "§4.2.4",
            "four: a brake on C adds one where A and B are apart",
        ),
    };
    Ok(Finding::claim(
        place,
        "local paths that the tip can be held to",
        stated,
        (
            format!("no two paths are less than {:.1}° apart", deg(least_rad)),
            deg(least_rad) > 1.0,
        ),
        "over the workspace, tips 6 mm apart; under 1° two paths would count as one",
    ))
}

fn square_to_forces(arcs: &[Arc]) -> Finding {
    let off_deg = deg(arcs.iter().map(|arc| arc.off_rad).fold(0.0, f64::max));
    Finding::claim(
        "§4.3",
        "the local paths lie perpendicular to the available forces",
        "perpendicular",
        (format!("within {off_deg:.0e}°"), off_deg < 1e-6),
        "tangents of the circles that the locked linkage turns on, against the forces of (5.33), on every point of every arc",
    )
}

fn about_the_base(arcs: &[Arc]) -> Finding {
    let of_e = arcs.iter().filter(|arc| arc.joint == Joint::E);
    let off_deg = deg(of_e.map(|arc| arc.off_rad).fold(0.0, f64::max));
    Finding::claim(
        "§4.2.3",
        "while E is locked the tip rotates",
        "about the base",
        (
            format!("about the base, within {off_deg:.0e}°"),
            off_deg < 1e-6,
        ),
        "the arcs of E are circles about A, which is also B",
    )
}

/// Whether brakes at C and D of the 3-brake layout hold the tip to no path of their own.
fn redundant() -> Result<Finding, Error> {
    let layout = Layout::ThreeBrake;
    let arms = arms(layout);
    let device = Device::Linkage {
        arms,
        ranges: angle_ranges(layout),
        brakes: Brakes::Joints(&[Joint::E, Joint::C]),
    };
    let mut off_rad = [0.0_f64; 2];
    for Spot { tip_m, forces } in spots(&device, STEP_M)? {
        let [of_e, of_c] = directions_rad(&forces)[..] else {
            continue;
        };
        let [c, d] = off_rad;
        let of_d = path_of_d(&arms, tip_m)?;
        off_rad = [
            c.max(between_rad(of_e, of_c)),
            d.max(between_rad(of_e, of_d)),
        ];
    }
    let [c_deg, d_deg] = off_rad.map(deg);
    Ok(Finding::claim(
        "§4.2.4",
        "a further brake at C or D of the 3-brake layout",
        "redundant",
        (
            format!("their paths differ from that of E by {c_deg:.0e} and {d_deg:.0e}°"),
            c_deg < 1e-6 && d_deg < 1e-3,
        ),
        "tips 6 mm apart; the path of D is square to the gradient of θD, by central differences of 1 µm",
    ))
}

/// The direction in which θD does not change, rad.
fn path_of_d(arms: &Arms, [x, y]: [f64; 2]) -> Result<f64, Error> {
    const STEP_M: f64 = 1e-6;
    let theta_d = |tip_m: [f64; 2]| {
        let pose = inverse::pose(arms, tip_m);
        pose.map(|pose| pose.theta_d_rad)
            .map_err(|e| Error::model("the path of joint D", e))
    };
    let along_x = theta_d([x + STEP_M, y])? - theta_d([x - STEP_M, y])?;
    let along_y = theta_d([x, y + STEP_M])? - theta_d([x, y - STEP_M])?;
    Ok(libm::atan2(along_x, -along_y))
}

fn table(arcs: &[Arc]) -> Table {
    let points = || {
        let of = |arc: &'_ Arc| {
            let points = arc.points_m.clone().into_iter();
            let (joint, at_deg) = (arc.joint, arc.at_deg);
            points
                .filter(|[x, _]| x.is_finite())
                .map(move |p| (joint, at_deg, p))
        };
        arcs.iter().flat_map(of)
    };
    let numbers = |name: &str, unit: &str, of: fn((Joint, f64, [f64; 2])) -> f64| {
        Column::numbers(name, unit, &points().map(of).collect::<Vec<f64>>())
    };
    let joints: Vec<&str> = points().map(|(joint, ..)| joint.letter()).collect();
    Table::new(
        "arcs",
        vec![
            Column::words("locked", &joints),
            numbers("at", "°", |(_, at_deg, _)| at_deg),
            numbers("x", "m", |(.., [x, _])| x),
            numbers("y", "m", |(.., [_, y])| y),
        ],
    )
}
