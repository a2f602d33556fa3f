//! This file sends recordings through a controller, sample by sample, before the judge: what it would have commanded, and which law that breaks.
//!
//! The loop is open: the rig moved as it was commanded then. What is told is what the sensors told, faults included.

pub mod compare;
pub mod expected;
pub mod looks;
pub mod taken;

use rigproof_spec::laws::Margin;

use crate::controller::{Controller, Failure, Source, Task};
use crate::declared::Declared;
use crate::differential::tie::Ties;
use crate::error::Error;
use crate::judge::Judge;
use crate::law::{Fared, LAWS, Law};
use crate::trial::retold;
use taken::Taken;

/// What a controller made of a recording.
#[derive(Clone, Debug, PartialEq)]
pub struct Answered {
    /// Its commands, A, in the order A, E, B, C, up to the sample that it did not answer.
    pub currents_a: Vec<[f64; 4]>,
    /// How every law fared, in the order of [`Law::ALL`].
    pub fared: [Fared; LAWS],
    /// The samples that were ties beside the reference.
    pub ties: Ties,
    /// How it broke, if it did.
    pub failure: Option<Failure>,
}

/// The laws that need the plant, which a recording does not have.
pub const NOT_LOOKED_AT: [Law; 2] = [Law::Dissipation, Law::Passivity];

impl Answered {
    /// The laws that were broken.
    pub fn broken(&self) -> impl Iterator<Item = (Law, Fared)> {
        let each = Law::ALL.into_iter().zip(self.fared);
        each.filter(|(_, fared)| fared.broken > 0)
    }
}

/// Sends a recording through a controller that promises so much, on a path.
///
/// # Errors
/// The path or the settings are none.
pub fn answered(
    taken: &Taken,
    task: &Task,
    source: &dyn Source,
    declared: &Declared,
) -> Result<Answered, Error> {
    let judge = Judge::new(&taken.settings, declared, task, None);
    let mut telling = Telling {
        taken,
        judge: judge.ok_or_else(|| {
            Error::Replay("the path or the rig's settings are none that a controller takes".into())
        })?,
        currents_a: Vec::with_capacity(taken.told.len()),
        failure: None,
    };
    match source.begin(&taken.settings, task) {
        Ok(mut controller) => telling.first(controller.as_mut()),
        Err(failure) => telling.fail(failure),
    }
    if telling.failure.is_none() {
        telling.again(source, task);
    }
    Ok(Answered {
        ties: telling.judge.ties(),
        fared: telling.judge.fared,
        currents_a: telling.currents_a,
        failure: telling.failure,
    })
}

/// A recording that is told to controllers.
struct Telling<'a> {
    taken: &'a Taken,
    judge: Judge,
    currents_a: Vec<[f64; 4]>,
    failure: Option<Failure>,
}

impl Telling<'_> {
    /// Tells it for the first time, and judges what is answered.
    fn first(&mut self, controller: &mut dyn Controller) {
        let samples = self.taken.told.iter().zip(&self.taken.is_faulty);
        for (tick, (sensed, is_faulty)) in (0..).zip(samples) {
            match controller.tick(sensed) {
                Ok(currents_a) => {
                    self.judge.add(Law::Answers, tick, Margin(0.0));
                    self.judge.command(tick, sensed, *is_faulty, currents_a);
                    self.currents_a.push(currents_a);
                }
                Err(failure) => return self.fail(failure),
            }
        }
        self.over(controller);
    }

    /// Tells it again, to a fresh controller and to one in another process: the answers have to be the same bits.
    fn again(&mut self, source: &dyn Source, task: &Task) {
        let settings = self.taken.settings;
        match source.begin_again(&settings, task) {
            Ok(mut fresh) => self.repeated(fresh.as_mut()),
            Err(failure) => self.fail(failure),
        }
        if self.failure.is_some() {
            return;
        }
        match source.begin_elsewhere(&settings, task) {
            Ok(Some(mut fresh)) => self.repeated(fresh.as_mut()),
            Ok(None) => {}
            Err(failure) => self.fail(failure),
        }
    }

    fn repeated(&mut self, fresh: &mut dyn Controller) {
        let told = self.taken.told.iter().zip(&self.currents_a);
        if retold(&mut self.judge, fresh, told) {
            self.over(fresh);
        }
    }

    fn over(&mut self, controller: &mut dyn Controller) {
        if let Err(failure) = controller.end() {
            self.fail(failure);
        }
    }

    fn fail(&mut self, failure: Failure) {
        let tick = self.currents_a.len() as u32;
        self.judge.add(Law::Answers, tick, Margin(-1.0));
        self.failure = Some(failure);
    }
}
