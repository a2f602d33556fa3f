//! This file is the first row of table 6.1: no brake ever acts.

use rigproof_spec::command::Reason;

use super::{Law, Situation};
use crate::actuation::Actuation;
use crate::command::Command;
use crate::number::Real;

/// No control (table 6.1).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Uncontrolled;

impl<R: Real> Law<R> for Uncontrolled {
    fn command(&mut self, _: &Situation<R>) -> Command<R> {
        Command::none(Reason::Uncontrolled)
    }

    fn actuation(&self) -> Option<&Actuation<R>> {
        None
    }
}
