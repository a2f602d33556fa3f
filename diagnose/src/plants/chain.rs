//! This room is the serial arm: its recordings, its equations in the momenta of the joints, and what can be left out of its description.

mod align;
mod beside;
mod plant;
mod run;

pub use run::ChainRun;
