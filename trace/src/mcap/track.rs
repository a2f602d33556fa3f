//! This file remembers the way through a message, so that the next one of the same layout is not walked through again.

use std::ops::Range;

use super::ros::Number;

/// The most stretches that a layout may depend on: comparing more is no shorter than the walk.
const MOST_PINS: usize = 256;

/// Where a number stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Spot {
    pub(super) number: Number,
    pub(super) at: usize,
    pub(super) lowest_first: bool,
}

/// What a walk depends on while it goes: lengths of lists and texts, texts that name numbers, the order of bytes.
#[derive(Debug, Default)]
pub(super) struct Pins {
    places: Vec<Range<usize>>,
}

impl Pins {
    pub(super) fn add(&mut self, place: Range<usize>) {
        if let Some(last) = self.places.last_mut()
            && last.end == place.start
        {
            last.end = place.end;
        } else if self.places.len() <= MOST_PINS {
            // One more than may be says that there were too many.
            self.places.push(place);
        }
    }
}

/// The way through messages of one layout.
#[derive(Debug)]
pub(super) struct Track {
    length: usize,
    pins: Vec<Range<usize>>,
    /// What stood there, one after another.
    pinned: Vec<u8>,
    spots: Vec<Spot>,
}

impl Track {
    /// The way that a walk through this message took, or `None` where it depends on too much.
    pub(super) fn new(data: &[u8], pins: Pins, spots: Vec<Spot>) -> Option<Track> {
        let pins = Some(pins.places).filter(|pins| pins.len() <= MOST_PINS)?;
        let stretches = pins.iter().map(|pin| data.get(pin.clone()));
        let pinned: Option<Vec<&[u8]>> = stretches.collect();
        Some(Track {
            length: data.len(),
            pinned: pinned?.concat(),
            pins,
            spots,
        })
    }

    /// Whether a walk through this message would take the same way: everything that it depends on is the same.
    #[inline]
    pub(super) fn fits(&self, data: &[u8]) -> bool {
        let mut pinned = self.pinned.as_slice();
        data.len() == self.length
            && self.pins.iter().all(|pin| {
                let Some((expected, rest)) = pinned.split_at_checked(pin.len()) else {
                    return false;
                };
                pinned = rest;
                data.get(pin.clone()) == Some(expected)
            })
    }

    #[inline]
    fn number(&self, place: usize, data: &[u8]) -> Option<f64> {
        let spot = self.spots.get(place)?;
        spot.number.read(data, spot.at, spot.lowest_first)
    }
}

/// The numbers of a message, however they are come by.
#[derive(Clone, Copy)]
pub(super) enum Numbers<'a> {
    /// Taken out one after another.
    Walked(&'a [f64]),
    /// Still where they stand.
    Tracked(&'a Track, &'a [u8]),
}

impl Numbers<'_> {
    /// The number at that place of the row; NaN where there is none.
    #[inline]
    pub(super) fn at(&self, place: usize) -> f64 {
        let number = match self {
            Numbers::Walked(numbers) => numbers.get(place).copied(),
            Numbers::Tracked(track, data) => track.number(place, data),
        };
        number.unwrap_or(f64::NAN)
    }
}
