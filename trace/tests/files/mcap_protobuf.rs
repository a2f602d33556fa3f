//! This file reads messages in Protocol Buffers, put together byte by byte.

use std::collections::BTreeMap;
use std::io::Cursor;
use std::path::Path;

use mcap::WriteOptions;
use mcap::records::MessageHeader;
use prost_reflect::prost::Message;
use prost_reflect::prost_types::field_descriptor_proto::{Label, Type};
use prost_reflect::prost_types::{
    DescriptorProto, FieldDescriptorProto, FileDescriptorProto, FileDescriptorSet,
};
use rigproof_trace::mcap::{read_bytes, summarise};

fn field(
    name: &str,
    number: i32,
    kind: Type,
    label: Label,
    of: Option<&str>,
) -> FieldDescriptorProto {
    FieldDescriptorProto {
        name: Some(name.into()),
        number: Some(number),
        r#type: Some(kind.into()),
        label: Some(label.into()),
        type_name: of.map(str::to_string),
        ..Default::default()
    }
}

fn descriptors() -> Vec<u8> {
    let record = |name: &str, fields: Vec<FieldDescriptorProto>| DescriptorProto {
        name: Some(name.into()),
        field: fields,
        ..Default::default()
    };
    let one = Label::Optional;
    let file = FileDescriptorProto {
        name: Some("hand.proto".into()),
        package: Some("lab".into()),
        syntax: Some("proto3".into()),
        message_type: vec![
            record("Tip", vec![field("x_m", 1, Type::Double, one, None)]),
            record(
                "Hand",
                vec![
                    field("torque_nm", 1, Type::Double, one, None),
                    field("load", 2, Type::Float, Label::Repeated, None),
                    field("tip", 3, Type::Message, one, Some(".lab.Tip")),
                    field("count", 4, Type::Sint32, one, None),
                    field("name", 5, Type::String, Label::Repeated, None),
                ],
            ),
        ],
        ..Default::default()
    };
    FileDescriptorSet { file: vec![file] }.encode_to_vec()
}

/// torque_nm −2.75; load 1.5, −0.25; tip.x_m 0.375; count −3; name "a", "b".
fn message() -> Vec<u8> {
    let mut bytes = vec![0x09];
    bytes.extend((-2.75_f64).to_le_bytes());
    bytes.extend([0x12, 8]);
    bytes.extend(1.5_f32.to_le_bytes());
    bytes.extend((-0.25_f32).to_le_bytes());
    bytes.extend([0x1a, 9, 0x09]);
    bytes.extend(0.375_f64.to_le_bytes());
    bytes.extend([0x20, 5]);
    bytes.extend([0x2a, 1, b'a', 0x2a, 1, b'b']);
    bytes
}

fn file(schema: &[u8], message: &[u8]) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    let mut writer = WriteOptions::new().create(&mut bytes).unwrap();
    let schema = writer.add_schema("lab.Hand", "protobuf", schema).unwrap();
    let channel = writer
        .add_channel(schema, "/hand", "protobuf", &BTreeMap::new())
        .unwrap();
    for sequence in 0..3 {
        let header = MessageHeader {
            channel_id: channel,
            sequence,
            log_time: 17 + u64::from(sequence),
            publish_time: 17,
        };
        writer.write_to_known_channel(&header, message).unwrap();
    }
    writer.finish().unwrap();
    drop(writer);
    bytes.into_inner()
}

#[test]
fn numbers_are_read_by_the_descriptors_in_the_file() {
    let bytes = file(&descriptors(), &message());
    let summary = summarise(Cursor::new(&bytes), Path::new("a.mcap")).unwrap();
    let topic = &summary.topics[0];
    assert_eq!(
        (topic.messages, topic.damaged, &topic.unreadable),
        (3, 0, &None)
    );
    let found: Vec<(&str, &str, f64)> = topic
        .channels
        .iter()
        .map(|channel| {
            (
                channel.address.as_str(),
                channel.unit.as_str(),
                channel.maximum,
            )
        })
        .collect();
    assert_eq!(
        found,
        [
            ("/hand.torque_nm", "", -2.75),
            ("/hand.load[name=a]", "", 1.5),
            ("/hand.load[name=b]", "", -0.25),
            ("/hand.tip.x_m", "m", 0.375),
            ("/hand.count", "", -3.0),
        ]
    );
}

#[test]
fn descriptors_and_messages_that_make_no_sense_are_told() {
    let refused = file(b"no descriptors", &message());
    let summary = summarise(Cursor::new(&refused), Path::new("a.mcap")).unwrap();
    let reason = summary.topics[0].unreadable.clone().unwrap();
    assert!(reason.contains("no set of file descriptors"), "{reason}");
    let whole = message();
    for length in [3, 10, 16, 24] {
        let bytes = file(&descriptors(), &whole[..length]);
        let summary = summarise(Cursor::new(&bytes), Path::new("a.mcap")).unwrap();
        assert_eq!(summary.topics[0].damaged, 3, "{length}");
    }
    let descriptors = descriptors();
    for at in 0..descriptors.len() {
        let mut damaged = descriptors.clone();
        damaged[at] ^= 1 << (at % 8);
        read_bytes(&file(&damaged, &whole));
    }
}
