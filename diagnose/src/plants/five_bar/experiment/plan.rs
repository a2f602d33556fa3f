//! This file lists the experiments that a five-bar can do: where a hand leads its tip, and the
//! currents of its brakes.

use crate::rules::JITTER;
pub use crate::rules::{DURATION_S, MIDDLE_M, STRONGEST_A};
use core::f64::consts::TAU;
use rigproof_spec::joint::Joint;
use rigproof_spec::layout::Layout;
use rigproof_trace::{Channel, Trace};

/// An experiment, sample by sample.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// Instructions for a person.
    pub words: String,
    /// Sample interval, s.
    pub step_s: f64,
    /// The tip position to which the hand leads, x and y, m.
    pub hand_m: Vec<[f64; 2]>,
    /// The currents of A, E, B, C, A; 0 without a brake.
    pub currents_a: [Vec<f64>; 4],
}

/// The columns of a file.
const HAND: [&str; 2] = ["hand_x", "hand_y"];
const CURRENTS: [&str; 4] = ["current_a", "current_e", "current_b", "current_c"];

/// A movement of the hand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Hand {
    Winding,
    Ramp,
    Reversals,
    Rests,
}

/// A use of the brakes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Currents {
    Off,
    InTurn,
    Staircase(Joint),
    Triangle(Joint),
    Steps(Joint),
}

/// The experiments that are tried: every movement of the hand with every use of the brakes, chiefly
/// of those at `joints`.
pub fn plans(layout: Layout, joints: &[Joint], step_s: f64) -> Vec<Plan> {
    let braked = joints
        .iter()
        .filter(|joint| layout.brakes().contains(joint));
    let own = braked.flat_map(|joint| {
        [
            Currents::Staircase(*joint),
            Currents::Triangle(*joint),
            Currents::Steps(*joint),
        ]
    });
    let currents: Vec<Currents> = [Currents::Off, Currents::InTurn]
        .into_iter()
        .chain(own)
        .collect();
    let hands = [Hand::Winding, Hand::Ramp, Hand::Reversals, Hand::Rests];
    let pairs = hands
        .into_iter()
        .flat_map(|hand| currents.iter().map(move |currents| (hand, *currents)));
    pairs
        .map(|(hand, currents)| plan(layout, hand, currents, step_s))
        .collect()
}

fn plan(layout: Layout, hand: Hand, currents: Currents, step_s: f64) -> Plan {
    let count = (DURATION_S / step_s).round() as usize;
    let times = || (0..count).map(|k| k as f64 * step_s);
    Plan {
        words: format!("{}; {}", hand.words(), currents.words()),
        step_s,
        hand_m: times().map(|time_s| hand.at(time_s)).collect(),
        currents_a: Joint::ALL.map(|joint| {
            let braked = layout.brakes().contains(&joint);
            let current = |time_s| match braked {
                true => currents.at(joint, time_s),
                false => 0.0,
            };
            times().map(current).collect()
        }),
    }
}

impl Hand {
    const fn words(self) -> &'static str {
        match self {
            Hand::Winding => "lead the tip along a winding path, fast and slow",
            Hand::Ramp => {
                "lead the tip along figures of eight, slowly at first and faster and faster"
            }
            Hand::Reversals => {
                "lead the tip to and fro on straight lines in three directions, slowly at first and faster and faster"
            }
            Hand::Rests => "lead the tip from point to point and rest at each of them",
        }
    }

    /// The position of the hand, m.
    fn at(self, time_s: f64) -> [f64; 2] {
        let sine = |rate: f64, phase: f64| libm::sin(rate * time_s + phase);
        let [by_x, by_y] = match self {
            Hand::Winding => [
                0.056 * sine(2.31, 0.3) + 0.029 * sine(5.13, 1.1),
                0.041 * sine(3.07, 2.1) + 0.024 * sine(6.71, 0.7),
            ],
            Hand::Ramp => {
                // From an eighth of a turn per second to a half. The force of a hand cannot move
                // the arms faster.
                let turns = (0.125 + 0.5 * 0.375 * time_s / DURATION_S) * time_s;
                [
                    0.071 * libm::sin(TAU * turns),
                    0.049 * libm::sin(2.0 * TAU * turns + 0.4),
                ]
            }
            Hand::Reversals => {
                let third = (3.0 * time_s / DURATION_S).floor();
                let within_s = time_s - third * DURATION_S / 3.0;
                let (sine, cosine) = libm::sincos(0.35 + third * TAU / 6.0);
                // From half a stroke per second to four.
                let strokes = (0.5 + 0.5 * 3.5 * within_s * 3.0 / DURATION_S) * within_s;
                let along = 0.047 * triangle(strokes);
                [along * cosine, along * sine]
            }
            Hand::Rests => {
                let leg = (time_s / 1.2).floor();
                let [from, to] = [leg, leg + 1.0].map(|leg| libm::sincos(2.51 * leg + 0.6));
                let share = ((time_s - 1.2 * leg) / 0.75).min(1.0);
                [
                    0.062 * (from.1 + share * (to.1 - from.1)),
                    0.051 * (from.0 + share * (to.0 - from.0)),
                ]
            }
        };
        let [x, y] = MIDDLE_M;
        [x + by_x, y + by_y]
    }
}

/// A triangle wave between −1 and 1, one stroke between two turning points; it starts in the
/// middle.
fn triangle(strokes: f64) -> f64 {
    let phase = (0.5 * strokes + 0.25).rem_euclid(1.0);
    1.0 - 4.0 * (phase - 0.5).abs()
}

impl Currents {
    fn words(self) -> String {
        match self {
            Currents::Off => "all brakes off".to_owned(),
            Currents::InTurn => format!("the brakes in turn on and off, up to {STRONGEST_A} A"),
            Currents::Staircase(joint) => alone(joint, "up and down a staircase"),
            Currents::Triangle(joint) => {
                alone(joint, "up and down straight, now and then half way")
            }
            Currents::Steps(joint) => alone(joint, "on and off at changing levels"),
        }
    }

    /// The current of a joint's brake, A.
    fn at(self, joint: Joint, time_s: f64) -> f64 {
        let share = match self {
            Currents::Off => 0.0,
            Currents::InTurn => {
                let place = joint as usize;
                let step = ((time_s + 0.23 * place as f64) / 0.7) as usize;
                pick(&[0.0, 0.52, 0.0, 0.3, 0.0, 0.0, 1.0], step + 3 * place)
            }
            Currents::Staircase(own) | Currents::Triangle(own) | Currents::Steps(own)
                if own != joint =>
            {
                0.0
            }
            Currents::Staircase(_) => {
                let step = (time_s / 0.8) as usize;
                pick(&[0.0, 0.25, 0.5, 0.75, 1.0, 0.75, 0.5, 0.25], step)
            }
            Currents::Triangle(_) => {
                let turns = [0.0, 1.0, 0.4, 0.8, 0.0, 0.6, 0.2, 1.0, 0.0];
                let at = time_s / 1.1;
                let [from, to] = [0, 1].map(|next| pick(&turns, at as usize + next));
                from + (at - at.floor()) * (to - from)
            }
            Currents::Steps(_) => {
                let step = (time_s / 0.37) as usize;
                pick(&[0.0, 0.4, 1.0, 0.0, 0.7, 0.2, 0.0, 0.9, 0.5], step)
            }
        };
        STRONGEST_A * share
    }
}

fn alone(joint: Joint, how: &str) -> String {
    format!(
        "brake {} {how}, up to {STRONGEST_A} A, the others off",
        joint.letter()
    )
}

/// A value of a list, repeated cyclically.
fn pick(values: &[f64], index: usize) -> f64 {
    values
        .get(index % values.len().max(1))
        .copied()
        .unwrap_or(0.0)
}

impl Plan {
    /// The plan as a time series.
    pub fn trace(&self, layout: Layout) -> Trace {
        let hand = [0, 1].map(|axis: usize| {
            let of = |point: &[f64; 2]| point.get(axis).copied().unwrap_or(0.0);
            self.hand_m.iter().map(of).collect::<Vec<f64>>()
        });
        let channel = |name: &str, unit: &str, samples: &[f64]| Channel {
            name: name.to_owned(),
            unit: unit.to_owned(),
            samples: samples.to_vec(),
        };
        let hand = HAND
            .iter()
            .zip(&hand)
            .map(|(name, x)| channel(name, "m", x));
        let currents = CURRENTS.iter().zip(&self.currents_a).zip(Joint::ALL);
        let currents = currents
            .filter(|(_, joint)| layout.brakes().contains(joint))
            .map(|((name, current), _)| channel(name, "A", current));
        Trace {
            time_s: (0..self.hand_m.len())
                .map(|k| k as f64 * self.step_s)
                .collect(),
            channels: hand.chain(currents).collect(),
        }
    }

    /// Whether a file holds a plan: it has columns for the hand.
    pub fn is_in(trace: &Trace) -> bool {
        HAND.iter().all(|name| trace.channel(name).is_some())
    }

    /// Reads a plan from a file. A brake that it does not name stays off.
    ///
    /// # Errors
    /// The hand is missing, a value is missing, the clock is irregular, a unit is not m or A, or a
    /// current belongs to a brake that is not there.
    pub fn of(trace: &Trace, layout: Layout) -> Result<Plan, String> {
        let step_s = regular_step(&trace.time_s)?;
        let samples = |name: &str, unit: &str| -> Result<Option<Vec<f64>>, String> {
            let Some(channel) = trace.channel(name) else {
                return Ok(None);
            };
            if !channel.unit.is_empty() && channel.unit != unit {
                return Err(format!(
                    "`{name}` is in `{}`; give it in `{unit}`",
                    channel.unit
                ));
            }
            match channel.samples.iter().position(|x| !x.is_finite()) {
                Some(k) => Err(format!("`{name}` has no value in sample {k}")),
                None => Ok(Some(channel.samples.clone())),
            }
        };
        let hand = |name| samples(name, "m")?.ok_or(format!("there is no column `{name}`"));
        let [x, y] = [hand("hand_x")?, hand("hand_y")?];
        let mut currents_a = [const { Vec::new() }; 4];
        let slots = currents_a.iter_mut().zip(CURRENTS).zip(Joint::ALL);
        for ((slot, name), joint) in slots {
            let given = samples(name, "A")?;
            if given.is_some() && !layout.brakes().contains(&joint) {
                return Err(format!(
                    "this rig has no brake for `{name}`; take the column out"
                ));
            }
            *slot = given.unwrap_or_else(|| vec![0.0; trace.len()]);
        }
        Ok(Plan {
            words: String::new(),
            step_s,
            hand_m: x.into_iter().zip(y).map(|(x, y)| [x, y]).collect(),
            currents_a,
        })
    }
}

fn regular_step(time_s: &[f64]) -> Result<f64, String> {
    let (Some(first), Some(last), true) = (time_s.first(), time_s.last(), time_s.len() > 1) else {
        return Err("an experiment has at least two samples".to_owned());
    };
    let step_s = (last - first) / (time_s.len() - 1) as f64;
    let off = (0..)
        .zip(time_s)
        .find(|(k, time_s)| (*time_s - first - f64::from(*k) * step_s).abs() > JITTER * step_s);
    match off {
        _ if step_s <= 0.0 => Err("the time does not grow".to_owned()),
        Some((k, at_s)) => Err(format!(
            "sample {k} is at {at_s} s, where steps of {step_s} s would not have it; an experiment needs a regular clock"
        )),
        None => Ok(step_s),
    }
}
