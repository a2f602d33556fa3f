//! This file holds what is claimed about the guard: what it lets in and what it lets out.

mod judge;
mod release;

use crate::claim::{Checker, Claim};

/// Every claim about the guard.
pub fn claims<C: Checker>() -> impl Iterator<Item = Claim<C>> {
    release::claims().into_iter().chain(judge::claims())
}
