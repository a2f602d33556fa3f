//! Figure 6.2: the field of desired velocities around the line y = 40 cm.

use nalgebra::Vector2;
use rigproof_model::control::desired_velocity::{Desired, desired_velocity};
use rigproof_model::control::path::{Line, Path};
use rigproof_spec::methods::BLEND_BOUNDARY_M;
use rigproof_spec::units::deg_from_rad;

use crate::outline::cm;
use crate::{Column, Curve, Error, Experiment, Finding, Outcome, Panel, Picture, Table};

/// The field.
pub const EXPERIMENT: Experiment = Experiment {
    id: "6.2",
    title: "Sample desired velocity field",
    what: "The desired direction around the line y = 40 cm with a boundary of 5 cm, for a force of 7 N along and 3 N upwards; which force the figure was drawn for is lost.",
    run,
};

/// The force that decides the sense of the path, N.
const FORCE_N: [f64; 2] = [7.0, 3.0];
/// The line, m.
const HEIGHT_M: f64 = 0.40;

fn run() -> Result<Outcome, Error> {
    let line = Line::through([-0.2, HEIGHT_M], [0.2, HEIGHT_M])
        .map_err(|error| Error::model("the line of the field", error))?;
    let field: Vec<([f64; 2], Desired)> = grid()
        .map(|point_m| {
            let nearest = line.nearest(point_m);
            let desired = desired_velocity(&nearest, Vector2::from(FORCE_N), BLEND_BOUNDARY_M);
            (point_m, desired)
        })
        .collect();
    let column =
        |pick: fn(&([f64; 2], Desired)) -> f64| -> Vec<f64> { field.iter().map(pick).collect() };
    Ok(Outcome {
        tables: vec![Table::new(
            "field",
            vec![
                Column::numbers("x", "m", &column(|([x, _], _)| *x)),
                Column::numbers("y", "m", &column(|([_, y], _)| *y)),
                Column::numbers("beta", "rad", &column(|(_, desired)| desired.beta_rad())),
            ],
        )],
        pictures: vec![picture(&field)],
        findings: vec![outside(&field), inside(&field), side()],
    })
}

fn grid() -> impl Iterator<Item = [f64; 2]> {
    let rows = (0..=16).map(|row| 0.30 + 0.0125 * f64::from(row));
    rows.flat_map(|y| (0..=16).map(move |column| [0.0225 * f64::from(column) - 0.18, y]))
}

fn outside(field: &[([f64; 2], Desired)]) -> Finding {
    // The way towards the line is straight up or down.
    let off = field
        .iter()
        .filter(|([_, y], _)| (y - HEIGHT_M).abs() > BLEND_BOUNDARY_M + 1e-9)
        .map(|([_, y], desired)| {
            let towards = libm::copysign(core::f64::consts::FRAC_PI_2, HEIGHT_M - y);
            deg_from_rad(desired.beta_rad() - towards).abs()
        });
    let (worst, count) = off.fold((0.0_f64, 0), |(worst, n), off| (worst.max(off), n + 1));
    Finding::claim(
        "§6.1.1",
        "outside the boundary the desired velocity points toward the path",
        "always",
        (
            format!("{worst:.1e}° off at most, at {count} points"),
            worst < 1e-9 && count > 0,
        ),
        "at every point of the grid beyond 5 cm",
    )
}

fn inside(field: &[([f64; 2], Desired)]) -> Finding {
    let off = field
        .iter()
        .filter(|([_, y], _)| (y - HEIGHT_M).abs() < BLEND_BOUNDARY_M - 1e-9)
        .map(|([_, y], desired)| {
            let linear_deg = 90.0 * (HEIGHT_M - y) / BLEND_BOUNDARY_M;
            (deg_from_rad(desired.beta_rad()) - linear_deg).abs()
        });
    let (worst, count) = off.fold((0.0_f64, 0), |(worst, n), off| (worst.max(off), n + 1));
    Finding::claim(
        "§6.1.1",
        "within the boundary the direction is linearly blended to that of the path",
        "linearly",
        (
            format!(
                "90° times the distance over 5 cm, {worst:.1e}° off at most, at {count} points"
            ),
            worst < 1e-9 && count > 0,
        ),
        "at every point of the grid within 5 cm; the angle is what is blended, not the vectors",
    )
}

fn side() -> Finding {
    Finding::lost(
        "§6.1.1",
        "the force for which the figure was drawn",
        format!("{} N along x, {} N along y", FORCE_N[0], FORCE_N[1]),
        "only the sign of its part along the path changes the field; a force with none counts as one along it (gap force-across-path)",
    )
}

fn picture(field: &[([f64; 2], Desired)]) -> Picture {
    let (mut x_cm, mut y_cm) = (Vec::new(), Vec::new());
    for ([x, y], desired) in field {
        let tip = Vector2::new(cm(*x), cm(*y)) + desired.direction;
        // A shaft of 1 cm with two short barbs.
        let back = -0.35 * desired.direction;
        let aside = 0.18 * Vector2::new(-desired.direction.y, desired.direction.x);
        for point in [
            Vector2::new(cm(*x), cm(*y)),
            tip,
            tip + back + aside,
            tip,
            tip + back - aside,
            Vector2::new(f64::NAN, f64::NAN),
        ] {
            x_cm.push(point.x);
            y_cm.push(point.y);
        }
    }
    let (ends_cm, line_cm) = ([-19.0, 19.0], cm(HEIGHT_M));
    let edge_cm = cm(BLEND_BOUNDARY_M);
    let curves = vec![
        Curve::line("desired path", &ends_cm, &[line_cm; 2]),
        Curve::thin("boundary", &ends_cm, &[line_cm + edge_cm; 2]),
        Curve::thin("", &ends_cm, &[line_cm - edge_cm; 2]),
        Curve::thin("desired velocity", &x_cm, &y_cm),
    ];
    Picture {
        name: "field".to_owned(),
        title: EXPERIMENT.title.to_owned(),
        subtitle: "path y = 40 cm, boundary 5 cm, force of 7 N to the right and 3 N upwards"
            .to_owned(),
        panels: vec![Panel::new(("x", "cm"), ("y", "cm"), curves).map()],
    }
}
