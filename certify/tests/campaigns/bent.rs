//! This file bends sound controllers: what they are told, what they answer, what they are made for.

use rigproof_certify::built_in::BuiltIn;
use rigproof_certify::controller::{Controller, Failure, Source, Task};
use rigproof_impl::tick::{Sensed, Settings};

/// What stands around a sound controller.
pub struct Bent<S, B, A> {
    pub inner: Box<dyn Controller>,
    pub state: S,
    pub before: B,
    pub after: A,
}

impl<S, B, A> Controller for Bent<S, B, A>
where
    B: FnMut(&mut S, &Sensed<f64>) -> Sensed<f64>,
    A: FnMut(&mut S, &Sensed<f64>, [f64; 4]) -> Result<[f64; 4], Failure>,
{
    fn tick(&mut self, sensed: &Sensed<f64>) -> Result<[f64; 4], Failure> {
        let bent = (self.before)(&mut self.state, sensed);
        let currents_a = self.inner.tick(&bent)?;
        (self.after)(&mut self.state, sensed, currents_a)
    }
}

pub type Answer = Result<[f64; 4], Failure>;

/// A sound law whose samples and answers are changed.
fn bent<S: Clone + Sync + 'static>(
    law: BuiltIn,
    state: S,
    before: impl Fn(&mut S, &Sensed<f64>) -> Sensed<f64> + Copy + Sync + 'static,
    after: impl Fn(&mut S, &Sensed<f64>, [f64; 4]) -> Answer + Copy + Sync + 'static,
) -> Box<dyn Source> {
    Box::new(
        move |settings: &Settings, task: &Task| -> Result<Box<dyn Controller>, Failure> {
            Ok(Box::new(Bent {
                inner: law.controller(settings, task)?,
                state: state.clone(),
                before,
                after,
            }))
        },
    )
}

/// A sound law whose answers are changed.
pub fn after<S: Clone + Sync + 'static>(
    law: BuiltIn,
    state: S,
    change: impl Fn(&mut S, &Sensed<f64>, [f64; 4]) -> Answer + Copy + Sync + 'static,
) -> Box<dyn Source> {
    bent(law, state, |_, sensed| *sensed, change)
}

/// A sound law whose samples are changed.
pub fn before<S: Clone + Sync + 'static>(
    law: BuiltIn,
    state: S,
    change: impl Fn(&mut S, &Sensed<f64>) -> Sensed<f64> + Copy + Sync + 'static,
) -> Box<dyn Source> {
    bent(law, state, change, |_, _, currents_a| Ok(currents_a))
}

/// A sound law that is told other settings.
pub fn told(law: BuiltIn, change: impl Fn(&mut Settings) + Sync + 'static) -> Box<dyn Source> {
    Box::new(move |settings: &Settings, task: &Task| {
        let mut settings = *settings;
        change(&mut settings);
        law.controller(&settings, task)
    })
}
