//! This file puts physics that the thesis leaves out into the fixed-step plant and its sensors.

mod drive;
mod refused;

use rigproof_impl::plant::Parameters;
use rigproof_impl::plant::effect::{Asked, Law};
use rigproof_impl::vector::Vector;
use rigproof_model::brake::slowed;
use rigproof_model::effects::facts::{AtRest, Family};
use rigproof_model::effects::{
    Drive, Form, OfBrake, OfLinkage, OfSensor, entry, form, law, slower,
};
use rigproof_model::motion::added_mass;
use rigproof_spec::effect::Mechanism;
use rigproof_spec::joint::Joint;
use rigproof_spec::tables::BrakeTable;
use rigproof_spec::units::deg_from_rad;
use serde::{Deserialize, Serialize};

pub use drive::Amplifiers;
pub use refused::{runs, why_not};

/// A mechanism of the library with its numbers, in the vocabulary's order and units, at a joint or of the whole rig.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Written", into = "Written")]
pub struct LeftOut {
    /// The mechanism.
    pub mechanism: Mechanism,
    /// The joint; `None` where it has none.
    pub joint: Option<Joint>,
    /// Its numbers.
    pub parameters: Vec<f64>,
}

/// As it stands in files.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    mechanism: String,
    joint: Option<String>,
    parameters: Vec<f64>,
}

impl From<LeftOut> for Written {
    fn from(own: LeftOut) -> Written {
        Written {
            mechanism: own.mechanism.name().to_owned(),
            joint: own.joint.map(|joint| joint.letter().to_owned()),
            parameters: own.parameters,
        }
    }
}

impl TryFrom<Written> for LeftOut {
    type Error = String;

    fn try_from(written: Written) -> Result<LeftOut, String> {
        let mechanism = Mechanism::from_name(&written.mechanism)
            .ok_or_else(|| format!("`{}` is no mechanism", written.mechanism))?;
        let joint = |letter: String| {
            Joint::from_letter(&letter).ok_or_else(|| format!("`{letter}` is no joint"))
        };
        Ok(LeftOut {
            mechanism,
            joint: written.joint.map(joint).transpose()?,
            parameters: written.parameters,
        })
    }
}

/// What the fixed-step plant and its sensors have.
pub fn known() -> impl Iterator<Item = Mechanism> {
    let all = Mechanism::ALL.into_iter();
    all.filter(|mechanism| role(*mechanism).is_some())
}

/// What a mechanism changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// What resists at a joint.
    Resistance,
    /// The numbers of a brake.
    Brake,
    /// What a brake gets of a command.
    Drive,
    /// Masses.
    Masses,
    /// What an encoder says.
    Encoder,
    /// What the force sensor says.
    Force,
}

impl Role {
    /// Whether it acts at a joint.
    pub const fn needs_joint(self) -> bool {
        matches!(
            self,
            Role::Resistance | Role::Brake | Role::Drive | Role::Encoder
        )
    }
}

/// What a mechanism changes; `None` where neither the plant nor its sensors have it.
pub fn role(mechanism: Mechanism) -> Option<Role> {
    match form(mechanism)? {
        Form::Resistance(_) | Form::ShareOfBrake(_) => {
            let numbers = vec![1.0; mechanism.needed()];
            Law::new(mechanism, &numbers).map(|_| Role::Resistance)
        }
        Form::Drive(Drive::Gain) | Form::Brake(OfBrake::BacklashWidth | OfBrake::TimeConstant) => {
            Some(Role::Brake)
        }
        Form::Brake(
            OfBrake::CurrentHysteresis
            | OfBrake::DeadTime
            | OfBrake::Saturation
            | OfBrake::CurrentGain,
        ) => Some(Role::Drive),
        // Of a brake that is stated otherwise than the rig's.
        Form::Brake(OfBrake::CommandExponent) => None,
        Form::Linkage(OfLinkage::Payload | OfLinkage::Inertias | OfLinkage::InertiaScale) => {
            Some(Role::Masses)
        }
        Form::Sensor(OfSensor::EncoderScale | OfSensor::EncoderOffset | OfSensor::Eccentric) => {
            Some(Role::Encoder)
        }
        Form::Sensor(OfSensor::ForceGain | OfSensor::ForceBias | OfSensor::ForceRotation) => {
            Some(Role::Force)
        }
        Form::Drive(Drive::Lag | Drive::Skew | Drive::Limit | Drive::Rate)
        | Form::Joint(_)
        | Form::Brake(OfBrake::ThermalFade)
        | Form::Linkage(
            OfLinkage::Load | OfLinkage::Weight | OfLinkage::PlaneSpring | OfLinkage::LinkLength,
        )
        | Form::Sensor(OfSensor::Clock) => None,
    }
}

impl LeftOut {
    fn number(&self, index: usize) -> f64 {
        self.parameters.get(index).copied().unwrap_or(0.0)
    }

    /// Whether it neither stores energy nor gives any.
    pub fn is_passive(&self) -> bool {
        match role(self.mechanism) {
            None => false,
            Some(Role::Resistance) => self.is_passive_resistance().unwrap_or(false),
            Some(Role::Brake | Role::Drive | Role::Masses | Role::Encoder | Role::Force) => true,
        }
    }

    /// Of a resistance: friction of the motion of the moment, without a memory.
    fn is_passive_resistance(&self) -> Option<bool> {
        let own = entry(self.mechanism)?;
        let is_of_moment = own.passive
            && own.facts.family == Family::FrictionOfMotion
            && !law(self.mechanism, &self.parameters)?.remembers();
        // A dry level only lowers that of the brake beside it, which never falls below 0.
        let is_dry = matches!(own.facts.at_rest, AtRest::Dry(_));
        Some(is_of_moment && (is_dry || self.number(0) >= 0.0))
    }

    /// The angle that an encoder shows of a joint's, rad.
    pub fn shown_rad(&self, joint: Joint, angle_rad: f64) -> f64 {
        match form(self.mechanism) {
            Some(Form::Sensor(of)) if self.joint == Some(joint) => {
                of.shown(angle_rad, &self.parameters)
            }
            _ => angle_rad,
        }
    }

    /// The force that the sensor shows of one, N.
    pub fn shown_n(&self, force_n: Vector<f64>) -> Vector<f64> {
        match form(self.mechanism) {
            Some(Form::Sensor(OfSensor::ForceGain)) => force_n * (1.0 + self.number(0)),
            Some(Form::Sensor(OfSensor::ForceRotation)) => {
                let (sine, cosine) = libm::sincos(self.number(0));
                force_n * cosine + force_n.left() * sine
            }
            Some(Form::Sensor(OfSensor::ForceBias)) => {
                force_n + Vector::new(self.number(0), self.number(1))
            }
            _ => force_n,
        }
    }
}

/// The resistances, as the plant is asked for them.
pub fn asked(left_out: &[LeftOut]) -> Vec<Asked<'_>> {
    let resistances = left_out
        .iter()
        .filter(|one| role(one.mechanism) == Some(Role::Resistance));
    let each = resistances.filter_map(|one| {
        Some(Asked {
            joint: one.joint?,
            mechanism: one.mechanism,
            parameters: &one.parameters,
        })
    });
    each.collect()
}

/// Puts brakes and masses into what a plant is made of; `None` where a brake is not there or a resistance is no law.
pub fn change(parameters: &mut Parameters, left_out: &[LeftOut]) -> Option<()> {
    for one in left_out {
        match role(one.mechanism)? {
            Role::Brake => {
                let table = parameters.brakes.get_mut(one.joint? as usize)?.as_mut()?;
                match form(one.mechanism)? {
                    Form::Drive(_) => scale_torque(table, 1.0 + one.number(0)),
                    Form::Brake(OfBrake::TimeConstant) => {
                        *table = slowed(*table, slower(&one.parameters))
                    }
                    _ => table.backlash_width_deg = deg_from_rad(one.number(0)),
                }
            }
            Role::Drive => {
                parameters.brakes.get(one.joint? as usize)?.as_ref()?;
                is_drive(one).then_some(())?;
            }
            Role::Masses => {
                let more = match form(one.mechanism)? {
                    Form::Linkage(OfLinkage::Payload) => added_mass::at_tip(one.number(0)),
                    Form::Linkage(OfLinkage::InertiaScale) => {
                        added_mass::share(&parameters.inertia, one.number(0))
                    }
                    _ => added_mass::in_all(
                        &parameters.inertia,
                        [0, 1, 2, 3, 4].map(|index| one.number(index)),
                    ),
                };
                parameters.inertia = added_mass::sum(&parameters.inertia, &more);
            }
            Role::Resistance => {
                // A lag or a gain of the current is no resistance.
                Law::new(one.mechanism, &one.parameters)?;
            }
            Role::Encoder => {
                matches!(one.joint, Some(Joint::A | Joint::B)).then_some(())?;
            }
            Role::Force => {}
        }
    }
    Some(())
}

/// Whether a command can be so late, multiplied, cut or held back.
fn is_drive(one: &LeftOut) -> bool {
    match form(one.mechanism) {
        Some(Form::Brake(OfBrake::DeadTime)) => (0.0..=drive::LONGEST_S).contains(&one.number(0)),
        Some(Form::Brake(OfBrake::CurrentHysteresis)) => {
            one.number(0) > 0.0 && one.number(2) >= 0.0 && (0.0..=1.0).contains(&one.number(3))
        }
        _ => one.number(0) > 0.0,
    }
}

/// Makes a brake's torque greater by a factor, with and without current.
pub fn scale_torque(table: &mut BrakeTable, factor: f64) {
    let gain = &mut table.torque_gain;
    for k in [
        &mut gain.k_1,
        &mut gain.k_2,
        &mut gain.k_3,
        &mut gain.k_4,
        &mut gain.k_5,
    ] {
        *k *= factor;
    }
}
