//! This file makes trials out of processes: one is begun for each trial, or begun anew.

use std::thread::current;

use rigproof_impl::tick::{Sensed, Settings};

use super::child::{Child, of_left};
use super::phase::Phase;
use super::protocol::{Begin, Message};
use super::{Foreign, MOST_POINTS, held};
use crate::controller::{Controller, Failure, Source, Task};

impl Foreign {
    /// Opens the library once, so that one that cannot be opened is known before a campaign begins.
    ///
    /// # Errors
    /// [`Failure`]: it cannot be opened, or not in time.
    pub fn check(&self) -> Result<(), Failure> {
        self.start().map(drop)
    }

    /// Ends every process that is at rest; what a controller started after its last trial is then among [`Foreign::between_trials`]. Another trial may
    /// begin.
    pub fn end(&self) {
        let idle = std::mem::take(&mut *held(&self.idle));
        for mut child in idle.into_values() {
            let left = child.stop().left;
            if left > 0 {
                self.keep(format!("when its process was ended{}", of_left(left)));
            }
        }
    }

    fn start(&self) -> Result<Child, Failure> {
        Child::start(&self.library.told(), &self.host, &self.limits)
    }

    /// The process that the last trial on this thread had, if it is at rest.
    fn rested(&self) -> Option<Child> {
        held(&self.idle).remove(&current().id())
    }

    /// A trial in a process that begins it as it is told.
    fn trial(
        &self,
        mut child: Child,
        begin: Begin,
        rests: bool,
    ) -> Result<Box<dyn Controller + '_>, Failure> {
        let sample_s = begin.settings.sample_s;
        child.forget_ticks();
        let message = Message::Begin(Box::new(begin));
        child.ask(Phase::Init, &message, self.limits.start_ms)?;
        Ok(Box::new(Trial {
            source: self,
            child: Some(child),
            rests: rests && !self.limits.one_trial_a_process,
            limit_ms: self.limits.tick_ms(sample_s),
        }))
    }
}

/// What a controller is told at the beginning.
fn told(settings: &Settings, path: &Task) -> Result<Begin, Failure> {
    if let Task::Chain(points_m) | Task::Spline(points_m) = path
        && points_m.len() > MOST_POINTS
    {
        return Err(Failure::Refused(format!(
            "the path has {} points, a compiled controller is told {MOST_POINTS} at most: give it a path of fewer",
            points_m.len()
        )));
    }
    Ok(Begin {
        settings: *settings,
        task: path.clone(),
    })
}

impl Source for Foreign {
    fn begin(&self, settings: &Settings, path: &Task) -> Result<Box<dyn Controller + '_>, Failure> {
        let begin = told(settings, path)?;
        if let Some(child) = self.rested() {
            match self.trial(child, begin.clone(), true) {
                Ok(trial) => return Ok(trial),
                // Which trial it had before is chance: a trial is judged by a new process.
                Err(failure) => self.keep(format!("after another trial: {failure}")),
            }
        }
        self.trial(self.start()?, begin, true)
    }

    fn begin_again(
        &self,
        settings: &Settings,
        path: &Task,
    ) -> Result<Box<dyn Controller + '_>, Failure> {
        match self.rested() {
            Some(child) => self.trial(child, told(settings, path)?, true),
            None => self.begin(settings, path),
        }
    }

    fn begin_elsewhere(
        &self,
        settings: &Settings,
        path: &Task,
    ) -> Result<Option<Box<dyn Controller + '_>>, Failure> {
        let begin = told(settings, path)?;
        self.trial(self.start()?, begin, false).map(Some)
    }
}

/// A trial in a process.
struct Trial<'a> {
    source: &'a Foreign,
    /// None once it failed.
    child: Option<Child>,
    /// Whether its process rests after it, for another trial.
    rests: bool,
    limit_ms: u64,
}

impl Controller for Trial<'_> {
    fn tick(&mut self, sensed: &Sensed<f64>) -> Result<[f64; 4], Failure> {
        let Some(child) = &mut self.child else {
            return Err(Failure::Ended("it failed before".to_owned()));
        };
        let phase = Phase::Tick(child.next_tick());
        let failure = match child.ask(phase, &Message::Tick(*sensed), self.limit_ms) {
            Ok(Message::Currents(currents_a)) => return Ok(currents_a),
            Ok(_) => Failure::Garbage(format!("no currents, {phase}")),
            Err(failure) => failure,
        };
        self.child = None;
        Err(failure)
    }
    fn end(&mut self) -> Result<(), Failure> {
        // One that failed has ended.
        let Some(mut child) = self.child.take() else {
            return Ok(());
        };
        let limits = &self.source.limits;
        child.ask(Phase::Shutdown, &Message::Over, limits.start_ms)?;
        if self.rests {
            held(&self.source.idle).insert(current().id(), child);
        }
        Ok(())
    }
}
