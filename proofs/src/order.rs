//! This file says how two rounded sums or products lie to each other where the order of their parts is known: rounding to nearest keeps order.

use crate::interval::Interval;

/// The left one may be less.
pub const LESS: u8 = 1;
/// The two may be equal.
pub const EQUAL: u8 = 2;
/// The left one may be greater.
pub const GREATER: u8 = 4;
/// One of them may be no number.
pub const UNORDERED: u8 = 8;
/// Nothing is known.
pub const ANY: u8 = LESS | EQUAL | GREATER | UNORDERED;

/// A factor of the left product and the one in its place of the right product.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Factors {
    /// Which orders are possible between the two.
    pub orders: u8,
    /// What each can be.
    pub intervals: [Interval; 2],
}

/// The same orders with the sides exchanged.
pub fn reversed(orders: u8) -> u8 {
    let kept = orders & (EQUAL | UNORDERED);
    let less = if orders & GREATER == 0 { 0 } else { LESS };
    let greater = if orders & LESS == 0 { 0 } else { GREATER };
    kept | less | greater
}

/// Which orders are possible between two sums, given those of their parts: the sum of the greater ones is the greater one.
pub fn of_sums([one, other]: [u8; 2]) -> u8 {
    if no_less(one) && no_less(other) {
        EQUAL | GREATER | UNORDERED
    } else if no_greater(one) && no_greater(other) {
        LESS | EQUAL | UNORDERED
    } else {
        ANY
    }
}

fn no_less(orders: u8) -> bool {
    orders & (LESS | UNORDERED) == 0
}

fn no_greater(orders: u8) -> bool {
    orders & (GREATER | UNORDERED) == 0
}

/// Which orders are possible between two products.
///
/// Where each factor keeps its sign, the product of the greater magnitudes has the greater magnitude: exactly, so also rounded.
pub fn of_products([one, other]: [Factors; 2]) -> u8 {
    let (Some((one_negative, one)), Some((other_negative, other))) =
        (magnitudes(one), magnitudes(other))
    else {
        return ANY;
    };
    let of_magnitudes = if no_less(one) && no_less(other) {
        EQUAL | GREATER
    } else if no_greater(one) && no_greater(other) {
        LESS | EQUAL
    } else {
        return ANY;
    };
    let of_products = if one_negative == other_negative {
        of_magnitudes
    } else {
        reversed(of_magnitudes)
    };
    of_products | UNORDERED
}

/// Whether both factors are at most zero, and the orders of their magnitudes; nothing where their signs are not known or not the same.
fn magnitudes(factors: Factors) -> Option<(bool, u8)> {
    let Factors { orders, intervals } = factors;
    let all = |has: fn(&Interval) -> bool| intervals.iter().all(has);
    if all(|interval| interval.low >= 0.0) {
        Some((false, orders))
    } else if all(|interval| interval.high <= 0.0) {
        Some((true, reversed(orders)))
    } else {
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Ends of ranges, numbers whose products round, and neighbours.
    const NUMBERS: [f64; 13] = [
        f64::NEG_INFINITY,
        -1e300,
        -3.000_000_000_000_000_4,
        -3.0,
        -5e-324,
        -0.0,
        0.0,
        5e-324,
        1e-160,
        0.1,
        0.100_000_000_000_000_02,
        7e200,
        f64::INFINITY,
    ];

    fn order(one: f64, other: f64) -> u8 {
        one.partial_cmp(&other)
            .map_or(UNORDERED, |order| match order {
                std::cmp::Ordering::Less => LESS,
                std::cmp::Ordering::Equal => EQUAL,
                std::cmp::Ordering::Greater => GREATER,
            })
    }

    /// What is known of two numbers when only a half-line of each and their order, or a wider one, is.
    fn known(one: f64, other: f64, wider: u8) -> Factors {
        let side = |number: f64| Interval {
            low: if number >= 0.0 {
                0.0
            } else {
                f64::NEG_INFINITY
            },
            high: if number <= 0.0 { 0.0 } else { f64::INFINITY },
            undefined: false,
        };
        Factors {
            orders: order(one, other) | wider,
            intervals: [side(one), side(other)],
        }
    }

    #[test]
    fn no_order_that_two_sums_or_products_have_is_ruled_out() {
        let mut ruled = 0;
        for a in NUMBERS {
            for b in NUMBERS {
                for c in NUMBERS {
                    for d in NUMBERS {
                        for wider in [0, EQUAL, LESS, GREATER, UNORDERED] {
                            let factors = [known(a, c, wider), known(b, d, EQUAL)];
                            let possible = of_products(factors);
                            let found = order(a * b, c * d);
                            assert!(possible & found != 0, "{a} {b} {c} {d} {factors:?}");
                            ruled += u32::from(possible != ANY);
                            let sums = of_sums(factors.map(|factors| factors.orders));
                            let found = order(a + b, c + d);
                            assert!(sums & found != 0, "{a} {b} {c} {d} {factors:?}");
                        }
                    }
                }
            }
        }
        assert!(ruled > 10_000, "{ruled}");
    }

    #[test]
    fn exchanged_twice_is_as_before() {
        for orders in 0..=ANY {
            assert_eq!(reversed(reversed(orders)), orders);
        }
        assert_eq!(reversed(LESS | UNORDERED), GREATER | UNORDERED);
    }
}
