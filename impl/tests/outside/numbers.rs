//! This file says that a number which brings nothing but sums, products and order has magnitude and bound all the same: those that f64 has.

use core::ops::{Add, Mul, Neg, Sub};

use rigproof_impl::number::Scalar;

/// A number without answers of its own, as the proofs' are.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
struct Plain(f64);

impl Add for Plain {
    type Output = Plain;
    fn add(self, other: Plain) -> Plain {
        Plain(self.0 + other.0)
    }
}

impl Sub for Plain {
    type Output = Plain;
    fn sub(self, other: Plain) -> Plain {
        Plain(self.0 - other.0)
    }
}

impl Mul for Plain {
    type Output = Plain;
    fn mul(self, other: Plain) -> Plain {
        Plain(self.0 * other.0)
    }
}

impl Neg for Plain {
    type Output = Plain;
    fn neg(self) -> Plain {
        Plain(-self.0)
    }
}

impl Scalar for Plain {
    fn of(constant: f64) -> Plain {
        Plain(constant)
    }
}

#[test]
fn magnitude_and_bound_of_any_number_are_those_of_f64() {
    let numbers = [
        0.0,
        -0.0,
        5e-324,
        -2.3e-308,
        0.7,
        -0.7,
        3.1,
        -1.7e308,
        f64::INFINITY,
    ];
    for value in numbers.into_iter().chain([f64::NEG_INFINITY]) {
        assert_eq!(Plain(value).magnitude().0, value.abs());
        for bound in numbers {
            let is_within = Plain(value).is_within(Plain(bound));
            assert_eq!(
                is_within,
                value.is_within(bound),
                "{value:e} within {bound:e}"
            );
        }
    }
    assert!(Plain(f64::NAN).magnitude().0.is_nan());
    assert!(!Plain(f64::NAN).is_within(Plain(f64::INFINITY)));
    assert!(!Plain(0.7).is_within(Plain(f64::NAN)));
    assert_eq!(Plain::zero(), Plain(0.0));
}
