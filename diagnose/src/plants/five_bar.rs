//! This room is the five-bar with three or four brakes: its recordings, its noise model, its
//! regression columns and its free runs.

pub mod calibrated;
pub mod candidates;
mod checks;
pub mod columns;
pub(crate) mod encoder;
mod equations;
pub mod experiment;
pub mod free_run;
mod free_runs;
pub mod from_rig;
mod held;
mod joined;
mod locate;
mod mapping;
#[cfg(test)]
mod mechanisms;
pub mod noise;
#[cfg(test)]
mod own_calibration;
mod plant;
mod protocol;
#[cfg(test)]
pub(crate) mod recorded;
pub mod replay;
pub(crate) mod replica;
pub mod run;
mod sensors;
mod stops;
#[cfg(test)]
mod tests;
mod undone;
