//! This file sets what a design found beside what the thesis says, as JSON and as statements.

use rigproof_model::ModelError;
use rigproof_model::linkage::sweep::Candidate;
use rigproof_model::linkage::workspace::Figures;
use rigproof_spec::geometry::{Angle, AngleRanges, angle_ranges};
use rigproof_spec::layout::Layout;
use rigproof_spec::units::RAD_PER_DEG;
use serde_json::{Value, json};

use super::{Design, Drawn};

/// How a statement of the thesis stands beside what was computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// The computed figure is what the thesis says.
    Agrees,
    /// It is not.
    Disagrees,
    /// The thesis leaves out what would be needed.
    NotComparable,
}

impl Verdict {
    /// The verdict in words.
    pub const fn name(self) -> &'static str {
        match self {
            Verdict::Agrees => "agrees",
            Verdict::Disagrees => "disagrees",
            Verdict::NotComparable => "cannot be compared",
        }
    }

    const fn of(holds: bool) -> Verdict {
        match holds {
            true => Verdict::Agrees,
            false => Verdict::Disagrees,
        }
    }
}

/// A statement of chapter 4 with its section, what was computed, and how the two stand.
pub struct Statement {
    /// Where the thesis says it.
    pub place: &'static str,
    /// What it says.
    pub says: &'static str,
    /// What was computed.
    pub ours: String,
    /// How the two stand.
    pub verdict: Verdict,
}

/// The statements of chapter 4 that a design of the thesis's own layouts can be held against.
pub fn statements(design: &Design) -> Vec<Statement> {
    if !design.is_thesis {
        return Vec::new();
    }
    let mut statements = Vec::new();
    let of = |name: &str| design.drawn.iter().find(|drawn| drawn.shape.name == name);
    if let Some(four) = of("four-brake") {
        statements.push(in_limits(&four.figures));
        statements.extend(four.attained.map(|attained| table_4_2(&attained)));
    }
    statements.extend(arms_of_the_sweep(&design.ranked));
    statements.extend(like_pter(design));
    statements
}

fn in_limits(four: &Figures) -> Statement {
    let (least, greatest) = (deg(four.least_rad), deg(four.greatest_rad));
    Statement {
        place: "§4.3",
        says: "with four brakes the greatest angle can vary between 45 and 180°",
        ours: format!("{least:.1} to {greatest:.1}° over the 4-brake workspace"),
        verdict: Verdict::of(least >= 45.0 && greatest <= 180.0),
    }
}

fn table_4_2(attained: &AngleRanges) -> Statement {
    let table = angle_ranges(Layout::FourBrake);
    let rounding = 1e-6;
    let same = Angle::ALL.into_iter().all(|angle| {
        let (ours, printed) = (attained.of(angle), table.of(angle));
        (ours.least_deg + rounding).floor() == printed.least_deg
            && (ours.greatest_deg - rounding).ceil() == printed.greatest_deg
    });
    let ends = Angle::ALL.map(|angle| {
        let range = attained.of(angle);
        format!(
            "θ{} {:.2} to {:.2}°",
            angle.letter(),
            range.least_deg,
            range.greatest_deg
        )
    });
    Statement {
        place: "table 4.2",
        says: "4-brake ranges θA 37 to 180, θE 210 to 350, θB 0 to 143, θC 10 to 150, θD 51 to 170°",
        ours: format!(
            "{}, from the stops and θA ≥ θB, before rounding outward",
            ends.join(", ")
        ),
        verdict: Verdict::of(same),
    }
}

fn arms_of_the_sweep(ranked: &[Candidate]) -> Vec<Statement> {
    let same = |candidate: &&Candidate| candidate.l_ae == 0.9;
    let place = ranked.iter().position(|c| c.l_ae == 0.9 && c.l_ab == 0.9);
    let (Some(place), Some(best)) = (place, ranked.first()) else {
        return Vec::new();
    };
    let share = ranked.get(place).map_or(0.0, Candidate::score) / best.score();
    let well_spaced = |c: &Candidate| c.figures.map_or(0.0, |figures| figures.well_spaced_m2);
    let widest = ranked
        .iter()
        .filter(same)
        .map(well_spaced)
        .fold(0.0, f64::max);
    let near = ranked.iter().filter(same);
    let near = near.filter(|c| well_spaced(c) > 0.99 * widest);
    let mut near: Vec<String> = near.map(|c| c.l_ab.to_string()).collect();
    near.sort();
    vec![
        Statement {
            place: "§4.3",
            says: "L_AE and L_AB of about 90 % of L_ED yield the best workspace, by inspection",
            ours: format!(
                "0.9/0.9 is number {} of {} at {:.0} % of the best score ({}/{}); the thesis states no criterion",
                place + 1,
                ranked.len(),
                100.0 * share,
                best.l_ae,
                best.l_ab
            ),
            verdict: Verdict::NotComparable,
        },
        Statement {
            place: "§4.3",
            says: "with L_AE = 0.9, L_AB of about 0.9",
            ours: format!(
                "most well-spaced area (within 1 %) at L_AB = {}",
                near.join(", ")
            ),
            verdict: Verdict::of(near.iter().any(|l_ab| l_ab == "0.9")),
        },
    ]
}

fn like_pter(design: &Design) -> Option<Statement> {
    let [_, pter, three, four] = design.concepts.as_slice() else {
        return None;
    };
    let (pter, three, four) = (pter.figures?, three.figures?, four.figures?);
    let share = |figures: &Figures| 100.0 * figures.well_spaced_m2 / figures.area_m2;
    Some(Statement {
        place: "chapter 7",
        says: "availability of local paths equivalent to that of PTER",
        ours: format!(
            "well-spaced share of the workspace: PTER {:.0} %, 4-brake {:.0} %, 3-brake {:.0} %; mean angle {:.0}, {:.0}, {:.0}°",
            share(&pter),
            share(&four),
            share(&three),
            deg(pter.mean_rad),
            deg(four.mean_rad),
            deg(three.mean_rad)
        ),
        verdict: Verdict::of(share(&four) >= share(&pter)),
    })
}

/// What a design found, as JSON.
pub fn json(design: &Design) -> Value {
    let concepts: Vec<Value> = design
        .concepts
        .iter()
        .map(|compared| {
            json!({ "name": compared.concept.name(), "figures": compared.figures.as_ref().map(figures) })
        })
        .collect();
    let ranked = design.ranked.iter().map(|candidate| {
        json!({
            "l_ae": candidate.l_ae, "l_ab": candidate.l_ab, "score": candidate.score(),
            "figures": candidate.figures.as_ref().map(figures),
        })
    });
    let statements = statements(design);
    let statements = statements.iter().map(|statement| {
        json!({
            "place": statement.place, "says": statement.says, "ours": statement.ours,
            "verdict": statement.verdict.name(),
        })
    });
    json!({
        "linkages": design.drawn.iter().map(linkage).collect::<Vec<_>>(),
        "concepts": concepts,
        "sweep": ranked.collect::<Vec<_>>(),
        "statements": statements.collect::<Vec<_>>(),
    })
}

fn linkage(drawn: &Drawn) -> Value {
    let arms = &drawn.shape.arms;
    json!({
        "name": drawn.shape.name,
        "lengths_m": { "ae": arms.l_ae_m, "ed": arms.l_ed_m, "bc": arms.l_bc_m, "cd": arms.l_cd_m, "ab": arms.l_ab_m },
        "brakes": drawn.shape.brakes.iter().map(|joint| joint.letter()).collect::<Vec<_>>(),
        "ranges_deg": ranges(&drawn.shape.ranges),
        "attained_deg": drawn.attained.as_ref().map(ranges),
        "step_m": drawn.map.grid.step_m,
        "boundary_area_m2": drawn.boundary.area_m2(),
        "figures": figures(&drawn.figures),
    })
}

/// Both ends of each angle; an open end is null.
fn ranges(ranges: &AngleRanges) -> Value {
    let ends = Angle::ALL.map(|angle| {
        let range = ranges.of(angle);
        let ends = [range.least_deg, range.greatest_deg];
        let ends = ends.map(|end| end.is_finite().then_some(end));
        (angle.letter().to_lowercase(), json!(ends))
    });
    Value::Object(ends.into_iter().collect())
}

fn figures(figures: &Figures) -> Value {
    json!({
        "area_m2": figures.area_m2,
        "well_spaced_m2": figures.well_spaced_m2,
        "fill": figures.fill,
        "least_deg": deg(figures.least_rad),
        "mean_deg": deg(figures.mean_rad),
        "greatest_deg": deg(figures.greatest_rad),
    })
}

/// An angle in degrees.
pub fn deg(angle_rad: f64) -> f64 {
    angle_rad / RAD_PER_DEG
}

/// What ends a workspace, in a word and the angle's value there.
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
