//! This file chooses how the messages of a channel are read.

use std::collections::HashMap;

use super::flat::{Flat, Leaf, Step};
use super::json::{self, Property};
use super::protobuf::ProtobufReader;
use super::ros::{RosReader, Wire};
use super::topics::{Topic, short};
use crate::header::{guessed_unit, name_and_unit};

/// A reader for the messages of one channel.
pub(super) struct Decoder {
    language: Language,
    properties: HashMap<String, Property>,
}

enum Language {
    Ros(RosReader),
    Json,
    Protobuf(ProtobufReader),
}

impl Decoder {
    /// The reader for a channel, or why there is none.
    pub(super) fn new(topic: &Topic) -> Result<Decoder, String> {
        let schema = topic.schema.as_deref();
        let encoding = schema.map_or("", |schema| schema.encoding.as_str());
        let text = || {
            let bytes = schema.map_or(&[][..], |schema| &schema.data);
            std::str::from_utf8(bytes).map_err(|_| "its definition is no text".to_string())
        };
        let name = schema.map_or("", |schema| schema.name.as_str());
        let mut properties = HashMap::new();
        let language = match (topic.encoding.as_str(), encoding) {
            ("cdr", "ros2msg") => Language::Ros(RosReader::new(name, text()?, Wire::Cdr)?),
            ("ros1", "ros1msg") => Language::Ros(RosReader::new(name, text()?, Wire::Ros1)?),
            ("json", "jsonschema") => {
                properties = json::properties(schema.map_or(&[], |schema| &schema.data));
                Language::Json
            }
            ("json", "") => Language::Json,
            ("protobuf", "protobuf") => match schema {
                Some(schema) => Language::Protobuf(ProtobufReader::new(schema)?),
                None => return Err("its messages have no schema".into()),
            },
            (message, schema) => {
                return Err(format!(
                    "its messages are in `{}` with a schema in `{}`; cdr with ros2msg, ros1 with ros1msg, json with jsonschema or none, and protobuf with protobuf are read",
                    short(message),
                    short(schema)
                ));
            }
        };
        Ok(Decoder {
            language,
            properties,
        })
    }

    /// Takes the numbers of a message out; `named` keeps their places too.
    pub(super) fn read(&self, data: &[u8], flat: &mut Flat, named: bool) -> Result<(), String> {
        match &self.language {
            Language::Ros(reader) => reader.read(data, flat, named),
            Language::Json => json::read(data, flat, named),
            Language::Protobuf(reader) => reader.read(data, flat, named),
        }
    }

    /// The unit of a number as its schema states it; empty where it does not.
    pub(super) fn stated_unit(&self, leaf: &Leaf) -> String {
        let property = self.property(leaf);
        property
            .and_then(|property| property.unit.clone())
            .unwrap_or_default()
    }

    /// The unit of a number: what the schema says, or what the name of its field ends in; empty where neither does.
    pub(super) fn unit(&self, leaf: &Leaf) -> String {
        if let Some(unit) = self
            .property(leaf)
            .and_then(|property| property.unit.clone())
        {
            return unit;
        }
        let mut fields = leaf.path.iter().rev().filter_map(|step| match step {
            Step::Field(name) => Some(name.as_str()),
            Step::Index(_) => None,
        });
        let unit = match name_and_unit(fields.next().unwrap_or_default()) {
            (name, "") => guessed_unit(name),
            (_, stated) => stated,
        };
        // In lower case both nanometre and newton metre are written so.
        match unit {
            "nm" => String::new(),
            unit => unit.to_string(),
        }
    }

    fn property(&self, leaf: &Leaf) -> Option<&Property> {
        match leaf.path.as_slice() {
            [Step::Field(name)] => self.properties.get(name),
            _ => None,
        }
    }
}
