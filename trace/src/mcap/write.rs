//! This file writes a recording as an MCAP file that viewers plot as it is.

mod joints;

use std::collections::BTreeMap;
use std::io::{BufWriter, Cursor, Seek, Write};
use std::path::Path;

use ::mcap::records::{MessageHeader, Metadata};
use ::mcap::{Attachment, Compression, McapError, WriteOptions, Writer};

use super::run::{Run, TOPIC};
use crate::error::TraceError;
use crate::series::Trace;
use crate::store;
use joints::Joints;

/// Bytes of a chunk before it is packed.
const CHUNK_BYTES: u64 = 128 << 10;

/// What goes into a file beside the recording.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Extras {
    /// Files, such as the rig description and the calibration: name, kind (`application/toml`) and content.
    pub attachments: Vec<(String, String, Vec<u8>)>,
    /// Texts by topic: where the run comes from, its seeds, the SHA-256 of its inputs.
    pub texts: BTreeMap<String, String>,
}

/// Writes a recording as an MCAP file, whole or not at all.
///
/// Three channels: `/rigproof/run` in JSON with every channel and the exact time, `/joint_states`
/// (`sensor_msgs/msg/JointState`, SI units) where there are displacements, and `/wrench`
/// (`geometry_msgs/msg/WrenchStamped`) where there is a force or a torque.
///
/// # Errors
/// A value is infinite, a time stamp does not fit, lengths differ, or the system refuses.
pub fn write(path: &Path, trace: &Trace, extras: &Extras) -> Result<(), TraceError> {
    let layout = Layout::new(trace).map_err(|problem| TraceError::recording(path, problem))?;
    store::write_aside_with(path, |file| {
        let mut buffered = BufWriter::with_capacity(1 << 18, file);
        layout
            .write(&mut buffered, trace, extras)
            .map_err(in_words)?;
        buffered.flush()
    })
}

/// As [`write()`], into memory.
///
/// # Errors
/// As [`write()`], in words.
pub fn to_bytes(trace: &Trace, extras: &Extras) -> Result<Vec<u8>, String> {
    let mut bytes = Cursor::new(Vec::new());
    let layout = Layout::new(trace)?;
    let written = layout.write(&mut bytes, trace, extras);
    written.map_err(|error| in_words(error).to_string())?;
    Ok(bytes.into_inner())
}

fn in_words(error: McapError) -> std::io::Error {
    match error {
        McapError::Io(error) => error,
        other => std::io::Error::other(other.to_string()),
    }
}

/// What of a recording goes where.
struct Layout {
    run: Run,
    joints: Joints,
    /// What log time counts from, s: 0, or a second before the first stamp where that is negative.
    origin_s: f64,
}

impl Layout {
    fn new(trace: &Trace) -> Result<Layout, String> {
        let count = trace.len();
        for channel in &trace.channels {
            let name = &channel.name;
            if channel.samples.len() != count {
                let found = channel.samples.len();
                return Err(format!(
                    "`{name}` has {found} samples and the time {count}; nothing was written"
                ));
            }
            if channel.samples.iter().any(|value| value.is_infinite()) {
                return Err(format!(
                    "`{name}` holds an infinite value; leave it missing"
                ));
            }
        }
        let ordered = trace
            .time_s
            .windows(2)
            .all(|pair| matches!(pair, [a, b] if a < b));
        let first_s = trace.time_s.first().copied().unwrap_or(0.0);
        let last_s = trace.time_s.last().copied().unwrap_or(0.0);
        let origin_s = first_s.min(0.0).floor();
        if !ordered || !first_s.is_finite() {
            return Err("time does not grow from sample to sample; nothing was written".into());
        }
        // The stamps of ROS count seconds in 31 bits.
        if last_s - origin_s >= f64::from(i32::MAX) {
            return Err(format!(
                "the time stamp {last_s} s does not fit: 68 years are the most"
            ));
        }
        Ok(Layout {
            run: Run::for_trace(trace),
            joints: Joints::of(trace),
            origin_s,
        })
    }

    fn write<W: Write + Seek>(
        &self,
        target: W,
        trace: &Trace,
        extras: &Extras,
    ) -> Result<(), McapError> {
        let mut writer = WriteOptions::new()
            .profile("")
            .library(concat!("rigproof ", env!("CARGO_PKG_VERSION")))
            .chunk_size(Some(CHUNK_BYTES))
            .compression(Some(Compression::Zstd))
            // With workers the bytes would depend on their number.
            .compression_threads(0)
            .create(target)?;
        let schema =
            writer.add_schema("rigproof.Run", "jsonschema", self.run.schema().as_bytes())?;
        let run = writer.add_channel(schema, TOPIC, "json", &self.run.metadata())?;
        let joints = self.joints.declare(&mut writer)?;
        self.write_texts(&mut writer, extras)?;
        let mut text = Vec::new();
        for (row, time_s) in trace.time_s.iter().enumerate() {
            // Not negative and below 2^62, as checked before.
            let log_time = ((time_s - self.origin_s) * 1e9).round() as u64;
            let header = |channel_id| MessageHeader {
                channel_id,
                sequence: row as u32,
                log_time,
                publish_time: log_time,
            };
            self.json(trace, row, *time_s, &mut text)?;
            writer.write_to_known_channel(&header(run), &text)?;
            for (channel, message) in self.joints.messages(trace, row, log_time, &joints) {
                writer.write_to_known_channel(&header(channel), &message)?;
            }
        }
        for (name, media_type, data) in &extras.attachments {
            writer.attach(&Attachment {
                log_time: 0,
                create_time: 0,
                name: name.clone(),
                media_type: media_type.clone(),
                data: data.into(),
            })?;
        }
        // Dropping the writer instead would hide what goes wrong here.
        writer.finish()?;
        Ok(())
    }

    fn write_texts<W: Write + Seek>(
        &self,
        writer: &mut Writer<W>,
        extras: &Extras,
    ) -> Result<(), McapError> {
        let mut metadata = extras.texts.clone();
        metadata.insert("version".into(), env!("CARGO_PKG_VERSION").into());
        metadata.insert("log_time_origin_s".into(), self.origin_s.to_string());
        let name = "rigproof".to_string();
        writer.write_metadata(&Metadata { name, metadata })
    }

    /// One sample of every channel; what is missing is left out.
    fn json(
        &self,
        trace: &Trace,
        row: usize,
        time_s: f64,
        text: &mut Vec<u8>,
    ) -> Result<(), McapError> {
        text.clear();
        text.extend(b"{");
        let columns = self.run.columns.iter().zip(&trace.channels);
        let values = columns.map(|(column, channel)| (&column.key, channel.samples.get(row)));
        let time = std::iter::once((&self.run.time, Some(&time_s)));
        for (key, value) in time.chain(values) {
            if let Some(value) = value.filter(|value| !value.is_nan()) {
                if text.len() > 1 {
                    text.push(b',');
                }
                let json = |error: serde_json::Error| McapError::Io(error.into());
                serde_json::to_writer(&mut *text, key).map_err(json)?;
                text.push(b':');
                serde_json::to_writer(&mut *text, value).map_err(json)?;
            }
        }
        text.push(b'}');
        Ok(())
    }
}

#[cfg(test)]
mod tests;
