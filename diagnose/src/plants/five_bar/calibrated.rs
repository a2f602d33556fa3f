//! This file writes a calibration: the five-bar's description with the fitted parameters and the
//! found effects.

use super::encoder::Encoder;
use super::run::joint_at;
use super::undone::undone_first;
use crate::cause::{Cause, Place, Scales};
use crate::diagnose::numbers::{fitted, with_interval};
use crate::diagnose::write::Stand;
use crate::evidence::{Intervals, coefficients_by_term};
use crate::problem::Term;
use crate::selection::refs;
use rigproof_model::effects::facts;
use rigproof_spec::effect::Mechanism;
use rigproof_trace::rig::five_bar::{FiveBar, JointEffect};
use rigproof_trace::rig::{RigEffect, Value};

impl Stand<'_, FiveBar> {
    /// The rig with the parameters of all terms. Found effects follow the nominal ones.
    pub(super) fn with_numbers(&self, intervals: &Intervals) -> FiveBar {
        let mut rig = self.plant.clone();
        let (_, coefficients) = coefficients_by_term(self.problem, self.selection);
        let terms = refs(&self.selection.nominal, &self.selection.found);
        let (undone, known) = undone_first(self.plant);
        rig.effects = undone;
        let all = fitted(self.problem, self.selection, intervals).into_iter();
        let fitted = all
            .zip(&terms)
            .enumerate()
            .flat_map(
                |(index, (effect, term))| match (known.get(index), &term.known) {
                    (Some(given), Some(_)) => vec![given.clone()],
                    _ => self.at_places(term.cause, effect),
                },
            );
        rig.effects.extend(fitted);
        let second = terms.iter().zip(&coefficients);
        let second = second.filter_map(|(term, own)| {
            let (mechanism, level) = match Encoder::of(self.train, term.cause, &term.shape) {
                Some(encoder) => (Mechanism::EncoderOffset, encoder.zero_rad(own)?),
                None => (facts(term.cause.mechanism)?.zero?, second_level(term, own)?),
            };
            let effect = RigEffect {
                mechanism,
                values: vec![with_interval(level, None)],
                onset: term.onset_s.map(Value::known),
                of_torque: false,
            };
            // Another law whose zero is fitted is written as two effects.
            let cause = Cause::at(mechanism, term.cause.at);
            Some(self.at_places(cause, effect))
        });
        rig.effects.extend(second.flatten());
        rig.provenance
            .insert("fit".to_owned(), "weighted windows".to_owned());
        rig
    }
}

/// The level of a term's zero. A spring states its place of rest itself, unless only its force is
/// determined.
fn second_level(term: &Term, own: &[f64]) -> Option<f64> {
    let [size, level] = *own.get(..2)? else {
        return None;
    };
    (term.cause.mechanism.parameters().len() == 1 || size == 0.0).then_some(level)
}

impl Stand<'_, FiveBar> {
    /// An effect at each joint where it acts: at every brake if the brakes share it.
    fn at_places(&self, cause: Cause, effect: RigEffect) -> Vec<JointEffect> {
        let at = |joint| JointEffect {
            joint,
            axis: match cause.at {
                Place::Axis(axis) => Some(axis),
                _ => None,
            },
            effect: RigEffect {
                of_torque: cause.scales == Scales::Torque,
                ..effect.clone()
            },
        };
        match cause.at {
            Place::Every => {
                let brakes = self.plant.layout.brakes().iter();
                brakes.map(|joint| at(Some(*joint))).collect()
            }
            place => vec![at(joint_at(place))],
        }
    }
}
