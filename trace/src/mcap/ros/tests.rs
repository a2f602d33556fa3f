//! This file holds messages put together byte by byte.

use super::*;
use crate::mcap::address::{Way, print};
use crate::mcap::flat::ELEMENTS;

const TEXT: &str = "\
# A comment
int32 LIMIT=5
string NAME = \"a # b\"
uint8 flag 7
float64 x 1.5   # metres
string<=10[<=3] name
shapes/Point[2] corner
float32[<=4] load
bool[3] on
================================================================================
MSG: shapes/msg/Point
float64 x
int16 y
";

/// A message of that type; `turn` puts numbers into the byte order.
fn message(head: [u8; 4], turn: impl Fn(&mut [u8])) -> Vec<u8> {
    let mut bytes = head.to_vec();
    let mut add = |padding: usize, number: &[u8]| {
        let mut number = number.to_vec();
        turn(&mut number);
        bytes.extend(vec![0xee; padding]);
        bytes.extend(number);
    };
    add(0, &9_u8.to_le_bytes());
    add(7, &2.25_f64.to_le_bytes());
    add(0, &2_u32.to_le_bytes());
    add(0, &3_u32.to_le_bytes());
    for letter in *b"ab\0" {
        add(0, &[letter]);
    }
    add(1, &2_u32.to_le_bytes());
    for letter in *b"c\0" {
        add(0, &[letter]);
    }
    add(6, &(-7.5_f64).to_le_bytes());
    add(0, &(-301_i16).to_le_bytes());
    add(6, &0.375_f64.to_le_bytes());
    add(0, &17_i16.to_le_bytes());
    add(2, &2_u32.to_le_bytes());
    add(0, &1.25_f32.to_le_bytes());
    add(0, &(-6.5_f32).to_le_bytes());
    for truth in [1, 0, 1] {
        add(0, &[truth]);
    }
    bytes
}

const NUMBERS: [f64; 11] = [
    9.0, 2.25, -7.5, -301.0, 0.375, 17.0, 1.25, -6.5, 1.0, 0.0, 1.0,
];

fn numbers(reader: &RosReader, data: &[u8]) -> Result<Vec<f64>, String> {
    let mut flat = Flat::new(ELEMENTS);
    reader.read(data, &mut flat, false)?;
    Ok(flat.numbers)
}

#[test]
fn both_byte_orders_give_the_same_numbers() {
    let reader = RosReader::new("shapes/msg/Hand", TEXT, Wire::Cdr).unwrap();
    let low = message([0, 1, 0, 0], |_| {});
    let high = message([0, 0, 0, 0], |bytes| bytes.reverse());
    assert_ne!(low, high);
    assert_eq!(numbers(&reader, &low).unwrap(), NUMBERS);
    assert_eq!(numbers(&reader, &high).unwrap(), NUMBERS);
    let refused = numbers(&reader, &[0, 7, 0, 0, 1]).unwrap_err();
    assert!(
        refused.contains("laid out in the way 0x00 0x07"),
        "{refused}"
    );
}

#[test]
fn lists_of_texts_name_the_elements_beside_them() {
    let reader = RosReader::new("shapes/msg/Hand", TEXT, Wire::Cdr).unwrap();
    let mut flat = Flat::new(ELEMENTS);
    reader
        .read(&message([0, 1, 0, 0], |_| {}), &mut flat, true)
        .unwrap();
    let (leaves, _) = flat.learned();
    let printed: Vec<String> = leaves.iter().map(|leaf| print("/hand", leaf)).collect();
    assert_eq!(
        printed[1..4],
        [
            "/hand.x",
            "/hand.corner[name=ab].x",
            "/hand.corner[name=ab].y"
        ]
    );
    for (address, expected) in [
        ("corner[1].y", 17.0),
        ("corner[name=c].x", 0.375),
        ("load[name=c]", -6.5),
        ("on[2]", 1.0),
    ] {
        let way = Way::parse(address).unwrap();
        let place = leaves.iter().position(|leaf| way.leads_to(leaf)).unwrap();
        assert_eq!(flat.numbers[place], expected, "{address}");
    }
}

#[test]
fn a_message_cut_anywhere_is_refused() {
    let reader = RosReader::new("shapes/msg/Hand", TEXT, Wire::Cdr).unwrap();
    let whole = message([0, 1, 0, 0], |_| {});
    for length in 0..whole.len() {
        assert!(numbers(&reader, &whole[..length]).is_err(), "{length}");
    }
}

#[test]
fn counts_that_lie_are_refused_before_anything_is_set_aside() {
    let list = "float64[] x\nstd_msgs/Empty[] e\n===========\nMSG: std_msgs/Empty\n";
    let reader = RosReader::new("a/msg/B", list, Wire::Cdr).unwrap();
    let lying = [0, 1, 0, 0, 0xff, 0xff, 0xff, 0xff, 1, 2, 3, 4, 5, 6, 7, 8];
    let refused = numbers(&reader, &lying).unwrap_err();
    assert!(
        refused.contains("`x` announces 4294967295 elements"),
        "{refused}"
    );
    let empty = RosReader::new("a/B", list, Wire::Ros1).unwrap();
    let many = [0, 0, 0, 0, 0xff, 0xff, 0xff, 0xff];
    assert_eq!(numbers(&empty, &many).unwrap(), [] as [f64; 0]);
    let bounded = RosReader::new("a/msg/B", "uint8[<=2] x", Wire::Cdr).unwrap();
    let refused = numbers(&bounded, &[0, 1, 0, 0, 3, 0, 0, 0, 7, 8, 9]).unwrap_err();
    assert!(
        refused.contains("`x` has 3 elements, its type allows 2"),
        "{refused}"
    );
}

#[test]
fn messages_of_ros_1_stand_close_together() {
    let text = "Header header\nuint8 a\nfloat64 b\nduration wait\n=============\nMSG: std_msgs/Header\nuint32 seq\ntime stamp\nstring frame_id\n";
    let reader = RosReader::new("pkg/Thing", text, Wire::Ros1).unwrap();
    let mut data = Vec::new();
    data.extend(3_u32.to_le_bytes());
    data.extend(1_490_149_580_u32.to_le_bytes());
    data.extend(71_113_143_u32.to_le_bytes());
    data.extend(2_u32.to_le_bytes());
    data.extend(b"hi");
    data.push(200);
    data.extend((-0.7_f64).to_le_bytes());
    data.extend((-4_i32).to_le_bytes());
    data.extend(11_i32.to_le_bytes());
    let expected = [3.0, 1_490_149_580.0, 71_113_143.0, 200.0, -0.7, -4.0, 11.0];
    assert_eq!(numbers(&reader, &data).unwrap(), expected);
}

#[test]
fn long_lists_are_read_past() {
    let reader = RosReader::new("a/msg/B", "uint16[] x\nstring[] s\nint8 y", Wire::Cdr).unwrap();
    let mut data = vec![0, 1, 0, 0];
    data.extend(90_u32.to_le_bytes());
    (0..90_u16).for_each(|k| data.extend((3 * k + 1).to_le_bytes()));
    data.extend(90_u32.to_le_bytes());
    for _ in 0..90 {
        data.extend(4_u32.to_le_bytes());
        data.extend(b"abc\0");
    }
    data.push(0xfb);
    let found = numbers(&reader, &data).unwrap();
    assert_eq!((found.len(), found[63], found[64]), (65, 190.0, -5.0));
}

#[test]
fn definitions_that_make_no_sense_are_refused() {
    for (text, expected) in [
        ("float64 x\nfloat65 y", "lacks the type `a/float65`"),
        ("a/B b", "contains itself"),
        ("C c\n==========\nMSG: a/C\nB b", "contains itself"),
        ("float64", "the line `float64` of its definition is none"),
        ("wstring name", "`name` is a wide text"),
        ("float64[x] y", "the type `float64[x]` is none"),
        ("x y\n==========\nIDL: a/x\nstruct", "in IDL"),
    ] {
        let refused = RosReader::new("a/msg/B", text, Wire::Cdr).unwrap_err();
        assert!(refused.contains(expected), "{refused} lacks {expected}");
    }
}
