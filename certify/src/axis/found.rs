//! This file is an axis as a diagnosis found it: its numbers with their intervals, what of it runs in trials, and a draw of it.

use std::path::Path;

use rigproof_model::axis::MOST_LAWS;
use rigproof_model::effects::{Drive, Entry, Form, OfJoint, OfSensor, entry};
use rigproof_spec::effect::{Mechanism, Motion};
use rigproof_spec::units::Unit;
use rigproof_trace::rig::{ChannelMap, Plant, Rig, RigEffect, Value};
use serde::{Deserialize, Serialize};

use crate::digest;
use crate::error::Error;
use crate::scenario::Draw;

/// An axis that trials draw their plant from.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Found {
    /// Its file.
    pub name: String,
    /// The SHA-256 of its file.
    pub sha256: String,
    /// Whether it turns; it slides otherwise.
    pub is_rotary: bool,
    /// Mass, kg, or moment of inertia, kg·m².
    pub inertia: Number,
    /// Effort for one SI unit of the command.
    pub command_gain: Number,
    /// What it has beyond that and runs in trials, in its order.
    pub effects: Vec<FoundEffect>,
    /// What it has and no trial runs: a reason against, each.
    pub not_run: Vec<NotRun>,
    /// Resolution of the sensed position, m or rad; 0 where the file states none.
    pub quantum: f64,
    /// Standard deviation of its noise, m or rad; 0 where the file states none.
    pub noise: f64,
}

/// A number, and between which ends it is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Number {
    /// As it was found.
    pub value: f64,
    /// The lower end of its 95 % interval; the number itself where none is given.
    pub low: f64,
    /// The upper end.
    pub high: f64,
}

/// A mechanism with its numbers, in the vocabulary's order.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FoundEffect {
    /// Its name.
    pub mechanism: String,
    /// Its numbers.
    pub numbers: Vec<Number>,
}

/// What no trial runs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct NotRun {
    /// The mechanism's name.
    pub mechanism: String,
    /// Why.
    pub why: String,
}

/// An axis of one trial.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawn {
    /// Mass, kg, or moment of inertia, kg·m².
    pub inertia: f64,
    /// What the drive gives of an effort that is asked for.
    pub gain: f64,
    /// What runs, with its numbers.
    pub effects: Vec<(Mechanism, Vec<f64>)>,
}

/// Standard deviations to either end of a 95 % interval.
const DEVIATIONS_95: f64 = 1.96;
/// Sets the draws of an axis apart from those of its trial.
const OF_AXIS: u64 = 0xa215_ca11_b7a7;

impl Found {
    /// The axis of a description's text; `file` is what messages name.
    ///
    /// # Errors
    /// It is no axis with its numbers, or one whose servo closes a loop of its own.
    pub fn read(text: &str, file: &Path) -> Result<Found, Error> {
        let rig = Rig::parse(text, file)?;
        let refused = |problem: &str| Error::unusable(file, problem);
        if rig.plant != Plant::Axis {
            return Err(refused(
                "it is no driven axis (`plant = \"axis\"`): name the calibration.toml that `rigproof diagnose` wrote for one",
            ));
        }
        if rig.servo.is_some() {
            return Err(refused(
                "its [servo] closes a loop of its own, and an effort cannot be commanded: a controller takes the servo's place, so take [servo] away and give `command_gain` for an effort",
            ));
        }
        let parameters = rig.parameters.as_ref();
        let parameters = parameters
            .ok_or_else(|| refused("it has no [parameters]: give inertia and command_gain"))?;
        let (effects, not_run) = effects(&rig.effects);
        let laws = effects.iter().filter(|own| is_resistance(&own.mechanism));
        if laws.count() > MOST_LAWS {
            let problem = format!("more than {MOST_LAWS} resistances act together: take some out");
            return Err(refused(&problem));
        }
        let position = rig.channels.position.as_ref();
        let in_si = |own: fn(&ChannelMap) -> Option<f64>| {
            position.map_or(0.0, |map| {
                let to_si = Unit::parse(&map.unit).map_or(1.0, |unit| unit.to_si);
                (own(map).unwrap_or(0.0) * to_si * map.scale).abs()
            })
        };
        let name = file.file_name().unwrap_or(file.as_os_str());
        Ok(Found {
            name: name.to_string_lossy().into_owned(),
            sha256: digest::of_bytes(text.as_bytes()),
            is_rotary: rig.motion == Motion::Rotary,
            inertia: number(&parameters.inertia, true),
            command_gain: number(&parameters.command_gain, true),
            effects,
            not_run,
            quantum: in_si(|map| map.quantum),
            noise: in_si(|map| map.noise),
        })
    }

    /// The axis of a trial: each number uniform in its interval, every fourth time as it was found.
    pub fn drawn(&self, seed: u64, index: u64) -> Drawn {
        let mut draw = Draw::new(seed ^ OF_AXIS, index);
        let is_as_found = draw.one_in(4);
        let mut of = |number: &Number| {
            let other = draw.between(number.low, number.high);
            if is_as_found { number.value } else { other }
        };
        let (inertia, gain) = (of(&self.inertia), of(&self.command_gain));
        let effects = self.effects.iter().filter_map(|own| {
            let numbers = own.numbers.iter().map(&mut of).collect();
            Some((Mechanism::from_name(&own.mechanism)?, numbers))
        });
        Drawn {
            inertia,
            gain: gain / self.command_gain.value,
            effects: effects.collect(),
        }
    }

    /// Its units of travel, effort and energy.
    pub const fn units(&self) -> [&'static str; 2] {
        match self.is_rotary {
            false => ["m", "N"],
            true => ["rad", "N·m"],
        }
    }

    /// That trials draw their plant from it, as a sentence.
    pub fn words(&self) -> String {
        let (name, count) = (&self.name, self.effects.len());
        format!(
            "The axis is drawn from {name}: inertia, command gain and {count} of its mechanisms, within their intervals."
        )
    }
}

fn is_resistance(name: &str) -> bool {
    let own = Mechanism::from_name(name).and_then(entry);
    own.is_some_and(|own| matches!(own.form, Form::Resistance(_)))
}

/// What runs, and what does not.
fn effects(all: &[RigEffect]) -> (Vec<FoundEffect>, Vec<NotRun>) {
    let (mut run, mut not_run) = (Vec::new(), Vec::new());
    for effect in all {
        let mechanism = effect.mechanism.name().to_owned();
        match (why_not(effect), entry(effect.mechanism)) {
            (None, Some(entry)) => run.push(FoundEffect {
                mechanism,
                numbers: numbers(entry, &effect.values),
            }),
            (why, _) => not_run.push(NotRun {
                mechanism,
                why: why.unwrap_or("it is no law of the library").to_owned(),
            }),
        }
    }
    (run, not_run)
}

/// Why a mechanism does not run in trials of an axis; `None` where it runs.
fn why_not(effect: &RigEffect) -> Option<&'static str> {
    if effect.of_torque {
        return Some("it is a share of a brake's torque, and the axis has no brake");
    }
    let first = effect.values.first().map_or(0.0, |own| own.value);
    match entry(effect.mechanism)?.form {
        Form::Resistance(_)
        | Form::Drive(Drive::Gain | Drive::Lag | Drive::Limit | Drive::Rate)
        | Form::Joint(OfJoint::Load | OfJoint::Inertia | OfJoint::Compliance | OfJoint::Gap)
        | Form::Sensor(OfSensor::EncoderScale | OfSensor::EncoderOffset | OfSensor::Eccentric) => {
            None
        }
        Form::Drive(Drive::Skew) => {
            (first < 0.0).then_some("its effort comes before it is commanded, which no loop can do")
        }
        Form::Joint(OfJoint::Fade) => {
            Some("friction that falls with time is a law of one recording, not of the next trial")
        }
        Form::Joint(OfJoint::Link | OfJoint::Stiffness | OfJoint::Lash) => {
            Some("it is of a joint of an arm")
        }
        Form::ShareOfBrake(_) | Form::Brake(_) => Some("it is of a brake, and the axis has none"),
        Form::Linkage(_) => Some("it is of a linkage"),
        Form::Sensor(_) => Some("it is of a force sensor"),
    }
}

/// The numbers of a mechanism: what has to stay above zero is drawn above zero.
fn numbers(entry: &Entry, values: &[Value]) -> Vec<Number> {
    let numbers = values.iter().enumerate();
    numbers
        .map(|(index, value)| number(value, entry.passive || index >= entry.linear))
        .collect()
}

fn number(value: &Value, keeps_sign: bool) -> Number {
    let own = value.value;
    let spread = value.sd.map_or(0.0, |sd| DEVIATIONS_95 * sd);
    let end = |given: Option<f64>, usual: f64| {
        let end = given.unwrap_or(usual);
        // An end where the law is another, such as drag that drives, is not gone to.
        if keeps_sign && end * own <= 0.0 {
            own
        } else {
            end
        }
    };
    Number {
        value: own,
        low: end(value.low95, own - spread),
        high: end(value.high95, own + spread),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEAD: &str = "name = \"slide\"\nplant = \"axis\"\nmotion = \"linear\"\n[channels]\n\
        position = { channel = \"x\", unit = \"mm\", quantum = 0.002, noise = 0.001 }\n\
        command = { channel = \"u\", unit = \"V\" }\n[parameters]\n\
        inertia = { value = 1.7, unit = \"kg\", status = \"unknown\", low95 = 1.6, high95 = 1.9 }\n\
        command_gain = { value = 35.5, unit = \"N/V\" }\n";

    fn read(more: &str) -> Result<Found, String> {
        let text = format!("{HEAD}{more}");
        Found::read(&text, Path::new("calibration.toml")).map_err(|error| error.to_string())
    }

    #[test]
    fn an_axis_is_drawn_within_its_intervals_and_never_beyond_what_a_law_is() {
        let found = read(
            "[[effect]]\nmechanism = \"viscous\"\n\
             coefficient = { value = 3.1, unit = \"N·s/m\", status = \"unknown\", low95 = -0.4, high95 = 6.6 }\n",
        )
        .unwrap();
        assert_eq!((found.quantum, found.noise), (2e-6, 1e-6));
        let all: Vec<Drawn> = (0..400).map(|index| found.drawn(7, index)).collect();
        assert_eq!(all[17], found.drawn(7, 17));
        let inertias: Vec<f64> = all.iter().map(|own| own.inertia).collect();
        assert!(inertias.iter().all(|own| (1.6..=1.9).contains(own)));
        assert!(inertias.iter().any(|own| *own < 1.62) && inertias.iter().any(|own| *own > 1.88));
        let as_found = inertias.iter().filter(|own| **own == 1.7).count();
        assert!((60..140).contains(&as_found), "{as_found}");
        assert!(
            all.iter()
                .all(|own| own.effects[0].1[0] >= 3.1 && own.gain == 1.0)
        );
    }

    #[test]
    fn what_no_trial_runs_is_named_with_its_reason() {
        let found = read(
            "[[effect]]\nmechanism = \"dry_offset\"\nlevel = { value = 2.5, unit = \"N\" }\n\
             [[effect]]\nmechanism = \"friction_fade\"\nrate = { value = 0.01, unit = \"1/s\" }\ndrag_rate = { value = 0.0, unit = \"1/s\" }\n",
        )
        .unwrap();
        assert_eq!(found.effects.len(), 1);
        assert_eq!(found.not_run[0].mechanism, "friction_fade");
        assert!(found.not_run[0].why.contains("falls with time"));
    }

    #[test]
    fn a_servo_is_refused_with_what_to_do() {
        let channels = HEAD.replace("unit = \"V\"", "unit = \"m\"");
        let text = format!("{channels}[servo]\ngain = 3.0\nsupply_v = 12.0\nback_emf = 1.1\n");
        let servo = Found::read(&text, Path::new("calibration.toml"));
        let servo = servo.unwrap_err().to_string();
        assert!(servo.contains("take [servo] away"), "{servo}");
    }
}
