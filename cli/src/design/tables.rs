//! This file sets what a design found beside what the thesis says, as JSON and as findings.

use rigproof_experiments::Finding;
use rigproof_experiments::chapter_4::statements::{
    arms_of_the_sweep, in_limits, like_pter, table_4_2,
};
use rigproof_model::linkage::workspace::Figures;
use rigproof_spec::geometry::{Angle, AngleRanges};
use rigproof_spec::layout::Layout;
use rigproof_spec::units::RAD_PER_DEG;
use serde_json::{Value, json};

use super::{Design, Drawn};

/// The statements of chapter 4 that a design of the thesis's own layouts can be held against.
pub fn statements(design: &Design) -> Vec<Finding> {
    if !design.is_thesis {
        return Vec::new();
    }
    let mut statements = Vec::new();
    let of = |name: &str| design.drawn.iter().find(|drawn| drawn.shape.name == name);
    if let Some(four) = of("four-brake") {
        statements.push(in_limits("the 4-brake layout", &four.figures));
        let attained = four.attained.as_ref();
        statements.extend(attained.map(|attained| table_4_2(Layout::FourBrake, attained)));
    }
    statements.extend(arms_of_the_sweep(&design.ranked));
    let [_, pter, three, four] = design.concepts.as_slice() else {
        return statements;
    };
    if let (Some(pter), Some(three), Some(four)) = (pter.figures, three.figures, four.figures) {
        statements.push(like_pter(&pter, &three, &four));
    }
    statements
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
    let displays: Vec<Value> = design
        .displays
        .iter()
        .map(|(name, of)| json!({ "name": name, "figures": of.as_ref().map(figures) }))
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
            "place": statement.place, "says": statement.statement, "stated": statement.stated,
            "ours": statement.ours, "verdict": statement.verdict.name(), "because": statement.because,
            "account": statement.account,
        })
    });
    json!({
        "linkages": design.drawn.iter().map(linkage).collect::<Vec<_>>(),
        "concepts": concepts,
        "displays": displays,
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
