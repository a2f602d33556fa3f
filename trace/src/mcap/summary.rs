//! This file says what is in an MCAP file, in one pass and bounded memory.

use std::collections::HashMap;
use std::fs::File;
use std::io::Read;
use std::path::Path;

use super::account::{Message, Visitor};
use super::address;
use super::clock::lag_s;
use super::decoder::Decoder;
use super::flat::{ELEMENTS, Flat, Leaf, Step};
use super::integrity::Integrity;
use super::pace::{Pace, median};
use super::shapes::Shapes;
use super::stream::walk;
use super::topics::Topic;
use crate::error::TraceError;

/// Stretches that a channel's picture is kept in.
const STRETCHES: usize = 128;
/// Messages whose own stamp is compared with the time of writing.
const STAMPS: usize = 4096;
/// Runs of four values that are kept of a number.
const RUNS: usize = 512;
/// Numbers of one channel that are followed.
const NUMBERS: usize = 1024;

/// What is in a file.
#[derive(Clone, Debug, PartialEq)]
pub struct Summary {
    /// Its channels, as they were declared.
    pub topics: Vec<TopicSummary>,
    /// Names of the tables of texts.
    pub metadata: Vec<String>,
    /// Names and sizes, in bytes, of the files inside.
    pub attachments: Vec<(String, u64)>,
    /// Check sums and what is missing.
    pub integrity: Integrity,
}

/// A channel and the numbers in its messages.
#[derive(Clone, Debug, PartialEq)]
pub struct TopicSummary {
    /// Its name.
    pub name: String,
    /// The language of its messages.
    pub encoding: String,
    /// The name of their type; empty when they have none.
    pub type_name: String,
    /// Messages.
    pub messages: u64,
    /// Messages that could not be read.
    pub damaged: u64,
    /// Why none of them can be read, where this is so.
    pub unreadable: Option<String>,
    /// Log time of the first message, ns.
    pub first_ns: u64,
    /// The latest log time, ns.
    pub last_ns: u64,
    /// The usual step of log time, s: the median of the first 4096; NaN for fewer than two messages.
    pub step_s: f64,
    /// The steps that 5 % and 95 % of those stay below, s.
    pub step_range_s: (f64, f64),
    /// Steps longer than [`super::GAP_STEPS`] usual ones.
    pub gaps: u64,
    /// The longest step, s.
    pub longest_step_s: f64,
    /// Messages written with an earlier time than the one before.
    pub backward: u64,
    /// How much later than their own stamp, `header.stamp`, messages were written, s; the median of the first 4096.
    pub lag_s: Option<f64>,
    /// The numbers, in the order of the messages.
    pub channels: Vec<ChannelSummary>,
}

/// One number of a channel's messages.
#[derive(Clone, Debug, PartialEq)]
pub struct ChannelSummary {
    /// Its address, as a rig description takes it.
    pub address: String,
    /// Its unit as its schema states it, or as its name suggests; empty when neither says anything.
    pub unit: String,
    /// Whether only its name suggests the unit.
    pub unit_is_guessed: bool,
    /// Finite values.
    pub count: u64,
    /// Values that are NaN or infinite.
    pub not_finite: u64,
    /// The least finite value; NaN when there is none.
    pub minimum: f64,
    /// The greatest finite value; NaN when there is none.
    pub maximum: f64,
    /// The smallest difference between two values that follow each other; `None` when it never moves.
    pub quantum: Option<f64>,
    /// Up to 512 runs of four values that follow each other, evenly spread; a value that is none is NaN.
    pub runs: Vec<[f64; 4]>,
    /// Least and greatest value of up to 128 stretches of equally many messages, in order.
    pub outline: Vec<(f64, f64)>,
}

/// Reads a file through and says what is in it.
///
/// # Errors
/// The file cannot be read or is no MCAP file; damage is in the account, not an error.
pub fn summary(path: &Path) -> Result<Summary, TraceError> {
    let file = File::open(path).map_err(TraceError::io("read", path))?;
    summarise(std::io::BufReader::with_capacity(1 << 18, file), path)
}

/// As [`summary`], from any source; `file` is what messages name.
///
/// # Errors
/// As [`summary`].
pub fn summarise(source: impl Read, file: &Path) -> Result<Summary, TraceError> {
    let mut pass = Pass {
        topics: Vec::new(),
        flat: Flat::new(ELEMENTS),
        metadata: Vec::new(),
        attachments: Vec::new(),
    };
    let (topics, integrity) = walk(source, file, &mut pass)?;
    let topics = pass.topics.into_iter().zip(topics);
    Ok(Summary {
        topics: topics.map(|(tally, topic)| tally.finish(&topic)).collect(),
        metadata: pass.metadata,
        attachments: pass.attachments,
        integrity,
    })
}

struct Pass {
    topics: Vec<Tally>,
    flat: Flat,
    metadata: Vec<String>,
    attachments: Vec<(String, u64)>,
}

/// What is known of a channel so far.
struct Tally {
    decoder: Result<Decoder, String>,
    name: String,
    messages: u64,
    damaged: u64,
    pace: Pace,
    lags_s: Vec<f64>,
    shapes: Shapes<Places>,
    numbers: Vec<Number>,
    by_address: HashMap<String, usize>,
}

/// Where the numbers of messages of one shape are counted.
struct Places {
    numbers: Vec<Option<usize>>,
    /// The places of the stamp's seconds and nanoseconds.
    stamp: Option<(usize, usize)>,
}

impl Visitor for Pass {
    fn topic(&mut self, _place: usize, topic: &Topic) {
        self.topics.push(Tally {
            decoder: Decoder::new(topic),
            name: topic.name.clone(),
            messages: 0,
            damaged: 0,
            pace: Pace::default(),
            lags_s: Vec::new(),
            shapes: Shapes::new(),
            numbers: Vec::new(),
            by_address: HashMap::new(),
        });
    }

    fn message(&mut self, message: Message<'_>) {
        if let Some(tally) = self.topics.get_mut(message.topic) {
            tally.messages += 1;
            tally.pace.add(message.log_time_ns);
            if tally.add(message, &mut self.flat).is_err() {
                tally.damaged += 1;
            }
        }
    }

    fn metadata(&mut self, name: &str) {
        if self.metadata.len() < NUMBERS {
            self.metadata.push(super::topics::short(name));
        }
    }

    fn attachment(&mut self, name: &str, bytes: u64) {
        if self.attachments.len() < NUMBERS {
            self.attachments.push((name.to_string(), bytes));
        }
    }
}

impl Tally {
    fn add(&mut self, message: Message<'_>, flat: &mut Flat) -> Result<(), String> {
        let Ok(decoder) = &self.decoder else {
            return Ok(());
        };
        let (numbers, by_address) = (&mut self.numbers, &mut self.by_address);
        let name = &self.name;
        let read = self.shapes.read(decoder, message.data, flat, |leaves| {
            let mut place = |leaf: &Leaf| {
                let address = address::print(name, leaf);
                if let Some(place) = by_address.get(&address) {
                    return Some(*place);
                }
                let place = numbers.len();
                (place < NUMBERS).then(|| {
                    numbers.push(Number::new(
                        &address,
                        decoder.unit(leaf),
                        decoder.stated_unit(leaf).is_empty(),
                    ));
                    by_address.insert(address, place);
                    place
                })
            };
            Places {
                numbers: leaves.iter().map(&mut place).collect(),
                stamp: stamp(leaves),
            }
        })?;
        let Some((places, values)) = read else {
            return Ok(());
        };
        for (at, place) in places.numbers.iter().enumerate() {
            if let Some(number) = place.and_then(|place| self.numbers.get_mut(place)) {
                number.add(values.at(at));
            }
        }
        if let (Some((s, ns)), true) = (places.stamp, self.lags_s.len() < STAMPS) {
            let lag_s = lag_s(message, values.at(s), values.at(ns));
            self.lags_s.push(lag_s);
        }
        Ok(())
    }

    fn finish(mut self, topic: &Topic) -> TopicSummary {
        self.pace.settle();
        let in_s = |ns: f64| ns * 1e-9;
        let lag_s = median(self.lags_s);
        TopicSummary {
            name: self.name,
            encoding: topic.encoding.clone(),
            type_name: topic
                .schema
                .as_ref()
                .map_or(String::new(), |s| s.name.clone()),
            messages: self.messages,
            damaged: self.damaged,
            unreadable: self.decoder.err(),
            first_ns: self.pace.first_ns(),
            last_ns: self.pace.last_ns(),
            step_s: in_s(self.pace.usual_ns()),
            step_range_s: (
                in_s(self.pace.quantile_ns(0.05)),
                in_s(self.pace.quantile_ns(0.95)),
            ),
            gaps: self.pace.gaps(),
            longest_step_s: in_s(self.pace.longest_ns() as f64),
            backward: self.pace.backward(),
            lag_s: lag_s.is_finite().then_some(lag_s),
            channels: self.numbers.into_iter().map(Number::finish).collect(),
        }
    }
}

/// Where the seconds and nanoseconds of `header.stamp` stand.
pub(super) fn stamp(leaves: &[Leaf]) -> Option<(usize, usize)> {
    let at = |names: &[&str]| {
        leaves.iter().position(|leaf| match leaf.path.as_slice() {
            [Step::Field(header), Step::Field(stamp), Step::Field(part)] => {
                header == "header" && stamp == "stamp" && names.contains(&part.as_str())
            }
            _ => false,
        })
    };
    Some((at(&["sec"])?, at(&["nanosec", "nsec"])?))
}

struct Number {
    address: String,
    unit: String,
    unit_is_guessed: bool,
    count: u64,
    not_finite: u64,
    minimum: f64,
    maximum: f64,
    last: f64,
    quantum: f64,
    runs: Vec<[f64; 4]>,
    /// Values from the start of one run to that of the next.
    run_step: u64,
    outline: Vec<(f64, f64)>,
    /// Values of a stretch, and how many of them are in the last one.
    stretch: u64,
    filled: u64,
}

impl Number {
    fn new(address: &str, unit: String, is_guessed: bool) -> Number {
        Number {
            address: address.to_string(),
            unit_is_guessed: is_guessed && !unit.is_empty(),
            unit,
            count: 0,
            not_finite: 0,
            minimum: f64::NAN,
            maximum: f64::NAN,
            last: f64::NAN,
            quantum: f64::INFINITY,
            runs: Vec::new(),
            run_step: 4,
            outline: Vec::new(),
            stretch: 1,
            filled: 0,
        }
    }

    fn add(&mut self, value: f64) {
        self.add_to_run(value);
        if !value.is_finite() {
            self.not_finite += 1;
            return;
        }
        self.count += 1;
        self.minimum = self.minimum.min(value);
        self.maximum = self.maximum.max(value);
        let step = (value - self.last).abs();
        if step > 0.0 && step < self.quantum {
            self.quantum = step;
        }
        self.last = value;
        match self.outline.last_mut() {
            Some((low, high)) if self.filled < self.stretch => {
                (*low, *high) = (low.min(value), high.max(value));
            }
            _ => {
                if self.outline.len() == STRETCHES {
                    self.halve();
                }
                self.outline.push((value, value));
                self.filled = 0;
            }
        }
        self.filled += 1;
    }

    fn add_to_run(&mut self, value: f64) {
        let place = (self.count + self.not_finite) % self.run_step;
        if place == 0 {
            if self.runs.len() == RUNS {
                let mut is_second = true;
                self.runs.retain(|_| {
                    is_second = !is_second;
                    !is_second
                });
                self.run_step *= 2;
            }
            self.runs.push([f64::NAN; 4]);
        }
        let place = usize::try_from(place).unwrap_or(usize::MAX);
        let run = self.runs.last_mut();
        if let Some(slot) = run.and_then(|run| run.get_mut(place)) {
            *slot = value;
        }
    }

    /// Joins two stretches to one each.
    fn halve(&mut self) {
        let pairs = self.outline.chunks(2).map(|pair| {
            let low = pair.iter().map(|(low, _)| *low);
            let high = pair.iter().map(|(_, high)| *high);
            (
                low.fold(f64::INFINITY, f64::min),
                high.fold(f64::NEG_INFINITY, f64::max),
            )
        });
        self.outline = pairs.collect();
        self.stretch *= 2;
    }

    fn finish(self) -> ChannelSummary {
        ChannelSummary {
            address: self.address,
            unit: self.unit,
            unit_is_guessed: self.unit_is_guessed,
            count: self.count,
            not_finite: self.not_finite,
            minimum: self.minimum,
            maximum: self.maximum,
            quantum: self.quantum.is_finite().then_some(self.quantum),
            runs: self.runs,
            outline: self.outline,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_are_neighbours_and_spread_over_everything() {
        let mut number = Number::new("/a.x", String::new(), false);
        for k in 0..70_001 {
            number.add(if k == 8193 {
                f64::INFINITY
            } else {
                f64::from(k) + 0.25
            });
        }
        let runs = number.finish().runs;
        assert!((RUNS / 2..=RUNS).contains(&runs.len()), "{}", runs.len());
        let step = runs[1][0] - runs[0][0];
        for (at, run) in runs.iter().enumerate().take(runs.len() - 1) {
            assert_eq!(run[0], at as f64 * step + 0.25);
            for (k, value) in run.iter().enumerate() {
                let missing = run[0] == 8192.25 && k == 1;
                assert!(*value == run[0] + k as f64 || missing, "{run:?}");
            }
        }
        assert!(runs[runs.len() - 1][0] > 69_000.0);
    }
}
