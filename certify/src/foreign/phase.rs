//! This file names what a controller was asked for when something happened.

use std::fmt;

/// What the controller was asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// The library is opened, which runs its constructors.
    Open,
    /// `init`.
    Init,
    /// `tick`, the how manieth of the trial, from 1.
    Tick(u64),
    /// `shutdown`.
    Shutdown,
}

impl fmt::Display for Phase {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Phase::Open => write!(f, "while the library was opened"),
            Phase::Init => write!(f, "in init"),
            Phase::Tick(number) => write!(f, "in tick {number} of the trial"),
            Phase::Shutdown => write!(f, "in shutdown"),
        }
    }
}
