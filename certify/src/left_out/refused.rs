//! This file says of every mechanism where it runs in scenarios, or why it does not and is refused by its name.

use rigproof_model::effects::{Drive, Form, OfBrake, OfLinkage, OfSensor, form};
use rigproof_spec::effect::Mechanism;

use super::{Role, role};

/// Where a mechanism runs in a scenario; `None` where it does not.
pub fn runs(mechanism: Mechanism) -> Option<&'static str> {
    Some(match role(mechanism)? {
        Role::Resistance => "the plant: a torque at its joint",
        Role::Brake => "the plant: the table of its brake",
        Role::Drive => "between command and brake",
        Role::Masses => "the plant: its masses",
        Role::Encoder => "what the encoder shows",
        Role::Force => "what the force sensor shows",
    })
}

/// Why a mechanism does not run in a scenario, and a calibration that names it is refused; `None` where it runs.
pub fn why_not(mechanism: Mechanism) -> Option<&'static str> {
    if role(mechanism).is_some() {
        return None;
    }
    Some(match form(mechanism) {
        Some(Form::Drive(Drive::Lag)) => {
            "a brake's current follows its own time constant, and a second lag before it is no part of the plant"
        }
        Some(Form::Drive(_)) => "it is of a drive, and the rig has brakes",
        Some(Form::Brake(OfBrake::CommandExponent)) => "no brake of the rig is stated by a curve",
        Some(Form::Joint(_)) => "it is of a driven joint or an arm",
        Some(Form::Brake(OfBrake::ThermalFade)) => {
            "the plant has no heat: the torque of a brake does not fall with the work it has taken"
        }
        Some(Form::Linkage(OfLinkage::Load)) => {
            "friction by the force in a bearing needs that force within a step, which the plant does not solve for"
        }
        Some(Form::Linkage(OfLinkage::Weight)) => "the plant lies flat: no weight acts along it",
        Some(Form::Linkage(OfLinkage::PlaneSpring)) => "the plant has no spring at the tip",
        Some(Form::Linkage(OfLinkage::LinkLength)) => {
            "controller and plant have the arms of the layout; with others neither path nor start are what was drawn"
        }
        Some(Form::Sensor(OfSensor::Clock)) => {
            "it is of a recorder, and a controller goes by the rig's own clock"
        }
        Some(_) => "the plant's step of 1 ms has no form of this resistance",
        None => "it is no law of the library",
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The page's table.
    fn table() -> String {
        let row = |mechanism: Mechanism| {
            let name = mechanism.name();
            match (runs(mechanism), why_not(mechanism)) {
                (Some(place), None) => format!("| `{name}` | yes | {place} |\n"),
                (None, Some(why)) => format!("| `{name}` | refused | {why} |\n"),
                both => panic!("{name}: {both:?}"),
            }
        };
        let rows: String = Mechanism::ALL.into_iter().map(row).collect();
        format!("| mechanism | runs in scenarios | where, or why not |\n|---|---|---|\n{rows}")
    }

    #[test]
    fn the_page_says_of_every_mechanism_whether_it_runs() {
        let page = include_str!("../../../docs/scenarios.md");
        let table = table();
        assert!(
            page.contains(&table),
            "docs/scenarios.md is to hold:\n{table}"
        );
    }
}
