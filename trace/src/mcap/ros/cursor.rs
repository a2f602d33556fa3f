//! This file reads numbers and texts out of bytes, never past their end.

use super::definition::Number;
use crate::mcap::flat::Flat;

/// A place in a message.
pub(super) struct Cursor<'a> {
    data: &'a [u8],
    at: usize,
    /// Where multiples of a number's size are counted from; none where numbers stand close together.
    aligned_from: Option<usize>,
    lowest_first: bool,
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
        })
    }

    /// A message of ROS 1.
    pub(super) fn packed(data: &'a [u8]) -> Cursor<'a> {
        Cursor {
            data,
            at: 0,
            aligned_from: None,
            lowest_first: true,
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

    #[inline]
    fn take<const N: usize>(&mut self) -> Result<[u8; N], String> {
        self.align(N);
        let rest = self.data.get(self.at..).unwrap_or_default();
        let mut bytes = *rest.first_chunk::<N>().ok_or_else(too_short)?;
        self.at += N;
        if !self.lowest_first {
            bytes.reverse();
        }
        Ok(bytes)
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
        Ok(u32::from_le_bytes(self.take()?) as usize)
    }

    /// The bytes of a text, without the zero that may end it.
    #[inline]
    pub(super) fn text(&mut self) -> Result<&'a [u8], String> {
        let count = self.count()?;
        let rest = self.data.get(self.at..).unwrap_or_default();
        let text = rest.get(..count).ok_or_else(too_short)?;
        self.at += count;
        Ok(text.strip_suffix(&[0]).unwrap_or(text))
    }

    /// Hands the numbers of a list on.
    pub(super) fn numbers(
        &mut self,
        number: Number,
        count: usize,
        flat: &mut Flat,
    ) -> Result<(), String> {
        if let (Number::F64, true, true) = (number, self.lowest_first, count > 0) {
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
            flat.number(self.number(number)?);
            flat.up();
        }
        Ok(())
    }

    #[inline]
    pub(super) fn number(&mut self, number: Number) -> Result<f64, String> {
        Ok(match number {
            Number::Bool => f64::from(u8::from(self.take::<1>()? != [0])),
            Number::U8 => f64::from(u8::from_le_bytes(self.take()?)),
            Number::I8 => f64::from(i8::from_le_bytes(self.take()?)),
            Number::U16 => f64::from(u16::from_le_bytes(self.take()?)),
            Number::I16 => f64::from(i16::from_le_bytes(self.take()?)),
            Number::U32 => f64::from(u32::from_le_bytes(self.take()?)),
            Number::I32 => f64::from(i32::from_le_bytes(self.take()?)),
            Number::U64 => u64::from_le_bytes(self.take()?) as f64,
            Number::I64 => i64::from_le_bytes(self.take()?) as f64,
            Number::F32 => f64::from(f32::from_le_bytes(self.take()?)),
            Number::F64 => f64::from_le_bytes(self.take()?),
        })
    }
}

fn too_short() -> String {
    "the message ends before its definition does".into()
}
