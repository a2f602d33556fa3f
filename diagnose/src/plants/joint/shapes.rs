//! This file lists the causes that are candidates on a plant of one joint.

use super::inertia::Inertia;
use super::run::{JointBrake, JointRun, PlantKind};
use crate::cause::Cause;
use crate::plant::Run;
use rigproof_model::effects::facts::Alone;
use rigproof_model::effects::{LIBRARY, facts};
use rigproof_spec::effect::Mechanism;

/// The causes that have a meaning on this plant, in the library's order.
pub fn causes(run: &JointRun) -> Vec<Cause> {
    let has_brake = run.brake().is_some();
    let is_driven = run.plant == PlantKind::Axis;
    // A gain error needs a known effort to be measured against.
    let is_known =
        run.known().iter().any(|e| *e != 0.0) || run.described.iter().any(|e| !e.unknown);
    let asked = |alone: Alone| match alone {
        Alone::Never => false,
        Alone::Always => true,
        Alone::WithKnown => is_known && (is_driven || has_brake),
        Alone::WithBrake => has_brake,
        Alone::WithCharacteristic => matches!(run.law, Some(JointBrake::Characteristic(..))),
        Alone::WithDrive => is_driven || run.predicted.is_some(),
        Alone::Driven => is_driven,
        Alone::Loaded => is_driven || run.load().is_some(),
        Alone::WithInertia => is_driven && matches!(run.inertia, Inertia::Known(_)),
    };
    let library = LIBRARY.iter();
    // If viscous friction is fitted anyway, a bristle law needs no viscous part.
    let is_drag_free = run
        .described
        .iter()
        .any(|e| e.unknown && e.cause.mechanism == Mechanism::Viscous);
    let asked_for = library.filter(|entry| {
        let is_twin = entry.mechanism == Mechanism::LugreBristle && is_drag_free;
        asked(entry.facts.asked.alone) && !is_twin && run.shows(&entry.facts)
    });
    let asked_for: Vec<Cause> = asked_for.map(|entry| Cause::of(entry.mechanism)).collect();
    let is_share =
        |own: &&Cause| has_brake && facts(own.mechanism).is_some_and(|facts| facts.of_torque);
    let shares = asked_for.iter().filter(is_share).map(|own| own.of_torque());
    asked_for.iter().copied().chain(shares).collect()
}
