//! Recordings with a hidden cause: makes them, seals the answer, and scores a diagnosis against it.
//!
//! The plants, friction laws and integration here are this room's own, so that an effect is never found by the code
//! that hid it. `docs/blind.md` states the protocol.
#![cfg_attr(
    not(test),
    deny(
        clippy::unwrap_used,
        clippy::expect_used,
        clippy::panic,
        clippy::indexing_slicing
    )
)]

mod answer;
mod axis;
mod bench;
mod brake;
#[cfg(test)]
mod claims;
mod draw;
mod element;
mod error;
mod fault;
mod five_bar;
mod found;
mod hide;
mod law;
mod make;
mod nominal;
mod path;
mod plant;
mod rig;
mod run;
mod score;
mod seal;
mod setup;
mod size;
mod stratum;
mod table;

pub use answer::{Answer, HiddenEffect, TrueParameter};
pub use brake::{BrakeStep, brake_yield_nm};
pub use error::Error;
pub use five_bar::{RigState, RigStep, five_bar_motion};
pub use make::{Case, again, make, under};
pub use plant::Plant;
pub use score::{ONSET_S, ParameterError, Score, score};
pub use seal::{commitment, open};
pub use stratum::Stratum;
pub use table::{Row, Share, Table};
