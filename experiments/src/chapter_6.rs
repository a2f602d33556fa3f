//! Chapter 6, the controllers: the simulations of §6.4 and the human-subject experiment with a simulated operator.

mod boxes;
mod compared;
mod figure_6_12;
mod figure_6_13;
mod figure_6_14;
mod figure_6_15;
mod figure_6_2;
mod figure_6_5;
mod force;
mod proof;
mod sample;
mod trials;

use crate::Experiment;

/// The experiments of the chapter.
pub const EXPERIMENTS: &[Experiment] = &[
    force::EXPERIMENT,
    figure_6_2::EXPERIMENT,
    figure_6_5::SDOF_THREE,
    figure_6_5::SDOF_FOUR,
    figure_6_5::PROPORTIONAL_THREE,
    figure_6_5::PROPORTIONAL_FOUR,
    figure_6_12::EXPERIMENT,
    figure_6_13::EXPERIMENT,
    figure_6_14::EXPERIMENT,
    figure_6_15::EXPERIMENT,
];
