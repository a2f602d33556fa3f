//! This file says which physics, left out of the thesis's model, a rig can be given, and reads it into terms.

use std::sync::Arc;

use rigproof_spec::effect::{Mechanism, Range};
use rigproof_spec::joint::Joint;

use super::left_out::{LeftOut, Term, Timed};
use super::{Parameters, Rig};
use crate::effects::facts::AtRest;
use crate::effects::{
    CurrentPlay, Drive, Form, OfBrake, OfLinkage, facts, form, law_of_torque, slower,
};
use crate::error::ModelError;
use crate::motion::two_coordinate::two_coordinate;
use crate::motion::{added_mass, check_inertia};
use rigproof_spec::tables::BrakeTable;
use rigproof_spec::units::deg_from_rad;

/// Physics that a rig has beyond the thesis's: a mechanism of the library with its numbers, where it acts and from when on.
#[derive(Clone, Debug, PartialEq)]
pub struct JointEffect {
    /// The mechanism.
    pub mechanism: Mechanism,
    /// The joint; `None` for what belongs to the whole linkage.
    pub joint: Option<Joint>,
    /// Whether a resistance is a share of the torque of its joint's brake, not an effort.
    pub of_torque: bool,
    /// Its parameters in the vocabulary's order, SI.
    pub parameters: Vec<f64>,
    /// When it begins, s of the rig's clock; `None` from the start.
    pub onset_s: Option<f64>,
}

impl Rig {
    /// A rig without effects with physics that the thesis leaves out.
    ///
    /// Dry levels are added to the yield torque with which a joint slips or holds, which never falls below zero; smooth torques
    /// act on their joint always. Memories begin empty: nothing bent, nothing stirred, no heat, the currents of the first step.
    /// [`Rig::dissipated_j`] then holds what the effects took too, stored or lost.
    ///
    /// An effect with an onset begins with the first step of the integrator that starts at or after it. Another backlash begins
    /// with the shaft in its middle (gap `backlash-start`); other masses begin with the rates that there are.
    ///
    /// # Errors
    /// [`ModelError::Effect`]: the mechanism is none of the rig's (those of the sensors are not), its joint is not usable, or
    /// the rig has effects already; [`ModelError::EffectValue`]: a number is not usable; [`ModelError::Mass`]: a mass does not stay above 0.
    pub fn with_effects(self, effects: &[JointEffect]) -> Result<Rig, ModelError> {
        let Some(one) = effects.first() else {
            return Ok(self);
        };
        if self.effects.is_some() {
            return Err(ModelError::Effect {
                mechanism: one.mechanism.name(),
                joint: one.joint.map_or("no joint", Joint::letter),
                reason: "the rig has effects already: give it all of them at once",
            });
        }
        let mut rig = self;
        let mut heaviest = rig.parameters.inertia;
        let mut terms = Vec::with_capacity(effects.len());
        for effect in effects {
            let term = term(&rig, effect)?;
            if let Term::Masses(more) = &term {
                heaviest = added_mass::sum(&heaviest, more);
                check_inertia(&heaviest)?;
            }
            if let (Some(place), true) = (effect.joint, has_dry(effect.mechanism)) {
                let place = place as usize;
                let rates = rig.joint_rates_rad_s();
                let rate = rates.get(place).copied().unwrap_or(0.0);
                rig.contacts = rig.contacts.with_dry(place, rate);
            }
            terms.push(Timed {
                term,
                onset_s: effect.onset_s.unwrap_or(f64::NEG_INFINITY),
            });
        }
        rig.effects = Some(LeftOut::new(effects.to_vec(), Arc::from(terms)));
        rig.begin_effects();
        rig.settle();
        Ok(rig)
    }

    /// The physics that the rig has beyond the thesis's.
    pub fn effects(&self) -> &[JointEffect] {
        self.effects.as_ref().map_or(&[], LeftOut::given)
    }
}

/// Whether a mechanism makes a joint hold that has no brake.
fn has_dry(mechanism: Mechanism) -> bool {
    facts(mechanism).is_some_and(|facts| matches!(facts.at_rest, AtRest::Dry(_)))
}

fn term(rig: &Rig, effect: &JointEffect) -> Result<Term, ModelError> {
    let refused = |reason| ModelError::Effect {
        mechanism: effect.mechanism.name(),
        joint: effect.joint.map_or("no joint", Joint::letter),
        reason,
    };
    check_numbers(effect)?;
    let value = |k: usize| effect.parameters.get(k).copied().unwrap_or(0.0);
    let joint = || effect.joint.ok_or(refused("it needs a joint"));
    let braked = || {
        let joint = joint()?;
        match rig.brake(joint) {
            Some(_) => Ok(joint),
            None => Err(refused("that joint has no brake")),
        }
    };
    let whole = |term| match effect.joint {
        None => Ok(term),
        Some(_) => Err(refused("it is of the whole linkage: give it no joint")),
    };
    let unknown = || refused("it is nothing that a rig does");
    if effect.of_torque {
        let law = law_of_torque(effect.mechanism, &effect.parameters).ok_or(refused(
            "it is no resistance that could be a share of a torque",
        ))?;
        let place = braked()? as usize;
        return Ok(Term::Share { place, law });
    }
    match form(effect.mechanism).ok_or_else(unknown)? {
        Form::Drive(Drive::Gain | Drive::Lag)
        | Form::ShareOfBrake(_)
        | Form::Brake(_)
        | Form::Linkage(OfLinkage::Load) => {
            of_brake(effect, braked()?).ok_or(refused("it is nothing that a brake does"))
        }
        Form::Linkage(OfLinkage::Weight) => whole(Term::Weight([value(0), value(1)])),
        Form::Linkage(OfLinkage::Payload) => whole(Term::Masses(added_mass::at_tip(value(0)))),
        Form::Linkage(OfLinkage::Inertias) => whole(Term::Masses(added_mass::in_all(
            &rig.parameters.inertia,
            [value(0), value(1), value(2), value(3), value(4)],
        ))),
        Form::Linkage(OfLinkage::InertiaScale) => whole(Term::Masses(added_mass::share(
            &rig.parameters.inertia,
            value(0),
        ))),
        Form::Linkage(OfLinkage::PlaneSpring) => whole(Term::Anchor {
            stiffness_n_m: value(0),
            tension_n: value(1),
            anchor_m: [value(2), value(3)],
        }),
        Form::Resistance(law) => Ok(Term::Law {
            place: joint()? as usize,
            law: law(&effect.parameters),
        }),
        Form::Drive(Drive::Skew | Drive::Limit | Drive::Rate)
        | Form::Sensor(_)
        | Form::Joint(_)
        | Form::Linkage(OfLinkage::LinkLength) => Err(unknown()),
    }
}

/// What an effect changes at the brake of a joint.
fn of_brake(effect: &JointEffect, joint: Joint) -> Option<Term> {
    let place = joint as usize;
    let value = |k: usize| effect.parameters.get(k).copied().unwrap_or(0.0);
    Some(match form(effect.mechanism)? {
        Form::Drive(Drive::Gain) => Term::Gain {
            place,
            fraction: value(0),
        },
        Form::ShareOfBrake(law) => Term::Share {
            place,
            law: law(&effect.parameters),
        },
        Form::Brake(OfBrake::ThermalFade) => Term::Fade {
            place,
            per_joule: value(0),
            cooling_s: value(1),
        },
        Form::Brake(OfBrake::CurrentHysteresis) => Term::Play {
            place,
            share: value(1),
            play: CurrentPlay {
                half_width_a: value(0),
                closing_a: value(2),
                spread: value(3),
                top_a: value(4),
            },
        },
        Form::Brake(OfBrake::DeadTime) => Term::Late {
            place,
            delay_s: value(0),
        },
        Form::Brake(OfBrake::Saturation) => Term::Limit {
            place,
            numbers: [value(0), value(1)],
        },
        Form::Brake(OfBrake::CurrentGain) => Term::Amplifier {
            place,
            times: value(0),
        },
        Form::Brake(OfBrake::TimeConstant) => Term::Slower {
            place,
            times: slower(&effect.parameters),
        },
        Form::Drive(Drive::Lag) => Term::Lag {
            place,
            time_constant_s: value(0),
        },
        Form::Brake(OfBrake::BacklashWidth) => Term::Backlash {
            joint,
            width_rad: value(0),
        },
        Form::Linkage(OfLinkage::Load) => Term::Load {
            place,
            arm_m: value(0),
        },
        Form::Brake(OfBrake::CommandExponent)
        | Form::Drive(Drive::Skew | Drive::Limit | Drive::Rate)
        | Form::Resistance(_)
        | Form::Sensor(_)
        | Form::Joint(_)
        | Form::Linkage(_) => return None,
    })
}

fn check_numbers(effect: &JointEffect) -> Result<(), ModelError> {
    let joint = effect.joint.map_or("no joint", Joint::letter);
    let names = effect.mechanism.parameters();
    if !(effect.mechanism.needed()..=names.len()).contains(&effect.parameters.len()) {
        return Err(ModelError::Effect {
            mechanism: effect.mechanism.name(),
            joint,
            reason: "it has another number of parameters",
        });
    }
    for (name, value) in names.iter().zip(&effect.parameters) {
        let allowed = if !value.is_finite() {
            "a finite number"
        } else {
            match name.range {
                Range::AboveZero if *value <= 0.0 => "above 0",
                Range::NotBelowZero if *value < 0.0 => "0 or more",
                Range::Part if !(0.0..=1.0).contains(value) => "from 0 to 1",
                Range::Any | Range::AboveZero | Range::NotBelowZero | Range::Part | Range::Sign => {
                    continue;
                }
            }
        };
        return Err(ModelError::EffectValue {
            mechanism: effect.mechanism.name(),
            joint,
            parameter: name.name,
            value: *value,
            allowed,
        });
    }
    Ok(())
}

impl Rig {
    /// Begins what begins at a moment and not by acting from then on: another backlash, other masses.
    pub(super) fn begin_effects(&mut self) {
        let Some(mut effects) = self.effects.take() else {
            return;
        };
        for k in effects.beginning(self.time_s) {
            match effects.term(k) {
                Some(Term::Masses(more)) => {
                    let before_j = self.kinetic_energy_j();
                    self.parameters.inertia = added_mass::sum(&self.parameters.inertia, more);
                    let Parameters { arms, inertia, .. } = &self.parameters;
                    self.form = two_coordinate(arms, inertia, &self.pose, self.rates_rad_s);
                    self.dissipated_j += before_j - self.kinetic_energy_j();
                }
                Some(Term::Backlash { joint, width_rad }) => {
                    let angles = self.joint_angles_rad();
                    let places = self.brakes.iter_mut().zip(angles).zip(Joint::ALL);
                    for ((brake, angle), own) in places {
                        if own == *joint {
                            *brake = brake.map(|brake| {
                                let table = BrakeTable {
                                    backlash_width_deg: deg_from_rad(*width_rad),
                                    ..brake.table()
                                };
                                brake.with_table(table, angle)
                            });
                        }
                    }
                }
                Some(Term::Slower { place, times }) => {
                    if let Some(brake) = self.brakes.get_mut(*place) {
                        *brake = brake.map(|brake| brake.slowed(*times));
                    }
                }
                _ => {}
            }
            effects.has_begun(k);
        }
        self.effects = Some(effects);
    }
}
