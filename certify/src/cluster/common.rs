//! This file says what all trials of a cluster have and few others do: a number of the plant beyond a value, a layout, a hand.

use serde::{Deserialize, Serialize};

use crate::hand::{Hand, Manner};
use crate::law::Law;
use crate::plan::Plan;
use crate::record::Record;
use crate::scenario::{Rig, Scenario};

/// Others that are looked at, at most, the first ones.
const OTHERS: usize = 1000;
/// How likely it may be at most that trials taken at random have one of the properties that are looked at.
const CHANCE: f64 = 0.01;

/// Something that all trials of a cluster have.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Common {
    /// What.
    pub what: String,
    /// The share of the trials that do not break the law which have it too.
    pub others: f64,
}

/// What is known of a scenario before it is run: numbers of its plant, and kinds.
struct Facts {
    numbers: [f64; 17],
    kinds: [&'static str; 2],
}

const NUMBERS: [&str; 17] = [
    "torque of brake A",
    "torque of brake E",
    "torque of brake B",
    "torque of brake C",
    "time constant of brake A",
    "time constant of brake E",
    "time constant of brake B",
    "time constant of brake C",
    "backlash of brake A",
    "backlash of brake E",
    "backlash of brake B",
    "backlash of brake C",
    "inertia of arm AE",
    "inertia of arm ED",
    "inertia of arm BC",
    "inertia of arm CD",
    "payload",
];

fn facts(scenario: &Scenario) -> Facts {
    let plant = &scenario.plant;
    let four = [
        plant.torque,
        plant.time_constant,
        plant.backlash,
        plant.inertia,
    ];
    let mut numbers = [plant.payload_kg; 17];
    let all = four.into_iter().flatten();
    numbers
        .iter_mut()
        .zip(all)
        .for_each(|(to, from)| *to = from);
    let hand = match scenario.hand {
        Hand::Operator { manner, .. } => match manner {
            Manner::Gentle => "a gentle hand",
            Manner::Hasty => "a hasty hand",
            Manner::Trembling => "a trembling hand",
        },
        Hand::Adversary { .. } => "an adversary's hand",
        Hand::Constant(_) => "a constant push",
    };
    let rig = match scenario.rig {
        Rig::ThreeBrake => "the 3-brake layout",
        Rig::FourBrake => "the 4-brake layout",
    };
    Facts {
        numbers,
        kinds: [rig, hand],
    }
}

/// What all of these trials have, and so few of those that do not break the law that chance is no explanation.
pub(super) fn common(plan: &Plan, records: &[&Record], law: Law, own: &[u64]) -> Vec<Common> {
    let is_other = |record: &&&Record| {
        let fared = record.fared.get(law as usize);
        fared.is_some_and(|fared| fared.broken == 0)
    };
    let of = |index: u64| facts(&plan.scenario(index));
    let others = records.iter().filter(is_other).take(OTHERS);
    let others: Vec<Facts> = others.map(|record| of(record.index)).collect();
    let own: Vec<Facts> = own.iter().take(OTHERS).map(|index| of(*index)).collect();
    let share = |has: &dyn Fn(&Facts) -> bool| {
        let count = others.iter().filter(|facts| has(facts)).count();
        // One more of either kind, so that none of a few others is no proof.
        (count as f64 + 1.0) / (others.len() as f64 + 1.0)
    };
    // Each number on two sides, and each kind.
    let looked_at = (2 * NUMBERS.len() + 2) as f64;
    let is_told = |share: f64| {
        let chance = libm::pow(share, own.len() as f64);
        chance * looked_at < CHANCE
    };
    let mut found = Vec::new();
    for (place, name) in (0..).zip(NUMBERS) {
        let number = |facts: &Facts| facts.numbers.get(place).copied().unwrap_or_default();
        let (mut least, mut most) = (f64::MAX, f64::MIN);
        own.iter().map(number).for_each(|value| {
            (least, most) = (f64::min(least, value), f64::max(most, value));
        });
        let unit = if name == "payload" {
            "kg"
        } else {
            "of its nominal value"
        };
        let above = share(&|facts: &Facts| number(facts) >= least);
        let below = share(&|facts: &Facts| number(facts) <= most);
        if is_told(above) {
            found.push((above, format!("{name} at least {least:+.3} {unit}")));
        }
        if is_told(below) {
            found.push((below, format!("{name} at most {most:+.3} {unit}")));
        }
    }
    for place in 0..2 {
        let kind = |facts: &Facts| facts.kinds.get(place).copied().unwrap_or_default();
        let mut kinds = own.iter().map(kind);
        let Some(first) = kinds.next() else { continue };
        let shared = share(&|facts: &Facts| kind(facts) == first);
        if kinds.all(|other| other == first) && is_told(shared) {
            found.push((shared, first.to_owned()));
        }
    }
    found.sort_by(|one, other| one.0.total_cmp(&other.0));
    let named = |(others, what): (f64, String)| Common { what, others };
    found.into_iter().take(3).map(named).collect()
}
