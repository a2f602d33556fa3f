//! This file is what a diagnosis found of a rig, as the plant of scenarios: mechanisms with the intervals of their numbers, and a draw of them.

use rigproof_impl::plant::{Parameters, Plant};
use rigproof_spec::effect::Mechanism;
use rigproof_trace::rig::five_bar::{FiveBar, JointEffect};
use serde::{Deserialize, Serialize};

use crate::left_out::{LeftOut, Role, asked, change, known, role};
use crate::scenario::{Draw, Rig};

/// A calibration that scenarios draw their plant from.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Calibration {
    /// Its file.
    pub name: String,
    /// The SHA-256 of its file.
    pub sha256: String,
    /// The layout of its rig.
    pub rig: Rig,
    /// What it names, in its order.
    pub found: Vec<Found>,
}

/// A mechanism, and between which ends each of its numbers is drawn.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Found {
    /// As it was found.
    pub as_found: LeftOut,
    /// The lower ends of the 95 % intervals; the number itself where none is given.
    pub low: Vec<f64>,
    /// The upper ends.
    pub high: Vec<f64>,
}

/// A pose of the linkage in which a plant is tried, θA and θB, rad.
const TRIED_RAD: [f64; 2] = [2.17, 0.83];
/// Sets the draws of a calibration apart from those of the scenario.
const OF_CALIBRATION: u64 = 0xca11_b7a7_1011;

impl Calibration {
    /// That scenarios draw their plant from it, as a sentence.
    pub fn words(&self) -> String {
        let (name, count) = (&self.name, self.found.len());
        format!(
            "The plant is drawn from the calibration {name}: {count} of its mechanisms, within their intervals."
        )
    }

    /// The calibration of a five-bar's description, its file's name and hash.
    ///
    /// # Errors
    /// The fixed-step plant does not know one of the mechanisms, or cannot take its numbers: what and why.
    pub fn of(rig: &FiveBar, name: String, sha256: String) -> Result<Calibration, String> {
        let own = match rig.layout {
            rigproof_spec::layout::Layout::ThreeBrake => Rig::ThreeBrake,
            rigproof_spec::layout::Layout::FourBrake => Rig::FourBrake,
        };
        let found: Result<Vec<Found>, String> = rig
            .effects
            .iter()
            .map(|effect| found(own, effect))
            .collect();
        let calibration = Calibration {
            name,
            sha256,
            rig: own,
            found: found?,
        };
        let all: Vec<LeftOut> = calibration
            .found
            .iter()
            .map(|f| f.as_found.clone())
            .collect();
        if !is_a_plant(own, &all) {
            return Err("together its mechanisms are no plant: at most eight resistances, and masses and torques above zero".to_owned());
        }
        Ok(calibration)
    }

    /// What the plant of a scenario leaves out of the thesis's: each number uniform in its interval, every fourth time as it was found.
    pub fn drawn(&self, seed: u64, index: u64) -> Vec<LeftOut> {
        let mut draw = Draw::new(seed ^ OF_CALIBRATION, index);
        let is_as_found = draw.one_in(4);
        let each = self.found.iter().map(|found| {
            let mut drawn = found.as_found.clone();
            let ends = found.low.iter().zip(&found.high);
            for (number, (low, high)) in drawn.parameters.iter_mut().zip(ends) {
                let other = draw.between(*low, *high);
                *number = if is_as_found { *number } else { other };
            }
            drawn
        });
        each.collect()
    }

    /// Whether nothing in it stores energy or gives it, whatever is drawn: then the rig never holds more than the hand put in.
    pub fn is_passive(&self) -> bool {
        self.found.iter().all(|found| {
            let lowest = LeftOut {
                parameters: found.low.clone(),
                ..found.as_found.clone()
            };
            lowest.is_passive()
        })
    }
}

fn found(rig: Rig, effect: &JointEffect) -> Result<Found, String> {
    let (mechanism, values) = (effect.effect.mechanism, &effect.effect.values);
    let as_found = LeftOut {
        mechanism,
        joint: effect.joint,
        parameters: values.iter().map(|value| value.value).collect(),
    };
    let at = effect.joint.map_or(String::new(), |joint| {
        format!(" at joint {}", joint.letter())
    });
    if effect.axis.is_some() || effect.effect.of_torque {
        return Err(format!(
            "the fixed-step plant has no `{}`{at} as a share of a torque or of one axis of a sensor: take it out, and know that it is not looked at",
            mechanism.name()
        ));
    }
    if role(mechanism).is_none() {
        let known = known().map(Mechanism::name).collect::<Vec<_>>().join(", ");
        return Err(format!(
            "the fixed-step plant of a campaign has no `{}`{at}; it has {known}: take it out, and know that it is not looked at",
            mechanism.name()
        ));
    }
    if !is_a_plant(rig, std::slice::from_ref(&as_found)) {
        return Err(format!(
            "the fixed-step plant takes no `{}`{at} of {:?}",
            mechanism.name(),
            as_found.parameters
        ));
    }
    // An end of an interval that is no law any more, such as a travel below zero, is not gone to.
    let end = |index: usize, end: Option<f64>| {
        let own = as_found.parameters.get(index).copied()?;
        let mut at_end = as_found.clone();
        *at_end.parameters.get_mut(index)? = end?;
        Some(match is_a_plant(rig, &[at_end]) {
            true => end?,
            false => own,
        })
    };
    let ends = |of: fn(&rigproof_trace::rig::Value) -> Option<f64>| -> Vec<f64> {
        let each = values.iter().enumerate();
        each.map(|(index, value)| end(index, of(value)).unwrap_or(value.value))
            .collect()
    };
    Ok(Found {
        low: ends(|value| value.low95),
        high: ends(|value| value.high95),
        as_found,
    })
}

/// Whether the fixed-step plant can be made of this.
fn is_a_plant(rig: Rig, left_out: &[LeftOut]) -> bool {
    let mut parameters = Parameters::of(rig.layout());
    let are_joints = left_out.iter().all(|one| {
        let is_needed = role(one.mechanism).is_some_and(Role::needs_joint);
        is_needed == one.joint.is_some() && one.parameters.iter().all(|number| number.is_finite())
    });
    are_joints
        && change(&mut parameters, left_out).is_some()
        && Plant::new(&parameters, TRIED_RAD, [0.0; 2], &asked(left_out)).is_some()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    /// A calibration with these effects.
    fn calibration(effects: &str) -> Result<Calibration, String> {
        let channels = "[channels]\ntheta_a = { channel = \"a\", unit = \"rad\" }\ntheta_b = { channel = \"b\", unit = \"rad\" }\n\
             force_x = { channel = \"x\", unit = \"N\" }\nforce_y = { channel = \"y\", unit = \"N\" }\n\
             current_a = { channel = \"i\", unit = \"A\" }\ncurrent_e = { channel = \"j\", unit = \"A\" }\ncurrent_b = { channel = \"k\", unit = \"A\" }\n";
        let text = format!(
            "name = \"a rig\"\nplant = \"rig\"\nlayout = \"three_brake\"\n{channels}{effects}"
        );
        let rig =
            FiveBar::parse(&text, Path::new("calibration.toml")).map_err(|e| e.to_string())?;
        Calibration::of(&rig, "calibration.toml".to_owned(), String::new())
    }

    #[test]
    fn every_number_is_drawn_within_its_interval() {
        let read = calibration(
            "[[effect]]\nmechanism = \"viscous\"\njoint = \"E\"\ncoefficient = { value = 0.017, unit = \"N·m·s/rad\", status = \"unknown\", low95 = 0.013, high95 = 0.023 }\n\
             [[effect]]\nmechanism = \"payload\"\nmass = { value = 0.31, unit = \"kg\", status = \"unknown\" }\n",
        )
        .unwrap();
        assert!(read.is_passive());
        let all: Vec<Vec<LeftOut>> = (0..400).map(|index| read.drawn(7, index)).collect();
        assert_eq!(all[17], read.drawn(7, 17));
        let viscous: Vec<f64> = all.iter().map(|one| one[0].parameters[0]).collect();
        assert!(viscous.iter().all(|own| (0.013..=0.023).contains(own)));
        assert!(viscous.iter().any(|own| *own < 0.014) && viscous.iter().any(|own| *own > 0.022));
        let as_found = viscous.iter().filter(|own| **own == 0.017).count();
        assert!((60..140).contains(&as_found), "{as_found}");
        assert!(all.iter().all(|one| one[1].parameters == [0.31]));
    }

    #[test]
    fn what_the_plant_does_not_have_is_refused_by_name() {
        let refused = calibration(
            "[[effect]]\nmechanism = \"thermal_fade\"\njoint = \"A\"\nper_joule = { value = 0.003, unit = \"1/J\", status = \"unknown\" }\ncooling = { value = 30, unit = \"s\", status = \"unknown\" }\n",
        );
        let refused = refused.unwrap_err();
        assert!(
            refused.contains("no `thermal_fade` at joint A") && refused.contains("viscous"),
            "{refused}"
        );
        let spring = calibration(
            "[[effect]]\nmechanism = \"spring\"\njoint = \"B\"\nstiffness = { value = 0.4, unit = \"N·m/rad\", status = \"unknown\" }\n",
        );
        assert!(!spring.unwrap().is_passive());
        let away = calibration(
            "[[effect]]\nmechanism = \"gain_error\"\njoint = \"C\"\nfraction = { value = 0.1, unit = \"1\", status = \"unknown\" }\n",
        );
        assert!(
            away.unwrap_err()
                .contains("takes no `gain_error` at joint C")
        );
    }
}
