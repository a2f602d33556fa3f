//! This file reads the definition of a ROS message: its fields, and the types it is made of.

use std::collections::HashMap;

use super::{Number, Wire};
use crate::mcap::topics::short;

/// The deepest that types may stand in each other.
const DEEPEST: usize = 32;

/// What a field holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Number(Number),
    Text,
    /// Another type, by its place.
    Record(usize),
}

/// How often a field holds it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Count {
    One,
    Fixed(usize),
    /// As many as the message says, up to a bound where there is one.
    Listed(Option<usize>),
}

/// A field of a type.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Field {
    pub(super) name: String,
    pub(super) kind: Kind,
    pub(super) count: Count,
}

/// A type: its fields in the order of the bytes.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct RecordType {
    pub(super) fields: Vec<Field>,
    /// The fewest bytes a value takes.
    least_bytes: u64,
}

/// The types of a message; the first one is its own.
#[derive(Debug)]
pub(super) struct Definitions {
    pub(super) records: Vec<RecordType>,
}

/// Types by name, as lines of text.
struct Sources<'a> {
    texts: HashMap<String, &'a str>,
    places: HashMap<String, usize>,
    records: Vec<RecordType>,
    wire: Wire,
}

impl Definitions {
    pub(super) fn parse(name: &str, text: &str, wire: Wire) -> Result<Definitions, String> {
        let mut texts = HashMap::new();
        let own = plain(name);
        for (index, section) in sections(text).into_iter().enumerate() {
            let named = section
                .trim_start()
                .split_once('\n')
                .unwrap_or((section.trim(), ""));
            match (index, named.0.trim().strip_prefix("MSG:")) {
                (_, Some(name)) => {
                    texts.insert(plain(name.trim()), named.1);
                }
                (0, None) => {
                    texts.insert(own.clone(), section);
                }
                (_, None) if named.0.starts_with("IDL:") => {
                    return Err("its definition is in IDL; definitions in .msg are read".into());
                }
                (_, None) => return Err("a part of its definition has no name".into()),
            }
        }
        let mut sources = Sources {
            texts,
            places: HashMap::new(),
            records: Vec::new(),
            wire,
        };
        sources.record(&own, 0)?;
        let records = sources.records;
        Ok(Definitions { records })
    }

    /// The fewest bytes that a value of this kind takes.
    pub(super) fn least_bytes(&self, kind: Kind) -> u64 {
        least_bytes(&self.records, kind)
    }
}

fn least_bytes(records: &[RecordType], kind: Kind) -> u64 {
    match kind {
        Kind::Number(number) => number.bytes() as u64,
        Kind::Text => 4,
        Kind::Record(place) => records.get(place).map_or(0, |record| record.least_bytes),
    }
}

impl<'a> Sources<'a> {
    /// The place of a type, read when it is needed first.
    fn record(&mut self, name: &str, depth: usize) -> Result<usize, String> {
        if let Some(&place) = self.places.get(name) {
            return match self
                .records
                .get(place)
                .is_some_and(|r| r.least_bytes == u64::MAX)
            {
                true => Err(format!("the type `{}` contains itself", short(name))),
                false => Ok(place),
            };
        }
        if depth > DEEPEST {
            return Err(format!(
                "its types stand more than {DEEPEST} deep in each other"
            ));
        }
        let text = match self.texts.get(name).copied() {
            Some(text) => text,
            None => well_known(name, self.wire)
                .ok_or_else(|| format!("its definition lacks the type `{}`", short(name)))?,
        };
        let place = self.records.len();
        self.places.insert(name.to_string(), place);
        // A mark until the type is whole.
        self.records.push(RecordType {
            fields: Vec::new(),
            least_bytes: u64::MAX,
        });
        let package = name.split_once('/').map_or("", |(package, _)| package);
        let mut fields = Vec::new();
        for line in text.lines() {
            if let Some((written, name)) = declaration(line)? {
                fields.push(self.field(written, name, package, depth)?);
            }
        }
        let each = fields.iter().map(|field| match field.count {
            Count::One => least_bytes(&self.records, field.kind),
            Count::Fixed(count) => {
                least_bytes(&self.records, field.kind).saturating_mul(count as u64)
            }
            Count::Listed(_) => 4,
        });
        let empty = u64::from(fields.is_empty() && self.wire == Wire::Cdr);
        // The mark itself is no size.
        let least_bytes = each.fold(empty, u64::saturating_add).min(u64::MAX - 1);
        if let Some(record) = self.records.get_mut(place) {
            *record = RecordType {
                fields,
                least_bytes,
            };
        }
        Ok(place)
    }

    fn field(
        &mut self,
        written: &str,
        name: &str,
        package: &str,
        depth: usize,
    ) -> Result<Field, String> {
        let (base, count) = counted(written)?;
        let base = base.split_once("<=").map_or(base, |(base, _)| base);
        let kind = match number(base, self.wire) {
            Some(number) => Kind::Number(number),
            None if base == "string" => Kind::Text,
            None if base == "wstring" => {
                return Err(format!(
                    "`{}` is a wide text, which writers lay out differently; such messages are not read",
                    short(name)
                ));
            }
            None => {
                let full = match (base, base.contains('/')) {
                    ("Header", _) => "std_msgs/Header".to_string(),
                    ("time" | "duration", _) => base.to_string(),
                    (_, true) => plain(base),
                    (_, false) => format!("{package}/{base}"),
                };
                Kind::Record(self.record(&full, depth + 1)?)
            }
        };
        let name = name.to_string();
        Ok(Field { name, kind, count })
    }
}

/// The parts of a definition, between lines of equals signs.
fn sections(text: &str) -> Vec<&str> {
    let mut sections = Vec::new();
    let (mut start, mut at) = (0, 0);
    for line in text.split_inclusive('\n') {
        let ruled = line.trim();
        if ruled.len() >= 10 && ruled.bytes().all(|byte| byte == b'=') {
            sections.push(text.get(start..at).unwrap_or_default());
            start = at + line.len();
        }
        at += line.len();
    }
    sections.push(text.get(start..).unwrap_or_default());
    sections
}

/// The type and the name of a field, or `None` for a constant, a comment or nothing.
fn declaration(line: &str) -> Result<Option<(&str, &str)>, String> {
    let line = line.trim();
    if line.is_empty() || line.starts_with('#') {
        return Ok(None);
    }
    let wrong = || format!("the line `{}` of its definition is none", short(line));
    let (written, rest) = line.split_once(char::is_whitespace).ok_or_else(wrong)?;
    let rest = rest.trim_start();
    let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let end = rest.find(|c| !is_part(c)).unwrap_or(rest.len());
    let (name, after) = rest.split_at_checked(end).ok_or_else(wrong)?;
    if name.is_empty() || written.contains('#') {
        return Err(wrong());
    }
    // What follows a field's name is its default, which every message states anyway.
    Ok((!after.trim_start().starts_with('=')).then_some((written, name)))
}

/// The type of an element and how many there are.
fn counted(written: &str) -> Result<(&str, Count), String> {
    let Some((base, bracket)) = written.strip_suffix(']').and_then(|w| w.rsplit_once('[')) else {
        return Ok((written, Count::One));
    };
    let number = |text: &str| {
        let number: Result<u32, _> = text.parse();
        number.map_err(|_| format!("the type `{}` is none", short(written)))
    };
    let count = match (bracket, bracket.strip_prefix("<=")) {
        ("", _) => Count::Listed(None),
        (_, Some(most)) => Count::Listed(Some(number(most)? as usize)),
        (exactly, None) => Count::Fixed(number(exactly)? as usize),
    };
    Ok((base, count))
}

fn number(base: &str, wire: Wire) -> Option<Number> {
    Some(match base {
        "bool" => Number::Bool,
        "byte" if wire == Wire::Ros1 => Number::I8,
        "uint8" | "char" | "byte" => Number::U8,
        "int8" => Number::I8,
        "uint16" => Number::U16,
        "int16" => Number::I16,
        "uint32" => Number::U32,
        "int32" => Number::I32,
        "uint64" => Number::U64,
        "int64" => Number::I64,
        "float32" => Number::F32,
        "float64" => Number::F64,
        _ => return None,
    })
}

/// Types that the language itself brings, so that a definition may leave them out.
fn well_known(name: &str, wire: Wire) -> Option<&'static str> {
    match (name, wire) {
        ("time", Wire::Ros1) => Some("uint32 sec\nuint32 nsec"),
        ("duration", Wire::Ros1) => Some("int32 sec\nint32 nsec"),
        ("builtin_interfaces/Time" | "builtin_interfaces/Duration", Wire::Cdr) => {
            Some("int32 sec\nuint32 nanosec")
        }
        _ => None,
    }
}

/// `package/Type` for `package/msg/Type`.
fn plain(name: &str) -> String {
    name.replacen("/msg/", "/", 1)
}
