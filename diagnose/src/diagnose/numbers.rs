//! This file formats parameters with their intervals for a calibration and a report.

use crate::cause::Scales;
use crate::evidence::{Intervals, coefficients_by_term, parameters};
use crate::problem::Problem;
use crate::report::Number;
use crate::selection::{Selection, refs};
use rigproof_spec::effect::Motion;
use rigproof_spec::units::Dimension;
use rigproof_trace::rig::{RigEffect, Value};
use std::collections::BTreeMap;

/// A value with a 95 % interval of this half width, if that is finite.
pub(crate) fn with_interval(value: f64, half: Option<f64>) -> Value {
    let mut out = Value::unknown(value);
    if let Some(half) = half.filter(|h| h.is_finite()) {
        out.low95 = Some(value - half);
        out.high95 = Some(value + half);
    }
    out
}

/// An effect whose intervals end where its parameters do: a width or a time is not below 0, and a
/// part is at most 1.
pub(crate) fn within_ranges(mut effect: RigEffect) -> RigEffect {
    let parameters = effect.mechanism.parameters().iter();
    for (parameter, value) in parameters.zip(&mut effect.values) {
        let [least, most] = parameter.range.ends();
        value.low95 = value.low95.map(|low| low.max(least).min(value.value));
        value.high95 = value.high95.map(|high| high.min(most).max(value.value));
    }
    effect
}

/// The onset of a term with its interval.
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

/// The effects of a selection with the parameters of the weak form, nominal ones first.
pub(crate) fn fitted(
    problem: &Problem,
    selection: &Selection,
    intervals: &Intervals,
) -> Vec<RigEffect> {
    let (_, coefficients) = coefficients_by_term(problem, selection);
    let terms = refs(&selection.nominal, &selection.found);
    let terms = terms.iter().zip(&coefficients).enumerate();
    terms
        .map(|(index, (term, own))| {
            let mechanism = term.cause.mechanism;
            let halves = intervals.terms.get(index);
            let values = parameters(problem, term, own).into_iter().enumerate();
            let values = values.take(mechanism.parameters().len());
            within_ranges(RigEffect {
                mechanism,
                values: values
                    .map(|(k, value)| with_interval(value, halves.and_then(|h| h.get(k)).copied()))
                    .collect(),
                onset: onset(term.onset_s, intervals, index),
                of_torque: term.cause.scales == Scales::Torque,
            })
        })
        .collect()
}

/// An effect's parameters as the report prints them.
pub fn numbers(
    effect: &RigEffect,
    (motion, driving): (Motion, Dimension),
) -> BTreeMap<String, Number> {
    let parameters = effect.mechanism.parameters().iter().zip(&effect.values);
    parameters
        .map(|(parameter, value)| {
            (
                parameter.name.to_owned(),
                number(value, effect.driven(parameter, motion, driving).to_string()),
            )
        })
        .collect()
}

pub(crate) fn number(value: &Value, unit: String) -> Number {
    Number {
        value: value.value,
        unit,
        low95: value.low95,
        high95: value.high95,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rigproof_spec::effect::Mechanism;

    #[test]
    fn an_interval_ends_where_its_parameter_does() {
        let effect = |mechanism, values: &[f64]| {
            let values = values.iter().map(|value| with_interval(*value, Some(0.3)));
            within_ranges(RigEffect {
                mechanism,
                values: values.collect(),
                onset: None,
                of_torque: false,
            })
        };
        let ends = |own: &RigEffect, k: usize| [own.values[k].low95, own.values[k].high95];
        let lag = effect(Mechanism::Lag, &[0.1]);
        assert_eq!(ends(&lag, 0), [Some(0.0), Some(0.4)]);
        let spring = effect(Mechanism::Spring, &[0.1]);
        assert_eq!(ends(&spring, 0), [Some(0.1 - 0.3), Some(0.4)]);
    }

    #[test]
    fn an_interval_is_written_where_the_recording_gives_one() {
        let value = with_interval(3.7, Some(0.19));
        assert!((value.low95.unwrap() - 3.51).abs() < 1e-12);
        assert!((value.high95.unwrap() - 3.89).abs() < 1e-12);
        assert_eq!(with_interval(3.7, Some(f64::NAN)).low95, None);
        assert_eq!(with_interval(3.7, None).high95, None);
    }
}
