//! This file is what is known of flexible parts, which no room computes.

use super::facts::Words;

pub(super) const WORDS: Words = Words {
    what: "parts that bend",
    look_for: "arms, couplings, the clamping of the base",
};
