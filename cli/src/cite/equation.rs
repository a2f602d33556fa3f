//! This file reads the numbered equations and sections of the thesis, and says which are next to a number that there is none of.

use super::repository::Repository;
use crate::outcome::Failure;

/// Where the equations stand.
pub const FILE: &str = "spec/thesis/equations.md";
/// Where the sections stand.
const SECTIONS: &str = "spec/thesis/sections.md";
/// The sign before the number of a section.
pub const SECTION: char = '§';

/// How many are offered for a number that there is none of.
const OFFERED: usize = 3;

/// One row of a table: an equation, or a section.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Equation {
    /// Its number, such as `5.36`, or `§2.2.1`.
    pub number: String,
    /// What it says, or its title.
    pub says: String,
    /// Its symbols, or what a section is cited for.
    pub symbols: String,
    /// The file with the table.
    pub file: &'static str,
    /// The line of the file, from one.
    pub line: usize,
}

impl Equation {
    /// The number as it is printed.
    pub fn in_brackets(&self) -> String {
        match self.is_section() {
            true => self.number.clone(),
            false => format!("({})", self.number),
        }
    }

    /// Whether it is a section.
    pub fn is_section(&self) -> bool {
        self.number.starts_with(SECTION)
    }
}

/// Every equation, in the order of the file, and every section after them.
///
/// # Errors
/// A file cannot be read.
pub fn all(repository: &Repository) -> Result<Vec<Equation>, Failure> {
    let mut all = Vec::new();
    for (file, row_of) in [
        (FILE, equation as fn(&str, usize) -> Option<Equation>),
        (SECTIONS, section),
    ] {
        let table = repository.read(file)?;
        let rows = table.lines().enumerate();
        all.extend(rows.filter_map(|(index, row)| row_of(row, index + 1)));
    }
    Ok(all)
}

/// The section of a row.
fn section(row: &str, line: usize) -> Option<Equation> {
    let (number, rest) = row.strip_prefix("| ")?.split_once(" |")?;
    let (says, symbols) = rest.trim_end().strip_suffix('|')?.split_once('|')?;
    number.starts_with(SECTION).then(|| Equation {
        number: number.to_owned(),
        says: says.trim().to_owned(),
        symbols: symbols.trim().to_owned(),
        file: SECTIONS,
        line,
    })
}

/// The equation of a row; a bar inside a cell is written `\|`.
fn equation(row: &str, line: usize) -> Option<Equation> {
    let (number, rest) = row.strip_prefix("| (")?.split_once(") |")?;
    let rest = rest.trim_end().strip_suffix('|')?.replace("\\|", "\u{1}");
    let (says, symbols) = rest.rsplit_once('|')?;
    let cell = |text: &str| text.replace('\u{1}', "|").trim().to_owned();
    Some(Equation {
        number: number.to_owned(),
        says: cell(says),
        symbols: cell(symbols),
        file: FILE,
        line,
    })
}

/// The equation of a number, with or without brackets, or the section after its sign or word; else a message with the nearest
/// equations.
pub fn find(equations: &[Equation], number: &str) -> Result<Equation, String> {
    let wanted = number.trim().trim_start_matches('(').trim_end_matches(')');
    let section = wanted.strip_prefix("section ");
    let section = section.map(|number| format!("{SECTION}{}", number.trim()));
    let wanted = section.as_deref().unwrap_or(wanted);
    let found = equations
        .iter()
        .find(|equation| equation.number.eq_ignore_ascii_case(wanted));
    found.cloned().ok_or_else(|| {
        if wanted.starts_with(SECTION) {
            return format!("the thesis has no section {wanted}; `{SECTIONS}` lists them");
        }
        let nearest = nearest(equations, wanted);
        let advice = match nearest.as_slice() {
            [] => "give a chapter and a number, such as 5.36 or A.7".to_owned(),
            nearest => format!("the nearest are {}", nearest.join(", ")),
        };
        format!("the thesis has no equation ({wanted}); {advice}")
    })
}

/// The numbers next to one that there is none of, nearest first.
fn nearest(equations: &[Equation], wanted: &str) -> Vec<String> {
    let Some(wanted) = place(wanted) else {
        return Vec::new();
    };
    let mut near: Vec<(u64, &str)> = equations
        .iter()
        .filter_map(|equation| {
            let distance = place(&equation.number)?.abs_diff(wanted);
            Some((distance, equation.number.as_str()))
        })
        .collect();
    near.sort_by_key(|(distance, _)| *distance);
    let near = near.into_iter().take(OFFERED);
    near.map(|(_, number)| number.to_owned()).collect()
}

/// Where a number stands in the thesis: chapters, the appendices after them, are a thousand places apart; a letter behind
/// the number is left out.
fn place(number: &str) -> Option<u64> {
    let (chapter, place) = number.split_once('.')?;
    let chapter = match chapter.as_bytes() {
        [letter] if letter.is_ascii_alphabetic() => {
            u64::from(letter.to_ascii_uppercase() - b'A') + 10
        }
        _ => u64::from(chapter.parse::<u32>().ok()?),
    };
    let place = place.trim_end_matches(|c: char| c.is_ascii_alphabetic());
    Some(1000 * chapter + u64::from(place.parse::<u32>().ok()?))
}

#[cfg(test)]
mod tests {
    use super::*;

    const ROWS: &str = "| number | says | symbols |\n|---|---|---|\n\
        | (6.13) | law: F = K·\\|v\\| | F force, N |\n| (6.16a) | way | – |\n| (6.16b) | force | – |\n| (A.7) | T | J |\n";

    fn rows() -> Vec<Equation> {
        let rows = ROWS.lines().enumerate();
        rows.filter_map(|(index, row)| equation(row, index + 1))
            .collect()
    }

    #[test]
    fn a_row_is_read_with_the_bars_inside_its_cells() {
        let equations = rows();
        assert_eq!(equations.len(), 4);
        assert_eq!(equations[0].says, "law: F = K·|v|");
        assert_eq!(
            (equations[0].symbols.as_str(), equations[0].line),
            ("F force, N", 3)
        );
        assert_eq!(find(&equations, "(a.7)").unwrap(), equations[3]);
    }

    #[test]
    fn a_section_is_found_by_its_sign_and_by_its_word() {
        let row = "| §2.2.1 | Existing Designs | what each is |";
        let sections = [section(row, 9).unwrap()];
        assert_eq!(sections[0].says, "Existing Designs");
        assert_eq!(sections[0].in_brackets(), "§2.2.1");
        for name in ["§2.2.1", "section 2.2.1"] {
            assert_eq!(find(&sections, name).unwrap(), sections[0]);
        }
        let message = find(&sections, "§9.9").unwrap_err();
        assert!(
            message.starts_with("the thesis has no section §9.9"),
            "{message}"
        );
        assert!(section("|---|---|---|", 7).is_none() && section("| (2.1) | a | b |", 7).is_none());
    }

    #[test]
    fn a_number_without_an_equation_is_answered_with_its_neighbours() {
        let message = find(&rows(), "6.16").unwrap_err();
        assert_eq!(
            message,
            "the thesis has no equation (6.16); the nearest are 6.16a, 6.16b, 6.13"
        );
        let message = find(&rows(), "9.1").unwrap_err();
        assert!(message.ends_with("A.7, 6.16a, 6.16b"), "{message}");
        for nowhere in ["five", "", "6.x", "ä.1", "6.99999999999"] {
            let message = find(&rows(), nowhere).unwrap_err();
            assert!(message.ends_with("such as 5.36 or A.7"), "{message}");
        }
    }
}
