//! This file inverts the described encoder errors before anything is fitted. The linkage is too
//! nonlinear for them to enter as regression columns.

use super::free_run::{Model, truly};
use super::from_rig::{aligned, nominal, realigned};
use super::run::FiveBarRun;
use crate::align::Fault;
use crate::effect::Effect;
use crate::plant::Run;
use rigproof_model::effects::{Form, form};
use rigproof_model::error::ModelError;
use rigproof_spec::effect::Mechanism;
use rigproof_trace::rig::five_bar::{FiveBar, FiveBarRecording, JointEffect};

/// The described effects that are inverted, and those that stay in the nominal model.
pub fn undone_first(rig: &FiveBar) -> (Vec<JointEffect>, Vec<JointEffect>) {
    let effects = rig.effects.iter().cloned();
    effects.partition(|own| is_of_encoder(own.effect.mechanism))
}

fn is_of_encoder(mechanism: Mechanism) -> bool {
    form(mechanism).is_some_and(Form::is_of_encoder)
}

/// The effects of the nominal model beyond the thesis's, without those of the encoders.
pub fn left(rig: &FiveBar) -> Vec<Effect> {
    nominal(&with(rig, undone_first(rig).1))
}

fn with(rig: &FiveBar, effects: Vec<JointEffect>) -> FiveBar {
    FiveBar {
        effects,
        ..rig.clone()
    }
}

/// An aligned recording with the true angles of the linkage. `before_s` is the length of the
/// recordings before it on the clock of the onsets.
///
/// # Errors
/// The fault that makes any conclusion meaningless.
pub fn described(
    rig: &FiveBar,
    recording: &FiveBarRecording,
    before_s: f64,
) -> Result<FiveBarRun, Fault> {
    let run = aligned(rig, recording)?;
    let (mut undone, _) = undone_first(rig);
    for onset in undone
        .iter_mut()
        .filter_map(|own| own.effect.onset.as_mut())
    {
        onset.value -= before_s;
    }
    if undone.is_empty() {
        return Ok(run);
    }
    let impossible = |error: ModelError| Fault {
        channel: "theta_a",
        from_s: 0.0,
        to_s: run.clock().duration_s(),
        reason: format!(
            "the linkage cannot stand at the angles that the description's encoder effects leave: {error}; correct or take out these effects"
        ),
    };
    let encoders = Model::of(&with(rig, undone));
    let theta = truly(&encoders, &run).map_err(impossible)?.theta;
    realigned(&run, theta).map_err(|(_, error)| impossible(error))
}
