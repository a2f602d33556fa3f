//! This file runs the stages in order: align, locate, explain, doubt, show.

pub(crate) mod balance;
mod beside;
mod bound;
pub(crate) mod ended;
pub(crate) mod numbers;
mod parts;
mod stages;
mod watch;
pub(crate) mod words;
pub(crate) mod write;

use crate::align::Fault;
use crate::cause::{Cause, Place};
use crate::continuity::Remark;
use crate::evidence::{Intervals, intervals};
use crate::explain::{Explanations, explain, explain_many};
use crate::filter::usable_rms;
use crate::plant::{At, Plant, Run, Shown};
use crate::problem::{Problem, Term};
use crate::report::{FitReport, Report};
use crate::rules::{EXPLAINED_LEFT, FEWEST_WINDOWS, FLOOR_RATIO, HOLD_OUT_SHARE};
use crate::scatter::{Trials, left_over};
use crate::selection::{Selection, refs};
use crate::weak::Windows;
use bound::{bound, untenable};
use ended::{faulty, not_excited};
use parts::Parts;
use rigproof_model::effects::linear;
use rigproof_trace::Trace;
pub use watch::{Stage, Watch};
use write::Stand;

/// The options of a diagnosis.
#[derive(Clone, Debug)]
pub struct Options {
    /// The share at the end of the recording that is held out if there is no other recording.
    pub hold_out_share: f64,
    /// Whether the parameters are refitted by free runs. The naming does not need it.
    pub refit: bool,
    /// Whether to look for the experiment that separates rival explanations.
    pub next_experiment: bool,
    /// Who is informed of each stage.
    pub watch: Watch,
}

impl Default for Options {
    fn default() -> Options {
        Options {
            hold_out_share: HOLD_OUT_SHARE,
            refit: true,
            next_experiment: true,
            watch: Watch::default(),
        }
    }
}

/// A report, the calibrated model, and the curves that its pictures need.
pub struct Diagnosis<D = crate::Description> {
    /// What was found.
    pub report: Report,
    /// The rig with the found effects and the fitted parameters.
    pub calibration: D,
    /// Curves for the pictures; empty after a fault.
    pub curves: Curves,
    /// The experiment that would separate rival explanations, if there are any.
    pub experiment: Option<Trace>,
}

impl<D> Diagnosis<D> {
    /// The same diagnosis with one more remark.
    fn remarked(mut self, remark: Remark) -> Diagnosis<D> {
        self.report.protocol.push(remark.words.clone());
        self.report.remarks.push(remark);
        self
    }

    /// The same diagnosis with its calibration converted.
    pub fn map<E>(self, of: impl FnOnce(D) -> E) -> Diagnosis<E> {
        Diagnosis {
            report: self.report,
            calibration: of(self.calibration),
            curves: self.curves,
            experiment: self.experiment,
        }
    }
}

/// Curves over time: of the held-out part before and after, and the residual of the windows.
#[derive(Clone, Debug, Default)]
pub struct Curves {
    /// Time stamps of the held-out part, s.
    pub time_s: Vec<f64>,
    /// The name of the output.
    pub output: &'static str,
    /// The recorded output: the position of an axis, the effort of a bench, the effort on one arm
    /// of the five-bar. NaN where it does not count.
    pub recorded: Vec<f64>,
    /// Output of the nominal model.
    pub before: Vec<f64>,
    /// Output with the named mechanisms.
    pub after: Vec<f64>,
    /// Unit of the output.
    pub unit: String,
    /// Window times of the fitted part, s.
    pub window_time_s: Vec<f64>,
    /// Whether a window counts in the naming. At rest and across a reversal it does not.
    pub window_counts: Vec<bool>,
    /// Residual effort with the nominal model.
    pub residual_before: Vec<f64>,
    /// Residual effort with the named mechanisms.
    pub residual_after: Vec<f64>,
    /// What each named mechanism contributes to the efforts, window by window: without it the residual is larger by so much.
    pub contributed: Vec<Contributed>,
    /// Predicted standard deviation of the residual.
    pub floor: f64,
    /// Unit of the residual.
    pub residual_unit: String,
    /// The same output on the fitted part.
    pub fitted: FittedCurves,
}

/// What a named mechanism contributes to the efforts of the fitted part.
#[derive(Clone, Debug, PartialEq)]
pub struct Contributed {
    /// The mechanism, as `viscous at E` where there are several joints.
    pub name: String,
    /// The effort in each window, in the residual's unit.
    pub effort: Vec<f64>,
}

/// The recorded output and both models on the fitted part; empty if not requested.
#[derive(Clone, Debug, Default)]
pub struct FittedCurves {
    /// Time stamps, s.
    pub time_s: Vec<f64>,
    /// The recorded output; NaN where it does not count.
    pub recorded: Vec<f64>,
    /// Output of the nominal model.
    pub before: Vec<f64>,
    /// Output with the named mechanisms.
    pub after: Vec<f64>,
}

/// Diagnoses recordings of a rig together.
///
/// The result is shown on `held_out`, another recording. Without it, the last of many recordings is
/// held out, or the end of the last.
pub fn diagnose<P: Plant>(
    plant: &P,
    recordings: &[&P::Recording],
    held_out: Option<&P::Recording>,
    options: &Options,
) -> Diagnosis<P> {
    options.watch.enters(Stage::Align);
    let parts = match Parts::of(plant, recordings, held_out, options) {
        Ok(parts) => parts,
        Err((which, fault)) => return faulty(plant, &which, fault),
    };
    let train: &dyn Run = &parts.train;
    let mut problem = Problem::new(train, train.windows());
    let usable = problem.windows.usable.iter().filter(|u| **u).count() / problem.windows.outputs;
    let (travel, noise) = (train.travel(Place::Whole), train.position_noise());
    let fewest = problem.windows.as_many_as(FEWEST_WINDOWS);
    if usable < fewest || travel < problem.rules.least_travel * noise {
        return not_excited(plant, [usable, fewest], travel, noise);
    }
    let terms = plant.check(&parts.train, &problem);
    let terms = match terms.and_then(|()| nominal(plant, &problem)) {
        Ok(terms) => terms,
        Err((at, fault)) => return faulty(plant, at, fault),
    };
    options.watch.enters(Stage::Explain);
    let (mut selection, mut explanations) = named(&mut problem, terms);
    let checked = plant.check_found(&problem, &selection);
    let checked = checked.and_then(|()| plant.check_numbers(&parts.train, &problem, &selection));
    if let Err(fault) = checked {
        return match plant.stated(&parts.train, &problem, &selection) {
            Some((stated, remark)) => {
                diagnose(&stated, recordings, held_out, options).remarked(remark)
            }
            None => faulty(plant, "recording", fault),
        };
    }
    let beyond = plant.beyond_reason(&problem, &selection);
    selection.withdraw(&problem, beyond.as_slice());
    let mut withdrawn: Vec<Cause> = beyond.into_iter().collect();
    let trials = scattered(&problem, &selection);
    if let Some((trials, windows)) = trials.clone() {
        problem = Problem::new(train, windows).within(trials);
        let terms = nominal(plant, &problem).unwrap_or_default();
        (selection, explanations) = named(&mut problem, terms);
        withdrawn.clear();
    }
    let numbers = tenable(&problem, &mut selection, &mut withdrawn);
    bound(&problem, &mut selection, &numbers);
    options.watch.enters(Stage::Show);
    let stand = Stand {
        plant,
        problem: &problem,
        selection: &selection,
        withdrawn: &withdrawn,
        train: &parts.train,
        test: &parts.test,
        test_from_s: parts.test_from_s,
        other_recording: parts.other_recording,
        options,
        trials: trials.as_ref().map(|(trials, _)| trials),
        explanations: &explanations,
    };
    let shown = P::shown(&stand, &numbers);
    let doubted = refuted(&shown).then(|| selection.at_most_suspected());
    Stand {
        selection: doubted.as_ref().unwrap_or(&selection),
        ..stand
    }
    .report(shown, &numbers)
}

/// The numbers of what can be upheld; the rest is withdrawn.
fn tenable(problem: &Problem, selection: &mut Selection, withdrawn: &mut Vec<Cause>) -> Intervals {
    let numbers = intervals(problem, selection);
    let untenable = untenable(problem, selection, &numbers);
    if untenable.is_empty() {
        return numbers;
    }
    selection.withdraw(problem, &untenable);
    withdrawn.extend(untenable);
    intervals(problem, selection)
}

/// Whether what is named predicts the held-out part worse.
fn refuted<D>(shown: &Shown<D>) -> bool {
    shown.fit.as_ref().is_some_and(FitReport::is_refuted)
}

/// The mechanisms that are named on top of the nominal terms.
fn named(problem: &mut Problem, terms: Vec<Term>) -> (Selection, Explanations) {
    let open = terms.iter().filter(|term| term.known.is_none());
    problem.open = open.map(|term| term.cause).collect();
    match problem.rules.many {
        true => explain_many(problem, terms),
        false => explain(problem, terms),
    }
}

/// The effects of the nominal model as terms.
///
/// # Errors
/// An effect of the description has no meaning on this plant.
fn nominal<P: Plant>(plant: &P, problem: &Problem) -> Result<Vec<Term>, (At, Fault)> {
    let mut terms = Vec::new();
    for effect in plant.nominal() {
        match problem.nominal_term(&effect) {
            Some(mut term) => {
                // Additional coefficients, such as the rest angle of a spring, are separate effects
                // in a description.
                let linear = linear(effect.cause.mechanism);
                term.free.truncate(linear);
                terms.push(term);
            }
            None => {
                if let Some(fault) = plant.meaningless(problem, &effect) {
                    return Err(("description", fault));
                }
            }
        }
    }
    Ok(terms)
}

/// The trials of a brake with the windows in which it has settled, if their gains differ and hide
/// other effects.
fn scattered(problem: &Problem, selection: &Selection) -> Option<(Trials, Windows)> {
    let (predicted, _) = problem.run.brake()?;
    let mut windows = problem.windows.clone();
    windows.keep_steady(predicted, problem.floor);
    let trials = Trials::of(problem.run, &windows)?;
    let usable = &windows.usable;
    let terms = refs(&selection.nominal, &selection.found);
    let residual = left_over(problem, &terms, &selection.after);
    let least = FLOOR_RATIO * problem.floor;
    trials.scatter(&residual, usable, least)?;
    // Laws of a few numbers that leave less than a gain for every trial are the better explanation,
    // and so are those that leave little of what the nominal model does.
    let nominal: Vec<&Term> = selection.nominal.iter().collect();
    let bare = left_over(problem, &nominal, &selection.before);
    let mut by_gains = bare.clone();
    trials.take_out(&mut by_gains, usable);
    let [laws, gains, bare] = [&residual, &by_gains, &bare].map(|rows| usable_rms(rows, usable));
    (laws >= gains && laws > EXPLAINED_LEFT * bare).then_some((trials, windows))
}
