//! Chapter 3, the brake: what was run on the bench, run on the model.

mod bench;
mod figure_3_3;

use crate::Experiment;

/// The experiments of the chapter.
pub const EXPERIMENTS: &[Experiment] = &[figure_3_3::EXPERIMENT];
