//! This file is a number as it stands in the bytes of a message.

/// A kind of number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::mcap) enum Number {
    Bool,
    U8,
    I8,
    U16,
    I16,
    U32,
    I32,
    U64,
    I64,
    F32,
    F64,
}

impl Number {
    pub(in crate::mcap) const fn bytes(self) -> usize {
        match self {
            Number::Bool | Number::U8 | Number::I8 => 1,
            Number::U16 | Number::I16 => 2,
            Number::U32 | Number::I32 | Number::F32 => 4,
            Number::U64 | Number::I64 | Number::F64 => 8,
        }
    }

    /// The number that stands there, or `None` where the bytes end before it does.
    #[inline]
    pub(in crate::mcap) fn read(self, data: &[u8], at: usize, lowest_first: bool) -> Option<f64> {
        Some(match self {
            Number::Bool => f64::from(u8::from(bytes(data, at, lowest_first)? != [0])),
            Number::U8 => f64::from(u8::from_le_bytes(bytes(data, at, lowest_first)?)),
            Number::I8 => f64::from(i8::from_le_bytes(bytes(data, at, lowest_first)?)),
            Number::U16 => f64::from(u16::from_le_bytes(bytes(data, at, lowest_first)?)),
            Number::I16 => f64::from(i16::from_le_bytes(bytes(data, at, lowest_first)?)),
            Number::U32 => f64::from(u32::from_le_bytes(bytes(data, at, lowest_first)?)),
            Number::I32 => f64::from(i32::from_le_bytes(bytes(data, at, lowest_first)?)),
            Number::U64 => u64::from_le_bytes(bytes(data, at, lowest_first)?) as f64,
            Number::I64 => i64::from_le_bytes(bytes(data, at, lowest_first)?) as f64,
            Number::F32 => f64::from(f32::from_le_bytes(bytes(data, at, lowest_first)?)),
            Number::F64 => f64::from_le_bytes(bytes(data, at, lowest_first)?),
        })
    }
}

/// Bytes in the order of the lowest first.
#[inline]
pub(super) fn bytes<const N: usize>(data: &[u8], at: usize, lowest_first: bool) -> Option<[u8; N]> {
    let mut bytes = *data.get(at..)?.first_chunk::<N>()?;
    if !lowest_first {
        bytes.reverse();
    }
    Some(bytes)
}
