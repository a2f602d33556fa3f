//! This file is the regression problem of a recording: the residual of the nominal model in each
//! window, and the columns of each cause.

mod kept;
mod within;

pub use kept::{Kept, Key, key};

use crate::cause::Cause;
use crate::effect::Effect;
use crate::filter::rms;
use crate::plant::{Columns, Rules, Run};
use crate::scatter::Trials;
use crate::weak::Windows;
use crate::whiten::Whitener;
use rigproof_model::effects::facts::Shapes;
use rigproof_model::effects::{entry, facts};
use std::borrow::Cow;
use std::collections::HashMap;
use std::sync::{Arc, Mutex, OnceLock, PoisonError, RwLock};

/// A column of the regression over all windows.
#[derive(Clone, Debug)]
pub struct Rows {
    /// The signal, one output after another; empty where it is not kept.
    pub signal: Vec<f64>,
    /// The signal averaged by the test function.
    pub raw: Vec<f64>,
    /// The whitened averages.
    pub white: Vec<f64>,
    /// The standard deviation of its coefficient about 0 that is known without the recording;
    /// infinite where nothing is known.
    pub prior_deviation: f64,
}

impl Rows {
    /// The precision of its coefficient without the recording, where so many rows carry as much
    /// information as one independent sample.
    pub fn ridge(&self, rows_a_sample: f64) -> f64 {
        rows_a_sample / (self.prior_deviation * self.prior_deviation)
    }
}

/// A cause with fixed shape: what it adds to the regression.
#[derive(Clone, Debug)]
pub struct Term {
    pub cause: Cause,
    /// Its shape parameters, in the vocabulary's order.
    pub shape: Vec<f64>,
    /// The time from which it acts, s; `None` from the start.
    pub onset_s: Option<f64>,
    /// Columns whose coefficients are the linear parameters.
    pub free: Vec<Arc<Rows>>,
    /// A column with coefficient 1.
    pub fixed: Option<Arc<Rows>>,
    /// The linear parameters, if the nominal model states them as known.
    pub known: Option<Vec<f64>>,
}

impl Term {
    /// Its shape parameters that are numbers of the law. The pitch of an encoder, 0 for a turn, is
    /// followed by the error about which its columns are straight.
    pub fn numbers(&self) -> &[f64] {
        let is_pitch = facts(self.cause.mechanism).is_some_and(|own| own.shapes == Shapes::Pitch);
        match self.shape.get(..1) {
            Some(turn) if is_pitch && turn.contains(&0.0) => &[],
            Some(pitch) if is_pitch => pitch,
            _ => &self.shape,
        }
    }
}

pub struct Problem<'a> {
    pub run: &'a dyn Run,
    /// The rules of naming.
    pub rules: &'static Rules,
    pub windows: Windows,
    /// The noise model.
    pub whitener: Whitener,
    /// The effort less the known part.
    pub target: Rows,
    /// The known part, sample by sample: known inertia, predicted effort.
    pub known: Vec<f64>,
    /// The columns of the nuisance parameters, such as an unknown inertia.
    pub nuisances: Vec<Rows>,
    /// The standard deviation of a residual from sensor noise alone.
    pub floor: f64,
    /// Root mean square of the averaged driving effort: the scale of all contributions.
    pub effort_size: f64,
    /// The number of rows that carry as much information as one independent sample.
    pub rows_a_sample: f64,
    /// The causes that the description states with numbers that are to be estimated.
    pub open: Vec<Cause>,
    /// Trials of a brake, each with a gain of its own that is projected out of every row.
    trials: Option<Trials>,
    /// Terms without onset that are requested repeatedly.
    kept: kept::All,
    /// The bounds of shapes of so many numbers, of each cause.
    bounds: RwLock<HashMap<(Cause, usize), Bounds>>,
    /// The columns that each thread requested last: several onsets are tried with the same ones.
    recent: Mutex<HashMap<Option<usize>, Recent>>,
}

/// The least and the greatest value of each parameter of a shape.
pub type Bounds = Arc<[(f64, f64)]>;

/// A cause, a shape and what belongs to them.
type Recent = (Cause, Vec<f64>, (Arc<Columns>, Averages));

/// The averages of columns over all windows, once they were requested.
type Averages = Arc<OnceLock<Vec<Vec<f64>>>>;

impl<'a> Problem<'a> {
    /// The problem in the usable rows of some windows. Its noise is sensor noise alone until
    /// `rewhiten`.
    pub fn new(run: &'a dyn Run, windows: Windows) -> Problem<'a> {
        let known = run.known();
        let target = rows(&windows, less(&run.driving(), &known));
        let nuisances = run.nuisances().into_iter();
        let mut problem = Problem {
            run,
            rules: run.rules(),
            whitener: run.whitener(&windows, 0.0),
            target,
            known,
            nuisances: nuisances.map(|signal| rows(&windows, signal)).collect(),
            floor: run.floor(&windows),
            effort_size: rms(&windows.average(&run.effort())),
            windows,
            rows_a_sample: 1.0,
            open: Vec::new(),
            trials: None,
            kept: RwLock::default(),
            bounds: RwLock::default(),
            recent: Mutex::default(),
        };
        problem.whiten_own();
        problem
    }

    pub fn name(&self, cause: Cause) -> String {
        self.run.cause_name(cause)
    }

    /// Refines the noise model: the variance of these residuals beyond the floor counts as white
    /// effort.
    ///
    /// `rms` is the root mean square of the residuals over the usable windows.
    pub fn rewhiten(&mut self, rms: f64) {
        let excess = (rms * rms - self.floor * self.floor).max(0.0);
        let whitener = self.run.whitener(&self.windows, excess);
        self.whiten_with(whitener);
    }

    /// Replaces the noise model and whitens the problem's columns with it.
    pub fn whiten_with(&mut self, whitener: Whitener) {
        let old = core::mem::replace(&mut self.whitener, whitener);
        self.whiten_own();
        self.whiten_kept(&old);
    }

    /// A column from given row values.
    pub fn rows_of(&self, mut raw: Vec<f64>) -> Rows {
        crate::stop::look();
        self.take_out_trials(&mut raw);
        Rows {
            signal: Vec::new(),
            white: self.whitener.whiten(&raw),
            raw,
            prior_deviation: f64::INFINITY,
        }
    }

    fn whiten_own(&mut self) {
        self.target.white = self.whitener.whiten(&self.target.raw);
        for column in &mut self.nuisances {
            column.white = self.whitener.whiten(&column.raw);
        }
    }

    /// The term of a cause; `None` if it acts on the effort of the other terms, or has no meaning
    /// here.
    pub fn term(&self, cause: Cause, shape: &[f64], onset_s: Option<f64>) -> Option<Term> {
        let kept = match (self.kept_whole(cause, shape), onset_s) {
            (Some(kept), None) => return Some(kept),
            (kept, _) => kept.filter(|_| self.run.is_linearised() && !self.run.moves(cause)),
        };
        if let Some(kept) = kept {
            let late = |rows: &Arc<Rows>| {
                // What trials take out of a row is not in its average.
                let whole = match self.is_within_trials() {
                    true => Cow::Owned(self.windows.average(&rows.signal)),
                    false => Cow::Borrowed(&rows.raw),
                };
                Arc::new(self.rows(&rows.signal, onset_s.map(|own| (own, &whole[..]))))
            };
            return Some(Term {
                onset_s,
                free: kept.free.iter().map(late).collect(),
                fixed: kept.fixed.as_ref().map(late),
                ..kept
            });
        }
        self.computed(cause, shape, onset_s)
    }

    fn computed(&self, cause: Cause, shape: &[f64], onset_s: Option<f64>) -> Option<Term> {
        let (columns, averages) = self.columns(cause, shape)?;
        Some(self.term_of(cause, shape, onset_s, &columns, &averages))
    }

    fn term_of(
        &self,
        cause: Cause,
        shape: &[f64],
        onset_s: Option<f64>,
        columns: &Columns,
        averages: &Averages,
    ) -> Term {
        let signals = match columns {
            Columns::Free(signals) => &signals[..],
            Columns::Fixed(signal) => core::slice::from_ref(signal),
            Columns::Moved(_) => &[],
        };
        let whole = || -> Vec<Vec<f64>> {
            let each = signals.iter();
            each.map(|signal| self.windows.average(signal)).collect()
        };
        let whole = onset_s.map(|_| averages.get_or_init(whole));
        let rows = |(index, signal): (usize, &Vec<f64>)| {
            let whole = whole.and_then(|whole| whole.get(index));
            self.rows(signal, onset_s.zip(whole.map(Vec::as_slice)))
        };
        let (free, fixed) = match columns {
            Columns::Free(signals) => {
                let mut free: Vec<Rows> = signals.iter().enumerate().map(rows).collect();
                let priors = self.run.prior_deviations(cause).into_iter();
                for (own, prior) in free.iter_mut().zip(priors) {
                    own.prior_deviation = prior;
                }
                (free.into_iter().map(Arc::new).collect(), None)
            }
            Columns::Fixed(signal) => (Vec::new(), Some(Arc::new(rows((0, signal))))),
            Columns::Moved(signals) => {
                let first = onset_s.map_or(0, |onset_s| self.run.clock().sample_at(onset_s));
                let (windows, recorded) = (&self.windows, &self.target.signal);
                let moved = self
                    .run
                    .moved_rows(windows, recorded, signals, cause, shape, first);
                let moved = moved.into_iter();
                (moved.map(|raw| Arc::new(self.rows_of(raw))).collect(), None)
            }
        };
        Term {
            cause,
            shape: shape.to_vec(),
            onset_s,
            free,
            fixed,
            known: None,
        }
    }

    fn columns(&self, cause: Cause, shape: &[f64]) -> Option<(Arc<Columns>, Averages)> {
        let recent = || self.recent.lock().unwrap_or_else(PoisonError::into_inner);
        let thread = rayon::current_thread_index();
        let same = |(own, known, _): &&Recent| (*own, &known[..]) == (cause, shape);
        if let Some((.., own)) = recent().get(&thread).filter(same) {
            return Some(own.clone());
        }
        let columns = Arc::new(self.run.columns(cause, shape, None)?);
        let own = (columns, Averages::default());
        recent().insert(thread, (cause, shape.to_vec(), own.clone()));
        Some(own)
    }

    /// For a cause whose columns are straight for a small change only: the shape with which they
    /// hold for the whole change that the coefficients state.
    pub fn shape_over(&self, term: &Term, coefficients: &[f64]) -> Option<Vec<f64>> {
        self.run.shape_over(term.cause, &term.shape, coefficients)
    }

    /// The bounds of a cause's shapes of so many numbers, computed once.
    pub fn kept_bounds(
        &self,
        cause: Cause,
        length: usize,
        computed: impl FnOnce() -> Vec<(f64, f64)>,
    ) -> Bounds {
        let key = (cause, length);
        let kept = self.bounds.read().unwrap_or_else(PoisonError::into_inner);
        if let Some(own) = kept.get(&key) {
            return own.clone();
        }
        drop(kept);
        let own: Bounds = computed().into();
        let mut kept = self.bounds.write().unwrap_or_else(PoisonError::into_inner);
        kept.insert(key, own.clone());
        own
    }

    /// The term of a change of the drive, linearised about `beside`, the effort of the other terms.
    /// `None` if the cause has no meaning on this plant.
    ///
    /// The recorded effort stays the target and the model changes. If the target changed instead, a
    /// change that shrinks it would shrink every residual.
    pub fn drive_term(
        &self,
        cause: Cause,
        shape: &[f64],
        onset_s: Option<f64>,
        beside: &[f64],
    ) -> Option<Term> {
        let columns = self.run.columns(cause, shape, Some(beside))?;
        Some(self.term_of(cause, shape, onset_s, &columns, &Averages::default()))
    }

    /// A term of the nominal model. Unknown parameters become columns, known ones a fixed column.
    /// For a cause that moves the plant the finite difference spans its stated size.
    pub fn nominal_term(&self, effect: &Effect) -> Option<Term> {
        let linear = entry(effect.cause.mechanism)?.linear;
        let first = if self.run.moves(effect.cause) {
            0
        } else {
            linear
        };
        let shape = effect.parameters.get(first..).unwrap_or_default();
        let mut term = self.term(effect.cause, shape, effect.onset_s)?;
        if !effect.unknown {
            let given = effect.parameters.get(..linear)?;
            term.known = Some(self.run.coefficients(effect.mechanism(), given));
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

    /// The rows of a signal; `late` is the time from which it acts, s, and its averages over all
    /// windows.
    fn rows(&self, signal: &[f64], late: Option<(f64, &[f64])>) -> Rows {
        let late = late.map(|(onset_s, whole)| {
            let first = self.run.clock().sample_at(onset_s);
            let signal = self.windows.since(signal, first);
            let averages = self.windows.average_late(&signal, whole, first);
            (signal, averages)
        });
        let (signal, averages) = match late {
            Some((signal, averages)) => (Cow::Owned(signal), averages),
            None => (Cow::Borrowed(signal), self.windows.average(signal)),
        };
        // Only what is linearised about the samples of other terms needs its own.
        let is_read = self.run.is_linearised();
        Rows {
            signal: if is_read {
                signal.into_owned()
            } else {
                Vec::new()
            },
            ..self.rows_of(averages)
        }
    }
}

/// A signal with its averages, not yet whitened.
fn rows(windows: &Windows, signal: Vec<f64>) -> Rows {
    Rows {
        raw: windows.average(&signal),
        signal,
        white: Vec::new(),
        prior_deviation: f64::INFINITY,
    }
}

pub fn add(to: &mut [f64], what: &[f64], times: f64) {
    for (x, y) in to.iter_mut().zip(what) {
        *x += times * y;
    }
}

pub fn less(from: &[f64], what: &[f64]) -> Vec<f64> {
    from.iter().zip(what).map(|(a, b)| a - b).collect()
}

#[cfg(test)]
mod tests;
