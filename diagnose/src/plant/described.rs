//! This file is a plant by its description: what it needs recorded, how a recording becomes a run,
//! and what only this plant can show.

use super::{Replayed, Run, Simulated, Unsimulated};
use crate::align::Fault;
use crate::cause::Cause;
use crate::continuity::Remark;
use crate::diagnose::numbers::fitted;
use crate::diagnose::write::Stand;
use crate::diagnose::{Curves, balance};
use crate::effect::Effect;
use crate::evidence::Intervals;
use crate::problem::Problem;
use crate::report::{
    ArmReport, FitReport, HeldReport, Horizon, InverseReport, NextExperiment, Number,
};
use crate::selection::Selection;
use core::fmt::Debug;
use rand_pcg::Pcg64Mcg;
use rigproof_spec::effect::Mechanism;
use rigproof_trace::csv::{Dialect, Hints};
use rigproof_trace::rig::RigEffect;
use rigproof_trace::{Trace, TraceError};
use std::collections::BTreeMap;
use std::path::Path;

/// What is at fault: a recording, or the description.
pub type At = &'static str;

/// A simulated recording before noise and quantisation, with the noise to add where its signals
/// state none.
#[derive(Clone, Debug)]
pub struct Replica<R> {
    /// The recording.
    pub recording: R,
    /// Standard deviation of a position and of an effort, in the recording's units.
    pub noise: [f64; 2],
    /// A sentence on how it was simulated.
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

    // From a recording to a run.

    /// Aligns a recording. `before_s` is the length of the recordings before it on the clock of the
    /// onsets.
    ///
    /// # Errors
    /// The fault that makes any conclusion meaningless.
    fn aligned(&self, recording: &Self::Recording, before_s: f64) -> Result<Self::Run, Fault>;

    /// Joins runs into one, so that one set of parameters is fitted to all of them.
    ///
    /// # Errors
    /// The index of the run that does not fit the others, and why.
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

    /// Cuts a run at a sample: the fitted run, the run that shows the result, and the time at which
    /// its held-out part begins, s. `before` is the number of samples of earlier recordings.
    fn parted(run: Self::Run, cut: usize, before: usize) -> (Self::Run, Self::Run, f64) {
        let _ = before;
        let samples = run.clock().samples;
        (
            Self::part(&run, 0, cut),
            Self::part(&run, cut, samples),
            0.0,
        )
    }

    /// The effects of the nominal model that the run does not include in its known part.
    fn nominal(&self) -> Vec<Effect> {
        Vec::new()
    }

    /// Checks before anything is fitted.
    ///
    /// # Errors
    /// What is at fault, and why.
    fn check(&self, run: &Self::Run, problem: &Problem) -> Result<(), (At, Fault)> {
        let _ = (run, problem);
        Ok(())
    }

    /// Where a check after the search fails: the description with what it leaves open, and this
    /// recording does not determine, taken as it is stated; with what is said of that. `None` if
    /// there is no such number.
    fn stated(
        &self,
        run: &Self::Run,
        problem: &Problem,
        selection: &Selection,
    ) -> Option<(Self, Remark)>
    where
        Self: Sized,
    {
        let _ = (run, problem, selection);
        None
    }

    /// Checks after the search.
    ///
    /// # Errors
    /// Why the recording does not belong to this plant.
    fn check_found(&self, problem: &Problem, selection: &Selection) -> Result<(), Fault> {
        let _ = (problem, selection);
        Ok(())
    }

    /// Checks the fitted parameters of the plant.
    ///
    /// # Errors
    /// Why no plant has these parameters.
    fn check_numbers(
        &self,
        run: &Self::Run,
        problem: &Problem,
        selection: &Selection,
    ) -> Result<(), Fault> {
        let _ = (run, problem, selection);
        Ok(())
    }

    /// A named cause with a parameter that no plant has, which is therefore not named.
    fn beyond_reason(&self, problem: &Problem, selection: &Selection) -> Option<Cause> {
        let _ = (problem, selection);
        None
    }

    /// Why an effect of the description has no meaning here; `None` if it is ignored.
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

    // From a selection to a result.

    /// The description with the parameters of a selection. Found effects follow the nominal ones.
    fn calibrated(stand: &Stand<'_, Self>, intervals: &Intervals) -> Self {
        let _ = intervals;
        stand.plant.clone()
    }

    /// The effects that a selection found, with their parameters.
    fn found(&self, stand: &Stand<'_, Self>, intervals: &Intervals) -> Vec<RigEffect> {
        let Selection { nominal, found, .. } = stand.selection;
        let effects = fitted(stand.problem, stand.selection, intervals).into_iter();
        effects.skip(nominal.len()).take(found.len()).collect()
    }

    /// The errors before and after, on the fitted and the held-out part: of the balance of efforts,
    /// unless the plant has free runs.
    fn shown(stand: &Stand<'_, Self>, intervals: &Intervals) -> Shown<Self> {
        balance::shown(stand, intervals)
    }

    /// The errors of free runs with the nominal and with all effects of a calibration, and the
    /// protocol.
    fn free_runs(stand: &Stand<'_, Self>, calibration: &Self) -> (Vec<Horizon>, String) {
        let _ = (stand, calibration);
        (
            Vec::new(),
            "no free runs: nothing simulates this plant".to_owned(),
        )
    }

    /// The protocol of the naming, line by line.
    fn protocol(stand: &Stand<'_, Self>, fit: Option<&FitReport>) -> Vec<String> {
        let _ = stand;
        fit.iter().map(|fit| fit.protocol.clone()).collect()
    }

    /// The parameters of the nominal model after the fit.
    fn nominal_numbers(&self, calibration: &Self) -> BTreeMap<String, Number> {
        let _ = calibration;
        BTreeMap::new()
    }

    /// The inverse model with some laws, given with their shapes, under a published protocol.
    fn inverse_model(run: &Self::Run, laws: &[(Mechanism, Vec<f64>)]) -> Option<InverseReport> {
        let _ = (run, laws);
        None
    }

    /// What joints at rest bound.
    fn held(stand: &Stand<'_, Self>) -> Option<HeldReport> {
        let _ = stand;
        None
    }

    /// What the models of an arm leave over, joint by joint.
    fn arm(stand: &Stand<'_, Self>) -> Option<ArmReport> {
        let _ = stand;
        None
    }

    /// The experiment that would separate rival explanations, and its file.
    fn next_experiment(
        stand: &Stand<'_, Self>,
        rivals: &[Vec<Cause>],
    ) -> Option<(NextExperiment, Option<Trace>)> {
        let _ = (stand, rivals);
        None
    }
}

/// The result of a fit.
pub struct Shown<P> {
    /// The description with the fitted parameters.
    pub calibration: P,
    /// Errors before and after; `None` if not requested.
    pub fit: Option<FitReport>,
    /// Curves for the pictures.
    pub curves: Curves,
}

/// A plant whose description and recordings are files, as the registry and the program need it.
pub trait Described: Plant + PartialEq {
    /// Whether a text describes such a plant. `origin` is the file named in error messages.
    ///
    /// # Errors
    /// The text is no description of any plant.
    fn describes(text: &str, origin: &Path) -> Result<bool, TraceError>;

    /// Reads a description. `origin` is the file named in error messages.
    ///
    /// # Errors
    /// The text does not describe such a plant.
    fn read(text: &str, origin: &Path) -> Result<Self, TraceError>;

    /// The rig's name as its description gives it.
    fn rig_name(&self) -> &str;

    /// The description as TOML.
    fn written(&self) -> String;

    /// The description in formats of other programs, as file names and texts.
    fn beside(&self) -> Vec<(&'static str, String)> {
        Vec::new()
    }

    /// Converts a recording to SI units. `origin` is the file named in error messages.
    ///
    /// # Errors
    /// A channel is missing, or its unit cannot be converted.
    fn measured(&self, trace: Trace, origin: &Path) -> Result<Self::Recording, TraceError>;

    /// The description with the given units for some columns, overriding what their headers say.
    ///
    /// # Errors
    /// The rig has no such channel; the message lists those that it has.
    fn in_units(&self, units: &[(String, String)]) -> Result<Self, String>;

    /// Reads a text recording whose dialect is partly known. Returns the recording, the dialect,
    /// and remarks on what was guessed, skipped or repaired.
    ///
    /// # Errors
    /// The file cannot be read, or as [`Described::measured`].
    fn read_csv(
        &self,
        file: &Path,
        hints: &Hints,
    ) -> Result<(Self::Recording, Dialect, Vec<String>), TraceError>;

    /// Reads an MCAP recording, with remarks on how it was read.
    ///
    /// # Errors
    /// The file cannot be read, or as [`Described::measured`].
    fn read_messages(&self, file: &Path) -> Result<(Self::Recording, Vec<String>), TraceError>;

    /// The time stamps of a recording, s.
    fn times_s(recording: &Self::Recording) -> &[f64];

    /// The recording reduced to the samples that are `true` in `kept`.
    fn only(recording: &Self::Recording, kept: &[bool]) -> Self::Recording;

    /// Simulates the recording that a plant with the parameters of `model` would have made. This
    /// description describes the recording.
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

    /// The recording with fresh sensor noise, quantised. `noise` is used where a signal states
    /// none.
    fn sensed(
        recording: &Self::Recording,
        noise: [f64; 2],
        random: &mut Pcg64Mcg,
    ) -> Self::Recording;

    /// Simulates a model beside a recording of this plant. A free run restarts from the recorded
    /// state every `restart_s`.
    ///
    /// # Errors
    /// The recording is faulty, or the model cannot be simulated.
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

    /// Why a calibration does not belong to this rig; `None` if it does. The argument is `None` for
    /// a calibration of another plant.
    fn refuses(&self, calibration: Option<&Self>) -> Option<String> {
        calibration.is_none().then(|| {
            "the calibration is of another plant; give the calibration of this rig".to_owned()
        })
    }

    /// The end of a recording beside free runs of this description and of `after`.
    fn replay(&self, after: &Self, recording: &Self::Recording) -> Option<Replayed> {
        let _ = (after, recording);
        None
    }

    /// A calibration of this nominal description, without the effects that were found.
    fn without_found(&self, calibration: &Self) -> Self;
}
