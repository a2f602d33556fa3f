//! This file gives the laws that act in a free run of a plant of one joint, each from its onset on.

use super::columns::{fades_at, is_of_brake};
use super::simulate::Model;
use crate::effect::Effect;
use rigproof_model::axis::MOST_LAWS;
use rigproof_model::effects::{Form, Instant, Law, OfJoint, facts, form, law};
use rigproof_spec::effect::Mechanism;

/// The laws of a plant: one for each effect that is a resistance, and one for each described effect
/// that fades.
pub(super) fn laws(plant: &Model) -> Vec<Box<dyn Law>> {
    let own = resistances(plant).map(|(effect, law)| with_onset(law, effect.onset_s));
    let mut all: Vec<Box<dyn Law>> = own.collect();
    for (place, fade) in plant.effects.iter().enumerate() {
        if !matches!(form(fade.mechanism()), Some(Form::Joint(OfJoint::Fade))) {
            continue;
        }
        let described = plant.effects.iter().take(place.min(plant.described));
        let faded = described.filter_map(|effect| {
            let law = with_onset(own_law(effect)?, effect.onset_s);
            let rate = fade.value(fades_at(effect)?);
            Some(with_onset(Box::new(Faded { law, rate }), fade.onset_s))
        });
        all.extend(faded.collect::<Vec<_>>());
    }
    all
}

/// Why a free run cannot evaluate so many laws; `None` if it can.
pub(super) fn too_many(plant: &Model) -> Option<String> {
    let count = laws(plant).len();
    (count > MOST_LAWS).then(|| {
        format!(
            "{count} resistances act together, a free run has room for {MOST_LAWS}: take some out"
        )
    })
}

fn resistances(plant: &Model) -> impl Iterator<Item = (&Effect, Box<dyn Law>)> {
    let effects = plant.effects.iter();
    effects.filter_map(|effect| Some((effect, own_law(effect)?)))
}

/// The law of an effect that is a resistance of its own; `None` for what a brake does.
pub(super) fn own_law(effect: &Effect) -> Option<Box<dyn Law>> {
    let is_own = !is_of_brake(effect.cause);
    is_own.then(|| law(effect.mechanism(), &effect.parameters))?
}

/// After sliding, a bristle has its full deflection.
pub(super) fn bend_bristles(plant: &Model, memory: &mut [f64], speed: f64) {
    for ((effect, law), memory) in resistances(plant).zip(memory) {
        if is_bristle(effect.mechanism()) && speed != 0.0 {
            *memory = law.memory_after(*memory, FAR.copysign(speed), speed);
        }
    }
}

/// Whether a mechanism is presliding friction, a form of it, or a sum that contains it.
fn is_bristle(mechanism: Mechanism) -> bool {
    let facts = facts(mechanism);
    let same_as = facts.and_then(|facts| facts.form_of).unwrap_or(mechanism);
    let first = facts.and_then(|facts| facts.both).map(|[first, _]| first);
    [Some(same_as), first].contains(&Some(Mechanism::Presliding))
}

/// A travel long enough to deflect every bristle fully, m or rad.
const FAR: f64 = 1e12;

/// The part of a law that fades with time.
struct Faded {
    law: Box<dyn Law>,
    rate: f64,
}

impl Faded {
    fn lost(&self, now: &Instant) -> f64 {
        -self.rate * now.time_s
    }
}

impl Law for Faded {
    fn smooth(&self, now: &Instant, memory: f64) -> f64 {
        self.lost(now) * self.law.smooth(now, memory)
    }

    fn dry(&self, now: &Instant) -> f64 {
        self.lost(now) * self.law.dry(now)
    }

    fn remembers(&self) -> bool {
        self.law.remembers()
    }

    fn starts_with(&self) -> f64 {
        self.law.starts_with()
    }

    fn memory_rate(&self, now: &Instant, memory: f64) -> f64 {
        self.law.memory_rate(now, memory)
    }

    fn memory_after(&self, memory: f64, travel: f64, speed: f64) -> f64 {
        self.law.memory_after(memory, travel, speed)
    }
}

/// A law that starts to act at its onset.
struct Late {
    law: Box<dyn Law>,
    onset_s: f64,
}

impl Law for Late {
    fn smooth(&self, now: &Instant, memory: f64) -> f64 {
        if now.time_s < self.onset_s {
            0.0
        } else {
            self.law.smooth(now, memory)
        }
    }

    fn dry(&self, now: &Instant) -> f64 {
        if now.time_s < self.onset_s {
            0.0
        } else {
            self.law.dry(now)
        }
    }

    fn remembers(&self) -> bool {
        self.law.remembers()
    }

    fn starts_with(&self) -> f64 {
        self.law.starts_with()
    }

    fn begins_anew(&self) -> bool {
        self.law.begins_anew()
    }

    fn memory_rate(&self, now: &Instant, memory: f64) -> f64 {
        self.law.memory_rate(now, memory)
    }

    fn parts(&self, now: &Instant, memory: f64) -> (f64, f64) {
        if now.time_s < self.onset_s {
            (0.0, 0.0)
        } else {
            self.law.parts(now, memory)
        }
    }

    fn memory_after(&self, memory: f64, travel: f64, speed: f64) -> f64 {
        self.law.memory_after(memory, travel, speed)
    }
}

fn with_onset(law: Box<dyn Law>, onset_s: Option<f64>) -> Box<dyn Law> {
    match onset_s {
        Some(onset_s) => Box::new(Late { law, onset_s }),
        None => law,
    }
}
