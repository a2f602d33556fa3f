//! This file holds the cases of appendix B: the tip let go, in free motion and with each brake locked, on both layouts.

use rigproof_model::rig::release::{FIGURES, Release, Sample};
use rigproof_spec::joint::Joint;
use rigproof_spec::layout::Layout;
use rigproof_spec::tables::GREATEST_CURRENT_A;

use crate::Error;
use crate::case::{Case, Parameter, Run};
use crate::claim::{Claim, Shows};
use crate::table::{RUN, Table};

/// Time between the rows, s.
const ROWS_S: f64 = 0.01;
/// The columns of `input.csv` after the run's number: one row is one run.
const INPUT: [(&str, &str); 13] = [
    (RUN, ""),
    ("current_a", "A"),
    ("current_e", "A"),
    ("current_b", "A"),
    ("current_c", "A"),
    ("start_x", "m"),
    ("start_y", "m"),
    ("cylinder_x", "m"),
    ("cylinder_y", "m"),
    ("cylinder_radius", "m"),
    ("spring_force", "N"),
    ("longest_duration", "s"),
    ("sample_step", "s"),
];
const CURRENTS: [&str; 4] = ["current_a", "current_e", "current_b", "current_c"];

/// The cases of both layouts.
pub fn cases() -> Vec<Case> {
    [Layout::ThreeBrake, Layout::FourBrake].map(case).into()
}

/// The word for a layout in names and parameters.
pub const fn name(layout: Layout) -> &'static str {
    match layout {
        Layout::ThreeBrake => "three_brake",
        Layout::FourBrake => "four_brake",
    }
}

fn case(layout: Layout) -> Case {
    let name = name(layout);
    let figures = FIGURES.into_iter().filter(move |figure| figure.1 == layout);
    let figures: Vec<(&str, Option<Joint>)> = figures.map(|(id, _, locked)| (id, locked)).collect();
    let runs = figures.iter().map(|(figure, locked)| {
        let (what, word) = match locked {
            None => ("free motion".to_owned(), "none".to_owned()),
            Some(joint) => (
                format!("brake {} locked", joint.letter()),
                joint.letter().to_owned(),
            ),
        };
        Run {
            what: format!("{what} (figure {figure})"),
            parameters: vec![Parameter::word("locked brake", word)],
        }
    });
    let locked: Vec<Option<Joint>> = figures.iter().map(|(_, locked)| *locked).collect();
    let case = format!("release_{name}");
    Case {
        name: case.clone(),
        purpose: "The tip is let go from rest and pulled towards a cylinder by a spring of constant force, in free motion and with each brake locked in turn.".to_owned(),
        citations: vec!["(5.40)", "(5.41)", "(5.67)", "(5.68)", "§5.4", "appendix B"],
        step_s: Release::of(layout, None).sample_s,
        rows_s: ROWS_S,
        parameters: vec![
            Parameter::word("layout", name),
            Parameter::number("the locked brake has had its current for", 1.0, "s"),
        ],
        runs: runs.collect(),
        must_show: claims(&locked),
        input: Box::new(move |()| Ok(input(layout, &locked))),
        expected: Box::new(move |input| expected(&case, layout, input)),
    }
}

fn claims(locked: &[Option<Joint>]) -> Vec<Claim> {
    let says = "the tip moves 5 cm across";
    let mut claims = vec![Claim::each(says, "tip_x", Shows::Spans(0.05))];
    for (index, locked) in locked.iter().enumerate() {
        if let Some(joint) = locked {
            let held = format!("held_{}", joint.letter().to_lowercase());
            let says = format!("brake {} holds its joint for 0.2 s", joint.letter());
            claims.push(Claim::of(index + 1, says, &held, Shows::Lasts(20)));
        } else {
            let says = "the tip comes within 3 cm of the cylinder at the right";
            claims.push(Claim::of(index + 1, says, "tip_x", Shows::Reaches(0.1)));
            for speed in ["speed_a", "speed_b"] {
                let says = "both base joints turn at 0.5 rad/s";
                claims.push(Claim::of(index + 1, says, speed, Shows::Spans(0.5)));
            }
        }
    }
    claims
}

fn input(layout: Layout, locked: &[Option<Joint>]) -> Table {
    let mut table = Table::new(&INPUT);
    for (index, locked) in locked.iter().enumerate() {
        let release = Release::of(layout, *locked);
        let mut row = Joint::ALL
            .map(|joint| {
                if *locked == Some(joint) {
                    GREATEST_CURRENT_A
                } else {
                    0.0
                }
            })
            .to_vec();
        row.extend(release.start_m);
        row.extend(release.cylinder_m);
        row.extend([
            release.radius_m,
            release.force_n,
            release.duration_s,
            release.sample_s,
        ]);
        table.push(index + 1, &row);
    }
    table
}

fn expected(case: &str, layout: Layout, input: &Table) -> Result<Table, Error> {
    let mut table = Table::new(&[
        (RUN, ""),
        ("time", "s"),
        ("tip_x", "m"),
        ("tip_y", "m"),
        ("angle_a", "rad"),
        ("angle_e", "rad"),
        ("angle_b", "rad"),
        ("angle_c", "rad"),
        ("speed_a", "rad/s"),
        ("speed_e", "rad/s"),
        ("speed_b", "rad/s"),
        ("speed_c", "rad/s"),
        ("torque_a", "N·m"),
        ("torque_e", "N·m"),
        ("torque_b", "N·m"),
        ("torque_c", "N·m"),
        ("held_a", ""),
        ("held_e", ""),
        ("held_b", ""),
        ("held_c", ""),
    ]);
    let mut run = 1;
    while let Some(release) = release(layout, run, input)? {
        let samples = release.run().map_err(|error| Error::model(case, error))?;
        let every = libm::round(ROWS_S / release.sample_s) as usize;
        for sample in samples.iter().step_by(every.max(1)) {
            table.push(run, &numbers(sample));
            table.extend(sample.stuck.map(u8::from));
        }
        run += 1;
    }
    Ok(table)
}

fn numbers(sample: &Sample) -> Vec<f64> {
    let mut numbers = vec![sample.time_s];
    numbers.extend(sample.tip_m);
    numbers.extend(sample.joint_angles_rad);
    numbers.extend(sample.joint_rates_rad_s);
    numbers.extend(sample.torques_nm);
    numbers
}

/// The experiment of a run's row; none when the run has no row.
fn release(layout: Layout, run: usize, input: &Table) -> Result<Option<Release>, Error> {
    let Some(start_x) = input.numbers(run, "start_x")?.first().copied() else {
        return Ok(None);
    };
    let one = |column: &str| -> Result<f64, Error> {
        let numbers = input.numbers(run, column)?;
        let first = numbers.first().copied();
        first.ok_or_else(|| Error::Table(format!("run {run} has no `{column}`")))
    };
    let mut locked = None;
    for (joint, column) in Joint::ALL.into_iter().zip(CURRENTS) {
        if one(column)? == GREATEST_CURRENT_A {
            locked = Some(joint);
        }
    }
    Ok(Some(Release {
        layout,
        locked,
        start_m: [start_x, one("start_y")?],
        cylinder_m: [one("cylinder_x")?, one("cylinder_y")?],
        radius_m: one("cylinder_radius")?,
        force_n: one("spring_force")?,
        duration_s: one("longest_duration")?,
        sample_s: one("sample_step")?,
    }))
}
