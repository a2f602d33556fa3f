//! This file holds what is claimed about the gate: what a selection takes at all.

use super::{desired, vector};
use crate::claims;
use crate::number::Scalar;
use crate::select::{GREATEST_INPUT, LEAST_ROW_SQUARED_PER_M2, is_sound};
use crate::vector::Vector;

claims! {
    /// The gate lets a row, a vector and a desired direction through if and only if every component is a number of at most a million and the
    /// row's squared length at least the least.
    /// Source: none in the thesis: law `undefined_input`. Assumes one row, at any place; another row is asked the same.
    Numbers fn the_gate_lets_through_what_is_bounded(c) {
        let (place, off_path) = (c.choice(4), c.choice(2) == 1);
        let (row, other) = (vector(c), vector(c));
        let desired = desired(c, off_path);
        let rows = [0, 1, 2, 3].map(|joint| (joint == place).then_some(row));
        let sound = is_sound(&rows, &[other], &desired);
        c.cover("let through", sound);
        c.cover("refused", !sound);
        let greatest = C::Number::of(GREATEST_INPUT);
        let inside = |number: C::Number| -greatest <= number && number <= greatest;
        let bounded = |vector: Vector<C::Number>| inside(vector.x) && inside(vector.y);
        let expected = bounded(other)
            && bounded(desired.direction)
            && bounded(desired.along)
            && desired.towards.is_none_or(bounded)
            && bounded(row)
            && row.x * row.x + row.y * row.y >= C::Number::of(LEAST_ROW_SQUARED_PER_M2);
        c.check(sound == expected)?;
    }
}
