//! This file keeps the terms that every step of the search tries.
//!
//! There are thousands of them. Where nothing but their white rows is needed, only these are kept,
//! in single precision: a term that is chosen is computed again.

use super::{Problem, Rows, Term};
use crate::cause::Cause;
use crate::whiten::Whitener;
use rayon::prelude::*;
use rigproof_model::effects::{Form, OfSensor, form};
use std::borrow::Cow;
use std::collections::HashMap;
use std::sync::{Arc, PoisonError, RwLock};

/// What a cause and the bits of its numbers stand for.
pub type Key = (Cause, Vec<u64>);

/// The kept terms, by cause and shape.
pub(super) type All = RwLock<HashMap<Key, Arc<Kept>>>;

/// A term without onset that is tried repeatedly.
#[derive(Clone, Debug)]
pub enum Kept {
    Whole(Term),
    Packed(Packed),
}

/// The white usable rows of a term.
#[derive(Clone, Debug)]
pub struct Packed {
    cause: Cause,
    shape: Vec<f64>,
    /// The rows of each column, and the deviation of its coefficient that is known.
    pub free: Vec<(Box<[f32]>, f64)>,
    pub fixed: Option<Box<[f32]>>,
}

impl Kept {
    pub fn cause(&self) -> Cause {
        match self {
            Kept::Whole(term) => term.cause,
            Kept::Packed(packed) => packed.cause,
        }
    }

    pub fn shape(&self) -> &[f64] {
        match self {
            Kept::Whole(term) => &term.shape,
            Kept::Packed(packed) => &packed.shape,
        }
    }

    /// The term for a trial. A packed one has white rows alone, with `usable` marking which these
    /// are.
    pub fn trial(&self, usable: &[bool]) -> Cow<'_, Term> {
        match self {
            Kept::Whole(term) => Cow::Borrowed(term),
            Kept::Packed(packed) => Cow::Owned(packed.trial(usable)),
        }
    }
}

impl Packed {
    fn of(term: &Term, usable: &[bool]) -> Packed {
        let free = term.free.iter();
        let free = free.map(|own| (packed(&own.white, usable), own.prior_deviation));
        let fixed = term.fixed.as_ref();
        Packed {
            cause: term.cause,
            shape: term.shape.clone(),
            free: free.collect(),
            fixed: fixed.map(|own| packed(&own.white, usable)),
        }
    }

    fn trial(&self, usable: &[bool]) -> Term {
        self.term(|own| unpacked(own, usable))
    }

    /// The term with columns that hold no rows.
    pub fn without_rows(&self) -> Term {
        self.term(|_| Vec::new())
    }

    fn term(&self, white: impl Fn(&[f32]) -> Vec<f64>) -> Term {
        let rows = |own: &[f32], prior_deviation: f64| {
            Arc::new(Rows {
                signal: Vec::new(),
                raw: Vec::new(),
                white: white(own),
                prior_deviation,
            })
        };
        let free = self.free.iter().map(|(own, prior)| rows(own, *prior));
        let fixed = self.fixed.as_ref();
        Term {
            cause: self.cause,
            shape: self.shape.clone(),
            onset_s: None,
            free: free.collect(),
            fixed: fixed.map(|own| rows(own, f64::INFINITY)),
            known: None,
        }
    }
}

fn packed(white: &[f64], usable: &[bool]) -> Box<[f32]> {
    let rows = white.iter().zip(usable).filter(|(_, u)| **u);
    rows.map(|(x, _)| *x as f32).collect()
}

fn unpacked(own: &[f32], usable: &[bool]) -> Vec<f64> {
    let mut white = vec![0.0; usable.len()];
    let slots = white.iter_mut().zip(usable).filter(|(_, u)| **u);
    for ((slot, _), value) in slots.zip(own) {
        *slot = f64::from(*value);
    }
    white
}

impl Problem<'_> {
    /// A term without onset for the search; `None` if it has to be linearised about the other
    /// terms.
    pub fn kept(&self, cause: Cause, shape: &[f64]) -> Option<Arc<Kept>> {
        let key = key(cause, shape);
        let kept = self.kept.read().unwrap_or_else(PoisonError::into_inner);
        if let Some(own) = kept.get(&key) {
            return Some(own.clone());
        }
        drop(kept);
        let term = self.computed(cause, shape, None)?;
        let own = Arc::new(match self.needs_more_than_white(cause) {
            true => Kept::Whole(term),
            false => Kept::Packed(Packed::of(&term, &self.windows.usable)),
        });
        let mut kept = self.kept.write().unwrap_or_else(PoisonError::into_inner);
        kept.insert(key, own.clone());
        Some(own)
    }

    /// A term that is kept whole; `None` if it is not kept yet.
    pub(super) fn kept_whole(&self, cause: Cause, shape: &[f64]) -> Option<Term> {
        let kept = self.kept.read().unwrap_or_else(PoisonError::into_inner);
        match &**kept.get(&key(cause, shape))? {
            Kept::Whole(term) => Some(term.clone()),
            Kept::Packed(_) => None,
        }
    }

    /// A whole term without onset; `None` as for [`Problem::kept`]. It is computed once where it is
    /// kept whole.
    pub fn whole_term(&self, cause: Cause, shape: &[f64]) -> Option<Term> {
        match self.needs_more_than_white(cause) {
            true => self.whole(&*self.kept(cause, shape)?),
            false => self.computed(cause, shape, None),
        }
    }

    /// The whole term of a kept one.
    pub fn whole(&self, kept: &Kept) -> Option<Term> {
        match kept {
            Kept::Whole(term) => Some(term.clone()),
            Kept::Packed(packed) => self.computed(packed.cause, &packed.shape, None),
        }
    }

    /// Whether the samples or the raw rows of a term are read again: it is linearised about, it
    /// changes the driving effort, it is expensive, or all of many terms are chosen at once.
    fn needs_more_than_white(&self, cause: Cause) -> bool {
        let is_gain = matches!(
            form(cause.mechanism),
            Some(Form::Sensor(OfSensor::ForceGain))
        );
        self.run.is_linearised()
            || self.rules.many
            || cause.is_of_drive()
            || is_gain
            || self.run.moves(cause)
    }

    /// Whitens the kept terms, which were white under the noise model `old`.
    pub(super) fn whiten_kept(&self, old: &Whitener) {
        let usable = &self.windows.usable;
        let again = |own: &mut Box<[f32]>| {
            let raw = old.coloured(&unpacked(own, usable));
            *own = packed(&self.whitener.whiten(&raw), usable);
        };
        let mut kept = self.kept.write().unwrap_or_else(PoisonError::into_inner);
        let kept = kept.par_iter_mut();
        kept.for_each(|(_, own)| match Arc::make_mut(own) {
            Kept::Whole(term) => self.refresh(term),
            Kept::Packed(packed) => {
                packed.free.iter_mut().for_each(|(own, _)| again(own));
                packed.fixed.iter_mut().for_each(again);
            }
        });
    }
}

pub fn key(cause: Cause, shape: &[f64]) -> Key {
    (cause, shape.iter().map(|x| x.to_bits()).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plants::five_bar::recorded::{problem, short_run};
    use crate::plants::five_bar::run::at;
    use rigproof_spec::effect::Mechanism;
    use rigproof_spec::joint::Joint;

    #[test]
    fn a_kept_term_is_white_under_every_noise_model() {
        let run = short_run();
        let mut problem = problem(&run);
        let (cause, shape) = (at(Mechanism::Stribeck, Joint::B), [0.31, 1.0]);
        let kept = |problem: &Problem| problem.kept(cause, &shape).unwrap();
        assert!(matches!(&*kept(&problem), Kept::Packed(_)));
        for excess_nm in [0.0, 0.013] {
            problem.rewhiten(problem.floor.hypot(excess_nm));
            let kept = kept(&problem);
            let trial = kept.trial(&problem.windows.usable);
            let whole = problem.whole(&kept).unwrap();
            let (trial, whole) = (&trial.free[0].white, &whole.free[0].white);
            let most = whole.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
            assert!(most > 0.0);
            for (a, b) in trial.iter().zip(whole) {
                assert!((a - b).abs() < 1e-5 * most, "{a} and {b}");
            }
        }
    }
}
