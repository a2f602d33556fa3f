//! This file holds the cases of one brake on the bench: steps, sinusoidal motion and sinusoidal current (chapter 3).

use core::f64::consts::PI;

use rigproof_model::brake::{Brake, torque_gain};
use rigproof_spec::joint::Joint;
use rigproof_spec::tables::torque_gain_fit;
use rigproof_spec::units::rad_s_from_rpm;

use crate::Error;
use crate::case::{Case, Parameter, Run};
use crate::claim::{Claim, Shows};
use crate::table::{RUN, Table};

/// Step in which the brake is run, s.
const STEP_S: f64 = 1e-3;
/// Share of K(I) that a run must reach.
const REACHED: f64 = 0.9;
/// Angle of the shaft at the start, rad.
const START_RAD: f64 = 0.31;

const STEP_CURRENTS_A: [f64; 4] = [0.2, 0.5, 0.8, 1.0];
const STEP_SPEEDS_RPM: [f64; 3] = [0.5, 4.0, 32.0];
/// When the current rises and falls, and the end, s: half the widest backlash, 0.9°, takes 0.3 s at 0.5 rpm, and 1 A there
/// has time constants of up to 0.1 s.
const STEP_TIMES_S: [f64; 3] = [0.35, 0.7, 0.85];

const SINUSOID_HZ: [f64; 2] = [0.25, 1.0];
const SINUSOID_CURRENTS_A: [f64; 2] = [0.5, 1.0];
const CURRENT_HZ: [f64; 2] = [1.0, 4.0];
/// Greatest speed of the sinusoidal motion, and the speed under sinusoidal current, rpm.
const SPEED_RPM: f64 = 10.0;
const PERIODS: f64 = 2.0;

/// The cases of the four brakes.
pub fn cases() -> Vec<Case> {
    let of = |one: fn(Joint) -> Case| Joint::ALL.map(one);
    [of(step), of(sinusoid), of(current)]
        .into_iter()
        .flatten()
        .collect()
}

/// One row of `input.csv`: time, s, current, A, and speed, rad/s; it holds until the time of the next row.
type Row = [f64; 3];

/// A case of one brake; `runs` are what happens, its parameters and its rows, `claims` what each of them must show.
fn case(
    kind: &str,
    joint: Joint,
    purpose: &str,
    citations: &[&'static str],
    rows_s: f64,
    runs: Vec<(String, Vec<Parameter>, Vec<Row>)>,
    must_show: Vec<Claim>,
) -> Case {
    let letter = joint.letter();
    let described = |(what, parameters, _): &(String, Vec<Parameter>, Vec<Row>)| Run {
        what: what.clone(),
        parameters: parameters.clone(),
    };
    let name = format!("brake_{kind}_{}", letter.to_lowercase());
    Case {
        name: name.clone(),
        purpose: format!("Brake {letter} on the bench: {purpose}."),
        citations: citations.to_vec(),
        step_s: STEP_S,
        rows_s,
        parameters: vec![
            Parameter::word("brake", letter),
            Parameter::number(
                "angle at the start, in the middle of the backlash",
                START_RAD,
                "rad",
            ),
            Parameter::number("current before the start", 0.0, "A"),
        ],
        runs: runs.iter().map(described).collect(),
        must_show,
        input: Box::new(move |()| {
            let mut table = Table::new(&[
                (RUN, ""),
                ("time", "s"),
                ("current", "A"),
                ("speed", "rad/s"),
            ]);
            for (index, (_, _, rows)) in runs.iter().enumerate() {
                for row in rows {
                    table.push(index + 1, row);
                }
            }
            Ok(table)
        }),
        expected: Box::new(move |input| turned(joint, rows_s, input)),
    }
}

/// What the brake does along the rows of every run: its state at each time.
fn turned(joint: Joint, rows_s: f64, input: &Table) -> Result<Table, Error> {
    let mut table = Table::new(&[
        (RUN, ""),
        ("time", "s"),
        ("angle", "rad"),
        ("torque", "N·m"),
        ("yield_torque", "N·m"),
        ("inside_backlash", ""),
    ]);
    for run in 1.. {
        let times_s = input.numbers(run, "time")?;
        if times_s.is_empty() {
            break;
        }
        let (currents_a, speeds) = (input.numbers(run, "current")?, input.numbers(run, "speed")?);
        let mut brake = Brake::new(joint, START_RAD);
        let (mut theta_rad, mut torque_nm, mut tick) = (START_RAD, 0.0, 0);
        let every = libm::round(rows_s / STEP_S) as u64;
        let mut write = |tick: u64, theta_rad: f64, torque_nm: f64, brake: &Brake| {
            if tick.is_multiple_of(every) {
                let time_s = tick as f64 * STEP_S;
                table.push(run, &[time_s, theta_rad, torque_nm, brake.yield_torque()]);
                table.extend([u8::from(brake.backlash().is_inside())]);
            }
        };
        write(tick, theta_rad, torque_nm, &brake);
        let held = times_s.iter().skip(1).zip(currents_a.iter().zip(&speeds));
        for (until_s, (current_a, omega_rad_s)) in held {
            while (tick as f64 + 0.5) * STEP_S < *until_s {
                theta_rad += omega_rad_s * STEP_S;
                torque_nm = brake.step(*current_a, theta_rad, *omega_rad_s, STEP_S);
                tick += 1;
                write(tick, theta_rad, torque_nm, &brake);
            }
        }
    }
    Ok(table)
}

fn step(joint: Joint) -> Case {
    let [on_s, off_s, end_s] = STEP_TIMES_S;
    let (mut runs, mut must_show) = (Vec::new(), Vec::new());
    for current_a in STEP_CURRENTS_A {
        for speed_rpm in STEP_SPEEDS_RPM {
            let omega_rad_s = rad_s_from_rpm(speed_rpm);
            let rows = [(0.0, 0.0), (on_s, current_a), (off_s, 0.0), (end_s, 0.0)];
            runs.push((
                format!("{current_a} A at {speed_rpm} rpm"),
                vec![
                    Parameter::number("current", current_a, "A"),
                    Parameter::number("speed", speed_rpm, "rpm"),
                ],
                rows.map(|(time_s, current_a)| [time_s, current_a, omega_rad_s])
                    .into(),
            ));
            must_show.push(Claim::of(
                runs.len(),
                "the torque reaches 90 % of K(I)",
                "torque",
                Shows::Reaches(REACHED * torque_gain(joint, current_a)),
            ));
        }
    }
    must_show.push(Claim::each(
        "the torque falls back to within 0.05 N·m of its off-state value",
        "torque",
        Shows::EndsWithin(torque_gain_fit(joint).off_state_nm() + 0.05),
    ));
    let citations = ["(3.2)", "(3.3)", "(3.5)", "(3.6)", "§3.3.1", "§3.4"];
    let purpose = "torque after steps of current at constant speed, up and down";
    case("step", joint, purpose, &citations, 0.005, runs, must_show)
}

fn sinusoid(joint: Joint) -> Case {
    let hold_s = 0.02;
    let (mut runs, mut must_show) = (Vec::new(), Vec::new());
    for hertz in SINUSOID_HZ {
        for current_a in SINUSOID_CURRENTS_A {
            let greatest = rad_s_from_rpm(SPEED_RPM);
            runs.push((
                format!("{current_a} A at {hertz} Hz"),
                vec![
                    Parameter::number("current", current_a, "A"),
                    Parameter::number("frequency of the motion", hertz, "Hz"),
                    Parameter::number("greatest speed", SPEED_RPM, "rpm"),
                    Parameter::number("speed held for", hold_s, "s"),
                ],
                held(hertz, hold_s, |phase| {
                    [current_a, greatest * libm::cos(phase)]
                }),
            ));
            let nm = REACHED * torque_gain(joint, current_a);
            for (way, nm) in [("forth", nm), ("back", -nm)] {
                let says = format!("the torque reaches 90 % of K(I) on the way {way}");
                must_show.push(Claim::of(runs.len(), says, "torque", Shows::Reaches(nm)));
            }
        }
    }
    must_show.push(Claim::each(
        "the speed changes sign 4 times",
        "speed",
        Shows::SignChanges(4),
    ));
    must_show.push(Claim::each(
        "the torque changes sign 4 times",
        "torque",
        Shows::SignChanges(4),
    ));
    if joint != Joint::A {
        must_show.push(Claim::each(
            "the shaft leaves its backlash and enters it at every turn",
            "inside_backlash",
            Shows::Changes(9),
        ));
    }
    let citations = ["(3.2)", "(3.3)", "(3.6)", "(3.7)", "§3.4.3"];
    let purpose = "torque under constant current while the speed is a sinusoid, through the backlash at every turn";
    case(
        "sinusoid", joint, purpose, &citations, 0.02, runs, must_show,
    )
}

fn current(joint: Joint) -> Case {
    let hold_s = 0.01;
    let runs = CURRENT_HZ.map(|hertz| {
        let omega_rad_s = rad_s_from_rpm(SPEED_RPM);
        (
            format!("0 to 1 A at {hertz} Hz"),
            vec![
                Parameter::number("frequency of the current", hertz, "Hz"),
                Parameter::number("speed", SPEED_RPM, "rpm"),
                Parameter::number("current held for", hold_s, "s"),
            ],
            held(hertz, hold_s, |phase| {
                [0.5 - 0.5 * libm::cos(phase), omega_rad_s]
            }),
        )
    });
    let greatest_nm = torque_gain_fit(joint).greatest_nm();
    let off_state_nm = torque_gain_fit(joint).off_state_nm();
    let must_show = vec![
        Claim::each(
            "the current comes up to 0.95 A",
            "current",
            Shows::Reaches(0.95),
        ),
        Claim::each(
            "the torque reaches 90 % of K(1 A)",
            "torque",
            Shows::Reaches(REACHED * greatest_nm),
        ),
        Claim::each(
            "the torque falls back below a third of K(1 A)",
            "torque",
            Shows::EndsWithin(greatest_nm / 3.0),
        ),
        Claim::each(
            "the torque moves over 90 % of its range",
            "torque",
            Shows::Spans(REACHED * (greatest_nm - off_state_nm)),
        ),
    ];
    let citations = ["(3.2)", "(3.3)", "(3.5)", "(3.6)", "§3.5"];
    let purpose = "torque at constant speed while the current is a sinusoid";
    case(
        "current",
        joint,
        purpose,
        &citations,
        0.01,
        runs.into(),
        must_show,
    )
}

/// Two periods in stairs of `hold_s`, each as high as the function in its middle; the last row ends the run.
fn held(hertz: f64, hold_s: f64, of_phase: impl Fn(f64) -> [f64; 2]) -> Vec<Row> {
    let stairs = libm::round(PERIODS / hertz / hold_s) as u32;
    let row = |index: u32| {
        let phase = 2.0 * PI * hertz * hold_s * (f64::from(index) + 0.5);
        let [current_a, omega_rad_s] = of_phase(phase);
        [hold_s * f64::from(index), current_a, omega_rad_s]
    };
    (0..=stairs).map(row).collect()
}
