//! This file says that the other displays of chapter 2 obey their laws, whatever pushes them.

mod hands;
mod osaka;
mod padyc;
mod plant;
mod pter;
mod scooter;
