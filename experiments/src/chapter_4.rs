//! Chapter 4, the linkage: the maps its arms were chosen by, and where its tip can go.

mod figure_4_10;
mod figure_4_17;
mod figure_4_7;
mod figure_4_8;
mod layouts;
pub mod statements;

pub use layouts::{limit, spread};

use crate::Experiment;

/// The experiments of the chapter.
pub const EXPERIMENTS: &[Experiment] = &[
    figure_4_7::EXPERIMENT,
    figure_4_8::THREE,
    figure_4_8::FOUR,
    figure_4_10::THREE,
    figure_4_10::FOUR,
    figure_4_17::EXPERIMENT,
];
