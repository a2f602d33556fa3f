//! This file makes a five-bar case: draws until the hidden effects have the size their stratum asks for, and records.

use super::hide;
use super::law::{Effect, Law};
use super::linkage::Pair;
use super::run::{Sample, quantised, run, shown_theta};
use super::setup::{Asked, RATE_HZ, Setup};
use super::size::{Sizes, sizes};
use crate::answer::{Answer, HiddenEffect, TrueParameter};
use crate::draw::Draw;
use crate::error::Error;
use crate::fault;
use crate::make::Case;
use crate::plant::Plant;
use crate::seal;
use crate::size::FAINT_STRENGTH;
use crate::stratum::Stratum;
use rigproof_spec::effect::Mechanism;
use rigproof_spec::joint::Joint;
use rigproof_spec::layout::Layout;
use rigproof_trace::rig::five_bar::{FiveBar, FiveBarChannels};
use rigproof_trace::rig::{ChannelMap, Drive, Protocol};
use rigproof_trace::{Channel, Trace};
use std::f64::consts::TAU;

/// A case before sensors and seals.
pub struct Secret {
    pub setup: Setup,
    pub hidden: Vec<Effect>,
    pub samples: Vec<Sample>,
    pub sizes: Sizes,
}

/// Draws that are tried.
const ATTEMPTS: usize = 24;

/// Least share of a recording in which something slides.
const LEAST_SLIDING: f64 = 0.5;

/// Greatest error of the plant's own, in block noise.
const GREATEST_LEFT: f64 = 0.5;

/// Makes the case of a seed.
pub fn make(seed: u64, stratum: Stratum) -> Result<Case, Error> {
    let plant = Plant::Rig;
    let secret = secret(seed, stratum)?;
    let mut trace = record(&secret, &mut Draw::new(plant, seed, "sensors"));
    let fault = (stratum == Stratum::DataFault).then(|| {
        let mut draw = Draw::new(plant, seed, "fault");
        let (position, effort) = (
            draw.pick(&["theta_a", "theta_b"]),
            draw.pick(&["force_x", "force_y"]),
        );
        fault::spoil(position, effort, &mut trace, &mut draw).to_owned()
    });
    case(seed, stratum, &secret, trace, fault)
}

fn case(
    seed: u64,
    stratum: Stratum,
    secret: &Secret,
    trace: Trace,
    fault: Option<String>,
) -> Result<Case, Error> {
    let answer = Answer {
        seed,
        plant: Plant::Rig,
        stratum,
        effects: answers(secret),
        fault,
        block_noise: secret.sizes.block_noise,
    };
    let (sealed, commitment) = seal::seal(&answer)?;
    let rig_toml = describe(seed, &secret.setup).to_toml();
    Ok(Case {
        trace,
        rig_toml,
        sealed,
        commitment,
    })
}

/// Another recording of a seed's rig, with the same hidden effects on the same clock: another hand, other currents.
pub fn again(seed: u64, stratum: Stratum) -> Result<Trace, Error> {
    let first = secret(seed, stratum)?;
    let mut draw = Draw::new(Plant::Rig, seed, "again");
    for _ in 0..ATTEMPTS {
        let setup = first.setup.again(stratum, &mut draw);
        let other = Secret::new(setup, first.hidden.clone());
        if let Some(other) = other.filter(|other| other.sizes.sliding >= LEAST_SLIDING) {
            return Ok(record(&other, &mut draw));
        }
    }
    Err(no_case(seed, stratum))
}

/// An experiment on a seed's rig as a case of its own: the same hidden effects, what began in the first recording now from the start.
pub fn under(seed: u64, stratum: Stratum, experiment: &Trace) -> Result<Case, Error> {
    let first = secret(seed, stratum)?;
    let mut draw = Draw::new(Plant::Rig, seed, "experiment");
    let asked = asked(experiment, first.setup.layout)?;
    let setup = first.setup.under(asked, &mut draw);
    let begun = |effect: Effect| Effect {
        onset_s: None,
        ..effect
    };
    let hidden = first.hidden.into_iter().map(begun).collect();
    let other = Secret::new(setup, hidden).ok_or(Error::Experiment(
        "it leads the arms out of their ranges (table 4.2)".to_owned(),
    ))?;
    let trace = record(&other, &mut draw);
    case(seed, stratum, &other, trace, None)
}

/// What an experiment's file asks for: `hand_x` and `hand_y`, m, and the currents of the brakes, A.
fn asked(experiment: &Trace, layout: Layout) -> Result<Asked, Error> {
    let column = |name: &str| {
        let channel = experiment.channel(name);
        channel.map(|channel| channel.samples.clone())
    };
    let needed = |name: &str| {
        column(name).ok_or_else(|| Error::Experiment(format!("there is no column `{name}`")))
    };
    let [x, y] = [needed("hand_x")?, needed("hand_y")?];
    let (Some(first_s), Some(last_s)) = (experiment.time_s.first(), experiment.time_s.last())
    else {
        return Err(Error::Experiment("it is empty".to_owned()));
    };
    let step_s = (last_s - first_s) / x.len().saturating_sub(1).max(1) as f64;
    if step_s <= 0.0 || x.iter().chain(&y).any(|x| !x.is_finite()) {
        return Err(Error::Experiment(
            "it needs two samples or more, a clock that grows and a hand in each sample".to_owned(),
        ));
    }
    let current = |joint: Joint| {
        let braked = layout.brakes().contains(&joint);
        column(current_name(joint))
            .filter(|_| braked)
            .unwrap_or_default()
    };
    Ok(Asked {
        step_s,
        path_m: x.into_iter().zip(y).map(|(x, y)| [x, y]).collect(),
        currents_a: Joint::ALL.map(current),
    })
}

/// Draws until the rule of size is met.
pub fn secret(seed: u64, stratum: Stratum) -> Result<Secret, Error> {
    let mut draw = Draw::new(Plant::Rig, seed, stratum.name());
    for _ in 0..ATTEMPTS {
        let Some(setup) = Setup::draw(stratum, &mut draw) else {
            continue;
        };
        let hidden = hide::draw(&setup, stratum, &mut draw);
        let Some(mut tried) = Secret::new(setup, hidden) else {
            continue;
        };
        if stratum == Stratum::TooSmall {
            match tried.shrunk(draw.uniform(0.2, 0.7)) {
                Some(smaller) => tried = smaller,
                None => continue,
            }
        }
        let fits = tried.sizes.sizes.iter().all(|size| size.fits(stratum));
        if fits && tried.sizes.sliding >= LEAST_SLIDING && tried.sizes.left <= GREATEST_LEFT {
            return Ok(tried);
        }
    }
    Err(no_case(seed, stratum))
}

fn no_case(seed: u64, stratum: Stratum) -> Error {
    Error::NoCase {
        seed,
        plant: Plant::Rig.name(),
        stratum: stratum.name(),
        attempts: ATTEMPTS,
    }
}

impl Secret {
    pub fn new(setup: Setup, hidden: Vec<Effect>) -> Option<Secret> {
        let samples = run(&setup, &hidden)?;
        let sizes = sizes(&setup, &hidden, &samples);
        Some(Secret {
            setup,
            hidden,
            samples,
            sizes,
        })
    }

    /// The same case with its effect scaled until its strength is near the target.
    fn shrunk(self, target: f64) -> Option<Secret> {
        let mut secret = self;
        for _ in 0..3 {
            let strengths = secret.sizes.sizes.iter().map(|size| size.strength);
            let strength = strengths.fold(0.0, f64::max);
            if strength <= FAINT_STRENGTH {
                break;
            }
            let scaled = |effect: &Effect| effect.scaled(target / strength);
            let hidden = secret.hidden.iter().map(scaled).collect();
            secret = Secret::new(secret.setup, hidden)?;
        }
        Some(secret)
    }
}

/// What the sensors make of the run.
fn record(secret: &Secret, draw: &mut Draw) -> Trace {
    let Secret {
        setup,
        hidden,
        samples,
        ..
    } = secret;
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

const fn current_name(joint: Joint) -> &'static str {
    match joint {
        Joint::A => "current_a",
        Joint::E => "current_e",
        Joint::B => "current_b",
        Joint::C => "current_c",
    }
}

/// The rig description that goes with the recording.
fn describe(seed: u64, setup: &Setup) -> FiveBar {
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

/// The effect with its numbers as the vocabulary counts them: a ripple from the zero of the joint's angle instead of from the start, the angle of a
/// sensor as that by which it turns the force.
pub fn in_the_vocabulary(setup: &Setup, effect: &Effect) -> Effect {
    let law = match (effect.law, effect.joint) {
        (
            Law::Ripple {
                sine,
                cosine,
                period,
            },
            Some(joint),
        ) => {
            let (s, c) = libm::sincos(TAU * setup.start_angle_rad(joint) / period);
            Law::Ripple {
                sine: sine * c + cosine * s,
                cosine: cosine * c - sine * s,
                period,
            }
        }
        (Law::ForceRotation { angle }, _) => Law::ForceRotation { angle: -angle },
        (law, _) => law,
    };
    Effect { law, ..*effect }
}

fn answers(secret: &Secret) -> Vec<HiddenEffect> {
    let each = secret.hidden.iter().zip(&secret.sizes.sizes);
    each.map(|(effect, size)| {
        let parameters = in_the_vocabulary(&secret.setup, effect)
            .parameters()
            .into_iter();
        HiddenEffect {
            mechanism: effect.name().to_owned(),
            joint: effect.joint.map(|joint| joint.letter().to_owned()),
            onset_s: effect.onset_s,
            parameters: parameters
                .map(|(name, value, dimension)| TrueParameter {
                    name: name.to_owned(),
                    value,
                    unit: dimension.to_string(),
                })
                .collect(),
            size: size.size,
            distinctness: size.distinctness,
            strength: size.strength,
            onset_strength: size.onset_strength,
            equivalent: sets(&secret.setup, effect),
        }
    })
    .collect()
}

/// Sets of mechanisms that no recording of this experiment can tell from an effect: single ones; what a joint does whose twin turns alike; and for
/// a bristle with unequal limits, once it has slid, the bristle with the mean of both and a constant of half their difference.
fn sets(setup: &Setup, effect: &Effect) -> Vec<Vec<String>> {
    let single = equivalent(setup, effect).iter();
    let mut sets: Vec<Vec<String>> = single.map(|name| vec![(*name).to_owned()]).collect();
    // Arm CD is parallel to AE and ED to BC: what the joint E itself does the joint C could do.
    if setup.layout == Layout::ThreeBrake && effect.joint == Some(Joint::E) && !effect.is_of_brake()
    {
        sets.push(vec![format!("{} at C", effect.name())]);
    }
    if let (Law::OneSided { .. }, Some(joint)) = (effect.law, effect.joint) {
        let both = [Mechanism::Presliding, Mechanism::ConstantBias];
        let named = both.map(|mechanism| format!("{} at {}", mechanism.name(), joint.letter()));
        sets.push(named.into());
    }
    sets
}

/// Mechanisms that no recording of this experiment can tell from an effect.
///
/// - On three brakes the joints E and C turn alike: friction at one is bearing friction at the other.
/// - Brake A has no backlash: at a constant current a gain error is dry friction.
/// - A payload is inside what the entries of the mass matrix can be.
fn equivalent(setup: &Setup, effect: &Effect) -> &'static [&'static str] {
    let three = setup.layout == Layout::ThreeBrake;
    match (effect.law, effect.joint) {
        (Law::Bearing { viscous: 0.0, .. }, _) if three => &["dry_offset at E", "dry_offset at C"],
        (Law::Bearing { .. }, _) if three => &["viscous at E", "viscous at C"],
        (Law::Dry { .. } | Law::Viscous { .. }, Some(Joint::E)) if three => {
            &["bearing_friction at C"]
        }
        (Law::Gain { .. }, Some(Joint::A)) if setup.is_constant() => &["dry_offset at A"],
        (Law::Dry { .. }, Some(Joint::A)) if setup.is_constant() => &["gain_error at A"],
        (Law::Payload { .. }, _) => &["inertia_error"],
        _ => &[],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn on_three_brakes_what_is_no_brakes_at_e_could_be_at_c() {
        let drawn = Setup::draw(Stratum::Single, &mut Draw::new(Plant::Rig, 3, "twins")).unwrap();
        let twins = |layout, law| {
            let effect = Effect {
                law,
                joint: Some(Joint::E),
                onset_s: None,
            };
            let setup = Setup {
                layout,
                ..drawn.clone()
            };
            sets(&setup, &effect).concat()
        };
        let spring = Law::Spring { stiffness: 0.7 };
        assert_eq!(twins(Layout::ThreeBrake, spring), ["spring at C"]);
        assert!(twins(Layout::FourBrake, spring).is_empty());
        let gain = Law::Gain { fraction: 0.13 };
        assert!(twins(Layout::ThreeBrake, gain).is_empty());
        let dry = twins(Layout::ThreeBrake, Law::Dry { level: 0.2 });
        assert_eq!(dry, ["bearing_friction at C", "dry_offset at C"]);
    }
}
