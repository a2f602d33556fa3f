//! This file is what a plant has to do for a case to be made on it; making, sealing and scoring know nothing else of a plant.

use crate::draw::Draw;
use crate::effect::Effect;
use crate::fault::Names;
use crate::forms::Forms;
use crate::plant::Plant;
use crate::size::Sizes;
use crate::stratum::Stratum;
use rigproof_spec::effect::Motion;
use rigproof_trace::Trace;

/// A kind of machine with its laboratory.
pub trait Lab {
    /// What is drawn of a laboratory: sizes, sensors, how it is moved.
    type Setup: Clone;
    /// The true signals of a recording.
    type Run;

    /// The plant's name in files.
    fn plant(&self) -> Plant;

    /// The family of forms that it hides physics in.
    fn forms(&self) -> Forms {
        Forms::Usual
    }

    /// The random numbers of a seed for one purpose; each family has its own.
    fn numbers(&self, seed: u64, purpose: &str) -> Draw {
        match self.forms() {
            Forms::Usual => Draw::new(self.plant(), seed, purpose),
            Forms::Other => Draw::new(self.plant(), seed, &format!("other {purpose}")),
        }
    }

    /// One draw of a seed; `None` where it cannot be.
    fn draw(&self, seed: u64, stratum: Stratum, draw: &mut Draw) -> Option<Drawn<Self::Setup>>;

    /// What happens; `None` where the machine leaves its range.
    fn run(&self, drawn: &Drawn<Self::Setup>) -> Option<Self::Run>;

    /// How visible the hidden effects are.
    fn sizes(&self, drawn: &Drawn<Self::Setup>, run: &Self::Run) -> Sizes;

    /// What the sensors make of a run.
    fn record(&self, case: &Secret<Self::Setup, Self::Run>, draw: &mut Draw) -> Trace;

    /// The rig description that goes with the recording, TOML.
    fn describe(&self, seed: u64, drawn: &Drawn<Self::Setup>) -> String;

    /// The channels of position and of effort in which a fault of the data may lie.
    fn channels(&self, draw: &mut Draw) -> Names<'static>;

    /// Whether the machine turns or slides.
    fn motion(&self, setup: &Self::Setup) -> Motion;

    /// The effect with its numbers as the vocabulary counts them.
    fn told(&self, _: &Self::Setup, effect: &Effect) -> Effect {
        *effect
    }

    /// Sets of mechanisms that no recording of this experiment can tell from an effect.
    fn twins(&self, drawn: &Drawn<Self::Setup>, effect: &Effect) -> Vec<Vec<String>>;

    /// Draws, runs and measures.
    fn tried(&self, drawn: Drawn<Self::Setup>) -> Option<Secret<Self::Setup, Self::Run>> {
        let run = self.run(&drawn)?;
        let sizes = self.sizes(&drawn, &run);
        Some(Secret { drawn, run, sizes })
    }
}

/// A laboratory, the physics that its nominal model has, and what is hidden.
#[derive(Clone, Debug)]
pub struct Drawn<S> {
    pub setup: S,
    pub known: Vec<Effect>,
    pub hidden: Vec<Effect>,
}

/// A case before sensors and seals.
pub struct Secret<S, R> {
    pub drawn: Drawn<S>,
    pub run: R,
    pub sizes: Sizes,
}
