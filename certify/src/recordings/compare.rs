//! This file sets the commands of two controllers that were told the same recording side by side: where they differ, by how much, and in which state first.

use rigproof_impl::vector::Vector;
use rigproof_spec::joint::Joint;
use serde::Serialize;

use super::Answered;
use super::expected::{Expected, Unmeant};
use super::looks::{Looks, looks};
use super::taken::Taken;
use crate::controller::Task;
use crate::judge::Seen;
use crate::law::Law;
use crate::way::Way;
use rigproof_impl::path::Path as _;

/// Two controllers beside each other on one recording.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Compared {
    /// Samples that were told.
    pub samples: usize,
    /// Samples in which any bit of a command differs, and those that one of the controllers did not answer.
    pub differing: usize,
    /// Stretches of such samples.
    pub stretches: usize,
    /// Samples whose difference is not meant.
    pub unmeant: usize,
    /// How the command of each brake differs, in the order A, E, B, C.
    pub brakes: [Field; 4],
    /// The first sample that differs.
    pub first: Option<First>,
    /// The first whose difference is not meant, and why it is not.
    pub first_unmeant: Option<(First, Unmeant)>,
    /// Whether commands differ in more samples than is meant.
    pub is_too_often: bool,
    /// What the difference looks like.
    pub looks: Vec<Looks>,
    /// Laws that the new controller breaks in more samples than the old one.
    pub broken: Vec<Broken>,
    /// How well the old controller's commands are those that were recorded.
    pub recorded: Recorded,
}

/// How one brake's command differs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Field {
    /// Samples in which it does.
    pub differing: usize,
    /// The greatest difference, new less old, A; `None` where a command is no number.
    pub greatest_a: Option<f64>,
    /// When it is that, s.
    pub greatest_s: Option<f64>,
    /// When it first differs, s.
    pub first_s: Option<f64>,
}

/// A sample in which commands differ.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct First {
    /// Its row among the samples that were told, from 0.
    pub sample: usize,
    /// Its time stamp, s.
    pub time_s: f64,
    /// The names of the brakes that differ.
    pub brakes: Vec<&'static str>,
    /// The old command, A, in the order A, E, B, C; `None` where it did not answer.
    pub old_a: Option<[f64; 4]>,
    /// The new one.
    pub new_a: Option<[f64; 4]>,
    /// What was told.
    pub state: State,
}

/// What a controller knew in a sample.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct State {
    /// The sample's number.
    pub number: u32,
    /// Counts of A and B.
    pub counts: [i32; 2],
    /// Force at the tip, N; `None` where it was no number.
    pub force_n: [Option<f64>; 2],
    /// Whether a sensor or the clock failed.
    pub is_faulty: bool,
    /// The tip, m; `None` before a whole window of good samples.
    pub tip_m: Option<[f64; 2]>,
    /// Its velocity, m/s.
    pub tip_velocity_m_s: Option<[f64; 2]>,
    /// How far left of the path it is, m.
    pub offset_m: Option<f64>,
}

/// A law that the new controller breaks more often.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Broken {
    /// Which.
    pub law: Law,
    /// In how many samples the old one breaks it.
    pub old: u64,
    /// In how many the new one does.
    pub new: u64,
    /// When the new one first does, s.
    pub first_s: Option<f64>,
}

/// What was commanded when it was recorded, beside the old controller.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Recorded {
    /// Samples with a recorded command.
    pub samples: usize,
    /// Samples in which the old controller commands the same, to [`SAME_A`].
    pub same: usize,
}

/// Within which a recorded current counts as the one that was commanded, A: half a step of a converter of ten bits.
pub const SAME_A: f64 = 5e-4;

impl Compared {
    /// Whether nothing but what is meant is different.
    pub fn holds(&self) -> bool {
        self.unmeant == 0 && !self.is_too_often && self.broken.is_empty()
    }

    /// Sets what two controllers made of a recording side by side.
    pub fn of(
        taken: &Taken,
        task: &Task,
        [old, new]: [&Answered; 2],
        expected: Option<&Expected>,
    ) -> Compared {
        let samples = taken.told.len();
        let mut compared = Compared {
            samples,
            differing: 0,
            stretches: 0,
            unmeant: 0,
            brakes: [Field::default(); 4],
            first: None,
            first_unmeant: None,
            is_too_often: false,
            looks: looks(&old.currents_a, &new.currents_a),
            broken: broken(taken, old, new),
            recorded: recorded(taken, old),
        };
        let mut is_in_stretch = false;
        for (k, &time_s) in taken.time_s.iter().enumerate() {
            let pair = [old, new].map(|own| own.currents_a.get(k).copied());
            let differs = pair.map(|own| own.map(|a| a.map(f64::to_bits)));
            if differs[0] == differs[1] {
                is_in_stretch = false;
                continue;
            }
            compared.differing += 1;
            compared.stretches += usize::from(!is_in_stretch);
            is_in_stretch = true;
            let why = match (pair, expected) {
                ([Some(old_a), Some(new_a)], expected) => {
                    compared.note(time_s, old_a, new_a);
                    match expected {
                        Some(expected) => expected.unmeant(old_a, new_a),
                        None => Some(Unmeant::NothingExpected),
                    }
                }
                // Whoever does not answer breaks a law as well.
                _ => Some(Unmeant::NothingExpected),
            };
            compared.unmeant += usize::from(why.is_some());
            if compared.first.is_none() {
                compared.first = Some(first(taken, task, k, pair));
            }
            if let (Some(why), None) = (why, &compared.first_unmeant) {
                compared.first_unmeant = Some((first(taken, task, k, pair), why));
            }
        }
        let allows = expected.is_none_or(|own| own.allows(compared.differing, samples));
        compared.is_too_often = !allows;
        compared
    }

    /// Counts the difference of two commands, A.
    fn note(&mut self, time_s: f64, old_a: [f64; 4], new_a: [f64; 4]) {
        let pairs = old_a.into_iter().zip(new_a);
        for (field, (old, new)) in self.brakes.iter_mut().zip(pairs) {
            if old.to_bits() == new.to_bits() {
                continue;
            }
            let is_first = field.differing == 0;
            field.differing += 1;
            field.first_s.get_or_insert(time_s);
            let by_a = new - old;
            let is_greater = field.greatest_a.is_some_and(|most| by_a.abs() > most.abs());
            // What is no number stays the greatest.
            if is_first || is_greater || (!by_a.is_finite() && field.greatest_a.is_some()) {
                field.greatest_a = by_a.is_finite().then_some(by_a);
                field.greatest_s = Some(time_s);
            }
        }
    }
}

/// A sample that differs, with what was known in it.
fn first(taken: &Taken, task: &Task, k: usize, [old_a, new_a]: [Option<[f64; 4]>; 2]) -> First {
    let bits =
        |own: Option<[f64; 4]>, place: usize| own.and_then(|a| a.get(place).map(|a| a.to_bits()));
    let joints = Joint::ALL.into_iter().enumerate();
    let differing = joints.filter(|(place, _)| bits(old_a, *place) != bits(new_a, *place));
    First {
        sample: k,
        time_s: taken.time_s.get(k).copied().unwrap_or(f64::NAN),
        brakes: differing.map(|(_, joint)| joint.letter()).collect(),
        old_a,
        new_a,
        state: state(taken, task, k),
    }
}

/// What a controller knew in a sample.
fn state(taken: &Taken, task: &Task, k: usize) -> State {
    let mut seen = Seen::new(&taken.settings);
    let mut known = None;
    let told = taken.told.iter().zip(&taken.is_faulty).take(k + 1);
    for (sensed, is_faulty) in told {
        known = match (seen.as_mut(), is_faulty) {
            (Some(seen), false) => seen.update(sensed),
            (Some(seen), true) => {
                seen.forget();
                None
            }
            (None, _) => None,
        };
    }
    let situation = known.map(|(situation, _)| situation);
    let sensed = taken.told.get(k).copied();
    let force_n = sensed.map_or([f64::NAN; 2], |own| own.tip_force_n.into());
    let pair = |vector: Vector<f64>| <[f64; 2]>::from(vector);
    let offset = |tip_m: Vector<f64>| Way::new(task).map(|way| way.path.nearest(tip_m).offset_m);
    State {
        number: sensed.map_or(0, |own| own.number),
        counts: sensed.map_or([0; 2], |own| own.counts),
        force_n: force_n.map(|n| n.is_finite().then_some(n)),
        is_faulty: taken.is_faulty.get(k).copied().unwrap_or(false),
        tip_m: situation.as_ref().map(|own| pair(own.linkage.tip_m)),
        tip_velocity_m_s: situation.as_ref().map(|own| pair(own.tip_velocity_m_s)),
        offset_m: situation.and_then(|own| offset(own.linkage.tip_m)),
    }
}

/// The laws that the new controller breaks in more samples than the old one.
fn broken(taken: &Taken, old: &Answered, new: &Answered) -> Vec<Broken> {
    let pairs = old.fared.iter().zip(&new.fared);
    let each = Law::ALL.into_iter().zip(pairs);
    let more = each.filter(|(_, (old, new))| new.broken > old.broken);
    more.map(|(law, (old, new))| Broken {
        law,
        old: old.broken,
        new: new.broken,
        first_s: new
            .first
            .and_then(|tick| taken.time_s.get(tick as usize).copied()),
    })
    .collect()
}

/// How well the old commands are those that were recorded: in the same row, or in the next one, as recorders write them.
fn recorded(taken: &Taken, old: &Answered) -> Recorded {
    let at = |later: usize| {
        let rows = taken.recorded_a.iter().skip(later).zip(&old.currents_a);
        let rows = rows.filter(|(own, _)| own.iter().all(|a| a.is_finite()));
        let mut recorded = Recorded::default();
        for (own, commanded) in rows {
            let pairs = own.iter().zip(commanded);
            recorded.samples += 1;
            recorded.same += usize::from(pairs.into_iter().all(|(a, b)| (a - b).abs() <= SAME_A));
        }
        recorded
    };
    let (same_row, next_row) = (at(0), at(1));
    match next_row.same > same_row.same {
        true => next_row,
        false => same_row,
    }
}
