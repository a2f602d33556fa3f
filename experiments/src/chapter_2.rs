//! Chapter 2, the other passive displays: each on three tasks in the hand of one simulated operator, beside the thesis's own.

mod compared;
mod figure_2_1;
mod figure_2_2;
mod figure_2_3;
mod figure_2_4;
mod freedom;
mod shown;
mod statements;
mod tasks;
mod trials;

use crate::Experiment;

/// The experiments of the chapter.
pub const EXPERIMENTS: &[Experiment] = &[
    figure_2_1::EXPERIMENT,
    figure_2_2::EXPERIMENT,
    figure_2_3::EXPERIMENT,
    figure_2_4::EXPERIMENT,
    compared::EXPERIMENT,
];
