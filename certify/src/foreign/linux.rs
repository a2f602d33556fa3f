//! This file makes trials out of processes: one is begun for each trial, or begun anew.

use std::thread::current;

use rigproof_impl::tick::{Sensed, Settings};

use super::child::{Child, of_left};
use super::phase::Phase;
use super::protocol::{Begin, Message};
use super::{Foreign, MOST_POINTS, held};
use crate::axis::controller as axis;
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

    /// A trial in the process that this thread's last one had, or in a new one.
    fn begun(&self, message: &Message, sample_s: f64) -> Result<Trial<'_>, Failure> {
        if let Some(child) = self.rested() {
            match self.trial(child, message, sample_s, true) {
                Ok(trial) => return Ok(trial),
                // Which trial it had before is chance: a trial is judged by a new process.
                Err(failure) => self.keep(format!("after another trial: {failure}")),
            }
        }
        self.trial(self.start()?, message, sample_s, true)
    }

    /// The same trial again, in the process that it had.
    fn begun_again(&self, message: &Message, sample_s: f64) -> Result<Trial<'_>, Failure> {
        match self.rested() {
            Some(child) => self.trial(child, message, sample_s, true),
            None => self.begun(message, sample_s),
        }
    }

    /// The same trial in a process that has run none, and runs no other.
    fn begun_elsewhere(&self, message: &Message, sample_s: f64) -> Result<Trial<'_>, Failure> {
        self.trial(self.start()?, message, sample_s, false)
    }

    /// A trial in a process that begins it as it is told.
    fn trial(
        &self,
        mut child: Child,
        message: &Message,
        sample_s: f64,
        rests: bool,
    ) -> Result<Trial<'_>, Failure> {
        child.forget_ticks();
        child.ask(Phase::Init, message, self.limits.start_ms)?;
        Ok(Trial {
            source: self,
            child: Some(child),
            rests: rests && !self.limits.one_trial_a_process,
            limit_ms: self.limits.tick_ms(sample_s),
        })
    }
}

/// What a controller is told at the beginning.
fn told(settings: &Settings, path: &Task) -> Result<Message, Failure> {
    if let Task::Chain(points_m) | Task::Spline(points_m) = path
        && points_m.len() > MOST_POINTS
    {
        return Err(Failure::Refused(format!(
            "the path has {} points, a compiled controller is told {MOST_POINTS} at most: give it a path of fewer",
            points_m.len()
        )));
    }
    Ok(Message::Begin(Box::new(Begin {
        settings: *settings,
        task: path.clone(),
    })))
}

impl Source for Foreign {
    fn begin(&self, settings: &Settings, path: &Task) -> Result<Box<dyn Controller + '_>, Failure> {
        let trial = self.begun(&told(settings, path)?, settings.sample_s)?;
        Ok(Box::new(trial))
    }

    fn begin_again(
        &self,
        settings: &Settings,
        path: &Task,
    ) -> Result<Box<dyn Controller + '_>, Failure> {
        let trial = self.begun_again(&told(settings, path)?, settings.sample_s)?;
        Ok(Box::new(trial))
    }

    fn begin_elsewhere(
        &self,
        settings: &Settings,
        path: &Task,
    ) -> Result<Option<Box<dyn Controller + '_>>, Failure> {
        let trial = self.begun_elsewhere(&told(settings, path)?, settings.sample_s)?;
        Ok(Some(Box::new(trial)))
    }
}

impl axis::Source for Foreign {
    fn begin(
        &self,
        settings: &axis::Settings,
        place: axis::Place,
    ) -> Result<Box<dyn axis::Controller + '_>, Failure> {
        let (message, sample_s) = (Message::BeginAxis(*settings), settings.sample_s);
        let trial = match place {
            axis::Place::Any => self.begun(&message, sample_s),
            axis::Place::Same => self.begun_again(&message, sample_s),
            axis::Place::New => self.begun_elsewhere(&message, sample_s),
        };
        Ok(Box::new(trial?))
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

impl Trial<'_> {
    /// Asks for one tick.
    fn ask(&mut self, message: &Message) -> Result<Message, Failure> {
        let Some(child) = &mut self.child else {
            return Err(Failure::Ended("it failed before".to_owned()));
        };
        let phase = Phase::Tick(child.next_tick());
        let answer = child.ask(phase, message, self.limit_ms);
        let failure = match (answer, message) {
            (Ok(answer @ Message::Currents(_)), Message::Tick(_))
            | (Ok(answer @ Message::Effort(_)), Message::TickAxis(_)) => return Ok(answer),
            (Ok(other), _) => Failure::Garbage(format!("{other:?}, {phase}")),
            (Err(failure), _) => failure,
        };
        self.child = None;
        Err(failure)
    }

    /// Ends the trial; its process may rest.
    fn over(&mut self) -> Result<(), Failure> {
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

impl Controller for Trial<'_> {
    fn tick(&mut self, sensed: &Sensed<f64>) -> Result<[f64; 4], Failure> {
        match self.ask(&Message::Tick(*sensed))? {
            Message::Currents(currents_a) => Ok(currents_a),
            other => Err(Failure::Garbage(format!("{other:?}"))),
        }
    }

    fn end(&mut self) -> Result<(), Failure> {
        self.over()
    }
}

impl axis::Controller for Trial<'_> {
    fn tick(&mut self, sensed: &axis::Sensed) -> Result<f64, Failure> {
        match self.ask(&Message::TickAxis(*sensed))? {
            Message::Effort(effort) => Ok(effort),
            other => Err(Failure::Garbage(format!("{other:?}"))),
        }
    }

    fn end(&mut self) -> Result<(), Failure> {
        self.over()
    }
}
