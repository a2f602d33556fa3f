//! Why a recording disagrees: align, locate, explain, refit, show.
//!
//! A mass with drag that its description does not know:
//!
//! ```
//! use rigproof_diagnose::{Options, diagnose};
//! use rigproof_trace::rig::Rig;
//! use rigproof_trace::{Channel, Trace};
//! use std::path::Path;
//!
//! let rig = Rig::parse(
//!     r#"
//!     name = "slide"
//!     plant = "axis"
//!     motion = "linear"
//!     [channels]
//!     position = { channel = "x", unit = "m", quantum = 1e-7 }
//!     command = { channel = "f", unit = "N", noise = 1e-6 }
//!     [parameters]
//!     inertia = { value = 2.0, unit = "kg", status = "known" }
//!     command_gain = { value = 1.0, unit = "N/N", status = "known" }
//!     [protocol]
//!     drive = "held"
//!     "#,
//!     Path::new("rig.toml"),
//! )?;
//! // The exact motion of 2 kg with a drag of 3 N·s/m under a force that is held for a millisecond.
//! let (mass, drag, step) = (2.0, 3.0, 1e-3);
//! let decay = f64::exp(-drag * step / mass);
//! let (mut x, mut v) = (0.0, 0.0);
//! let (mut time, mut position, mut force) = (vec![], vec![], vec![]);
//! for k in 0..8000 {
//!     let t = k as f64 * step;
//!     let f = 4.0 * f64::sin(3.1 * t) + 2.0 * f64::sin(11.3 * t);
//!     time.push(t);
//!     position.push((x / 1e-7_f64).round() * 1e-7);
//!     force.push(f);
//!     let limit = f / drag;
//!     x += limit * step + (v - limit) * (1.0 - decay) * mass / drag;
//!     v = limit + (v - limit) * decay;
//! }
//! let channel = |name: &str, unit: &str, samples| Channel {
//!     name: name.to_owned(),
//!     unit: unit.to_owned(),
//!     samples,
//! };
//! let trace = Trace {
//!     time_s: time,
//!     channels: vec![channel("x", "m", position), channel("f", "N", force)],
//! };
//! let recording = rig.apply(&trace, Path::new("run.csv"))?;
//! let report = diagnose(&rig, &[&recording], None, &Options::default()).report;
//! assert_eq!(report.effects[0].mechanism, "viscous");
//! let coefficient = report.effects[0].parameters["coefficient"].value;
//! assert!((coefficient - 3.0).abs() < 0.03, "{coefficient} N·s/m");
//! # Ok::<(), rigproof_trace::TraceError>(())
//! ```
#![deny(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing
)]

pub mod align;
mod candidates;
pub mod cause;
mod continuity;
mod diagnose;
mod doubt;
mod effect;
mod evidence;
mod explain;
mod filter;
pub mod identify;
mod locate;
pub mod plant;
pub mod plants;
mod problem;
mod regression;
pub mod report;
mod rivals;
pub mod rules;
mod scatter;
mod selection;
pub mod self_calibration;
mod sensor;
mod signals;
pub mod stop;
mod student;
mod unknown;
mod weak;
mod whiten;

pub use diagnose::{Contributed, Curves, Diagnosis, FittedCurves, Options, Stage, Watch, diagnose};
pub use plants::{Description, Measured};
