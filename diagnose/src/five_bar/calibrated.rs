//! This file gives a five-bar's description the numbers of a selection.

use super::diagnose::Stand;
use super::encoder::Encoder;
use super::undone::undone_first;
use crate::evidence::{Intervals, coefficients_by_term, parameters};
use crate::problem::Term;
use crate::select::refs;
use crate::write_rig::{onset, with_interval};
use rigproof_model::effects::facts;
use rigproof_spec::effect::Mechanism;
use rigproof_trace::rig::five_bar::{FiveBar, JointEffect};
use rigproof_trace::rig::{RigEffect, Value};

impl Stand<'_> {
    /// The rig with the numbers of all terms; found effects follow the nominal ones.
    pub(super) fn calibrated(&self, intervals: &Intervals) -> FiveBar {
        let mut rig = self.rig.clone();
        let (_, coefficients) = coefficients_by_term(self.problem, self.selection);
        let terms = refs(&self.selection.nominal, &self.selection.found);
        let (undone, known) = undone_first(self.rig);
        rig.effects = undone;
        let fitted = terms
            .iter()
            .zip(&coefficients)
            .enumerate()
            .map(|(index, (term, own))| {
                if let (Some(given), Some(_)) = (known.get(index), &term.known) {
                    return given.clone();
                }
                let halves = intervals.terms.get(index);
                let count = term.cause.mechanism.parameters().len();
                let values = parameters(term, own).into_iter().take(count).enumerate();
                let values = values
                    .map(|(k, value)| with_interval(value, halves.and_then(|h| h.get(k)).copied()));
                joint_effect(
                    term,
                    term.cause.mechanism,
                    values.collect(),
                    onset(term.onset_s, intervals, index),
                )
            });
        rig.effects.extend(fitted);
        let second = terms.iter().zip(&coefficients);
        rig.effects.extend(second.filter_map(|(term, own)| {
            let mechanism = facts(term.cause.mechanism)?.zero?;
            let mut level = *own.get(1)?;
            if let Some(encoder) = Encoder::of(self.train, term.cause, &term.shape) {
                level = encoder.zero_at_zero_rad([*own.first()?, level]);
            }
            let level = with_interval(level, None);
            Some(joint_effect(
                term,
                mechanism,
                vec![level],
                term.onset_s.map(Value::known),
            ))
        }));
        rig.provenance
            .insert("fit".to_owned(), "weighted windows".to_owned());
        rig
    }
}

fn joint_effect(
    term: &Term,
    mechanism: Mechanism,
    values: Vec<Value>,
    onset: Option<Value>,
) -> JointEffect {
    JointEffect {
        joint: term.cause.joint,
        effect: RigEffect {
            mechanism,
            values,
            onset,
        },
    }
}
