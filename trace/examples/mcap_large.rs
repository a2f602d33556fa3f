//! This file makes a large MCAP file: messages of ROS 2 of about 300 bytes, packed or not.
//!
//! `cargo run --profile bench -p rigproof-trace --example mcap_large -- FILE MEGABYTES [zstd]`

use std::collections::BTreeMap;
use std::error::Error;
use std::fs::{self, File};
use std::io::BufWriter;
use std::path::{Path, PathBuf};

use mcap::records::MessageHeader;
use mcap::{Compression, WriteOptions};

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

fn make(
    path: &Path,
    bytes: u64,
    compression: Option<Compression>,
) -> Result<(u32, u64), Box<dyn Error>> {
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
    Ok((sequence, written))
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let path = PathBuf::from(arguments.next().ok_or("name a file to make")?);
    let megabytes: u64 = arguments.next().ok_or("say how many megabytes")?.parse()?;
    let packed = arguments.next().is_some_and(|word| word == "zstd");
    let compression = packed.then_some(Compression::Zstd);
    let (messages, bytes) = make(&path, megabytes * 1_000_000, compression)?;
    let in_file = fs::metadata(&path)?.len();
    println!("{messages} messages, {bytes} bytes, {in_file} in the file");
    Ok(())
}
