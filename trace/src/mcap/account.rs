//! This file takes the records of a file in and keeps the account of what is missing.

use ::mcap::parse_record;
use ::mcap::records::{Record, op};

use super::integrity::Integrity;
use super::topics::{Topic, Topics};

/// What a pass over a file is made for.
pub(super) trait Visitor {
    /// A channel was declared; `place` counts them from 0.
    fn topic(&mut self, place: usize, topic: &Topic);
    /// A message of a channel.
    fn message(&mut self, message: Message<'_>);
    /// A named table of texts.
    fn metadata(&mut self, _name: &str) {}
    /// A file inside the file.
    fn attachment(&mut self, _name: &str, _bytes: u64) {}
    /// Whether it holds all that it may: the rest of the file is not read then.
    fn is_full(&self) -> bool {
        false
    }
}

/// One message.
#[derive(Clone, Copy)]
pub(super) struct Message<'a> {
    /// The place of its channel.
    pub(super) topic: usize,
    pub(super) log_time_ns: u64,
    pub(super) publish_time_ns: u64,
    pub(super) data: &'a [u8],
}

/// The parts of a file.
#[derive(Clone, Copy, Default, PartialEq, Eq)]
pub(super) enum Section {
    #[default]
    Data,
    Summary,
}

/// What was read and what was not.
pub(super) struct Account<'v, V> {
    pub(super) visitor: &'v mut V,
    pub(super) topics: Topics,
    pub(super) integrity: Integrity,
    pub(super) section: Section,
    /// A chunk that was left out, and its messages as the indexes after it count them.
    lost: Option<(String, u64)>,
    /// Messages of channels that nobody declared, or twice.
    strangers: u64,
}

impl<'v, V: Visitor> Account<'v, V> {
    pub(super) fn new(visitor: &'v mut V) -> Account<'v, V> {
        Account {
            visitor,
            topics: Topics::default(),
            integrity: Integrity::default(),
            section: Section::default(),
            lost: None,
            strangers: 0,
        }
    }

    /// Takes in a record that stands in the file or in a chunk.
    pub(super) fn record(&mut self, kind: u8, content: &[u8]) {
        match (kind, self.section) {
            (op::MESSAGE, Section::Data) => self.message(content),
            (op::SCHEMA | op::CHANNEL | op::METADATA, Section::Data) => {
                self.declared(kind, content)
            }
            (op::MESSAGE_INDEX, Section::Data) => {
                if let Some((_, count)) = &mut self.lost {
                    // A channel's number and a length, then a time and a place for each message.
                    *count += content.len().saturating_sub(6) as u64 / 16;
                }
            }
            (op::STATISTICS, Section::Summary) => {
                let count = content
                    .first_chunk()
                    .map(|bytes| u64::from_le_bytes(*bytes));
                self.integrity.announced = count;
            }
            _ => {}
        }
    }

    fn message(&mut self, content: &[u8]) {
        let fields = content.split_first_chunk::<22>();
        let Some((&[a, b, _, _, _, _, times @ ..], data)) = fields else {
            self.integrity
                .miss("a message is shorter than its head".into());
            return;
        };
        let Some(topic) = self.topics.place(u16::from_le_bytes([a, b])) else {
            self.strangers += 1;
            return;
        };
        let (log, publish) = times.split_at(8);
        let time = |bytes: &[u8]| bytes.try_into().map_or(0, u64::from_le_bytes);
        self.integrity.messages += 1;
        self.visitor.message(Message {
            topic,
            log_time_ns: time(log),
            publish_time_ns: time(publish),
            data,
        });
    }

    fn declared(&mut self, kind: u8, content: &[u8]) {
        let result = match parse_record(kind, content) {
            Ok(Record::Schema { header, data }) => self.topics.add_schema(header, &data),
            Ok(Record::Channel(channel)) => self.topics.add_channel(channel).map(|new| {
                if let Some((place, topic)) = new {
                    self.visitor.topic(place, topic);
                }
            }),
            Ok(Record::Metadata(metadata)) => {
                self.visitor.metadata(&metadata.name);
                Ok(())
            }
            _ => Err("a schema, a channel or a table of texts breaks the format".into()),
        };
        if let Err(line) = result {
            self.integrity.miss(line);
        }
    }

    /// A chunk was left out; the indexes that follow say of how many messages.
    pub(super) fn lose(&mut self, line: String) {
        self.tell_lost();
        self.lost = Some((line, 0));
    }

    /// Says what the chunk left out last held, once no index of it can follow.
    pub(super) fn tell_lost(&mut self) {
        if let Some((line, count)) = self.lost.take() {
            let count = match count {
                0 => "its messages are lost".to_string(),
                count => format!("{count} messages are lost"),
            };
            self.integrity.miss(format!("{line}; {count}"));
        }
    }

    /// Settles the account at the end of the file.
    pub(super) fn close(&mut self) {
        self.tell_lost();
        if self.strangers > 0 {
            let count = self.strangers;
            self.integrity.miss(format!(
                "{count} messages belong to channels that the file does not declare, or declares in two ways; they are left out"
            ));
        }
        let read = self.integrity.messages;
        if let Some(announced) = self.integrity.announced.filter(|count| *count != read) {
            self.integrity
                .miss(format!("{read} of {announced} messages were read"));
        }
    }
}
