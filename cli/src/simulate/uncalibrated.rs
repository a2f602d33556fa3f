//! This file runs the rig's own numbers beside a calibration, so that both errors stand side by side.

use rigproof_diagnose::plant::Simulated;
use rigproof_diagnose::{Curves, Description, Measured};
use rigproof_trace::compare::{Comparison, compare};
use serde_json::{Value, json};

use super::in_json;
use crate::picture;
use crate::text::number::{significant, with_unit};

/// A simulation with the rig's own numbers, and how far it is off.
pub struct Uncalibrated {
    simulated: Simulated,
    /// An entry an output.
    pub off: Vec<Comparison>,
}

impl Uncalibrated {
    /// Nothing where the rig's own numbers are not complete enough to run.
    pub fn of(rig: &Description, recording: &Measured, restart_s: f64) -> Option<Uncalibrated> {
        let simulated = rig.simulated(rig, recording, restart_s).ok()?;
        let outputs = simulated.outputs.iter();
        let off = outputs.map(|own| compare(&own.counted(), &own.simulated).ok());
        let off = off.collect::<Option<Vec<_>>>()?;
        Some(Uncalibrated { simulated, off })
    }

    /// How far every output is off; `calibrated` gives their names.
    pub fn json(&self, calibrated: &Simulated) -> Value {
        let pairs = calibrated.outputs.iter().zip(&self.off);
        let all = pairs.map(|(own, off)| (own.name.to_owned(), in_json(off, &own.unit)));
        json!(all.collect::<serde_json::Map<_, _>>())
    }
}

/// The first output that was recorded, and both models over it.
///
/// # Errors
/// In words: there is no such output, or the rig's own numbers do not run.
pub fn picture(
    rig: &str,
    without: Option<&Uncalibrated>,
    calibrated: &Simulated,
) -> Result<String, String> {
    let without =
        without.ok_or("the rig's own numbers do not run, so there is nothing to compare")?;
    let mut outputs = calibrated.outputs.iter().zip(&without.simulated.outputs);
    let recorded = outputs.find_map(|(new, old)| Some((new, old, new.recorded.as_ref()?)));
    let Some((new, old, recorded)) = recorded else {
        return Err("this plant starts again from the recorded state, over and over: there is no single run to draw".to_owned());
    };
    let errors = compare(&old.counted(), &old.simulated)
        .and_then(|before| Ok((before, compare(&new.counted(), &new.simulated)?)))
        .map_err(|error| error.to_string())?;
    let (before, after) = errors;
    let curves = Curves {
        time_s: calibrated.time_s.clone(),
        output: new.name,
        recorded: recorded.clone(),
        before: old.simulated.clone(),
        after: new.simulated.clone(),
        unit: new.unit.clone(),
        ..Curves::default()
    };
    let title = format!(
        "Error {} → {}",
        significant(before.rms, 3),
        with_unit(after.rms, &new.unit)
    );
    let names = ["without the calibration", "with the calibration"];
    Ok(picture::overlay((&title, rig), names, &curves))
}
