//! How chapter 3 turns steps of current into a brake's table (§3.4): one step, then the fits over many.

mod fits;
mod least_squares;
mod step;

pub use fits::{GainFit, SurfaceFit, average, gain_fit, surface_fit};
pub use least_squares::{Estimate, Fit, Row, least_squares};
pub use step::{StepFit, TRANSIENT, elapsed_over_time_constant, fit_step};
