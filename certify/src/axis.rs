//! This file is what is asked of controllers of a driven axis: its trials, its laws, its certificate. The five-bar has its own.

pub mod campaign;
pub mod certificate;
pub mod controller;
pub mod description;
pub mod found;
pub mod law;
pub mod metrics;
pub mod plan;
mod plant;
pub mod scenario;
pub mod trial;
