//! This file says what the campaign and the process of a controller tell each other: one request, one answer, numbers in little-endian order.

use rigproof_impl::tick::{Sensed, Settings};
use rigproof_impl::vector::Vector;
use rigproof_spec::geometry::Arms;
use rigproof_spec::layout::Layout;

use crate::axis::controller as axis;
use crate::controller::Task;

pub use super::end::{End, LOST};

/// What is told.
#[derive(Clone, Debug, PartialEq)]
pub enum Message {
    /// Asked: begin a trial.
    Begin(Box<Begin>),
    /// Asked: one tick.
    Tick(Sensed<f64>),
    /// Asked of a controller of an axis: begin a trial.
    BeginAxis(axis::Settings),
    /// Asked of a controller of an axis: one tick.
    TickAxis(axis::Sensed),
    /// Asked: the trial is over.
    Over,
    /// Answered: it is done.
    Done,
    /// Answered: the currents, A.
    Currents([f64; 4]),
    /// Answered: the effort, N or N·m.
    Effort(f64),
    /// Answered: the controller's status, which is not 0.
    Status(i32),
    /// Answered: where it wrote though it must not.
    WroteOutside(String),
    /// Answered: the trial is over, and so many processes that the controller had started are running.
    Left(u32),
    /// Answered: why the library cannot be used.
    Unusable(String),
    /// Said by the watch: how the process ended, and how many others that it had started were ended with it.
    Ended(End, u32),
}

/// The rig and the path of a trial.
#[derive(Clone, Debug, PartialEq)]
pub struct Begin {
    /// The rig.
    pub settings: Settings,
    /// The path.
    pub task: Task,
}

/// The number of a chain in messages and in the header.
pub const CHAIN: u32 = 0;
/// The number of an arc.
pub const ARC: u32 = 1;
/// The number of a spline.
pub const SPLINE: u32 = 2;

impl Begin {
    /// Lengths of AE, ED, BC, CD and AB, m: the order in which all who are told them are told.
    pub fn arms_m(&self) -> [f64; 5] {
        let Arms {
            l_ae_m,
            l_ed_m,
            l_bc_m,
            l_cd_m,
            l_ab_m,
        } = self.settings.arms;
        [l_ae_m, l_ed_m, l_bc_m, l_cd_m, l_ab_m]
    }

    /// How many brakes the layout has.
    pub fn brakes(&self) -> u32 {
        self.settings.layout.brakes().len() as u32
    }

    /// The number of the kind of path.
    pub const fn task_number(&self) -> u32 {
        match self.task {
            Task::Chain(_) => CHAIN,
            Task::Arc { .. } => ARC,
            Task::Spline(_) => SPLINE,
        }
    }

    /// The points of a chain or a spline, m; none of an arc.
    pub fn points_m(&self) -> &[[f64; 2]] {
        match &self.task {
            Task::Chain(points_m) | Task::Spline(points_m) => points_m,
            Task::Arc { .. } => &[],
        }
    }

    /// Centre, x and y, and radius, m, first and last angle, rad, of an arc.
    pub const fn arc(&self) -> Option<[f64; 5]> {
        match self.task {
            Task::Arc {
                centre_m: [x, y],
                radius_m,
                from_rad,
                to_rad,
            } => Some([x, y, radius_m, from_rad, to_rad]),
            _ => None,
        }
    }
}

/// Size of what stands before every message: its kind, its length in bytes, and the number of the request, which the answer repeats.
pub const HEAD: usize = 16;
/// Longest message, bytes.
pub const LONGEST: usize = 4096;

/// Writes a message with its head at the end of `out`.
pub fn encode(number: u64, message: &Message, out: &mut Vec<u8>) {
    let start = out.len();
    out.extend_from_slice(&kind(message));
    out.extend_from_slice(&[0; 4]);
    out.extend_from_slice(&number.to_le_bytes());
    match message {
        Message::Begin(begin) => encode_begin(begin, out),
        Message::Tick(sensed) => {
            out.extend_from_slice(&sensed.number.to_le_bytes());
            for count in sensed.counts {
                out.extend_from_slice(&count.to_le_bytes());
            }
            put(out, [sensed.tip_force_n.x, sensed.tip_force_n.y]);
        }
        Message::BeginAxis(settings) => {
            out.extend_from_slice(&u32::from(settings.is_rotary).to_le_bytes());
            put(out, settings.numbers());
        }
        Message::TickAxis(sensed) => {
            out.extend_from_slice(&sensed.number.to_le_bytes());
            put(out, sensed.numbers());
        }
        Message::Over | Message::Done => {}
        Message::Currents(currents_a) => put(out, *currents_a),
        Message::Effort(effort) => put(out, [*effort]),
        Message::Status(status) => out.extend_from_slice(&status.to_le_bytes()),
        Message::Left(count) => out.extend_from_slice(&count.to_le_bytes()),
        Message::WroteOutside(text) | Message::Unusable(text) => {
            let most = LONGEST.min(text.len());
            out.extend(text.as_bytes().iter().take(most));
        }
        Message::Ended(end, left) => {
            let (how, number) = match *end {
                End::Code(code) => (0_u32, code),
                End::Signal(signal) => (1, signal),
                End::Lost => (2, 0),
            };
            out.extend_from_slice(&how.to_le_bytes());
            out.extend_from_slice(&number.to_le_bytes());
            out.extend_from_slice(&left.to_le_bytes());
        }
    }
    // No message is longer than `LONGEST`: a path has at most `MOST_POINTS`.
    let length = (out.len() - start - HEAD) as u32;
    let place = out.iter_mut().skip(start + 4);
    for (byte, of_length) in place.zip(length.to_le_bytes()) {
        *byte = of_length;
    }
}

fn kind(message: &Message) -> [u8; 4] {
    *match message {
        Message::Begin(_) => b"RPbe",
        Message::Tick(_) => b"RPti",
        Message::BeginAxis(_) => b"RPba",
        Message::TickAxis(_) => b"RPta",
        Message::Over => b"RPov",
        Message::Done => b"RPdo",
        Message::Currents(_) => b"RPcu",
        Message::Effort(_) => b"RPef",
        Message::Status(_) => b"RPst",
        Message::Left(_) => b"RPle",
        Message::WroteOutside(_) => b"RPwr",
        Message::Unusable(_) => b"RPun",
        Message::Ended(..) => b"RPen",
    }
}

/// What stands in a head: kind, length, number of the request; `None` if it is none.
pub fn head(bytes: &[u8; HEAD]) -> Option<([u8; 4], usize, u64)> {
    let mut bytes = bytes.as_slice();
    let kind: [u8; 4] = take(&mut bytes)?;
    let length = u32::from_le_bytes(take(&mut bytes)?) as usize;
    let number = u64::from_le_bytes(take(&mut bytes)?);
    (kind.starts_with(b"RP") && length <= LONGEST).then_some((kind, length, number))
}

/// The message of this kind; `None` if it is none.
pub fn decode(kind: [u8; 4], mut body: &[u8]) -> Option<Message> {
    let bytes = &mut body;
    let message = match &kind {
        b"RPbe" => Message::Begin(Box::new(decode_begin(bytes)?)),
        b"RPti" => Message::Tick(Sensed {
            number: u32::from_le_bytes(take(bytes)?),
            counts: [
                i32::from_le_bytes(take(bytes)?),
                i32::from_le_bytes(take(bytes)?),
            ],
            tip_force_n: Vector::from(floats(bytes)?),
        }),
        b"RPba" => {
            let is_rotary = match u32::from_le_bytes(take(bytes)?) {
                0 => false,
                1 => true,
                _ => return None,
            };
            Message::BeginAxis(axis::Settings::of(is_rotary, floats(bytes)?))
        }
        b"RPta" => {
            let number = u32::from_le_bytes(take(bytes)?);
            Message::TickAxis(axis::Sensed::of(number, floats(bytes)?))
        }
        b"RPov" => Message::Over,
        b"RPdo" => Message::Done,
        b"RPcu" => Message::Currents(floats(bytes)?),
        b"RPef" => floats(bytes).map(|[effort]| Message::Effort(effort))?,
        b"RPst" => Message::Status(i32::from_le_bytes(take(bytes)?)),
        b"RPle" => Message::Left(u32::from_le_bytes(take(bytes)?)),
        b"RPwr" => Message::WroteOutside(text(bytes)),
        b"RPun" => Message::Unusable(text(bytes)),
        b"RPen" => {
            let how = u32::from_le_bytes(take(bytes)?);
            let number = i32::from_le_bytes(take(bytes)?);
            let end = match how {
                0 => End::Code(number),
                1 => End::Signal(number),
                2 => End::Lost,
                _ => return None,
            };
            Message::Ended(end, u32::from_le_bytes(take(bytes)?))
        }
        _ => return None,
    };
    body.is_empty().then_some(message)
}

fn encode_begin(begin: &Begin, out: &mut Vec<u8>) {
    let settings = &begin.settings;
    out.extend_from_slice(&begin.brakes().to_le_bytes());
    for count in settings.counts_per_turn {
        out.extend_from_slice(&count.to_le_bytes());
    }
    for count in settings.zero_counts {
        out.extend_from_slice(&count.to_le_bytes());
    }
    put(out, begin.arms_m());
    put(
        out,
        [
            settings.sample_s,
            settings.greatest_rate_rad_s,
            settings.greatest_force_n,
        ],
    );
    let points_m = begin.points_m();
    out.extend_from_slice(&begin.task_number().to_le_bytes());
    out.extend_from_slice(&(points_m.len() as u32).to_le_bytes());
    for point_m in points_m {
        put(out, *point_m);
    }
    if let Some(arc) = begin.arc() {
        put(out, arc);
    }
}

fn decode_begin(bytes: &mut &[u8]) -> Option<Begin> {
    let layout = match u32::from_le_bytes(take(bytes)?) {
        3 => Layout::ThreeBrake,
        4 => Layout::FourBrake,
        _ => return None,
    };
    let counts_per_turn = [
        u32::from_le_bytes(take(bytes)?),
        u32::from_le_bytes(take(bytes)?),
    ];
    let zero_counts = [
        i32::from_le_bytes(take(bytes)?),
        i32::from_le_bytes(take(bytes)?),
    ];
    let [l_ae_m, l_ed_m, l_bc_m, l_cd_m, l_ab_m] = floats(bytes)?;
    let [sample_s, greatest_rate_rad_s, greatest_force_n] = floats(bytes)?;
    let kind = u32::from_le_bytes(take(bytes)?);
    let count = u32::from_le_bytes(take(bytes)?) as usize;
    let mut points_m = Vec::with_capacity(count.min(LONGEST));
    for _ in 0..count {
        points_m.push(floats(bytes)?);
    }
    let task = match kind {
        CHAIN => Task::Chain(points_m),
        ARC => {
            let [x, y, radius_m, from_rad, to_rad] = floats(bytes)?;
            Task::Arc {
                centre_m: [x, y],
                radius_m,
                from_rad,
                to_rad,
            }
        }
        SPLINE => Task::Spline(points_m),
        _ => return None,
    };
    let settings = Settings {
        arms: Arms {
            l_ae_m,
            l_ed_m,
            l_bc_m,
            l_cd_m,
            l_ab_m,
        },
        layout,
        counts_per_turn,
        zero_counts,
        sample_s,
        greatest_rate_rad_s,
        greatest_force_n,
    };
    Some(Begin { settings, task })
}

fn put<const N: usize>(out: &mut Vec<u8>, numbers: [f64; N]) {
    for number in numbers {
        out.extend_from_slice(&number.to_le_bytes());
    }
}

fn floats<const N: usize>(bytes: &mut &[u8]) -> Option<[f64; N]> {
    let mut numbers = [0.0; N];
    for number in &mut numbers {
        *number = f64::from_le_bytes(take(bytes)?);
    }
    Some(numbers)
}

fn take<const N: usize>(bytes: &mut &[u8]) -> Option<[u8; N]> {
    let (taken, rest) = bytes.split_first_chunk()?;
    *bytes = rest;
    Some(*taken)
}

/// A text of another process: nothing in it steers a terminal.
fn text(bytes: &mut &[u8]) -> String {
    let text = String::from_utf8_lossy(std::mem::take(bytes));
    text.chars()
        .map(|character| match character.is_control() {
            true => ' ',
            false => character,
        })
        .collect()
}
