//! This file is one of several rival explanations of a recording, and its loss on another
//! recording.

use super::super::free_run::Model;
use crate::candidates::{realise, variants};
use crate::cause::Cause;
use crate::problem::{Problem, Term};
use crate::regression::{Blocks, fit};
use crate::selection::best_variant;

/// A cause with its shape.
#[derive(Clone, Debug)]
struct Part {
    cause: Cause,
    shape: Vec<f64>,
    known: Option<Vec<f64>>,
}

impl Part {
    fn of(term: &Term) -> Part {
        Part {
            cause: term.cause,
            shape: term.shape.clone(),
            known: term.known.clone(),
        }
    }

    /// The term on another recording, without its onset, which belongs to the original one.
    fn on(&self, problem: &Problem) -> Option<Term> {
        let term = realise(problem, self.cause, &self.shape, None, &[])?;
        Some(Term {
            known: self.known.clone(),
            ..term
        })
    }
}

#[derive(Clone, Debug)]
pub struct Explanation {
    /// The term about which the rivals disagree.
    own: Part,
    /// The terms that all rivals share.
    others: Vec<Part>,
    /// The rig with its parameters.
    pub model: Model,
}

impl Explanation {
    /// An explanation by its own term, those beside it, and the rig with all their parameters.
    pub fn new<'a>(own: &Term, others: impl Iterator<Item = &'a Term>, model: Model) -> Self {
        Explanation {
            own: Part::of(own),
            others: others.map(Part::of).collect(),
            model,
        }
    }

    /// The cause about which the rivals disagree.
    pub fn cause(&self) -> Cause {
        self.own.cause
    }

    /// Its loss on another recording, with all parameters refitted and the contested cause in its
    /// best trial shape.
    pub fn loss(&self, problem: &Problem, blocks: &Blocks) -> f64 {
        let others: Vec<Term> = self.others.iter().filter_map(|p| p.on(problem)).collect();
        let common: Vec<&Term> = others.iter().collect();
        let bare = fit(problem, &common, blocks);
        let mut tried = variants(problem, self.own.cause, &common, &bare);
        tried.extend(self.own.on(problem));
        best_variant(problem, &common, &tried).map_or(bare.loss, |(_, loss)| loss)
    }
}
