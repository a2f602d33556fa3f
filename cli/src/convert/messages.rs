//! This file converts from MCAP files, and says what goes into them beside the recording.

use std::collections::BTreeMap;
use std::path::Path;

use rigproof_trace::TraceError;
use rigproof_trace::csv::TimeColumn;
use rigproof_trace::mcap::{self, Between, Extras, Selection, TopicSummary, Wanted};
use serde_json::{Value, json};

use super::Args;
use crate::input;
use crate::outcome::{self, Failure, Outcome, print};

/// Converts an MCAP file, or lists what it holds.
pub fn run(args: &Args, to_mcap: bool) -> Result<Outcome, Failure> {
    if args.rate_hz.is_some() || args.rate_from.is_some() || args.group.is_some() {
        return Err(Failure::Usage(
            "--rate-hz, --rate-from and --group are for HDF5 and MATLAB files; messages have times of their own".into(),
        ));
    }
    let Some(output) = &args.output else {
        return list(args);
    };
    let channels = args.variables.iter().map(|address| Wanted {
        address: address.clone(),
        between: Between::Line,
    });
    let time = args.time_from.as_ref().map(|name| TimeColumn {
        name: name.clone(),
        unit: unit_of(args, name).unwrap_or_default(),
    });
    let selection = Selection {
        channels: channels.collect(),
        time,
    };
    let mut reading = mcap::read(&args.input, &selection)?;
    for channel in &mut reading.trace.channels {
        if let Some(unit) = unit_of(args, &channel.name) {
            channel.unit = unit;
        }
    }
    outcome::note(&args.input, &reading.integrity.lines());
    outcome::note(&args.input, &reading.protocol);
    super::write(args, output, &reading.trace, None, to_mcap)
}

fn unit_of(args: &Args, name: &str) -> Option<String> {
    let stated = args.units.iter().find(|(of, _)| of == name);
    stated.map(|(_, unit)| unit.clone())
}

/// The files and texts of an MCAP file: what was to be attached, and where the recording comes from.
pub fn extras(args: &Args) -> Result<Extras, Failure> {
    let source = input::identity(&args.input, None)?;
    let texts = BTreeMap::from([
        ("input".to_string(), source.path),
        ("input_sha256".to_string(), source.sha256),
    ]);
    let attachment = |file: &std::path::PathBuf| -> Result<(String, String, Vec<u8>), Failure> {
        let content = std::fs::read(file).map_err(|source| TraceError::File {
            action: "read",
            path: file.clone(),
            source,
        })?;
        let name = file.file_name().unwrap_or_default().to_string_lossy();
        Ok((name.into_owned(), kind(file).to_string(), content))
    };
    let attachments = args.attach.iter().map(attachment);
    Ok(Extras {
        attachments: attachments.collect::<Result<_, _>>()?,
        texts,
    })
}

/// The kind of a file, as the internet calls it.
fn kind(file: &Path) -> &'static str {
    match file.extension().and_then(|extension| extension.to_str()) {
        Some("toml") => "application/toml",
        Some("json") => "application/json",
        Some("csv") => "text/csv",
        _ => "application/octet-stream",
    }
}

fn list(args: &Args) -> Result<Outcome, Failure> {
    let summary = mcap::summary(&args.input)?;
    let file = args.input.display().to_string();
    if args.json {
        let topics = summary.topics.iter().map(|topic| {
            let numbers: Vec<Value> = topic
                .channels
                .iter()
                .map(|c| json!({ "address": c.address, "unit": c.unit, "samples": c.count }))
                .collect();
            json!({ "name": topic.name, "messages": topic.messages, "numbers": numbers })
        });
        let topics: Vec<Value> = topics.collect();
        let said = summary.integrity.lines();
        return print(&json!({ "file": file, "topics": topics, "integrity": said }).to_string());
    }
    let head = std::iter::once(file);
    let said = summary
        .integrity
        .lines()
        .into_iter()
        .map(|line| format!("  {line}"));
    let topics = summary.topics.iter().flat_map(topic_lines);
    let lines = head.chain(said).chain(topics);
    let lines: Vec<String> = lines.map(|line| outcome::plain(&line)).collect();
    print(&lines.join("\n"))
}

fn topic_lines(topic: &TopicSummary) -> Vec<String> {
    let mut lines = vec![format!(
        "  {} ({}): {} messages",
        topic.name, topic.type_name, topic.messages
    )];
    lines.extend(
        topic
            .unreadable
            .iter()
            .map(|reason| format!("    {reason}")),
    );
    lines.extend(topic.channels.iter().map(|channel| {
        let unit = match channel.unit.as_str() {
            "" => String::new(),
            unit => format!(" ({unit})"),
        };
        format!("    {}{unit}  {} samples", channel.address, channel.count)
    }));
    lines
}
