//! This file collects the wanted numbers of every channel while a file passes.

use std::collections::HashMap;

use super::account::{Message, Visitor};
use super::address::{self, Way, within};
use super::clock::{Clock, Origin, Rate, Slot};
use super::decoder::Decoder;
use super::flat::{ELEMENTS, Flat, Leaf};
use super::pace::median;
use super::read::{Selection, Wanted};
use super::resample::{Between, Ordered, went_back};
use super::run::Run;
use super::shapes::Shapes;
use super::summary::stamp;
use super::topics::Topic;
use crate::budget;
use crate::csv::TimeColumn;

/// Addresses of a topic that a message names.
const NAMED: usize = 64;
/// How far the time of writing may run from the stamps, as a share.
const SAME_SPEED: f64 = 0.01;
/// Messages whose own stamp is compared with the time of writing.
const STAMPS: usize = 4096;

/// Everything collected.
pub(super) struct Feeds {
    pub(super) wanted: Vec<Wanted>,
    pub(super) feeds: Vec<Feed>,
    /// Names of the topics, as they were declared.
    pub(super) topics: Vec<String>,
    takes_run: bool,
    time: Option<TimeColumn>,
    origin: Origin,
    flat: Flat,
    readers: Vec<Option<Reader>>,
    refusals: HashMap<String, String>,
    addresses: HashMap<String, Vec<String>>,
    /// Numbers that are held, and the most that may be.
    held: u64,
    most: u64,
}

/// The samples of one topic.
pub(super) struct Feed {
    pub(super) time_s: Vec<f64>,
    /// A column for each way, NaN where a message lacks the number.
    pub(super) columns: Vec<Vec<f64>>,
    name: String,
    clock: Clock,
    /// The number of the wanted one, and the way to it.
    ways: Vec<(usize, Way)>,
    units: Vec<Option<String>>,
    lags_s: Vec<f64>,
    rate: Rate,
    damaged: usize,
}

/// Where a wanted number was collected.
#[derive(Clone, Copy)]
pub(super) struct WantedPlace {
    pub(super) feed: usize,
    pub(super) column: usize,
}

/// One channel of a topic; a topic may have several.
struct Reader {
    feed: usize,
    decoder: Decoder,
    shapes: Shapes<Slots>,
    /// Elements of a list that are looked into.
    elements: usize,
}

/// Where the wanted numbers of messages of one shape stand.
struct Slots {
    time: Option<Slot>,
    columns: Vec<Option<usize>>,
    stamp: Option<(usize, usize)>,
}

impl Feeds {
    pub(super) fn new(selection: &Selection) -> Feeds {
        Feeds {
            wanted: selection.channels.clone(),
            feeds: Vec::new(),
            topics: Vec::new(),
            takes_run: selection.channels.is_empty(),
            time: selection.time.clone(),
            origin: Origin::default(),
            flat: Flat::new(ELEMENTS),
            readers: Vec::new(),
            refusals: HashMap::new(),
            addresses: HashMap::new(),
            held: 0,
            most: budget::held() / 8,
        }
    }

    /// What the chosen numbers take, bytes, where that is more than a reader may hold.
    pub(super) fn beyond(&self) -> Option<u64> {
        (self.held > self.most).then(|| self.held.saturating_mul(8))
    }

    /// Where each wanted number was found first.
    pub(super) fn places(&self) -> Vec<Option<WantedPlace>> {
        let mut places = vec![None; self.wanted.len()];
        for (feed, content) in self.feeds.iter().enumerate() {
            let ways = content.ways.iter().zip(&content.units).enumerate();
            for (column, ((wanted, _), _)) in ways.filter(|(_, (_, unit))| unit.is_some()) {
                if let Some(place) = places.get_mut(*wanted) {
                    place.get_or_insert(WantedPlace { feed, column });
                }
            }
        }
        places
    }

    pub(super) fn unit(&self, place: WantedPlace) -> String {
        let feed = self.feeds.get(place.feed);
        let unit = feed.and_then(|feed| feed.units.get(place.column)?.clone());
        unit.unwrap_or_default()
    }

    /// The times of a topic, which are no longer here afterwards.
    pub(super) fn take_times(&mut self, place: WantedPlace) -> Vec<f64> {
        let feed = self.feeds.get_mut(place.feed);
        feed.map_or(Vec::new(), |feed| std::mem::take(&mut feed.time_s))
    }

    /// The samples of a wanted number, which are no longer here afterwards; no two wanted ones share a column.
    pub(super) fn take_column(&mut self, place: WantedPlace) -> Vec<f64> {
        let feed = self.feeds.get_mut(place.feed);
        let column = feed.and_then(|feed| feed.columns.get_mut(place.column));
        column.map(std::mem::take).unwrap_or_default()
    }

    /// Why a topic cannot be read, if it cannot.
    pub(super) fn why_not(&self, topic: &str) -> Option<&str> {
        self.refusals.get(topic).map(String::as_str)
    }

    /// The numbers of a topic that is read.
    pub(super) fn addresses(&self, topic: &str) -> &[String] {
        self.addresses.get(topic).map_or(&[], Vec::as_slice)
    }

    /// Why the times of a topic cannot be those of its samples, if so: the file was written slower or faster than its messages
    /// are stamped, or the clock was set back.
    pub(super) fn clock_fault(&self, place: WantedPlace, time_s: &[f64]) -> Option<String> {
        let feed = self.feeds.get(place.feed)?;
        let name = &feed.name;
        let by_writing = matches!(feed.clock, Clock::Log | Clock::Publish);
        let ratio = feed
            .rate
            .ratio()
            .filter(|ratio| by_writing && (ratio - 1.0).abs() > SAME_SPEED);
        if let Some(ratio) = ratio {
            return Some(format!(
                "the messages of `{name}` were written in {ratio:.3} times the time that their own stamps span, as a bag that was played at another speed and recorded again is; take the stamps: `time = {{ channel = \"header.stamp\" }}` in the rig file, or `--time-from header.stamp`"
            ));
        }
        let back = went_back(time_s)?;
        Some(format!(
            "the clock of `{name}` went back by {:.3} s after {:.6} s, and {} messages follow before it gets there again; take another clock (`publish_time`, or a stamp in the messages: `time = {{ channel = \"header.stamp\" }}` in the rig file, `--time-from header.stamp`), or cut the file there",
            back.by_s, back.after_s, back.messages
        ))
    }

    /// How the times of a feed came about.
    pub(super) fn time_lines(&self, place: WantedPlace, ordered: &Ordered) -> Vec<String> {
        let Some(feed) = self.feeds.get(place.feed) else {
            return Vec::new();
        };
        let name = &feed.name;
        let clock = feed.clock.name(self.time.as_ref());
        let from = match self.origin.second() {
            0 => String::new(),
            from_s => format!(", counted from {from_s} s"),
        };
        let mut lines = vec![format!("time of `{name}`: {clock}{from}")];
        let mut say = |count: usize, what: &str| {
            if count > 0 {
                lines.push(format!("{count} messages of `{name}` {what}"));
            }
        };
        say(
            ordered.moved,
            "came after a later one; they were put in order",
        );
        say(
            ordered.dropped,
            "have no time of their own; of equal times the first counts",
        );
        say(feed.damaged, "could not be read");
        let lag_ms = 1e3 * median(feed.lags_s.clone());
        if lag_ms.is_finite() && feed.clock == Clock::Log {
            lines.push(format!(
                "`{name}` was written {lag_ms:.3} ms after its own stamps (median); `header.stamp` as time uses those"
            ));
        }
        lines
    }

    fn feed_of(&mut self, topic: &Topic) -> Option<usize> {
        if let Some(place) = self.feeds.iter().position(|feed| feed.name == topic.name) {
            return Some(place);
        }
        let run = Run::of(topic);
        if self.takes_run && self.wanted.is_empty() {
            let columns = run.iter().flat_map(|run| &run.columns);
            self.wanted.extend(columns.map(|column| Wanted {
                address: column.name.clone(),
                between: Between::Line,
            }));
        }
        let columns = run.iter().flat_map(|run| run.columns.iter().rev());
        // Of two with one name the first.
        let keys: HashMap<&str, &str> = columns
            .map(|column| (column.name.as_str(), column.key.as_str()))
            .collect();
        let mut ways = Vec::new();
        for (place, wanted) in self.wanted.iter().enumerate() {
            let inside = within(&wanted.address, &topic.name).and_then(Way::parse);
            let named = || Some(Way::field(keys.get(wanted.address.as_str())?));
            ways.extend(inside.or_else(named).map(|way| (place, way)));
        }
        let own = run.as_ref().map(|run| run.time.as_str());
        let clock = Clock::new(self.time.as_ref(), &topic.name, own);
        if ways.is_empty() {
            return None;
        }
        self.feeds.push(Feed {
            time_s: Vec::new(),
            columns: vec![Vec::new(); ways.len()],
            name: topic.name.clone(),
            clock: clock?,
            units: vec![None; ways.len()],
            ways,
            lags_s: Vec::new(),
            rate: Rate::default(),
            damaged: 0,
        });
        Some(self.feeds.len() - 1)
    }
}

impl Visitor for Feeds {
    fn is_full(&self) -> bool {
        self.beyond().is_some()
    }

    fn topic(&mut self, _place: usize, topic: &Topic) {
        self.topics.push(topic.name.clone());
        let reader = self.feed_of(topic).and_then(|feed| {
            let ways = self.feeds.get(feed)?.ways.iter();
            let elements = ways
                .map(|(_, way)| way.elements())
                .fold(ELEMENTS, usize::max);
            match Decoder::new(topic) {
                Ok(decoder) => Some(Reader {
                    feed,
                    decoder,
                    shapes: Shapes::new(),
                    elements,
                }),
                Err(reason) => {
                    self.refusals.insert(topic.name.clone(), reason);
                    None
                }
            }
        });
        self.readers.push(reader);
    }

    fn message(&mut self, message: Message<'_>) {
        let Some(Some(reader)) = self.readers.get_mut(message.topic) else {
            return;
        };
        let Some(feed) = self.feeds.get_mut(reader.feed) else {
            return;
        };
        self.held += 1 + feed.columns.len() as u64;
        if self.held > self.most {
            return;
        }
        let addresses = &mut self.addresses;
        self.flat.elements = reader.elements;
        let decoder = &reader.decoder;
        let read = reader
            .shapes
            .read(decoder, message.data, &mut self.flat, |leaves| {
                let named = leaves.iter().take(NAMED);
                let printed = named.map(|leaf| address::print(&feed.name, leaf));
                addresses.insert(feed.name.clone(), printed.collect());
                feed.slots(leaves, decoder)
            });
        let (slots, numbers) = match read {
            Ok(Some(read)) => read,
            Ok(None) => return,
            Err(reason) => {
                feed.damaged += 1;
                self.refusals.entry(feed.name.clone()).or_insert(reason);
                return;
            }
        };
        let time_s = match slots.time {
            Some(slot) => self.origin.time_s(slot, message, numbers),
            None => f64::NAN,
        };
        feed.time_s.push(time_s);
        for (column, slot) in feed.columns.iter_mut().zip(&slots.columns) {
            column.push(slot.map_or(f64::NAN, |place| numbers.at(place)));
        }
        if let Some((s, ns)) = slots.stamp {
            feed.rate
                .add(message.log_time_ns, numbers.at(s), numbers.at(ns));
        }
        if let (Some((s, ns)), true) = (slots.stamp, feed.lags_s.len() < STAMPS) {
            let lag_s = super::clock::lag_s(message, numbers.at(s), numbers.at(ns));
            feed.lags_s.push(lag_s);
        }
    }
}

impl Feed {
    /// Finds out where the numbers stand in messages of one shape.
    fn slots(&mut self, leaves: &[Leaf], decoder: &Decoder) -> Slots {
        let mut columns = Vec::new();
        // By their first field, so that not every way is held to every number.
        let mut by_field: HashMap<Option<&str>, Vec<usize>> = HashMap::new();
        for (place, leaf) in leaves.iter().enumerate() {
            by_field.entry(leaf.field()).or_default().push(place);
        }
        for ((_, way), unit) in self.ways.iter().zip(&mut self.units) {
            let own = by_field.get(&way.first()).into_iter().flatten().copied();
            let leads = |place: &usize| leaves.get(*place).is_some_and(|leaf| way.leads_to(leaf));
            let place = own.into_iter().find(leads);
            if let Some(leaf) = place.and_then(|place| leaves.get(place)) {
                unit.get_or_insert_with(|| decoder.stated_unit(leaf));
            }
            columns.push(place);
        }
        Slots {
            time: self.clock.slot(leaves, decoder),
            columns,
            stamp: stamp(leaves),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;
    use std::sync::Arc;

    use super::*;
    use crate::mcap::topics::Schema;

    #[test]
    fn an_address_far_down_another_topics_list_moves_no_number() {
        let topic = |name: &str| {
            let schema = Schema {
                name: "a/msg/Lists".into(),
                encoding: "ros2msg".into(),
                data: b"float64[] x\nfloat64 y\n".to_vec(),
            };
            Topic::new(name, "cdr", Some(Arc::new(schema)), BTreeMap::new())
        };
        let wanted = |address: &str| Wanted {
            address: address.into(),
            between: Between::Line,
        };
        let mut feeds = Feeds::new(&Selection {
            channels: vec![wanted("/a.y"), wanted("/b.x[150]")],
            time: None,
        });
        let mut data = [[0, 1, 0, 0], 200_u32.to_le_bytes(), [0; 4]].concat();
        for k in 0..=200 {
            data.extend((0.25 + f64::from(k)).to_le_bytes());
        }
        let message = |topic: usize| Message {
            topic,
            log_time_ns: 7,
            publish_time_ns: 11,
            data: &data,
        };
        feeds.topic(0, &topic("/a"));
        feeds.message(message(0));
        feeds.topic(1, &topic("/b"));
        for topic in [0, 1, 0, 0] {
            feeds.message(message(topic));
        }
        assert_eq!(feeds.feeds[0].columns, [[200.25; 4]]);
        assert_eq!(feeds.feeds[1].columns, [[150.25]]);
    }

    #[test]
    fn a_clock_that_does_not_tell_when_is_named_with_the_one_that_does() {
        let fault = |log_ms: &dyn Fn(u64) -> u64| {
            let mut feeds = Feeds::new(&Selection {
                channels: vec![Wanted {
                    address: "/a.y".into(),
                    between: Between::Line,
                }],
                time: None,
            });
            feeds.topic(0, &Topic::new("/a", "json", None, BTreeMap::new()));
            for k in 0..900 {
                let data = format!(
                    "{{\"header\": {{\"stamp\": {{\"sec\": 170, \"nanosec\": {}}}}}, \"y\": 2.5}}",
                    k * 1_000_000
                );
                feeds.message(Message {
                    topic: 0,
                    log_time_ns: 1_000_000 * log_ms(k),
                    publish_time_ns: 11,
                    data: data.as_bytes(),
                });
            }
            let place = feeds.places()[0].unwrap();
            let stamps = feeds.take_times(place);
            feeds.clock_fault(place, &stamps)
        };
        assert_eq!(fault(&|k| 5000 + k), None);
        assert_eq!(fault(&|k| 5000 + k + k / 300), None);
        for (pace, said) in [
            (2, "in 2.000 times the time"),
            (5, "in 5.000 times"),
            (10, "in 10.000 times"),
        ] {
            let message = fault(&|k| 5000 + pace * k).unwrap();
            assert!(
                message.contains(said) && message.contains("`--time-from header.stamp`"),
                "{message}"
            );
        }
        let message = fault(&|k| {
            if k == 899 {
                5899
            } else {
                5000 + k - if k > 400 { 300 } else { 0 }
            }
        })
        .unwrap();
        assert!(
            message.contains("went back by 0.299 s after 5.400000 s, and 299 messages follow"),
            "{message}"
        );
    }
}
