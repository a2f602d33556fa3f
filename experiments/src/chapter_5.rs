//! Chapter 5, the simulation: the tests of §5.4, run on the rig.

mod figure_5_7;
pub(crate) mod release;
mod thesis_rules;

use crate::Experiment;

/// The experiments of the chapter.
pub const EXPERIMENTS: &[Experiment] = &[figure_5_7::THREE_BRAKE, figure_5_7::FOUR_BRAKE];
