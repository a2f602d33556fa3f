//! This file adds the equations of a joint whose motor is told from its link, by a second encoder
//! or by a torque sensor.
//!
//! What passes the transmission is what the sensor shows or, without one, the stated stiffness times
//! the twist. It drives the link, and the motor drives it:
//!
//! - link: what passes = the rigid bodies + friction behind the transmission
//! - motor: its effort = rotor·acceleration + what passes + friction before the transmission
//! - transmission, where sensor and twist are both recorded: what passes = stiffness·twist

use super::align::{Aligned, Metered, accelerations, lasting};
use super::run::ChainRun;
use rigproof_model::chain::{Chain, Joint};
use rigproof_model::effects::facts::Family;
use rigproof_model::effects::{Drive, Form, Instant, OfJoint, OfLinkage, facts, form};
use rigproof_spec::effect::Mechanism;
use rigproof_trace::rig::chain::ChainRig;
use rigproof_trace::rig::transmission::{Part, Transmission};

/// Where a mechanism may act.
#[derive(Clone, Debug)]
pub struct ArmPlace {
    /// Its name.
    pub name: &'static str,
    /// The part of that joint.
    pub part: Part,
    /// Whether the motor of this joint is told from its link.
    pub is_split: bool,
    /// What the description says of it.
    pub described: Vec<(Mechanism, f64)>,
    /// The equations in which an effort at this place stands, with its sign.
    pub rows: Vec<(usize, f64)>,
}

impl ArmPlace {
    /// The described number of a mechanism; 0 if there is none.
    pub fn described(&self, mechanism: Mechanism) -> f64 {
        let own = self.described.iter().find(|(own, _)| *own == mechanism);
        own.map_or(0.0, |(_, number)| *number)
    }

    /// Whether a mechanism is a candidate here.
    pub fn asks(&self, mechanism: Mechanism) -> bool {
        let Some(facts) = facts(mechanism) else {
            return false;
        };
        let own = form(mechanism);
        let is_of_effort = matches!(own, Some(Form::Drive(Drive::Gain | Drive::Skew)));
        let is_of_bodies = matches!(
            own,
            Some(Form::Joint(OfJoint::Link) | Form::Linkage(OfLinkage::Payload))
        );
        // What a twist is wrong by looks like an effort by the position on either side.
        if self.is_split && self.part != Part::Transmission && facts.family == Family::Position {
            return false;
        }
        let is_rotor = matches!(own, Some(Form::Joint(OfJoint::Inertia)));
        match self.part {
            // A bias of what passes cannot be told from one of its sensor or of the motor.
            Part::Link => {
                let elsewhere = is_of_effort || is_rotor || mechanism == Mechanism::ConstantBias;
                facts.at_arm && !(self.is_split && elsewhere)
            }
            Part::Motor => facts.at_arm && !is_of_bodies,
            Part::Transmission => facts.at_transmission,
            Part::Sensor => is_of_effort || mechanism == Mechanism::ConstantBias,
        }
    }
}

/// What the description says of the transmission of a joint whose motor is told from its link.
pub(super) fn stated<'a>(rig: &'a ChainRig, joint: &Joint) -> Option<&'a Transmission> {
    let own = &rig.joint(&joint.name)?.transmission;
    own.is_seen().then_some(own)
}

/// The names of the places of an arm, in the order of a run.
pub(super) fn place_names(rig: &ChainRig, chain: &Chain) -> Vec<String> {
    let links = chain.joints.iter().map(|own| own.name.clone());
    let parts = chain.joints.iter().flat_map(|own| {
        let stated = rig.joint(&own.name);
        let parts = [Part::Motor, Part::Transmission, Part::Sensor].into_iter();
        let has = move |part: &Part| stated.is_some_and(|own| own.transmission.has(*part));
        parts.filter(has).map(|part| part.of(&own.name))
    });
    links.chain(parts).collect()
}

/// The motion at a place, what is described there, and the equations in which it stands.
type Stands<'a> = (&'a [Instant], Vec<(Mechanism, f64)>, Vec<(usize, f64)>);

/// What is known of the parts of a joint.
struct Split<'a> {
    name: &'a str,
    joint: usize,
    own: &'a Aligned,
    stated: &'a Transmission,
    /// The inertia of the motor, of the description or of the model.
    rotor: f64,
}

impl ChainRun {
    /// Adds the equations and the places of the joints whose motors are told from their links.
    pub(super) fn split_joints(&mut self, rig: &ChainRig, chain: &Chain, joints: &[Aligned]) {
        for (joint, (of_model, own)) in chain.joints.iter().zip(joints).enumerate() {
            let Some(stated) = stated(rig, of_model) else {
                continue;
            };
            let rotor = stated.rotor.map_or(of_model.armature, |rotor| rotor.value);
            let split = Split {
                name: &of_model.name,
                joint,
                own,
                stated,
                rotor,
            };
            self.split(&split);
        }
    }

    fn split(&mut self, split: &Split<'_>) {
        let (joint, own, step_s) = (split.joint, split.own, self.step_s);
        let twist = own.twist(step_s);
        let stiffness = split.stated.stiffness.map_or(0.0, |own| own.value);
        let sprung = twist.as_ref().map(|twist| twist.sprung(stiffness));
        let Some(passed) = own.torque.as_ref().or(sprung.as_ref()) else {
            return;
        };
        self.passes_to_link(joint, passed);
        let wound = own.wound(stiffness, step_s);
        let motor = own.motor.as_ref().or(wound.as_ref()).unwrap_or(&own.link);
        let known = accelerations(&motor.motion, step_s).into_iter();
        let known = known
            .zip(&passed.signal)
            .map(|(faster, passed)| split.rotor * faster + passed);
        let noise = [motor.noise, own.effort.noise.hypot(passed.noise)];
        let effort = (own.effort.signal.as_slice(), noise, split.rotor);
        let motor_row = self.add_equation(effort, known.collect());
        let mut between = vec![(motor_row, 1.0), (joint, -1.0)];
        let mut sensor = vec![(joint, 1.0), (motor_row, -1.0)];
        let twist_row = match (&own.torque, &sprung) {
            (Some(torque), Some(sprung)) => {
                let noise = [0.0, torque.noise.hypot(sprung.noise)];
                let torque = (torque.signal.as_slice(), noise, 0.0);
                let row = self.add_equation(torque, sprung.signal.clone());
                between = vec![(row, 1.0)];
                sensor.push((row, 1.0));
                Some(row)
            }
            _ => None,
        };
        let described = vec![(Mechanism::AddedInertia, split.rotor)];
        let rows = vec![(motor_row, 1.0)];
        self.add_place(
            split,
            Part::Motor,
            (&motor.motion, described, rows),
            Some(motor_row),
        );
        if let Some(twist) = &twist {
            let described = vec![(Mechanism::TransmissionStiffness, stiffness)];
            self.add_place(
                split,
                Part::Transmission,
                (&twist.motion, described, between),
                twist_row,
            );
        }
        if own.torque.is_some() {
            self.add_place(
                split,
                Part::Sensor,
                (&own.link.motion, Vec::new(), sensor),
                None,
            );
        }
    }

    /// A link is driven by what passes its transmission.
    fn passes_to_link(&mut self, joint: usize, passed: &Metered) {
        let efforts = self.effort.iter_mut().skip(joint * self.recorded.len());
        let efforts = efforts.zip(&passed.signal);
        efforts.for_each(|(slot, passed)| *slot = *passed);
        if let Some([_, noise]) = self.noise.get_mut(joint) {
            *noise = passed.noise;
        }
    }

    /// Adds an equation: what is recorded, the noise of its position and effort, its inertia, and
    /// what is known of it.
    fn add_equation(
        &mut self,
        (effort, noise, mass): (&[f64], [f64; 2], f64),
        known: Vec<f64>,
    ) -> usize {
        self.effort.extend_from_slice(effort);
        self.known.extend(known);
        let all = self.effort.len();
        self.payload.resize(all, 0.0);
        self.links
            .iter_mut()
            .for_each(|(_, own)| own.resize(all, 0.0));
        self.noise.push(noise);
        self.masses.push(mass);
        self.masses.len() - 1
    }

    /// Adds a place: its motion, what is described there, and the equations in which its effort
    /// stands; `equation` is the one that has its name.
    fn add_place(
        &mut self,
        split: &Split<'_>,
        part: Part,
        (motion, described, rows): Stands<'_>,
        equation: Option<usize>,
    ) {
        self.equations.extend(equation.map(|_| self.places.len()));
        self.motions.push(motion.to_vec());
        self.places.push(ArmPlace {
            name: lasting(&part.of(split.name)),
            part,
            is_split: true,
            described,
            rows,
        });
    }
}
