//! This file writes what was found as a rig description: the calibration that a simulation can read.

use crate::evidence::Intervals;
use crate::plants::joint::simulate::Plant;
use crate::report::Number;
use rigproof_spec::effect::Motion;
use rigproof_trace::rig::{Rig, RigEffect, Status, Value};
use std::collections::BTreeMap;

/// The rig with the plant's numbers and their intervals; found effects follow the nominal ones.
pub fn calibrated(rig: &Rig, plant: &Plant, intervals: &Intervals, refitted: bool) -> Rig {
    let mut out = rig.clone();
    if let Some(parameters) = &mut out.parameters
        && parameters.inertia.status != Status::Known
    {
        parameters.inertia = with_interval(plant.inertia, intervals.nuisances.first().copied());
    }
    out.effects = plant
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
                mechanism: effect.mechanism,
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

/// A value with a 95 % interval of this half width, where it is a number.
pub(crate) fn with_interval(value: f64, half: Option<f64>) -> Value {
    let mut out = Value::unknown(value);
    if let Some(half) = half.filter(|h| h.is_finite()) {
        out.low95 = Some(value - half);
        out.high95 = Some(value + half);
    }
    out
}

/// The onset of a term, which no fit touches, with its interval.
pub(crate) fn onset(onset_s: Option<f64>, intervals: &Intervals, index: usize) -> Option<Value> {
    let [low95, high95] = match intervals.onsets.get(index) {
        Some(Some(ends)) => ends.map(Some),
        _ => [None; 2],
    };
    onset_s.map(|onset_s| Value {
        low95,
        high95,
        ..Value::known(onset_s)
    })
}

/// An effect's parameters as the report prints them.
pub fn numbers(effect: &RigEffect, motion: Motion) -> BTreeMap<String, Number> {
    let parameters = effect.mechanism.parameters().iter().zip(&effect.values);
    parameters
        .map(|(parameter, value)| {
            (
                parameter.name.to_owned(),
                number(value, parameter.quantity.dimension(motion).to_string()),
            )
        })
        .collect()
}

fn number(value: &Value, unit: String) -> Number {
    Number {
        value: value.value,
        unit,
        low95: value.low95,
        high95: value.high95,
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_interval_is_written_where_the_recording_gives_one() {
        let value = with_interval(3.7, Some(0.19));
        assert!((value.low95.unwrap() - 3.51).abs() < 1e-12);
        assert!((value.high95.unwrap() - 3.89).abs() < 1e-12);
        assert_eq!(with_interval(3.7, Some(f64::NAN)).low95, None);
        assert_eq!(with_interval(3.7, None).high95, None);
    }
}
