//! This file says how a text file is written down: separator, decimal mark, header, encoding.

use std::fmt;

use super::stamp::calendar;

/// What stands between two cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Separator {
    /// `,`
    Comma,
    /// `;`
    Semicolon,
    /// A tabulator.
    Tab,
    /// One or more blanks.
    Blank,
}

impl Separator {
    /// All of them, the likeliest first.
    pub const ALL: [Separator; 4] = [
        Separator::Comma,
        Separator::Semicolon,
        Separator::Tab,
        Separator::Blank,
    ];

    /// The name in files, on the command line and in reports.
    pub const fn name(self) -> &'static str {
        match self {
            Separator::Comma => ",",
            Separator::Semicolon => ";",
            Separator::Tab => "tab",
            Separator::Blank => "blank",
        }
    }

    pub(super) const fn byte(self) -> u8 {
        match self {
            Separator::Comma => b',',
            Separator::Semicolon => b';',
            Separator::Tab => b'\t',
            Separator::Blank => b' ',
        }
    }
}

/// What stands before the fraction of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Decimal {
    /// `.`
    Point,
    /// `,`
    Comma,
}

impl Decimal {
    /// Both of them, the likelier first.
    pub const ALL: [Decimal; 2] = [Decimal::Point, Decimal::Comma];

    /// The name in files, on the command line and in reports.
    pub const fn name(self) -> &'static str {
        match self {
            Decimal::Point => ".",
            Decimal::Comma => ",",
        }
    }

    /// What is in a cell.
    pub(super) fn kind(self, cell: &str) -> Kind {
        if is_missing(cell) {
            Kind::Missing
        } else if self.number(cell).is_some() {
            Kind::Number
        } else if calendar(cell).is_some() {
            Kind::Stamp
        } else {
            Kind::Text
        }
    }

    /// The finite number in a cell, or `None`.
    pub(super) fn number(self, cell: &str) -> Option<f64> {
        let finite = |text: &str| text.parse::<f64>().ok().filter(|x| x.is_finite());
        match self {
            Decimal::Point => finite(cell),
            Decimal::Comma if cell.contains('.') => None,
            Decimal::Comma => match cell.split_once(',') {
                None => finite(cell),
                Some((whole, fraction)) => {
                    let digit = fraction.starts_with(|c: char| c.is_ascii_digit());
                    finite(&format!("{whole}.{fraction}")).filter(|_| digit)
                }
            },
        }
    }
}

/// What a cell holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// Nothing, or a word that says so.
    Missing,
    /// A finite number.
    Number,
    /// A date with a time, or a time of day.
    Stamp,
    /// Anything else.
    Text,
}

/// What stands where a sample is missing, in lower case.
const MISSING: [&str; 14] = [
    "",
    "nan",
    "-nan",
    "+nan",
    "na",
    "n/a",
    "#n/a",
    "null",
    "none",
    "nil",
    "-nan(ind)",
    "1.#qnan",
    "-1.#ind",
    "--",
];

/// Whether a cell says that its sample is missing.
pub(super) fn is_missing(cell: &str) -> bool {
    cell.len() <= 9 && MISSING.iter().any(|word| cell.eq_ignore_ascii_case(word))
}

/// How characters are kept as bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Encoding {
    /// UTF-8, or plain ASCII.
    Utf8,
    /// One byte a letter, as Western Europe wrote it before UTF-8 (Latin-1).
    Latin1,
    /// UTF-16, the low byte first.
    Utf16Le,
    /// UTF-16, the high byte first.
    Utf16Be,
}

impl Encoding {
    /// The name in reports.
    pub const fn name(self) -> &'static str {
        match self {
            Encoding::Utf8 => "UTF-8",
            Encoding::Latin1 => "Latin-1",
            Encoding::Utf16Le => "UTF-16 (little-endian)",
            Encoding::Utf16Be => "UTF-16 (big-endian)",
        }
    }
}

/// How a text file was read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Dialect {
    /// What stands between two cells.
    pub separator: Separator,
    /// What stands before the fraction of a number.
    pub decimal: Decimal,
    /// Lines before the line with the names, comments and blank lines among them.
    pub header_lines: usize,
    /// Whether a row of units stands below the names.
    pub units_row: bool,
    /// How characters are kept as bytes.
    pub encoding: Encoding,
}

impl fmt::Display for Dialect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let separator = match self.separator {
            separator @ (Separator::Comma | Separator::Semicolon) => {
                format!("'{}'", separator.name())
            }
            separator => separator.name().to_owned(),
        };
        let lines = match self.header_lines {
            1 => "1 header line".to_owned(),
            count => format!("{count} header lines"),
        };
        write!(
            f,
            "separator {separator}, decimal '{}', {lines}{}, {}",
            self.decimal.name(),
            if self.units_row { ", units row" } else { "" },
            self.encoding.name()
        )
    }
}

/// What the caller knows of a dialect; the rest is found out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Hints {
    /// What stands between two cells.
    pub separator: Option<Separator>,
    /// What stands before the fraction of a number.
    pub decimal: Option<Decimal>,
    /// Lines before the line with the names.
    pub header_lines: Option<usize>,
}

impl Hints {
    /// These hints, and those of another where these are silent.
    pub fn or(self, other: Hints) -> Hints {
        Hints {
            separator: self.separator.or(other.separator),
            decimal: self.decimal.or(other.decimal),
            header_lines: self.header_lines.or(other.header_lines),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_has_one_decimal_mark_and_a_digit_after_the_comma() {
        for (decimal, cell, expected) in [
            (Decimal::Point, "-1.25e-3", Some(-1.25e-3)),
            (Decimal::Point, "1,25", None),
            (Decimal::Comma, "-1,25E-03", Some(-1.25e-3)),
            (Decimal::Comma, ",5", Some(0.5)),
            (Decimal::Comma, "17", Some(17.0)),
            (Decimal::Comma, "1.5", None),
            (Decimal::Comma, "1.234,5", None),
            (Decimal::Comma, "1,", None),
            (Decimal::Comma, "1,2,3", None),
            (Decimal::Comma, "1,inf", None),
            (Decimal::Point, "inf", None),
        ] {
            assert_eq!(decimal.number(cell), expected, "{cell}");
        }
    }
}
