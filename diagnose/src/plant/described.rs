//! This file is a plant by its description: what it needs recorded, how that becomes a run, and what only this plant can show.

use super::{Replayed, Run, Simulated, Unsimulated};
use crate::align::Fault;
use crate::cause::Cause;
use crate::diagnose::numbers::fitted;
use crate::diagnose::write::Stand;
use crate::diagnose::{Curves, balance};
use crate::effect::Effect;
use crate::evidence::Intervals;
use crate::problem::Problem;
use crate::report::{FitReport, HeldReport, Horizon, InverseReport, NextExperiment, Number};
use crate::selection::Selection;
use core::fmt::Debug;
use rand_pcg::Pcg64Mcg;
use rigproof_spec::effect::Mechanism;
use rigproof_trace::csv::{Dialect, Hints};
use rigproof_trace::rig::RigEffect;
use rigproof_trace::{Trace, TraceError};
use std::collections::BTreeMap;
use std::path::Path;

/// What a fault is of: a recording, or the description itself.
pub type At = &'static str;

/// A recording before noise and counts, and the noise of positions and of efforts where it states none.
#[derive(Clone, Debug)]
pub struct Replica<R> {
    /// The recording.
    pub recording: R,
    /// Standard deviation of a position and of an effort, in the recording's units.
    pub noise: [f64; 2],
    /// How it was made, in words.
    pub how: &'static str,
}

/// A plant by its description: how its recordings become runs, and what only it can show.
pub trait Plant: Clone + Debug + Send + Sync + Sized {
    /// A recording in SI units.
    type Recording: Clone + Debug + Send + Sync;
    /// An aligned recording.
    type Run: Run;

    /// The plant's name in reports.
    fn plant_name(&self) -> &'static str;

    // Becoming a run.

    /// Aligns a recording; `before_s` of other recordings come before it on the clock of onsets.
    ///
    /// # Errors
    /// The fault that makes any conclusion meaningless.
    fn aligned(&self, recording: &Self::Recording, before_s: f64) -> Result<Self::Run, Fault>;

    /// Runs one after another, so that one set of numbers explains them all.
    ///
    /// # Errors
    /// The place of the one that does not fit the others, and why.
    fn joined(runs: Vec<Self::Run>) -> Result<Self::Run, (usize, Fault)> {
        let mut runs = runs.into_iter();
        match (runs.next(), runs.next()) {
            (Some(only), None) => Ok(only),
            (none, _) => Err((
                usize::from(none.is_some()),
                Fault {
                    channel: "time",
                    from_s: 0.0,
                    to_s: 0.0,
                    reason: "recordings of this plant are diagnosed one by one".to_owned(),
                },
            )),
        }
    }

    /// The samples `from..to` of a run.
    fn part(run: &Self::Run, from: usize, to: usize) -> Self::Run;

    /// What is fitted of a run that is cut at a sample, what shows the result, and where in it the held-out part begins, s.
    /// `before` samples of other recordings come before it.
    fn parted(run: Self::Run, cut: usize, before: usize) -> (Self::Run, Self::Run, f64) {
        let _ = before;
        let samples = run.clock().samples;
        (
            Self::part(&run, 0, cut),
            Self::part(&run, cut, samples),
            0.0,
        )
    }

    /// What the nominal model has beside what the run knows.
    fn nominal(&self) -> Vec<Effect> {
        Vec::new()
    }

    /// Checks what can be checked before anything is fitted.
    ///
    /// # Errors
    /// What is at fault, and why.
    fn check(&self, run: &Self::Run, problem: &Problem) -> Result<(), (At, Fault)> {
        let _ = (run, problem);
        Ok(())
    }

    /// Checks what only the search tells.
    ///
    /// # Errors
    /// Why the recording is no recording of this plant.
    fn check_found(&self, problem: &Problem, selection: &Selection) -> Result<(), Fault> {
        let _ = (problem, selection);
        Ok(())
    }

    /// Checks the plant's own numbers.
    ///
    /// # Errors
    /// Why they are those of no plant.
    fn check_numbers(
        &self,
        run: &Self::Run,
        problem: &Problem,
        selection: &Selection,
    ) -> Result<(), Fault> {
        let _ = (run, problem, selection);
        Ok(())
    }

    /// A name whose number nothing has, and which is therefore none.
    fn beyond_reason(&self, problem: &Problem, selection: &Selection) -> Option<Cause> {
        let _ = (problem, selection);
        None
    }

    /// Why an effect of the description has no meaning here; `None` where it is passed over.
    fn meaningless(&self, problem: &Problem, effect: &Effect) -> Option<Fault> {
        Some(Fault {
            channel: "effect",
            from_s: 0.0,
            to_s: 0.0,
            reason: format!(
                "`{}` cannot stand in the nominal model of this plant; take it out",
                problem.name(effect.cause)
            ),
        })
    }

    // Showing.

    /// The description with the numbers of a selection; found effects follow the nominal ones.
    fn calibrated(stand: &Stand<'_, Self>, intervals: &Intervals) -> Self {
        let _ = intervals;
        stand.plant.clone()
    }

    /// The effects that a selection found, with the numbers of this calibration.
    fn found(&self, stand: &Stand<'_, Self>, intervals: &Intervals) -> Vec<RigEffect> {
        let Selection { nominal, found, .. } = stand.selection;
        let effects = fitted(stand.problem, stand.selection, intervals).into_iter();
        effects.skip(nominal.len()).take(found.len()).collect()
    }

    /// What the fit comes to, on what was fitted and what was not: of the balance of efforts, unless the plant has better.
    fn shown(stand: &Stand<'_, Self>, intervals: &Intervals) -> Shown<Self> {
        balance::shown(stand, intervals)
    }

    /// Errors of free runs with the nominal effects of a calibration and with all of them, and how they were made, in words.
    fn free_runs(stand: &Stand<'_, Self>, calibration: &Self) -> (Vec<Horizon>, String) {
        let _ = (stand, calibration);
        (
            Vec::new(),
            "no free runs: nothing simulates this plant".to_owned(),
        )
    }

    /// How the naming was measured, line by line.
    fn protocol(stand: &Stand<'_, Self>, fit: Option<&FitReport>) -> Vec<String> {
        let _ = stand;
        fit.iter().map(|fit| fit.protocol.clone()).collect()
    }

    /// The nominal model's own unknowns after the fit.
    fn nominal_numbers(&self, calibration: &Self) -> BTreeMap<String, Number> {
        let _ = calibration;
        BTreeMap::new()
    }

    /// The inverse model with some laws, given with their shapes, under a published protocol.
    fn inverse_model(run: &Self::Run, laws: &[(Mechanism, Vec<f64>)]) -> Option<InverseReport> {
        let _ = (run, laws);
        None
    }

    /// What joints at rest tell.
    fn held(stand: &Stand<'_, Self>) -> Option<HeldReport> {
        let _ = stand;
        None
    }

    /// The experiment that would tell rival explanations apart, and its file.
    fn next_experiment(
        stand: &Stand<'_, Self>,
        rivals: &[Vec<Cause>],
    ) -> Option<(NextExperiment, Option<Trace>)> {
        let _ = (stand, rivals);
        None
    }
}

/// What a fit comes to.
pub struct Shown<P> {
    /// The description with the numbers.
    pub calibration: P,
    /// Before and after; `None` where it was not asked for.
    pub fit: Option<FitReport>,
    /// Curves for the pictures.
    pub curves: Curves,
}

/// A plant whose description and recordings are files: what the registry and the program need.
pub trait Described: Plant + PartialEq {
    /// Whether a text describes such a plant; `origin` is the file that messages name.
    ///
    /// # Errors
    /// It is no description of any plant.
    fn describes(text: &str, origin: &Path) -> Result<bool, TraceError>;

    /// Reads a description; `origin` is the file that messages name.
    ///
    /// # Errors
    /// The text does not describe such a plant.
    fn read(text: &str, origin: &Path) -> Result<Self, TraceError>;

    /// What people call it.
    fn rig_name(&self) -> &str;

    /// As TOML.
    fn written(&self) -> String;

    /// It in formats of other programs: names of files and their texts.
    fn beside(&self) -> Vec<(&'static str, String)> {
        Vec::new()
    }

    /// Turns a recording into SI quantities; `origin` is the file that messages name.
    ///
    /// # Errors
    /// A channel is missing, or its unit does not convert.
    fn measured(&self, trace: Trace, origin: &Path) -> Result<Self::Recording, TraceError>;

    /// The description with the units that some columns are said to be in, whatever their headers say.
    ///
    /// # Errors
    /// Names a channel that the rig does not have, and those it has.
    fn in_units(&self, units: &[(String, String)]) -> Result<Self, String>;

    /// Reads a text recording whose dialect is partly known, and says in which it was, and what was guessed, passed over or mended.
    ///
    /// # Errors
    /// The file cannot be read, or as [`Described::measured`].
    fn read_csv(
        &self,
        file: &Path,
        hints: &Hints,
    ) -> Result<(Self::Recording, Dialect, Vec<String>), TraceError>;

    /// Reads an MCAP recording, and says how it was read.
    ///
    /// # Errors
    /// The file cannot be read, or as [`Described::measured`].
    fn read_messages(&self, file: &Path) -> Result<(Self::Recording, Vec<String>), TraceError>;

    /// The time stamps of a recording, s.
    fn times_s(recording: &Self::Recording) -> &[f64];

    /// A recording of which only some samples count.
    fn only(recording: &Self::Recording, kept: &[bool]) -> Self::Recording;

    /// What a plant with the numbers of `model` would have recorded; this one describes the recording.
    ///
    /// # Errors
    /// Why it cannot be simulated.
    fn replica(
        &self,
        model: &Self,
        recording: &Self::Recording,
    ) -> Result<Replica<Self::Recording>, String> {
        let _ = (model, recording);
        Err("nothing simulates this plant".to_owned())
    }

    /// A recording with fresh noise, of the size that it states or of an estimate of positions and efforts, in counts.
    fn sensed(
        recording: &Self::Recording,
        noise: [f64; 2],
        random: &mut Pcg64Mcg,
    ) -> Self::Recording;

    /// A model beside a recording that this description describes; where it runs freely it starts from the recorded state every `restart_s`.
    ///
    /// # Errors
    /// The recording is at fault, or the model cannot be simulated.
    fn simulated(
        &self,
        model: &Self,
        recording: &Self::Recording,
        restart_s: f64,
    ) -> Result<Simulated, Unsimulated> {
        let _ = (model, recording, restart_s);
        Err(Unsimulated::Model(
            "nothing simulates this plant".to_owned(),
        ))
    }

    /// Why a calibration is none of this rig; `None` if it is one. It may be of another plant altogether: `None`.
    fn refuses(&self, calibration: Option<&Self>) -> Option<String> {
        calibration.is_none().then(|| {
            "the calibration is of another plant; give the calibration of this rig".to_owned()
        })
    }

    /// The end of a recording beside free runs of this description and another one.
    fn replay(&self, after: &Self, recording: &Self::Recording) -> Option<Replayed> {
        let _ = (after, recording);
        None
    }

    /// A calibration without what was found: this one is nominal.
    fn without_found(&self, calibration: &Self) -> Self;
}
