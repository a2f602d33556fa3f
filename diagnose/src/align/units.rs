//! This file finds stated units that a recording contradicts: its resolution or its noise fits
//! another unit.

use super::{Fault, smallest_step};
use crate::continuity::roughness;
use crate::filter::rms;
use crate::rules::{MOST_SCATTER, NEAR_UNIT, THOUSANDFOLD};

/// A channel with its stated properties.
pub(crate) struct Stated<'a> {
    /// Its role.
    pub channel: &'static str,
    /// Its samples.
    pub samples: &'a [f64],
    /// Its resolution, if stated.
    pub quantum: Option<f64>,
    /// Its noise including its resolution, if stated.
    pub noise: Option<f64>,
}

/// Ratios between units that are often confused, with their names.
const UNITS: [(f64, &str); 4] = [
    (
        180.0 / core::f64::consts::PI,
        "degrees, described as radians",
    ),
    (
        core::f64::consts::PI / 180.0,
        "radians, described as degrees",
    ),
    (1000.0, "thousandths (mm, mrad), described as whole units"),
    (1e-3, "whole units, described as thousandths"),
];

/// # Errors
/// The smallest step of the samples, or their scatter, fits the stated value in another unit.
pub(crate) fn check_units(stated: &Stated<'_>, ends_s: [f64; 2]) -> Result<(), Fault> {
    let [from_s, to_s] = ends_s;
    let fault = |reason| {
        Err(Fault {
            channel: stated.channel,
            from_s,
            to_s,
            reason,
        })
    };
    if let Some(quantum) = stated.quantum {
        let times = smallest_step(stated.samples) / quantum;
        let near = |(unit, _): &&(f64, &str)| (times / unit - 1.0).abs() < NEAR_UNIT;
        if let Some((_, words)) = UNITS.iter().find(near) {
            return fault(format!(
                "its smallest step is {times:.4} times the stated quantum: the samples seem to be {words}; correct `unit`, or `quantum`"
            ));
        }
    }
    let Some(noise) = stated.noise.filter(|noise| *noise > 0.0) else {
        return Ok(());
    };
    let scatter = roughness(stated.samples);
    let times = scatter / noise;
    // A command that chatters scatters too, but by more than any sensor's noise.
    if THOUSANDFOLD.contains(&times) && scatter < MOST_SCATTER * rms(stated.samples) {
        return fault(format!(
            "its samples scatter {times:.0} times as much as the stated noise: they seem to be thousandths (mN, mN·m, mV), described as whole units; correct `unit`, or `noise`"
        ));
    }
    Ok(())
}
