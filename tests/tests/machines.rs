//! This file is the parts that remember: random operations on each and on a plain reference, and the laws after every one.

mod backlash;
mod guard;
mod lock_and_gap;
mod reader;
mod stick_slip;
