//! This file runs the stages in order: align, locate, explain, refit, show.

use crate::align::{Fault, band_hz};
use crate::evidence::{
    coefficients_by_term, inclusion, not_seen, null_directions, parameters, rivals, standard_errors,
};
use crate::free_run::{HORIZONS_S, Shown, figure, horizon_error, show};
use crate::from_rig;
use crate::locate::locate;
use crate::problem::{Inertia, Problem, Term};
use crate::report::*;
use crate::run::{PlantKind, Run};
use crate::select::{FLOOR_RATIO, Gates, Selection, refs, select, usable_rms};
use crate::simulate::{Effect, Plant, Protocol, output};
use crate::unknown::{surrogates, unknown};
use crate::weak::{Windows, choose_width};
use crate::write_rig::calibrated;
use rigproof_model::effects::entry;
use rigproof_spec::effect::{Mechanism, Quantity};
use rigproof_trace::rig::{Recording, Rig};

/// What a diagnosis is asked to do.
#[derive(Clone, Debug)]
pub struct Options {
    /// What a mechanism must show before it is named.
    pub gates: Gates,
    /// Share of the recording's end that is held out when no other recording is.
    pub hold_out_share: f64,
    /// Whether the numbers are refitted by free runs (the naming does not need it).
    pub refit: bool,
}

impl Default for Options {
    fn default() -> Options {
        Options {
            gates: Gates::default(),
            hold_out_share: 0.25,
            refit: true,
        }
    }
}

/// A report, the calibrated model, and the curves that its pictures need.
pub struct Diagnosis {
    /// What was found.
    pub report: Report,
    /// The rig with the physics found and the numbers fitted.
    pub calibration: Rig,
    /// Curves for the pictures; empty after a fault.
    pub curves: Curves,
}

/// Curves over time: of the held-out part before and after, and the residual of the windows.
#[derive(Clone, Debug, Default)]
pub struct Curves {
    /// Time stamps of the held-out part, s.
    pub time_s: Vec<f64>,
    /// Recorded output: position of an axis, effort of a bench.
    pub recorded: Vec<f64>,
    /// Output of the nominal model.
    pub before: Vec<f64>,
    /// Output with the named mechanisms.
    pub after: Vec<f64>,
    /// Whether a sample counts in the figures.
    pub unit: String,
    /// Window times of the fitted part, s.
    pub window_time_s: Vec<f64>,
    /// Residual effort with the nominal model.
    pub residual_before: Vec<f64>,
    /// Residual effort with the named mechanisms.
    pub residual_after: Vec<f64>,
    /// Predicted standard deviation of the residual.
    pub floor: f64,
    /// Unit of the residual.
    pub residual_unit: String,
}

/// Fewest windows from which anything can be said.
const FEWEST_WINDOWS: usize = 40;

/// Diagnoses a recording of a rig; `held_out` is another recording of the same rig.
pub fn diagnose(
    rig: &Rig,
    recording: &Recording,
    held_out: Option<&Recording>,
    options: &Options,
) -> Diagnosis {
    let aligned = match from_rig::aligned(rig, recording) {
        Ok(run) => run,
        Err(fault) => return faulty(rig, "recording", fault),
    };
    let (train, test) = match held_out {
        Some(recording) => match from_rig::aligned(rig, recording) {
            Ok(run) => (aligned, run),
            Err(fault) => return faulty(rig, "held-out recording", fault),
        },
        None => split(&aligned, options.hold_out_share),
    };
    let inertia = from_rig::inertia(rig);
    let start = match inertia {
        Inertia::None => 0.0,
        Inertia::Known(value) | Inertia::Unknown(value) => value,
    };
    let width_s = choose_width(&train, start, band_hz(&train.effort, train.step_s));
    let windows = Windows::new(&train, width_s);
    let mut problem = Problem::new(&train, windows, inertia);
    let usable = problem.windows.usable.iter().filter(|u| **u).count();
    if usable < FEWEST_WINDOWS || train.travel() < 20.0 * train.position_noise {
        return not_excited(rig, &train, usable);
    }
    let nominal: Vec<Term> = from_rig::nominal(rig)
        .iter()
        .filter_map(|n| problem.nominal_term(n))
        .collect();
    let mut selection = select(&mut problem, nominal, options.gates);
    if let Some(fault) = reversed_drive(&problem, &selection) {
        return faulty(rig, "recording", fault);
    }
    let withdrawn = withdraw_surrogates(&problem, &mut selection, rig);
    Stand {
        rig,
        problem: &problem,
        selection: &selection,
        withdrawn: &withdrawn,
        train: &train,
        test: &test,
        options,
        width_s,
    }
    .report(held_out.is_some())
}

/// A gain error of more than the whole gain is a channel with the wrong sign.
fn reversed_drive(problem: &Problem, selection: &Selection) -> Option<Fault> {
    let (_, coefficients) = coefficients_by_term(problem, selection);
    let terms = refs(&selection.nominal, &selection.found);
    let fraction = terms
        .iter()
        .zip(&coefficients)
        .find(|(term, _)| term.mechanism == Mechanism::GainError)
        .and_then(|(term, own)| parameters(term, own).first().copied())?;
    (fraction < -1.0).then(|| Fault {
        channel: "drive",
        from_s: problem.run.start_s,
        to_s: problem.run.start_s + problem.run.duration_s(),
        reason: "the plant answers against its drive: the command, the force or the position has the wrong sign (set `sign = -1`)".to_owned(),
    })
}

/// Takes out the names that only stand in for another law, where more than noise is left.
fn withdraw_surrogates(problem: &Problem, selection: &mut Selection, rig: &Rig) -> Vec<Mechanism> {
    let ratio = usable_rms(problem, &selection.after.residual) / problem.floor;
    if ratio <= FLOOR_RATIO {
        return Vec::new();
    }
    let found: Vec<Mechanism> = selection.found.iter().map(|f| f.term.mechanism).collect();
    let withdrawn = surrogates(problem, &selection.after.residual, &found, rig.motion);
    selection.withdraw(problem, &withdrawn);
    withdrawn
}

fn split(run: &Run, share: f64) -> (Run, Run) {
    let cut = ((1.0 - share) * run.len() as f64).round() as usize;
    (run.slice(0, cut), run.slice(cut, run.len()))
}

/// Everything the report is written from.
struct Stand<'a> {
    rig: &'a Rig,
    problem: &'a Problem<'a>,
    selection: &'a Selection,
    withdrawn: &'a [Mechanism],
    train: &'a Run,
    test: &'a Run,
    options: &'a Options,
    width_s: f64,
}

/// The plants before and after, and their free runs.
struct Fitted {
    nominal: Shown,
    found: Shown,
    by_windows: Plant,
}

impl Stand<'_> {
    fn report(&self, other_recording: bool) -> Diagnosis {
        let protocol = from_rig::protocol(self.rig);
        let fitted = self.fit(&protocol);
        let rivals = self.rivals();
        let floor = self.floor();
        let verdict = self.verdict(&floor, &rivals);
        let unknown = (floor.ratio_after > FLOOR_RATIO)
            .then(|| {
                unknown(
                    self.problem,
                    &self.selection.after.residual,
                    self.rig.motion,
                )
            })
            .flatten();
        let fit = fitted
            .as_ref()
            .map(|f| self.fit_report(f, &protocol, other_recording));
        let plants = match &fitted {
            Some(f) => (f.nominal.plant.clone(), f.found.plant.clone()),
            None => (self.plant(false), self.plant(true)),
        };
        let errors = standard_errors(self.problem, self.selection);
        let calibration = calibrated(self.rig, &plants.1, &errors, fitted.is_some());
        let summary = summary(verdict, self.selection, fit.as_ref());
        let report = Report {
            schema: SCHEMA,
            tool: concat!("rigproof ", env!("CARGO_PKG_VERSION")).to_owned(),
            inputs: Vec::new(),
            plant: self.rig.plant.name(),
            verdict,
            summary,
            protocol: self.protocol_lines(&protocol, other_recording),
            floor: Some(floor),
            located: locate(
                self.problem,
                &self.selection.before.residual,
                &self.selection.after.residual,
            ),
            stages: self.stages(),
            effects: self.effects(&calibration),
            ambiguous_with: rivals
                .iter()
                .map(|r| r.iter().map(|m| m.name()).collect())
                .collect(),
            too_small_to_name: self
                .selection
                .too_small
                .iter()
                .map(|m| m.name().to_owned())
                .collect(),
            withdrawn: self.withdrawn.iter().map(|m| m.name()).collect(),
            nominal: crate::write_rig::nominal_numbers(self.rig, &calibration),
            not_seen: not_seen(
                self.problem,
                self.selection,
                self.options.gates,
                self.rig.motion,
            ),
            null_directions: null_directions(self.problem, self.selection),
            unknown,
            fit,
            next_experiment: None,
            self_calibration: None,
            calibration_file: None,
            fault: None,
        };
        let curves = self.curves(&plants.0, &plants.1, &protocol);
        Diagnosis {
            report,
            calibration,
            curves,
        }
    }

    /// The plant of the windows' fit, with or without the mechanisms found.
    fn plant(&self, found: bool) -> Plant {
        let mut selection = self.selection.clone();
        if !found {
            selection.found.clear();
            selection.after = selection.before.clone();
        }
        let (inertia, coefficients) = coefficients_by_term(self.problem, &selection);
        let terms = refs(&selection.nominal, &selection.found);
        let effects = terms
            .iter()
            .zip(&coefficients)
            .map(|(term, own)| Effect {
                mechanism: term.mechanism,
                parameters: parameters(term, own),
                onset_s: term.onset_s,
            })
            .collect();
        let given = from_rig::plant(self.rig).inertia;
        Plant {
            inertia: inertia.unwrap_or(given).max(1e-3 * given),
            effects,
        }
    }

    fn fit(&self, protocol: &Protocol) -> Option<Fitted> {
        if !self.options.refit {
            return None;
        }
        let inertia_free = matches!(self.problem.inertia, Inertia::Unknown(_));
        let known_nominal: Vec<bool> = self
            .selection
            .nominal
            .iter()
            .map(|t| t.known.is_some())
            .collect();
        let mut known_all = known_nominal.clone();
        known_all.extend(self.selection.found.iter().map(|_| false));
        let by_windows = self.plant(true);
        let found = show(
            &by_windows,
            inertia_free,
            &known_all,
            self.train,
            protocol,
            // Where the windows leave only noise there is nothing that a drift could stand for.
            !self.selection.found.is_empty() && self.floor().ratio_after > FLOOR_RATIO,
        );
        let nominal = show(
            &self.plant(false),
            inertia_free,
            &known_nominal,
            self.train,
            protocol,
            false,
        );
        Some(Fitted {
            nominal,
            found,
            by_windows,
        })
    }

    /// For each effect, what explains as much in its place: measured rivals, and the twin that no recording of this
    /// plant can tell: a constant that changes no sign with the motion is a bias or a direction asymmetry.
    fn rivals(&self) -> Vec<Vec<Mechanism>> {
        let mut all = rivals(self.problem, self.selection);
        for (rivals, found) in all.iter_mut().zip(&self.selection.found) {
            let twin = match found.term.mechanism {
                Mechanism::ConstantBias => Mechanism::DirectionAsymmetry,
                Mechanism::DirectionAsymmetry => Mechanism::ConstantBias,
                _ => continue,
            };
            let taken = refs(&self.selection.nominal, &self.selection.found)
                .iter()
                .any(|t| t.mechanism == twin);
            if !taken && !rivals.contains(&twin) {
                rivals.push(twin);
            }
        }
        all
    }

    fn floor(&self) -> Floor {
        let predicted = self.problem.floor;
        let before = usable_rms(self.problem, &self.selection.before.residual);
        let after = usable_rms(self.problem, &self.selection.after.residual);
        Floor {
            predicted,
            measured_before: before,
            measured_after: after,
            ratio_before: before / predicted,
            ratio_after: after / predicted,
            unit: Quantity::Effort.dimension(self.rig.motion).to_string(),
        }
    }

    fn verdict(&self, floor: &Floor, rivals: &[Vec<Mechanism>]) -> Verdict {
        let explained = floor.ratio_after <= FLOOR_RATIO;
        match (self.selection.found.is_empty(), explained) {
            (true, true) => Verdict::Consistent,
            (true, false) => Verdict::NoneOfLibrary,
            (false, false) => Verdict::PartlyExplained,
            (false, true) if rivals.iter().any(|r| !r.is_empty()) => Verdict::Ambiguous,
            (false, true) => Verdict::Explained,
        }
    }

    fn stages(&self) -> Vec<StageReport> {
        let stages = self.selection.stages.iter();
        stages
            .map(|stage| StageReport {
                entered: stage.entered.name(),
                standing: stage.standing.iter().map(|m| m.name()).collect(),
                residual: stage.residual,
            })
            .collect()
    }

    fn effects(&self, calibration: &Rig) -> Vec<EffectReport> {
        let offset = self.selection.nominal.len();
        self.selection
            .found
            .iter()
            .enumerate()
            .filter_map(|(index, found)| {
                let entry = entry(found.term.mechanism)?;
                let fitted = calibration.effects.get(offset + index)?;
                Some(EffectReport {
                    mechanism: found.term.mechanism.name(),
                    joint: None,
                    parameters: crate::write_rig::numbers(fitted, self.rig.motion),
                    onset_s: found.term.onset_s,
                    z: found.z,
                    inclusion: inclusion(self.problem, self.selection, index, self.options.gates),
                    share_explained: found.share,
                    equation: entry.equation,
                    refuted_by: entry.refuted_by,
                })
            })
            .collect()
    }

    fn output_unit(&self) -> String {
        let quantity = match self.train.plant {
            PlantKind::Axis => Quantity::Travel,
            PlantKind::Bench => Quantity::Effort,
        };
        quantity.dimension(self.rig.motion).to_string()
    }

    fn fit_report(&self, fitted: &Fitted, protocol: &Protocol, other_recording: bool) -> FitReport {
        let pair = |run: &Run| {
            let (before, size) = figure(&fitted.nominal.plant, run, protocol);
            let (after, _) = figure(&fitted.found.plant, run, protocol);
            let percent = |x: f64| 100.0 * x / size.max(1e-300);
            BeforeAfter {
                before,
                after,
                nrmse_before: percent(before),
                nrmse_after: percent(after),
            }
        };
        let (train, held_out) = (pair(self.train), pair(self.test));
        let floor = match self.train.plant {
            PlantKind::Axis => self.train.position_noise,
            PlantKind::Bench => self.train.effort_noise,
        };
        let horizon = HORIZONS_S
            .into_iter()
            .filter_map(|horizon_s| {
                Some(Horizon {
                    horizon_s,
                    before: horizon_error(&fitted.nominal.plant, self.test, protocol, horizon_s)?,
                    after: horizon_error(&fitted.found.plant, self.test, protocol, horizon_s)?,
                })
            })
            .collect();
        let (windows_only, _) = figure(&fitted.by_windows, self.test, protocol);
        FitReport {
            protocol: self.fit_protocol(protocol, other_recording),
            unit: self.output_unit(),
            train,
            held_out: Some(held_out),
            held_out_without_refit: Some(windows_only),
            held_out_from_rest: (protocol.warm_up_periods > 0).then(|| {
                let from_rest = Protocol {
                    warm_up_periods: 0,
                    start_samples: 0,
                    ..*protocol
                };
                figure(&fitted.found.plant, self.test, &from_rest).0
            }),
            horizon,
            recovered_share: (held_out.before - held_out.after) / (held_out.before - floor).max(1e-300),
            improved: held_out.after < held_out.before,
            drift: fitted.found.drift.map(|rate| {
                format!("the free run of the fitted part drifts by a constant effort that changes at {rate:.4e} {}; a warming drive, a slow load or wear would look the same", Quantity::EffortPerTime.dimension(self.rig.motion))
            }),
        }
    }

    fn fit_protocol(&self, protocol: &Protocol, other_recording: bool) -> String {
        let held_out = if other_recording {
            "another recording"
        } else {
            "the end of the recording"
        };
        match self.train.plant {
            PlantKind::Axis => format!(
                "free run from the recorded drive only; state from a parabola through the first {} samples, error from there on; drive {} between samples; Runge-Kutta 4 with located stops, {} step(s) a sample; {} warm-up period(s); held out: {held_out}",
                protocol.start_samples,
                match protocol.interpolation {
                    crate::simulate::Interpolation::Hold => "held",
                    crate::simulate::Interpolation::Linear => "straight",
                    crate::simulate::Interpolation::Band => "band-limited and periodic",
                },
                protocol.substeps,
                protocol.warm_up_periods,
            ),
            PlantKind::Bench => format!(
                "effort along the recorded motion (zero-phase low-pass, central difference), memories empty at the start, no sample discarded; held out: {held_out}"
            ),
        }
    }

    fn protocol_lines(&self, protocol: &Protocol, other_recording: bool) -> Vec<String> {
        let windows = &self.problem.windows;
        let usable = windows.usable.iter().filter(|u| **u).count();
        vec![
            format!(
                "fitted part: {} samples at {:.1} Hz, {:.3} s; held-out part: {} samples{}",
                self.train.len(),
                1.0 / self.train.step_s,
                self.train.duration_s(),
                self.test.len(),
                if other_recording {
                    " of another recording"
                } else {
                    " at the end of the recording"
                },
            ),
            format!(
                "windows: bump (1 - x²)⁴, {:.1} ms wide, {} samples apart, {usable} of {} usable (sense of motion known)",
                1e3 * self.width_s,
                windows.hop,
                windows.centres.len()
            ),
            format!(
                "noise: position {:.3e}, effort {:.3e} (standard deviation of a sample, SI); whitened by an autoregression of order 8 of the residual",
                self.train.position_noise, self.train.effort_noise
            ),
            format!(
                "naming: z ≥ {} over left-out contiguous blocks, ≥ {} % of the loss, ≥ {} % of the effort, ≥ half of what stays unexplained",
                self.options.gates.z,
                100.0 * self.options.gates.share,
                100.0 * self.options.gates.relevance
            ),
            self.fit_protocol(protocol, other_recording),
        ]
    }

    fn curves(&self, before: &Plant, after: &Plant, protocol: &Protocol) -> Curves {
        let run = self.test;
        Curves {
            time_s: (0..run.len())
                .map(|k| run.start_s + k as f64 * run.step_s)
                .collect(),
            recorded: match run.plant {
                PlantKind::Axis => run.position.clone(),
                PlantKind::Bench => run.effort.clone(),
            },
            before: output(before, run, protocol),
            after: output(after, run, protocol),
            unit: self.output_unit(),
            window_time_s: self.problem.windows.times_s(),
            residual_before: self.selection.before.residual.clone(),
            residual_after: self.selection.after.residual.clone(),
            floor: self.problem.floor,
            residual_unit: Quantity::Effort.dimension(self.rig.motion).to_string(),
        }
    }
}

fn summary(verdict: Verdict, selection: &Selection, fit: Option<&FitReport>) -> String {
    let names: Vec<&str> = selection
        .found
        .iter()
        .map(|f| f.term.mechanism.name())
        .collect();
    let named = names.join(", ");
    let shown = match fit.and_then(|f| f.held_out.map(|h| (h, f))) {
        Some((held, fit)) if !names.is_empty() && fit.improved => {
            format!(
                "; on data it never saw the error falls from {:.4e} to {:.4e} {}",
                held.before, held.after, fit.unit
            )
        }
        Some(_) if !names.is_empty() => {
            "; but the held-out part did not improve: do not use this calibration".to_owned()
        }
        _ => String::new(),
    };
    match verdict {
        Verdict::Consistent => "the nominal model explains the recording down to its sensor noise".to_owned(),
        Verdict::Explained => format!("the model left out {named}; with it nothing but sensor noise stays{shown}"),
        Verdict::PartlyExplained => format!("the model left out {named}; something beyond sensor noise stays{shown}"),
        Verdict::Ambiguous => format!("the model left out {named}, or what is listed as ambiguous with it{shown}"),
        Verdict::NoneOfLibrary => "the model left out something that is not in the library; its shape is drawn under `unknown`".to_owned(),
        Verdict::NotExcited => "the recording moves too little to tell anything".to_owned(),
        Verdict::DataFault => "the recording itself is at fault".to_owned(),
    }
}

fn empty(rig: &Rig, verdict: Verdict, summary: String) -> Diagnosis {
    Diagnosis {
        report: Report {
            schema: SCHEMA,
            tool: concat!("rigproof ", env!("CARGO_PKG_VERSION")).to_owned(),
            inputs: Vec::new(),
            plant: rig.plant.name(),
            verdict,
            summary,
            protocol: Vec::new(),
            floor: None,
            located: Vec::new(),
            stages: Vec::new(),
            effects: Vec::new(),
            ambiguous_with: Vec::new(),
            too_small_to_name: Vec::new(),
            withdrawn: Vec::new(),
            nominal: Default::default(),
            not_seen: Vec::new(),
            null_directions: Vec::new(),
            unknown: None,
            fit: None,
            next_experiment: None,
            self_calibration: None,
            calibration_file: None,
            fault: None,
        },
        calibration: rig.clone(),
        curves: Curves::default(),
    }
}

fn faulty(rig: &Rig, which: &str, fault: Fault) -> Diagnosis {
    let mut diagnosis = empty(
        rig,
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

fn not_excited(rig: &Rig, run: &Run, usable: usize) -> Diagnosis {
    empty(
        rig,
        Verdict::NotExcited,
        format!(
            "the recording moves too little: {usable} usable windows, travel {:.3e} against a position noise of {:.3e}",
            run.travel(),
            run.position_noise
        ),
    )
}
