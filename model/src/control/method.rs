//! This file makes a controller of a row of table 6.1.

use rigproof_spec::command::{Command, Reason};
use rigproof_spec::methods::{BLEND_BOUNDARY_M, Method, Setting};
use rigproof_spec::units::M_PER_CM;

use super::path::Path;
use super::{Actuation, Controller, Proportional, Sdof, Sensed};
use crate::error::ModelError;

/// The unit of the gains of table 6.1, printed as Ns/m (erratum `gain-unit`).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum GainUnit {
    /// N·s/m, as printed.
    PerMetre,
    /// N·s/cm.
    PerCentimetre,
}

impl GainUnit {
    /// N·s/m in one of this unit.
    pub const fn to_si(self) -> f64 {
        match self {
            GainUnit::PerMetre => 1.0,
            GainUnit::PerCentimetre => 1.0 / M_PER_CM,
        }
    }
}

/// The first row of table 6.1: no brake ever acts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Uncontrolled;

impl Controller for Uncontrolled {
    fn command(&mut self, _: &Sensed) -> Command {
        Command::none(Reason::Uncontrolled)
    }
}

/// The controller of a row of table 6.1 on a path, with the velocity field of §6.1.1.
///
/// # Errors
/// None with the settings of the table; those of [`Sdof::new`] and [`Proportional::new`].
pub fn controller<P: Path + 'static>(
    method: Method,
    gain_unit: GainUnit,
    actuation: Actuation,
    path: P,
) -> Result<Box<dyn Controller>, ModelError> {
    Ok(match method.setting() {
        Setting::Nothing => Box::new(Uncontrolled),
        Setting::GapCm(gap_cm) => {
            let gap_m = gap_cm * M_PER_CM;
            Box::new(Sdof::new(actuation, path, BLEND_BOUNDARY_M, gap_m)?)
        }
        Setting::GainPrinted(gain) => {
            let gain = gain * gain_unit.to_si();
            Box::new(Proportional::new(actuation, path, BLEND_BOUNDARY_M, gain)?)
        }
    })
}
