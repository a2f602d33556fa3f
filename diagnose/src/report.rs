//! This file is the report: what a diagnosis says, in the fields that `report.json` has.

mod agreement;
mod fault;
mod read_as;

use serde::Serialize;
use std::collections::BTreeMap;

pub use crate::continuity::Remark;
pub use agreement::Agreement;
pub use fault::FaultReport;
pub use read_as::ReadAs;

/// Version of the report's shape.
pub const SCHEMA: &str = "rigproof-report/1";

/// What a diagnosis found.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// Version of this shape.
    pub schema: &'static str,
    /// Name and version of the program.
    pub tool: String,
    /// The files that were read.
    pub inputs: Vec<InputFile>,
    /// `axis`, `bench` or `rig`.
    pub plant: &'static str,
    /// One of the seven verdicts.
    pub verdict: Verdict,
    /// The verdict in one sentence.
    pub summary: String,
    /// How it was measured, line by line.
    pub protocol: Vec<String>,
    /// Residual against what sensor noise alone predicts.
    pub floor: Option<Floor>,
    /// Where the unexplained energy is, largest excess first.
    pub located: Vec<Located>,
    /// How the mechanisms were named, one after another.
    pub stages: Vec<StageReport>,
    /// The mechanisms that are named.
    pub effects: Vec<EffectReport>,
    /// For each effect, what explains as much in its place: a mechanism, or as `viscous at E` where there are several joints; two that do so together as `presliding at E with constant_bias at E`.
    pub ambiguous_with: Vec<Vec<String>>,
    /// Mechanisms that only stand in for another law over the same variable: not named.
    pub withdrawn: Vec<String>,
    /// The nominal model's own unknowns after the fit.
    pub nominal: BTreeMap<String, Number>,
    /// The inverse model of an axis under the published filter protocol; its errors stand with the stages.
    pub inverse_model: Option<InverseReport>,
    /// The explanations that were weighed, the most probable first; none where names were not weighed.
    pub explanations: Vec<ExplanationReport>,
    /// For each mechanism that is not named, what would have been seen.
    pub not_seen: Vec<NotSeen>,
    /// What the joints of a five-bar at rest tell; nothing on other plants, where an encoder was named, and where nothing was concluded.
    pub held: Option<HeldReport>,
    /// Combinations of parameters that this recording cannot tell.
    pub null_directions: Vec<NullDirection>,
    /// The shape of what is left, when it is more than noise.
    pub unknown: Option<Unknown>,
    /// Before and after, on what was fitted and on what was held out.
    pub fit: Option<FitReport>,
    /// What would tell a five-bar's rival explanations apart; nothing where there are none, and on other plants.
    pub next_experiment: Option<NextExperiment>,
    /// What the diagnosis says of simulated recordings like this one, where it was asked to try.
    pub self_calibration: Option<SelfCalibration>,
    /// The file that holds the calibrated model, beside the report.
    pub calibration_file: Option<String>,
    /// What was mended in the recordings before anything was fitted, or is to be said of them.
    pub remarks: Vec<Remark>,
    /// The fault that ended the diagnosis.
    pub fault: Option<FaultReport>,
}

/// What the diagnosis says of simulated recordings that excite what this one excites.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SelfCalibration {
    /// How the recordings were simulated.
    pub protocol: String,
    /// With nothing left out of the model: in how many something was named.
    pub false_alarms: Rate,
    /// With what was found left out: in how many it was named and nothing else.
    pub exact: Option<Rate>,
    /// With what was found left out: in how many each of it was named.
    pub found_again: Vec<NamedRate>,
    /// What was named without being there, with nothing or with what was found left out; the most frequent first.
    pub false_names: Vec<NamedRate>,
}

/// How often something happened.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Rate {
    /// How often it happened.
    pub count: usize,
    /// Of how many.
    pub of: usize,
    /// Lower end of the 95 % interval of Clopper and Pearson (1934).
    pub low95: f64,
    /// Upper end.
    pub high95: f64,
}

/// How often a mechanism was named.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct NamedRate {
    /// A mechanism, or as `viscous at E` where there are several joints.
    pub name: String,
    /// How often.
    #[serde(flatten)]
    pub rate: Rate,
}

/// A file with its hash.
#[derive(Clone, Debug, Serialize)]
pub struct InputFile {
    /// As given.
    pub path: String,
    /// SHA-256 in hexadecimal.
    pub sha256: String,
    /// How a text recording was read; nothing for another file.
    pub read_as: Option<ReadAs>,
}

/// The seven verdicts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// The nominal model explains the recording.
    Consistent,
    /// The named mechanisms explain the recording down to its noise.
    Explained,
    /// Mechanisms are named, and something beyond noise is left.
    PartlyExplained,
    /// Another set of mechanisms explains it as well.
    Ambiguous,
    /// Something is left out that is not in the library.
    NoneOfLibrary,
    /// The recording moves too little to tell.
    NotExcited,
    /// The recording itself is at fault.
    DataFault,
}

impl Verdict {
    /// The name in files.
    pub const fn name(self) -> &'static str {
        match self {
            Verdict::Consistent => "consistent",
            Verdict::Explained => "explained",
            Verdict::PartlyExplained => "partly_explained",
            Verdict::Ambiguous => "ambiguous",
            Verdict::NoneOfLibrary => "none_of_library",
            Verdict::NotExcited => "not_excited",
            Verdict::DataFault => "data_fault",
        }
    }
}

/// Residual of the windows against the predicted noise.
#[derive(Clone, Debug, Serialize)]
pub struct Floor {
    /// Predicted standard deviation.
    pub predicted: f64,
    /// Root mean square with the nominal model.
    pub measured_before: f64,
    /// Root mean square with the named mechanisms.
    pub measured_after: f64,
    /// `measured_before / predicted`.
    pub ratio_before: f64,
    /// `measured_after / predicted`.
    pub ratio_after: f64,
    /// Unit of the first three.
    pub unit: String,
}

/// A regime and its share of the unexplained energy.
#[derive(Clone, Debug, Serialize)]
pub struct Located {
    /// The equation that does not balance.
    pub output: &'static str,
    /// The joint, where there are several.
    pub joint: Option<&'static str>,
    /// The regime, in words.
    pub regime: String,
    /// First time in that regime, s.
    pub from_s: f64,
    /// Last time in that regime, s.
    pub to_s: f64,
    /// Share of the windows that lie in it.
    pub share_of_time: f64,
    /// Share of the nominal model's unexplained energy.
    pub share: f64,
    /// 95 % interval of `share` by block bootstrap.
    pub share_low95: f64,
    /// Upper end.
    pub share_high95: f64,
    /// Share of the energy that is left with the named mechanisms.
    pub share_after: f64,
}

/// One step of the naming.
#[derive(Clone, Debug, Serialize)]
pub struct StageReport {
    /// What entered.
    pub entered: &'static str,
    /// The joint at which it acts, where there are several.
    pub joint: Option<&'static str>,
    /// What stood then; with its joint where there are several, as `viscous at E`.
    pub standing: Vec<String>,
    /// Root-mean-square residual of the windows then.
    pub residual: f64,
    /// Error of the inverse model with what stood then, per cent; absent where `inverse_model` is, or where a law has a
    /// memory, an onset, or acts on the drive.
    pub inverse_error_percent: Option<f64>,
}

/// The inverse model under the published filter protocol: for comparison with published figures, no verdict rests on it.
#[derive(Clone, Debug, Serialize)]
pub struct InverseReport {
    /// The protocol in words.
    pub protocol: String,
    /// Order of the position filter, run forward and backward.
    pub filter_order: usize,
    /// Its cut-off, Hz.
    pub cutoff_hz: f64,
    /// Every how many samples one is kept.
    pub decimation: usize,
    /// Error with the nominal model alone, per cent of the effort.
    pub nominal_error_percent: f64,
}

/// A number with its unit and interval.
#[derive(Clone, Debug, Serialize)]
pub struct Number {
    /// The value.
    pub value: f64,
    /// Its unit.
    pub unit: String,
    /// 95 % interval; absent when the recording does not determine it.
    pub low95: Option<f64>,
    /// Upper end.
    pub high95: Option<f64>,
}

/// A set of mechanisms that explains the recording, beside others.
#[derive(Clone, Debug, Serialize)]
pub struct ExplanationReport {
    /// Its mechanisms, as `viscous at E` where there are several joints; none for the nominal model alone.
    pub names: Vec<String>,
    /// How probable it is beside the others.
    pub probability: f64,
    /// What it leaves of data that was not fitted, in standard deviations of the sensors' noise.
    pub leaves: f64,
}

/// A named mechanism.
#[derive(Clone, Debug, Serialize)]
pub struct EffectReport {
    /// Its name in the vocabulary.
    pub mechanism: &'static str,
    /// The joint, where there are several.
    pub joint: Option<&'static str>,
    /// Its parameters.
    pub parameters: BTreeMap<String, Number>,
    /// When it begins, s after the first sample.
    pub onset_s: Option<f64>,
    /// 95 % interval of the onset, s.
    pub onset_low95_s: Option<f64>,
    /// Upper end.
    pub onset_high95_s: Option<f64>,
    /// Paired z against the model without it, over left-out blocks; over windows where it shows in too few blocks.
    pub z: f64,
    /// Share of block-bootstrap replicates in which it still passes.
    pub inclusion: f64,
    /// Share of the left-out loss that it removes from the model without it.
    pub share_explained: f64,
    /// How probable it is beside everything that was tried; 1 where it was not weighed.
    pub probability: f64,
    /// `named` from 0.9 on, `suspected` from 0.5 on, else `possible`.
    pub status: &'static str,
    /// Its equation.
    pub equation: &'static str,
    /// What would refute it.
    pub refuted_by: &'static str,
}

/// The least size at which a mechanism would have been named.
#[derive(Clone, Debug, Serialize)]
pub struct NotSeen {
    /// The mechanism.
    pub mechanism: &'static str,
    /// The joint, where there are several.
    pub joint: Option<&'static str>,
    /// The parameter that was bounded.
    pub parameter: &'static str,
    /// Its least visible size.
    pub minimum_detectable: f64,
    /// Unit of that size.
    pub unit: String,
}

/// What brakes at rest tell: each holds at least what it was pushed with.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct HeldReport {
    /// The brakes that were at rest alone, in the order A, E, B, C; those are left out whose named law depends on what the brake did before.
    pub joints: Vec<HeldJoint>,
    /// For how long, by whole windows, every brake was at rest, s: what each of them holds then cannot be told, and nothing is attributed.
    pub all_seen_s: f64,
    /// Unit of all torques.
    pub unit: String,
}

/// A brake that was at rest while all others moved, in the window that says most.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct HeldJoint {
    /// The joint.
    pub joint: &'static str,
    /// For how long, by whole windows, s.
    pub seen_s: f64,
    /// The middle of the window, s.
    pub at_s: f64,
    /// The torque on the joint there, everything else being as named.
    pub pushed: f64,
    /// Standard deviation of that torque.
    pub pushed_deviation: f64,
    /// The most that the nominal model lets the joint hold there.
    pub holds_nominal: f64,
    /// The most that it holds there with what is named at it.
    pub holds: f64,
    /// What the names have to hold at least, five standard deviations aside; 0 where the nominal model holds it.
    pub named_at_least: f64,
    /// What is missing at least, five standard deviations aside; 0 where nothing has to be.
    pub missing: f64,
}

/// A combination of parameters along which nothing changes.
#[derive(Clone, Debug, Serialize)]
pub struct NullDirection {
    /// The mechanism.
    pub mechanism: &'static str,
    /// Relative change of each parameter, unit length.
    pub direction: BTreeMap<String, f64>,
    /// Smallest over largest eigenvalue of the information matrix.
    pub eigenvalue_ratio: f64,
    /// In words.
    pub meaning: String,
}

/// The shape of what the library does not explain.
#[derive(Clone, Debug, Serialize)]
pub struct Unknown {
    /// The variable that orders it best.
    pub variable: &'static str,
    /// The joint whose motion it is, where there are several.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub joint: Option<&'static str>,
    /// Unit of the variable.
    pub variable_unit: String,
    /// Whether the curve is a level along the motion, as a friction's is, instead of an effort.
    pub along_motion: bool,
    /// Share of the remaining energy that a curve over that variable takes away, on left-out blocks.
    pub share: f64,
    /// Points of the curve: variable, residual.
    pub shape: Vec<(f64, f64)>,
    /// Whether the rising and the falling branch differ.
    pub memory: bool,
    /// `odd`, `even` or `neither` in the variable.
    pub parity: &'static str,
    /// What family of physics has such a shape.
    pub suggestion: String,
}

/// The experiment that tells rival explanations apart best, of those that were simulated.
#[derive(Clone, Debug, Serialize)]
pub struct NextExperiment {
    /// What to do; nothing where no experiment tells any two of them apart.
    pub what: Option<String>,
    /// How long it takes, s.
    pub duration_s: f64,
    /// The greatest current it asks for, A.
    pub greatest_current_a: f64,
    /// The greatest force of the hand, N.
    pub greatest_force_n: f64,
    /// How many experiments were simulated for the named explanation; the best two of them were for every one.
    pub tried: usize,
    /// How far it sets each pair of explanations apart.
    pub separations: Vec<Separation>,
    /// Explanations that are in no comparison: the reference rig does not compute them, or they leave most where there are many.
    pub not_compared: Vec<String>,
    /// Its file, beside the report.
    pub file: Option<String>,
}

/// Two explanations and how far an experiment sets them apart.
#[derive(Clone, Debug, Serialize)]
pub struct Separation {
    /// One cause.
    pub one: String,
    /// The other one in its place.
    pub other: String,
    /// Standard deviations of the sensors' noise, summed over the windows, by which either leaves more of the other's recording.
    pub sigmas: f64,
    /// Whether this experiment tells them apart.
    pub tellable: bool,
}

/// Before and after.
#[derive(Clone, Debug, Serialize)]
pub struct FitReport {
    /// How it was measured.
    pub protocol: String,
    /// Unit of all errors below.
    pub unit: String,
    /// On the fitted part.
    pub train: BeforeAfter,
    /// On the held-out part.
    pub held_out: Option<BeforeAfter>,
    /// Held-out part with the mechanisms named, but the numbers of the windows (no output-error refit).
    pub held_out_without_refit: Option<f64>,
    /// Held-out part of a periodic protocol, with the mechanisms named, started from rest without a warm-up.
    pub held_out_from_rest: Option<f64>,
    /// Error after a given time from the recorded state.
    pub horizon: Vec<Horizon>,
    /// Share of the achievable improvement that was reached on the held-out part (or the fitted one).
    pub recovered_share: f64,
    /// Whether the held-out part improved.
    pub improved: bool,
    /// Whether the held-out part agrees with the windows.
    pub agreement: Option<Agreement>,
    /// A slow drift that the free run needed and the windows could not see.
    pub drift: Option<String>,
}

/// A figure before and after.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct BeforeAfter {
    /// With the nominal model, its unknowns fitted.
    pub before: f64,
    /// With the named mechanisms.
    pub after: f64,
    /// `before` in per cent of the output's standard deviation.
    pub nrmse_before: f64,
    /// `after` in per cent of the output's standard deviation.
    pub nrmse_after: f64,
}

/// Error at a horizon.
#[derive(Clone, Debug, Serialize)]
pub struct Horizon {
    /// Time from the recorded state, s.
    pub horizon_s: f64,
    /// The part of the recording on which it was measured.
    pub part: &'static str,
    /// Unit of `before` and `after`: that of the position, or of the angles of the five-bar's base joints.
    pub unit: String,
    /// Nominal model.
    pub before: f64,
    /// With the named mechanisms.
    pub after: f64,
    /// Distance of a five-bar's tip from the recorded one, mm, nominal model.
    pub tip_before_mm: Option<f64>,
    /// Distance of a five-bar's tip from the recorded one, mm, with the named mechanisms.
    pub tip_after_mm: Option<f64>,
}

/// What was not fitted, in words.
pub const HELD_OUT_PART: &str = "held-out part";
/// What was fitted, in words.
pub const FITTED_PART: &str = "fitted part";
