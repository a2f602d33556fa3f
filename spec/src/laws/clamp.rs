//! This file says what becomes of a current that a controller asks for.

/// Whether a current given is the one asked for, where that lies between none and the greatest; else the nearer end; and none where no
/// number was asked for.
///
/// Source: §3.2, the amplifiers give up to 1 A; that nothing undefined acts is this project's.
pub fn clamped<T: Copy + PartialOrd + From<i8>>(asked_a: T, given_a: T, greatest_a: T) -> bool {
    let none_a = T::from(0);
    let expected_a = if asked_a > greatest_a {
        greatest_a
    } else if asked_a > none_a {
        asked_a
    } else {
        none_a
    };
    given_a == expected_a
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_current_is_given_as_asked_up_to_the_ends() {
        for (asked_a, given_a) in [
            (0.37, 0.37),
            (1.3, 1.0),
            (-0.2, 0.0),
            (f64::NAN, 0.0),
            (f64::INFINITY, 1.0),
            (f64::NEG_INFINITY, 0.0),
        ] {
            assert!(clamped(asked_a, given_a, 1.0), "{asked_a} A");
            assert!(!clamped(asked_a, given_a + 0.003, 1.0), "{asked_a} A");
        }
        assert!(!clamped(0.37, f64::NAN, 1.0));
    }
}
