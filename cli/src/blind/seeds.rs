//! This file reads which seeds a trial takes.

use std::ops::Range;

/// Most seeds of one trial: years of processor time, whose results are held together.
const MOST_SEEDS: u64 = 1_000_000;

/// Seeds as they are written: FIRST..END.
///
/// # Errors
/// What to write instead.
pub fn parse_seeds(text: &str) -> Result<Range<u64>, String> {
    let advice = || "write FIRST..END with whole numbers, END greater than FIRST, such as 0..200";
    let (first, end) = text.split_once("..").ok_or_else(advice)?;
    let number = |text: &str| text.trim().parse::<u64>().map_err(|_| advice());
    let seeds = number(first)?..number(end)?;
    if seeds.is_empty() {
        return Err(advice().to_owned());
    }
    let count = seeds.end - seeds.start;
    if count > MOST_SEEDS {
        return Err(format!(
            "these are {count} seeds; give at most {MOST_SEEDS} at once"
        ));
    }
    Ok(seeds)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn seeds_are_a_range_that_can_be_held() {
        assert_eq!(parse_seeds("3..7"), Ok(3..7));
        assert_eq!(
            parse_seeds("18446744073709551000..18446744073709551615").map(|seeds| seeds.count()),
            Ok(615)
        );
        for text in [
            "0..18446744073709551615",
            "1..18446744073709551615",
            "0..1000001",
            "7..3",
            "3..3",
            "0..18446744073709551616",
        ] {
            assert!(parse_seeds(text).is_err(), "{text}");
        }
    }
}
