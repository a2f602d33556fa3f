//! Whether the plant that runs in real time is the reference rig: its parts, its order, its energy and whole runs.

mod braked_step;
mod brakes;
mod closed_loop;
mod convergence;
mod dry;
mod effects;
mod energy;
mod form;
mod golden;
mod one_step;
mod rigs;
