//! This file runs the simulations of §6.4: a constant push along the line y = 38 cm and towards it.

use rigproof_model::ModelError;
use rigproof_model::brake::torque_gain;
use rigproof_model::control::force_limit::force_magnitude;
use rigproof_model::control::path::Line;
use rigproof_model::control::{Actuation, GainUnit, controller};
use rigproof_model::linkage::inverse;
use rigproof_model::linkage::jacobian::jacobian;
use rigproof_model::operator::ConstantPush;
use rigproof_model::rig::Rig;
use rigproof_model::trial::{Record, run};
use rigproof_spec::command::Reason;
use rigproof_spec::geometry::arms;
use rigproof_spec::layout::Layout;
use rigproof_spec::methods::{Method, SAMPLE_STEP_S, greatest_desired_force_n};
use rigproof_spec::tables::GREATEST_CURRENT_A;

use crate::Error;
use crate::outline::cm;

/// The line, the start 4 cm below it, and the push (§6.4).
const HEIGHT_M: f64 = 0.38;
const START_M: [f64; 2] = [-0.15, 0.34];
const PUSH_N: [f64; 2] = [7.0, 3.0];
/// Where the run ends, and from where on the path counts as reached, m (gap `proof-of-concept-start`).
const END_M: f64 = 0.15;
const REACHED_M: f64 = 0.05;

/// One simulation with what it is judged by.
pub struct Proof {
    pub record: Record,
    /// Average path error (6.14) over the whole run, cm.
    pub error_cm: f64,
    /// Average distance from the path over the last third, cm.
    pub late_cm: f64,
    /// Share of the commands to a brake that ask for the greatest force.
    pub full: f64,
    /// Changes from one brake, or none, to another a second.
    pub switches_hz: f64,
}

/// The desired path.
pub fn line() -> Result<Line, Error> {
    Line::through([-0.3, HEIGHT_M], [0.3, HEIGHT_M])
        .map_err(|error| Error::model("the line of §6.4", error))
}

/// Runs one method on one layout.
pub fn proof(layout: Layout, method: Method, unit: GainUnit) -> Result<Proof, Error> {
    let refused = |error| Error::model("the simulation of §6.4", error);
    let line = line()?;
    let mut controller =
        controller(method, unit, Actuation::thesis(layout), line).map_err(refused)?;
    let mut rig = Rig::new(layout, START_M).map_err(refused)?;
    let mut push = ConstantPush(PUSH_N);
    let ended = |[x, _]: [f64; 2]| x > END_M;
    let record = run(&mut rig, &mut *controller, &mut push, 6.0, ended).map_err(refused)?;
    if !record.arrived {
        let problem = format!("{method:?} on {layout:?} does not reach x = {END_M} m in 6 s");
        return Err(Error::model("the simulation of §6.4", problem));
    }
    let metrics = record.metrics(&line).map_err(refused)?;
    let late = record.tips_m.iter().filter(|[x, _]| *x > REACHED_M);
    let (sum_m, count) = late.fold((0.0, 0.0), |(sum, n), [_, y]| {
        (sum + (y - HEIGHT_M).abs(), n + 1.0)
    });
    let next = record.commands.iter().skip(1);
    let pairs = record.commands.iter().zip(next);
    let switches = pairs.filter(|(a, b)| a.reason != b.reason).count();
    let full = full_force(layout, &record).map_err(refused)?;
    Ok(Proof {
        full,
        error_cm: cm(metrics.path_error_m),
        late_cm: cm(sum_m / count),
        switches_hz: switches as f64 / (SAMPLE_STEP_S * record.tips_m.len() as f64),
        record,
    })
}

/// Share of the commands to one brake that ask for the greatest force of §6.1.2, or for the brake's own greatest.
fn full_force(layout: Layout, record: &Record) -> Result<f64, ModelError> {
    let (arms, greatest_n) = (arms(layout), greatest_desired_force_n(layout));
    let (mut full, mut chosen) = (0_u32, 0_u32);
    for (tip_m, command) in record.tips_m.iter().zip(&record.commands) {
        let Reason::Chosen(joint) = command.reason else {
            continue;
        };
        let j = jacobian(&arms, &inverse::pose(&arms, *tip_m)?)?;
        let current_a = command.currents_a.get(joint as usize).copied();
        let current_a = current_a.unwrap_or(0.0);
        let row = j.row(joint as usize).transpose();
        let force_n = force_magnitude(row, torque_gain(joint, current_a));
        chosen += 1;
        full += u32::from(current_a >= GREATEST_CURRENT_A || force_n > 0.999 * greatest_n);
    }
    Ok(f64::from(full) / f64::from(chosen))
}
