//! This file says how brakes imitate springs and dampers along a path: the impedance control of §2.2.2.

use nalgebra::Vector2;
use rigproof_spec::command::{Command, Reason};

use super::path::{Nearest, Path};
use super::torque_translation::{Share, translate};
use super::{Actuation, Controller, Sensed, setting};
use crate::brake::current_gain;
use crate::error::ModelError;
use rigproof_spec::settings::{DAMPING_RANGE_N_S_PER_M, STIFFNESS_RANGE_N_PER_M};
use rigproof_spec::tables::brake_table;

/// The virtual spring and dampers. Gomes's law is a spring alone; Charles's and Davis's have all three.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Virtual {
    /// Spring across the path, N/m.
    pub stiffness_n_per_m: f64,
    /// Damper across the path, N·s/m.
    pub damping_across_n_s_per_m: f64,
    /// Damper along the path, N·s/m.
    pub damping_along_n_s_per_m: f64,
}

/// Impedance control with torque translation (§2.2.2; decision 0044).
///
/// The wanted force is that of a spring and a damper across the path and a damper along it. If no two brakes can make it,
/// the part across the path is tried alone, then the part along it; if they cannot make that either, no brake acts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impedance<P> {
    actuation: Actuation,
    path: P,
    elements: Virtual,
}

impl<P: Path> Impedance<P> {
    /// The controller on a path.
    ///
    /// # Errors
    /// [`ModelError::SettingRange`]: stiffness or damping is not between 0 and 10⁶ in its unit.
    pub fn new(
        actuation: Actuation,
        path: P,
        elements: Virtual,
    ) -> Result<Impedance<P>, ModelError> {
        let stiffness = elements.stiffness_n_per_m;
        setting(
            "the virtual stiffness",
            stiffness,
            STIFFNESS_RANGE_N_PER_M,
            "N/m",
        )?;
        for (name, damping) in [
            ("the damping across", elements.damping_across_n_s_per_m),
            ("the damping along", elements.damping_along_n_s_per_m),
        ] {
            setting(name, damping, DAMPING_RANGE_N_S_PER_M, "N·s/m")?;
        }
        Ok(Impedance {
            actuation,
            path,
            elements,
        })
    }

    /// The wanted force across the path and the one along it, N.
    fn wanted(&self, nearest: &Nearest, velocity_m_s: Vector2<f64>) -> [Vector2<f64>; 2] {
        let tangent = nearest.tangent;
        let left = Vector2::new(-tangent.y, tangent.x);
        let along_m_s = tangent.dot(&velocity_m_s);
        let across_m_s = left.dot(&velocity_m_s);
        let elements = &self.elements;
        let across_n = elements.stiffness_n_per_m * nearest.offset_m
            + elements.damping_across_n_s_per_m * across_m_s;
        let along_n = elements.damping_along_n_s_per_m * along_m_s;
        [left * -across_n, tangent * -along_n]
    }
}

impl<P: Path> Controller for Impedance<P> {
    fn command(&mut self, sensed: &Sensed) -> Command {
        let (rows, nearest) = match self.actuation.situation(&self.path, sensed) {
            Ok(situation) => situation,
            Err(reason) => return Command::none(reason),
        };
        let velocity_m_s = sensed.decisive_velocity_m_s();
        let [across, along] = self.wanted(&nearest, velocity_m_s);
        if across == Vector2::zeros() && along == Vector2::zeros() {
            return Command::none(Reason::NothingToDo);
        }
        let candidates = [across + along, across, along];
        match candidates
            .into_iter()
            .find_map(|force_n| translate(&rows, velocity_m_s, force_n))
        {
            Some([first, second]) => {
                let given = |share: Share| {
                    (
                        share.joint,
                        current_gain(&brake_table(share.joint), share.torque_nm),
                    )
                };
                Actuation::two(given(first), given(second))
            }
            None => Command::none(Reason::NoneHelps),
        }
    }
}
