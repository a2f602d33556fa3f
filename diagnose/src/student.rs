//! This file converts a standard error to the half width of a 95 % interval by Student's t.

use statrs::distribution::{ContinuousCDF, StudentsT};

/// The half width; `None` if there are no degrees of freedom.
pub fn half_width(standard_error: f64, freedom: f64) -> Option<f64> {
    if !(standard_error > 0.0 && freedom > 0.0) {
        return None;
    }
    let t = StudentsT::new(0.0, 1.0, freedom).ok()?;
    Some(t.inverse_cdf(0.975) * standard_error)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_quantile_is_the_one_of_the_tables() {
        // Student's t, two-sided 95 %: 2.776 with 4 degrees of freedom, 2.228 with 10.
        for (freedom, quantile) in [(4.0, 2.776_445), (10.0, 2.228_139)] {
            let half = half_width(0.3, freedom).unwrap();
            assert!((half / 0.3 - quantile).abs() < 1e-5, "{half}");
        }
        assert_eq!(half_width(0.0, 4.0), None);
        assert_eq!(half_width(0.3, 0.0), None);
    }
}
