//! This file remembers where the numbers stand in messages of the shapes that came before.

use super::decoder::Decoder;
use super::flat::{Flat, Leaf};
use super::track::{Numbers, Track};

/// Shapes that are remembered for a channel; one that changes more often is worked out anew.
const SHAPES: usize = 64;

/// What is known of messages by their shape.
pub(super) struct Shapes<T> {
    known: Vec<(Vec<u8>, T)>,
    last: usize,
    /// The way through messages of one shape, by its place.
    track: Option<(usize, Track)>,
    /// Messages that were not on it.
    strayed: u64,
}

impl<T> Shapes<T> {
    pub(super) fn new() -> Shapes<T> {
        Shapes {
            known: Vec::new(),
            last: 0,
            track: None,
            strayed: 0,
        }
    }

    /// Reads a message: what is known of its shape, and its numbers. A shape that is new is learned first.
    ///
    /// # Errors
    /// The message cannot be read.
    #[inline]
    pub(super) fn read<'a>(
        &'a mut self,
        decoder: &Decoder,
        data: &'a [u8],
        flat: &'a mut Flat,
        learn: impl FnOnce(&[Leaf]) -> T,
    ) -> Result<Option<(&'a T, Numbers<'a>)>, String> {
        let on_track = |(_, track): &(usize, Track)| track.fits(data);
        if !self.track.as_ref().is_some_and(on_track) {
            self.walk(decoder, data, flat, learn)?;
            let known = self.known.get(self.last);
            return Ok(known.map(|(_, known)| (known, Numbers::Walked(&flat.numbers))));
        }
        Ok(self.track.as_ref().and_then(|(place, track)| {
            let (_, known) = self.known.get(*place)?;
            Some((known, Numbers::Tracked(track, data)))
        }))
    }

    /// Takes the numbers out, and afterwards the shape is the last one.
    fn walk(
        &mut self,
        decoder: &Decoder,
        data: &[u8],
        flat: &mut Flat,
        learn: impl FnOnce(&[Leaf]) -> T,
    ) -> Result<(), String> {
        decoder.read(data, flat, false)?;
        let is_new = !self.find(flat.shape());
        self.strayed += 1;
        // What strays again and again is looked at anew, ever more seldom: the first messages need not be like the rest.
        if !is_new && !self.strayed.is_power_of_two() {
            return Ok(());
        }
        decoder.read(data, flat, true)?;
        let (leaves, track) = flat.learned();
        if is_new {
            if self.known.len() >= SHAPES {
                self.known.clear();
            }
            self.last = self.known.len();
            self.known.push((flat.shape().to_vec(), learn(&leaves)));
        }
        self.track = track.map(|track| (self.last, track));
        Ok(())
    }

    /// Whether a shape is known; it is the last one then. Most messages look like the one before.
    fn find(&mut self, shape: &[u8]) -> bool {
        let is_it = |(known, _): &(Vec<u8>, T)| known == shape;
        if self.known.get(self.last).is_some_and(is_it) {
            return true;
        }
        let place = self.known.iter().position(is_it);
        self.last = place.unwrap_or(self.last);
        place.is_some()
    }
}

#[cfg(test)]
mod tests;
