//! This file is what is set beside the reference's command: currents, and the reason where one is known.

use rigproof_spec::command::{Command, Reason};
use rigproof_spec::joint::Joint;

/// Four currents, and why, if whoever answered says why. A certified controller is known by its currents alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Answer {
    /// The currents, A, in the order A, E, B, C.
    pub currents_a: [f64; 4],
    /// Why; `None` where no reason is given, so that any may be meant.
    pub reason: Option<Reason>,
}

impl From<Command> for Answer {
    fn from(command: Command) -> Answer {
        Answer {
            currents_a: command.currents_a,
            reason: Some(command.reason),
        }
    }
}

impl Answer {
    /// Currents, A, without a reason.
    pub const fn unexplained(currents_a: [f64; 4]) -> Answer {
        Answer {
            currents_a,
            reason: None,
        }
    }

    /// Whether this reason may be meant.
    pub fn may_mean(&self, reason: Reason) -> bool {
        self.reason.is_none_or(|own| own == reason)
    }

    /// Whether this command may be meant.
    pub fn may_be(&self, command: &Command) -> bool {
        self.currents_a == command.currents_a && self.may_mean(command.reason)
    }

    /// Whether no brake has current, for one of these reasons.
    pub fn is_silent(&self, reasons: &[Reason]) -> bool {
        self.currents_a == [0.0; 4] && reasons.iter().any(|reason| self.may_mean(*reason))
    }

    /// The greatest difference from a command's currents, A; infinite where one is no number.
    pub fn apart_a(&self, command: &Command) -> f64 {
        apart_a(self.currents_a, command.currents_a)
    }

    /// The commands that may be meant where at most one brake is chosen.
    pub fn of_one_brake(&self) -> impl Iterator<Item = Command> + use<> {
        let reasons = Joint::ALL.map(Reason::Chosen);
        let reasons = reasons.into_iter().chain([Reason::NoneHelps]);
        let own = *self;
        reasons
            .filter(move |reason| own.may_mean(*reason))
            .map(move |reason| Command {
                currents_a: own.currents_a,
                reason,
            })
    }
}

/// The greatest difference of currents, A; infinite where one is no number.
pub fn apart_a(one_a: [f64; 4], other_a: [f64; 4]) -> f64 {
    one_a
        .into_iter()
        .zip(other_a)
        .map(|(one_a, other_a)| (one_a - other_a).abs())
        .map(|apart_a| {
            if apart_a.is_nan() {
                f64::INFINITY
            } else {
                apart_a
            }
        })
        .fold(0.0, f64::max)
}
