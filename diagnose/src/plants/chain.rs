//! This room is the serial arm: its recordings, the momentum equations of its joints, and the
//! physics that its description may lack.

mod align;
mod beside;
mod by_joint;
mod columns;
mod joined;
mod parts;
mod plant;
mod run;
mod simulated;

pub use run::ChainRun;
