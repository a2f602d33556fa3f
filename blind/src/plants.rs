//! This file is the register of the plants: a folder each, behind one trait.

pub mod arm;
pub mod driven_joint;
pub mod five_bar;
pub mod one_joint;

use crate::error::Error;
use crate::forms::Forms;
use crate::make::{Case, case, clean};
use crate::plant::Plant;
use crate::stratum::Stratum;

/// Makes the recording of a data fault without the fault.
pub fn unspoilt(plant: Plant, seed: u64) -> Result<Case, Error> {
    match plant {
        Plant::Rig => clean(&five_bar::Rig(Forms::Usual), seed),
        Plant::Chain => clean(&arm::Arm, seed),
        Plant::Axis | Plant::Bench => clean(&one_joint::OneJoint(plant, Forms::Usual), seed),
    }
}

/// Makes a case on the plant of a name.
pub fn make(forms: Forms, plant: Plant, seed: u64, stratum: Stratum) -> Result<Case, Error> {
    match (forms, plant) {
        (Forms::Other, Plant::Axis) => case(&driven_joint::DrivenJoint, seed, stratum),
        (_, Plant::Chain) => case(&arm::Arm, seed, stratum),
        (_, Plant::Rig) => case(&five_bar::Rig(forms), seed, stratum),
        (_, Plant::Axis | Plant::Bench) => case(&one_joint::OneJoint(plant, forms), seed, stratum),
    }
}
