//! This file says that the reader of text recordings loses nothing and invents nothing, whatever a logger appends and wherever it was cut off.

use std::path::Path;

use proptest::prelude::*;
use proptest::test_runner::FileFailurePersistence;
use proptest_state_machine::{ReferenceStateMachine, StateMachineTest, prop_state_machine};
use rigproof_trace::Trace;
use rigproof_trace::csv::{Dialect, Hints, LEAST_SAMPLES, parse_as};

const NAMES: [&str; 3] = ["t", "x", "y"];
const UNITS: [&str; 3] = ["s", "mm", "V"];
/// Separators, as text and as they are reported, and decimal marks that go together.
const DIALECTS: [(&str, &str, char); 8] = [
    (",", ",", '.'),
    (",", ",", ','),
    (";", ";", '.'),
    (";", ";", ','),
    ("\t", "tab", '.'),
    ("\t", "tab", ','),
    (" ", "blank", '.'),
    (" ", "blank", ','),
];

/// What a logger, or somebody with an editor, does to the recording.
#[derive(Clone, Debug)]
enum Edit {
    /// One more row: how much later, and two values, thousandths.
    Row(u32, [i32; 2]),
    /// A row without one value.
    Missing(usize),
    /// A line that holds nothing.
    Other(&'static str),
    /// A row without its time.
    NoTime,
    /// A row so many thousandths before the last one.
    Back(u32),
    /// A row with something in one column that is no number.
    Word(usize, &'static str),
    /// A row with a cell too few.
    Narrow,
    /// A row with a cell too many.
    Wide,
    /// The last line is written up to here only, until something else happens.
    Cut(usize),
    /// The first faulty line is taken out.
    Mend,
}

#[derive(Clone, Debug)]
enum Line {
    Cells(Vec<String>),
    Other(&'static str),
}

/// A recording as lines of cells; nothing is parsed here but what was cut.
#[derive(Clone, Debug)]
struct Recording {
    dialect: (&'static str, &'static str, char),
    units_row: bool,
    end: &'static str,
    lines: Vec<Line>,
    /// How much of the last line is written, if not all of it.
    cut: Option<usize>,
    time_ms: i64,
}

/// What is wrong: line, column (0 for the line) and the words.
type Fault = (usize, usize, String);

impl Recording {
    fn number(&self, thousandths: i64) -> String {
        let sign = if thousandths < 0 { "-" } else { "" };
        let (whole, part) = (thousandths.abs() / 1000, thousandths.abs() % 1000);
        format!("{sign}{whole}{}{part:03}", self.dialect.2)
    }

    fn row(&self, time_ms: i64, [x, y]: [i32; 2]) -> Vec<String> {
        [time_ms, x.into(), y.into()]
            .map(|number| self.number(number))
            .into()
    }

    fn quoted(&self, cell: &str) -> String {
        if cell.contains(self.dialect.0) {
            format!("\"{cell}\"")
        } else {
            cell.to_owned()
        }
    }

    fn written(&self, line: &Line) -> String {
        match line {
            Line::Other(text) => (*text).to_owned(),
            Line::Cells(cells) => {
                let cells: Vec<String> = cells.iter().map(|cell| self.quoted(cell)).collect();
                cells.join(self.dialect.0)
            }
        }
    }

    /// The file.
    fn text(&self) -> String {
        let head = |cells: [&str; 3]| cells.join(self.dialect.0) + self.end;
        let mut text = head(NAMES);
        if self.units_row {
            text += &head(UNITS);
        }
        for (index, line) in self.lines.iter().enumerate() {
            let written = self.written(line);
            match self.cut.filter(|_| index + 1 == self.lines.len()) {
                Some(cut) => text.extend(written.chars().take(cut)),
                None => text += &(written + self.end),
            }
        }
        text
    }

    /// The cells of a row of which so many characters are written; a quote that is not closed loses its cell.
    fn begun(&self, cells: &[String], mut left: usize) -> Vec<String> {
        let mut begun = Vec::new();
        for (index, cell) in cells.iter().enumerate() {
            if index > 0 {
                if left == 0 {
                    break;
                }
                left -= 1;
            }
            let whole = self.quoted(cell);
            if left >= whole.len() {
                begun.push(cell.clone());
                left -= whole.len();
                continue;
            }
            if left == 0 || whole == *cell {
                begun.push(cell[..left].to_owned());
            }
            break;
        }
        begun
    }

    /// What stands in a line: nothing, or cells.
    fn cells(&self, index: usize) -> Option<Vec<String>> {
        let line = self.lines.get(index)?;
        let Line::Cells(cells) = line else {
            return None;
        };
        let written = self.written(line);
        let last = index + 1 == self.lines.len();
        let length = self.cut.filter(|_| last).unwrap_or(written.len());
        let shown: String = written.chars().take(length).collect();
        let mut cells = self.begun(cells, length);
        if self.dialect.0 == " " {
            cells.retain(|cell| !cell.is_empty());
        }
        (!shown.trim().is_empty()).then_some(cells)
    }

    /// The number in a cell: an empty one is a missing sample, and so is one that says it, a cut word too.
    fn value(&self, cell: &str) -> Option<f64> {
        if cell.is_empty() || ["NaN", "Na", "--"].contains(&cell) {
            return Some(f64::NAN);
        }
        let (negative, digits) = match cell.strip_prefix('-') {
            Some(rest) => (true, rest),
            None => (false, cell),
        };
        let (whole, part) = digits.split_once(self.dialect.2).unwrap_or((digits, ""));
        let ends_in_comma = digits.ends_with(',');
        if whole.is_empty() || ends_in_comma || !(whole.to_owned() + part).chars().all(is_digit) {
            return None;
        }
        // Both are whole and small, so that the quotient is the nearest double.
        let number: u32 = (whole.to_owned() + part).parse().unwrap();
        let size = f64::from(number) / [1.0, 10.0, 100.0, 1000.0][part.len()];
        Some(if negative { -size } else { size })
    }

    /// The samples, or the first thing that is wrong.
    fn samples(&self) -> Result<Vec<[f64; 3]>, Fault> {
        let mut samples: Vec<[f64; 3]> = Vec::new();
        let mut repeated = Vec::new();
        let mut shortest = usize::MAX;
        for index in 0..self.lines.len() {
            let Some(cells) = self.cells(index) else {
                continue;
            };
            let line = index + 2 + usize::from(self.units_row);
            let read = self.row_of(&cells, line);
            let is_last = index + 1 == self.lines.len();
            let last = cells.last().map_or(0, String::len);
            let is_cut = self.cut.is_some() && is_last && (read.is_err() || last < shortest);
            if is_cut && samples.len() >= LEAST_SAMPLES {
                break;
            }
            shortest = shortest.min(last);
            let row = read?;
            if row[0].is_nan() {
                return Err((line, 1, "the time stamp is missing".to_owned()));
            }
            let previous = samples.last().map_or(f64::NEG_INFINITY, |before| before[0]);
            if row[0] < previous {
                let words = format!(
                    "the time stamp {} s goes backward after {previous} s",
                    row[0]
                );
                return Err((line, 1, words));
            }
            if row[0] == previous {
                repeated.push(line);
            }
            samples.push(row);
        }
        let few = samples.len() >= LEAST_SAMPLES && 50 * repeated.len() <= samples.len();
        match repeated.first() {
            Some(line) if !few => Err((*line, 1, "the time stamp is repeated".to_owned())),
            _ => {
                samples.dedup_by(|later, first| later[0] == first[0]);
                Ok(samples)
            }
        }
    }

    /// The samples of a row, or what is wrong with its cells.
    fn row_of(&self, cells: &[String], line: usize) -> Result<[f64; 3], Fault> {
        let mut row = [f64::NAN; 3];
        for (column, (cell, sample)) in cells.iter().zip(&mut row).enumerate() {
            let what = if column == 0 { "the time stamp " } else { "" };
            *sample = self.value(cell).ok_or_else(|| {
                let words = format!("{what}`{cell}` is no finite number");
                (line, column + 1, words)
            })?;
        }
        match cells.len() {
            3 => Ok(row),
            count => {
                let words = format!("the line has {count} cells, the header has 3");
                Err((line, 0, words))
            }
        }
    }
}

fn is_digit(character: char) -> bool {
    character.is_ascii_digit()
}

impl ReferenceStateMachine for Recording {
    type State = Recording;
    type Transition = Edit;

    /// Two to twenty good rows: with fewer there is no telling a dialect.
    fn init_state() -> BoxedStrategy<Recording> {
        let rows = prop::collection::vec((1..2903_u32, any_values()), 2..21);
        let dialect = prop::sample::select(DIALECTS.to_vec());
        let end = prop::sample::select(vec!["\n", "\r\n"]);
        (dialect, any::<bool>(), end, -7001..7001_i64, rows)
            .prop_map(|(dialect, units_row, end, time_ms, rows)| {
                let recording = Recording {
                    dialect,
                    units_row,
                    end,
                    lines: Vec::new(),
                    cut: None,
                    time_ms,
                };
                let edits = rows
                    .into_iter()
                    .map(|(step, values)| Edit::Row(step, values));
                edits.fold(recording, |recording, edit| {
                    Recording::apply(recording, &edit)
                })
            })
            .boxed()
    }

    fn transitions(_: &Recording) -> BoxedStrategy<Edit> {
        let other = vec!["", "   ", "\t", "# a remark", "  # 1,5;2,5;3,5"];
        let word = vec!["far", "NaN", "inf", "-", "0x1f", "1e", "1.2.3", "--3"];
        prop_oneof![
            12 => (1..2903_u32, any_values()).prop_map(|(step, values)| Edit::Row(step, values)),
            2 => (1..3_usize).prop_map(Edit::Missing),
            2 => prop::sample::select(other).prop_map(Edit::Other),
            1 => Just(Edit::NoTime),
            1 => prop_oneof![Just(0), 1..901_u32].prop_map(Edit::Back),
            1 => (0..3_usize, prop::sample::select(word)).prop_map(|(k, text)| Edit::Word(k, text)),
            1 => Just(Edit::Narrow),
            1 => Just(Edit::Wide),
            4 => (0..34_usize).prop_map(Edit::Cut),
            6 => Just(Edit::Mend),
        ]
        .boxed()
    }

    fn apply(mut recording: Recording, edit: &Edit) -> Recording {
        recording.cut = None;
        let mut cells = recording.row(recording.time_ms + 617, [-2129, 347]);
        match edit {
            Edit::Row(step, values) => {
                recording.time_ms += i64::from(*step);
                cells = recording.row(recording.time_ms, *values);
            }
            Edit::Missing(column) => {
                recording.time_ms += 617;
                cells[*column].clear();
            }
            Edit::NoTime => cells[0].clear(),
            Edit::Back(by) => cells[0] = recording.number(recording.time_ms - i64::from(*by)),
            Edit::Word(column, word) => cells[*column] = (*word).to_owned(),
            Edit::Narrow => cells.truncate(2),
            Edit::Wide => cells.push(recording.number(7)),
            Edit::Other(text) => {
                recording.lines.push(Line::Other(text));
                return recording;
            }
            Edit::Cut(length) => {
                let last = recording.lines.last();
                let written = last.map_or(0, |line| recording.written(line).chars().count());
                recording.cut = Some(*length).filter(|length| *length < written);
                let cells = recording.cells(recording.lines.len() - 1);
                // A blank at the end of a line is no cell, and a tabulator there may be a blank.
                if recording.dialect.1 == "tab" && cells.is_some_and(|cells| cells.len() > 3) {
                    recording.cut = None;
                }
                return recording;
            }
            Edit::Mend => {
                if let Err((line, ..)) = recording.samples() {
                    let above = 2 + usize::from(recording.units_row);
                    recording.lines.remove(line - above);
                }
                return recording;
            }
        }
        recording.lines.push(Line::Cells(cells));
        recording
    }
}

fn any_values() -> impl Strategy<Value = [i32; 2]> {
    [-99_991..99_991_i32, -9973..9973_i32]
}

/// What the reader makes of the file.
struct Read(Result<(Trace, Dialect), String>);

fn read(recording: &Recording) -> Read {
    let text = recording.text();
    let file = Path::new("run.csv");
    Read(
        parse_as(text.as_bytes(), file, None, &Hints::default()).map_err(|error| error.to_string()),
    )
}

impl StateMachineTest for Read {
    type SystemUnderTest = Read;
    type Reference = Recording;

    fn init_test(recording: &Recording) -> Read {
        read(recording)
    }

    fn apply(_: Read, recording: &Recording, _: Edit) -> Read {
        read(recording)
    }

    fn check_invariants(Read(read): &Read, recording: &Recording) {
        let expected = match recording.samples() {
            Ok(samples) if samples.len() < LEAST_SAMPLES => {
                format!("run.csv: the recording has {} samples", samples.len())
            }
            Ok(samples) => return check_samples(read, recording, &samples),
            Err((line, 0, words)) => format!("run.csv, line {line}: {words}"),
            Err((line, column, words)) => {
                let name = NAMES[column - 1];
                format!("run.csv, line {line}, column {column} `{name}`: {words}")
            }
        };
        let message = read.as_ref().expect_err(&expected);
        assert!(message.starts_with(&expected), "{message}, not {expected}");
        assert!(!message.contains('\n'), "{message}");
    }
}

fn check_samples(
    read: &Result<(Trace, Dialect), String>,
    recording: &Recording,
    samples: &[[f64; 3]],
) {
    let (trace, dialect) = read.as_ref().unwrap();
    let (_, separator, mark) = recording.dialect;
    assert_eq!(dialect.separator.name(), separator);
    assert_eq!(dialect.decimal.name(), mark.to_string());
    assert_eq!(
        (dialect.units_row, dialect.header_lines),
        (recording.units_row, 0)
    );
    assert_eq!(trace.channels.len(), 2);
    let [_, x, y] = NAMES;
    for (channel, (name, unit)) in trace.channels.iter().zip([(x, "mm"), (y, "V")]) {
        let unit = if recording.units_row { unit } else { "" };
        assert_eq!((channel.name.as_str(), channel.unit.as_str()), (name, unit));
    }
    let columns = [
        &trace.time_s,
        &trace.channels[0].samples,
        &trace.channels[1].samples,
    ];
    for (index, column) in columns.into_iter().enumerate() {
        let bits = |value: f64| (!value.is_nan()).then(|| value.to_bits());
        let read: Vec<Option<u64>> = column.iter().copied().map(bits).collect();
        let expected: Vec<Option<u64>> = samples.iter().map(|row| bits(row[index])).collect();
        assert_eq!(read, expected, "{}", NAMES[index]);
    }
}

prop_state_machine! {
    #![proptest_config(ProptestConfig {
        failure_persistence: Some(Box::new(FileFailurePersistence::WithSource("regressions"))),
        ..ProptestConfig::default()
    })]

    #[test]
    fn a_recording_is_read_as_it_stands_or_refused_at_its_first_fault(sequential 1..60 => Read);
}
