//! This file finds the rows of numbers among the first lines of a text file.

use super::dialect::{Decimal, Kind, Separator, is_missing};
use super::lines::Splitter;
use super::stamp::calendar;

/// The tag of ControlDesk's first data row; the rows below have nothing in its place.
pub(super) const TAG: &str = "trace_values";

/// The first lines of a file in cells.
pub(super) struct Table {
    pub(super) separator: Separator,
    pub(super) decimal: Decimal,
    rows: Vec<(usize, Vec<String>)>,
    /// The longest run of rows that hold numbers: the first and the one after the last.
    pub(super) run: (usize, usize),
    /// How many rows the run has, each weighed by the share of its cells that hold numbers.
    pub(super) score: f64,
}

/// What a column holds, as far as the first rows tell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Content {
    pub(super) kind: Kind,
    pub(super) grows: bool,
    pub(super) counts: bool,
}

/// Rows of one width whose cells are of the same kinds.
struct Run {
    start: usize,
    kinds: Vec<Kind>,
    score: f64,
}

impl Table {
    pub(super) fn new(
        separator: Separator,
        decimal: Option<Decimal>,
        lines: &[(usize, String)],
    ) -> Table {
        let mut splitter = Splitter::new(separator);
        let rows = lines.iter().map(|(number, line)| {
            let cells = splitter.cells(line);
            (*number, cells.map(|cell| cell.trim().to_owned()).collect())
        });
        let rows: Vec<(usize, Vec<String>)> = rows.collect();
        let decimals = Decimal::ALL.into_iter();
        let decimals = decimals.filter(|d| decimal.is_none_or(|hint| hint == *d));
        let runs = decimals.map(|decimal| (best_run(&rows, decimal), decimal));
        // The later of two equal ones would win, so the likelier comes last.
        let best = runs.rev().max_by(|((_, a), _), ((_, b), _)| a.total_cmp(b));
        let ((run, score), decimal) = best.unwrap_or((((0, 0), 0.0), Decimal::Point));
        Table {
            separator,
            decimal,
            rows,
            run,
            score,
        }
    }

    pub(super) fn cells(&self, row: usize) -> Option<&[String]> {
        self.rows.get(row).map(|(_, cells)| cells.as_slice())
    }

    /// The number of a row's line.
    pub(super) fn line(&self, row: usize) -> Option<usize> {
        self.rows.get(row).map(|(line, _)| *line)
    }

    pub(super) fn rows(&self) -> impl Iterator<Item = &[String]> {
        self.rows.iter().map(|(_, cells)| cells.as_slice())
    }

    pub(super) fn run_rows(&self) -> impl Iterator<Item = &[String]> {
        (self.run.0..self.run.1).filter_map(|row| self.cells(row))
    }

    /// Cells of a row of numbers.
    pub(super) fn width(&self) -> Option<usize> {
        let rows = self.run.1 - self.run.0;
        self.cells(self.run.0)
            .filter(|_| rows > 0)
            .map(<[String]>::len)
    }

    /// Whether the file begins with numbers, the first of which may be the time.
    pub(super) fn headless(&self) -> bool {
        self.run.0 == 0 && self.run.1 > 1 && self.column(0).grows
    }

    /// The row that ControlDesk marks in its first cell, above the samples.
    pub(super) fn tagged(&self, tag: &str) -> Option<usize> {
        let is_tagged = self.cells(self.run.0)?.first()? == TAG;
        let mut above = (0..self.run.0).rev();
        above.find(|row| {
            let first = self.cells(*row).and_then(<[String]>::first);
            is_tagged && first.is_some_and(|cell| cell.starts_with(tag))
        })
    }

    /// The first row of samples below the head: rows as wide as the run's, with numbers, belong to them where a fault parts
    /// them from the run.
    pub(super) fn first_below(&self, head_end: usize) -> usize {
        let belongs = |row: &usize| {
            let cells = self.cells(*row).unwrap_or_default();
            let is_wide = Some(cells.len()) == self.width();
            is_wide && share_of_numbers(&kinds(cells, self.decimal)).is_some()
        };
        let mut below = (0..self.run.0).filter(|row| self.line(*row) > Some(head_end));
        below.find(belongs).unwrap_or(self.run.0)
    }

    /// What a column holds.
    pub(super) fn column(&self, column: usize) -> Content {
        self.column_from(self.run.0, column)
    }

    /// What a column holds from a row on.
    pub(super) fn column_from(&self, start: usize, column: usize) -> Content {
        let rows = (start..self.run.1).filter_map(|row| self.cells(row));
        let rows = rows.filter(|cells| Some(cells.len()) == self.width());
        let cells = || rows.clone().filter_map(|cells| cells.get(column));
        let kinds = cells().map(|cell| self.decimal.kind(cell));
        let kind = kinds.fold(Kind::Missing, |kind, own| match kind {
            Kind::Missing => own,
            kind => kind,
        });
        let value = |cell: &String| match kind {
            Kind::Number => self.decimal.number(cell),
            Kind::Stamp => calendar(cell).map(|(exact, _)| exact.value()),
            Kind::Missing | Kind::Text => None,
        };
        let values: Vec<f64> = cells().filter_map(value).collect();
        let steps = || {
            values
                .windows(2)
                .filter_map(|pair| Some(pair.get(1)? - pair.first()?))
        };
        Content {
            kind,
            grows: values.first() < values.last() && steps().all(|step| step >= 0.0),
            counts: values.len() > 1 && steps().all(|step| step == 1.0),
        }
    }
}

/// The run of rows with equally many cells, two at least, that holds the most numbers, and how many.
fn best_run(rows: &[(usize, Vec<String>)], decimal: Decimal) -> ((usize, usize), f64) {
    let mut best = ((0, 0), 0.0);
    let mut run: Option<Run> = None;
    for (row, (_, cells)) in rows.iter().enumerate() {
        let kinds: Vec<Kind> = kinds(cells, decimal);
        let Some(share) = share_of_numbers(&kinds) else {
            run = None;
            continue;
        };
        let goes_on = run.as_mut().is_some_and(|own| own.takes(&kinds));
        match run.as_mut().filter(|_| goes_on) {
            Some(own) => own.score += share,
            None => {
                run = Some(Run {
                    start: row,
                    kinds,
                    score: share,
                });
            }
        }
        if let Some(run) = &run
            && run.score > best.1
        {
            best = ((run.start, row + 1), run.score);
        }
    }
    best
}

impl Run {
    /// Whether a row goes on with the run; what was missing so far is what the row has.
    fn takes(&mut self, kinds: &[Kind]) -> bool {
        let pairs = || self.kinds.iter().zip(kinds);
        let fits = pairs().all(|(own, new)| own == new || [*own, *new].contains(&Kind::Missing));
        if !fits || self.kinds.len() != kinds.len() {
            return false;
        }
        for (own, new) in self.kinds.iter_mut().zip(kinds) {
            if *own == Kind::Missing {
                *own = *new;
            }
        }
        true
    }
}

fn kinds(cells: &[String], decimal: Decimal) -> Vec<Kind> {
    let kind = |(column, cell): (usize, &String)| match column {
        0 if cell == TAG => Kind::Missing,
        _ if is_missing(cell) => Kind::Missing,
        _ => decimal.kind(cell),
    };
    cells.iter().enumerate().map(kind).collect()
}

/// The share of the cells that hold numbers or stamps; `None` for a row that is none of numbers.
fn share_of_numbers(kinds: &[Kind]) -> Option<f64> {
    let filled = kinds.iter().filter(|kind| **kind != Kind::Missing).count();
    let numbers = kinds
        .iter()
        .filter(|kind| matches!(kind, Kind::Number | Kind::Stamp))
        .count();
    let holds = kinds.len() > 1 && numbers > 0 && (numbers == filled || numbers > 1);
    holds.then(|| numbers as f64 / filled.max(1) as f64)
}

/// The cells of a line if there are so many of them: split as the rows are, else in another way.
pub(super) fn split_to_width(
    line: &str,
    separator: Separator,
    width: usize,
) -> Option<Vec<String>> {
    let others = Separator::ALL
        .into_iter()
        .filter(|other| *other != separator);
    let mut ways = core::iter::once(separator).chain(others).map(|separator| {
        let mut splitter = Splitter::new(separator);
        let cells = splitter.cells(line).map(|cell| cell.trim().to_owned());
        cells.collect::<Vec<_>>()
    });
    let wide = || {
        let cells = line.split("  ").map(|cell| cell.trim().to_owned());
        cells.filter(|cell| !cell.is_empty()).collect::<Vec<_>>()
    };
    ways.find(|cells| cells.len() == width)
        .or_else(|| Some(wide()).filter(|cells| cells.len() == width))
}
