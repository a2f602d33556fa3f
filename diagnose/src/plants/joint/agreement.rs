//! This file checks whether the error of the held-out free run is as large as noise, residual and
//! parameter intervals predict.

use super::refit::errors;
use super::run::{JointRun, PlantKind};
use super::simulate::{Model, Protocol};
use crate::diagnose::write::Stand;
use crate::evidence::Intervals;
use crate::filter::rms;
use crate::report::Agreement;
use crate::rules::AGREES_WITHIN;
use crate::sensor::normal;
use core::f64::consts::SQRT_2;
use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::SeedableRng;
use rigproof_trace::rig::Rig;

/// Half width of a 95 % interval, in standard deviations.
const NORMAL: f64 = 1.959_963_984_540_054;
/// Seed of the noise that is added to the effort of a trial run.
const SEED: u64 = 41;

impl Stand<'_, Rig> {
    /// Compares the held-out free run with its predicted error. `None` with a brake: the edges of
    /// its torque are known to one sample only.
    pub(super) fn agreement(
        &self,
        plant: &Model,
        intervals: &Intervals,
        protocol: &Protocol,
    ) -> Option<Agreement> {
        let test = self.test;
        if self.train.brake().is_some() {
            return None;
        }
        let own = errors(plant, test, protocol);
        let changed = |other: &[f64]| -> f64 {
            let pairs = own.iter().zip(other);
            rms(&pairs.map(|(own, other)| other - own).collect::<Vec<f64>>())
        };
        let mut variance = 0.0;
        for other in moved(plant, intervals) {
            let other = changed(&errors(&other, test, protocol));
            variance += if other.is_finite() {
                other * other
            } else {
                0.0
            };
        }
        let noise = match test.plant {
            PlantKind::Axis => {
                let other = changed(&errors(plant, &noisy(test), protocol));
                test.position_noise.hypot(other)
            }
            // On a bench the scatter between neighbouring samples is noise, whatever noise the
            // description states.
            PlantKind::Bench => {
                let next = own.iter().skip(1);
                let jumps: Vec<f64> = own.iter().zip(next).map(|(a, b)| b - a).collect();
                test.effort_noise.max(rms(&jumps) / SQRT_2)
            }
        };
        variance += noise * noise;
        // The model discrepancy that the windows show acts on a free run too.
        let discrepancy = self.floor().ratio_after.max(1.0);
        let allowed = AGREES_WITHIN * discrepancy * variance.sqrt();
        let first_s = test.start_s + test.len().saturating_sub(own.len()) as f64 * test.step_s;
        let own = own.iter().enumerate();
        let timed = own.map(|(k, error)| (*error, first_s + k as f64 * test.step_s));
        Some(Agreement::of(&timed.collect::<Vec<_>>(), allowed))
    }
}

/// The plant with one parameter at a time moved by its standard deviation.
fn moved(plant: &Model, intervals: &Intervals) -> Vec<Model> {
    let mut all = Vec::new();
    if let Some(half) = intervals.nuisances.first().filter(|half| half.is_finite()) {
        all.push(Model {
            inertia: plant.inertia + half / NORMAL,
            ..plant.clone()
        });
    }
    for (index, halves) in intervals.terms.iter().enumerate() {
        for (place, half) in halves
            .iter()
            .enumerate()
            .filter(|(_, half)| half.is_finite())
        {
            let mut moved = plant.clone();
            let effect = moved.effects.get_mut(index);
            if let Some(number) = effect.and_then(|own| own.parameters.get_mut(place)) {
                *number += half / NORMAL;
                all.push(moved);
            }
        }
    }
    all
}

/// The recording with extra noise on the effort, of the stated size.
fn noisy(run: &JointRun) -> JointRun {
    let mut random = Pcg64Mcg::seed_from_u64(SEED);
    let mut own = run.part(0, run.len());
    for effort in &mut own.effort {
        *effort += run.effort_noise * normal(&mut random);
    }
    own
}
