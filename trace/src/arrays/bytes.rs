//! This file takes the elements of a MATLAB file apart: a tag says kind and length, bytes follow.

/// An array with its header.
pub(super) const MATRIX: u32 = 14;
/// Another element, deflated.
pub(super) const COMPRESSED: u32 = 15;

/// Bytes that are read from the front.
#[derive(Clone, Copy)]
pub(super) struct Bytes<'a> {
    bytes: &'a [u8],
    /// Whether the high byte stands first.
    big: bool,
}

impl<'a> Bytes<'a> {
    pub(super) fn new(bytes: &'a [u8], big: bool) -> Bytes<'a> {
        Bytes { bytes, big }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.bytes.is_empty()
    }

    pub(super) fn is_big(&self) -> bool {
        self.big
    }

    pub(super) fn rest(&self) -> &'a [u8] {
        self.bytes
    }

    fn take(&mut self, count: usize) -> Option<&'a [u8]> {
        let (taken, rest) = self.bytes.split_at_checked(count)?;
        self.bytes = rest;
        Some(taken)
    }

    /// The next four bytes as a number.
    pub(super) fn word(&mut self) -> Option<u32> {
        let bytes = self.take(4)?.try_into().ok()?;
        Some(match self.big {
            true => u32::from_be_bytes(bytes),
            false => u32::from_le_bytes(bytes),
        })
    }

    /// The next element: its kind and its bytes.
    pub(super) fn element(&mut self) -> Option<(u32, Bytes<'a>)> {
        let word = self.word()?;
        let (kind, bytes) = match word >> 16 {
            0 => {
                let length = usize::try_from(self.word()?).ok()?;
                let bytes = self.take(length)?;
                if word != COMPRESSED {
                    // The last element of a file may lack its padding.
                    let padding = (8 - length % 8) % 8;
                    self.take(padding.min(self.bytes.len()))?;
                }
                (word, bytes)
            }
            // A small element: kind and length share a word, the bytes stand in the next.
            length => {
                let bytes = self.take(4)?.get(..usize::try_from(length).ok()?)?;
                (word & 0xffff, bytes)
            }
        };
        Some((kind, Bytes { bytes, ..*self }))
    }

    /// All bytes as the sizes of an array.
    pub(super) fn sizes(mut self) -> Option<Vec<usize>> {
        let mut sizes = Vec::new();
        while !self.is_empty() {
            sizes.push(usize::try_from(self.word()?).ok()?);
        }
        Some(sizes)
    }
}

/// Numbers as they stand in the file.
#[derive(Debug)]
pub(super) struct Numbers {
    bytes: Vec<u8>,
    big: bool,
    kind: Kind,
}

#[derive(Clone, Copy, Debug)]
enum Kind {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
    I64,
    U64,
}

impl Kind {
    fn of(kind: u32) -> Option<Kind> {
        use Kind::*;
        [
            (1, I8),
            (2, U8),
            (3, I16),
            (4, U16),
            (5, I32),
            (6, U32),
            (7, F32),
            (9, F64),
            (12, I64),
            (13, U64),
        ]
        .into_iter()
        .find(|(number, _)| *number == kind)
        .map(|(_, kind)| kind)
    }

    const fn width(self) -> usize {
        match self {
            Kind::I8 | Kind::U8 => 1,
            Kind::I16 | Kind::U16 => 2,
            Kind::I32 | Kind::U32 | Kind::F32 => 4,
            Kind::F64 | Kind::I64 | Kind::U64 => 8,
        }
    }
}

impl Numbers {
    /// `None` for what is no kind of number.
    pub(super) fn new(kind: u32, bytes: Bytes<'_>) -> Option<Numbers> {
        Some(Numbers {
            kind: Kind::of(kind)?,
            big: bytes.big,
            bytes: bytes.bytes.to_vec(),
        })
    }

    pub(super) fn len(&self) -> usize {
        self.bytes.len() / self.kind.width()
    }

    pub(super) fn values(&self) -> Vec<f64> {
        let width = self.kind.width();
        self.bytes
            .chunks_exact(width)
            .map(|bytes| self.value(bytes))
            .collect()
    }

    fn value(&self, bytes: &[u8]) -> f64 {
        // The value's bytes, low byte first, in the front of eight.
        let mut low = [0; 8];
        for (place, byte) in low.iter_mut().zip(bytes) {
            *place = *byte;
        }
        if self.big
            && let Some(own) = low.get_mut(..bytes.len())
        {
            own.reverse();
        }
        let [a, b, c, d, ..] = low;
        match self.kind {
            Kind::I8 => i8::from_le_bytes([a]).into(),
            Kind::U8 => a.into(),
            Kind::I16 => i16::from_le_bytes([a, b]).into(),
            Kind::U16 => u16::from_le_bytes([a, b]).into(),
            Kind::I32 => i32::from_le_bytes([a, b, c, d]).into(),
            Kind::U32 => u32::from_le_bytes([a, b, c, d]).into(),
            Kind::F32 => f32::from_le_bytes([a, b, c, d]).into(),
            Kind::F64 => f64::from_le_bytes(low),
            Kind::I64 => i64::from_le_bytes(low) as f64,
            Kind::U64 => u64::from_le_bytes(low) as f64,
        }
    }
}
