//! This file lists the experiments that are tried on one joint: the recorded motion at another pace,
//! as a part of its width, or with rests, and a brake at a constant current.

use super::super::run::{JointRun, PlantKind};
use crate::align::{cutoff_hz, forget_sense_at_rest, forget_sense_at_reversals, smoothed_motion};
use crate::plant::Run;
use crate::rules::{DURATION_S, STILL_SIGMAS};
use core::f64::consts::TAU;
use rigproof_spec::effect::Quantity;
use rigproof_spec::units::Dimension;
use rigproof_trace::rig::Rig;
use rigproof_trace::{Channel, Trace};

/// An experiment.
#[derive(Clone, Debug)]
pub struct Plan {
    /// Instructions for a person.
    pub words: String,
    /// The constant current of a brake, A.
    pub current_a: Option<f64>,
    /// The motion, without an effort.
    pub run: JointRun,
}

/// What becomes of the recorded motion.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Change {
    /// It is passed through at this pace.
    Pace(f64),
    /// It is this part as wide.
    Width(f64),
    /// It comes to rest once a second.
    Rests,
}

/// Changes, with the words that stand after "the recorded motion".
const CHANGES: [(Change, &str); 6] = [
    (Change::Pace(0.5), "at half the speed"),
    (Change::Pace(0.25), "at a quarter of the speed"),
    (Change::Pace(2.0), "at twice the speed"),
    (Change::Width(0.5), "half as wide, as often"),
    (Change::Width(0.1), "a tenth as wide, as often"),
    (Change::Rests, "with a rest in every second"),
];

/// All experiments that are tried.
pub fn plans(run: &JointRun) -> Vec<Plan> {
    let greatest = run.current.iter().flatten();
    let greatest = greatest.fold(0.0, |most: f64, i| most.max(i.abs()));
    let currents = match run.current {
        Some(_) => vec![Some(greatest), Some(0.5 * greatest), Some(0.0)],
        None => vec![None],
    };
    let all = CHANGES.iter().flat_map(|change| {
        let currents = currents.iter();
        currents.map(|current_a| plan(run, change, *current_a))
    });
    all.collect()
}

fn plan(run: &JointRun, (change, words): &(Change, &str), current_a: Option<f64>) -> Plan {
    let what = drive_word(run);
    let unit = match run.driven_by() {
        Dimension::NUMBER => String::new(),
        own => format!(" {own}"),
    };
    let held = match current_a {
        Some(0.0) => format!(", without {what}"),
        Some(current_a) => format!(", with the {what} held at {current_a:.2}{unit}"),
        None => String::new(),
    };
    Plan {
        words: format!("repeat the recorded motion {words}{held}"),
        current_a,
        run: changed(run, *change, current_a),
    }
}

/// What drives a brake, in a word.
fn drive_word(run: &JointRun) -> &'static str {
    match run.driven_by() == Dimension::CURRENT {
        true => "current",
        false => "command",
    }
}

/// The time of the recording that stands at a time of the experiment, s.
fn recorded_time_s(change: Change, time_s: f64) -> f64 {
    match change {
        Change::Pace(pace) => pace * time_s,
        Change::Width(_) => time_s,
        Change::Rests => time_s - libm::sin(TAU * time_s) / TAU,
    }
}

/// A run along the changed motion, without an effort.
fn changed(run: &JointRun, change: Change, current_a: Option<f64>) -> JointRun {
    let step_s = run.step_s;
    let at = |k: usize| recorded_time_s(change, k as f64 * step_s) / step_s;
    let most = (DURATION_S / step_s) as usize;
    let count = (0..most)
        .take_while(|k| at(*k) + 2.0 < run.len() as f64)
        .count();
    let positions = run.motion.iter().map(|now| now.position);
    let (low, high) = positions.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), q| {
        (low.min(q), high.max(q))
    });
    let (middle, width) = (
        0.5 * (low + high),
        match change {
            Change::Width(width) => width,
            _ => 1.0,
        },
    );
    let position: Vec<f64> = (0..count)
        .map(|k| middle + width * (between(run, at(k)) - middle))
        .collect();
    let noise = run.position_noise;
    let (mut motion, speed_floor) =
        smoothed_motion(&position, step_s, cutoff_hz(step_s, 0.0), noise);
    forget_sense_at_rest(&mut motion, &position, step_s, STILL_SIGMAS * noise);
    if run.plant == PlantKind::Axis {
        forget_sense_at_reversals(&mut motion);
    }
    let mut changed = JointRun {
        start_s: 0.0,
        // The effort is that of a sample's own time.
        held: false,
        untold_speed: vec![speed_floor; count],
        recorded: vec![true; count],
        effort: vec![0.0; count],
        current: current_a.map(|current_a| vec![current_a; count]),
        position,
        motion,
        speed_floor,
        predicted: None,
        ..run.part(0, 0)
    };
    if let Some(current) = &changed.current {
        changed.predicted = changed.braked(current);
    }
    changed
}

/// The smoothed position between two samples, by a cubic through four.
fn between(run: &JointRun, at: f64) -> f64 {
    let (first, share) = (at as usize, at.fract());
    let q = |k: usize| run.motion.get(k).map_or(0.0, |now| now.position);
    let [a, b, c, d] = [
        q(first.saturating_sub(1)),
        q(first),
        q(first + 1),
        q(first + 2),
    ];
    b + 0.5
        * share
        * (c - a + share * (2.0 * a - 5.0 * b + 4.0 * c - d + share * (3.0 * (b - c) + d - a)))
}

impl Plan {
    /// The experiment as a file: time, position, and the current of a brake.
    pub fn trace(&self, rig: &Rig) -> Trace {
        let clock = self.run.clock();
        let position = Channel {
            name: "position".to_owned(),
            unit: Quantity::Travel.dimension(rig.motion).to_string(),
            samples: self.run.position.clone(),
        };
        let current = self.run.current.iter().map(|own| Channel {
            name: drive_word(&self.run).to_owned(),
            unit: self.run.driven_by().to_string(),
            samples: own.clone(),
        });
        Trace {
            time_s: (0..self.run.len())
                .map(|k| k as f64 * clock.step_s)
                .collect(),
            channels: [position].into_iter().chain(current).collect(),
        }
    }
}
