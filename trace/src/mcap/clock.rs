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

/// How fast the clock of writing runs beside the stamps in the messages.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Rate {
    first: Option<(u64, i64)>,
    last: (u64, i64),
}

impl Rate {
    pub(super) fn add(&mut self, log_time_ns: u64, s: f64, ns: f64) {
        if let Some(stamp_ns) = whole_ns(s, ns).filter(|ns| *ns > 0) {
            self.first.get_or_insert((log_time_ns, stamp_ns));
            self.last = (log_time_ns, stamp_ns);
        }
    }

    /// Seconds of writing for each second of the stamps; `None` where too little time passed to tell.
    pub(super) fn ratio(self) -> Option<f64> {
        let (first_log, first_stamp) = self.first?;
        let (last_log, last_stamp) = self.last;
        let log_ns = last_log.checked_sub(first_log)? as f64;
        let stamp_ns = last_stamp.checked_sub(first_stamp)? as f64;
        (stamp_ns > LEAST_SPAN_NS).then(|| log_ns / stamp_ns)
    }
}

/// A shorter time does not tell how fast a clock runs, ns.
const LEAST_SPAN_NS: f64 = 2e8;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_clock_that_runs_at_half_the_speed_of_the_stamps_is_seen() {
        for (pace, expected) in [(2.0, 0.5), (1.0, 1.0), (0.25, 4.0)] {
            let mut rate = Rate::default();
            for k in 0..900_u32 {
                let stamp_ns = 1e6 * f64::from(k) * pace;
                rate.add(5_000_000_000 + 1_000_000 * u64::from(k), 1.7e9, stamp_ns);
            }
            assert!((rate.ratio().unwrap() - expected).abs() < 1e-9);
        }
        let mut short = Rate::default();
        short.add(5, 3.0, 7.0);
        short.add(9_000, 3.0, 1e6);
        assert_eq!(short.ratio(), None);
        assert_eq!(Rate::default().ratio(), None);
    }
}
