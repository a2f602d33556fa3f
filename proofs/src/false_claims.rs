//! This file holds claims that are false, each on a few numbers among 2⁶⁴: an engine that does not refute them proves nothing.

use rigproof_impl::claims;
use rigproof_impl::number::Scalar;

claims! {
    /// FALSE: no number times three is ten and a little. Of all numbers two or three are.
    Numbers fn no_number_times_three_is_a_little_more_than_ten(c) {
        let number = c.scalar();
        c.cover("any number", true);
        let product = number * Scalar::of(3.0);
        c.check(product != Scalar::of(10.000_001))?;
    }

    /// FALSE: a sum of three numbers between one and two, the first and the last the same, is never five, if the middle one is above 1.999.
    Numbers fn three_numbers_have_no_sum_of_five(c) {
        let (one, other) = (c.scalar(), c.scalar());
        c.assume(one >= Scalar::of(1.0) && one <= Scalar::of(2.0))?;
        c.assume(other > Scalar::of(1.999) && other < Scalar::of(2.0))?;
        c.cover("such numbers", true);
        c.check(one + other + one != Scalar::of(5.0))?;
    }
}
