//! This file claims that rates have the right intervals.

use super::rate;

#[test]
fn an_interval_is_that_of_clopper_and_pearson() {
    for (count, of, low, high) in [
        (0, 10, 0.0, 0.308_497),
        (5, 10, 0.187_086, 0.812_914),
        (10, 10, 0.691_503, 1.0),
        (1, 40, 0.000_633, 0.131_586),
    ] {
        let own = rate(count, of);
        assert!((own.low95 - low).abs() < 1e-6, "{own:?}");
        assert!((own.high95 - high).abs() < 1e-6, "{own:?}");
    }
    assert_eq!(rate(0, 0).low95, 0.0);
    assert_eq!(rate(0, 0).high95, 1.0);
}
