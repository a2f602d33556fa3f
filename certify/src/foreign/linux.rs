//! This file makes trials out of processes: one is begun for each trial, or begun anew.

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
        let child = self.start()?;
        self.rest(child);
        Ok(())
    }

    /// Ends every process that is at rest; what a controller had left running is then among [`Foreign::between_trials`]. Another trial may begin.
    pub fn end(&self) {
        let idle = std::mem::take(&mut *held(&self.idle));
        for child in idle {
            self.end_one(child);
        }
    }

    fn end_one(&self, mut child: Child) {
        let left = child.stop().left;
        if left > 0 {
            self.keep(format!("when its process was ended{}", of_left(left)));
        }
    }

    fn start(&self) -> Result<Child, Failure> {
        Child::start(&self.library, &self.host, &self.limits)
    }

    fn rest(&self, child: Child) {
        if self.limits.one_trial_a_process {
            self.end_one(child);
        } else {
            held(&self.idle).push(child);
        }
    }

    /// A process that has begun the trial.
    fn begun(&self, message: &Message) -> Result<Child, Failure> {
        let begin = |mut child: Child| {
            child.forget_ticks();
            let begun = child.ask(Phase::Init, message, self.limits.start_ms);
            begun.map(|_| child)
        };
        let idle = held(&self.idle).pop();
        if let Some(child) = idle {
            match begin(child) {
                Ok(child) => return Ok(child),
                // Which trial it had before is chance: a trial is judged by a new process.
                Err(failure) => self.keep(format!("after another trial: {failure}")),
            }
        }
        begin(self.start()?)
    }
}

impl Source for Foreign {
    fn begin(&self, settings: &Settings, path: &Task) -> Result<Box<dyn Controller + '_>, Failure> {
        if let Task::Chain(points_m) | Task::Spline(points_m) = path
            && points_m.len() > MOST_POINTS
        {
            return Err(Failure::Refused(format!(
                "the path has {} points, a compiled controller is told {MOST_POINTS} at most: give it a path of fewer",
                points_m.len()
            )));
        }
        let begin = Begin {
            settings: *settings,
            task: path.clone(),
        };
        let child = self.begun(&Message::Begin(Box::new(begin)))?;
        Ok(Box::new(Trial {
            source: self,
            child: Some(child),
            limit_ms: self.limits.tick_ms(settings.sample_s),
        }))
    }
}

/// A trial in a process.
struct Trial<'a> {
    source: &'a Foreign,
    /// None once it failed.
    child: Option<Child>,
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
}

impl Drop for Trial<'_> {
    fn drop(&mut self) {
        let Some(mut child) = self.child.take() else {
            return;
        };
        let limit_ms = self.source.limits.start_ms;
        match child.ask(Phase::Shutdown, &Message::Over, limit_ms) {
            Ok(_) => self.source.rest(child),
            Err(failure) => self.source.keep(format!("in shutdown: {failure}")),
        }
    }
}
