//! This file says which currents may be commanded.

use super::Margin;
use crate::tables::GREATEST_CURRENT_A;

/// Whether a commanded current is finite and between 0 and 1 A. The margin to the nearer end is A.
///
/// Source: §3.2, the amplifiers are adjusted to 1 A continuous output; table 3.2 is fitted from 0 to 1 A.
pub fn current_limit(current_a: f64) -> Margin {
    Margin(current_a).and(Margin(GREATEST_CURRENT_A - current_a))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_finite_currents_up_to_one_ampere_are_allowed() {
        for allowed in [f64::MIN_POSITIVE, 0.37, 0.999_3] {
            assert!(current_limit(allowed).holds(), "{allowed} A");
        }
        for refused in [-0.003, 1.000_7, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert!(!current_limit(refused).holds(), "{refused} A");
        }
        assert_eq!(current_limit(0.37), Margin(0.37));
        assert_eq!(current_limit(0.875), Margin(0.125));
    }
}
