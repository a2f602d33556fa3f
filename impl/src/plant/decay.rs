//! This file is the mean of a decaying exponential, from which every exact first-order step follows.

/// Greatest exponent that the continued fraction is taken for.
const FRACTION: f64 = 0.5;

/// (1 − e⁻ˣ)/x: the mean of e⁻ˣᵗ for t from 0 to 1; e⁻ˣ is 1 − x times this. Relative error at most a few units in the last place.
#[inline]
pub fn decayed(exponent: f64) -> f64 {
    if exponent.abs() <= FRACTION {
        // 1 − e⁻ˣ is 2·t/(1 + t) with t = tanh(x/2), here y·n/d by the first six terms of Lambert's continued fraction;
        // what is left out is at most 1e-16.
        let y = 0.5 * exponent;
        let square = y * y;
        let n = 10_395.0 + square * (1_260.0 + square * 21.0);
        let d = 10_395.0 + square * (4_725.0 + square * (210.0 + square));
        n / (d + y * n)
    } else {
        -libm::expm1(-exponent) / exponent
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_fraction_and_the_function_are_one() {
        let mut worst = 0.0_f64;
        for k in -911..=911_i32 {
            let exponent = 0.9e-3 * f64::from(k) + 1e-7;
            let exact = -libm::expm1(-exponent) / exponent;
            worst = worst.max((decayed(exponent) / exact - 1.0).abs());
        }
        assert!(worst < 7e-16, "{worst:e}");
        assert_eq!(decayed(0.0), 1.0);
    }
}
