//! This file is the report of a diagnosis, with the fields of `report.json`.

mod agreement;
mod arm;
mod fault;
mod read_as;
mod verdict;

use serde::Serialize;
use std::collections::BTreeMap;

pub use crate::continuity::Remark;
pub use agreement::Agreement;
pub use arm::{ArmReport, JointReport, is_of_joint};
pub use fault::FaultReport;
pub use read_as::ReadAs;
pub use verdict::Verdict;

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
    /// `axis`, `bench`, `rig` or `chain`.
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
    /// For each effect, the rivals that explain as much in its place, written `viscous at E` where
    /// there are several joints.
    pub ambiguous_with: Vec<Vec<String>>,
    /// Mechanisms that only substitute for another law over the same variable, and are not named.
    pub withdrawn: Vec<String>,
    /// The nuisance parameters and unknown parameters of the nominal model after the fit.
    pub nominal: BTreeMap<String, Number>,
    /// The inverse model of an axis under the published filter protocol. Its errors are listed with
    /// the stages.
    pub inverse_model: Option<InverseReport>,
    /// The explanations that were compared, the most probable first; none if names were not
    /// compared.
    pub explanations: Vec<ExplanationReport>,
    /// The detection limit of each mechanism that is not named.
    pub not_seen: Vec<NotSeen>,
    /// What joints of a five-bar at rest bound; none on other plants, where an encoder error was
    /// named, or where nothing was concluded.
    pub held: Option<HeldReport>,
    /// What is left over joint by joint; none on other plants than arms.
    pub arm: Option<ArmReport>,
    /// Combinations of parameters that this recording does not identify.
    pub null_directions: Vec<NullDirection>,
    /// The shape of the residual, if it is more than noise.
    pub unknown: Option<Unknown>,
    /// Errors before and after, on the fitted and on the held-out part.
    pub fit: Option<FitReport>,
    /// The experiment that separates a five-bar's rival explanations; none without rivals, and on
    /// other plants.
    pub next_experiment: Option<NextExperiment>,
    /// What the diagnosis finds in simulated recordings like this one, if that was requested.
    pub self_calibration: Option<SelfCalibration>,
    /// The file that holds the calibrated model, beside the report.
    pub calibration_file: Option<String>,
    /// What was repaired in the recordings before anything was fitted, and other remarks.
    pub remarks: Vec<Remark>,
    /// The fault that ended the diagnosis.
    pub fault: Option<FaultReport>,
}

/// What the diagnosis finds in simulated recordings with the same excitation.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SelfCalibration {
    /// How the recordings were simulated.
    pub protocol: String,
    /// With nothing left out of the model: how often something was named.
    pub false_alarms: Rate,
    /// With the found mechanisms left out: how often exactly these were named.
    pub exact: Option<Rate>,
    /// With the found mechanisms left out: how often each was named.
    pub found_again: Vec<NamedRate>,
    /// Names without a cause, with nothing or with the found mechanisms left out; the most frequent
    /// first.
    pub false_names: Vec<NamedRate>,
}

/// A count with its 95 % interval.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Rate {
    /// The count.
    pub count: usize,
    /// The number of trials.
    pub of: usize,
    /// Lower end of the 95 % interval of Clopper and Pearson (1934).
    pub low95: f64,
    /// Upper end.
    pub high95: f64,
}

/// How often a mechanism was named.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct NamedRate {
    /// A mechanism, written `viscous at E` where there are several joints.
    pub name: String,
    /// How often it was named.
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
    /// How a text recording was read; none for other files.
    pub read_as: Option<ReadAs>,
}

/// The residual of the windows beside the predicted noise.
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
    /// The equation whose residual this is.
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

/// The selection after one more mechanism entered.
#[derive(Clone, Debug, Serialize)]
pub struct StageReport {
    /// The mechanism that entered.
    pub entered: &'static str,
    /// The joint at which it acts, where there are several.
    pub joint: Option<&'static str>,
    /// All mechanisms selected by then, written `viscous at E` where there are several joints.
    pub standing: Vec<String>,
    /// Root-mean-square residual of the windows.
    pub residual: f64,
    /// Error of the inverse model with these mechanisms, per cent. Absent where `inverse_model` is,
    /// or where a law has memory, an onset, or acts on the drive.
    pub inverse_error_percent: Option<f64>,
}

/// The inverse model under the published filter protocol, for comparison with published figures. No
/// verdict depends on it.
#[derive(Clone, Debug, Serialize)]
pub struct InverseReport {
    /// The protocol in words.
    pub protocol: String,
    /// Order of the position filter, run forward and backward.
    pub filter_order: usize,
    /// Its cut-off, Hz.
    pub cutoff_hz: f64,
    /// Every n-th sample is kept.
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

/// A set of mechanisms that was compared with others.
#[derive(Clone, Debug, Serialize)]
pub struct ExplanationReport {
    /// Its mechanisms, written `viscous at E` where there are several joints; none for the nominal
    /// model alone.
    pub names: Vec<String>,
    /// Its posterior probability.
    pub probability: f64,
    /// The root-mean-square residual on left-out blocks, in standard deviations of the sensor
    /// noise.
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
    /// Paired z against the model without it, over left-out blocks; over windows if it acts in too
    /// few blocks.
    pub z: f64,
    /// Share of block-bootstrap replicates in which it still reduces the loss by a relevant share.
    pub inclusion: f64,
    /// Share of the left-out loss that it removes from the model without it.
    pub share_explained: f64,
    /// Its posterior probability; 1 if it was not compared.
    pub probability: f64,
    /// `named` from 0.9 on, `suspected` from 0.5 on, else `possible`.
    pub status: &'static str,
    /// Its equation.
    pub equation: &'static str,
    /// What would refute it.
    pub refuted_by: &'static str,
}

/// The detection limit of a mechanism: the least size at which it would have been named.
#[derive(Clone, Debug, Serialize)]
pub struct NotSeen {
    /// The mechanism.
    pub mechanism: &'static str,
    /// The joint, where there are several.
    pub joint: Option<&'static str>,
    /// Its leading parameter.
    pub parameter: &'static str,
    /// The detection limit of that parameter.
    pub minimum_detectable: f64,
    /// Unit of that size.
    pub unit: String,
}

/// What brakes at rest bound: each holds at least the torque it was pushed with.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct HeldReport {
    /// The brakes that were at rest while all others moved, in the order A, E, B, C. Brakes whose
    /// named law depends on past currents are left out.
    pub joints: Vec<HeldJoint>,
    /// Total time in which every brake was at rest, s, in whole windows. The holding torques cannot
    /// be told apart then.
    pub all_seen_s: f64,
    /// Unit of all torques.
    pub unit: String,
}

/// A brake that was at rest while all others moved, in its most informative window.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct HeldJoint {
    /// The joint.
    pub joint: &'static str,
    /// Total time, in whole windows, s.
    pub seen_s: f64,
    /// The middle of the window, s.
    pub at_s: f64,
    /// The torque on the joint, if everything else acts as named.
    pub pushed: f64,
    /// Standard deviation of that torque.
    pub pushed_deviation: f64,
    /// The greatest torque that the joint can hold by the nominal model.
    pub holds_nominal: f64,
    /// The greatest torque that it can hold with the named mechanisms.
    pub holds: f64,
    /// The least torque that named mechanisms must hold, minus five standard deviations; 0 if the
    /// nominal model holds it.
    pub named_at_least: f64,
    /// The least torque that is missing, minus five standard deviations; 0 if none is.
    pub missing: f64,
}

/// A direction in parameter space along which nothing changes.
#[derive(Clone, Debug, Serialize)]
pub struct NullDirection {
    /// The mechanism.
    pub mechanism: &'static str,
    /// Relative change of each parameter, unit length.
    pub direction: BTreeMap<String, f64>,
    /// Smallest over largest eigenvalue of the information matrix.
    pub eigenvalue_ratio: f64,
    /// Its meaning in words.
    pub meaning: String,
}

/// The shape of the residual that the library does not explain.
#[derive(Clone, Debug, Serialize)]
pub struct Unknown {
    /// The variable over which it is most regular.
    pub variable: &'static str,
    /// The joint whose motion it is, where there are several.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub joint: Option<&'static str>,
    /// Unit of the variable.
    pub variable_unit: String,
    /// Whether the curve is a friction level, whose effort acts along the motion.
    pub along_motion: bool,
    /// Share of the remaining energy that a curve over that variable removes on left-out blocks.
    pub share: f64,
    /// Points of the curve: variable, residual.
    pub shape: Vec<(f64, f64)>,
    /// Whether the rising and the falling branch differ.
    pub memory: bool,
    /// `odd`, `even` or `neither` in the variable.
    pub parity: &'static str,
    /// The family of physics that has such a shape.
    pub suggestion: String,
}

/// The simulated experiment that best separates the rival explanations.
#[derive(Clone, Debug, Serialize)]
pub struct NextExperiment {
    /// What to do; none if no experiment separates any two of them.
    pub what: Option<String>,
    /// How long it takes, s.
    pub duration_s: f64,
    /// The greatest current, A; 0 without a brake.
    pub greatest_current_a: f64,
    /// The greatest force of the hand that leads a five-bar, N; 0 on other plants.
    pub greatest_force_n: f64,
    /// Number of experiments that were simulated for the named explanation. The best two were
    /// simulated for every explanation.
    pub tried: usize,
    /// The separation of each pair of explanations.
    pub separations: Vec<Separation>,
    /// Explanations that were not compared: the reference rig cannot simulate them, or there are
    /// many and they fit worst.
    pub not_compared: Vec<String>,
    /// Its file, beside the report.
    pub file: Option<String>,
}

/// Two explanations, and how far an experiment separates them.
#[derive(Clone, Debug, Serialize)]
pub struct Separation {
    /// One cause.
    pub one: String,
    /// The other cause.
    pub other: String,
    /// Separation in standard deviations of the sensor noise, summed over the windows. It is the
    /// lesser of the two, as either cause may be true.
    pub sigmas: f64,
    /// Whether the experiment can tell them apart.
    pub tellable: bool,
}

/// Errors before and after.
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
    /// Held-out error with the named mechanisms and the parameters of the weak form (no
    /// output-error refit).
    pub held_out_without_refit: Option<f64>,
    /// Held-out error of a periodic protocol with the named mechanisms, started from rest without a
    /// warm-up.
    pub held_out_from_rest: Option<f64>,
    /// Error after a given time from the recorded state.
    pub horizon: Vec<Horizon>,
    /// Share of the achievable improvement that was reached on the held-out part (or the fitted one).
    pub recovered_share: f64,
    /// Whether the held-out part improved.
    pub improved: bool,
    /// Whether the held-out error is as large as predicted.
    pub agreement: Option<Agreement>,
    /// A slow drift that the free run needed and that the windows did not show.
    pub drift: Option<String>,
}

/// An error before and after.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct BeforeAfter {
    /// With the nominal model, its unknown parameters fitted.
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

/// Label of the part that was not fitted.
pub const HELD_OUT_PART: &str = "held-out part";
/// Label of the part that was fitted.
pub const FITTED_PART: &str = "fitted part";
