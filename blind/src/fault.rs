//! This file spoils a recording in the ways a careful technician would throw it away for, or mend it.

mod channels;
mod clock;
mod position;
#[cfg(test)]
mod tests;

use crate::draw::Draw;
use rigproof_trace::Trace;
use serde::{Deserialize, Serialize};

/// What was done to a recording, and where.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Spoilt {
    /// The fault's name.
    pub fault: String,
    /// The channels that a report may say are at fault, by what they are to the plant.
    pub channels: Vec<String>,
    /// When it begins, s.
    pub from_s: f64,
    /// When it ends, s.
    pub to_s: f64,
}

/// The channels of a recording that are spoilt, by their names in it.
#[derive(Clone, Copy, Debug)]
pub struct Names<'a> {
    /// A position.
    pub position: &'a str,
    /// An effort.
    pub effort: &'a str,
    /// What they are to the plant.
    pub roles: [&'a str; 2],
    /// Another position and another effort, where there are two of each.
    pub others: Option<[&'a str; 2]>,
}

/// A kind of fault: what is spoilt and where, in samples; `None` where this recording would not show it.
type Kind = fn(&mut Recording<'_>, &mut Draw) -> Option<Mark>;

/// What a kind of fault did.
pub struct Mark {
    /// The roles that may be named.
    pub roles: Vec<String>,
    /// The first and the last sample.
    pub samples: (usize, usize),
}

/// Every kind of fault with its name.
pub const KINDS: [(&str, Kind); 20] = [
    ("stuck_position", position::stick),
    ("dropped_samples", position::drop_samples),
    ("rezeroed", position::rezero),
    ("wrapped", position::wrap),
    ("dropouts", position::drop_out),
    ("lost_counts", position::lose_counts),
    ("repeated_samples", position::repeat_single),
    ("repeated_bursts", position::repeat_bursts),
    ("few_repeated_bursts", position::repeat_few),
    ("filled_straight", position::fill_in),
    ("slow_refresh", position::refresh_slowly),
    ("clock_jump", clock::jump),
    ("clock_set_forward", clock::set_forward),
    ("jitter", clock::jitter),
    ("clipped_channel", channels::clip),
    ("swapped_sign", channels::turn),
    ("dead_effort", channels::silence),
    ("thousandfold_effort", channels::thousandfold),
    ("degrees", channels::degrees),
    ("exchanged", channels::exchange),
];

/// A recording under the hand that spoils it.
pub struct Recording<'a> {
    pub trace: &'a mut Trace,
    pub names: Names<'a>,
}

impl Recording<'_> {
    /// The samples of a channel; a linear bench meters a force where a rotary one meters a torque.
    pub fn samples(&mut self, name: &str) -> Option<&mut Vec<f64>> {
        let mut channels = self.trace.channels.iter_mut();
        let own =
            channels.find(|own| own.name == name || (name == "torque" && own.name == "force"));
        own.map(|own| &mut own.samples)
    }

    pub fn position(&mut self) -> Option<&mut Vec<f64>> {
        self.samples(self.names.position)
    }

    pub fn effort(&mut self) -> Option<&mut Vec<f64>> {
        self.samples(self.names.effort)
    }

    pub fn count(&self) -> usize {
        self.trace.time_s.len()
    }

    /// A mark on the position.
    pub fn on_position(&self, samples: (usize, usize)) -> Option<Mark> {
        let [position, _] = self.names.roles;
        Some(mark(&[position], samples))
    }

    /// A mark on the effort throughout.
    pub fn on_effort(&self) -> Option<Mark> {
        let [_, effort] = self.names.roles;
        Some(mark(
            &[effort, "drive"],
            (0, self.count().saturating_sub(1)),
        ))
    }
}

pub fn mark(roles: &[&str], samples: (usize, usize)) -> Mark {
    Mark {
        roles: roles.iter().map(|role| (*role).to_owned()).collect(),
        samples,
    }
}

/// Spoils the recording in one of its channels and says what was done; kinds are drawn until the recording shows one.
pub fn spoil(names: Names<'_>, trace: &mut Trace, draw: &mut Draw) -> Spoilt {
    let mut left: Vec<(&str, Kind)> = KINDS.to_vec();
    while !left.is_empty() {
        let (name, kind) = left.swap_remove(draw.below(left.len()));
        let mut tried = trace.clone();
        let done = kind(
            &mut Recording {
                trace: &mut tried,
                names,
            },
            draw,
        );
        if let Some(Mark { roles, samples }) = done {
            // The clock of the recording as it was: a clock that jumps has two times for one sample.
            let clock = tried.time_s.iter().zip(&trace.time_s);
            let at = |k: usize| clock.clone().nth(k).map_or(0.0, |(now, _)| *now);
            let (from_s, to_s) = (at(samples.0), at(samples.1));
            *trace = tried;
            return Spoilt {
                fault: name.to_owned(),
                channels: roles,
                from_s: from_s.min(to_s),
                to_s: to_s.max(from_s),
            };
        }
    }
    Spoilt {
        fault: "none".to_owned(),
        channels: Vec::new(),
        from_s: 0.0,
        to_s: 0.0,
    }
}

/// The smallest step between two values that differ.
pub fn quantum(samples: &[f64]) -> f64 {
    let mut steps: Vec<f64> = samples
        .windows(2)
        .filter_map(|pair| match pair {
            [a, b] => Some((b - a).abs()),
            _ => None,
        })
        .collect();
    steps.retain(|step| *step > 0.0);
    let most = steps.iter().copied().fold(0.0, f64::max);
    steps
        .into_iter()
        .filter(|step| *step > 1e-9 * most)
        .fold(f64::INFINITY, f64::min)
}

pub fn range(samples: &[f64]) -> [f64; 2] {
    samples
        .iter()
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| {
            [low.min(*x), high.max(*x)]
        })
}

/// A sample between two shares of the recording around which the position moves by `least` counts a sample.
pub fn moving(samples: &[f64], least: f64, draw: &mut Draw) -> Option<usize> {
    let quantum = quantum(samples);
    let tries = (0..400).map(|_| (draw.uniform(0.05, 0.95) * samples.len() as f64) as usize);
    let tries: Vec<usize> = tries.collect();
    tries.into_iter().find(|k| {
        let ends = samples.get(k.saturating_sub(6)).zip(samples.get(k + 6));
        ends.is_some_and(|(before, after)| (after - before).abs() >= 12.0 * least * quantum)
    })
}
