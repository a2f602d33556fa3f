//! This file is a law of the position that turns with the sense of motion, as what a brake gives does.

use super::{Instant, Law};

/// A law of the position as a resistance.
pub(super) struct Resisting(pub(super) Box<dyn Law>);

impl Law for Resisting {
    fn dry(&self, now: &Instant) -> f64 {
        self.0.smooth(now, 0.0)
    }
}
