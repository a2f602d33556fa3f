//! This file joins the tests of the tick inside the loop: rig, encoders, tick and operator; in double and in single precision.

#[path = "../budget/mod.rs"]
mod budget;
mod closed_loop;
mod single;
