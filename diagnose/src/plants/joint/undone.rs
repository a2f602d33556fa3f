//! This file inverts the described effects of drive and encoder before anything is fitted, and
//! refuses effects that a plant of one joint cannot compute.

use super::columns::is_of_brake;
use super::drive::{drive_of, driven};
use super::encoder::{behind, of_encoder};
use super::from_rig::{bare, nominal};
use super::laws::too_many;
use super::run::{JointRun, PlantKind};
use super::simulate::Model;
use crate::align::Fault;
use crate::effect::Effect;
use crate::plant::Run;
use crate::signals::lagged_yield;
use rigproof_model::effects::{Drive, Form, OfJoint, OfSensor, form};
use rigproof_spec::effect::{Mechanism, Motion};
use rigproof_trace::rig::{Plant, Recording, Rig, Status};

/// Whether an effect is inverted before anything is fitted.
pub(super) fn is_undone(effect: &Effect) -> bool {
    drive_of(effect).is_some() || of_encoder(effect).is_some()
}

/// The effects of the nominal model that remain.
pub(super) fn left(rig: &Rig) -> Vec<Effect> {
    let mut effects = nominal(rig);
    effects.retain(|effect| !is_undone(effect));
    effects
}

/// An aligned recording with the true position and the effort that acted.
///
/// `before_s` is the length of the recordings before it on the clock of the onsets.
///
/// # Errors
/// The fault that makes any conclusion meaningless.
pub(super) fn aligned(rig: &Rig, recording: &Recording, before_s: f64) -> Result<JointRun, Fault> {
    let mut undone = nominal(rig);
    undone.retain(is_undone);
    for onset_s in undone.iter_mut().filter_map(|own| own.onset_s.as_mut()) {
        *onset_s -= before_s;
    }
    let run = bare(rig, recording, |position, clock| {
        behind(&undone, position, clock)
    })?;
    let mut run = run.dealt();
    run.described = left(rig);
    let clock = run.clock();
    if run.plant == PlantKind::Axis {
        run.effort = driven(&undone, &run.effort, &run, 0);
        return Ok(run);
    }
    for effect in &undone {
        let of_predicted = match drive_of(effect) {
            Some(Drive::Gain) => true,
            // The yield torque of a brake lags; on other benches the whole effort lags.
            Some(Drive::Lag) => run.current.is_some() && run.predicted.is_some(),
            Some(Drive::Skew) => false,
            Some(Drive::Limit | Drive::Rate) | None => continue,
        };
        if let Some(Drive::Skew) = drive_of(effect) {
            run.forget_ends(effect.value(0));
        }
        let Some(predicted) = run.predicted.as_ref().filter(|_| of_predicted) else {
            run.metered_by.push(effect.clone());
            continue;
        };
        let changed = match drive_of(effect) {
            Some(Drive::Lag) => lagged_yield(predicted, run.step_s, effect.value(0)),
            _ => driven([effect], predicted, &run, 0),
        };
        let begins = effect.first_sample(clock);
        let pairs = predicted.iter().zip(changed).enumerate();
        let own = pairs.map(|(k, (own, changed))| if k < begins { *own } else { changed });
        run.predicted = Some(own.collect());
    }
    Ok(run)
}

/// Why an effect of a description cannot be computed; `None` if all can.
pub(super) fn not_computed(rig: &Rig) -> Option<String> {
    let effects = nominal(rig);
    let refused = effects.iter().find_map(|effect| {
        let name = effect.mechanism().name();
        Some(format!("`{name}` {}", reason(rig, effect)?))
    });
    refused.or_else(|| {
        let described = effects.len();
        too_many(&Model {
            inertia: 1.0,
            effects,
            described,
        })
    })
}

fn reason(rig: &Rig, effect: &Effect) -> Option<String> {
    let is_axis = rig.plant == Plant::Axis;
    let has_current = rig.channels.current.is_some();
    let has_brake = rig.brake.is_some() && has_current || rig.characteristic.is_some();
    let has_prediction = has_brake || rig.channels.simulated.is_some();
    let share = effect.value(0);
    let no_meaning = || {
        let plant = rig.plant.name();
        Some(format!(
            "is nothing that this {plant} computes: take it out of the description, or give the description of a plant that has it"
        ))
    };
    match form(effect.mechanism()) {
        _ if is_of_brake(effect.cause) => match has_brake {
            true => None,
            false => Some("needs a bench with a brake and what drives it".to_owned()),
        },
        Some(Form::Resistance(_)) => None,
        Some(Form::Drive(Drive::Lag | Drive::Skew)) => None,
        Some(Form::Drive(_)) if is_axis => None,
        Some(Form::Drive(Drive::Gain)) => match has_prediction {
            true => None,
            false => Some("needs a brake or a simulated effort whose gain it can be".to_owned()),
        },
        Some(Form::Joint(OfJoint::Fade)) => None,
        // On a bench it is a share of the simulated effort.
        Some(Form::Joint(OfJoint::Load)) if !is_axis && has_prediction && !has_brake => None,
        Some(Form::Joint(OfJoint::Load)) if is_axis => (share >= 1.0
            && effect.parameters.len() < 2)
            .then(|| format!("has a share of {share}; below 1, or the joint never moves")),
        Some(Form::Joint(OfJoint::Compliance)) if is_axis => {
            (!(0.0..1.0).contains(&share)).then(|| {
                format!("has a share of {share}; 0 to below 1 of the inertia hangs behind a spring")
            })
        }
        Some(Form::Joint(OfJoint::Inertia)) if is_axis => None,
        Some(Form::Joint(OfJoint::Gap)) if is_axis => {
            let whole = rig.parameters.as_ref().map_or(0.0, |own| own.inertia.value);
            (share >= whole).then(|| {
                format!(
                    "has an inertia of {share}; behind the gap is less than the whole of {whole}"
                )
            })
        }
        Some(Form::Sensor(OfSensor::Eccentric))
            if rig.motion == Motion::Linear && effect.parameters.len() < 3 =>
        {
            Some("needs a `period`: what slides has no turn".to_owned())
        }
        Some(Form::Sensor(_)) if of_encoder(effect).is_some() => None,
        _ => no_meaning(),
    }
}

/// Why a description does not say enough for a diagnosis; `None` if it does.
pub(super) fn not_told(rig: &Rig) -> Option<String> {
    let parameters = rig.parameters.as_ref()?;
    if parameters.command_gain.status == Status::Unknown {
        return Some(
            "`command_gain` is `unknown`, and every effort is measured by it: state a rough one as known; where the inertia is known a wrong one is named `gain_error`"
                .to_owned(),
        );
    }
    let adds = |own: &Effect| own.mechanism() == Mechanism::AddedInertia;
    let is_unknown = parameters.inertia.status != Status::Known;
    (is_unknown && nominal(rig).iter().any(adds)).then(|| {
        "`added_inertia` stands beside an inertia that is not known: only their sum can be told, state the inertia as known or take the other out"
            .to_owned()
    })
}

pub(super) fn of_description(reason: String) -> Fault {
    Fault {
        channel: "effect",
        from_s: 0.0,
        to_s: 0.0,
        reason,
    }
}
