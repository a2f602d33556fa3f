//! What the rig runs: one tick of a controller, one step of the plant. No standard library but for the feature `batch`, no heap, no
//! panic, and bounded work in every tick.
//!
//! A controller that leads along a line, told where the encoders stand and what the hand does:
//!
//! ```
//! use rigproof_impl::actuation::Actuation;
//! use rigproof_impl::law::Proportional;
//! use rigproof_impl::path::Line;
//! use rigproof_impl::tick::{Sensed, Settings, Tick};
//! use rigproof_impl::vector::Vector;
//! use rigproof_spec::layout::Layout;
//! use rigproof_spec::methods::BLEND_BOUNDARY_M;
//!
//! let layout = Layout::FourBrake;
//! let line: Line<f64> = Line::through([-0.1, 0.37], [0.1, 0.40]).unwrap();
//! let law = Proportional::new(Actuation::thesis(layout), line, BLEND_BOUNDARY_M, 500.0).unwrap();
//! let mut controller = Tick::new(&Settings::thesis(layout), law).unwrap();
//! for number in 0..10 {
//!     let sensed = Sensed { number, counts: [31_000, 14_000], tip_force_n: Vector::new(0.5, -0.3) };
//!     let command = controller.tick(&sensed);
//!     assert!(command.currents_a.iter().all(|current| (0.0..=1.0).contains(current)));
//! }
//! ```
#![no_std]
#![deny(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing
)]

pub mod actuation;
#[cfg(feature = "batch")]
pub mod batch;
#[cfg(any(kani, feature = "claims"))]
pub mod claim;
pub mod command;
pub mod current;
pub mod encoder;
pub mod guard;
pub mod law;
pub mod linkage;
pub mod monitor;
pub mod number;
pub mod path;
pub mod plant;
pub mod select;
mod setting;
pub mod tick;
pub mod tip_mass;
pub mod vector;
pub mod velocity;
