//! This file turns a force wanted at the tip into the current of the brake that gives it.

use nalgebra::{SMatrix, Vector2};
use rigproof_spec::command::{Command, Reason};
use rigproof_spec::geometry::{Arms, arms};
use rigproof_spec::joint::Joint;
use rigproof_spec::layout::Layout;
use rigproof_spec::methods::greatest_desired_force_n;

use super::force_limit::force_magnitude;
use super::path::{Nearest, Path};
use super::{JointRow, Sensed, setting};
use crate::brake::current_gain;
use crate::error::ModelError;
use crate::linkage::jacobian::jacobian;
use rigproof_spec::settings::FORCE_LIMIT_RANGE_N;
use rigproof_spec::tables::{GREATEST_CURRENT_A, brake_table};

/// Which brakes a controller has, on which arms, and the force it may ask of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Actuation {
    layout: Layout,
    arms: Arms,
    greatest_force_n: f64,
}

impl Actuation {
    /// The thesis's arms (table 4.1) and force limit (§6.1.2).
    pub const fn thesis(layout: Layout) -> Actuation {
        Actuation {
            layout,
            arms: arms(layout),
            greatest_force_n: greatest_desired_force_n(layout),
        }
    }

    /// Other arms, and another force limit, N.
    ///
    /// # Errors
    /// [`ModelError::ArmLength`]; [`ModelError::SettingRange`] when the limit is not between 0 and 1000 N.
    pub fn new(layout: Layout, arms: Arms, greatest_force_n: f64) -> Result<Actuation, ModelError> {
        crate::linkage::check_arms(&arms)?;
        let range = FORCE_LIMIT_RANGE_N;
        Ok(Actuation {
            layout,
            arms,
            greatest_force_n: setting("the greatest desired force", greatest_force_n, range, "N")?,
        })
    }

    /// Which joints have brakes.
    pub const fn layout(&self) -> Layout {
        self.layout
    }

    /// The arm lengths.
    pub const fn arms(&self) -> &Arms {
        &self.arms
    }

    /// The greatest force asked for at the tip, N.
    pub const fn greatest_force_n(&self) -> f64 {
        self.greatest_force_n
    }

    /// Each brake with its row of the Jacobian, 1/m: the force at the tip of 1 N·m on its shaft, N.
    ///
    /// # Errors
    /// The reason for which no brake may act: an undefined input, or a singular pose.
    fn rows(&self, sensed: &Sensed) -> Result<Vec<JointRow>, Reason> {
        let j = self.jacobian(sensed)?;
        let all = Joint::ALL.into_iter().zip(j.row_iter());
        Ok(all
            .filter(|(joint, _)| self.layout.brakes().contains(joint))
            .map(|(joint, row)| (joint, row.transpose().into_owned()))
            .collect())
    }

    /// How the tip lies to a path.
    ///
    /// # Errors
    /// [`Reason::UndefinedInput`]: the path does not know.
    pub(super) fn nearest(path: &impl Path, sensed: &Sensed) -> Result<Nearest, Reason> {
        let nearest = path.nearest(sensed.pose.tip_m);
        if nearest.is_defined() {
            Ok(nearest)
        } else {
            Err(Reason::UndefinedInput)
        }
    }

    /// The brakes' rows of the Jacobian, and how the tip lies to a path.
    ///
    /// # Errors
    /// The reason for which no brake may act: as [`Actuation::rows`] and [`Actuation::nearest`].
    pub(super) fn situation(
        &self,
        path: &impl Path,
        sensed: &Sensed,
    ) -> Result<(Vec<JointRow>, Nearest), Reason> {
        Ok((self.rows(sensed)?, Actuation::nearest(path, sensed)?))
    }

    /// The 4×2 Jacobian, rows A, E, B, C, columns x, y.
    ///
    /// # Errors
    /// As [`Actuation::rows`].
    pub(super) fn jacobian(&self, sensed: &Sensed) -> Result<SMatrix<f64, 4, 2>, Reason> {
        if !sensed.is_defined() {
            return Err(Reason::UndefinedInput);
        }
        jacobian(&self.arms, &sensed.pose).map_err(|_| Reason::SingularPose)
    }

    /// The current with which a brake gives a force at the tip, A (§6.1.3): the inverse of (6.3), then the current gain.
    pub(super) fn current_for_force(&self, joint: Joint, row: Vector2<f64>, force_n: f64) -> f64 {
        // Not f64::min, which would make the greatest force of one that is not a number.
        let force_n = if force_n > self.greatest_force_n {
            self.greatest_force_n
        } else {
            force_n
        };
        current_gain(&brake_table(joint), force_n / force_magnitude(row, 1.0))
    }

    /// A command to one brake.
    pub(super) fn one(joint: Joint, current_a: f64) -> Command {
        let mut command = Command::none(Reason::Chosen(joint));
        give(&mut command, joint, current_a);
        command
    }

    /// A command to two brakes.
    pub(super) fn two(first: (Joint, f64), second: (Joint, f64)) -> Command {
        let mut command = Command::none(Reason::ChosenPair(first.0, second.0));
        give(&mut command, first.0, first.1);
        give(&mut command, second.0, second.1);
        command
    }

    /// Full current to every brake (§6.1.2).
    pub(super) fn lock(&self, reason: Reason) -> Command {
        let mut command = Command::none(reason);
        for joint in self.layout.brakes() {
            give(&mut command, *joint, GREATEST_CURRENT_A);
        }
        command
    }
}

fn give(command: &mut Command, joint: Joint, current_a: f64) {
    let places = Joint::ALL.into_iter().zip(&mut command.currents_a);
    for (_, place) in places.filter(|(other, _)| *other == joint) {
        *place = current_a;
    }
}
