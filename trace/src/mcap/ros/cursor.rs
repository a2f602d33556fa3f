//! This file reads numbers and texts out of bytes, never past their end.

use super::number::{Number, bytes};
use crate::mcap::flat::Flat;
use crate::mcap::track::{Pins, Spot};

/// A place in a message.
pub(super) struct Cursor<'a> {
    data: &'a [u8],
    at: usize,
    /// Where multiples of a number's size are counted from; none where numbers stand close together.
    aligned_from: Option<usize>,
    lowest_first: bool,
    /// What the way depends on, where somebody wants to know.
    pins: Option<Pins>,
}

impl<'a> Cursor<'a> {
    /// A message of ROS 2: four bytes say the byte order, and alignment counts from behind them.
    pub(super) fn cdr(data: &'a [u8]) -> Result<Cursor<'a>, String> {
        let lowest_first = match data {
            [0, 0, _, _, ..] => false,
            [0, 1, _, _, ..] => true,
            [a, b, _, _, ..] => {
                return Err(format!(
                    "the bytes are laid out in the way {a:#04x} {b:#04x}; plain CDR, 0x00 0x00 or 0x00 0x01, is read"
                ));
            }
            _ => return Err("the message is shorter than its head".into()),
        };
        Ok(Cursor {
            data,
            at: 4,
            aligned_from: Some(4),
            lowest_first,
            pins: None,
        })
    }

    /// A message of ROS 1.
    pub(super) fn packed(data: &'a [u8]) -> Cursor<'a> {
        Cursor {
            data,
            at: 0,
            aligned_from: None,
            lowest_first: true,
            pins: None,
        }
    }

    /// From here on, what the way depends on is kept; the bytes before belong to it.
    pub(super) fn keep_pins(&mut self) {
        let mut pins = Pins::default();
        pins.add(0..self.at);
        self.pins = Some(pins);
    }

    pub(super) fn into_pins(self) -> Option<Pins> {
        self.pins
    }

    /// The way depends on the bytes since `start`.
    #[inline]
    fn pin(&mut self, start: usize) {
        if let Some(pins) = &mut self.pins {
            pins.add(start..self.at);
        }
    }

    #[inline]
    pub(super) fn left(&self) -> usize {
        self.data.len().saturating_sub(self.at)
    }

    #[inline]
    fn align(&mut self, size: usize) {
        if let Some(from) = self.aligned_from {
            // Sizes are powers of two.
            let mask = size.max(1) - 1;
            self.at = from + ((self.at.saturating_sub(from) + mask) & !mask);
        }
    }

    /// Passes over `count` things of `size` bytes.
    #[inline]
    pub(super) fn skip(&mut self, count: usize, size: usize) -> Result<(), String> {
        if count == 0 {
            return Ok(());
        }
        self.align(size);
        let bytes = count
            .checked_mul(size)
            .filter(|bytes| *bytes <= self.left());
        self.at += bytes.ok_or_else(too_short)?;
        Ok(())
    }

    /// How many elements a list says it has.
    #[inline]
    pub(super) fn count(&mut self) -> Result<usize, String> {
        self.align(4);
        let bytes = bytes(self.data, self.at, self.lowest_first).ok_or_else(too_short)?;
        self.at += bytes.len();
        self.pin(self.at - bytes.len());
        Ok(u32::from_le_bytes(bytes) as usize)
    }

    /// The bytes of a text, without the zero that may end it; `names` says whether places depend on it.
    #[inline]
    pub(super) fn text(&mut self, names: bool) -> Result<&'a [u8], String> {
        let count = self.count()?;
        let rest = self.data.get(self.at..).unwrap_or_default();
        let text = rest.get(..count).ok_or_else(too_short)?;
        self.at += count;
        if names {
            self.pin(self.at - count);
        }
        Ok(text.strip_suffix(&[0]).unwrap_or(text))
    }

    /// Hands the numbers of a list on.
    pub(super) fn numbers(
        &mut self,
        number: Number,
        count: usize,
        flat: &mut Flat,
    ) -> Result<(), String> {
        if let (Number::F64, true, false) = (number, self.lowest_first, flat.is_named())
            && count > 0
        {
            self.align(8);
            let start = self.at;
            self.skip(count, 8)?;
            let bytes = self.data.get(start..self.at).unwrap_or_default();
            let (numbers, _) = bytes.as_chunks::<8>();
            flat.list(numbers.iter().map(|bytes| f64::from_le_bytes(*bytes)));
            return Ok(());
        }
        for index in 0..count {
            flat.element(index);
            self.number(number, flat)?;
            flat.up();
        }
        Ok(())
    }

    /// Hands a number on.
    #[inline]
    pub(super) fn number(&mut self, number: Number, flat: &mut Flat) -> Result<(), String> {
        self.align(number.bytes());
        let (at, lowest_first) = (self.at, self.lowest_first);
        let value = number.read(self.data, at, lowest_first);
        let spot = Spot {
            number,
            at,
            lowest_first,
        };
        flat.number_at(value.ok_or_else(too_short)?, spot);
        self.at += number.bytes();
        Ok(())
    }
}

fn too_short() -> String {
    "the message ends before its definition does".into()
}
