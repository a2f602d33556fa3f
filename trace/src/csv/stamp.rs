//! This file reads time stamps: numbers to their last digit, dates and times of day.

use super::dialect::Decimal;

/// More digits are no time stamp.
const MOST_DIGITS: usize = 30;
/// Seconds of a day.
pub(super) const DAY_S: f64 = 86_400.0;

/// A decimal number as it is printed: digits times a power of ten.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Exact {
    digits: i128,
    exponent: i32,
}

impl Exact {
    /// The number in a cell, or `None`.
    pub(super) fn parse(cell: &str, decimal: Decimal) -> Option<Exact> {
        let (mantissa, power) = match cell.split_once(['e', 'E']) {
            Some((mantissa, power)) => (mantissa, power.parse::<i32>().ok()?),
            None => (cell, 0),
        };
        let (sign, unsigned) = match mantissa.strip_prefix('-') {
            Some(rest) => (-1, rest),
            None => (1, mantissa.strip_prefix('+').unwrap_or(mantissa)),
        };
        let mark = match decimal {
            Decimal::Point => '.',
            Decimal::Comma => ',',
        };
        let (whole, fraction) = unsigned.split_once(mark).unwrap_or((unsigned, ""));
        let digits = Exact::digits(whole, fraction)?;
        let exponent = power - i32::try_from(fraction.len()).ok()?;
        (power.abs() < 40).then_some(Exact {
            digits: sign * digits,
            exponent,
        })
    }

    fn digits(whole: &str, fraction: &str) -> Option<i128> {
        let count = whole.len() + fraction.len();
        let mut digits = whole.bytes().chain(fraction.bytes());
        (1..=MOST_DIGITS).contains(&count).then_some(())?;
        digits.try_fold(0_i128, |sum, byte| {
            let digit = byte.is_ascii_digit().then(|| i128::from(byte - b'0'))?;
            Some(10 * sum + digit)
        })
    }

    /// The double nearest to it, nearly.
    pub(super) fn value(self) -> f64 {
        scaled(self.digits, self.exponent)
    }

    /// The difference, taken digit by digit.
    pub(super) fn minus(self, other: Exact) -> f64 {
        let exponent = self.exponent.min(other.exponent);
        let at = |number: Exact| {
            let places = u32::try_from(number.exponent - exponent).ok()?;
            number.digits.checked_mul(10_i128.checked_pow(places)?)
        };
        let difference = || at(self)?.checked_sub(at(other)?);
        match difference() {
            Some(digits) => scaled(digits, exponent),
            None => self.value() - other.value(),
        }
    }

    /// The greatest whole multiple of `of` that is not above it.
    pub(super) fn whole(self, of: i128) -> Exact {
        let power = || 10_i128.checked_pow(self.exponent.unsigned_abs());
        let whole = match (self.exponent >= 0, power()) {
            (true, Some(power)) => self.digits.checked_mul(power).unwrap_or(0),
            (false, Some(power)) => self.digits.div_euclid(power),
            (_, None) => 0,
        };
        Exact {
            digits: whole - whole.rem_euclid(of.max(1)),
            exponent: 0,
        }
    }

    /// What its last digit counts.
    pub(super) fn resolution(self) -> f64 {
        scaled(1, self.exponent)
    }
}

/// Digits times a power of ten, rounded once where both are exact.
fn scaled(digits: i128, exponent: i32) -> f64 {
    let power = (0..exponent.unsigned_abs()).fold(1.0, |power, _| power * 10.0);
    match exponent < 0 {
        true => digits as f64 / power,
        false => digits as f64 * power,
    }
}

/// A date with a time of day, or a time of day alone, in seconds, and whether a date is in it; `None` for anything else.
pub(super) fn calendar(cell: &str) -> Option<(Exact, bool)> {
    let first = cell.find(':')?;
    let (date, time) = match cell.get(..first)?.rfind(['T', ' ', '_']) {
        Some(at) => (cell.get(..at)?.trim(), cell.get(at + 1..)?),
        None => ("", cell),
    };
    let days = match date {
        "" => 0,
        date => days(date)?,
    };
    let (s, fraction) = time_of_day(time)?;
    let places = u32::try_from(fraction.len()).ok()?;
    let exact = Exact {
        digits: (days * 86_400 + s) * 10_i128.checked_pow(places)? + Exact::digits("0", fraction)?,
        exponent: -i32::try_from(places).ok()?,
    };
    Some((exact, !date.is_empty()))
}

/// Whole seconds of a day, and the digits of the fraction.
fn time_of_day(text: &str) -> Option<(i128, &str)> {
    let (text, zone_s) = without_zone(text.trim());
    let upper = text
        .get(text.len().saturating_sub(2)..)
        .map(str::to_ascii_uppercase);
    let (text, half) = match upper.as_deref() {
        Some("AM") => (text.get(..text.len() - 2)?.trim(), Some(0)),
        Some("PM") => (text.get(..text.len() - 2)?.trim(), Some(12)),
        _ => (text, None),
    };
    let mut parts = text.split(':');
    let first = number(parts.next()?)?;
    let second = parts.next()?;
    let (third, fourth) = (parts.next(), parts.next());
    if parts.next().is_some() {
        return None;
    }
    let (hours, minutes, seconds) = match third {
        Some(third) => (first, number(second)?, third),
        // Minutes and seconds if there is a fraction, else hours and minutes.
        None if second.contains(['.', ',']) => (0, first, second),
        None => (first, number(second)?, "0"),
    };
    let (seconds, fraction) = match fourth {
        Some(thousandths) => (seconds, thousandths),
        None => seconds.split_once(['.', ',']).unwrap_or((seconds, "")),
    };
    let hours = match half {
        Some(noon) => hours % 12 + noon,
        None => hours,
    };
    let seconds = number(seconds)?;
    let fits = hours < 48 && minutes < 60 && seconds < 61 && fraction.len() < 13;
    fits.then_some((hours * 3600 + minutes * 60 + seconds - zone_s, fraction))
}

/// A time without its zone, and what the zone is ahead, s.
fn without_zone(text: &str) -> (&str, i128) {
    if let Some(text) = text.strip_suffix('Z').or_else(|| text.strip_suffix("UTC")) {
        return (text.trim_end(), 0);
    }
    let ahead = || {
        let at = text.rfind(['+', '-'])?;
        let zone = text.get(at + 1..)?.replace(':', "");
        let (hours, minutes) = (number(zone.get(..2)?)?, number(zone.get(2..)?).unwrap_or(0));
        let sign = if text.get(at..)?.starts_with('-') {
            -1
        } else {
            1
        };
        Some((
            text.get(..at)?.trim_end(),
            sign * (hours * 3600 + minutes * 60),
        ))
    };
    ahead().unwrap_or((text, 0))
}

/// Days since the first of January 1970; the year stands first or last.
fn days(date: &str) -> Option<i128> {
    let parts: Vec<&str> = date.split(['-', '/', '.']).collect();
    let [first, second, third] = parts.as_slice() else {
        return None;
    };
    let (a, b, c) = (number(first)?, number(second)?, number(third)?);
    let (year, month, day) = match (first.len(), third.len()) {
        (4, _) => (a, b, c),
        (_, 4 | 2) if date.contains('/') && a <= 12 => (c, a, b),
        (_, 4 | 2) => (c, b, a),
        _ => return None,
    };
    let year = if year < 100 { year + 2000 } else { year };
    let fits = (1..=12).contains(&month) && (1..=31).contains(&day);
    fits.then(|| days_from_civil(year, month, day))
}

/// Of the Gregorian calendar, in which a year begins in March so that the odd day comes last.
fn days_from_civil(year: i128, month: i128, day: i128) -> i128 {
    let year = if month <= 2 { year - 1 } else { year };
    let day_of_year = (153 * ((month + 9) % 12) + 2) / 5 + day - 1;
    365 * year + year.div_euclid(4) - year.div_euclid(100) + year.div_euclid(400) + day_of_year
        - 719_468
}

fn number(text: &str) -> Option<i128> {
    let digits = !text.is_empty() && text.len() < 5 && text.bytes().all(|b| b.is_ascii_digit());
    digits.then(|| text.parse().ok()).flatten()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stamps_are_subtracted_to_their_last_digit() {
        let exact = |text: &str| Exact::parse(text, Decimal::Point).unwrap();
        let origin = exact("1700000000.25").whole(1);
        assert_eq!(exact("1700000000.251001").minus(origin), 0.251001);
        assert_eq!(exact("1.700000000251001E+09").minus(origin), 0.251001);
        let ns = exact("1305043218123456789");
        assert_eq!(ns.minus(ns.whole(1_000_000_000)), 123_456_789.0);
        assert_eq!(exact("-3.25").whole(1).value(), -4.0);
        for text in ["", ".", "1.2.3", "1,5", "nan", "0x10", "1e400"] {
            assert_eq!(Exact::parse(text, Decimal::Point), None, "{text}");
        }
    }

    #[test]
    fn dates_and_times_of_day_are_read_in_the_forms_that_loggers_write() {
        let second = 1_714_990_272.0;
        for (text, expected, dated) in [
            ("2024-05-06 10:11:12.125", second + 0.125, true),
            ("2024-05-06T10:11:12.125Z", second + 0.125, true),
            ("2024-05-06T12:11:12,125+02:00", second + 0.125, true),
            ("06.05.2024 10:11:12,125", second + 0.125, true),
            ("05/06/2024 10:11:12.125 AM", second + 0.125, true),
            ("5/6/24 10:11:12", second, true),
            ("10:11:12.5", 36_672.5, false),
            ("10:11:12:500", 36_672.5, false),
            ("11:12.5", 672.5, false),
            ("10:11:12 PM", 79_872.0, false),
        ] {
            let (exact, has_date) = calendar(text).unwrap();
            assert_eq!((exact.value(), has_date), (expected, dated), "{text}");
        }
        for text in [
            "",
            "a:b",
            "12",
            "2024-05-06",
            "10:75:12",
            "x 10:11:12",
            "1:2:3:4:5",
        ] {
            assert!(calendar(text).is_none(), "{text}");
        }
    }
}
