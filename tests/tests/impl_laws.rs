//! This file holds the rig's control laws to the reference's, tick by tick, and to the laws of `spec`.

mod agree;
mod idle;
mod joined;
mod paths;
mod properties;
mod sample;
mod single;
mod standing_tip;
mod tally;
mod ticks;
mod traced;
