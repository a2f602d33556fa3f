//! This file makes a large MCAP file and sets our reading of it beside the bare iteration of the format's own crate.
//!
//! `cargo run --profile bench -p rigproof-trace --example mcap_speed -- FILE [MEGABYTES]`; the file is taken away again.

use std::collections::BTreeMap;
use std::error::Error;
use std::fs::{self, File};
use std::io::{BufReader, BufWriter};
use std::path::{Path, PathBuf};

use mcap::records::MessageHeader;
use mcap::sans_io::{LinearReadEvent, LinearReader, LinearReaderOptions};
use mcap::{Compression, WriteOptions};
use rigproof_trace::mcap::{Between, Selection, Wanted, read, summary};

/// A message of ROS 2: six joints with positions, velocities and efforts, about 300 bytes.
fn joint_state(row: u32) -> Vec<u8> {
    let mut bytes = vec![0, 1, 0, 0];
    let count = |bytes: &mut Vec<u8>, count: u32| {
        bytes.resize((bytes.len() - 4).next_multiple_of(4) + 4, 0);
        bytes.extend(count.to_le_bytes());
    };
    bytes.extend((row / 1000).to_le_bytes());
    bytes.extend((row % 1000 * 1_000_000).to_le_bytes());
    count(&mut bytes, 5);
    bytes.extend(b"base\0");
    count(&mut bytes, 6);
    for joint in 0..6 {
        let name = format!("joint_{joint}\0");
        count(&mut bytes, name.len() as u32);
        bytes.extend(name.as_bytes());
    }
    for list in 0..3 {
        count(&mut bytes, 6);
        bytes.resize((bytes.len() - 4).next_multiple_of(8) + 4, 0);
        for joint in 0..6 {
            let angle = f64::from(row) * 1e-3 + f64::from(joint + list);
            bytes.extend(libm::sin(angle).to_le_bytes());
        }
    }
    bytes
}

const DEFINITION: &str = "std_msgs/Header header\nstring[] name\nfloat64[] position\nfloat64[] velocity\nfloat64[] effort\n\
================================================================================\nMSG: std_msgs/Header\n\
builtin_interfaces/Time stamp\nstring frame_id\n";

fn make(path: &Path, bytes: u64, compression: Option<Compression>) -> Result<u64, Box<dyn Error>> {
    let options = WriteOptions::new()
        .compression(compression)
        .compression_level(1);
    let mut writer = options.create(BufWriter::new(File::create(path)?))?;
    let schema = writer.add_schema(
        "sensor_msgs/msg/JointState",
        "ros2msg",
        DEFINITION.as_bytes(),
    )?;
    let channel = writer.add_channel(schema, "/joint_states", "cdr", &BTreeMap::new())?;
    let (mut written, mut sequence) = (0, 0);
    while written < bytes {
        let time = 1_000_000 * u64::from(sequence);
        let header = MessageHeader {
            channel_id: channel,
            sequence,
            log_time: time,
            publish_time: time,
        };
        let message = joint_state(sequence);
        writer.write_to_known_channel(&header, &message)?;
        written += 31 + message.len() as u64;
        sequence += 1;
    }
    writer.finish()?;
    Ok(written)
}

/// Every message, its bytes not looked into: with the checks of the crate that we make too, or without.
fn bare(path: &Path, checked: bool) -> Result<u64, Box<dyn Error>> {
    use std::io::Read;
    let mut file = BufReader::with_capacity(1 << 18, File::open(path)?);
    let options = LinearReaderOptions::default()
        .with_prevalidate_chunk_crcs(checked)
        .with_validate_data_section_crc(checked)
        .with_validate_summary_section_crc(checked)
        .with_record_length_limit(32 << 20);
    let mut reader = LinearReader::new_with_options(options);
    let mut messages = 0;
    while let Some(event) = reader.next_event() {
        match event? {
            LinearReadEvent::ReadRequest(need) => {
                let read = file.read(reader.insert(need))?;
                reader.notify_read(read);
            }
            LinearReadEvent::Record { data, opcode } => {
                if let mcap::records::Record::Message { header, data } =
                    mcap::parse_record(opcode, data)?
                {
                    messages += u64::from(!data.is_empty() && header.log_time < u64::MAX);
                }
            }
        }
    }
    Ok(messages)
}

/// Seconds that this thread has computed, where the system counts them: other programs do not disturb it.
fn cpu_s() -> Result<f64, Box<dyn Error>> {
    let times = fs::read_to_string("/proc/self/schedstat")?;
    let ns: f64 = times.split(' ').next().ok_or("no time")?.parse()?;
    Ok(ns * 1e-9)
}

fn timed<T>(
    what: &str,
    bytes: u64,
    run: impl FnOnce() -> Result<T, Box<dyn Error>>,
) -> Result<(T, f64), Box<dyn Error>> {
    let start = cpu_s()?;
    let result = run()?;
    let seconds = cpu_s()? - start;
    println!(
        "  {what}: {seconds:.2} s, {:.0} MB/s",
        bytes as f64 / 1e6 / seconds
    );
    Ok((result, seconds))
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let path = PathBuf::from(arguments.next().ok_or("name a file to make")?);
    let megabytes: u64 = arguments.next().map_or(Ok(1000), |text| text.parse())?;
    for compression in [None, Some(Compression::Zstd)] {
        let bytes = make(&path, megabytes * 1_000_000, compression)?;
        let on_disk = fs::metadata(&path)?.len();
        println!("{bytes} bytes of messages, {on_disk} in the file, {compression:?}");
        let selection = Selection {
            channels: ["position[name=joint_2]", "effort[name=joint_4]"]
                .map(|field| Wanted {
                    address: format!("/joint_states.{field}"),
                    between: Between::Line,
                })
                .to_vec(),
            time: None,
        };
        // The first pass brings the file into the system's cache.
        bare(&path, false)?;
        let (_, plain_s) = timed("crate, bare", bytes, || bare(&path, false))?;
        let (_, checked_s) = timed("crate, checked", bytes, || bare(&path, true))?;
        let (reading, read_s) = timed("two numbers read, checked", bytes, || {
            Ok(read(&path, &selection)?)
        })?;
        let (_, summary_s) = timed("everything summed up, checked", bytes, || {
            Ok(summary(&path)?)
        })?;
        println!(
            "  {} samples; of the bare speed: read {:.0} %, summary {:.0} %; of the checked speed: read {:.0} %, summary {:.0} %",
            reading.trace.len(),
            100.0 * plain_s / read_s,
            100.0 * plain_s / summary_s,
            100.0 * checked_s / read_s,
            100.0 * checked_s / summary_s
        );
        if let Some(line) = fs::read_to_string("/proc/self/status")?
            .lines()
            .find(|line| line.starts_with("VmHWM"))
        {
            println!("  {line}");
        }
        fs::remove_file(&path)?;
    }
    Ok(())
}
