//! Appendix B, the simulation's verification: the tests of §5.4, each brake locked in turn.

mod figure_b;

use crate::Experiment;

/// The experiments of the appendix.
pub const EXPERIMENTS: &[Experiment] = figure_b::EXPERIMENTS;
