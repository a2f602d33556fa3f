//! Chapter 3, the brake: what was run on the bench, run on the model.

mod bench;
mod figure_3_10;
mod figure_3_15;
mod figure_3_17;
mod figure_3_21;
mod figure_3_3;
mod figure_3_4;
mod figure_3_5;
mod figure_3_7;
mod matrix;

use crate::Experiment;

/// The experiments of the chapter.
pub const EXPERIMENTS: &[Experiment] = &[
    figure_3_3::EXPERIMENT,
    figure_3_4::EXPERIMENT,
    figure_3_5::EXPERIMENT,
    figure_3_7::SURFACE,
    figure_3_7::FIT,
    figure_3_7::SCATTER,
    figure_3_10::RISING,
    figure_3_10::FALLING,
    figure_3_10::RISING_FIT,
    figure_3_10::FALLING_FIT,
    figure_3_15::STEP,
    figure_3_15::SINUSOID,
    figure_3_17::EXPERIMENT,
    figure_3_21::SPRING,
    figure_3_21::WALL,
];
