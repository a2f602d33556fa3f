//! This file says which of the two widths of numbers a claim is examined on.

use rigproof_impl::number::Scalar;

/// IEEE 754 binary64 or binary32.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Width {
    /// binary64: f64.
    #[default]
    Double,
    /// binary32: f32.
    Single,
}

impl Width {
    /// The nearest number of this width.
    ///
    /// The f64 sum, difference or product of two f32 numbers becomes theirs by this: twice 24 bits and two are less than 53, so that rounding
    /// twice is rounding once.
    pub fn rounded(self, number: f64) -> f64 {
        match self {
            Width::Double => number,
            Width::Single => f64::from(number as f32),
        }
    }

    /// The greatest finite number.
    pub fn greatest(self) -> f64 {
        match self {
            Width::Double => f64::MAX,
            Width::Single => f32::MAX.into(),
        }
    }

    /// The bits of a number of this width.
    pub fn bits(self, number: f64) -> u64 {
        match self {
            Width::Double => number.to_bits(),
            Width::Single => (number as f32).to_bits().into(),
        }
    }

    /// The number of these bits; none of more than there are.
    pub fn of_bits(self, bits: u64) -> Option<f64> {
        match self {
            Width::Double => Some(f64::from_bits(bits)),
            Width::Single => u32::try_from(bits)
                .ok()
                .map(|bits| f32::from_bits(bits).into()),
        }
    }
}

/// Numbers that the rig computes with.
pub trait Number: Scalar + From<i8> + Into<f64> {
    /// Their width.
    const WIDTH: Width;
}

impl Number for f64 {
    const WIDTH: Width = Width::Double;
}

impl Number for f32 {
    const WIDTH: Width = Width::Single;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_result_rounded_twice_is_the_result_of_single_numbers() {
        let mut bits = 0x1234_5678_u32;
        let mut next = || {
            bits = bits.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f32::from_bits(bits ^ (bits >> 15))
        };
        let single = Width::Single;
        for _ in 0..200_000 {
            let (a, b) = (next(), next());
            let (wide_a, wide_b) = (f64::from(a), f64::from(b));
            for (narrow, wide) in [
                (a + b, wide_a + wide_b),
                (a - b, wide_a - wide_b),
                (a * b, wide_a * wide_b),
            ] {
                let rounded = single.rounded(wide);
                assert!(f64::from(narrow) == rounded || narrow.is_nan() && rounded.is_nan());
            }
        }
    }

    #[test]
    fn bits_are_those_of_the_width() {
        for (width, bits) in [
            (Width::Double, 0x3ff8_0000_0000_0000),
            (Width::Single, 0x3fc0_0000),
        ] {
            assert_eq!((width.bits(1.5), width.of_bits(bits)), (bits, Some(1.5)));
        }
        assert_eq!(Width::Single.of_bits(1 << 32), None);
    }
}
