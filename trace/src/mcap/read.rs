//! This file takes chosen numbers out of an MCAP file and brings them to one time.

use std::fs::File;
use std::io::{BufReader, Read};
use std::path::Path;

use super::address;
use super::feed::Feeds;
use super::integrity::Integrity;
use super::resample::{Between, Ordered, order, resample};
use super::stream::walk;
use crate::budget;
use crate::csv::{LEAST_SAMPLES, TimeColumn};
use crate::error::TraceError;
use crate::series::{Channel, Trace};
use crate::suggest::{advice, quoted};

/// Which numbers make the recording.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Selection {
    /// The numbers; the first one's times are the recording's. None at all takes the run of a file that this program
    /// wrote.
    pub channels: Vec<Wanted>,
    /// Where a message's time stands: `log_time`, `publish_time`, or a field such as `header.stamp`; in a file of this
    /// program its own field, elsewhere the log time, unless this says otherwise.
    pub time: Option<TimeColumn>,
}

/// One number.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Wanted {
    /// `topic.field[index]`, `topic.field[name=joint_a]`, or a channel's name in a file of this program.
    pub address: String,
    /// How it goes on between its samples.
    pub between: Between,
}

/// A recording out of an MCAP file.
#[derive(Clone, Debug, PartialEq)]
pub struct Reading {
    /// The numbers.
    pub trace: Trace,
    /// Check sums and what is missing.
    pub integrity: Integrity,
    /// How the recording was made of the file, a line each.
    pub protocol: Vec<String>,
}

/// Reads chosen numbers.
///
/// # Errors
/// The file cannot be read or is no MCAP file, a number is not in it, or there are too few samples.
pub fn read(path: &Path, selection: &Selection) -> Result<Reading, TraceError> {
    let file = File::open(path).map_err(TraceError::io("read", path))?;
    read_from(BufReader::with_capacity(1 << 18, file), path, selection)
}

/// As [`read`], from any source; `file` is what messages name.
///
/// # Errors
/// As [`read`].
pub fn read_from(
    source: impl Read,
    file: &Path,
    selection: &Selection,
) -> Result<Reading, TraceError> {
    let mut feeds = Feeds::new(selection);
    let (_, integrity) = walk(source, file, &mut feeds)?;
    let refused = |problem: String| TraceError::recording(file, problem);
    if let Some(bytes) = feeds.beyond() {
        let what = "what is chosen of its messages";
        return Err(refused(budget::beyond(what, bytes, budget::bytes())));
    }
    if feeds.wanted.is_empty() {
        return Err(refused(nothing_wanted(&feeds.topics, &integrity)));
    }
    let mut protocol = Vec::new();
    // The times of every topic that is needed; the first one's are the recording's.
    let mut times: Vec<(usize, Ordered)> = Vec::new();
    let mut channels = Vec::new();
    for (wanted, place) in feeds.wanted.clone().into_iter().zip(feeds.places()) {
        let Some(place) = place else {
            return Err(refused(absent(&feeds, &wanted.address, &integrity)));
        };
        if !times.iter().any(|(feed, _)| *feed == place.feed) {
            let stamps = feeds.take_times(place);
            if let Some(fault) = feeds.clock_fault(place, &stamps) {
                return Err(refused(fault));
            }
            let own = order(stamps);
            protocol.extend(feeds.time_lines(place, &own));
            times.push((place.feed, own));
        }
        let own = times.iter().find(|(feed, _)| *feed == place.feed);
        let (Some((_, own)), Some((base, ordered))) = (own, times.first()) else {
            continue;
        };
        let mut samples = own.put(feeds.take_column(place));
        if *base != place.feed {
            let gaps;
            (samples, gaps) = resample(&own.time_s, &samples, &ordered.time_s, wanted.between);
            protocol.push(resampled(&wanted.address, wanted.between, gaps));
        }
        channels.push(Channel {
            unit: feeds.unit(place),
            name: wanted.address,
            samples,
        });
    }
    let base = times.into_iter().next();
    let time_s = base.map_or(Vec::new(), |(_, ordered)| ordered.time_s);
    if time_s.len() < LEAST_SAMPLES {
        return Err(TraceError::TooFewSamples {
            file: file.to_path_buf(),
            samples: time_s.len(),
            least: LEAST_SAMPLES,
        });
    }
    Ok(Reading {
        trace: Trace { time_s, channels },
        integrity,
        protocol,
    })
}

fn resampled(address: &str, between: Between, gaps: usize) -> String {
    match between {
        Between::Held => format!("`{address}` holds its last value until the next message"),
        Between::Line => format!(
            "`{address}` goes in straight lines between its own samples, and is left empty across {gaps} gaps (steps longer than {} usual ones)",
            super::GAP_STEPS
        ),
    }
}

/// Nobody said what is wanted, and there is no run that says it.
fn nothing_wanted(topics: &[String], integrity: &Integrity) -> String {
    match topics {
        [] => format!(
            "the file holds no channel; {}",
            integrity.missing.join("; ")
        ),
        _ => format!(
            "the file was not written by this program, so say which numbers are meant, as `topic.field[index]`; the topics are {}",
            quoted(topics.iter().map(String::as_str))
        ),
    }
}

/// Why a number is not there, and what is.
fn absent(feeds: &Feeds, wanted: &str, integrity: &Integrity) -> String {
    let topics: Vec<&str> = feeds.topics.iter().map(String::as_str).collect();
    let is_its = |topic: &&String| address::within(wanted, topic).is_some();
    let problem = match feeds.topics.iter().rfind(is_its) {
        None => {
            let topic = wanted.split('.').next().unwrap_or(wanted);
            format!(
                "`{wanted}` is not in the file; {}",
                advice(topic, "topics", &topics)
            )
        }
        Some(topic) => match feeds.why_not(topic) {
            Some(reason) => format!("`{topic}` cannot be read: {reason}"),
            None => {
                let known = feeds.addresses(topic);
                let known: Vec<&str> = known.iter().map(String::as_str).collect();
                let advice = advice(wanted, "numbers of this topic", &known);
                format!("`{wanted}` is in no message of `{topic}`; {advice}")
            }
        },
    };
    match integrity.missing.as_slice() {
        [] => problem,
        missing => format!("{problem}; {}", missing.join("; ")),
    }
}
