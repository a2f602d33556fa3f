//! This file takes the numbers of one message out in a row, and says where each of them stands.

use std::hash::{DefaultHasher, Hasher};

use super::track::{Pins, Spot, Track};

/// Elements of a list that are looked into, unless a reader asks for more.
pub(super) const ELEMENTS: usize = 64;
/// The most numbers of one message.
const MOST_NUMBERS: usize = 4096;

/// The longest shape that is kept as it is, bytes; what is beyond is kept as a hash.
const LONGEST_SHAPE: usize = 4096;
/// The most texts of one message that may name numbers.
const MOST_TEXTS: usize = 1024;

/// A step down to a number.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Step {
    Field(String),
    Index(usize),
}

/// Where a number stands in a message.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Leaf {
    pub(super) path: Vec<Step>,
    /// What a list of texts beside a list of numbers calls an element: the step, the list's name and the text.
    pub(super) labels: Vec<(usize, String, String)>,
}

impl Leaf {
    /// The field of the message that it stands in.
    pub(super) fn field(&self) -> Option<&str> {
        match self.path.first() {
            Some(Step::Field(name)) => Some(name),
            _ => None,
        }
    }
}

/// The numbers of a message, and what their places depend on.
pub(super) struct Flat {
    pub(super) numbers: Vec<f64>,
    pub(super) elements: usize,
    shape: Vec<u8>,
    /// What did not fit into the shape.
    beyond: Option<DefaultHasher>,
    names: Option<Names>,
}

#[derive(Default)]
struct Names {
    path: Vec<Step>,
    leaves: Vec<Leaf>,
    texts: Vec<(Vec<Step>, String)>,
    /// Where the numbers stand in the bytes, for languages in which they have places of their own.
    spots: Vec<Spot>,
    track: Option<Track>,
}

impl Flat {
    pub(super) fn new(elements: usize) -> Flat {
        Flat {
            numbers: Vec::new(),
            elements,
            shape: Vec::new(),
            beyond: None,
            names: None,
        }
    }

    /// Begins a message; with `named`, the place of every number is kept.
    pub(super) fn begin(&mut self, named: bool) {
        self.numbers.clear();
        self.shape.clear();
        self.beyond = None;
        self.names = named.then(Names::default);
    }

    /// What the places depend on: messages with the same shape have their numbers at the same places.
    pub(super) fn shape(&mut self) -> &[u8] {
        if let Some(beyond) = self.beyond.take() {
            self.shape.extend(beyond.finish().to_le_bytes());
        }
        &self.shape
    }

    #[inline]
    pub(super) fn is_named(&self) -> bool {
        self.names.is_some()
    }

    /// The message was walked through by `pins`: so will others be that have the same there.
    pub(super) fn keep_track(&mut self, data: &[u8], pins: Pins) {
        if let Some(names) = &mut self.names {
            names.track = Track::new(data, pins, std::mem::take(&mut names.spots));
        }
    }

    /// The places of the numbers of a message begun with `named`, and the way to them where it can be taken again.
    pub(super) fn learned(&mut self) -> (Vec<Leaf>, Option<Track>) {
        let mut names = self.names.take().unwrap_or_default();
        let track = names.track.take();
        (names.into_leaves(), track)
    }

    /// A number and where it stands in the message.
    #[inline]
    pub(super) fn number_at(&mut self, value: f64, spot: Spot) {
        if let Some(names) = &mut self.names
            && self.numbers.len() < MOST_NUMBERS
        {
            names.spots.push(spot);
        }
        self.number(value);
    }

    #[inline]
    pub(super) fn number(&mut self, value: f64) {
        if self.numbers.len() >= MOST_NUMBERS {
            return;
        }
        self.numbers.push(value);
        if let Some(names) = &mut self.names {
            let path = names.path.clone();
            let labels = Vec::new();
            names.leaves.push(Leaf { path, labels });
        }
    }

    /// A text as an element of a list: it may name what stands at the same position of other lists.
    #[inline]
    pub(super) fn element_text(&mut self, text: &[u8]) {
        self.depends_on(text);
        if let Some(names) = &mut self.names
            && names.texts.len() < MOST_TEXTS
        {
            let text = String::from_utf8_lossy(text).into_owned();
            names.texts.push((names.path.clone(), text));
        }
    }

    /// The places depend on these bytes.
    #[inline]
    pub(super) fn depends_on(&mut self, bytes: &[u8]) {
        self.depends_on_count(bytes.len());
        self.add_to_shape(bytes);
    }

    #[inline]
    pub(super) fn depends_on_count(&mut self, count: usize) {
        self.add_to_shape(&count.to_le_bytes());
    }

    #[inline]
    fn add_to_shape(&mut self, bytes: &[u8]) {
        if self.shape.len() + bytes.len() <= LONGEST_SHAPE {
            self.shape.extend_from_slice(bytes);
        } else {
            self.beyond.get_or_insert_default().write(bytes);
        }
    }

    /// Numbers of a list, all of them looked into, whose places nobody wants to know.
    pub(super) fn list(&mut self, numbers: impl Iterator<Item = f64>) {
        let left = MOST_NUMBERS.saturating_sub(self.numbers.len());
        self.numbers.extend(numbers.take(left));
    }

    #[inline]
    pub(super) fn field(&mut self, name: &str) {
        if let Some(names) = &mut self.names {
            names.path.push(Step::Field(name.to_string()));
        }
    }

    #[inline]
    pub(super) fn element(&mut self, index: usize) {
        if let Some(names) = &mut self.names {
            names.path.push(Step::Index(index));
        }
    }

    /// Back up from a field or an element.
    #[inline]
    pub(super) fn up(&mut self) {
        if let Some(names) = &mut self.names {
            names.path.pop();
        }
    }
}

impl Names {
    /// Labels every element that a list of texts beside its own list names.
    fn into_leaves(self) -> Vec<Leaf> {
        let mut leaves = self.leaves;
        for leaf in &mut leaves {
            for (at, step) in leaf.path.iter().enumerate() {
                let (Step::Index(index), Some(parent)) = (step, at.checked_sub(1)) else {
                    continue;
                };
                let container = leaf.path.get(..parent).unwrap_or_default();
                let named = self.texts.iter().filter_map(|(path, text)| {
                    let (above, last) = path.split_at_checked(parent)?;
                    match last {
                        [Step::Field(list), Step::Index(other)]
                            if above == container && other == index =>
                        {
                            Some((at, list.clone(), text.clone()))
                        }
                        _ => None,
                    }
                });
                leaf.labels.extend(named);
            }
        }
        leaves
    }
}
