//! This file says which causes are tried on a plant of one joint.

use super::run::JointRun;
use crate::cause::Cause;
use crate::plant::Run;
use rigproof_model::effects::{Form, LIBRARY};
use rigproof_spec::effect::Mechanism;

/// The causes that have a meaning on a plant of one joint, in the library's order.
pub fn causes(run: &JointRun) -> Vec<Cause> {
    let has_brake = run.brake().is_some();
    // A gain can only be wrong against something that is known.
    let is_known = run.known().iter().any(|e| *e != 0.0);
    LIBRARY
        .iter()
        .filter(|entry| match entry.mechanism {
            Mechanism::CurrentHysteresis | Mechanism::ReversalOvershoot => has_brake,
            // Only the five-bar is asked for them: the rules of the other plants were chosen without.
            Mechanism::Settling | Mechanism::AsymmetricPresliding => false,
            Mechanism::GainError => is_known,
            _ => matches!(entry.form, Form::Resistance(_) | Form::Drive),
        })
        .map(|entry| Cause::of(entry.mechanism))
        .collect()
}
