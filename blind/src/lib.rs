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
mod brake;
mod braked;
mod draw;
mod effect;
mod element;
mod error;
mod fault;
mod form;
mod forms;
mod found;
mod judge;
mod lab;
mod make;
mod path;
mod plant;
mod plants;
mod preisach;
mod score;
mod seal;
mod size;
mod stratum;
mod table;
mod tally;
mod told;
mod typical;

pub use answer::{Answer, HiddenEffect, TrueParameter};
pub use brake::{BrakeStep, brake_yield_nm};
pub use error::Error;
pub use fault::Spoilt;
pub use forms::Forms;
pub use judge::{DETECTABLE_RATIO, Judgement, Outcome, judge};
pub use make::{Case, again, make, make_in, under, unspoilt};
pub use plant::Plant;
pub use plants::five_bar::{RigState, RigStep, five_bar_motion};
pub use score::{ONSET_S, ParameterError, Score, score};
pub use seal::{commitment, open};
pub use stratum::Stratum;
pub use table::{Row, Share, Table};
pub use tally::{Bin, Outcomes, Tally};
pub use told::{PLACE_S, Told, told};
