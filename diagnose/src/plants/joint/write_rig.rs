//! This file writes what was found as a rig description: the calibration that a simulation can read.

use super::simulate::Model;
use crate::diagnose::numbers::{number, numbers, onset, with_interval};
use crate::evidence::Intervals;
use crate::report::Number;
use rigproof_trace::rig::{Rig, RigEffect, Status};
use std::collections::BTreeMap;

/// The rig with a model's numbers and their intervals; found effects follow the nominal ones.
pub fn calibrated(rig: &Rig, model: &Model, intervals: &Intervals, refitted: bool) -> Rig {
    let mut out = rig.clone();
    if let Some(parameters) = &mut out.parameters
        && parameters.inertia.status != Status::Known
    {
        parameters.inertia = with_interval(model.inertia, intervals.nuisances.first().copied());
    }
    out.effects = model
        .effects
        .iter()
        .enumerate()
        .map(|(index, effect)| {
            let given = rig.effects.get(index);
            let halves = intervals.terms.get(index);
            let values = effect.parameters.iter().enumerate().map(|(k, &value)| {
                match given.and_then(|g| g.values.get(k)) {
                    Some(known) if known.status == Status::Known => *known,
                    _ => with_interval(value, halves.and_then(|h| h.get(k)).copied()),
                }
            });
            RigEffect {
                mechanism: effect.mechanism(),
                values: values.collect(),
                onset: onset(effect.onset_s, intervals, index),
            }
        })
        .collect();
    let how = if refitted {
        "output-error refit of free runs; intervals from the weighted windows"
    } else {
        "weighted windows"
    };
    out.provenance.insert("fit".to_owned(), how.to_owned());
    out
}

/// The nominal model's own numbers after the fit, `mechanism.parameter` by name, the inertia as `inertia`.
pub fn nominal_numbers(rig: &Rig, calibration: &Rig) -> BTreeMap<String, Number> {
    let mut out = BTreeMap::new();
    if let Some(parameters) = &calibration.parameters {
        let unit = rigproof_spec::effect::Quantity::Inertia
            .dimension(rig.motion)
            .to_string();
        out.insert("inertia".to_owned(), number(&parameters.inertia, unit));
    }
    for effect in calibration.effects.iter().take(rig.effects.len()) {
        for (name, number) in numbers(effect, rig.motion) {
            out.insert(format!("{}.{name}", effect.mechanism.name()), number);
        }
    }
    out
}
