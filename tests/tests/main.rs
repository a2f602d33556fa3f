//! This file joins the tests of where rooms meet in one program: it is linked once, and both cores have work until its last test.

mod budget;

mod arm;
mod blind_brake;
mod blind_rig;
mod blind_slice;
mod brake;
mod control_choice;
mod control_laws;
mod diagnosed;
mod experiments;
mod faults;
mod force_limit;
mod friction;
mod golden;
mod identify;
mod impl_batch;
mod impl_laws;
mod impl_plant;
mod impl_tick;
mod impl_velocity;
mod linkage;
mod lumped;
mod machines;
mod metrics;
mod motion;
mod operator;
mod paths;
mod recordings;
mod release;
mod rig;
mod rig_convergence;
mod rig_effects;
mod tables;
mod tidy;
mod trials;
