//! This file writes what is a joint or a force as the messages of ROS that viewers know.

use std::collections::BTreeMap;
use std::io::{Seek, Write};

use ::mcap::{McapError, Writer};
use rigproof_spec::units::{Dimension, Unit};

use crate::series::{Channel, Trace};

/// The definition of `sensor_msgs/msg/JointState`.
const JOINT_STATE: &str = "\
std_msgs/Header header
string[] name
float64[] position
float64[] velocity
float64[] effort
";
/// The definition of `geometry_msgs/msg/WrenchStamped`.
const WRENCH_STAMPED: &str = "\
std_msgs/Header header
geometry_msgs/Wrench wrench
================================================================================
MSG: geometry_msgs/Wrench
geometry_msgs/Vector3 force
geometry_msgs/Vector3 torque
================================================================================
MSG: geometry_msgs/Vector3
float64 x
float64 y
float64 z
";
/// The types that both of them use.
const HEADER: &str = "\
================================================================================
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
================================================================================
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
";

/// A channel of the recording and its factor to SI.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Source {
    channel: usize,
    to_si: f64,
}

/// Which channels are joints, and which are forces.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Joints {
    names: Vec<String>,
    /// As many as there are names, or none.
    position: Vec<Source>,
    velocity: Vec<Source>,
    effort: Vec<Source>,
    /// Force along x, y, z and torque about x, y, z.
    wrench: [Option<Source>; 6],
}

/// The channels of the file that they are written to.
pub(super) struct Declared {
    joints: Option<u16>,
    wrench: Option<u16>,
}

impl Joints {
    /// Every channel in a unit of displacement is a joint. Speeds and efforts belong to the joints in their order where
    /// there are as many of them, and stay out of the joints where there are not.
    pub(super) fn of(trace: &Trace) -> Joints {
        let per_s = |dimension: Dimension| dimension.per(Dimension::TIME);
        let position = sources(trace, &[Dimension::LENGTH, Dimension::ANGLE]);
        let suits = |sources: Vec<Source>| match sources.len() == position.len() {
            true => sources,
            false => Vec::new(),
        };
        let speeds = [per_s(Dimension::LENGTH), per_s(Dimension::ANGLE)];
        let name = |source: &Source| Some(trace.channels.get(source.channel)?.name.clone());
        let force = axes(trace, Dimension::FORCE, 0);
        let torque = axes(trace, Dimension::TORQUE, 2);
        let mut wrench = [None; 6];
        for (place, source) in wrench.iter_mut().zip(force.into_iter().chain(torque)) {
            *place = source;
        }
        Joints {
            names: position.iter().filter_map(name).collect(),
            velocity: suits(sources(trace, &speeds)),
            effort: suits(sources(trace, &[Dimension::FORCE, Dimension::TORQUE])),
            position,
            wrench,
        }
    }

    /// Declares the channels that there is something for.
    pub(super) fn declare<W: Write + Seek>(
        &self,
        writer: &mut Writer<W>,
    ) -> Result<Declared, McapError> {
        let mut declare = |topic: &str, name: &str, definition: &str| {
            let text = [definition, HEADER].concat();
            let schema = writer.add_schema(name, "ros2msg", text.as_bytes())?;
            writer.add_channel(schema, topic, "cdr", &BTreeMap::new())
        };
        let joints = !self.position.is_empty();
        let wrench = self.wrench.iter().any(Option::is_some);
        Ok(Declared {
            joints: joints
                .then(|| declare("/joint_states", "sensor_msgs/msg/JointState", JOINT_STATE))
                .transpose()?,
            wrench: wrench
                .then(|| declare("/wrench", "geometry_msgs/msg/WrenchStamped", WRENCH_STAMPED))
                .transpose()?,
        })
    }

    /// The messages of one sample and their channels.
    pub(super) fn messages(
        &self,
        trace: &Trace,
        row: usize,
        log_time: u64,
        declared: &Declared,
    ) -> Vec<(u16, Vec<u8>)> {
        let value = |source: Source| {
            let channel = trace.channels.get(source.channel);
            let sample = channel.and_then(|channel| channel.samples.get(row));
            sample.map_or(f64::NAN, |sample| sample * source.to_si)
        };
        let mut messages = Vec::new();
        if let Some(channel) = declared.joints {
            let mut message = Cdr::stamped(log_time);
            message.count(self.names.len());
            self.names.iter().for_each(|name| message.text(name));
            for list in [&self.position, &self.velocity, &self.effort] {
                message.count(list.len());
                list.iter()
                    .for_each(|source| message.number(value(*source)));
            }
            messages.push((channel, message.bytes));
        }
        if let Some(channel) = declared.wrench {
            let mut message = Cdr::stamped(log_time);
            for source in self.wrench {
                // What was not measured is no zero.
                message.number(source.map_or(f64::NAN, value));
            }
            messages.push((channel, message.bytes));
        }
        messages
    }
}

/// The channels in units of these kinds.
fn sources(trace: &Trace, kinds: &[Dimension]) -> Vec<Source> {
    let source = |(channel, content): (usize, &Channel)| {
        let unit = Unit::parse(content.likely_unit())?;
        let to_si = unit.to_si;
        kinds
            .contains(&unit.dimension)
            .then_some(Source { channel, to_si })
    };
    trace
        .channels
        .iter()
        .enumerate()
        .filter_map(source)
        .collect()
}

/// The channels of one kind along the axes that their names end in; one without such a name is along `usual`.
fn axes(trace: &Trace, kind: Dimension, usual: usize) -> [Option<Source>; 3] {
    let mut axes = [None; 3];
    for source in sources(trace, &[kind]) {
        let name = trace
            .channels
            .get(source.channel)
            .map_or("", |channel| &channel.name);
        let end = name.to_lowercase();
        let named = ["x", "y", "z"].iter().position(|axis| {
            let before = end.strip_suffix(axis);
            before.is_some_and(|before| before.len() < 2 || before.ends_with(['_', '.', '/']))
        });
        if let Some(place) = axes.get_mut(named.unwrap_or(usual))
            && place.is_none()
        {
            *place = Some(source);
        }
    }
    axes
}

/// A message of ROS 2, lowest byte first.
struct Cdr {
    bytes: Vec<u8>,
}

impl Cdr {
    /// A message that begins with a header: the stamp, and no frame.
    fn stamped(log_time: u64) -> Cdr {
        let mut message = Cdr {
            bytes: vec![0, 1, 0, 0],
        };
        // Below 2^31 s, as the layout has checked.
        message
            .bytes
            .extend(((log_time / 1_000_000_000) as u32).to_le_bytes());
        message
            .bytes
            .extend(((log_time % 1_000_000_000) as u32).to_le_bytes());
        message.text("");
        message
    }

    /// Numbers stand at multiples of their size, counted from behind the first four bytes.
    fn align(&mut self, size: usize) {
        let length = (self.bytes.len() - 4).next_multiple_of(size) + 4;
        self.bytes.resize(length, 0);
    }

    fn count(&mut self, count: usize) {
        self.align(4);
        self.bytes.extend((count as u32).to_le_bytes());
    }

    fn text(&mut self, text: &str) {
        self.count(text.len() + 1);
        self.bytes.extend(text.as_bytes());
        self.bytes.push(0);
    }

    fn number(&mut self, number: f64) {
        self.align(8);
        self.bytes.extend(number.to_le_bytes());
    }
}
