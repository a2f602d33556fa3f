//! This file reads messages in JSON, and what their schema says of their fields.

use std::collections::HashMap;
use std::fmt;

use serde::de::{DeserializeSeed, Deserializer, Error, MapAccess, SeqAccess, Visitor};

use super::flat::Flat;

/// What a schema says of a field of the message itself.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Property {
    /// The exact name of the quantity, where the schema gives one.
    pub(super) title: Option<String>,
    /// The unit, where the schema gives one.
    pub(super) unit: Option<String>,
}

/// The properties that a JSON schema describes, by name.
pub(super) fn properties(schema: &[u8]) -> HashMap<String, Property> {
    let schema: serde_json::Value = serde_json::from_slice(schema).unwrap_or_default();
    let described = schema.get("properties").and_then(|p| p.as_object());
    let text = |value: &serde_json::Value, key: &str| Some(value.get(key)?.as_str()?.to_string());
    let property = |(name, value): (&String, &serde_json::Value)| {
        let (title, unit) = (text(value, "title"), text(value, "unit"));
        (name.clone(), Property { title, unit })
    };
    described.into_iter().flatten().map(property).collect()
}

/// Takes the numbers of a message out; `named` keeps their places too.
pub(super) fn read(data: &[u8], flat: &mut Flat, named: bool) -> Result<(), String> {
    flat.begin(named);
    let mut reader = serde_json::Deserializer::from_slice(data);
    let element = false;
    let result = Numbers { flat, element }.deserialize(&mut reader);
    result
        .and_then(|()| reader.end())
        .map_err(|_| "the message is no JSON".to_string())
}

/// Walks over a value without keeping it.
struct Numbers<'f> {
    flat: &'f mut Flat,
    element: bool,
}

impl<'de> DeserializeSeed<'de> for Numbers<'_> {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<(), D::Error> {
        deserializer.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for Numbers<'_> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a value")
    }

    fn visit_bool<E: Error>(self, value: bool) -> Result<(), E> {
        self.visit_f64(f64::from(u8::from(value)))
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<(), E> {
        self.visit_f64(value as f64)
    }

    fn visit_u64<E: Error>(self, value: u64) -> Result<(), E> {
        self.visit_f64(value as f64)
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<(), E> {
        self.flat.depends_on_count(1);
        self.flat.number(value);
        Ok(())
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<(), E> {
        self.flat.depends_on_count(2);
        if self.element {
            self.flat.element_text(text.as_bytes());
        }
        Ok(())
    }

    fn visit_unit<E: Error>(self) -> Result<(), E> {
        self.flat.depends_on_count(3);
        Ok(())
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<(), A::Error> {
        self.flat.depends_on_count(4);
        let mut index = 0;
        loop {
            if index >= self.flat.elements {
                let past = list.next_element::<serde::de::IgnoredAny>()?;
                if past.is_none() {
                    break;
                }
                continue;
            }
            self.flat.element(index);
            let flat = &mut *self.flat;
            let next = list.next_element_seed(Numbers {
                flat,
                element: true,
            })?;
            self.flat.up();
            if next.is_none() {
                break;
            }
            index += 1;
        }
        self.flat.depends_on_count(5);
        Ok(())
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<(), A::Error> {
        self.flat.depends_on_count(6);
        while let Some(key) = map.next_key::<std::borrow::Cow<'de, str>>()? {
            self.flat.depends_on(key.as_bytes());
            self.flat.field(&key);
            let flat = &mut *self.flat;
            let element = false;
            map.next_value_seed(Numbers { flat, element })?;
            self.flat.up();
        }
        self.flat.depends_on_count(7);
        Ok(())
    }
}
