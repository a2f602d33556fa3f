//! This file is what a tick answers: currents and why.

use rigproof_spec::command::{self, Reason};

use crate::number::{Real, Scalar};

/// What a tick asks of the amplifiers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Command<S> {
    /// Brake currents, A, in the order A, E, B, C: 0 to 1.
    pub currents_a: [S; 4],
    /// Why these currents.
    pub reason: Reason,
}

impl<S: Scalar> Command<S> {
    /// No current anywhere.
    pub fn none(reason: Reason) -> Command<S> {
        Command {
            currents_a: [S::zero(); 4],
            reason,
        }
    }
}

impl<R: Real> From<Command<R>> for command::Command {
    fn from(command: Command<R>) -> command::Command {
        command::Command {
            currents_a: command.currents_a.map(Real::to_f64),
            reason: command.reason,
        }
    }
}
