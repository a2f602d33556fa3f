//! This file gives a five-bar's description the numbers of a selection.

use super::encoder::Encoder;
use super::run::joint_at;
use super::undone::undone_first;
use crate::diagnose::numbers::{fitted, with_interval};
use crate::diagnose::write::Stand;
use crate::evidence::{Intervals, coefficients_by_term};
use crate::problem::Term;
use crate::select::refs;
use rigproof_model::effects::facts;
use rigproof_spec::effect::Mechanism;
use rigproof_trace::rig::five_bar::{FiveBar, JointEffect};
use rigproof_trace::rig::{RigEffect, Value};

impl Stand<'_, FiveBar> {
    /// The rig with the numbers of all terms; found effects follow the nominal ones.
    pub(super) fn with_numbers(&self, intervals: &Intervals) -> FiveBar {
        let mut rig = self.plant.clone();
        let (_, coefficients) = coefficients_by_term(self.problem, self.selection);
        let terms = refs(&self.selection.nominal, &self.selection.found);
        let (undone, known) = undone_first(self.plant);
        rig.effects = undone;
        let all = fitted(self.problem, self.selection, intervals).into_iter();
        let fitted = all.zip(&terms).enumerate().map(|(index, (effect, term))| {
            match (known.get(index), &term.known) {
                (Some(given), Some(_)) => given.clone(),
                _ => JointEffect {
                    joint: joint_at(term.cause.at),
                    effect,
                },
            }
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
        joint: joint_at(term.cause.at),
        effect: RigEffect {
            mechanism,
            values,
            onset,
        },
    }
}
