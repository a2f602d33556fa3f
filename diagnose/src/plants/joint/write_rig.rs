//! This file writes a calibration: the rig description with the fitted parameters and the found
//! effects.

use super::from_rig::nominal;
use super::simulate::Model;
use super::undone::is_undone;
use crate::cause::Scales;
use crate::diagnose::numbers::{number, numbers, onset, with_interval, within_ranges};
use crate::evidence::Intervals;
use crate::report::Number;
use crate::selection::Selection;
use rigproof_spec::effect::Mechanism;
use rigproof_trace::rig::{Rig, RigEffect, Status};
use std::collections::BTreeMap;

/// The rig with a model's parameters and intervals. Found effects follow the nominal ones.
pub fn calibrated(rig: &Rig, model: &Model, intervals: &Intervals, refitted: bool) -> Rig {
    let mut out = rig.clone();
    if let Some(parameters) = &mut out.parameters
        && parameters.inertia.status != Status::Known
    {
        parameters.inertia = with_interval(model.inertia, intervals.nuisances.first().copied());
    }
    let written = |index: usize, given: Option<&RigEffect>| {
        let effect = model.effects.get(index)?;
        let halves = intervals.terms.get(index);
        let values = effect.parameters.iter().enumerate().map(|(k, &value)| {
            match given.and_then(|g| g.values.get(k)) {
                Some(known) if known.status == Status::Known => *known,
                _ => with_interval(value, halves.and_then(|h| h.get(k)).copied()),
            }
        });
        Some(within_ranges(RigEffect {
            mechanism: effect.mechanism(),
            values: values.collect(),
            onset: onset(effect.onset_s, intervals, index),
            of_torque: effect.cause.scales == Scales::Torque,
        }))
    };
    // Effects that were inverted before the fit stay as described. Every other described effect has
    // its place in the model.
    let mut fitted = 0..model.described;
    let described = rig.effects.iter().zip(nominal(rig));
    out.effects = described
        .map(|(given, own)| match is_undone(&own) {
            true => given.clone(),
            false => {
                let own = fitted.next().and_then(|index| written(index, Some(given)));
                own.filter(|own| own.mechanism == given.mechanism)
                    .unwrap_or_else(|| given.clone())
            }
        })
        .collect();
    let mut found: Vec<RigEffect> = (model.described..model.effects.len())
        .filter_map(|index| written(index, None))
        .collect();
    // A fade acts on the effects before it, so it comes last.
    found.sort_by_key(|own| own.mechanism != Mechanism::FrictionFade);
    out.effects.extend(found);
    let how = if refitted {
        "output-error refit of free runs; intervals from the weighted windows"
    } else {
        "weighted windows"
    };
    out.provenance.insert("fit".to_owned(), how.to_owned());
    out
}

/// The found effects of a calibration, in the order of the names. They are matched by mechanism and
/// onset.
pub(super) fn found_in(
    effects: &[RigEffect],
    described: usize,
    selection: &Selection,
) -> Vec<RigEffect> {
    let mut left: Vec<&RigEffect> = effects.iter().skip(described).collect();
    let names = selection.found.iter();
    let own = names.filter_map(|name| {
        let onset_s = name.term.onset_s;
        let is_own = |own: &&RigEffect| {
            own.mechanism == name.term.cause.mechanism && own.onset.map(|o| o.value) == onset_s
        };
        // One that is found twice, with two periods, is listed twice.
        let place = left.iter().position(is_own)?;
        Some(left.remove(place).clone())
    });
    own.collect()
}

/// The fitted parameters of the nominal model by the name `mechanism.parameter`; the inertia is
/// `inertia`.
pub fn nominal_numbers(rig: &Rig, calibration: &Rig) -> BTreeMap<String, Number> {
    let mut out = BTreeMap::new();
    if let Some(parameters) = &calibration.parameters {
        let unit = rigproof_spec::effect::Quantity::Inertia
            .dimension(rig.motion)
            .to_string();
        out.insert("inertia".to_owned(), number(&parameters.inertia, unit));
    }
    for effect in calibration.effects.iter().take(rig.effects.len()) {
        for (name, number) in numbers(effect, (rig.motion, rig.driving())) {
            out.insert(format!("{}.{name}", effect.mechanism.name()), number);
        }
    }
    out
}
