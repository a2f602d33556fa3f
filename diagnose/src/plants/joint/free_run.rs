//! This file refits nominal and found parameters by output error, and measures free runs and
//! prediction horizons.

use crate::effect::Effect;
use crate::filter::rms;
use crate::plants::joint::refit::{Free, error_rms, refit};
use crate::plants::joint::run::{JointRun, PlantKind};
use crate::plants::joint::simulate::{Model, Protocol, predict};
pub use crate::rules::HORIZONS_S;
use crate::rules::{DRIFT_SHARE, HORIZON_STARTS};
use rigproof_model::effects::{facts, linear};
use rigproof_spec::effect::Mechanism;

/// The parameters that a refit may change: an unknown inertia, and those of effects that are not
/// known.
///
/// `known` marks the effects that stay. Shape parameters are free only with `shapes`.
fn free_numbers(plant: &Model, inertia_free: bool, known: &[bool], shapes: bool) -> Vec<Free> {
    let mut free = Vec::new();
    if inertia_free {
        free.push(Free {
            place: None,
            scale: 0.02 * plant.inertia,
        });
    }
    for (index, (effect, known)) in plant.effects.iter().zip(known).enumerate() {
        let linear = linear(effect.mechanism());
        let size = leading_size(plant);
        for (parameter, value) in effect.parameters.iter().enumerate() {
            let is_shape = parameter >= linear;
            if *known || (is_shape && !shapes) {
                continue;
            }
            // A coefficient near zero still needs a step of noticeable size.
            let least = if is_shape {
                0.0
            } else {
                1e-3 * size_of(effect, parameter, size)
            };
            free.push(Free {
                place: Some((index, parameter)),
                scale: (0.02 * value.abs()).max(least).max(1e-12),
            });
        }
    }
    free
}

/// The largest leading coefficient among the plant's efforts: the scale that a small coefficient is
/// compared with.
fn leading_size(plant: &Model) -> f64 {
    let leads = |mechanism| facts(mechanism).is_some_and(|facts| facts.refit.leads);
    let efforts = plant.effects.iter().filter(|e| leads(e.mechanism()));
    efforts
        .filter_map(|e| e.parameters.first())
        .map(|p| p.abs())
        .fold(0.0, f64::max)
}

fn size_of(effect: &Effect, parameter: usize, effort: f64) -> f64 {
    let sizes = facts(effect.mechanism()).map_or(&[][..], |facts| facts.refit.sizes);
    sizes.get(parameter).map_or(0.0, |size| size * effort)
}

/// A refitted plant.
pub struct Shown {
    /// The refitted plant.
    pub plant: Model,
    /// Root-mean-square error of the free run on the fitted part.
    pub train: f64,
    /// The rate of the bias drift, if one was added.
    pub drift: Option<f64>,
}

/// Refits a plant on a recording: the linear parameters first, then the shapes as well.
///
/// With `drift`, a slow bias drift is added to an axis if it removes enough of the error.
pub fn show(
    plant: &Model,
    inertia_free: bool,
    known: &[bool],
    run: &JointRun,
    protocol: &Protocol,
    drift: bool,
) -> Shown {
    let mut best = staged(plant, inertia_free, known, run, protocol);
    let has_drift = plant
        .effects
        .iter()
        .any(|e| e.mechanism() == Mechanism::BiasDrift);
    if !drift || has_drift || run.plant == PlantKind::Bench {
        return best;
    }
    let mut with_drift = plant.clone();
    with_drift
        .effects
        .push(Effect::of(Mechanism::BiasDrift, &[0.0]));
    let mut known = known.to_vec();
    known.push(false);
    let drifting = staged(&with_drift, inertia_free, &known, run, protocol);
    if drifting.train * drifting.train < (1.0 - DRIFT_SHARE) * best.train * best.train {
        let rate = drifting
            .plant
            .effects
            .last()
            .and_then(|e| e.parameters.first().copied());
        best = Shown {
            drift: rate,
            ..drifting
        };
    }
    best
}

fn staged(
    plant: &Model,
    inertia_free: bool,
    known: &[bool],
    run: &JointRun,
    protocol: &Protocol,
) -> Shown {
    let linear = free_numbers(plant, inertia_free, known, false);
    let first = refit(plant, &linear, run, protocol);
    let all = free_numbers(&first.plant, inertia_free, known, true);
    if all.len() == linear.len() {
        return Shown {
            plant: first.plant,
            train: first.error,
            drift: None,
        };
    }
    let second = refit(&first.plant, &all, run, protocol);
    Shown {
        plant: second.plant,
        train: second.error,
        drift: None,
    }
}

/// Root-mean-square position error of predictions over a horizon, started at points spread along
/// the recording. `None` on a bench, or if the recording is too short.
pub fn horizon_error(
    plant: &Model,
    run: &JointRun,
    protocol: &Protocol,
    horizon_s: f64,
) -> Option<f64> {
    let count = (horizon_s / run.step_s).round() as usize;
    if run.plant == PlantKind::Bench || count == 0 || run.len() < 2 * count + HORIZON_STARTS {
        return None;
    }
    let stride = (run.len() - count - 1) / HORIZON_STARTS;
    let errors: Vec<f64> = (0..HORIZON_STARTS)
        .filter_map(|k| {
            let first = k * stride;
            let reached = predict(plant, run, first, count, protocol)?;
            Some(reached - run.motion.get(first + count)?.position)
        })
        .collect();
    Some(rms(&errors))
}

/// The root-mean-square error of the free run, and the standard deviation of the recorded output.
pub fn figure(plant: &Model, run: &JointRun, protocol: &Protocol) -> (f64, f64) {
    let output = match run.plant {
        PlantKind::Axis => &run.position,
        PlantKind::Bench => &run.effort,
    };
    let mean = output.iter().sum::<f64>() / output.len().max(1) as f64;
    let centred: Vec<f64> = output.iter().map(|x| x - mean).collect();
    (error_rms(plant, run, protocol), rms(&centred))
}
