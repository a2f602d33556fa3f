//! §6.1.2: the tip force of every brake at full current, and the greatest force that a controller asks for.

use rigproof_model::brake::torque_gain;
use rigproof_model::control::force_limit::{
    force_from_elbow, force_magnitude, greatest_common_force, least_force,
};
use rigproof_model::linkage::device::Device;
use rigproof_model::linkage::jacobian::jacobian;
use rigproof_model::linkage::limits::reach;
use rigproof_model::linkage::workspace::Grid;
use rigproof_spec::geometry::{AngleRange, angle_ranges, arms};
use rigproof_spec::joint::Joint;
use rigproof_spec::layout::Layout;
use rigproof_spec::methods::greatest_desired_force_n;
use rigproof_spec::tables::GREATEST_CURRENT_A;
use rigproof_spec::units::rad_from_deg;

use crate::outline;
use crate::{Column, Curve, Error, Experiment, Finding, Outcome, Panel, Picture, Table};

/// The maximum desired force.
pub const EXPERIMENT: Experiment = Experiment {
    id: "force",
    title: "Maximum desired force of both configurations (§6.1.2)",
    what: "The tip force of each brake at 1 A by (6.4) to (6.7) over the elbow angles of table 4.2, and the least of them.",
    run,
};

fn run() -> Result<Outcome, Error> {
    let mut outcome = Outcome::default();
    for layout in [Layout::ThreeBrake, Layout::FourBrake] {
        outcome.tables.push(table(layout));
        outcome.pictures.push(picture(layout));
        outcome.findings.push(Finding::number(
            "§6.1.2",
            format!("{}: the maximum desired force", outline::name(layout)),
            (
                greatest_desired_force_n(layout),
                greatest_common_force(layout),
                "N",
            ),
            0.5,
            format!(
                "rounded down to half a newton; the least of {}",
                least(layout, layout.brakes())
            ),
        ));
        outcome.findings.push(elbows_alone(layout)?);
    }
    let without = least_n(Layout::ThreeBrake, Joint::C);
    outcome.findings.push(Finding {
        stated: "not stated".to_owned(),
        ..Finding::lost(
            "§6.1.2",
            "3-brake: the least force of a brake at C",
            format!("{without:.2} N, below the maximum of the text"),
            "the maximum is \"among all brakes\", and this configuration has none at C",
        )
    });
    Ok(outcome)
}

/// The elbow angle on a joint's side.
fn elbow(layout: Layout, joint: Joint) -> AngleRange {
    let ranges = angle_ranges(layout);
    match joint {
        Joint::A | Joint::E => ranges.e,
        Joint::B | Joint::C => ranges.c,
    }
}

fn least_n(layout: Layout, joint: Joint) -> f64 {
    least_force(&arms(layout), joint, elbow(layout, joint))
}

fn least(layout: Layout, joints: &[Joint]) -> String {
    let of = |joint: &Joint| format!("{} {:.2} N", joint.letter(), least_n(layout, *joint));
    joints.iter().map(of).collect::<Vec<String>>().join(", ")
}

fn table(layout: Layout) -> Table {
    let joints = layout.brakes();
    let letters: Vec<&str> = joints.iter().map(|joint| joint.letter()).collect();
    let column = |pick: &dyn Fn(Joint) -> f64| -> Vec<f64> {
        joints.iter().map(|joint| pick(*joint)).collect()
    };
    let torque = |joint| torque_gain(joint, GREATEST_CURRENT_A);
    Table::new(
        format!("least-force-{}", outline::name(layout)),
        vec![
            Column::words("brake", &letters),
            Column::numbers("torque at 1 A", "N·m", &column(&torque)),
            Column::numbers(
                "elbow from",
                "deg",
                &column(&|j| elbow(layout, j).least_deg),
            ),
            Column::numbers(
                "elbow to",
                "deg",
                &column(&|j| elbow(layout, j).greatest_deg),
            ),
            Column::numbers("least force", "N", &column(&|j| least_n(layout, j))),
        ],
    )
}

fn picture(layout: Layout) -> Picture {
    let arms = arms(layout);
    let panel = |joints: [Joint; 2], name: &str| {
        let braked = joints
            .iter()
            .filter(|joint| layout.brakes().contains(joint));
        let mut curves: Vec<Curve> = braked
            .map(|joint| {
                let range = elbow(layout, *joint);
                let width_deg = range.greatest_deg - range.least_deg;
                let degrees: Vec<f64> = (0..=200)
                    .map(|k| range.least_deg + width_deg * f64::from(k) / 200.0)
                    .collect();
                let torque_nm = torque_gain(*joint, GREATEST_CURRENT_A);
                let force = degrees
                    .iter()
                    .map(|deg| force_from_elbow(&arms, *joint, rad_from_deg(*deg), torque_nm));
                let force: Vec<f64> = force.collect();
                Curve::line(format!("brake {}", joint.letter()), &degrees, &force)
            })
            .collect();
        let range = elbow(layout, joints[0]);
        let limit_n = greatest_desired_force_n(layout);
        let ends = [range.least_deg, range.greatest_deg];
        curves.push(Curve::thin("maximum of the text", &ends, &[limit_n; 2]));
        Panel::new((name, "°"), ("force at the tip", "N"), curves)
    };
    Picture {
        name: format!("force-{}", outline::name(layout)),
        title: format!(
            "Tip force of each brake at 1 A, {} configuration",
            outline::name(layout)
        ),
        subtitle: "(6.4) to (6.7), magnitudes, over the ranges of table 4.2".to_owned(),
        panels: vec![
            panel([Joint::A, Joint::E], "angle of joint E"),
            panel([Joint::B, Joint::C], "angle of joint C"),
        ],
    }
}

/// "The force magnitude depends only on the angle θ_E for brakes A and E, and on θ_C for brakes B and C."
fn elbows_alone(layout: Layout) -> Result<Finding, Error> {
    let refused = |error| Error::model("the tip force over the workspace", error);
    let (arms, ranges) = (arms(layout), angle_ranges(layout));
    let grid = Grid::over(&Device::layout(layout), 0.02).map_err(refused)?;
    let (mut worst, mut poses) = (0.0_f64, 0);
    for (row, column) in (0..grid.rows).flat_map(|r| (0..grid.columns).map(move |c| (r, c))) {
        let Ok(pose) = reach(&arms, &ranges, grid.middle_m(column, row)) else {
            continue;
        };
        poses += 1;
        let j = jacobian(&arms, &pose).map_err(refused)?;
        for (joint, row) in Joint::ALL.into_iter().zip(j.row_iter()) {
            let elbow_rad = match joint {
                Joint::A | Joint::E => pose.theta_e_rad,
                Joint::B | Joint::C => pose.theta_c_rad,
            };
            let by_jacobian = force_magnitude(row.transpose(), 1.0);
            let by_elbow = force_from_elbow(&arms, joint, elbow_rad, 1.0);
            worst = worst.max((by_elbow / by_jacobian - 1.0).abs());
        }
    }
    Ok(Finding::claim(
        "§6.1.2",
        format!(
            "{}: the force depends on the elbow angle of the brake's side only",
            outline::name(layout)
        ),
        "depends only on θE for A and E, on θC for B and C",
        (
            format!("(6.4) to (6.7) give the Jacobian's force to {worst:.1e} in {poses} poses"),
            worst < 1e-9 && poses > 0,
        ),
        "all joints, with the magnitudes of the denominators and θC in (6.6): the errata force-magnitude-sign and force-of-b-angle",
    ))
}
