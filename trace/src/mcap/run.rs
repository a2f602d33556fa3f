//! This file is how a run of this program stands in an MCAP file: one JSON channel whose head names every column.

use std::collections::{BTreeMap, HashMap, HashSet};

use serde_json::{Map, Value, json};

use super::topics::Topic;
use crate::series::Trace;

/// The topic of a run.
pub(super) const TOPIC: &str = "/rigproof/run";
/// The key, in the head of the channel, under which the field of the time stands.
const TIME_KEY: &str = "rigproof.time";
/// The key under which the columns stand.
const COLUMNS_KEY: &str = "rigproof.columns";

/// The columns of a run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Run {
    /// The field that holds the time, s.
    pub(super) time: String,
    /// The columns, in order.
    pub(super) columns: Vec<Column>,
}

/// A channel of a run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Column {
    /// Its field in the messages.
    pub(super) key: String,
    /// Its name in the recording.
    pub(super) name: String,
    /// Its unit, as printed.
    pub(super) unit: String,
}

impl Run {
    /// The columns for a recording: fields are called as the channels are, with the unit last, in plain letters.
    pub(super) fn for_trace(trace: &Trace) -> Run {
        let time = "time_s".to_string();
        let mut columns: Vec<Column> = Vec::new();
        let mut taken = HashSet::from([time.clone()]);
        // Where the numbers of a name go on that stands over many columns.
        let mut next: HashMap<String, usize> = HashMap::new();
        for channel in &trace.channels {
            let base = key(&channel.name, &channel.unit);
            let from = next.entry(base.clone()).or_insert(1);
            let numbered = (*from..).map(|number| match number {
                1 => (base.clone(), number),
                _ => (format!("{base}_{number}"), number),
            });
            let mut free = numbered.filter(|(key, _)| !taken.contains(key));
            let key = free.next().map(|(key, number)| {
                *from = number + 1;
                key
            });
            taken.extend(key.clone());
            columns.push(Column {
                key: key.unwrap_or(base),
                name: channel.name.clone(),
                unit: channel.unit.clone(),
            });
        }
        Run { time, columns }
    }

    /// The columns of a channel that this program wrote, or `None`.
    pub(super) fn of(topic: &Topic) -> Option<Run> {
        let time = topic.metadata.get(TIME_KEY)?.clone();
        let columns: Value = serde_json::from_str(topic.metadata.get(COLUMNS_KEY)?).ok()?;
        let column = |value: &Value| {
            let text = |key: &str| Some(value.get(key)?.as_str()?.to_string());
            Some(Column {
                key: text("key")?,
                name: text("name")?,
                unit: text("unit")?,
            })
        };
        let columns: Option<Vec<Column>> = columns.as_array()?.iter().map(column).collect();
        Some(Run {
            time,
            columns: columns?,
        })
    }

    /// The head of the channel.
    pub(super) fn metadata(&self) -> BTreeMap<String, String> {
        let columns = self
            .columns
            .iter()
            .map(|column| json!({ "key": column.key, "name": column.name, "unit": column.unit }));
        let columns = Value::Array(columns.collect()).to_string();
        BTreeMap::from([
            (TIME_KEY.to_string(), self.time.clone()),
            (COLUMNS_KEY.to_string(), columns),
        ])
    }

    /// The layout of the messages, for viewers: every field a number, absent where a sample is missing.
    pub(super) fn schema(&self) -> String {
        let property =
            |title: &str, unit: &str| json!({ "type": "number", "title": title, "unit": unit });
        let mut properties = Map::new();
        properties.insert(self.time.clone(), property("time", "s"));
        for column in &self.columns {
            properties.insert(column.key.clone(), property(&column.name, &column.unit));
        }
        let schema = json!({
            "$schema": "http://json-schema.org/draft-07/schema#",
            "title": "rigproof.Run",
            "type": "object",
            "properties": properties,
            "required": [self.time],
        });
        schema.to_string()
    }
}

/// A name in plain letters, with the unit last.
fn key(name: &str, unit: &str) -> String {
    let plain = |text: &str| {
        let letters = text
            .chars()
            .map(|c| if c.is_ascii_alphanumeric() { c } else { '_' });
        let text: String = letters.collect();
        text.trim_matches('_').to_string()
    };
    let (name, unit) = (plain(name), plain(&unit.replace('·', "")).to_lowercase());
    let name = if name.is_empty() { "x".into() } else { name };
    match unit.as_str() {
        "" => name,
        unit if name.to_lowercase().ends_with(&format!("_{unit}")) => name,
        unit => format!("{name}_{unit}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::series::Channel;

    #[test]
    fn fields_are_named_with_units_and_never_twice() {
        let channel = |name: &str, unit: &str| Channel {
            name: name.into(),
            unit: unit.into(),
            samples: Vec::new(),
        };
        let channels = vec![
            channel("theta A", "deg/s"),
            channel("theta_A", "deg/s"),
            channel("qm_m", "m"),
            channel("torque", "N·m"),
            channel("time", "s"),
            channel("µ", ""),
        ];
        let run = Run::for_trace(&Trace {
            time_s: Vec::new(),
            channels,
        });
        let keys: Vec<&str> = run
            .columns
            .iter()
            .map(|column| column.key.as_str())
            .collect();
        let expected = [
            "theta_A_deg_s",
            "theta_A_deg_s_2",
            "qm_m",
            "torque_nm",
            "time_s_2",
            "x",
        ];
        assert_eq!(keys, expected);
    }
}
