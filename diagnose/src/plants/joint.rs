//! This room is a plant of one joint: a driven axis, or a bench that turns a brake or damper.

mod agreement;
pub mod align;
mod checks;
pub mod columns;
mod drive;
mod encoder;
mod experiment;
mod fitted;
pub mod free_run;
pub mod from_rig;
pub mod inertia;
pub mod inverse;
mod joined;
mod laws;
#[cfg(test)]
mod loaded;
#[cfg(test)]
mod metamorphic;
mod mistaken;
#[cfg(test)]
mod own_calibration;
mod plant;
#[cfg(test)]
pub(crate) mod recorded;
pub mod refit;
pub(crate) mod replica;
pub mod run;
mod servo;
mod shapes;
pub mod simulate;
mod start;
mod sweep;
#[cfg(test)]
mod tests;
mod undone;
mod words;
pub(crate) mod write_rig;
