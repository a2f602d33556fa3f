//! This file answers for recordings from which nothing can be concluded.

use super::{Curves, Diagnosis};
use crate::align::Fault;
use crate::plant::Plant;
use crate::report::{FaultReport, Report, SCHEMA, Verdict};

/// The answer for a faulty channel. `which` names the recording.
pub(crate) fn faulty<P: Plant>(plant: &P, which: &str, fault: Fault) -> Diagnosis<P> {
    let mut diagnosis = empty(
        plant,
        Verdict::DataFault,
        format!(
            "the {which} is at fault: {} from {:.3} to {:.3} s: {}",
            fault.channel, fault.from_s, fault.to_s, fault.reason
        ),
    );
    diagnosis.report.fault = Some(FaultReport {
        channel: fault.channel,
        from_s: fault.from_s,
        to_s: fault.to_s,
        reason: fault.reason,
    });
    diagnosis
}

/// The answer for too little motion, or too short a recording.
pub(crate) fn not_excited<P: Plant>(
    plant: &P,
    [usable, fewest]: [usize; 2],
    travel: f64,
    noise: f64,
) -> Diagnosis<P> {
    empty(
        plant,
        Verdict::NotExcited,
        format!(
            "too little can be told: {usable} windows are usable (at least {fewest} are needed), the rest hold a reversal, a rest, a brake that changes or a gap; travel {travel:.3e}, position noise {noise:.3e}"
        ),
    )
}

fn empty<P: Plant>(plant: &P, verdict: Verdict, summary: String) -> Diagnosis<P> {
    Diagnosis {
        report: blank(plant.plant_name(), verdict, summary),
        calibration: plant.clone(),
        curves: Curves::default(),
        experiment: None,
    }
}

/// A report with a verdict and nothing else.
pub(crate) fn blank(plant: &'static str, verdict: Verdict, summary: String) -> Report {
    Report {
        schema: SCHEMA,
        tool: concat!("rigproof ", env!("CARGO_PKG_VERSION")).to_owned(),
        inputs: Vec::new(),
        plant,
        verdict,
        summary,
        protocol: Vec::new(),
        floor: None,
        located: Vec::new(),
        stages: Vec::new(),
        effects: Vec::new(),
        ambiguous_with: Vec::new(),
        withdrawn: Vec::new(),
        nominal: Default::default(),
        inverse_model: None,
        explanations: Vec::new(),
        not_seen: Vec::new(),
        held: None,
        arm: None,
        null_directions: Vec::new(),
        unknown: None,
        fit: None,
        next_experiment: None,
        self_calibration: None,
        calibration_file: None,
        remarks: Vec::new(),
        fault: None,
    }
}
