//! This room is a plant of one joint: an axis that is driven, or a bench at which a brake or damper is turned.

pub mod align;
mod checks;
pub mod columns;
mod fitted;
pub mod free_run;
pub mod from_rig;
pub mod inertia;
pub mod inverse;
mod joined;
mod mistaken;
mod plant;
#[cfg(test)]
pub(crate) mod recorded;
pub mod refit;
pub(crate) mod replica;
pub mod run;
mod shapes;
pub mod simulate;
#[cfg(test)]
mod tests;
mod words;
pub(crate) mod write_rig;
