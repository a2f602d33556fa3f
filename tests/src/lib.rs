//! Where the rooms meet. The tests stand in `tests/`; this is what they share.

/// How many cases a property tries: `PROPTEST_CASES`, or what a test has time for.
///
/// # Panics
///
/// If the variable is no number.
pub fn cases(usually: u32) -> u32 {
    let asked = std::env::var("PROPTEST_CASES");
    asked.map_or(usually, |count| count.parse().unwrap())
}
