//! This file finds out how a text file is laid out, from its first lines.

use std::path::Path;

use super::columns::{TimeColumn, has_time};
use super::dialect::{Dialect, Encoding, Hints, Kind, Separator};
use super::lines::{Lines, Splitter};
use super::logger::{self, TimeBase};
use super::table::{Table, split_to_width};
use super::units_row::{is_units_row, symbol};

/// Lines that are looked at.
const PROBED_LINES: usize = 400;
/// Comments above the samples that may name the columns.
const PROBED_COMMENTS: usize = 3;
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
    /// A time that is no column of stamps.
    pub(super) time_base: Option<TimeBase>,
    /// Whether names stand over the columns.
    pub(super) has_header: bool,
    /// Whether it is a LabVIEW measurement, whose heads may stand between the rows too.
    pub(super) is_labview: bool,
}

/// What stands over a column, and what is in it as far as its first lines tell.
pub(super) struct Name {
    /// As printed, with a unit if there is one.
    pub(super) text: String,
    /// The cell of a units row below it.
    pub(super) unit: String,
    /// Whether the column may hold samples.
    pub(super) kept: bool,
    pub(super) kind: Kind,
    /// Whether its numbers or stamps never fall, and not all are the same.
    pub(super) grows: bool,
    /// Whether it numbers the rows.
    pub(super) counts: bool,
}

/// The first lines of a file.
struct Probe {
    rows: Vec<(usize, String)>,
    comments: Vec<(usize, String)>,
    has_latin: bool,
    /// Whether the separator was stated: then a head is not split by another one.
    is_stated: bool,
}

/// The line with the names.
struct Head {
    line: usize,
    cells: Vec<String>,
    units: Option<(usize, Vec<String>)>,
}

impl Head {
    fn new(line: usize, cells: Vec<String>) -> Head {
        let units = None;
        Head { line, cells, units }
    }
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
        let mut probe = Probe::new(start, file);
        probe.is_stated = hints.separator.is_some();
        let encoding = match probe.has_latin {
            true => Encoding::Latin1,
            false => encoding,
        };
        let separators = Separator::ALL.into_iter();
        let separators = separators.filter(|s| hints.separator.is_none_or(|hint| hint == *s));
        let tables: Vec<Table> = separators
            .map(|separator| Table::new(separator, hints.decimal, &probe.rows))
            .collect();
        let best = tables.iter().rev();
        let mut best = best.max_by(|a, b| a.score.total_cmp(&b.score))?;
        let mut head = head(best, &probe, hints.header_lines, time);
        if head.is_none() && hints.header_lines.is_none() {
            if best.headless() {
                return best_layout(best, None, encoding);
            }
            // Faulty rows may hide the table; a first line that names the time is a header all the same.
            let named = |table: &&Table| table.cells(0).is_some_and(|cells| has_time(cells, time));
            best = tables.iter().find(named).unwrap_or(best);
            head = likely_head(best, time);
        }
        best_layout(best, Some(head?), encoding)
    }
}

impl Probe {
    /// The lines that hold something, with their numbers, up to the first that cannot be read.
    fn new(start: &[u8], file: &Path) -> Probe {
        let mut source = Lines::new(start, file);
        let (mut rows, mut comments) = (Vec::new(), Vec::new());
        while rows.len() < PROBED_LINES {
            let (text, is_comment) = match source.next_line_or_comment() {
                Ok(Some((text, is_comment))) => (text.to_owned(), is_comment),
                Ok(None) | Err(_) => break,
            };
            let lines = if is_comment { &mut comments } else { &mut rows };
            lines.push((source.number(), text));
        }
        Probe {
            rows,
            comments,
            has_latin: source.has_latin(),
            is_stated: false,
        }
    }

    /// The names in a comment right above the samples, as numpy and many loggers write them.
    fn commented(&self, table: &Table, time: Option<&TimeColumn>) -> Option<Head> {
        let first = table.line(table.run.0)?;
        let before = table.run.0.checked_sub(1).and_then(|row| table.line(row));
        let above = self.comments.iter().rev();
        let above = above.filter(|(line, _)| *line < first && before.is_none_or(|b| *line > b));
        let mut found = above.take(PROBED_COMMENTS).filter_map(|(line, text)| {
            let cells = split_to_width(text, table.separator, table.width()?)?;
            let is_split_alike = table.separator != Separator::Blank
                && Splitter::new(table.separator).cells(text).count() == cells.len();
            let all_names = || {
                cells
                    .iter()
                    .all(|cell| table.decimal.kind(cell) == Kind::Text)
            };
            let sure = has_time(&cells, time) || is_split_alike && all_names();
            sure.then(|| Head::new(*line, cells))
        });
        found.next()
    }

    /// The first line behind so many others.
    fn behind(&self, table: &Table, lines: usize) -> Option<Head> {
        let row = self.rows.iter().position(|(number, _)| *number > lines)?;
        let line = table.line(row)?;
        let comment = self
            .comments
            .iter()
            .find(|(number, _)| (lines + 1..line).contains(number));
        let commented = comment.and_then(|(number, text)| {
            let cells = split_to_width(text, table.separator, table.width()?)?;
            Some(Head::new(*number, cells))
        });
        commented.or_else(|| Some(with_units(table, row, table.cells(row)?.to_vec())))
    }
}

/// A head with the row of units below it, if there is one.
fn with_units(table: &Table, row: usize, cells: Vec<String>) -> Head {
    let units = table.cells(row + 1).filter(|cells| is_units_row(cells));
    let units = units.and_then(|units| Some((table.line(row + 1)?, units.to_vec())));
    Head {
        units,
        ..Head::new(table.line(row).unwrap_or(0), cells)
    }
}

/// The names and the row of units below them, where the table leaves no doubt.
fn head(
    table: &Table,
    probe: &Probe,
    header_lines: Option<usize>,
    time: Option<&TimeColumn>,
) -> Option<Head> {
    if let Some(lines) = header_lines {
        return probe.behind(table, lines);
    }
    if let Some(row) = table.tagged("trace_names") {
        let units = table.tagged("unit");
        let units = units.and_then(|row| Some((table.line(row)?, table.cells(row)?.to_vec())));
        let head = Head::new(table.line(row)?, table.cells(row)?.to_vec());
        return Some(Head { units, ..head });
    }
    let width = table.width()?;
    let above = table.run.0.checked_sub(1);
    if let Some(row) = above {
        let cells = table.cells(row)?;
        if has_time(cells, time) || logger::is_labview(table) {
            // Names may hold blanks.
            let fits = cells.len() == width || table.separator != Separator::Blank;
            let text = probe.rows.get(row).filter(|_| !fits);
            let fitted = text.and_then(|(_, text)| split_to_width(text, table.separator, width));
            let cells = fitted.unwrap_or_else(|| cells.to_vec());
            return Some(Head::new(table.line(row)?, cells));
        }
        let names = row.checked_sub(1);
        if let Some(names) = names
            && table.cells(names)?.len() == cells.len()
            && is_units_row(cells)
        {
            return Some(with_units(table, names, table.cells(names)?.to_vec()));
        }
    }
    if let Some(head) = probe.commented(table, time) {
        return Some(head);
    }
    // A header that is separated otherwise than the rows, or names no time.
    let row = above?;
    if probe.is_stated && table.cells(row)?.len() != width {
        return None;
    }
    let text = &probe.rows.get(row)?.1;
    let cells = split_to_width(text, table.separator, width)?;
    let kinds = |cells: &[String]| -> Vec<Kind> {
        cells.iter().map(|cell| table.decimal.kind(cell)).collect()
    };
    let names = |cells: &[String]| {
        let kinds = kinds(cells);
        let holds = |kind: Kind| kinds.contains(&kind);
        holds(Kind::Text) && !holds(Kind::Number) && !holds(Kind::Stamp)
    };
    let sure = has_time(&cells, time) || table.cells(row)?.len() == width && names(&cells);
    sure.then(|| Head::new(table.line(row).unwrap_or(0), cells))
}

/// The names where nothing is sure: the nearest row above the samples that names the time, the first line, or the one above
/// the samples.
fn likely_head(table: &Table, time: Option<&TimeColumn>) -> Option<Head> {
    let above = (0..table.run.0).rev();
    let named = above
        .clone()
        .find(|row| table.cells(*row).is_some_and(|cells| has_time(cells, time)));
    let (first, row) = (table.cells(0), table.cells(table.run.0));
    let widths = first.zip(row);
    let is_first =
        widths.is_none_or(|(first, row)| has_time(first, time) || first.len() == row.len());
    let row = match named {
        Some(row) => row,
        None if is_first => 0,
        None => table.run.0.saturating_sub(1),
    };
    Some(with_units(table, row, table.cells(row)?.to_vec()))
}

/// The layout of a table below its head, or without one.
fn best_layout(table: &Table, head: Option<Head>, encoding: Encoding) -> Option<Layout> {
    let has_header = head.is_some();
    let head = match head {
        Some(head) => head,
        None => {
            let names = 1..=table.width()?;
            Head::new(0, names.map(|k| format!("column {k}")).collect())
        }
    };
    let tagged = table.tagged("trace_names").and_then(|row| table.line(row)) == Some(head.line);
    let units = head.units.as_ref();
    let unit = |column: usize| units.and_then(|(_, cells)| cells.get(column));
    let names = head.cells.iter().enumerate().map(|(column, text)| Name {
        text: match text.as_str() {
            "" if tagged && column == 1 => "time".to_owned(),
            text => text.to_owned(),
        },
        unit: unit(column).map_or(String::new(), |unit| symbol(unit)),
        ..name("", !(tagged && column == 0))
    });
    let mut names: Vec<Name> = names.collect();
    let time_base = logger::time_base(table, &names, units.map(|(_, cells)| cells.as_slice()));
    match &time_base {
        Some(base) if base.has_no_column() => logger::leave_out_stamps(table, &mut names),
        Some(_) => {
            for name in &mut names {
                name.kept &= !EMPTY_COLUMNS.contains(&name.text.as_str());
                name.unit = name.unit.replace("Sequence", "s");
            }
        }
        None => put_row_names_before(table, &mut names),
    }
    leave_out_empty(table, &mut names);
    let head_end = match (tagged, units) {
        (true, _) => table.line(table.run.0.checked_sub(1)?)?,
        (false, Some((number, _))) => *number,
        (false, None) => head.line,
    };
    let start = table.first_below(head_end);
    for (column, name) in names.iter_mut().enumerate() {
        let cells = table.column_from(start, column);
        (name.kind, name.grows, name.counts) = (cells.kind, cells.grows, cells.counts);
    }
    Some(Layout {
        dialect: Dialect {
            separator: table.separator,
            decimal: table.decimal,
            header_lines: head.line.saturating_sub(1),
            units_row: units.is_some(),
            encoding,
        },
        names,
        names_line: head.line,
        head_end,
        time_base,
        has_header,
        is_labview: logger::is_labview(table),
    })
}

fn name(text: &str, kept: bool) -> Name {
    Name {
        text: text.to_owned(),
        unit: String::new(),
        kept,
        kind: Kind::Missing,
        grows: false,
        counts: false,
    }
}

/// R writes the names of the rows into a column that has none itself.
fn put_row_names_before(table: &Table, names: &mut Vec<Name>) {
    let one_less = table.width() == Some(names.len() + 1);
    if one_less && table.column(0).counts && table.column(names.len()).kind != Kind::Missing {
        names.insert(0, name("", true));
    }
}

/// Leaves out columns at the end that have neither name nor samples, as trailing separators make them.
fn leave_out_empty(table: &Table, names: &mut Vec<Name>) {
    let Some(width) = table.width() else {
        return;
    };
    let beyond = names.get(width..).unwrap_or_default();
    if beyond
        .iter()
        .all(|name| EMPTY_COLUMNS.contains(&name.text.as_str()))
    {
        names.truncate(width);
    }
    let filled = table
        .run_rows()
        .filter_map(|cells| cells.iter().rposition(|cell| !cell.is_empty()));
    let filled = filled.max().map_or(0, |last| last + 1);
    if filled <= names.len() {
        while names.len() < width {
            names.push(name("", false));
        }
    }
    let empty = names.iter_mut().skip(filled);
    for name in empty.filter(|name| EMPTY_COLUMNS.contains(&name.text.as_str())) {
        name.kept = false;
    }
}
