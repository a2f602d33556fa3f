//! This file says what a controller under test is: something that is told what is sensed and answers with currents, or breaks.

use rigproof_impl::law::Law;
use rigproof_impl::tick::{Sensed, Settings, Tick};
use serde::{Deserialize, Serialize};

/// A controller at work in one trial.
pub trait Controller {
    /// The brake currents of one tick, A, in the order A, E, B, C; nothing about them is promised.
    ///
    /// # Errors
    /// [`Failure`]: the controller did not answer. It is not asked again in this trial.
    fn tick(&mut self, sensed: &Sensed<f64>) -> Result<[f64; 4], Failure>;

    /// The trial is over; after a tick that failed it is not called.
    ///
    /// # Errors
    /// [`Failure`]: it broke in what it does at the end, or left something running: it did not answer this trial.
    fn end(&mut self) -> Result<(), Failure> {
        Ok(())
    }
}

/// What makes controllers: one for every trial, on any thread.
pub trait Source: Sync {
    /// A controller that has seen nothing, for a rig and the path it is to keep to.
    ///
    /// # Errors
    /// [`Failure`]: it could not be begun.
    fn begin(&self, settings: &Settings, path: &Task) -> Result<Box<dyn Controller + '_>, Failure>;

    /// The same again, after the trial that ended last on this thread: where controllers outlive a trial, with the one that it had.
    ///
    /// # Errors
    /// [`Failure`]: it could not be begun again.
    fn begin_again(
        &self,
        settings: &Settings,
        path: &Task,
    ) -> Result<Box<dyn Controller + '_>, Failure> {
        self.begin(settings, path)
    }

    /// The same once more in a process that has run no trial: with another number, at another time, elsewhere in memory. `None` where controllers have no
    /// process of their own.
    ///
    /// # Errors
    /// [`Failure`]: it could not be begun there.
    fn begin_elsewhere(
        &self,
        _settings: &Settings,
        _path: &Task,
    ) -> Result<Option<Box<dyn Controller + '_>>, Failure> {
        Ok(None)
    }
}

/// What the operator is to follow or to stay out of, in the plane of the rig.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Task {
    /// A chain of straight lines through these points, m; two points are a line.
    Chain(Vec<[f64; 2]>),
    /// An arc about a centre, m, from one angle to another, rad.
    #[expect(missing_docs, reason = "the variant says it")]
    Arc {
        centre_m: [f64; 2],
        radius_m: f64,
        from_rad: f64,
        to_rad: f64,
    },
    /// A natural cubic spline through these points, m.
    Spline(Vec<[f64; 2]>),
}

/// How a controller broke. Each is a finding about the controller, never the end of a campaign.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Failure {
    /// It cannot be run at all, whatever the settings.
    #[error("the controller cannot be run: {0}")]
    Unusable(String),
    /// It refuses the settings.
    #[error("the controller refuses the settings: {0}")]
    Refused(String),
    /// Its process ended.
    #[error("the controller's process ended: {0}")]
    Ended(String),
    /// It did not answer in time.
    #[error("the controller did not answer within {limit_ms} ms")]
    Hung {
        /// The time it was given, ms.
        limit_ms: u64,
    },
    /// It wrote where it must not.
    #[error("the controller wrote outside its buffer: {0}")]
    WroteOutside(String),
    /// Its process answered what is no answer.
    #[error("the controller's process answered what is no answer: {0}")]
    Garbage(String),
    /// Its trial is over, and not all that it had started is.
    #[error("the controller left {0} of its processes running after the trial")]
    LeftRunning(u32),
    /// It said itself that it failed.
    #[error("the controller answered with status {0}")]
    Status(i32),
}

impl<F> Source for F
where
    F: Fn(&Settings, &Task) -> Result<Box<dyn Controller>, Failure> + Sync,
{
    fn begin(&self, settings: &Settings, path: &Task) -> Result<Box<dyn Controller + '_>, Failure> {
        self(settings, path)
    }
}

impl<L: Law<f64>> Controller for Tick<f64, L> {
    fn tick(&mut self, sensed: &Sensed<f64>) -> Result<[f64; 4], Failure> {
        Ok(Tick::tick(self, sensed).currents_a)
    }
}
