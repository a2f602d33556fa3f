//! This file is the list of physics that a plant's nominal model may leave out: a new mechanism is one file
//! and one line here.
//!
//! Every law gives a *resistance*: an effort counted positive against positive motion, so that an axis obeys
//! `inertia·q̈ = gain·u − Σ resistance` and a bench meters `Σ resistance`.

mod asymmetric_presliding;
mod backlash;
mod bias_drift;
mod brake;
mod clock_jitter;
mod constant_bias;
mod dahl_bristle;
mod direction_asymmetry;
mod driven;
mod dry_offset;
mod eccentric_encoder;
mod encoder;
pub mod facts;
mod hysteresis;
mod joint_stop;
mod lag;
mod limits;
mod linkage;
mod lugre_bristle;
mod nonlinear_spring;
mod play;
mod presliding;
mod resisting;
mod reversal_overshoot;
mod ripple;
mod settling;
mod spring;
mod stribeck;
mod torque_drift;
pub mod transmission;
mod uneven_friction;
mod velocity_power;
mod viscous;

pub use brake::{bent_command, slower};
pub use driven::load_friction;
pub use eccentric_encoder::{behind_shown, shown_too_much};
pub use lag::{first_order_lag_held, first_order_lag_straight, lagged, lagged_held};
pub use limits::{limited, slewed, slewed_held};
pub use play::{CurrentPlay, PLAYS, Played};

use facts::{Facts, Family, Words};
use rigproof_spec::effect::Mechanism;

/// What a law may look at: one instant of the motion. Travel in m or rad.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Instant {
    /// Time since the recording's first sample, s.
    pub time_s: f64,
    /// Position, m or rad.
    pub position: f64,
    /// Speed, m/s or rad/s.
    pub speed: f64,
    /// Sense of motion: +1, −1, or 0 at rest; between them only where a recording cannot tell.
    pub sense: f64,
}

/// A resistance law. Parameters are fixed when the law is built; memory is one number that the plant
/// integrates.
pub trait Law: Send + Sync {
    /// The part of the resistance that is a function of the instant and the memory (N or N·m).
    fn smooth(&self, _now: &Instant, _memory: f64) -> f64 {
        0.0
    }

    /// The dry level: the resistance is `level·sense` in motion and anything up to `level` at rest.
    fn dry(&self, _now: &Instant) -> f64 {
        0.0
    }

    /// The smooth part and the dry level as a joint of the rig has them, where a dry level may know the memory and holds at rest
    /// too. `now.sense` is +1 or −1, at rest the sense that is tried.
    fn parts(&self, now: &Instant, memory: f64) -> (f64, f64) {
        (self.smooth(now, memory), self.dry(now))
    }

    /// Whether the law has a memory.
    fn remembers(&self) -> bool {
        false
    }

    /// The memory before any motion.
    fn starts_with(&self) -> f64 {
        0.0
    }

    /// Whether a change of sense begins the memory anew: where the sense cannot be told, nothing is known to have changed.
    fn begins_anew(&self) -> bool {
        false
    }

    /// The time derivative of the memory, 0 for a law without any.
    fn memory_rate(&self, _now: &Instant, _memory: f64) -> f64 {
        0.0
    }

    /// The memory after a travel in one sense, m or rad, at a speed that holds, m/s or rad/s: the solution of [`Law::memory_rate`].
    /// After no travel it is the memory with which a motion of that sense begins.
    fn memory_after(&self, memory: f64, _travel: f64, _speed: f64) -> f64 {
        memory
    }
}

/// How a mechanism enters the equations of a plant.
#[derive(Clone, Copy)]
pub enum Form {
    /// A resistance along the motion, built from the parameters in the vocabulary's order.
    Resistance(fn(&[f64]) -> Box<dyn Law>),
    /// A share of a brake's torque, positive along the motion: the law says how great a share.
    ShareOfBrake(fn(&[f64]) -> Box<dyn Law>),
    /// A change of the driving effort, applied by the plant itself.
    Drive(Drive),
    /// Something that a brake does with its current: it needs the brake.
    Brake(OfBrake),
    /// Something that only a linkage has.
    Linkage(OfLinkage),
    /// What a sensor shows other than what is there.
    Sensor(OfSensor),
    /// Something that a driven joint has as a whole.
    Joint(OfJoint),
}

/// What a driven joint has as a whole.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OfJoint {
    /// Friction by the effort that it transmits.
    Load,
    /// Friction that falls with time.
    Fade,
    /// Another inertia.
    Inertia,
    /// An inertia behind a spring.
    Compliance,
    /// An inertia behind a gap.
    Gap,
    /// Another stiffness of its transmission.
    Stiffness,
    /// A gap in its transmission.
    Lash,
    /// Other masses of a link of an arm.
    Link,
}

/// A change of the driving effort.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Drive {
    /// A first-order lag.
    Lag,
    /// A wrong gain.
    Gain,
    /// A time shift.
    Skew,
    /// A greatest effort.
    Limit,
    /// A greatest rate of the effort.
    Rate,
}

/// What a brake does with its current.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OfBrake {
    /// Another backlash.
    BacklashWidth,
    /// A memory of the current.
    CurrentHysteresis,
    /// A delay of the current.
    DeadTime,
    /// A greatest current.
    Saturation,
    /// A torque that falls with heat.
    ThermalFade,
    /// Other time constants.
    TimeConstant,
    /// Another current.
    CurrentGain,
    /// Another curve over its command.
    CommandExponent,
}

/// What a linkage has as a whole, or by the force on its tip.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OfLinkage {
    /// Friction by the force on the tip.
    Load,
    /// Weight.
    Weight,
    /// Other moments of inertia.
    Inertias,
    /// All inertias by one factor.
    InertiaScale,
    /// A mass at the tip.
    Payload,
    /// A spring from the tip to the plane.
    PlaneSpring,
    /// An arm of another length.
    LinkLength,
}

/// What a sensor shows other than what is there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OfSensor {
    /// A wrong scale of an angle.
    EncoderScale,
    /// A wrong zero of an angle.
    EncoderOffset,
    /// An error that repeats, such as that of a disc off its centre.
    Eccentric,
    /// Time stamps that scatter.
    Clock,
    /// A wrong scale of the force.
    ForceGain,
    /// A wrong zero of the force.
    ForceBias,
    /// A force sensor that is mounted turned.
    ForceRotation,
}

impl Form {
    /// Whether what a brake holds depends on what its current did before.
    pub const fn goes_by_past_current(self) -> bool {
        matches!(self, Form::Drive(Drive::Lag) | Form::Brake(_))
    }

    /// Whether an encoder is off: every angle of a linkage is then another one.
    pub const fn is_of_encoder(self) -> bool {
        matches!(
            self,
            Form::Sensor(OfSensor::EncoderScale | OfSensor::EncoderOffset | OfSensor::Eccentric)
        )
    }
}

/// One mechanism as the diagnosis and the plants use it.
#[derive(Clone, Copy)]
pub struct Entry {
    /// Its name in the vocabulary.
    pub mechanism: Mechanism,
    /// How it enters.
    pub form: Form,
    /// How many of its leading parameters are linear coefficients; the others shape the law.
    pub linear: usize,
    /// Whether none of its coefficients can be negative, because the mechanism would give energy.
    pub passive: bool,
    /// What would refute it, in words for the report.
    pub refuted_by: &'static str,
    /// The equation as the report prints it.
    pub equation: &'static str,
    /// What else is known of it.
    pub facts: Facts,
}

/// The library. Order is the order in which ties are reported.
pub const LIBRARY: &[Entry] = &[
    dry_offset::ENTRY,
    constant_bias::ENTRY,
    viscous::ENTRY,
    velocity_power::ENTRY,
    direction_asymmetry::ENTRY,
    stribeck::ENTRY,
    presliding::ENTRY,
    dahl_bristle::ENTRY,
    lugre_bristle::ENTRY,
    backlash::ENTRY,
    asymmetric_presliding::ENTRY,
    hysteresis::ENTRY,
    ripple::ENTRY,
    uneven_friction::ENTRY,
    spring::ENTRY,
    nonlinear_spring::ENTRY,
    joint_stop::ENTRY,
    bias_drift::ENTRY,
    lag::ENTRY,
    lag::GAIN_ENTRY,
    lag::SKEW_ENTRY,
    limits::ENTRY,
    limits::RATE_ENTRY,
    reversal_overshoot::ENTRY,
    reversal_overshoot::OF_FRICTION,
    settling::ENTRY,
    brake::BACKLASH_WIDTH,
    brake::CURRENT_HYSTERESIS,
    brake::DEAD_TIME,
    brake::SATURATION,
    torque_drift::ENTRY,
    brake::THERMAL_FADE,
    brake::TIME_CONSTANT,
    brake::CURRENT_GAIN,
    brake::COMMAND_EXPONENT,
    dry_offset::BEARING,
    linkage::LOAD_DEPENDENT,
    driven::LOAD_FRICTION,
    driven::FRICTION_FADE,
    driven::ADDED_INERTIA,
    driven::LINK_INERTIA,
    driven::COMPLIANCE,
    driven::LOAD_BACKLASH,
    transmission::STIFFNESS,
    transmission::BACKLASH,
    linkage::GRAVITY,
    linkage::INERTIA_ERROR,
    linkage::INERTIA_SCALE,
    linkage::PAYLOAD,
    linkage::PLANE_SPRING,
    linkage::LINK_LENGTH,
    linkage::ENCODER_SCALE,
    linkage::ENCODER_OFFSET,
    eccentric_encoder::ENTRY,
    clock_jitter::ENTRY,
    linkage::FORCE_GAIN,
    linkage::FORCE_BIAS,
    linkage::FORCE_ROTATION,
];

/// The entry of a mechanism, or `None` while the library has no law for it.
pub fn entry(mechanism: Mechanism) -> Option<&'static Entry> {
    LIBRARY.iter().find(|entry| entry.mechanism == mechanism)
}

/// The law of a mechanism with these parameters, of a resistance or of a share of a brake's torque; `None` for a mechanism of
/// another form.
pub fn law(mechanism: Mechanism, parameters: &[f64]) -> Option<Box<dyn Law>> {
    match entry(mechanism)?.form {
        Form::Resistance(build) | Form::ShareOfBrake(build) => Some(build(parameters)),
        Form::Drive(_) | Form::Brake(_) | Form::Linkage(_) | Form::Sensor(_) | Form::Joint(_) => {
            None
        }
    }
}

/// The law of a mechanism as a share of a brake's torque; `None` for a mechanism of another form.
///
/// A brake resists: what depends on the position alone is then a share of its resistance, and turns with the sense of motion.
pub fn law_of_torque(mechanism: Mechanism, parameters: &[f64]) -> Option<Box<dyn Law>> {
    let own = law(mechanism, parameters)?;
    match facts(mechanism)?.family {
        Family::Position => Some(Box::new(resisting::Resisting(own))),
        _ => Some(own),
    }
}

/// How a mechanism enters the equations, or `None` while the library has no law for it.
pub fn form(mechanism: Mechanism) -> Option<Form> {
    entry(mechanism).map(|entry| entry.form)
}

/// How many of a mechanism's leading parameters are linear coefficients; 0 while the library has no
/// law for it.
pub fn linear(mechanism: Mechanism) -> usize {
    entry(mechanism).map_or(0, |entry| entry.linear)
}

/// What is known of a mechanism, or `None` while the library has no law for it.
pub fn facts(mechanism: Mechanism) -> Option<&'static Facts> {
    entry(mechanism).map(|entry| &entry.facts)
}

/// A mechanism in plain words, also where the library has no law for it.
pub fn words(mechanism: Mechanism) -> Words {
    facts(mechanism).map_or(driven::COMPLIANCE.facts.words, |facts| facts.words)
}

/// A memory that relaxes towards `target` within `length` of travel.
fn relaxed(memory: f64, target: f64, travel: f64, length: f64) -> f64 {
    target + (memory - target) * libm::exp(-travel.abs() / length)
}

/// The parameter at an index, 0 when the list is short.
fn parameter(parameters: &[f64], index: usize) -> f64 {
    parameters.get(index).copied().unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_catalogue_holds_every_law_of_the_library_in_its_order() {
        let page = include_str!("../../docs/mechanisms.md");
        let (laws, _) = page.split_once("## What else is known").unwrap();
        let rows: Vec<&str> = laws.lines().filter(|l| l.starts_with("| `")).collect();
        assert_eq!(rows.len(), LIBRARY.len());
        for (row, entry) in rows.iter().zip(LIBRARY) {
            let law = entry.equation.replace('|', "\\|");
            let start = format!("| `{}` | {law} | ", entry.mechanism.name());
            assert!(row.starts_with(&start), "{start}");
            assert!(
                row.ends_with(&format!(" | {} |", entry.refuted_by)),
                "{row}"
            );
            for parameter in entry.mechanism.parameters() {
                assert!(row.contains(&format!("`{}`", parameter.name)), "{row}");
            }
            assert_eq!(row.contains(" | yes | "), entry.passive, "{row}");
        }
    }

    #[test]
    fn every_mechanism_but_compliance_has_a_law_and_words_of_its_own() {
        let without = Mechanism::ALL
            .into_iter()
            .filter(|own| entry(*own).is_none());
        let without: Vec<Mechanism> = without.collect();
        assert!(
            without
                .iter()
                .all(|own| *own == Mechanism::Compliance && own.parameters().is_empty()),
            "{without:?}"
        );
        let mut said: Vec<&str> = Vec::new();
        for mechanism in Mechanism::ALL {
            let Words { what, look_for } = words(mechanism);
            said.extend([what, look_for]);
        }
        let count = said.len();
        said.sort_unstable();
        said.dedup();
        assert_eq!(said.len(), count);
    }

    #[test]
    fn what_the_facts_point_to_is_there() {
        for entry in LIBRARY {
            let Facts {
                limit,
                zero,
                twin,
                both,
                refit,
                shapes,
                ..
            } = entry.facts;
            let name = entry.mechanism.name();
            let parameters = entry.mechanism.parameters();
            assert!(entry.linear <= entry.mechanism.needed(), "{name}");
            assert!(refit.sizes.len() <= parameters.len(), "{name}");
            if let Some(limit) = limit {
                assert!(limit.parameter < parameters.len(), "{name}");
                assert!(limit.of != entry.mechanism, "{name}");
            }
            if let Some(twin) = twin {
                let back = facts(twin).and_then(|facts| facts.twin);
                assert_eq!(back, Some(entry.mechanism));
            }
            for other in zero.into_iter().chain(both.into_iter().flatten()) {
                assert!(self::entry(other).is_some(), "{name}");
            }
            // What has no shape needs no number but its coefficients; an encoder's is the step at which its column is taken.
            let is_optional = matches!(
                shapes,
                facts::Shapes::Optional { .. } | facts::Shapes::Pitch
            );
            let is_shaped = entry.mechanism.needed() > entry.linear
                || entry.form.is_of_encoder()
                || is_optional && parameters.len() > entry.linear;
            assert_eq!(shapes != facts::Shapes::None, is_shaped, "{name}");
        }
    }

    #[test]
    fn the_memory_after_a_travel_solves_its_rate() {
        let mut tried = 0;
        for entry in LIBRARY {
            let Some(law) = law(entry.mechanism, &[1.3, 3.7, 2.3, 0.7]) else {
                continue;
            };
            for (start, travel) in [(0.21, 0.43), (0.21, -0.43), (-0.17, 0.61), (0.31, -0.7)] {
                let steps = 20_000;
                let now = Instant {
                    time_s: 0.7,
                    position: 0.031,
                    speed: travel,
                    sense: f64::signum(travel),
                };
                let h = 1.0 / f64::from(steps);
                let begun = law.memory_after(start, 0.0, travel);
                let mut memory = begun;
                for _ in 0..steps {
                    let middle = memory + 0.5 * h * law.memory_rate(&now, memory);
                    memory += h * law.memory_rate(&now, middle);
                }
                let exact = law.memory_after(begun, travel, travel);
                // A memory that has come to an end stays there; steps come there within one of them.
                let has_ended = law.memory_after(exact, travel, travel) == exact;
                let most = match has_ended && law.remembers() {
                    true => h * travel.abs(),
                    false => 1e-8,
                };
                assert!((memory - exact).abs() < most, "{:?}", entry.mechanism);
                tried += usize::from(law.remembers());
            }
        }
        assert_eq!(tried, 40);
    }
}
