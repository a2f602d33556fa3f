//! This file is the mean of a decaying exponential, from which every exact first-order step follows.

use super::turn::series;

/// Greatest exponent that the series is taken for.
const SERIES: f64 = 0.33;

/// (1 − e⁻ˣ)/x: the mean of e⁻ˣᵗ for t from 0 to 1; e⁻ˣ is 1 − x times this. Relative error at most a few units in the last place.
#[inline]
pub fn decayed(exponent: f64) -> f64 {
    if exponent.abs() <= SERIES {
        // To the 11th power: what is left out is at most 3e-16.
        series(-exponent, RECIPROCAL_FACTORIALS)
    } else {
        -libm::expm1(-exponent) / exponent
    }
}

/// 1/(k + 1)!.
const RECIPROCAL_FACTORIALS: [f64; 12] = [
    1.0,
    1.0 / 2.0,
    1.0 / 6.0,
    1.0 / 24.0,
    1.0 / 120.0,
    1.0 / 720.0,
    1.0 / 5_040.0,
    1.0 / 40_320.0,
    1.0 / 362_880.0,
    1.0 / 3_628_800.0,
    1.0 / 39_916_800.0,
    1.0 / 479_001_600.0,
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_series_and_the_function_are_one() {
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
