//! What a person looks at: one self-contained HTML page for each kind of result.
//!
//! A page opens from a disk without a network, in light and dark, on paper and on a phone. It asks nobody for anything: style, scripts and data
//! stand in it, and its content security policy forbids the rest. Whatever comes out of a file is escaped where it is written.

#![cfg_attr(
    not(test),
    deny(
        clippy::unwrap_used,
        clippy::expect_used,
        clippy::panic,
        clippy::indexing_slicing
    )
)]

pub mod certificate;
pub mod chart;
pub mod compared;
pub mod diagnosis;
pub mod document;
mod forest;
pub mod number;
pub mod replay;
mod statistics;
pub mod table;
pub mod trial;
pub mod what_if;
pub mod words;
