//! This file writes messages of three numbers in every encoding and packing that the reader of MCAP knows, and MATLAB files of the newer form.

use std::collections::BTreeMap;
use std::io::Cursor;
use std::path::Path;

use hdf5_pure::FileBuilder;
use mcap::records::MessageHeader;
use mcap::{Compression, WriteOptions};
use prost_reflect::prost::Message;
use prost_reflect::prost_types::field_descriptor_proto::{Label, Type};
use prost_reflect::prost_types::{
    DescriptorProto, FieldDescriptorProto, FileDescriptorProto, FileDescriptorSet,
};

/// The topic, and the numbers of its messages.
pub const ADDRESSES: [&str; 3] = ["/tip.x", "/tip.y", "/tip.z"];

/// How messages are written.
#[derive(Clone, Copy, Debug)]
pub enum Encoding {
    Json,
    Ros2,
    Ros1,
    Protobuf,
}

impl Encoding {
    /// Schema name, its encoding, its text, and the messages' encoding.
    fn schema(self) -> (&'static str, &'static str, Vec<u8>, &'static str) {
        let plain = b"float64 x\nfloat64 y\nfloat64 z\n".to_vec();
        match self {
            Encoding::Json => ("", "", Vec::new(), "json"),
            Encoding::Ros2 => ("geometry_msgs/msg/Vector3", "ros2msg", plain, "cdr"),
            Encoding::Ros1 => ("geometry_msgs/Vector3", "ros1msg", plain, "ros1"),
            Encoding::Protobuf => ("lab.Tip", "protobuf", descriptors(), "protobuf"),
        }
    }

    fn message(self, [x, y, z]: [f64; 3]) -> Vec<u8> {
        let bytes = |head: &[u8]| {
            let all = [x, y, z].into_iter().flat_map(f64::to_le_bytes);
            head.iter().copied().chain(all).collect()
        };
        match self {
            Encoding::Json => format!("{{\"x\":{x},\"y\":{y},\"z\":{z}}}").into_bytes(),
            Encoding::Ros2 => bytes(&[0, 1, 0, 0]),
            Encoding::Ros1 => bytes(&[]),
            Encoding::Protobuf => {
                let fields = [(0x09, x), (0x11, y), (0x19, z)];
                let one = |(tag, value): (u8, f64)| [vec![tag], value.to_le_bytes().to_vec()];
                fields.into_iter().flat_map(one).flatten().collect()
            }
        }
    }
}

fn descriptors() -> Vec<u8> {
    let field = |(name, number): (&str, i32)| FieldDescriptorProto {
        name: Some(name.into()),
        number: Some(number),
        r#type: Some(Type::Double.into()),
        label: Some(Label::Optional.into()),
        ..Default::default()
    };
    let file = FileDescriptorProto {
        name: Some("tip.proto".into()),
        package: Some("lab".into()),
        syntax: Some("proto3".into()),
        message_type: vec![DescriptorProto {
            name: Some("Tip".into()),
            field: [("x", 1), ("y", 2), ("z", 3)].map(field).to_vec(),
            ..Default::default()
        }],
        ..Default::default()
    };
    FileDescriptorSet { file: vec![file] }.encode_to_vec()
}

/// A file of so many messages.
pub fn messages(file: &Path, encoding: Encoding, packed: Option<Compression>, count: u32) {
    let mut bytes = Cursor::new(Vec::new());
    let options = WriteOptions::new().compression(packed);
    let mut writer = options.create(&mut bytes).unwrap();
    let (name, of_schema, text, of_messages) = encoding.schema();
    let schema = match name.is_empty() {
        true => 0,
        false => writer.add_schema(name, of_schema, &text).unwrap(),
    };
    let channel = writer
        .add_channel(schema, "/tip", of_messages, &BTreeMap::new())
        .unwrap();
    for sequence in 0..count {
        let time = 7_000_003 + 1_000_000 * u64::from(sequence);
        let header = MessageHeader {
            channel_id: channel,
            sequence,
            log_time: time,
            publish_time: time,
        };
        let k = f64::from(sequence);
        let message = encoding.message([0.25 * k, libm::sin(0.37 * k), -1.5]);
        writer.write_to_known_channel(&header, &message).unwrap();
    }
    writer.finish().unwrap();
    drop(writer);
    std::fs::write(file, bytes.into_inner()).unwrap();
}

/// A MATLAB file of the newer form, of so many numbers.
pub fn matlab_7_3(file: &Path, numbers: usize) {
    let mut builder = FileBuilder::new();
    builder
        .with_userblock(512)
        .with_userblock_content(b"MATLAB 7.3 MAT-file, made here");
    for name in ["x", "y"] {
        let values: Vec<f64> = (0..numbers).map(|k| libm::sin(0.37 * k as f64)).collect();
        let data = builder.create_dataset(name);
        data.with_f64_data(&values).with_shape(&[1, numbers as u64]);
    }
    builder.write(file).unwrap();
}
