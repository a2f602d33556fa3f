//! This file writes what the sensors of a five-bar make of its motion, and the rig description that goes with it.

use super::linkage::Pair;
use super::run::{Sample, quantised, shown_theta};
use super::setup::{RATE_HZ, Setup};
use crate::draw::Draw;
use crate::effect::Effect;
use rigproof_spec::joint::Joint;
use rigproof_trace::rig::five_bar::{FiveBar, FiveBarChannels};
use rigproof_trace::rig::{ChannelMap, Drive, Protocol};
use rigproof_trace::{Channel, Trace};

/// What the sensors make of the run.
pub fn record(setup: &Setup, hidden: &[Effect], samples: &[Sample], draw: &mut Draw) -> Trace {
    let angles: Vec<Pair> = samples
        .iter()
        .map(|sample| quantised(setup, shown_theta(setup, hidden, sample.theta)))
        .collect();
    let (unit, factor) = match setup.in_counts {
        true => (String::new(), 1.0 / setup.quantum_rad()),
        false => ("rad".to_owned(), 1.0),
    };
    let angle = |angle: f64| match setup.in_counts {
        true => (angle * factor).round(),
        false => angle,
    };
    let channel = |name: &str, unit: &str, samples: Vec<f64>| Channel {
        name: name.to_owned(),
        unit: unit.to_owned(),
        samples,
    };
    let mut force = |of: fn(&Pair) -> f64| -> Vec<f64> {
        let noise = setup.force_noise_n;
        samples
            .iter()
            .map(|sample| of(&sample.shown_force_n) + draw.normal(noise))
            .collect()
    };
    let mut channels = vec![
        channel(
            "theta_a",
            &unit,
            angles.iter().map(|[a, _]| angle(*a)).collect(),
        ),
        channel(
            "theta_b",
            &unit,
            angles.iter().map(|[_, b]| angle(*b)).collect(),
        ),
        channel("force_x", "N", force(|[x, _]| *x)),
        channel("force_y", "N", force(|[_, y]| *y)),
    ];
    for (k, joint) in Joint::ALL.into_iter().enumerate() {
        if setup.layout.brakes().contains(&joint) {
            let current = |sample: &Sample| sample.currents_a.get(k).copied().unwrap_or_default();
            channels.push(channel(
                current_name(joint),
                "A",
                samples.iter().map(current).collect(),
            ));
        }
    }
    Trace {
        time_s: (0..samples.len()).map(|k| k as f64 / RATE_HZ).collect(),
        channels,
    }
}

pub const fn current_name(joint: Joint) -> &'static str {
    match joint {
        Joint::A => "current_a",
        Joint::E => "current_e",
        Joint::B => "current_b",
        Joint::C => "current_c",
    }
}

/// The rig description that goes with the recording.
pub fn describe(seed: u64, setup: &Setup) -> FiveBar {
    let quantum = setup.quantum_rad();
    let theta = |name: &str| match setup.in_counts {
        true => ChannelMap {
            scale: quantum,
            quantum: Some(1.0),
            ..ChannelMap::plain(name, "rad")
        },
        false => ChannelMap {
            quantum: Some(quantum),
            ..ChannelMap::plain(name, "rad")
        },
    };
    let noise = Some(setup.force_noise_n);
    let force = |name: &str| ChannelMap {
        noise,
        ..ChannelMap::plain(name, "N")
    };
    let current = |joint: Joint| {
        let braked = setup.layout.brakes().contains(&joint);
        braked.then(|| ChannelMap::plain(current_name(joint), "A"))
    };
    FiveBar {
        name: format!("blind rig {seed}"),
        layout: setup.layout,
        source: None,
        channels: FiveBarChannels {
            time: None,
            theta: [theta("theta_a"), theta("theta_b")],
            force: [force("force_x"), force("force_y")],
            currents: Joint::ALL.map(current),
        },
        text: Default::default(),
        effects: Vec::new(),
        protocol: Protocol {
            drive: Drive::Held,
            ..Protocol::default()
        },
        provenance: Default::default(),
    }
}
