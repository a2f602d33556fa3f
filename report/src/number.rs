//! This file writes numbers the way a report prints them.

use rigproof_diagnose::report::{Number, Rate};

/// A number with as many significant digits, in powers of ten only where it is very large or small.
pub fn significant(value: f64, digits: usize) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    if !value.is_finite() {
        return value.to_string();
    }
    let scientific = format!("{value:.*e}", digits.saturating_sub(1));
    let exponent = scientific
        .split_once('e')
        .and_then(|(_, e)| e.parse::<i32>().ok());
    match exponent {
        Some(exponent @ -3..=5) => {
            let decimals = usize::try_from(digits as i32 - 1 - exponent).unwrap_or(0);
            format!("{value:.decimals$}")
        }
        _ => scientific,
    }
}

/// A count with a gap between its thousands.
pub fn grouped(count: u64) -> String {
    let digits = count.to_string();
    let mut groups: Vec<&[u8]> = digits.as_bytes().rchunks(3).collect();
    groups.reverse();
    let groups: Vec<_> = groups.into_iter().map(String::from_utf8_lossy).collect();
    groups.join("\u{202f}")
}

/// A share as per cent; what rounds to nothing has no sign.
pub fn percent(share: f64) -> String {
    // −0 and 0 are 0.
    format!("{:.0} %", (100.0 * share).round() + 0.0)
}

/// A probability, never more certain than two digits can say.
pub fn probability(share: f64) -> String {
    match share {
        share if share > 0.99 => "above 99 %".to_owned(),
        share if share < 0.01 => "below 1 %".to_owned(),
        share => percent(share),
    }
}

/// How often of how many, with its interval.
pub fn rate(rate: Rate) -> String {
    format!(
        "{} of {} (95 %: {} to {})",
        rate.count,
        rate.of,
        percent(rate.low95),
        percent(rate.high95)
    )
}

/// A number with its unit and interval.
pub fn with_interval(number: &Number) -> String {
    let value = with_unit(number.value, &number.unit);
    match (number.low95, number.high95) {
        (Some(low), Some(high)) => format!(
            "{value}   (95 %: {} to {})",
            significant(low, 4),
            significant(high, 4)
        ),
        _ => format!("{value}   (no interval)"),
    }
}

/// A value with its unit; a plain number has none.
pub fn with_unit(value: f64, unit: &str) -> String {
    let value = significant(value, 4);
    match unit {
        "" | "1" => value,
        unit => format!("{value} {unit}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_are_those_that_say_something() {
        for (value, expected) in [
            (0.034594, "0.03459"),
            (-123_456.0, "-123456"),
            (9.999_96, "10.00"),
            (2.5e-7, "2.500e-7"),
            (7.25e8, "7.250e8"),
            (0.0, "0"),
            (-0.0, "0"),
            (f64::NAN, "NaN"),
        ] {
            assert_eq!(significant(value, 4), expected);
        }
        assert_eq!(with_unit(1.5, "1"), "1.500");
        assert_eq!(percent(0.374), "37 %");
        assert_eq!(
            [1.0, 0.97, 0.0].map(probability),
            ["above 99 %", "97 %", "below 1 %"]
        );
        assert_eq!(percent(-0.004), "0 %");
        assert_eq!(percent(-0.026), "-3 %");
        assert_eq!(
            [7, 921, 1004, 8_512_034].map(grouped),
            ["7", "921", "1\u{202f}004", "8\u{202f}512\u{202f}034"]
        );
    }
}
