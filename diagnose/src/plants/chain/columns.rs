//! This file is what an effort of an arm lacks where a mechanism is left out: the columns of its
//! regression.

use super::run::{ChainRun, joint_at};
use crate::cause::Cause;
use crate::plant::{Columns, resistances};
use rigproof_model::bench::column;
use rigproof_model::chain::INERTIAL;
use rigproof_model::effects::transmission::within_gap;
use rigproof_model::effects::{
    Drive, Form, Instant, OfJoint, OfLinkage, OfSensor, form, load_friction,
};
use rigproof_spec::effect::Mechanism;

impl ChainRun {
    /// What a cause of this shape adds to the balance; `None` if it has no meaning here.
    pub(super) fn lacked(&self, cause: Cause, shape: &[f64]) -> Option<Columns> {
        let joint = joint_at(cause.at)?;
        let motion = self.motions.get(joint)?;
        let signals = match form(cause.mechanism)? {
            // Inertial parameters that no effort depends on have an empty column.
            Form::Joint(OfJoint::Link) => (0..INERTIAL)
                .map(|number| {
                    let own = self.links.iter().find(|(of, _)| *of == (joint, number));
                    let none = || vec![0.0; self.effort.len()];
                    own.map_or_else(none, |(_, signal)| signal.clone())
                })
                .collect(),
            Form::Joint(OfJoint::Inertia) => {
                let speeds: Vec<f64> = motion.iter().map(|now| now.speed).collect();
                vec![self.at_place(joint, &self.rate(&speeds))]
            }
            Form::Linkage(OfLinkage::Payload) => vec![self.payload.clone()],
            // The true effort is (1 + fraction) times the recorded one.
            Form::Drive(Drive::Gain) => {
                vec![self.at_place(joint, self.stretch(&self.known, joint))]
            }
            Form::Joint(OfJoint::Stiffness) => {
                let twist: Vec<f64> = motion.iter().map(|now| now.position).collect();
                vec![self.at_place(joint, &twist)]
            }
            Form::Joint(OfJoint::Lash) => {
                let (gap, centre) = (shape.first()?, shape.get(1).unwrap_or(&0.0));
                let lacks = motion.iter();
                let lacks = lacks.map(|now| -within_gap(now.position, *gap, *centre));
                vec![self.at_place(joint, &lacks.collect::<Vec<_>>())]
            }
            // A twist that is recorded too great by an angle lacks the stiffness times the angle.
            Form::Sensor(OfSensor::EncoderOffset) => {
                let place = self.places.get(joint)?;
                let stiffness = place.described(Mechanism::TransmissionStiffness);
                vec![self.at_place(joint, &vec![-stiffness; self.len()])]
            }
            Form::Joint(OfJoint::Load) => return Some(self.by_load(joint, motion, shape)),
            // An effort recorded with a delay lacks the delay times its rate. Averaged over a
            // window, the rate is no noisier than the effort itself.
            Form::Drive(Drive::Skew) => {
                let rate = self.rate(self.stretch(&self.effort, joint));
                let delay = shape.first().copied();
                let late: Vec<f64> = rate.iter().map(|x| -x * delay.unwrap_or(1.0)).collect();
                let late = self.at_place(joint, &late);
                match delay {
                    None => vec![late],
                    Some(_) => return Some(Columns::Fixed(late)),
                }
            }
            _ => resistances(cause, shape, |law| column(law, motion, self.step_s))?
                .iter()
                .map(|own| self.at_place(joint, own))
                .collect(),
        };
        Some(Columns::Free(signals))
    }

    /// Friction by the load, per unit of its share where no numbers are given. The load is what the
    /// described bodies take, without friction that is recorded or described.
    fn by_load(&self, joint: usize, motion: &[Instant], numbers: &[f64]) -> Columns {
        let of = |effort: f64| match numbers {
            [] => effort.abs(),
            numbers => load_friction(effort, numbers),
        };
        let described = |mechanism| {
            let place = self.places.get(joint);
            place.map_or(0.0, |own| own.described(mechanism))
        };
        let [dry, viscous] = [Mechanism::DryOffset, Mechanism::Viscous].map(described);
        let known = self.stretch(&self.known, joint).iter().zip(motion);
        let rubs = known.map(|(e, now)| {
            let load = e - dry * now.sense - viscous * now.speed;
            of(load) * now.sense
        });
        let rubs: Vec<f64> = rubs.collect();
        let rubs = self.at_place(joint, &rubs);
        match numbers {
            [] => Columns::Free(vec![rubs]),
            _ => Columns::Fixed(rubs),
        }
    }
}
