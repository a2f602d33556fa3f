//! This file is the regression problem of one recording: what the nominal model leaves over, window by window,
//! and the columns that a cause could explain it with.

mod cause;
mod inertia;
mod joint;
mod signals;
mod within;

use crate::five_bar;
use crate::five_bar::run::FiveBarRun;
use crate::rules::{
    LEAST_RIVAL_SHARE_FIVE_BAR, LEAST_RIVAL_SHARE_JOINT, OWN_TO_UNEXPLAINED_FIVE_BAR,
    OWN_TO_UNEXPLAINED_JOINT,
};
use crate::run::{PlantKind, Run, rms};
use crate::scatter::Trials;
use crate::weak::Windows;
use crate::whiten::{NOISE_ORDER, Whitener};
use rayon::prelude::*;
use rigproof_model::effects::entry;
use signals::second_difference;
use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError, RwLock};

pub use cause::Cause;
pub use inertia::Inertia;
pub use joint::{is_of_brake, of_brake, unit_parameters};
pub use signals::{USUAL_SHARE, lagged_yield, numerov, shifted, through_play};

/// One column of the regression over all windows.
#[derive(Clone, Debug)]
pub struct Rows {
    /// Sample by sample, one output after another; empty where they are not kept.
    pub signal: Vec<f64>,
    /// As averaged by the test function.
    pub raw: Vec<f64>,
    /// After whitening.
    pub white: Vec<f64>,
}

/// A cause with its shape fixed: what it adds to the regression.
#[derive(Clone, Debug)]
pub struct Term {
    /// The cause.
    pub cause: Cause,
    /// The parameters that shape it, in the vocabulary's order after the linear ones.
    pub shape: Vec<f64>,
    /// When it begins, s; `None` from the start.
    pub onset_s: Option<f64>,
    /// Columns whose coefficients are the linear parameters.
    pub free: Vec<Arc<Rows>>,
    /// A column that enters with coefficient 1: a change of the drive.
    pub fixed: Option<Arc<Rows>>,
    /// Given values of the linear parameters, where the nominal model states them as known.
    pub known: Option<Vec<f64>>,
}

/// What the nominal model says about one cause.
#[derive(Clone, Debug)]
pub struct NominalEffect {
    /// The mechanism, and where it acts.
    pub cause: Cause,
    /// Its parameters in the vocabulary's order, SI.
    pub parameters: Vec<f64>,
    /// Whether its linear parameters are to be estimated.
    pub unknown: bool,
    /// When it begins, s.
    pub onset_s: Option<f64>,
}

/// The recording that a problem is about.
#[derive(Clone, Copy)]
pub enum PlantRun<'a> {
    /// A plant of one joint.
    Joint(&'a Run),
    /// The five-bar.
    FiveBar(&'a FiveBarRun),
}

impl PlantRun<'_> {
    /// Time of the first sample, s.
    pub fn start_s(self) -> f64 {
        match self {
            PlantRun::Joint(run) => run.start_s,
            PlantRun::FiveBar(run) => run.start_s,
        }
    }

    /// The length of the recording, s.
    pub fn duration_s(self) -> f64 {
        match self {
            PlantRun::Joint(run) => run.duration_s(),
            PlantRun::FiveBar(run) => run.duration_s(),
        }
    }

    /// Whether a change of the drive depends on what the other terms give; it does not where brakes run again.
    pub fn is_linearised(self) -> bool {
        matches!(self, PlantRun::Joint(_))
    }

    /// Share of an effect's gain below which nothing counts as explaining as much, however the blocks scatter. An effect of the
    /// five-bar often lives in few blocks; the rules of the other plants were chosen without such a share.
    pub fn least_rival_share(self) -> f64 {
        match self {
            PlantRun::Joint(_) => LEAST_RIVAL_SHARE_JOINT,
            PlantRun::FiveBar(_) => LEAST_RIVAL_SHARE_FIVE_BAR,
        }
    }

    /// Multiple of the unexplained energy (beyond the floor) that a mechanism must explain by itself to be named. On the five-bar, one of two
    /// cogging periods alone comes to 1.7, and laws of another family than the one that is there to 4 and more.
    pub fn own_to_unexplained(self) -> f64 {
        match self {
            PlantRun::Joint(_) => OWN_TO_UNEXPLAINED_JOINT,
            PlantRun::FiveBar(_) => OWN_TO_UNEXPLAINED_FIVE_BAR,
        }
    }

    /// Whether terms that are kept hold their samples; the five-bar has too many of both.
    fn keeps_signals(self) -> bool {
        matches!(self, PlantRun::Joint(_))
    }

    /// The driving effort, sample by sample, one output after another.
    fn effort(self) -> Vec<f64> {
        match self {
            PlantRun::Joint(run) => run.effort.clone(),
            PlantRun::FiveBar(run) => run.driving_effort(),
        }
    }

    /// The first sample at or after a time, s.
    fn sample_at(self, time_s: f64) -> usize {
        match self {
            PlantRun::Joint(run) => run.sample_at(time_s),
            PlantRun::FiveBar(run) => run.sample_at(time_s),
        }
    }
}

/// The regression problem of one recording.
pub struct Problem<'a> {
    /// The recording.
    pub plant: PlantRun<'a>,
    /// The windows.
    pub windows: Windows,
    /// The noise model.
    pub whitener: Whitener,
    /// Effort less everything the nominal model knows.
    pub target: Rows,
    /// The effort that the nominal model knows, sample by sample: known inertia, predicted effort.
    pub known: Vec<f64>,
    /// The averaged acceleration, when the inertia is to be estimated.
    pub inertia_column: Option<Rows>,
    /// The inertia.
    pub inertia: Inertia,
    /// Predicted standard deviation of one residual from sensor noise alone.
    pub floor: f64,
    /// Root mean square of the averaged driving effort: what a contribution is compared with.
    pub effort_size: f64,
    /// Trials of a brake whose gains are taken out of every row.
    trials: Option<Trials>,
    /// Terms from the start of the recording that are asked for again and again.
    kept: RwLock<Vec<Term>>,
    /// The signals that each thread asked for last: several onsets are tried of the same ones.
    recent: Mutex<HashMap<Option<usize>, Recent>>,
}

/// A cause, a shape, and what they give.
type Recent = (Cause, Vec<f64>, Arc<Vec<Vec<f64>>>);

impl<'a> Problem<'a> {
    /// Sets up the problem of a plant of one joint with a white noise model; `rewhiten` refines it.
    pub fn new(run: &'a Run, windows: Windows, inertia: Inertia) -> Problem<'a> {
        let start = inertia.start();
        let floor = windows.floor(run, start);
        let mut windows = windows;
        if run.plant == PlantKind::Axis {
            windows.avoid_rests(run, floor);
        }
        if let (Some((predicted, _)), Some(doubt)) = (run.brake(), run.brake_doubt()) {
            windows.keep_foreseen(predicted, &doubt, floor);
        }
        let acceleration = second_difference(&run.position, run.step_s);
        let mut known = run
            .predicted
            .clone()
            .unwrap_or_else(|| vec![0.0; run.len()]);
        if let Inertia::Known(value) = inertia {
            add(&mut known, &acceleration, value);
        }
        let target = less(&joint::acting_effort(run, &run.effort), &known);
        let covariance = windows.noise_covariance(run, start, 0.0, NOISE_ORDER + 1);
        let whitener = Whitener::new(&covariance, &windows.usable);
        let inertia_column = match inertia {
            Inertia::Unknown(_) => Some(rows(&windows, acceleration)),
            _ => None,
        };
        let mut problem = Problem::with(
            PlantRun::Joint(run),
            windows,
            whitener,
            (target, known),
            floor,
        );
        problem.inertia = inertia;
        problem.inertia_column = inertia_column;
        problem.whiten_own();
        problem
    }

    /// Sets up the problem of a five-bar in the rows in which what its brakes do is known.
    pub fn of_five_bar(run: &'a FiveBarRun, mut windows: Windows) -> Problem<'a> {
        five_bar::noise::keep_told(run, &mut windows);
        Problem::over_windows(run, windows)
    }

    /// Sets up the problem of a five-bar in the usable rows of some windows.
    pub fn over_windows(run: &'a FiveBarRun, windows: Windows) -> Problem<'a> {
        let floor = five_bar::noise::floor(run, &windows);
        let whitener = five_bar::noise::whitener(run, &windows, 0.0);
        let known = five_bar::columns::known(run);
        let target = less(&five_bar::columns::driving(run, run.forces()), &known);
        let mut problem = Problem::with(
            PlantRun::FiveBar(run),
            windows,
            whitener,
            (target, known),
            floor,
        );
        problem.whiten_own();
        problem
    }

    fn with(
        plant: PlantRun<'a>,
        windows: Windows,
        whitener: Whitener,
        (target, known): (Vec<f64>, Vec<f64>),
        floor: f64,
    ) -> Problem<'a> {
        Problem {
            plant,
            whitener,
            target: rows(&windows, target),
            known,
            inertia_column: None,
            inertia: Inertia::None,
            floor,
            effort_size: rms(&windows.average(&plant.effort())),
            windows,
            trials: None,
            kept: RwLock::default(),
            recent: Mutex::default(),
        }
    }

    /// Refines the noise model: what these residuals have beyond the floor counts as unexplained white effort.
    ///
    /// `rms` is the root mean square of the residuals over the usable windows.
    pub fn rewhiten(&mut self, rms: f64) {
        let excess = (rms * rms - self.floor * self.floor).max(0.0);
        let whitener = match self.plant {
            PlantRun::Joint(run) => {
                let inertia = self.inertia.start();
                let covariance =
                    self.windows
                        .noise_covariance(run, inertia, excess, NOISE_ORDER + 1);
                Whitener::new(&covariance, &self.windows.usable)
            }
            PlantRun::FiveBar(run) => five_bar::noise::whitener(run, &self.windows, excess),
        };
        self.whiten_with(whitener);
    }

    /// Takes a noise model and whitens with it.
    pub fn whiten_with(&mut self, whitener: Whitener) {
        self.whitener = whitener;
        self.whiten_own();
        let kept = core::mem::take(&mut self.kept).into_inner();
        let mut kept = kept.unwrap_or_else(PoisonError::into_inner);
        kept.par_iter_mut().for_each(|term| self.refresh(term));
        self.kept = RwLock::new(kept);
    }

    /// A column given row by row.
    pub fn rows_of(&self, mut raw: Vec<f64>) -> Rows {
        self.take_out_trials(&mut raw);
        Rows {
            signal: Vec::new(),
            white: self.whitener.whiten(&raw),
            raw,
        }
    }

    fn whiten_own(&mut self) {
        self.target.white = self.whitener.whiten(&self.target.raw);
        if let Some(column) = &mut self.inertia_column {
            column.white = self.whitener.whiten(&column.raw);
        }
    }

    /// The term of a cause whose leading parameters are linear; `None` for one that acts on the drive.
    pub fn term(&self, cause: Cause, shape: &[f64], onset_s: Option<f64>) -> Option<Term> {
        let free = match (self.kept(cause, shape), onset_s) {
            (Some(kept), None) => return Some(kept),
            _ if cause.moves_linkage() => {
                let signals = self.free_signals(cause, shape)?;
                let first = onset_s.map_or(0, |onset_s| self.plant.sample_at(onset_s));
                let (windows, recorded) = (&self.windows, &self.target.signal);
                five_bar::encoder::rows(windows, recorded, &signals, shape, first)
                    .into_iter()
                    .map(|raw| Arc::new(self.rows_of(raw)))
                    .collect()
            }
            (Some(kept), onset_s) if self.plant.keeps_signals() => kept
                .free
                .iter()
                .map(|rows| Arc::new(self.rows(rows.signal.clone(), onset_s)))
                .collect(),
            (_, onset_s) => self
                .free_signals(cause, shape)?
                .iter()
                .map(|signal| Arc::new(self.rows(signal.clone(), onset_s)))
                .collect(),
        };
        Some(Term {
            cause,
            shape: shape.to_vec(),
            onset_s,
            free,
            fixed: None,
            known: None,
        })
    }

    fn free_signals(&self, cause: Cause, shape: &[f64]) -> Option<Arc<Vec<Vec<f64>>>> {
        let recent = || self.recent.lock().unwrap_or_else(PoisonError::into_inner);
        let thread = rayon::current_thread_index();
        let same = |(own, known, _): &&Recent| (*own, &known[..]) == (cause, shape);
        if let Some((.., signals)) = recent().get(&thread).filter(same) {
            return Some(signals.clone());
        }
        let signals = Arc::new(match self.plant {
            PlantRun::Joint(run) => joint::resistances(run, cause.mechanism, shape),
            PlantRun::FiveBar(run) => five_bar::columns::free(run, cause, shape),
        }?);
        recent().insert(thread, (cause, shape.to_vec(), signals.clone()));
        Some(signals)
    }

    /// The shape of a term that moves the linkage whose columns are taken over the whole change that its coefficients say.
    pub fn shape_over(&self, term: &Term, coefficients: &[f64]) -> Option<Vec<f64>> {
        let PlantRun::FiveBar(run) = self.plant else {
            return None;
        };
        let encoder = five_bar::encoder::Encoder::of(run, term.cause, &term.shape)?;
        encoder.over(coefficients)
    }

    /// The term of a cause that acts from the start, kept for the next time: for shapes that are tried in every
    /// step of the search. `None` for one that has to be linearised about the other terms.
    pub fn kept_term(&self, cause: Cause, shape: &[f64]) -> Option<Term> {
        self.kept(cause, shape).or_else(|| {
            let mut term = self.term(cause, shape, None).or_else(|| match self.plant {
                PlantRun::Joint(_) => None,
                PlantRun::FiveBar(_) => self.drive_term(cause, shape, None, &[]),
            })?;
            self.lighten(&mut term);
            let mut kept = self.kept.write().unwrap_or_else(PoisonError::into_inner);
            kept.push(term.clone());
            Some(term)
        })
    }

    /// Lets go of a term's samples where there are too many terms to hold them.
    pub fn lighten(&self, term: &mut Term) {
        if !self.plant.keeps_signals() {
            for rows in term.free.iter_mut().chain(&mut term.fixed) {
                Arc::make_mut(rows).signal = Vec::new();
            }
        }
    }

    fn kept(&self, cause: Cause, shape: &[f64]) -> Option<Term> {
        let kept = self.kept.read().unwrap_or_else(PoisonError::into_inner);
        let same = |t: &&Term| t.cause == cause && t.shape == shape;
        kept.iter().find(same).cloned()
    }

    /// The term of a change of the drive, linearised about `fitted`: the effort, sample by sample, that the model
    /// gives with the other terms. `None` where the cause has no meaning on this plant.
    ///
    /// The recorded effort stays the target and the model's side is changed, because a change of the target
    /// would make every residual small that the change itself makes small.
    pub fn drive_term(
        &self,
        cause: Cause,
        shape: &[f64],
        onset_s: Option<f64>,
        fitted: &[f64],
    ) -> Option<Term> {
        let (free, fixed) = match self.plant {
            PlantRun::Joint(run) => joint::drive(self, run, cause.mechanism, shape, fitted)?,
            PlantRun::FiveBar(run) => (None, Some(five_bar::columns::fixed(run, cause, shape)?)),
        };
        Some(Term {
            cause,
            shape: shape.to_vec(),
            onset_s,
            free: free
                .map(|signal| Arc::new(self.rows(signal, onset_s)))
                .into_iter()
                .collect(),
            fixed: fixed.map(|signal| Arc::new(self.rows(signal, onset_s))),
            known: None,
        })
    }

    /// A term of the nominal model: its columns where unknown, else its value as a fixed column. An encoder's slope is over its value.
    pub fn nominal_term(&self, effect: &NominalEffect) -> Option<Term> {
        let entry = entry(effect.cause.mechanism)?;
        let linear = entry.linear;
        let first = if entry.form.is_of_encoder() {
            0
        } else {
            linear
        };
        let shape = effect.parameters.get(first..).unwrap_or_default();
        let mut term =
            self.term(effect.cause, shape, effect.onset_s)
                .or_else(|| match self.plant {
                    PlantRun::Joint(_) => None,
                    PlantRun::FiveBar(_) => {
                        self.drive_term(effect.cause, shape, effect.onset_s, &[])
                    }
                })?;
        if !effect.unknown {
            term.known = Some(effect.parameters.iter().take(linear).copied().collect());
        }
        Some(term)
    }

    /// Whitens a term again after the noise model changed.
    pub fn refresh(&self, term: &mut Term) {
        for rows in term.free.iter_mut().chain(&mut term.fixed) {
            let white = self.whitener.whiten(&rows.raw);
            Arc::make_mut(rows).white = white;
        }
    }

    fn rows(&self, mut signal: Vec<f64>, onset_s: Option<f64>) -> Rows {
        if let Some(onset_s) = onset_s {
            signal = self.windows.since(&signal, self.plant.sample_at(onset_s));
        }
        let mut rows = rows(&self.windows, signal);
        self.take_out_trials(&mut rows.raw);
        rows.white = self.whitener.whiten(&rows.raw);
        rows
    }
}

/// A signal with its averages; not yet whitened.
fn rows(windows: &Windows, signal: Vec<f64>) -> Rows {
    Rows {
        raw: windows.average(&signal),
        signal,
        white: Vec::new(),
    }
}

/// Adds `times` a signal to another.
pub fn add(to: &mut [f64], what: &[f64], times: f64) {
    for (x, y) in to.iter_mut().zip(what) {
        *x += times * y;
    }
}

/// One signal less another.
pub fn less(from: &[f64], what: &[f64]) -> Vec<f64> {
    from.iter().zip(what).map(|(a, b)| a - b).collect()
}

#[cfg(test)]
mod tests;
