//! What holds for every input: claims about the rig's own code, the engines that examine them, and the ledger of what came out.

pub mod campaign;
pub mod classes;
pub mod engine;
pub mod false_claims;
pub mod fingerprint;
pub mod fork;
pub mod interval;
pub mod kani;
pub mod ledger;
pub mod mutation;
pub mod order;
pub mod planted;
pub mod prove;
pub mod replay;
pub mod script;
pub mod solver;
pub mod symbol;
pub mod width;
pub mod work;

use rigproof_impl::claim::{Checker, Claim};

/// Every claim of this ledger.
pub fn claims<C: Checker>() -> Vec<Claim<C>> {
    rigproof_impl::select::proofs::claims()
        .chain(rigproof_impl::guard::proofs::claims())
        .chain(rigproof_impl::plant::backlash::proofs::claims())
        .collect()
}
