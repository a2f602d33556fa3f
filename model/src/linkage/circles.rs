//! This file finds the point at two given distances from two given points.

/// How far the apex of a triangle lies along and beside its base, m; `None` when three sides make no triangle.
///
/// `base` is the distance of two points, `from_first` and `from_second`, finite, are the apex's distances from them. The height is
/// taken from the area in Kahan's form, which keeps its digits in needle-like triangles, where acos does not.
pub fn apex(base: f64, from_first: f64, from_second: f64) -> Option<[f64; 2]> {
    let [a, b, c] = descending([base, from_first, from_second]);
    let needle = c - (a - b);
    if base.is_nan() || base <= 0.0 || needle < 0.0 {
        return None;
    }
    let four_areas = ((a + (b + c)) * needle * (c + (a - b)) * (a + (b - c))).sqrt();
    let along = 0.5 * (base + (from_first - from_second) * ((from_first + from_second) / base));
    Some([along, four_areas / (2.0 * base)])
}

/// The point `along` the way from `first` to `second` and `beside` it to the left; the two are `base` apart.
pub fn beside(first: [f64; 2], second: [f64; 2], base: f64, [along, beside]: [f64; 2]) -> [f64; 2] {
    let [x_1, y_1] = first;
    let [x_2, y_2] = second;
    let (along_x, along_y) = ((x_2 - x_1) / base, (y_2 - y_1) / base);
    [
        x_1 + along * along_x - beside * along_y,
        y_1 + along * along_y + beside * along_x,
    ]
}

fn descending([a, b, c]: [f64; 3]) -> [f64; 3] {
    let (high, low) = (a.max(b), a.min(b));
    [high.max(c), low.max(high.min(c)), low.min(c)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_triangle_of_whole_sides_has_its_height() {
        // Sides 13, 14, 15: the height on 14 is 12 and meets it 5 from the side of 13.
        let [along, height] = apex(14.0, 13.0, 15.0).unwrap();
        assert!((along - 5.0).abs() < 1e-14 && (height - 12.0).abs() < 1e-14);
        let [x, y] = beside([2.0, 1.0], [2.0, 15.0], 14.0, [along, height]);
        assert!((x + 10.0).abs() < 1e-13 && (y - 6.0).abs() < 1e-13);
    }

    #[test]
    fn a_needle_keeps_its_height() {
        // Sides 1, 1, 2·(1 − 2^-40): height² = 1 − (1 − 2^-40)² = 2^-39 − 2^-80.
        let short = libm::exp2(-40.0);
        let [_, height] = apex(2.0 * (1.0 - short), 1.0, 1.0).unwrap();
        let expected = (2.0 * short - short * short).sqrt();
        assert!((height / expected - 1.0).abs() < 1e-15, "{height:e}");
    }

    #[test]
    fn sides_that_do_not_meet_make_no_triangle() {
        for [base, first, second] in [
            [2.7, 1.1, 1.5],
            [0.3, 1.1, 1.5],
            [0.0, 1.3, 1.3],
            [f64::NAN, 1.1, 1.5],
        ] {
            assert_eq!(apex(base, first, second), None);
        }
    }

    #[test]
    fn three_numbers_are_ordered() {
        for three in [
            [3.0, 2.0, 1.0],
            [1.0, 2.0, 3.0],
            [2.0, 1.0, 3.0],
            [2.0, 3.0, 1.0],
        ] {
            assert_eq!(descending(three), [3.0, 2.0, 1.0]);
        }
    }
}
