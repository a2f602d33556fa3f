//! Figures 4.8 and 4.9: how evenly the local paths of both layouts are spread.

use nalgebra::Vector2;
use rigproof_model::control::desired_velocity::Desired;
use rigproof_model::control::force_angle::opposing_force;
use rigproof_model::control::influence;
use rigproof_model::linkage::device::{Concept, Device};
use rigproof_model::linkage::paths::greatest_angle_rad;
use rigproof_model::linkage::workspace::{self, Map};
use rigproof_spec::geometry::arms;
use rigproof_spec::laws::influence_rank;
use rigproof_spec::layout::Layout;
use rigproof_spec::units::rad_from_deg;

use super::layouts::{
    Spot, angle_table, base, deg, figures, name, outline, spots, spread, well_spaced_percent,
};
use super::statements;
use crate::{Error, Experiment, Finding, Outcome, Panel, Picture};

/// The 3-brake layout.
pub const THREE: Experiment = Experiment {
    id: "4.8",
    title: "Contour plot of maximum angle between local SDOF paths for 3-brake configuration",
    what: "The workspace of tables 4.1 and 4.2 on a grid of 2 mm; the text gives neither step nor contours.",
    run: || run(Layout::ThreeBrake, THREE.title),
};

/// The 4-brake layout.
pub const FOUR: Experiment = Experiment {
    id: "4.9",
    title: "Contour plot of maximum angle between local SDOF paths for 4-brake configuration",
    what: "As 4.8, with the layout of four brakes; PTER beside it has the arms and stops of the 3-brake layout.",
    run: || run(Layout::FourBrake, FOUR.title),
};

/// Side of the cells that are shaded, of those that concepts are compared on, and of those that controllers are asked in, m.
const STEP_M: f64 = 0.002;
const CONCEPT_STEP_M: f64 = 0.006;
const ASKED_STEP_M: f64 = 0.03;

fn run(layout: Layout, title: &str) -> Result<Outcome, Error> {
    let device = Device::layout(layout);
    let refused = |problem| Error::model("the contour plot", problem);
    let map = workspace::map(&device, STEP_M).map_err(refused)?;
    let boundary = workspace::boundary(&device, STEP_M).map_err(refused)?;
    let found = figures(&map)?;
    let curves = vec![
        outline("end of the workspace", &boundary),
        base(&arms(layout)),
    ];
    let picture = Picture {
        name: "greatest-angle".to_owned(),
        title: title.to_owned(),
        subtitle: "greatest angle between adjacent paths with one brake locked, over the workspace"
            .to_owned(),
        panels: vec![
            Panel::new(("x", "m"), ("y", "m"), curves)
                .map()
                .over(spread(&map)),
        ],
    };
    let mut findings = Vec::new();
    if layout == Layout::FourBrake {
        findings.push(statements::in_limits("the 4-brake layout", &found));
        let concept = |concept: Concept| {
            figures(&workspace::map(&concept.device(), CONCEPT_STEP_M).map_err(refused)?)
        };
        let (pter, three) = (concept(Concept::ScaledPter)?, concept(Concept::ThreeBrake)?);
        findings.push(statements::like_pter(&pter, &three, &found));
    }
    findings.push(invalid_beyond_90(&device)?);
    findings.push(Finding::lost(
        "§4.3",
        format!("the contours of the {} layout", name(layout)),
        format!(
            "{:.1} to {:.1}°, mean {:.1}°; at most 90° on {:.1} % of {:.3} m²",
            deg(found.least_rad),
            deg(found.greatest_rad),
            deg(found.mean_rad),
            well_spaced_percent(&found),
            found.area_m2
        ),
        "the text gives no number beside the figure",
    ));
    Ok(Outcome {
        tables: vec![angle_table(&coarse(&device)?)],
        pictures: vec![picture],
        findings,
    })
}

/// The map that is written down: a ninth of the cells that are shaded.
fn coarse(device: &Device) -> Result<Map, Error> {
    workspace::map(device, 3.0 * STEP_M).map_err(|e| Error::model("the contour plot", e))
}

/// Whether there are invalid solutions exactly where the greatest angle exceeds 90°.
fn invalid_beyond_90(device: &Device) -> Result<Finding, Error> {
    let (mut within, mut beyond) = ([0, 0], [0, 0]);
    for Spot { forces, .. } in spots(device, ASKED_STEP_M)? {
        let greatest_deg = deg(greatest_angle_rad(&forces));
        let invalid = usize::from(has_invalid_solution(&forces));
        // Near 90° an invalid direction is narrower than the directions are apart.
        if greatest_deg <= 90.0 {
            within = [within[0] + invalid, within[1] + 1];
        } else if greatest_deg >= 93.0 {
            beyond = [beyond[0] + invalid, beyond[1] + 1];
        }
    }
    let holds = within[0] == 0 && beyond[0] == beyond[1] && within[1] > 0 && beyond[1] > 0;
    Ok(Finding::claim(
        "§4.3",
        "invalid solutions to the controllers exist when the greatest angle exceeds 90°",
        "beyond 90°",
        (
            format!(
                "no brake helps on {} of {} tips up to 90°, on {} of {} from 93°",
                within[0], within[1], beyond[0], beyond[1]
            ),
            holds,
        ),
        "proportional control (§6.3) asked at tips 3 cm apart, for velocities 1° off every desired direction, 1° apart",
    ))
}

/// Whether there is a desired direction, and a velocity 1° off it, that no brake turns towards it.
fn has_invalid_solution(forces: &[[f64; 2]]) -> bool {
    let unit = |angle_deg: f64| {
        let (sine, cosine) = libm::sincos(rad_from_deg(angle_deg));
        Vector2::new(cosine, sine)
    };
    let helped = |direction_deg: f64, velocity_deg: f64| {
        let desired = Desired {
            direction: unit(direction_deg),
            along: unit(direction_deg),
            towards: None,
        };
        let velocity = unit(velocity_deg);
        forces.iter().any(|force| {
            opposing_force(Vector2::from(*force), velocity).is_some_and(|opposing| {
                influence_rank(influence(opposing, &desired, velocity)).is_some()
            })
        })
    };
    (0..360).map(f64::from).any(|direction_deg| {
        [-1.0, 1.0]
            .into_iter()
            .any(|off_deg| !helped(direction_deg, direction_deg + off_deg))
    })
}
