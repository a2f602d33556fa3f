//! This file finds out how a text file is laid out, from its first lines.

use std::path::Path;

use super::columns::{TimeColumn, has_time};
use super::dialect::{Decimal, Dialect, Encoding, Hints, Separator};
use super::lines::{Lines, Splitter};
use super::units_row::{is_units_row, symbol};

/// Lines that are looked at.
const PROBED_LINES: usize = 400;
/// The tag of ControlDesk's first data row; the rows below have nothing in its place.
pub(super) const TAG: &str = "trace_values";
/// Names over columns that a logger leaves empty: LabVIEW's remarks, Rigol's time base.
const EMPTY_COLUMNS: [&str; 4] = ["", "Comment", "Start", "Increment"];

/// Where the table of a text file is, and what stands over it.
pub(super) struct Layout {
    pub(super) dialect: Dialect,
    /// What stands over the columns.
    pub(super) names: Vec<Name>,
    /// The line with the names, counted from 1.
    pub(super) names_line: usize,
    /// The last line above the samples.
    pub(super) head_end: usize,
    /// The time base of an oscilloscope that counts samples: start and step.
    pub(super) sequence: Option<(f64, f64)>,
}

/// What stands over a column.
pub(super) struct Name {
    pub(super) text: String,
    /// The cell of a units row below it.
    pub(super) unit: String,
    /// Whether the column holds samples.
    pub(super) kept: bool,
}

/// The first lines of a file in cells.
struct Table {
    separator: Separator,
    decimal: Decimal,
    rows: Vec<(usize, Vec<String>)>,
    /// The longest run of rows that hold numbers: the first and the one after the last.
    run: (usize, usize),
}

impl Layout {
    /// The layout of a file that begins like `start`, or `None` when no line of it holds anything.
    pub(super) fn find(
        start: &[u8],
        encoding: Encoding,
        file: &Path,
        hints: &Hints,
        time: Option<&TimeColumn>,
    ) -> Option<Layout> {
        let lines = first_lines(start, file);
        let separators = Separator::ALL.into_iter();
        let separators = separators.filter(|s| hints.separator.is_none_or(|hint| hint == *s));
        let tables: Vec<Table> = separators
            .map(|separator| Table::new(separator, hints.decimal, &lines))
            .collect();
        let mut best = tables.iter().max_by_key(|table| {
            let likelier = Separator::ALL
                .iter()
                .rev()
                .position(|s| *s == table.separator);
            (table.run.1 - table.run.0, likelier)
        })?;
        let mut head = best.head(hints.header_lines, time);
        if head.is_none() && hints.header_lines.is_none() {
            // Faulty rows may hide the table; a first line that names the time is a header all the same.
            let named = |table: &&Table| table.cells(0).is_some_and(|cells| has_time(cells, time));
            best = tables.iter().find(named).unwrap_or(best);
            let names = best.likely_names(time);
            let units_row = best.cells(names + 1).is_some_and(is_units_row);
            head = Some((names, units_row));
        }
        let (names, units_row) = head?;
        best.layout(names, units_row, encoding)
    }
}

/// The lines that hold something, with their numbers, up to the first that cannot be read.
fn first_lines(start: &[u8], file: &Path) -> Vec<(usize, String)> {
    let mut source = Lines::new(start, file);
    let mut lines = Vec::new();
    while lines.len() < PROBED_LINES {
        let Ok(Some(text)) = source.next_line() else {
            break;
        };
        let text = text.to_owned();
        lines.push((source.number(), text));
    }
    lines
}

impl Table {
    fn new(separator: Separator, decimal: Option<Decimal>, lines: &[(usize, String)]) -> Table {
        let mut splitter = Splitter::new(separator);
        let rows = lines.iter().map(|(number, line)| {
            let cells = splitter.cells(line);
            (*number, cells.map(|cell| cell.trim().to_owned()).collect())
        });
        let rows: Vec<(usize, Vec<String>)> = rows.collect();
        let decimals = Decimal::ALL.into_iter();
        let decimals = decimals.filter(|d| decimal.is_none_or(|hint| hint == *d));
        let runs = decimals.map(|decimal| (longest_run(&rows, decimal), decimal));
        // The later of two equal ones would win, so the likelier comes last.
        let best = runs.rev().max_by_key(|((start, end), _)| end - start);
        let (run, decimal) = best.unwrap_or(((0, 0), Decimal::Point));
        Table {
            separator,
            decimal,
            rows,
            run,
        }
    }

    fn cells(&self, row: usize) -> Option<&[String]> {
        self.rows.get(row).map(|(_, cells)| cells.as_slice())
    }

    fn run_rows(&self) -> impl Iterator<Item = &[String]> {
        (self.run.0..self.run.1).filter_map(|row| self.cells(row))
    }

    /// The row with the names and whether a units row follows it, where the table leaves no doubt.
    fn head(
        &self,
        header_lines: Option<usize>,
        time: Option<&TimeColumn>,
    ) -> Option<(usize, bool)> {
        if let Some(lines) = header_lines {
            let row = self.rows.iter().position(|(number, _)| *number > lines)?;
            let below = self.cells(row + 1).is_some_and(is_units_row);
            return Some((row, below));
        }
        if let Some(row) = self.tagged("trace_names") {
            return Some((row, false));
        }
        let above = self.run.0.checked_sub(1).filter(|_| self.run.1 > 0)?;
        let cells = self.cells(above)?;
        if has_time(cells, time) {
            return Some((above, false));
        }
        let names = above.checked_sub(1)?;
        let same = self.cells(names)?.len() == cells.len();
        (same && is_units_row(cells)).then_some((names, true))
    }

    /// The row with the names where no time is named: the first line, or the one above the samples.
    fn likely_names(&self, time: Option<&TimeColumn>) -> usize {
        let above = self.run.0.saturating_sub(1);
        let (Some(first), Some(row)) = (self.cells(0), self.cells(self.run.0)) else {
            return 0;
        };
        if has_time(first, time) || first.len() == row.len() {
            0
        } else {
            above
        }
    }

    /// The row that ControlDesk marks in its first cell, above the samples.
    fn tagged(&self, tag: &str) -> Option<usize> {
        let is_tagged = self.cells(self.run.0)?.first()? == TAG;
        let mut above = (0..self.run.0).rev();
        above.find(|row| {
            let first = self.cells(*row).and_then(<[String]>::first);
            is_tagged && first.is_some_and(|cell| cell.starts_with(tag))
        })
    }

    fn layout(&self, names_row: usize, units_row: bool, encoding: Encoding) -> Option<Layout> {
        let (names_line, cells) = self.rows.get(names_row)?;
        let tagged = self.tagged("trace_names") == Some(names_row);
        let units = match (units_row, tagged) {
            (true, _) => self.rows.get(names_row + 1),
            (false, true) => self.tagged("unit").and_then(|row| self.rows.get(row)),
            (false, false) => None,
        };
        let unit = |column: usize| units.and_then(|(_, cells)| cells.get(column));
        let names = cells.iter().enumerate().map(|(column, text)| Name {
            text: match text.as_str() {
                "" if tagged && column == 1 => "time".to_owned(),
                text => text.to_owned(),
            },
            unit: unit(column).map_or(String::new(), |unit| symbol(unit)),
            kept: !(tagged && column == 0),
        });
        let mut names: Vec<Name> = names.collect();
        self.leave_out_empty(&mut names);
        let sequence = self.sequence(&names, units.map(|(_, cells)| cells.as_slice()));
        if sequence.is_some() {
            for name in &mut names {
                name.kept &= !EMPTY_COLUMNS.contains(&name.text.as_str());
                name.unit = name.unit.replace("Sequence", "s");
            }
        }
        let head_end = match (tagged, units) {
            (true, _) => self.rows.get(self.run.0.checked_sub(1)?)?.0,
            (false, Some((number, _))) => *number,
            (false, None) => *names_line,
        };
        Some(Layout {
            dialect: Dialect {
                separator: self.separator,
                decimal: self.decimal,
                header_lines: names_line - 1,
                units_row: units.is_some(),
                encoding,
            },
            names,
            names_line: *names_line,
            head_end,
            sequence,
        })
    }

    /// Leaves out columns at the end that have neither name nor samples, as trailing separators make them.
    fn leave_out_empty(&self, names: &mut Vec<Name>) {
        let Some(width) = self
            .cells(self.run.0)
            .filter(|_| self.run.1 > 0)
            .map(<[String]>::len)
        else {
            return;
        };
        let beyond = names.get(width..).unwrap_or_default();
        if beyond
            .iter()
            .all(|name| EMPTY_COLUMNS.contains(&name.text.as_str()))
        {
            names.truncate(width);
        }
        let filled = self
            .run_rows()
            .filter_map(|cells| cells.iter().rposition(|cell| !cell.is_empty()));
        let filled = filled.max().map_or(0, |last| last + 1);
        if filled <= names.len() {
            while names.len() < width {
                names.push(Name {
                    text: String::new(),
                    unit: String::new(),
                    kept: false,
                });
            }
        }
        let empty = names.iter_mut().skip(filled);
        for name in empty.filter(|name| EMPTY_COLUMNS.contains(&name.text.as_str())) {
            name.kept = false;
        }
    }

    /// Start and step of a Rigol's time, which counts samples: they stand in the units row.
    fn sequence(&self, names: &[Name], units: Option<&[String]>) -> Option<(f64, f64)> {
        let units = units.filter(|cells| cells.first().is_some_and(|c| c == "Sequence"))?;
        let (_, head) = self.rows.iter().find(|(_, cells)| {
            cells.first().map(String::as_str) == names.first().map(|name| name.text.as_str())
        })?;
        let number = |name: &str| {
            let column = head.iter().position(|text| text == name)?;
            self.decimal.number(units.get(column)?)
        };
        Some((number("Start")?, number("Increment")?))
    }
}

/// The longest run of rows with equally many cells, two at least, that hold numbers.
fn longest_run(rows: &[(usize, Vec<String>)], decimal: Decimal) -> (usize, usize) {
    let mut best = (0, 0);
    let mut run: Option<(usize, usize)> = None;
    for (row, (_, cells)) in rows.iter().enumerate() {
        let numbers = cells.len() > 1 && holds_numbers(cells, decimal);
        run = match run {
            _ if !numbers => None,
            Some((start, width)) if width == cells.len() => Some((start, width)),
            _ => Some((row, cells.len())),
        };
        if let Some((start, _)) = run
            && row + 1 - start > best.1 - best.0
        {
            best = (start, row + 1);
        }
    }
    best
}

fn holds_numbers(cells: &[String], decimal: Decimal) -> bool {
    let tagged = cells.first().is_some_and(|cell| cell == TAG);
    let mut cells = cells.iter().skip(usize::from(tagged));
    let mut filled = cells.by_ref().filter(|cell| !cell.is_empty()).peekable();
    filled.peek().is_some() && filled.all(|cell| decimal.number(cell).is_some())
}
