//! This file takes a text file apart, line by line and cell by cell, in bounded memory.

use std::io::{BufRead, BufReader, Read};
use std::path::Path;

use super::dialect::Separator;
use crate::error::{Place, TraceError};

/// The longest line that is read, bytes.
const LONGEST_LINE: usize = 1 << 20;

/// What comments begin with.
const COMMENTS: [char; 2] = ['#', '%'];

/// The lines of a file that hold something: no blank line, no comment.
pub(super) struct Lines<'a, R> {
    source: BufReader<R>,
    file: &'a Path,
    number: usize,
    buffer: Vec<u8>,
    /// The line read last, where its bytes are no UTF-8 and were taken for Latin letters.
    latin: Option<String>,
    /// Whether any line was read so.
    has_latin: bool,
    /// Whether the line read last ended with the file and not with a line feed.
    is_open: bool,
}

impl<'a, R: Read> Lines<'a, R> {
    pub(super) fn new(source: R, file: &'a Path) -> Self {
        Lines {
            source: BufReader::with_capacity(1 << 16, source),
            file,
            number: 0,
            buffer: Vec::new(),
            latin: None,
            has_latin: false,
            is_open: false,
        }
    }

    /// Whether some line was no UTF-8, so that its bytes were taken for Latin letters.
    pub(super) fn has_latin(&self) -> bool {
        self.has_latin
    }

    /// Whether the file ends in the line read last, without a line feed.
    pub(super) fn is_open(&self) -> bool {
        self.is_open
    }

    /// The number of the line read last.
    pub(super) fn number(&self) -> usize {
        self.number
    }

    /// The place of the line read last.
    pub(super) fn place(&self) -> Place {
        Place::line(self.file, self.number)
    }

    /// The next line without its end, or `None` at the end of the file.
    pub(super) fn next_line(&mut self) -> Result<Option<&str>, TraceError> {
        while let Some(line) = self.advance()? {
            if !line.trim_start().starts_with(COMMENTS) {
                return self.text().map(Some);
            }
        }
        Ok(None)
    }

    /// The next line, and whether it is a comment, which is given without its mark.
    pub(super) fn next_line_or_comment(&mut self) -> Result<Option<(&str, bool)>, TraceError> {
        let Some(line) = self.advance()? else {
            return Ok(None);
        };
        let shown = line.trim_start();
        let is_comment = shown.starts_with(COMMENTS);
        Ok(Some(match is_comment {
            true => (shown.trim_start_matches(COMMENTS).trim(), true),
            false => (line, false),
        }))
    }

    /// Reads on to the next line that holds something.
    fn advance(&mut self) -> Result<Option<&str>, TraceError> {
        loop {
            self.buffer.clear();
            self.latin = None;
            let longest = u64::try_from(LONGEST_LINE + 1).unwrap_or(u64::MAX);
            let read = (&mut self.source)
                .take(longest)
                .read_until(b'\n', &mut self.buffer)
                .map_err(TraceError::io("read", self.file))?;
            if read == 0 {
                return Ok(None);
            }
            self.number += 1;
            self.is_open = self.buffer.last() != Some(&b'\n');
            if std::str::from_utf8(&self.buffer).is_err() {
                self.latin = Some(self.buffer.iter().copied().map(char::from).collect());
                self.has_latin = true;
            }
            if !self.text()?.trim().is_empty() {
                break;
            }
        }
        self.text().map(Some)
    }

    /// The buffered line, without its end and a byte-order mark.
    fn text(&self) -> Result<&str, TraceError> {
        let refuse = |problem| TraceError::NotText {
            place: self.place(),
            problem,
        };
        if self.buffer.contains(&0) {
            return Err(refuse("the file holds NUL bytes, so it is no text"));
        }
        if self.buffer.len() > LONGEST_LINE {
            return Err(refuse("the line is longer than 1 MiB"));
        }
        let text = match &self.latin {
            Some(text) => text.as_str(),
            None => std::str::from_utf8(&self.buffer).unwrap_or_default(),
        };
        let text = text.trim_end_matches(['\n', '\r']);
        if text.contains('\r') {
            return Err(refuse(
                "the line holds a carriage return; end lines with a line feed",
            ));
        }
        let first = self.number == 1;
        Ok(text
            .strip_prefix('\u{feff}')
            .filter(|_| first)
            .unwrap_or(text))
    }
}

/// Splits a line into cells; quotes are taken off, blanks around a cell stay.
pub(super) struct Splitter {
    /// Built at the first quote: its tables cost more than a short file takes to read.
    reader: Option<csv_core::Reader>,
    separator: Separator,
    line: Vec<u8>,
    text: Vec<u8>,
    ends: Vec<usize>,
}

impl Splitter {
    pub(super) fn new(separator: Separator) -> Splitter {
        Splitter {
            reader: None,
            separator,
            line: Vec::new(),
            text: Vec::new(),
            ends: Vec::new(),
        }
    }

    /// The cells of one line. A quote that is not closed loses its cell, so that the count comes out wrong.
    pub(super) fn cells<'s>(&'s mut self, line: &str) -> impl Iterator<Item = &'s str> {
        self.line.clear();
        if self.separator == Separator::Blank {
            for word in line.split_whitespace() {
                self.line.extend_from_slice(word.as_bytes());
                self.line.push(b' ');
            }
            self.line.pop();
        } else {
            self.line.extend_from_slice(line.as_bytes());
        }
        // Between cells that are not unquoted their separators still stand.
        let between = if self.line.contains(&b'"') || self.line.is_empty() {
            self.unquote();
            0
        } else {
            self.divide();
            1
        };
        let (text, mut start) = (&self.text, 0);
        self.ends.iter().map(move |&end| {
            let cell = text.get(start..end).unwrap_or_default();
            start = end + between;
            std::str::from_utf8(cell).unwrap_or_default()
        })
    }

    /// Finds the cells of a line without quotes.
    fn divide(&mut self) {
        self.text.clone_from(&self.line);
        let separator = self.separator.byte();
        let bytes = self.line.iter().enumerate();
        let separators = bytes.filter(|(_, byte)| **byte == separator);
        self.ends.clear();
        self.ends.extend(separators.map(|(at, _)| at));
        self.ends.push(self.line.len());
    }

    /// Finds the cells of a line with quotes, and takes the quotes off.
    fn unquote(&mut self) {
        let separator = self.separator.byte();
        let reader = self.reader.get_or_insert_with(|| {
            let mut builder = csv_core::ReaderBuilder::new();
            builder.delimiter(separator).build()
        });
        self.line.push(b'\n');
        // A cell never grows by unquoting, and there is one cell more than separators.
        self.text.resize(self.line.len(), 0);
        self.ends.resize(self.line.len(), 0);
        reader.reset();
        let (_, _, _, count) = reader.read_record(&self.line, &mut self.text, &mut self.ends);
        self.ends.truncate(count);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_is_split_alike_with_quotes_and_without() {
        for separator in Separator::ALL {
            let mark = char::from(separator.byte());
            let mut splitter = Splitter::new(separator);
            for cells in [
                &["0.25", "-1.5e3", "µm"][..],
                &["a", "7.5", "b c", "x"],
                &["3.25"],
                &["", "0.75", ""],
            ] {
                let splits = separator != Separator::Blank;
                if !splits
                    && cells
                        .iter()
                        .any(|cell| cell.is_empty() || cell.contains(' '))
                {
                    continue;
                }
                let plain = cells.join(&mark.to_string());
                let quoted = cells.iter().map(|cell| format!("\"{cell}\""));
                let quoted = quoted.collect::<Vec<_>>().join(&mark.to_string());
                for line in [plain, quoted] {
                    assert_eq!(splitter.cells(&line).collect::<Vec<_>>(), cells, "{line}");
                }
            }
        }
    }
}
