//! This file reads the row of units that some loggers write below the names.

use rigproof_spec::units::Unit;

/// Units that oscilloscopes and LabVIEW write out, and their symbols.
const WORDS: [(&str, &str); 9] = [
    ("second", "s"),
    ("volt", "V"),
    ("amp", "A"),
    ("ampere", "A"),
    ("newton", "N"),
    ("meter", "m"),
    ("metre", "m"),
    ("degree", "deg"),
    ("radian", "rad"),
];

/// Whether every cell that holds something holds a unit.
pub(super) fn is_units_row(cells: &[String]) -> bool {
    let counts_samples = cells.first().is_some_and(|cell| cell == "Sequence");
    let mut filled = cells.iter().filter(|cell| !cell.is_empty()).peekable();
    filled.peek().is_some()
        && filled.all(|cell| {
            let known = Unit::parse(&symbol(cell)).is_some() && cell.parse::<f64>().is_err();
            known || counts_samples
        })
}

/// The symbol of a unit that may stand in brackets or be written out; else the cell as it is.
pub(super) fn symbol(cell: &str) -> String {
    let inside = |open, close| cell.strip_prefix(open)?.strip_suffix(close);
    let unit = inside('(', ')')
        .or_else(|| inside('[', ']'))
        .unwrap_or(cell)
        .trim();
    let word = unit.to_lowercase();
    let word = word.strip_suffix('s').unwrap_or(&word);
    let written_out = WORDS.iter().find(|(name, _)| *name == word);
    written_out.map_or(unit, |(_, symbol)| symbol).to_owned()
}
