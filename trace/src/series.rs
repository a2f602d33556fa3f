//! This file is the one time-series type of the workspace.

use crate::header::guessed_unit;

/// One named signal of a recording.
#[derive(Clone, Debug, PartialEq)]
pub struct Channel {
    /// The name in the recording, without its unit.
    pub name: String,
    /// The unit as printed; empty when the recording does not say. What the name suggests is [`Channel::likely_unit`].
    pub unit: String,
    /// One value for each time stamp; NaN where the recording has none.
    pub samples: Vec<f64>,
}

impl Channel {
    /// The unit that the recording states, or else the one that the name ends in; empty where neither says anything.
    pub fn likely_unit(&self) -> &str {
        match self.unit.as_str() {
            "" => guessed_unit(&self.name),
            stated => stated,
        }
    }
}

/// A recording: time stamps and the channels sampled at them.
///
/// Irregular steps and missing samples are kept as they were recorded.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Trace {
    /// Time stamps in seconds.
    pub time_s: Vec<f64>,
    /// The signals, each as long as `time_s`.
    pub channels: Vec<Channel>,
}

impl Trace {
    /// The number of time stamps.
    pub fn len(&self) -> usize {
        self.time_s.len()
    }

    /// Whether there are no time stamps.
    pub fn is_empty(&self) -> bool {
        self.time_s.is_empty()
    }

    /// The channel of that name, or `None`.
    pub fn channel(&self, name: &str) -> Option<&Channel> {
        self.channels.iter().find(|channel| channel.name == name)
    }
}
