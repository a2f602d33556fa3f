//! This file keeps the schemas and channels of a file as they are declared.

use std::collections::{BTreeMap, HashMap};
use std::sync::Arc;

use ::mcap::records::{Channel, SchemaHeader};

/// The layout of a channel's messages, as the file states it.
#[derive(Debug, PartialEq, Eq)]
pub struct Schema {
    /// The type's name.
    pub name: String,
    /// The language of `data`: `ros2msg`, `jsonschema`, …
    pub encoding: String,
    /// The definition.
    pub data: Vec<u8>,
}

/// A channel of the file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Topic {
    /// Its name; several channels may share one.
    pub name: String,
    /// The language of its messages: `cdr`, `json`, …
    pub encoding: String,
    /// The layout of its messages, where it has one.
    pub schema: Option<Arc<Schema>>,
    /// What its writer said of it.
    pub metadata: BTreeMap<String, String>,
}

impl Topic {
    pub(super) fn new(
        name: &str,
        encoding: &str,
        schema: Option<Arc<Schema>>,
        metadata: BTreeMap<String, String>,
    ) -> Topic {
        Topic {
            name: name.to_string(),
            encoding: encoding.to_string(),
            schema,
            metadata,
        }
    }
}

/// Everything declared so far.
#[derive(Default)]
pub(super) struct Topics {
    schemas: HashMap<u16, Arc<Schema>>,
    /// By number: none for a channel that is not declared, and `None` inside for one declared twice.
    places: Vec<Option<Option<usize>>>,
    topics: Vec<Topic>,
}

impl Topics {
    pub(super) fn into_topics(self) -> Vec<Topic> {
        self.topics
    }

    /// The place of a channel, or `None` when it was not declared, or declared twice in different ways.
    pub(super) fn place(&self, id: u16) -> Option<usize> {
        self.places
            .get(usize::from(id))
            .copied()
            .flatten()
            .flatten()
    }

    fn put(&mut self, id: u16, place: Option<usize>) {
        let id = usize::from(id);
        if self.places.len() <= id {
            self.places.resize(id + 1, None);
        }
        if let Some(entry) = self.places.get_mut(id) {
            *entry = Some(place);
        }
    }

    /// Takes a schema in, or says why not.
    pub(super) fn add_schema(&mut self, header: SchemaHeader, data: &[u8]) -> Result<(), String> {
        let SchemaHeader { id, name, encoding } = header;
        let earlier = self.schemas.get(&id);
        if id == 0 {
            return Err(format!(
                "the schema `{}` has the number 0, which means none",
                short(&name)
            ));
        }
        if let Some(earlier) = earlier {
            let same = earlier.name == name && earlier.encoding == encoding && earlier.data == data;
            return match same {
                true => Ok(()),
                false => Err(format!(
                    "schema {id} is declared twice, as `{}` and as `{}`; the first one counts",
                    short(&earlier.name),
                    short(&name)
                )),
            };
        }
        let data = data.to_vec();
        let schema = Schema {
            name,
            encoding,
            data,
        };
        self.schemas.insert(id, Arc::new(schema));
        Ok(())
    }

    /// Takes a channel in and answers it with its place when it is new, or says why not.
    pub(super) fn add_channel(
        &mut self,
        channel: Channel,
    ) -> Result<Option<(usize, &Topic)>, String> {
        let name = short(&channel.topic);
        let schema = self.schemas.get(&channel.schema_id).cloned();
        if channel.schema_id != 0 && schema.is_none() {
            self.put(channel.id, None);
            return Err(format!(
                "the channel `{name}` refers to schema {}, which the file does not hold; its messages are left out",
                channel.schema_id
            ));
        }
        let topic = Topic::new(
            &channel.topic,
            &channel.message_encoding,
            schema,
            channel.metadata,
        );
        match self.places.get(usize::from(channel.id)).copied().flatten() {
            Some(Some(place)) if self.topics.get(place) == Some(&topic) => return Ok(None),
            Some(None) => return Ok(None),
            Some(Some(_)) => {
                self.put(channel.id, None);
                return Err(format!(
                    "channel {} is declared twice in different ways, the second time as `{name}`; its messages from there on are left out",
                    channel.id
                ));
            }
            None => {}
        }
        let place = self.topics.len();
        self.put(channel.id, Some(place));
        self.topics.push(topic);
        Ok(self.topics.last().map(|topic| (place, topic)))
    }
}

/// A name from a file, cut to what a line can bear.
pub(super) fn short(text: &str) -> String {
    match text.char_indices().nth(80) {
        Some((end, _)) => format!("{}…", text.get(..end).unwrap_or_default()),
        None => text.to_string(),
    }
}
