//! Figure 4.17: where the workspaces of both layouts end, how they overlap, and which limit ends them.

use rigproof_model::ModelError;
use rigproof_model::linkage::device::Device;
use rigproof_model::linkage::inverse;
use rigproof_model::linkage::singularity::{Pair, measure};
use rigproof_model::linkage::workspace::{self, Boundary};
use rigproof_spec::geometry::{Angle, AngleRange, AngleRanges, STOPS, arms};
use rigproof_spec::layout::Layout;

use super::layouts::{Spot, base, deg, limit, loops, name, outline, spots};
use super::statements;
use crate::table::Column;
use crate::{Curve, Error, Experiment, Finding, Outcome, Panel, Picture, Table};

/// The experiment.
pub const EXPERIMENT: Experiment = Experiment {
    id: "4.17",
    title: "Workspace boundaries",
    what: "The boundaries of both layouts within table 4.2, traced on a grid of 1 mm and halved onto the limit; the ranges derived from the stops of §4.5.",
    run,
};

/// Side of the cells that boundaries are traced on, and of those that areas are counted on, m.
const TRACED_M: f64 = 0.001;
const STEP_M: f64 = 0.003;

struct Bounded {
    layout: Layout,
    boundary: Boundary,
    attained: AngleRanges,
}

fn run() -> Result<Outcome, Error> {
    let three = bounded(Layout::ThreeBrake)?;
    let four = bounded(Layout::FourBrake)?;
    let both = [&three, &four];
    let mut curves: Vec<Curve> = both
        .iter()
        .map(|b| outline(name(b.layout), &b.boundary))
        .collect();
    curves.push(base(&arms(Layout::FourBrake)));
    let overlapping = Panel::new(("x", "m"), ("y", "m"), curves).map();
    let by_limit = |b: &Bounded| Picture {
        name: format!("{}-limits", name(b.layout)),
        title: format!("What ends the workspace of the {} layout", name(b.layout)),
        subtitle: "the angle whose range ends there, table 4.2".to_owned(),
        panels: vec![Panel::new(("x", "m"), ("y", "m"), pieces(&b.boundary)).map()],
    };
    let picture = Picture {
        name: "workspaces".to_owned(),
        title: EXPERIMENT.title.to_owned(),
        subtitle: "both layouts within the ranges of table 4.2; the dots are the base joints, on one axis with 3 brakes".to_owned(),
        panels: vec![overlapping],
    };
    let mut findings: Vec<Finding> = both
        .iter()
        .map(|b| statements::table_4_2(b.layout, &b.attained))
        .collect();
    findings.push(further_limited(&four));
    findings.push(unreachable_singularities()?);
    findings.push(stop_at_d()?);
    findings.push(overlap(&three, &four)?);
    findings.extend(both.iter().map(|b| ends(b)));
    Ok(Outcome {
        tables: both.iter().map(|b| table(b)).collect(),
        pictures: vec![picture, by_limit(&three), by_limit(&four)],
        findings,
    })
}

fn bounded(layout: Layout) -> Result<Bounded, Error> {
    let refused = |problem| Error::model("the boundary", problem);
    Ok(Bounded {
        layout,
        boundary: workspace::boundary(&Device::layout(layout), TRACED_M).map_err(refused)?,
        attained: attained(layout, &STOPS)?,
    })
}

fn attained(layout: Layout, stops: &AngleRanges) -> Result<AngleRanges, Error> {
    workspace::attained_ranges(&arms(layout), stops)
        .map_err(|e| Error::model("the ranges of the angles", e))?
        .ok_or_else(|| Error::model("the ranges of the angles", "no pose is within the stops"))
}

/// What ends a workspace at a point, as the legend has it.
fn word(error: &ModelError) -> String {
    match error {
        ModelError::AngleRange { angle, .. } => {
            let (_, at) = limit(error);
            format!("θ{} {}°", angle.letter(), at.unwrap_or(f64::NAN))
        }
        _ => limit(error).0,
    }
}

/// A curve for each limit, interrupted where another one ends the workspace.
fn pieces(boundary: &Boundary) -> Vec<Curve> {
    let mut words: Vec<String> = Vec::new();
    for (_, error) in boundary.loops.iter().flatten() {
        let word = word(error);
        if !words.contains(&word) {
            words.push(word);
        }
    }
    words
        .into_iter()
        .map(|limit| {
            let (mut x, mut y) = (Vec::new(), Vec::new());
            for points in loops(boundary) {
                let mut before = false;
                for ([point_x, point_y], error) in points.iter().chain(points.first()) {
                    let here = word(error) == limit;
                    // Each piece reaches the first point of the next.
                    x.push(if here || before { *point_x } else { f64::NAN });
                    y.push(*point_y);
                    before = here;
                }
                x.push(f64::NAN);
                y.push(f64::NAN);
            }
            Curve::line(limit, &x, &y)
        })
        .collect()
}

/// How much of a boundary each limit is, m.
fn lengths(boundary: &Boundary) -> Vec<(String, f64)> {
    let mut lengths: Vec<(String, f64)> = Vec::new();
    for points in &boundary.loops {
        let next = points.iter().cycle().skip(1);
        for (([x_1, y_1], error), ([x_2, y_2], _)) in points.iter().zip(next) {
            let (word, length_m) = (word(error), libm::hypot(x_2 - x_1, y_2 - y_1));
            match lengths.iter_mut().find(|(known, _)| *known == word) {
                Some((_, sum)) => *sum += length_m,
                None => lengths.push((word, length_m)),
            }
        }
    }
    lengths.sort_by(|(_, a), (_, b)| b.total_cmp(a));
    lengths
}

fn further_limited(four: &Bounded) -> Finding {
    let narrower = Angle::ALL.into_iter().filter(|angle| {
        let (ours, stop) = (four.attained.of(*angle), STOPS.of(*angle));
        ours.least_deg > stop.least_deg + 0.5 || ours.greatest_deg < stop.greatest_deg - 0.5
    });
    let narrower: Vec<&str> = narrower.map(Angle::letter).collect();
    Finding::claim(
        "§4.5",
        "the ranges of the 4-brake layout are further limited by its geometry",
        "further limited",
        (
            format!("narrower than the stops at {}", narrower.join(", ")),
            narrower.len() == Angle::ALL.len(),
        ),
        "by half a degree and more; the arms AE and BC must not pass each other (gap `base-order`)",
    )
}

/// Whether the singularities lie outside both workspaces.
fn unreachable_singularities() -> Result<Finding, Error> {
    let mut least = f64::INFINITY;
    for layout in [Layout::ThreeBrake, Layout::FourBrake] {
        for Spot { tip_m, .. } in spots(&Device::layout(layout), STEP_M)? {
            let pose = inverse::pose(&arms(layout), tip_m);
            let pose = pose.map_err(|e| Error::model("the singularities", e))?;
            let measures = Pair::ALL.map(|pair| measure(&pose, pair));
            least = measures.into_iter().fold(least, f64::min);
        }
    }
    let nearest_deg = deg(libm::asin(least));
    Ok(Finding::claim(
        "§4.5",
        "constraints such that the singularities can never be reached",
        "never",
        (
            format!("no two arms come nearer to parallel than {nearest_deg:.2}°"),
            nearest_deg > 9.99,
        ),
        "AE and ED, BC and CD, ED and CD over both workspaces: 10° by table 4.2",
    ))
}

/// Whether a stop at the tip is needed: §4.5 puts rings on C and E and speaks of the range of θD.
fn stop_at_d() -> Result<Finding, Error> {
    let open = AngleRange::new(f64::NEG_INFINITY, f64::INFINITY);
    let rings = AngleRanges { d: open, ..STOPS };
    let three = attained(Layout::ThreeBrake, &rings)?.d;
    let four = attained(Layout::FourBrake, &rings)?.d;
    Ok(Finding::claim(
        "§4.5",
        "rings on the shafts of C and E constrain θC and θD to 10 to 170°",
        "θD is constrained",
        (
            format!(
                "without a stop of its own θD takes {:.1} to {:.1}° (3-brake), {:.1} to {:.1}° (4-brake)",
                three.least_deg, three.greatest_deg, four.least_deg, four.greatest_deg
            ),
            three.greatest_deg < 170.001 && four.greatest_deg < 170.001,
        ),
        "derived from the rings on C and E, the bumpers and θA ≥ θB; at 180° ED and CD are parallel",
    )
    .accounted("stop-at-d"))
}

fn overlap(three: &Bounded, four: &Bounded) -> Result<Finding, Error> {
    let other = Device::layout(three.layout);
    let inside = spots(&Device::layout(four.layout), STEP_M)?;
    let inside = inside
        .iter()
        .filter(|spot| other.tip_forces(spot.tip_m).is_ok());
    let common_m2 = inside.count() as f64 * STEP_M * STEP_M;
    let (three_m2, four_m2) = (three.boundary.area_m2(), four.boundary.area_m2());
    Ok(Finding::lost(
        "§4.5",
        "the overlapping workspaces of both configurations",
        format!(
            "3-brake {three_m2:.4} m², 4-brake {four_m2:.4} m², common {common_m2:.4} m²: {:.0} % of the 4-brake's",
            100.0 * common_m2 / four_m2
        ),
        "the text gives no number beside the figure",
    ))
}

fn ends(of: &Bounded) -> Finding {
    let lengths = lengths(&of.boundary);
    let whole_m: f64 = lengths.iter().map(|(_, length_m)| length_m).sum();
    let shares = lengths.iter().map(|(word, length_m)| {
        let percent = 100.0 * length_m / whole_m;
        format!("{word} {percent:.1} %")
    });
    let shares: Vec<String> = shares.collect();
    Finding::lost(
        "§4.5",
        format!(
            "the angles that form the boundary of the {} layout",
            name(of.layout)
        ),
        format!("{} of {whole_m:.2} m", shares.join(", ")),
        "the angles were written into the figure",
    )
}

fn table(of: &Bounded) -> Table {
    let points: Vec<(usize, [f64; 2], String)> = of
        .boundary
        .loops
        .iter()
        .enumerate()
        .flat_map(|(number, points)| {
            points
                .iter()
                .map(move |(point, error)| (number, *point, word(error)))
        })
        .collect();
    let numbers = |name: &str, unit: &str, of: fn(&(usize, [f64; 2], String)) -> f64| {
        Column::numbers(name, unit, &points.iter().map(of).collect::<Vec<f64>>())
    };
    let words: Vec<&String> = points.iter().map(|(.., word)| word).collect();
    Table::new(
        format!("{}-boundary", name(of.layout)),
        vec![
            numbers("loop", "", |(number, ..)| *number as f64),
            numbers("x", "m", |(_, [x, _], _)| *x),
            numbers("y", "m", |(_, [_, y], _)| *y),
            Column::words("limit", &words),
        ],
    )
}
