//! This file examines finite claims: every choice that there is.

use rigproof_impl::claim::{Checker, Claim, Domain, Held};

use crate::classes::Classes;
use crate::fork::Forks;

/// What became of a claim of choices.
#[derive(Clone, Debug)]
pub struct Enumerated {
    /// How many cases there are.
    pub cases: u64,
    /// Whether the claim failed in one of them.
    pub refuted: bool,
    /// How many cases met each class.
    pub classes: Classes,
}

/// All choices in turn.
#[derive(Default)]
pub struct Enumerator {
    forks: Forks,
    classes: Classes,
    refuted: bool,
}

impl Checker for Enumerator {
    type Number = f64;

    /// A finite claim asks for no numbers; to one that does anyway, nothing is proved.
    fn scalar(&mut self) -> f64 {
        self.refuted = true;
        f64::NAN
    }

    fn greatest(&self) -> f64 {
        f64::MAX
    }

    fn choice(&mut self, count: u8) -> u8 {
        self.forks.take(count)
    }

    fn assume(&mut self, condition: bool) -> Held {
        condition.then_some(())
    }

    fn check(&mut self, condition: bool) -> Held {
        self.refuted |= !condition;
        condition.then_some(())
    }

    fn cover(&mut self, class: &'static str, condition: bool) {
        self.classes.count(class, condition);
    }
}

/// Every case of a finite claim, until one refutes it; `None` for a claim about numbers.
pub fn enumerate(claim: &Claim<Enumerator>) -> Option<Enumerated> {
    if claim.domain != Domain::Finite {
        return None;
    }
    let mut enumerator = Enumerator::default();
    let mut cases = 0;
    loop {
        cases += 1;
        let _ = (claim.body)(&mut enumerator);
        if enumerator.refuted || !enumerator.forks.advance() {
            return Some(Enumerated {
                cases,
                refuted: enumerator.refuted,
                classes: enumerator.classes,
            });
        }
    }
}
