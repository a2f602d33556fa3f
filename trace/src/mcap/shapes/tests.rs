//! This file holds messages that resemble the one before, more or less.

use std::collections::BTreeMap;
use std::sync::Arc;

use proptest::prelude::*;

use super::*;
use crate::mcap::address::print;
use crate::mcap::flat::ELEMENTS;
use crate::mcap::topics::{Schema, Topic};

/// A message: a text that names nothing, numbers, texts that name them, and a number behind.
#[derive(Clone, Debug)]
struct Joints {
    highest_first: bool,
    note: &'static str,
    x: Vec<f64>,
    name: Vec<&'static str>,
    last: i16,
}

impl Joints {
    /// The message as ROS 2 lays it out.
    fn bytes(&self) -> Vec<u8> {
        let mut body = Vec::new();
        let add = |body: &mut Vec<u8>, size: usize, number: &[u8]| {
            body.resize(body.len().next_multiple_of(size), 0xee);
            match self.highest_first {
                true => body.extend(number.iter().rev()),
                false => body.extend(number),
            }
        };
        let count = |body: &mut Vec<u8>, count: usize| add(body, 4, &(count as u32).to_le_bytes());
        let text = |body: &mut Vec<u8>, text: &str| {
            count(body, text.len() + 1);
            body.extend(text.as_bytes());
            body.push(0);
        };
        text(&mut body, self.note);
        count(&mut body, self.x.len());
        for x in &self.x {
            add(&mut body, 8, &x.to_le_bytes());
        }
        count(&mut body, self.name.len());
        for name in &self.name {
            text(&mut body, name);
        }
        add(&mut body, 2, &self.last.to_le_bytes());
        let head = [0, u8::from(!self.highest_first), 0, 0];
        [head.as_slice(), &body].concat()
    }

    /// Its numbers and what they are called.
    fn numbers(&self) -> Vec<(String, f64)> {
        let x = self.x.iter().enumerate();
        let named = x.map(|(k, x)| match self.name.get(k) {
            Some(name) => (format!("/t.x[name={name}]"), *x),
            None => (format!("/t.x[{k}]"), *x),
        });
        let last = ("/t.last".to_string(), f64::from(self.last));
        named.chain([last]).collect()
    }
}

fn decoder() -> Decoder {
    let schema = Schema {
        name: "a/msg/Joints".into(),
        encoding: "ros2msg".into(),
        data: b"string note\nfloat64[] x\nstring[] name\nint16 last\n".to_vec(),
    };
    let topic = Topic::new("/t", "cdr", Some(Arc::new(schema)), BTreeMap::new());
    Decoder::new(&topic).unwrap()
}

/// Reads messages one after another, and answers their numbers and how many were not walked through.
fn read(messages: &[Joints]) -> (Vec<Vec<(String, f64)>>, usize) {
    let decoder = decoder();
    let (mut shapes, mut flat) = (Shapes::new(), Flat::new(ELEMENTS));
    let mut tracked = 0;
    let each = messages.iter().map(|message| {
        let bytes = message.bytes();
        let learn = |leaves: &[Leaf]| leaves.iter().map(|leaf| print("/t", leaf)).collect();
        let read = shapes.read(&decoder, &bytes, &mut flat, learn).unwrap();
        let (names, numbers): (&Vec<String>, _) = read.unwrap();
        tracked += usize::from(matches!(numbers, Numbers::Tracked(..)));
        let named = names.iter().enumerate();
        named
            .map(|(k, name)| (name.clone(), numbers.at(k)))
            .collect()
    });
    (each.collect(), tracked)
}

fn joints() -> impl Strategy<Value = Joints> {
    let names = prop::collection::vec(prop::sample::select(vec!["a", "b", "elbow"]), 0..3);
    let x = prop::collection::vec(-7.5..9.25_f64, 0..4);
    let note = prop::sample::select(vec!["", "x", "base"]);
    (any::<bool>(), note, x, names, any::<i16>()).prop_map(
        |(highest_first, note, x, name, last)| Joints {
            highest_first,
            note,
            x,
            name,
            last,
        },
    )
}

proptest! {
    #[test]
    fn whatever_came_before_a_message_has_its_own_numbers(
        kinds in prop::collection::vec(joints(), 1..4),
        order in prop::collection::vec((0..3_usize, -3.5..4.5_f64), 1..60),
    ) {
        // The same few layouts again and again, with other numbers.
        let messages: Vec<Joints> = order.iter().map(|(kind, shift)| {
            let mut message = kinds[kind % kinds.len()].clone();
            message.x.iter_mut().for_each(|x| *x += shift);
            message.last = message.last.wrapping_add((shift * 1e3) as i16);
            message
        }).collect();
        let (read, _) = read(&messages);
        let expected: Vec<_> = messages.iter().map(Joints::numbers).collect();
        prop_assert_eq!(read, expected);
    }
}

#[test]
fn a_message_laid_out_as_the_one_before_is_not_walked_through() {
    let like = |note: &'static str, shift: f64| Joints {
        highest_first: false,
        note,
        x: vec![1.5 + shift, -2.25 * shift],
        name: vec!["elbow", "wrist"],
        last: 301,
    };
    // The first one is unlike the rest.
    let first = std::iter::once(like("starting", 0.75));
    let rest = (0..1000).map(|k| like("base", 0.3 * f64::from(k)));
    let messages: Vec<Joints> = first.chain(rest).collect();
    let (numbers, tracked) = read(&messages);
    let expected: Vec<_> = messages.iter().map(Joints::numbers).collect();
    assert_eq!(numbers, expected);
    assert_eq!(tracked, 999);
    // Elbow and wrist changed places: the bytes are as many as before.
    let mut turned = messages[..3].to_vec();
    turned[2].name.reverse();
    assert_eq!(read(&turned).0[2], turned[2].numbers());
}
