//! This file walks a TOML table and says where in the text it stops making sense.

use std::ops::Range;
use std::path::Path;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::FILL_IN;
use crate::error::{Place, TraceError};
use crate::suggest::advice;

/// The text of a TOML file.
#[derive(Clone, Copy)]
pub struct Source<'a> {
    /// The text.
    pub text: &'a str,
    /// The file that messages name.
    pub file: &'a Path,
}

impl<'a> Source<'a> {
    /// The text as TOML.
    ///
    /// # Errors
    /// It is none; the message gives line and column.
    pub fn document(&self) -> Result<Spanned<DeTable<'a>>, TraceError> {
        DeTable::parse(self.text).map_err(|error| {
            let at = error.span().map_or(0, |span| span.start);
            let message = error.message().lines().collect::<Vec<_>>().join("; ");
            self.error(at, format!("the text is no TOML: {message}"))
        })
    }

    /// What else is to be filled in beside the value at a byte position, so that nobody is told one thing at a time.
    fn others_to_fill_in(&self, except: usize) -> String {
        let Ok(document) = self.document() else {
            return String::new();
        };
        let mut found = Vec::new();
        unfilled(document.get_ref(), "", &mut found);
        found.retain(|(_, at)| *at != except);
        let before = |at: usize| self.text.get(..at).unwrap_or_default();
        let others = found
            .iter()
            .map(|(key, at)| format!("`{key}` in line {}", before(*at).matches('\n').count() + 1));
        let others: Vec<String> = others.collect();
        match others.is_empty() {
            true => String::new(),
            false => format!("; so are {}", others.join(", ")),
        }
    }

    /// An error at a byte position of the text.
    pub fn error(&self, at: usize, problem: impl Into<String>) -> TraceError {
        let before = self.text.get(..at).unwrap_or(self.text);
        let line_start = before.rfind('\n').map_or(0, |end| end + 1);
        let in_line = before.get(line_start..).unwrap_or_default();
        TraceError::Rig {
            place: Place {
                column: in_line.chars().count() + 1,
                ..Place::line(self.file, before.matches('\n').count() + 1)
            },
            problem: problem.into(),
        }
    }
}

/// The keys below a table that are still to be filled in, with their byte positions, in the order of the text.
fn unfilled(table: &DeTable<'_>, within: &str, found: &mut Vec<(String, usize)>) {
    let mut own: Vec<(&str, &Spanned<DeValue<'_>>)> = Vec::new();
    for (key, value) in table {
        own.push((key.get_ref(), value));
    }
    own.sort_by_key(|(_, value)| value.span().start);
    for (key, value) in own {
        let key = match within {
            "" => key.to_owned(),
            within => format!("{within}.{key}"),
        };
        match value.get_ref() {
            DeValue::String(text) if text.as_ref() == FILL_IN => {
                found.push((key, value.span().start));
            }
            DeValue::Table(below) => unfilled(below, &key, found),
            DeValue::Array(items) => items
                .iter()
                .filter_map(|item| item.get_ref().as_table())
                .for_each(|below| unfilled(below, &key, found)),
            _ => {}
        }
    }
}

/// One table of the file.
pub struct Table<'a> {
    source: Source<'a>,
    /// How a message calls the table.
    title: String,
    span: Range<usize>,
    entries: &'a DeTable<'a>,
}

impl<'a> Table<'a> {
    /// The whole file.
    pub fn root(source: Source<'a>, document: &'a Spanned<DeTable<'a>>) -> Table<'a> {
        Table {
            source,
            title: "the file".into(),
            span: 0..0,
            entries: document.get_ref(),
        }
    }

    /// An error at the table as a whole.
    pub fn error(&self, problem: impl Into<String>) -> TraceError {
        self.source.error(self.span.start, problem)
    }

    /// An error at the value of a key.
    pub fn error_at(&self, key: &str, problem: impl Into<String>) -> TraceError {
        let at = self
            .get(key)
            .map_or(self.span.start, |value| value.span().start);
        self.source.error(at, problem)
    }

    /// Refuses every key that is not listed.
    ///
    /// # Errors
    /// There is another; the message gives line and column, and the keys that are known.
    pub fn only(&self, known: &[&str]) -> Result<(), TraceError> {
        for key in self.entries.keys() {
            let name: &str = key.get_ref();
            if !known.contains(&name) {
                let advice = advice(name, "keys", known);
                let problem = format!("`{name}` is no key of {}; {advice}", self.title);
                return Err(self.source.error(key.span().start, problem));
            }
        }
        Ok(())
    }

    /// What the table is called in a message.
    pub fn title(&self) -> &str {
        &self.title
    }

    /// Its keys.
    pub fn keys(&self) -> impl Iterator<Item = &'a str> {
        self.entries.keys().map(|key| -> &str { key.get_ref() })
    }

    /// Whether a key is there.
    pub fn has(&self, key: &str) -> bool {
        self.get(key).is_some()
    }

    /// The text of a key, if it is there.
    ///
    /// # Errors
    /// It is something else.
    pub fn text(&self, key: &str) -> Result<Option<&'a str>, TraceError> {
        self.typed(key, "text in quotes", DeValue::as_str)
    }

    /// Whether a key holds, if it is there.
    ///
    /// # Errors
    /// It is something else than `true` or `false`.
    pub fn flag(&self, key: &str) -> Result<Option<bool>, TraceError> {
        self.typed(key, "true or false", DeValue::as_bool)
    }

    /// The number of a key, if it is there.
    ///
    /// # Errors
    /// It is something else, or not finite.
    pub fn number(&self, key: &str) -> Result<Option<f64>, TraceError> {
        let number = self.typed(key, "a number", number)?;
        match number {
            Some(number) if !f64::is_finite(number) => {
                Err(self.error_at(key, format!("`{key}` is {number}; give a finite number")))
            }
            _ => Ok(number),
        }
    }

    /// The numbers of a list, if it is there.
    ///
    /// # Errors
    /// It is something else, or holds something else.
    pub fn numbers(&self, key: &str) -> Result<Option<Vec<f64>>, TraceError> {
        let Some(list) = self.typed(key, "a list of numbers", DeValue::as_array)? else {
            return Ok(None);
        };
        let number = |item: &Spanned<DeValue<'_>>| {
            let own = number(item.get_ref()).filter(|own| own.is_finite());
            own.ok_or_else(|| {
                let found = item.get_ref().type_str();
                let problem = format!(
                    "`{key}` holds something of type {found}; give numbers that are finite"
                );
                self.source.error(item.span().start, problem)
            })
        };
        list.iter().map(number).collect::<Result<_, _>>().map(Some)
    }

    /// A number above zero, if it is there.
    ///
    /// # Errors
    /// It is something else.
    pub fn positive(&self, key: &str) -> Result<Option<f64>, TraceError> {
        match self.number(key)? {
            Some(number) if number <= 0.0 => {
                Err(self.error_at(key, format!("`{key}` is {number}; it must be above 0")))
            }
            number => Ok(number),
        }
    }

    /// The table of a key, if it is there.
    ///
    /// # Errors
    /// It is something else.
    pub fn table(&self, key: &str) -> Result<Option<Table<'a>>, TraceError> {
        let entries = self.typed(key, "a table", DeValue::as_table)?;
        Ok(entries.map(|entries| self.child(key, entries)))
    }

    /// The tables of an array, `[[key]]`.
    ///
    /// # Errors
    /// The key holds something else.
    pub fn tables(&self, key: &str) -> Result<Vec<Table<'a>>, TraceError> {
        let expected = format!("a list of tables, `[[{key}]]`");
        let array = self.typed(key, &expected, DeValue::as_array)?;
        let items = array.into_iter().flat_map(|array| array.iter());
        items
            .map(|item| match item.get_ref().as_table() {
                Some(entries) => Ok(Table {
                    title: format!("`[[{key}]]`"),
                    span: item.span(),
                    source: self.source,
                    entries,
                }),
                None => Err(self
                    .source
                    .error(item.span().start, format!("give {expected}"))),
            })
            .collect()
    }

    /// A value that must be there.
    ///
    /// # Errors
    /// It is not.
    pub fn need<T>(&self, key: &str, value: Option<T>) -> Result<T, TraceError> {
        value.ok_or_else(|| self.error(format!("`{key}` is missing in {}; add it", self.title)))
    }

    fn child(&self, key: &str, entries: &'a DeTable<'a>) -> Table<'a> {
        Table {
            source: self.source,
            title: format!("`{key}`"),
            span: self.get(key).map_or(self.span.clone(), Spanned::span),
            entries,
        }
    }

    fn get(&self, key: &str) -> Option<&'a Spanned<DeValue<'a>>> {
        let mut entries = self.entries.iter();
        entries
            .find(|(name, _)| name.get_ref() == key)
            .map(|(_, value)| value)
    }

    fn typed<T>(
        &self,
        key: &str,
        expected: &str,
        read: impl FnOnce(&'a DeValue<'a>) -> Option<T>,
    ) -> Result<Option<T>, TraceError> {
        let Some(value) = self.get(key) else {
            return Ok(None);
        };
        if value.get_ref().as_str() == Some(FILL_IN) {
            let title = &self.title;
            let others = self.source.others_to_fill_in(value.span().start);
            let problem =
                format!("`{key}` of {title} is still to be filled in; give {expected}{others}");
            return Err(self.error_at(key, problem));
        }
        let found = value.get_ref().type_str();
        let wrong = || self.error_at(key, format!("`{key}` is of type {found}; give {expected}"));
        read(value.get_ref()).map(Some).ok_or_else(wrong)
    }
}

fn number(value: &DeValue<'_>) -> Option<f64> {
    let integer = || value.as_integer().filter(|n| n.radix() == 10);
    let float = value.as_float().map(|n| n.as_str());
    float
        .or_else(|| integer().map(|n| n.as_str()))?
        .parse()
        .ok()
}
