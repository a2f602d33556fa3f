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
        Some(exponent @ -5..=5) => {
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

/// Most digits of a number with an interval, in a table; in a sentence one fewer.
const MOST: usize = 4;
/// Digits of a number whose interval is not known.
const UNTOLD: usize = 3;

/// A number and the ends of its interval to one decimal place: that at which half the interval has
/// two digits, or an earlier one where the largest of the three would have more than `most`.
/// Without an interval the number has three digits. `write` writes a number with so many digits.
pub fn told(
    value: f64,
    interval: Option<[f64; 2]>,
    most: usize,
    write: fn(f64, usize) -> String,
) -> (String, Option<[String; 2]>) {
    let Some([low, high]) = interval else {
        return (write(value, UNTOLD), None);
    };
    let largest = value.abs().max(low.abs()).max(high.abs());
    let (Some(half), Some(largest)) = (exponent(0.5 * (high - low)), exponent(largest)) else {
        return (
            write(value, most),
            Some([low, high].map(|own| write(own, most))),
        );
    };
    let last = (half - 1).max(largest - most as i32 + 1);
    let to = |own: f64| match exponent(own) {
        // Digits before the point that say nothing are noughts.
        Some(first) if first >= last && last > 0 => {
            let place = libm::pow(10.0, f64::from(last));
            write((own / place).round() * place, (first - last + 1) as usize)
        }
        Some(first) if first >= last => write(own, (first - last + 1) as usize),
        _ => "0".to_owned(),
    };
    (to(value), Some([to(low), to(high)]))
}

/// The power of ten of a number's first digit; nothing where it has none.
fn exponent(value: f64) -> Option<i32> {
    (value.is_finite() && value != 0.0).then(|| libm::floor(libm::log10(value.abs())) as i32)
}

/// The ends of a number's interval.
pub fn interval(number: &Number) -> Option<[f64; 2]> {
    number.low95.zip(number.high95).map(<[f64; 2]>::from)
}

/// A number of a report and its interval, with as many digits as the interval tells.
pub fn told_of(number: &Number) -> (String, Option<[String; 2]>) {
    told(number.value, interval(number), MOST, significant)
}

/// A number with its unit and interval.
pub fn with_interval(number: &Number) -> String {
    let (value, interval) = told_of(number);
    let value = joined(value, &number.unit);
    match interval {
        Some([low, high]) => format!("{value}   (95 %: {low} to {high})"),
        None => format!("{value}   (no interval)"),
    }
}

/// A measured value with its unit; a plain number has none. Three digits: what has an interval goes by that.
pub fn with_unit(value: f64, unit: &str) -> String {
    joined(significant(value, UNTOLD), unit)
}

/// A value that is stated and has no interval, such as a sensor's count, with its unit: four digits.
pub fn stated(value: f64, unit: &str) -> String {
    joined(significant(value, MOST), unit)
}

fn joined(value: String, unit: &str) -> String {
    match unit {
        "" | "1" => value,
        unit => format!("{value} {unit}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_has_the_digits_that_its_interval_tells() {
        let of = |value, low, high| {
            let (value, interval) = told(value, Some([low, high]), 4, significant);
            let [low, high] = interval.unwrap();
            [value, low, high].join(" ")
        };
        assert_eq!(of(0.377_12, 0.344_71, 0.409_53), "0.377 0.345 0.410");
        assert_eq!(
            of(0.048_63, 0.048_501, 0.048_759),
            "0.04863 0.04850 0.04876"
        );
        // No more than four, however narrow the interval is.
        assert_eq!(of(9.812_345, 9.812_3, 9.812_4), "9.812 9.812 9.812");
        assert_eq!(of(1.9, -6.3, 10.1), "1.9 -6.3 10.1");
        assert_eq!(of(-0.03, -21.0, 20.0), "0 -21 20");
        assert_eq!(of(123_456.0, 101_000.0, 145_000.0), "123000 101000 145000");
        assert_eq!(
            told(0.718_9, None, 4, significant),
            ("0.719".to_owned(), None)
        );
    }

    #[test]
    fn digits_are_those_that_say_something() {
        for (value, expected) in [
            (0.034594, "0.03459"),
            (-123_456.0, "-123456"),
            (9.999_96, "10.00"),
            (7.196e-4, "0.0007196"),
            (2.5e-7, "2.500e-7"),
            (7.25e8, "7.250e8"),
            (0.0, "0"),
            (-0.0, "0"),
            (f64::NAN, "NaN"),
        ] {
            assert_eq!(significant(value, 4), expected);
        }
        assert_eq!(with_unit(1.5, "1"), "1.50");
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
