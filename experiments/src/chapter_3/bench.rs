//! This file turns one brake on the bench, as the motor of §3.2 did, and writes down what the torquemeter would show.

use rigproof_model::brake::Brake;
use rigproof_spec::joint::Joint;

use crate::{Column, Table};

/// Sample time of the bench here, s; the text does not give its own.
pub const SAMPLE_S: f64 = 1e-3;

/// What the bench does at a time: current, A, angle, rad, and speed, rad/s.
#[derive(Clone, Copy, Debug)]
pub struct Command {
    pub current_a: f64,
    pub theta_rad: f64,
    pub omega_rad_s: f64,
}

/// What was recorded, one value a sample.
#[derive(Clone, Debug, Default)]
pub struct Recorded {
    pub time_s: Vec<f64>,
    pub current_a: Vec<f64>,
    pub theta_rad: Vec<f64>,
    pub omega_rad_s: Vec<f64>,
    pub torque_nm: Vec<f64>,
}

/// Turns the brake for `duration_s` along an imposed motion and current; the brake starts settled and without current.
pub fn turn(joint: Joint, duration_s: f64, command: impl Fn(f64) -> Command) -> Recorded {
    let mut brake = Brake::new(joint, command(0.0).theta_rad);
    let mut recorded = Recorded::default();
    for sample in 1..=(duration_s / SAMPLE_S).round() as u32 {
        let time_s = SAMPLE_S * f64::from(sample);
        let now = command(time_s);
        let torque_nm = brake.step(now.current_a, now.theta_rad, now.omega_rad_s, SAMPLE_S);
        recorded.time_s.push(time_s);
        recorded.current_a.push(now.current_a);
        recorded.theta_rad.push(now.theta_rad);
        recorded.omega_rad_s.push(now.omega_rad_s);
        recorded.torque_nm.push(torque_nm);
    }
    recorded
}

impl Recorded {
    /// The run as a table.
    pub fn table(&self, name: &str) -> Table {
        Table::run(
            name,
            &self.time_s,
            vec![
                Column::numbers("current", "A", &self.current_a),
                Column::numbers("position", "rad", &self.theta_rad),
                Column::numbers("speed", "rad/s", &self.omega_rad_s),
                Column::numbers("torque", "N·m", &self.torque_nm),
            ],
        )
    }
}

/// The same for every brake, as text: `A 6.44, E 5.05, …`.
pub fn each(text: impl Fn(Joint) -> String) -> String {
    let of = |joint: Joint| format!("{} {}", joint.letter(), text(joint));
    Joint::ALL.map(of).join(", ")
}

/// A file's or curve's name for a brake.
pub fn name(joint: Joint) -> String {
    format!("brake-{}", joint.letter().to_lowercase())
}
