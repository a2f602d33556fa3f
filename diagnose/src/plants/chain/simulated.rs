//! This file simulates an arm by inverse dynamics: the effort that each joint takes along a recorded
//! motion.

use super::align::{aligned, lasting};
use super::run::{ChainRun, joint_at};
use crate::effect::Effect;
use crate::plant::{Columns, Plant, Run, Simulated, SimulatedOutput, Unsimulated};
use crate::signals::shifted;
use rigproof_model::effects::{Drive, Form, entry, form};
use rigproof_spec::effect::Quantity;
use rigproof_trace::rig::chain::{ChainRecording, ChainRig};

/// The efforts of a model beside the recorded ones, N·m or N, an output a joint in the arm's order.
///
/// # Errors
/// The recording is faulty, or the description holds an effect that no joint of an arm can have.
pub(super) fn simulated(
    model: &ChainRig,
    recording: &ChainRecording,
) -> Result<Simulated, Unsimulated> {
    let run = aligned(model, recording).map_err(Unsimulated::Recording)?;
    let mut efforts = run.known();
    let effects = model.nominal();
    for effect in effects.iter().filter(|own| !is_late(own)) {
        let own = taken(&run, effect).ok_or_else(|| unknown(effect))?;
        efforts.iter_mut().zip(own).for_each(|(sum, x)| *sum += x);
    }
    for effect in effects.iter().filter(|own| is_late(own)) {
        delay(&run, effect, &mut efforts);
    }
    let samples = run.len().max(1);
    let recorded = run.effort();
    let each = efforts.chunks(samples).zip(recorded.chunks(samples));
    let outputs = each.enumerate().map(|(output, (own, recorded))| {
        let name = run.output_name(output);
        SimulatedOutput {
            name: lasting(&format!("effort_{name}")),
            unit: Quantity::Effort
                .dimension(model.motion_at(name))
                .to_string(),
            recorded: Some(recorded.to_vec()),
            simulated: own.to_vec(),
            counts: run.recorded.clone(),
        }
    });
    Ok(Simulated {
        outputs: outputs.collect(),
        time_s: (0..run.len())
            .map(|k| run.start_s + k as f64 * run.step_s)
            .collect(),
        runs: None,
    })
}

fn is_late(effect: &Effect) -> bool {
    matches!(form(effect.cause.mechanism), Some(Form::Drive(Drive::Skew)))
}

fn unknown(effect: &Effect) -> Unsimulated {
    Unsimulated::Model(format!(
        "`{}` is no effect of an arm's joint that can be simulated; take it out",
        effect.cause.mechanism.name()
    ))
}

/// The effort that an effect adds to the joints.
fn taken(run: &ChainRun, effect: &Effect) -> Option<Vec<f64>> {
    let mechanism = effect.cause.mechanism;
    let (linear, shape) = effect
        .parameters
        .split_at_checked(entry(mechanism)?.linear)?;
    let mut sum = match run.columns(effect.cause, shape, None)? {
        Columns::Fixed(signal) => signal,
        Columns::Free(signals) => {
            let mut sum = vec![0.0; run.effort.len()];
            for (signal, own) in signals.iter().zip(run.coefficients(mechanism, linear)) {
                sum.iter_mut().zip(signal).for_each(|(s, x)| *s += own * x);
            }
            sum
        }
        _ => return None,
    };
    let samples = run.len().max(1);
    let begins = |k: usize| run.start_s + (k % samples) as f64 * run.step_s;
    if let Some(onset_s) = effect.onset_s {
        let late = sum.iter_mut().enumerate();
        late.filter(|(k, _)| begins(*k) < onset_s)
            .for_each(|(_, x)| *x = 0.0);
    }
    Some(sum)
}

/// Shifts the efforts that a delayed channel shows to when they are recorded. Before the first
/// sample they stand still.
fn delay(run: &ChainRun, effect: &Effect, efforts: &mut [f64]) {
    let late = effect.parameters.first().copied().unwrap_or(0.0) / run.step_s;
    let place = joint_at(effect.cause.at).and_then(|place| run.places.get(place));
    let shows = place.iter().flat_map(|own| &own.rows);
    for (row, _) in shows.filter(|(_, sign)| *sign > 0.0) {
        if let Some(own) = efforts.chunks_mut(run.len().max(1)).nth(*row) {
            let moved = shifted(own, -late);
            own.copy_from_slice(&moved);
        }
    }
}
