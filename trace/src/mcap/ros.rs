//! This file reads the messages of ROS 1 and ROS 2 by the definition that their file carries.

mod cursor;
mod definition;
mod number;

use cursor::Cursor;
use definition::{Count, Definitions, Field, Kind};
pub(super) use number::Number;

use super::flat::Flat;

/// How a message stands in its bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Wire {
    /// ROS 2: a head that gives the byte order, numbers at multiples of their size.
    Cdr,
    /// ROS 1: lowest byte first, nothing in between.
    Ros1,
}

/// A reader for the messages of one type.
#[derive(Debug)]
pub(super) struct RosReader {
    definitions: Definitions,
    wire: Wire,
}

impl RosReader {
    /// Prepares to read messages of the type `name`, defined by `text`.
    ///
    /// # Errors
    /// The definition makes no sense, or holds what cannot be read.
    pub(super) fn new(name: &str, text: &str, wire: Wire) -> Result<RosReader, String> {
        let definitions = Definitions::parse(name, text, wire)?;
        Ok(RosReader { definitions, wire })
    }

    /// Takes the numbers of a message out; `named` keeps their places too.
    ///
    /// # Errors
    /// The bytes end early or contradict the definition.
    pub(super) fn read(&self, data: &[u8], flat: &mut Flat, named: bool) -> Result<(), String> {
        flat.begin(named);
        let mut cursor = match self.wire {
            Wire::Cdr => Cursor::cdr(data)?,
            Wire::Ros1 => Cursor::packed(data),
        };
        if named {
            cursor.keep_pins();
        }
        self.fields(0, &mut cursor, flat)?;
        if let Some(pins) = cursor.into_pins() {
            flat.keep_track(data, pins);
        }
        Ok(())
    }

    fn fields(
        &self,
        record: usize,
        cursor: &mut Cursor<'_>,
        flat: &mut Flat,
    ) -> Result<(), String> {
        let Some(record) = self.definitions.records.get(record) else {
            return Ok(());
        };
        for field in &record.fields {
            flat.field(&field.name);
            self.field(field, cursor, flat)?;
            flat.up();
        }
        if record.fields.is_empty() && self.wire == Wire::Cdr {
            // A record without fields takes one byte there.
            cursor.skip(1, 1)?;
        }
        Ok(())
    }

    fn field(&self, field: &Field, cursor: &mut Cursor<'_>, flat: &mut Flat) -> Result<(), String> {
        let count = match field.count {
            Count::One => return self.value(field.kind, cursor, flat, false),
            Count::Fixed(count) => count,
            Count::Listed(most) => {
                let count = cursor.count()?;
                if most.is_some_and(|most| count > most) {
                    return Err(format!(
                        "`{}` has {count} elements, its type allows {}",
                        field.name,
                        most.unwrap_or(0)
                    ));
                }
                flat.depends_on_count(count);
                count
            }
        };
        let least = self.definitions.least_bytes(field.kind);
        if (count as u64).saturating_mul(least) > cursor.left() as u64 {
            return Err(format!(
                "`{}` announces {count} elements, which the message is too short for",
                field.name
            ));
        }
        if least == 0 {
            return Ok(());
        }
        if let Kind::Number(number) = field.kind {
            let looked_into = count.min(flat.elements);
            cursor.numbers(number, looked_into, flat)?;
            return cursor.skip(count - looked_into, number.bytes());
        }
        for index in 0..count {
            // Numbers beyond are read past: only the last element of a list of that length costs more.
            if index == flat.elements {
                return self.read_past(field.kind, count - index, cursor);
            }
            flat.element(index);
            self.value(field.kind, cursor, flat, true)?;
            flat.up();
        }
        Ok(())
    }

    fn value(
        &self,
        kind: Kind,
        cursor: &mut Cursor<'_>,
        flat: &mut Flat,
        element: bool,
    ) -> Result<(), String> {
        match kind {
            Kind::Number(number) => cursor.number(number, flat)?,
            Kind::Text => {
                let text = cursor.text(element)?;
                if element {
                    flat.element_text(text);
                }
            }
            Kind::Record(record) => self.fields(record, cursor, flat)?,
        }
        Ok(())
    }

    /// Passes over what nobody asked for.
    fn read_past(&self, kind: Kind, count: usize, cursor: &mut Cursor<'_>) -> Result<(), String> {
        let mut nowhere = Flat::new(0);
        for _ in 0..count {
            nowhere.numbers.clear();
            self.value(kind, cursor, &mut nowhere, false)?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;
