//! This file holds what is claimed about selection, and the inputs that the claims share.

mod best;
mod decide;
mod gate;
mod proportional;
mod sdof;

use super::{Desired, Rows, is_sound};
use crate::claim::{Checker, Claim};
use crate::vector::Vector;

/// Every claim about selection.
pub fn claims<C: Checker>() -> impl Iterator<Item = Claim<C>> {
    best::claims()
        .into_iter()
        .chain(gate::claims())
        .chain(proportional::claims())
        .chain(sdof::claims())
        .chain(decide::claims())
}

fn vector<C: Checker>(c: &mut C) -> Vector<C::Number> {
    Vector::new(c.scalar(), c.scalar())
}

/// Any desired direction; off the path where `towards` says so.
fn desired<C: Checker>(c: &mut C, off_path: bool) -> Desired<C::Number> {
    Desired {
        direction: vector(c),
        along: vector(c),
        towards: off_path.then(|| vector(c)),
    }
}

/// One brake's row, a velocity or force, and a desired direction that the gate lets through, off the path.
#[expect(clippy::type_complexity, reason = "one row, one vector, one direction")]
fn gated<C: Checker>(
    c: &mut C,
) -> Option<(Vector<C::Number>, Vector<C::Number>, Desired<C::Number>)> {
    let (row, other, desired) = (vector(c), vector(c), desired(c, true));
    let rows: Rows<C::Number> = [Some(row), None, None, None];
    c.assume(is_sound(&rows, &[other], &desired))?;
    Some((row, other, desired))
}
