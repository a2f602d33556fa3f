//! This file proves claims about numbers: it walks every path of the rig's own code on unknown numbers, and asks a solver about those on
//! which the claim fails.

use std::time::{Duration, Instant};

use rigproof_impl::claim::{Checker, Claim, Held};
use rigproof_impl::number::Scalar;

use crate::replay::Replay;
use crate::replay::replay;
use crate::script::script;
use crate::solver::{Answer, Solver};
use crate::symbol::{Arena, Literal, Symbol, with_arena};
use crate::width::Number;

/// Longest walk over the paths of a claim that should hold.
pub const LONGEST_WALK: Duration = Duration::from_secs(240);

/// What became of a claim.
#[derive(Clone, Debug)]
pub struct Examined {
    /// How many paths there are.
    pub paths: u64,
    /// How many of them the solver was asked about.
    pub queries: u64,
    /// What follows.
    pub outcome: Outcome,
    /// How long it took, s.
    pub seconds: f64,
}

/// What follows from the paths and the solver's answers.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// No path on which the claim fails can be walked.
    Proved,
    /// These numbers, replayed, refute the claim.
    Refuted(Vec<f64>),
    /// The solver, or the time, did not suffice; why.
    Undecided(String),
}

/// One run over unknown numbers.
#[derive(Default)]
pub struct Walker {
    choices: Vec<u8>,
    failing: Option<Failing>,
}

/// A path on which the claim fails: what it takes for granted, and its choices.
#[derive(Clone, Debug)]
pub struct Failing {
    path: Vec<Literal>,
    choices: Vec<u8>,
}

impl Checker for Walker {
    type Number = Symbol;

    fn scalar(&mut self) -> Symbol {
        with_arena(|arena| arena.input())
    }

    fn greatest(&self) -> Symbol {
        Symbol::of(with_arena(|arena| arena.width.greatest()))
    }

    fn choice(&mut self, count: u8) -> u8 {
        let choice = with_arena(|arena| arena.forks.take(count));
        self.choices.push(choice);
        choice
    }

    fn assume(&mut self, condition: bool) -> Held {
        condition.then_some(())
    }

    fn check(&mut self, condition: bool) -> Held {
        let contradicted = with_arena(|arena| arena.contradicted);
        if !condition && !contradicted {
            self.failing = Some(Failing {
                path: with_arena(|arena| arena.path.clone()),
                choices: self.choices.clone(),
            });
        }
        condition.then_some(())
    }

    /// A class is met by a number, not by a path: see the sampler.
    fn cover(&mut self, _: &'static str, _: bool) {}
}

/// Proves or refutes a claim on numbers of one width; a refutation is replayed on them before it counts.
pub fn examine<N: Number>(
    claim: &Claim<Walker>,
    again: &Claim<Replay<N>>,
    solver: &Solver,
    longest: Duration,
) -> Examined {
    let start = Instant::now();
    with_arena(|arena| *arena = Arena::of(N::WIDTH));
    let (mut paths, mut queries) = (0, 0);
    let outcome = loop {
        paths += 1;
        with_arena(|arena| arena.restart());
        let mut walker = Walker::default();
        let _ = (claim.body)(&mut walker);
        if let Some(failing) = walker.failing {
            queries += 1;
            match question(&failing, again, solver) {
                Outcome::Proved => {}
                settled => break settled,
            }
        }
        if !with_arena(|arena| arena.forks.advance()) {
            break Outcome::Proved;
        }
        if start.elapsed() > longest {
            break Outcome::Undecided(format!("more than {paths} paths"));
        }
    };
    Examined {
        paths,
        queries,
        outcome,
        seconds: start.elapsed().as_secs_f64(),
    }
}

/// Whether any numbers walk a failing path.
fn question<N: Number>(failing: &Failing, again: &Claim<Replay<N>>, solver: &Solver) -> Outcome {
    let script = with_arena(|arena| script(arena.width, arena.terms(), &failing.path));
    match solver.ask(&script) {
        Answer::Unsatisfiable => Outcome::Proved,
        Answer::Unknown(why) => Outcome::Undecided(why),
        Answer::Satisfiable(numbers) => {
            if replay(again, &numbers, &failing.choices) {
                Outcome::Refuted(numbers)
            } else {
                Outcome::Undecided(format!("the solver's numbers {numbers:?} do not refute it"))
            }
        }
    }
}
