//! This file gives a five-bar's description the numbers of a selection.

use super::encoder::Encoder;
use super::run::joint_at;
use super::undone::undone_first;
use crate::cause::{Place, Scales};
use crate::diagnose::numbers::{fitted, with_interval};
use crate::diagnose::write::Stand;
use crate::evidence::{Intervals, coefficients_by_term};
use crate::problem::Term;
use crate::select::refs;
use rigproof_model::effects::{Form, OfBrake, OfLinkage, facts, form};
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
        let fitted = all
            .zip(&terms)
            .enumerate()
            .flat_map(
                |(index, (effect, term))| match (known.get(index), &term.known) {
                    (Some(given), Some(_)) => vec![given.clone()],
                    _ => self.at_places(term, effect),
                },
            );
        rig.effects.extend(fitted);
        let second = terms.iter().zip(&coefficients);
        let second = second.filter(|(term, _)| !term.cause.is_composed());
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

impl Stand<'_, FiveBar> {
    /// An effect at the joints where it acts: a shared one at every brake. A share of a torque, one axis of a sensor and what the reference rig does
    /// not compute have no place in a description: they are left out of it.
    fn at_places(&self, term: &Term, effect: RigEffect) -> Vec<JointEffect> {
        let unknown = matches!(
            form(term.cause.mechanism),
            Some(
                Form::Brake(OfBrake::TimeConstant | OfBrake::CurrentGain)
                    | Form::Linkage(OfLinkage::PlaneSpring | OfLinkage::LinkLength)
            )
        );
        let at = |joint| JointEffect {
            joint,
            effect: effect.clone(),
        };
        match (term.cause.at, term.cause.scales) {
            _ if unknown => Vec::new(),
            (_, Scales::Torque) | (Place::Axis(_), _) => Vec::new(),
            (Place::Every, _) => {
                let brakes = self.plant.layout.brakes().iter();
                brakes.map(|joint| at(Some(*joint))).collect()
            }
            (place, _) => vec![at(joint_at(place))],
        }
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
