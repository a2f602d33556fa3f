//! This file says what is in an MCAP file.

use rigproof_trace::mcap::{self, TopicSummary};
use rigproof_trace::suggest::advice;
use serde_json::{Value, json};

use super::{Args, begun, next, show, signal, signal::SignalView, write_rig};
use crate::outcome::{Failure, Outcome, print};
use crate::shell;
use crate::text::number::significant;
use crate::text::section;

/// Channels of a topic that never move and are shown.
const MOST_STILL: usize = 8;
/// A stamp that lies further from the writing of its message, in s, is of another clock: about three years.
const ANOTHER_CLOCK_S: f64 = 1e8;

/// Of more topics each is one line, until one is asked for.
const MOST_TOPICS: usize = 12;

/// Numbers of stamps that are named.
const STAMPS: usize = 2;

/// What was found of one topic.
struct TopicView {
    topic: TopicSummary,
    signals: Vec<SignalView>,
}

/// Looks at an MCAP file, and writes the beginning of a rig description if asked.
pub fn run(args: &Args) -> Result<Outcome, Failure> {
    let summary = mcap::summary(&args.recording)?;
    let topics = summary.topics.into_iter().map(|mut topic| TopicView {
        signals: topic
            .channels
            .drain(..)
            .map(SignalView::of_summary)
            .collect(),
        topic,
    });
    let topics = chosen(args, topics.collect())?;
    if let Some(file) = &args.write_rig {
        let signals: Vec<&SignalView> = topics.iter().flat_map(|view| &view.signals).collect();
        let time = args.time_column();
        let text = begun(args, file, time.as_ref(), &signals)?;
        write_rig(file, &text)?;
    }
    let integrity = summary.integrity.lines();
    if args.json {
        let result = json!({
            "file": args.recording.display().to_string(),
            "topics": topics.iter().map(|view| view.json(args.ascii)).collect::<Vec<_>>(),
            "metadata": summary.metadata,
            "attachments": summary.attachments.iter().map(|(name, _)| name).collect::<Vec<_>>(),
            "whole": summary.integrity.is_whole(),
            "integrity": integrity,
            "rig": args.write_rig.as_ref().map(|file| file.display().to_string()),
        });
        return print(&result.to_string());
    }
    let head = format!(
        "{}: {} messages on {} topics",
        args.recording.display(),
        summary.integrity.messages,
        topics.len()
    );
    let inside = summary
        .attachments
        .iter()
        .map(|(name, bytes)| format!("  {name}, {bytes} bytes"));
    let metadata = summary.metadata.iter().map(|name| format!("  {name}"));
    let mut sections = vec![
        vec![head],
        section(
            "Integrity",
            integrity.iter().map(|line| format!("  {line}")),
        ),
    ];
    let seen = topics.iter().any(|view| !view.signals.is_empty());
    if topics.len() > MOST_TOPICS && args.topic.is_empty() {
        sections.push(section("Topics", one_by_one(&topics)));
        let name = topics
            .first()
            .map_or("NAME", |view| view.topic.name.as_str());
        let command = shell::line(&["rigproof", "inspect"], &[("", args.recording.as_path())]);
        let more = format!("  {command} --topic {name}   (its channels)");
        sections.push(section("One topic", [more]));
    } else {
        sections.extend(topics.iter().map(|view| view.lines(args.ascii)));
    }
    sections.push(section("Metadata and attachments", metadata.chain(inside)));
    sections.push(section("Next", seen.then(|| format!("  {}", next(args)))));
    show(sections)
}

/// The topics that are asked for: all, unless `--topic` names some.
fn chosen(args: &Args, mut topics: Vec<TopicView>) -> Result<Vec<TopicView>, Failure> {
    let names: Vec<&str> = topics.iter().map(|view| view.topic.name.as_str()).collect();
    let unknown = args.topic.iter().find(|own| !names.contains(&own.as_str()));
    if let Some(own) = unknown {
        let problem = format!("`{own}` is no topic; {}", advice(own, "topics", &names));
        return Err(Failure::unusable(&args.recording, problem));
    }
    topics.retain(|view| args.topic.is_empty() || args.topic.contains(&view.topic.name));
    Ok(topics)
}

/// A line a topic, in the order of their names: those below one name stand together.
fn one_by_one(topics: &[TopicView]) -> Vec<String> {
    let mut topics: Vec<&TopicView> = topics.iter().collect();
    topics.sort_by(|a, b| a.topic.name.cmp(&b.topic.name));
    let names = topics.iter().map(|view| view.topic.name.chars().count());
    let width = names.max().unwrap_or(0);
    let lines = topics.iter().map(|view| {
        let topic = &view.topic;
        let rate = match topic.messages > 2 {
            true => format!("{} Hz", significant(1.0 / topic.step_s, 4)),
            false => String::new(),
        };
        let numbers = view.signals.iter().filter(|own| !is_stamp(&own.name));
        let line = format!(
            "  {:<width$}  {:>9} messages  {rate:>9}  {:>5} channels  {}",
            topic.name,
            topic.messages,
            numbers.count(),
            topic.type_name
        );
        line.trim_end().to_owned()
    });
    lines.collect()
}

impl TopicView {
    fn lines(&self, ascii: bool) -> Vec<String> {
        let topic = &self.topic;
        let seconds = (topic.last_ns - topic.first_ns.min(topic.last_ns)) as f64 * 1e-9;
        let (low_s, high_s) = topic.step_range_s;
        let s = |value: f64| significant(value, 4);
        let kind = match topic.type_name.as_str() {
            "" => topic.encoding.clone(),
            name => format!("{name}, {}", topic.encoding),
        };
        let mut lines = vec![
            format!("{} ({kind})", topic.name),
            match topic.messages {
                1 => "  1 message".to_owned(),
                count => format!("  {count} messages in {} s", s(seconds)),
            },
        ];
        lines.extend(
            (topic.damaged > 0).then(|| format!("  {} of them are damaged", topic.damaged)),
        );
        if topic.messages > 2 {
            lines.push(format!(
                "  rate {} Hz, a step of {} s (nine of ten: {} to {} s)",
                s(1.0 / topic.step_s),
                s(topic.step_s),
                s(low_s),
                s(high_s),
            ));
            lines.extend((topic.gaps > 0).then(|| {
                let longest = s(topic.longest_step_s);
                format!("  {} gaps, the longest {longest} s", topic.gaps)
            }));
            lines.extend(
                (topic.backward > 0)
                    .then(|| format!("  time runs backward {} times", topic.backward)),
            );
        }
        lines.extend(topic.lag_s.map(|lag_s| match (lag_s.abs(), lag_s >= 0.0) {
            (lag_s, _) if lag_s > ANOTHER_CLOCK_S => {
                "  stamped by another clock than that of the file".to_owned()
            }
            (0.0, _) => "  stamped as it was written".to_owned(),
            (lag_s, true) => format!("  stamped {} s before it was written", s(lag_s)),
            (lag_s, false) => format!("  stamped {} s after it was written", s(lag_s)),
        }));
        lines.extend(
            topic
                .unreadable
                .as_ref()
                .map(|why| format!("  not read: {why}")),
        );
        let (stamps, numbers): (Vec<_>, Vec<_>) = self
            .signals
            .iter()
            .partition(|signal| is_stamp(&signal.name));
        lines.extend(signal::lines(&numbers, ascii, MOST_STILL));
        if numbers.is_empty() && topic.unreadable.is_none() && topic.messages > 0 {
            lines.push("  no numbers in it".to_owned());
        }
        lines.extend((!stamps.is_empty()).then(|| {
            let names = stamps.iter().map(|stamp| stamp.name.as_str());
            let names: Vec<&str> = names.take(STAMPS).collect();
            format!("  stamps: {}", names.join(", "))
        }));
        lines
    }

    fn json(&self, ascii: bool) -> Value {
        let topic = &self.topic;
        json!({
            "name": topic.name, "encoding": topic.encoding, "type": topic.type_name, "messages": topic.messages,
            "damaged": topic.damaged, "unreadable": topic.unreadable, "first_ns": topic.first_ns,
            "last_ns": topic.last_ns, "step_s": topic.step_s, "rate_hz": 1.0 / topic.step_s,
            "gaps": topic.gaps, "longest_step_s": topic.longest_step_s, "backward": topic.backward,
            "lag_s": topic.lag_s,
            "channels": self.signals.iter().map(|signal| signal.json(ascii)).collect::<Vec<_>>(),
        })
    }
}

/// Whether a number is a part of a stamp, which is no channel to look at.
fn is_stamp(name: &str) -> bool {
    let part = name.rsplit_once(".stamp.").map(|(_, part)| part);
    part.is_some_and(|part| ["sec", "nanosec", "nsec", "secs", "nsecs"].contains(&part))
}
