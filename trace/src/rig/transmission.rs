//! This file is the transmission between the motor of an arm's joint and its link: what a second encoder or a torque sensor
//! shows of it, and how stiff it is.

use rigproof_spec::effect::{Motion, Quantity};

use super::chain::ChainJoint;
use super::read::{above_zero, read_channel, read_value};
use super::table::Table;
use super::write::{channel, value};
use super::{ChannelMap, Status, Value};
use crate::error::TraceError;

/// The keys of a `[[joint]]` that state its transmission.
pub(super) const KEYS: [&str; 4] = ["motor", "torque", "stiffness", "rotor"];

/// What is recorded and known of the transmission of a joint. Positions, torques and inertias of the motor are those at the
/// joint: a gear ratio is the `scale` of the motor's channel.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Transmission {
    /// Position of the motor, rad or m.
    pub motor: Option<ChannelMap>,
    /// What passes the transmission, as a sensor shows it, N·m or N.
    pub torque: Option<ChannelMap>,
    /// Stiffness, N·m/rad or N/m.
    pub stiffness: Option<Value>,
    /// Inertia of the motor, kg·m² or kg.
    pub rotor: Option<Value>,
}

/// A part of a joint at which a mechanism may act.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// Its link, or the whole joint where nothing is stated of its transmission.
    Link,
    /// Its motor, before the transmission.
    Motor,
    /// The transmission.
    Transmission,
    /// The sensor of what passes the transmission.
    Sensor,
}

impl Part {
    /// All of them.
    pub const ALL: [Part; 4] = [Part::Link, Part::Motor, Part::Transmission, Part::Sensor];

    const fn suffix(self) -> &'static str {
        match self {
            Part::Link => "",
            Part::Motor => ".motor",
            Part::Transmission => ".transmission",
            Part::Sensor => ".torque",
        }
    }

    /// The name of this part of a joint: `elbow`, `elbow.motor`, `elbow.transmission`, `elbow.torque`.
    pub fn of(self, joint: &str) -> String {
        format!("{joint}{}", self.suffix())
    }
}

impl Transmission {
    /// Whether the motor is told from the link.
    pub const fn is_seen(&self) -> bool {
        self.motor.is_some() || self.torque.is_some()
    }

    /// Whether a joint with this transmission has a part.
    pub const fn has(&self, part: Part) -> bool {
        match part {
            Part::Link => true,
            Part::Motor => self.is_seen(),
            Part::Transmission => self.motor.is_some(),
            Part::Sensor => self.torque.is_some(),
        }
    }

    /// Reads it from a `[[joint]]` that slides or turns.
    pub(super) fn read(table: &Table<'_>, motion: Motion) -> Result<Transmission, TraceError> {
        let dimension = |quantity: Quantity| quantity.dimension(motion);
        let own = Transmission {
            motor: read_channel(table, "motor", Some(dimension(Quantity::Travel)))?,
            torque: read_channel(table, "torque", Some(dimension(Quantity::Effort)))?,
            stiffness: stated(table, "stiffness", Quantity::EffortPerTravel, motion)?,
            rotor: stated(table, "rotor", Quantity::Inertia, motion)?,
        };
        let said = match &own.stiffness {
            None if own.motor.is_some() => {
                "`motor` needs `stiffness`: give the transmission's as you know it; what it lacks is found"
            }
            Some(_) if !own.is_seen() => {
                "`stiffness` needs `motor` or `torque`: without them no twist is known"
            }
            _ if own.rotor.is_some() && !own.is_seen() => {
                "`rotor` needs `motor` or `torque`: without them the motor and the link are one inertia"
            }
            _ => return Ok(own),
        };
        Err(table.error(said))
    }

    /// Its lines in a `[[joint]]`.
    pub(super) fn lines(&self, motion: Motion) -> Vec<String> {
        let channels = [("motor", &self.motor), ("torque", &self.torque)].into_iter();
        let channels = channels.filter_map(|(key, map)| {
            let map = map.as_ref()?;
            Some(format!("{key} = {}", channel(map)))
        });
        let values = [
            ("stiffness", &self.stiffness, Quantity::EffortPerTravel),
            ("rotor", &self.rotor, Quantity::Inertia),
        ];
        let values = values.into_iter().filter_map(|(key, own, quantity)| {
            let own = own.as_ref()?;
            Some(format!(
                "{key} = {}",
                value(own, quantity.dimension(motion))
            ))
        });
        channels.chain(values).collect()
    }

    /// Every channel that is named.
    pub(super) fn maps(&self) -> impl Iterator<Item = &ChannelMap> {
        self.motor.iter().chain(&self.torque)
    }

    /// The same, to be changed.
    pub(super) fn maps_mut(&mut self) -> impl Iterator<Item = &mut ChannelMap> {
        self.motor.iter_mut().chain(&mut self.torque)
    }
}

/// A positive number that is known: a wrong one is a candidate at every joint anyway.
fn stated(
    table: &Table<'_>,
    key: &str,
    quantity: Quantity,
    motion: Motion,
) -> Result<Option<Value>, TraceError> {
    let Some(own) = read_value(table, key, quantity.dimension(motion))? else {
        return Ok(None);
    };
    if own.status != Status::Known {
        let said =
            format!("`{key}` has no status: a wrong one is looked for anyway, leave `status` out");
        return Err(table.error_at(key, said));
    }
    above_zero(table, key, &own, quantity.dimension(motion))?;
    Ok(Some(own))
}

/// The joint and the part of it that a name stands for.
pub fn part<'a>(name: &str, joints: &'a [ChainJoint]) -> Option<(&'a ChainJoint, Part)> {
    let each = joints.iter();
    let mut parts = each.flat_map(|joint| Part::ALL.map(|part| (joint, part)));
    parts.find(|(joint, part)| joint.transmission.has(*part) && part.of(&joint.name) == name)
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::rig::chain::ChainRig;

    /// An arm whose one joint has these lines more.
    fn arm(more: &str) -> Result<ChainRig, String> {
        let text = format!(
            "name = \"arm\"\nplant = \"chain\"\nurdf = '''<robot/>'''\n[[joint]]\nname = \"elbow\"\n\
             position = {{ channel = \"q\", unit = \"rad\" }}\neffort = {{ channel = \"tau\", unit = \"N·m\" }}\n{more}"
        );
        ChainRig::parse(&text, Path::new("arm.toml")).map_err(|error| error.to_string())
    }

    const MOTOR: &str = "motor = { channel = \"theta\", unit = \"rad\", scale = 0.01 }\n";
    const STIFFNESS: &str = "stiffness = { value = 9, unit = \"kN·m/rad\" }\n";
    const TORQUE: &str = "torque = { channel = \"s\", unit = \"N·m\" }\n";

    #[test]
    fn a_transmission_is_read_and_written_again() {
        let rotor = "rotor = { value = 0.4, unit = \"kg·m^2\" }\n";
        let effect = "[[effect]]\nmechanism = \"viscous\"\njoint = \"elbow.motor\"\ncoefficient = { value = 2, unit = \"N·m·s/rad\" }\n";
        let rig = arm(&[MOTOR, STIFFNESS, TORQUE, rotor, effect].concat()).unwrap();
        let own = &rig.joints[0].transmission;
        assert_eq!(own.stiffness.unwrap().value, 9000.0);
        assert_eq!(rig.maps().len(), 4);
        assert!(Part::ALL.into_iter().all(|part| own.has(part)));
        assert_eq!(part("elbow.motor", &rig.joints).unwrap().1, Part::Motor);
        let again = ChainRig::parse(&rig.to_toml(), Path::new("arm.toml")).unwrap();
        assert_eq!(again, rig);
    }

    #[test]
    fn what_is_missing_of_a_transmission_is_said() {
        let refused = |lines: &[&str]| arm(&lines.concat()).unwrap_err();
        let rotor = "rotor = { value = 0.4, unit = \"kg·m^2\" }\n";
        let guessed = "stiffness = { value = 9, unit = \"N·m/rad\", status = \"unknown\" }\n";
        let none = "stiffness = { value = 0, unit = \"N·m/rad\" }\n";
        let nowhere = "[[effect]]\nmechanism = \"viscous\"\njoint = \"elbow.motor\"\ncoefficient = { value = 2, unit = \"N·m·s/rad\" }\n";
        for (lines, said) in [
            (&[MOTOR][..], "`motor` needs `stiffness`"),
            (&[STIFFNESS], "`stiffness` needs `motor` or `torque`"),
            (&[rotor], "`rotor` needs `motor` or `torque`"),
            (&[MOTOR, guessed], "leave `status` out"),
            (&[MOTOR, none], "it must be above 0"),
            (&[nowhere], "`elbow.motor` is no joint of this arm"),
        ] {
            let error = refused(lines);
            assert!(
                error.contains(said) && error.contains("arm.toml"),
                "{error}"
            );
        }
    }
}
