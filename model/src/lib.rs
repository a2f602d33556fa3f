//! What the equations compute: the reference model, one equation one function, f64, clarity first.
//!
//! A rig at rest, its brake at A holding, pushed for a tenth of a second:
//!
//! ```
//! use rigproof_model::rig::Rig;
//! use rigproof_spec::layout::Layout;
//!
//! let mut rig = Rig::new(Layout::FourBrake, [0.02, 0.40])?;
//! let push = |_tip_m: [f64; 2], _velocity_m_s: [f64; 2]| [1.0, 0.5]; // N
//! for _ in 0..100 {
//!     rig.step_under(&push, [0.8, 0.0, 0.0, 0.0], 1e-3)?;
//! }
//! let [_, y_m] = rig.tip_m();
//! assert!(y_m > 0.40, "the rest of the linkage gives way: {y_m} m");
//! # Ok::<(), rigproof_model::ModelError>(())
//! ```

pub mod axis;
pub mod bench;
pub mod brake;
pub mod chain;
pub mod control;
pub mod displays;
pub mod effects;
pub mod encoder;
pub mod error;
pub mod linkage;
pub mod metrics;
pub mod motion;
pub mod operator;
pub mod rig;
pub mod trial;
pub mod velocity;

pub use error::ModelError;
