//! Whether the plant that runs in real time is the reference rig: its parts, its order, its energy and whole runs.

#[path = "../budget/mod.rs"]
mod budget;

mod convergence;
mod rigs;
