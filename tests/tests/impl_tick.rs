//! This file joins the tests of the tick inside the loop: rig, encoders, tick and operator; in double and in single precision.

mod closed_loop;
mod single;
