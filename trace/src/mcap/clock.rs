//! This file says when a message was, in seconds.

use super::account::Message;
use super::address::{Way, within};
use super::decoder::Decoder;
use super::flat::Leaf;
use super::track::Numbers;
use crate::csv::{TimeColumn, time_to_s};

/// Stamps from here on, ns, are counted from the first one: about eleven days, below which a double keeps them to
/// better than a nanosecond.
const EPOCH_NS: i64 = 1_000_000_000_000_000;

/// Where a message's time comes from.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Clock {
    /// When it was written.
    Log,
    /// When it was sent.
    Publish,
    /// A field of the message, and its unit where it is stated.
    Field(Way, String),
}

impl Clock {
    /// The clock of a topic; `own` is the field that the writer of the file itself calls time.
    pub(super) fn new(time: Option<&TimeColumn>, topic: &str, own: Option<&str>) -> Option<Clock> {
        let stated = time.map(|time| (time.name.as_str(), time.unit.as_str()));
        match (stated, own) {
            (Some(("log_time", _)), _) => Some(Clock::Log),
            (Some(("publish_time", _)), _) => Some(Clock::Publish),
            (_, Some(field)) => Some(Clock::Field(Way::parse(field)?, "s".into())),
            (Some((name, unit)), None) => {
                let field = within(name, topic).unwrap_or(name);
                Some(Clock::Field(Way::parse(field)?, unit.to_string()))
            }
            (None, None) => Some(Clock::Log),
        }
    }

    /// How the time is found in messages of one shape; `None` when it is not in them.
    pub(super) fn slot(&self, leaves: &[Leaf], decoder: &Decoder) -> Option<Slot> {
        let (way, unit) = match self {
            Clock::Log => return Some(Slot::Log),
            Clock::Publish => return Some(Slot::Publish),
            Clock::Field(way, unit) => (way, unit),
        };
        if let Some(place) = leaves.iter().position(|leaf| way.leads_to(leaf)) {
            let named = leaves.get(place).map(|leaf| decoder.unit(leaf));
            let unit = match unit.as_str() {
                "" => named.unwrap_or_default(),
                stated => stated.to_string(),
            };
            return Some(Slot::Number(place, time_to_s(&unit)?));
        }
        let part = |names: &[&str]| {
            let ways: Vec<Way> = names.iter().map(|name| way.then(name)).collect();
            leaves
                .iter()
                .position(|leaf| ways.iter().any(|way| way.leads_to(leaf)))
        };
        let whole = part(&["sec", "secs", "seconds"])?;
        Some(Slot::Parts(
            whole,
            part(&["nanosec", "nsec", "nsecs", "nanos"])?,
        ))
    }

    /// The words of a protocol.
    pub(super) fn name(&self, time: Option<&TimeColumn>) -> String {
        match self {
            Clock::Log => "log time".into(),
            Clock::Publish => "publish time".into(),
            Clock::Field(..) => match time {
                Some(time) => format!("the field `{}`", time.name),
                None => "the field that its writer names".into(),
            },
        }
    }
}

/// Where the time of a message of one shape stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Slot {
    Log,
    Publish,
    /// A number, and its unit in seconds.
    Number(usize, f64),
    /// Whole seconds and nanoseconds.
    Parts(usize, usize),
}

/// Where time is counted from, once the first message has come.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Origin {
    ns: Option<i64>,
}

impl Origin {
    /// The time of a message, s; NaN where it has none.
    pub(super) fn time_s(&mut self, slot: Slot, message: Message<'_>, numbers: Numbers<'_>) -> f64 {
        let ns = match slot {
            Slot::Log => i64::try_from(message.log_time_ns).ok(),
            Slot::Publish => i64::try_from(message.publish_time_ns).ok(),
            Slot::Number(place, to_s) => return numbers.at(place) * to_s,
            Slot::Parts(whole, ns) => whole_ns(numbers.at(whole), numbers.at(ns)),
        };
        let Some(ns) = ns else {
            return f64::NAN;
        };
        let first = *self.ns.get_or_insert(match ns >= EPOCH_NS {
            true => ns - ns % 1_000_000_000,
            false => 0,
        });
        ns.checked_sub(first).map_or(f64::NAN, |ns| ns as f64 / 1e9)
    }

    /// The second that the recording's time is counted from.
    pub(super) fn second(self) -> i64 {
        self.ns.unwrap_or(0) / 1_000_000_000
    }
}

fn whole_ns(s: f64, ns: f64) -> Option<i64> {
    let fits = |x: f64| x.is_finite() && x.abs() < 9e9;
    (fits(s) && fits(ns)).then(|| {
        (s as i64)
            .checked_mul(1_000_000_000)?
            .checked_add(ns as i64)
    })?
}

/// How much later a message was written than its own stamp says, s.
pub(super) fn lag_s(message: Message<'_>, s: f64, ns: f64) -> f64 {
    let log_s = (message.log_time_ns / 1_000_000_000) as f64;
    let log_ns = (message.log_time_ns % 1_000_000_000) as f64;
    (log_s - s) + (log_ns - ns) * 1e-9
}
