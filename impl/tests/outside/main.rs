//! This file joins what is claimed of this room from outside in one program: the tick is compiled for it once, and it is linked once.

mod another_rig;
mod crossing;
mod decisive;
mod faults;
mod friction;
mod memories;
mod no_plant;
mod nothing_to_go_by;
mod numbers;
mod outcomes;
mod standing;
mod watched;
