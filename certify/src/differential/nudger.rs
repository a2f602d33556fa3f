//! This file draws by how much a nudge moves what both implementations are told.

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// Draws nudges from a seed.
#[derive(Debug)]
pub struct Nudger(Pcg64Mcg);

impl Nudger {
    /// The nudges of a seed.
    pub fn new(seed: u64) -> Nudger {
        Nudger(Pcg64Mcg::seed_from_u64(seed))
    }

    /// A number of either sign between −1 and 1.
    pub fn nudge(&mut self) -> f64 {
        -1.0 + 2.0 * self.0.random::<f64>()
    }
}
