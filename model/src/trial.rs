//! This file runs a rig, a controller and a hand together, tick by tick: the loop of figure 6.1 and of §6.5.1.

use nalgebra::Vector2;
use rigproof_spec::command::Command;
use rigproof_spec::layout::Layout;
use rigproof_spec::methods::{Method, SAMPLE_STEP_S};

use crate::control::path::{Line, Path};
use crate::control::{Actuation, Controller, GainUnit, Sensed, controller};
use crate::error::ModelError;
use crate::metrics::{average_tip_force, path_error, smoothness};
use crate::operator::{Abilities, Hand, Operator};
use crate::rig::Rig;

/// What happened in a run, a sample a tick: the state at its start, the force and the command over it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Record {
    /// The tip, x and y, m.
    pub tips_m: Vec<[f64; 2]>,
    /// The tip's velocity, x and y, m/s.
    pub velocities_m_s: Vec<[f64; 2]>,
    /// The hand's force on the tip, x and y, N.
    pub forces_n: Vec<[f64; 2]>,
    /// What the controller asked for.
    pub commands: Vec<Command>,
    /// Whether the end of the line was reached in time.
    pub arrived: bool,
}

/// A line segment to be followed, from and to, x and y, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment {
    /// Where it starts.
    pub from_m: [f64; 2],
    /// Where it ends.
    pub to_m: [f64; 2],
}

/// Two lines that lie in the workspace of both layouts; those of figure 6.11 are lost (decision 0047).
pub const LINES: [Segment; 2] = [
    Segment {
        from_m: [-0.11, 0.38],
        to_m: [0.11, 0.38],
    },
    Segment {
        from_m: [-0.08, 0.29],
        to_m: [0.09, 0.43],
    },
];

/// The three metrics of a run (§6.5.2).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Metrics {
    /// Average path error (6.14), m.
    pub path_error_m: f64,
    /// Average tip force (6.16b), N.
    pub tip_force_n: f64,
    /// DFT sum of acceleration (6.20), m/s³.
    pub dft_sum_m_s3: f64,
}

impl Record {
    /// The metrics of the run against a path.
    ///
    /// # Errors
    /// Those of [`path_error`], [`average_tip_force`] and [`smoothness`].
    pub fn metrics(&self, path: &impl Path) -> Result<Metrics, ModelError> {
        Ok(Metrics {
            path_error_m: path_error(path, &self.tips_m)?,
            tip_force_n: average_tip_force(&self.forces_n, SAMPLE_STEP_S)?,
            dft_sum_m_s3: smoothness(&self.tips_m, SAMPLE_STEP_S)?,
        })
    }
}

/// Runs rig, controller and hand at 1000 Hz until `ended` or for `longest_s`.
///
/// The controller is told the true pose, velocities and force of the start of the tick; its currents and the force hold
/// over the tick (decision 0047).
///
/// # Errors
/// Those of [`Rig::step`].
pub fn run(
    rig: &mut Rig,
    controller: &mut dyn Controller,
    hand: &mut dyn Hand,
    longest_s: f64,
    ended: impl Fn([f64; 2]) -> bool,
) -> Result<Record, ModelError> {
    let mut record = Record::default();
    let ticks = libm::round(longest_s / SAMPLE_STEP_S) as u64;
    for _ in 0..ticks {
        let (tip_m, tip_velocity_m_s) = (rig.tip_m(), rig.tip_velocity_m_s());
        if ended(tip_m) {
            record.arrived = true;
            break;
        }
        let tip_force_n = hand.push(tip_m, tip_velocity_m_s, SAMPLE_STEP_S);
        let sensed = Sensed {
            pose: *rig.pose(),
            tip_velocity_m_s,
            omega_rad_s: rig.joint_rates_rad_s(),
            tip_force_n,
        };
        let command = controller.command(&sensed);
        record.tips_m.push(tip_m);
        record.velocities_m_s.push(tip_velocity_m_s);
        record.forces_n.push(tip_force_n);
        record.commands.push(command);
        rig.step(tip_force_n, command.currents_a, SAMPLE_STEP_S)?;
    }
    Ok(record)
}

/// One trial of the human-subject experiment with a simulated operator: one method on one line and layout (§6.5.1).
///
/// The tip starts at rest at the start of the line; the trial ends when the tip is past the line's end, or after 20 s.
///
/// # Errors
/// [`ModelError::PathPiece`] for a line without length; those of [`Operator::new`], [`Rig::new`] and [`Rig::step`].
pub fn trial(
    layout: Layout,
    method: Method,
    gain_unit: GainUnit,
    segment: Segment,
    abilities: Abilities,
    seed: u64,
) -> Result<Record, ModelError> {
    let line = Line::through(segment.from_m, segment.to_m)?;
    let mut controller = controller(method, gain_unit, Actuation::thesis(layout), line)?;
    let mut operator = Operator::new(line, abilities, seed)?;
    let mut rig = Rig::new(layout, segment.from_m)?;
    let (from_m, to_m) = (Vector2::from(segment.from_m), Vector2::from(segment.to_m));
    let past_end = |tip_m: [f64; 2]| (Vector2::from(tip_m) - to_m).dot(&(to_m - from_m)) >= 0.0;
    run(&mut rig, &mut *controller, &mut operator, 20.0, past_end)
}
