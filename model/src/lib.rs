//! What the equations compute: the reference model, one equation one function, f64, clarity first.

pub mod axis;
pub mod bench;
pub mod brake;
pub mod control;
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
