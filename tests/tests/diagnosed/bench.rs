//! This file turns the brakes of the golden cases, of the implementation and of the reference, and records them.

use rigproof_impl::plant::brake::{Brake, Characteristic, Turn};
use rigproof_model::brake::Brake as Reference;
use rigproof_spec::joint::Joint;
use rigproof_spec::tables::{BrakeTable, brake_table};

use crate::diagnosed::recording::{Noise, Recording, STEP_S, Turned};
use crate::diagnosed::script::Script;

/// Standard deviation of the torquemeter, N·m.
const TORQUE_NOISE_NM: f64 = 0.0057;

/// Every run of the cases: of the implementation, and of the reference.
pub fn recordings() -> Vec<Recording> {
    let mut recordings = Vec::new();
    for joint in Joint::ALL {
        for kind in ["step", "sinusoid", "current"] {
            let case = format!("brake_{kind}_{}", joint.letter().to_lowercase());
            let script = Script::of(&case);
            for run in script.runs() {
                let own = on_plant(&script, run, &brake_table(joint));
                let reference = on_model(&script, run, joint);
                for (who, torques) in [("impl", own), ("reference", reference)] {
                    let name = format!("{case}-{run}-{who}");
                    recordings.push(recorded(&name, joint, &script, run, &torques));
                }
            }
        }
    }
    recordings
}

/// Currents and angles of a run, a sample a step: the current that acted until then, A, and the angle, rad.
fn turned(script: &Script, run: usize) -> Vec<(f64, f64, f64)> {
    let times_s = script.numbers(run, "time");
    let (currents_a, speeds) = (script.numbers(run, "current"), script.numbers(run, "speed"));
    let mut theta_rad = script.number(run, "angle at the start, in the middle of the backlash");
    let mut way = vec![(currents_a[0], speeds[0], theta_rad)];
    for row in 1..times_s.len() {
        while (way.len() as f64 - 0.5) * STEP_S < times_s[row] {
            theta_rad += speeds[row - 1] * STEP_S;
            way.push((currents_a[row - 1], speeds[row - 1], theta_rad));
        }
    }
    way
}

/// The torques of the implementation's brake with a table, N·m.
pub fn on_plant(script: &Script, run: usize, table: &BrakeTable) -> Vec<f64> {
    let way = turned(script, run);
    let of = Characteristic::new(table);
    let mut brake = Brake::new(table, way[0].2);
    let mut torques = vec![brake.yield_nm() * way[0].1.signum()];
    for pair in way.windows(2) {
        let (current_a, speed_rad_s, to_rad) = pair[1];
        let turn = Turn {
            way_rad: [pair[0].2, to_rad],
            around_s: [0.0, STEP_S],
            speed_rad_s,
            step_s: STEP_S,
        };
        brake.step(&of, current_a, &turn);
        torques.push(brake.yield_nm() * speed_rad_s.signum());
    }
    torques
}

fn on_model(script: &Script, run: usize, joint: Joint) -> Vec<f64> {
    let way = turned(script, run);
    let mut brake = Reference::new(joint, way[0].2);
    let mut torques = vec![brake.yield_torque() * way[0].1.signum()];
    let steps = way.iter().skip(1);
    torques.extend(
        steps.map(|(current_a, speed, theta)| brake.step(*current_a, *theta, *speed, STEP_S)),
    );
    torques
}

/// The recording of a run: counts, current, torque with noise.
pub fn recorded(
    name: &str,
    joint: Joint,
    script: &Script,
    run: usize,
    torques_nm: &[f64],
) -> Recording {
    let noise = Noise::new(
        name.bytes()
            .fold(4127, |seed, b| seed * 31 % 1_000_003 + u64::from(b)),
    );
    let way = turned(script, run);
    let turned = Turned {
        angles_rad: way.iter().map(|(_, _, angle)| *angle).collect(),
        currents_a: way.iter().map(|(current, ..)| *current).collect(),
        torques_nm: torques_nm.to_vec(),
    };
    Recording::of_bench(name.to_owned(), joint, turned, noise, TORQUE_NOISE_NM)
}

/// The sinusoids of an implementation whose brakes have a greater gain than the table's.
pub fn with_gain(gain: f64) -> Vec<Recording> {
    // Brake A has no backlash: at a constant current its gain error is dry friction.
    [Joint::E, Joint::B, Joint::C]
        .into_iter()
        .map(|joint| {
            let case = format!("brake_sinusoid_{}", joint.letter().to_lowercase());
            let script = Script::of(&case);
            let torques = on_plant(&script, 2, &stronger(&brake_table(joint), gain));
            recorded(&format!("{case}-2-gain"), joint, &script, 2, &torques)
        })
        .collect()
}

/// A table whose torque at every current is greater by a factor.
pub fn stronger(table: &BrakeTable, gain: f64) -> BrakeTable {
    let mut table = *table;
    let of = &mut table.torque_gain;
    for k in [
        &mut of.k_1,
        &mut of.k_2,
        &mut of.k_3,
        &mut of.k_4,
        &mut of.k_5,
    ] {
        *k *= gain;
    }
    table
}
