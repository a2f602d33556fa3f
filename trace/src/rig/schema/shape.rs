//! This file says what kinds of values there are, as a JSON Schema says it.

use serde_json::{Map, Value, json};

/// An object with these keys and no others.
pub fn object(about: Option<&str>, keys: Vec<(&str, Value)>, required: &[&str]) -> Value {
    let keys: Map<String, Value> = keys
        .into_iter()
        .map(|(key, what)| (key.to_owned(), what))
        .collect();
    let mut whole = json!({
        "type": "object",
        "properties": keys,
        "required": required,
        "additionalProperties": false,
    });
    if let Some(about) = about {
        whole["description"] = json!(about);
    }
    whole
}

/// Text.
pub fn text(about: &str) -> Value {
    json!({ "type": "string", "description": about })
}

/// A number.
pub fn number(about: &str) -> Value {
    json!({ "type": "number", "description": about })
}

/// A number above 0.
pub fn above_zero(about: &str) -> Value {
    json!({ "type": "number", "exclusiveMinimum": 0, "description": about })
}

/// A number of 0 or more.
pub fn not_below_zero(about: &str) -> Value {
    json!({ "type": "number", "minimum": 0, "description": about })
}

/// A whole number.
pub fn whole(about: &str, least: u32, most: u32) -> Value {
    json!({ "type": "number", "multipleOf": 1, "minimum": least, "maximum": most, "description": about })
}

/// One of some words.
pub fn one_of<'a>(about: &str, words: impl IntoIterator<Item = &'a str>) -> Value {
    let words: Vec<&str> = words.into_iter().collect();
    json!({ "enum": words, "description": about })
}

/// A list.
pub fn list(about: &str, of: Value) -> Value {
    json!({ "type": "array", "items": of, "description": about })
}

/// What is defined once.
pub fn defined(name: &str) -> Value {
    json!({ "$ref": format!("#/$defs/{name}") })
}
