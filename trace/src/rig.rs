//! This file is the rig description: the plant, its parameters, the physics its nominal model has, and what the
//! channels of its recordings mean.
//!
//! A calibration file is the same description with the effects that a diagnosis added.

mod apply;
mod brake;
pub mod chain;
mod characteristic;
mod column_unit;
pub mod five_bar;
pub mod linkage;
mod messages;
mod plausible;
mod protocol;
mod read;
pub mod schema;
mod servo;
mod signals;
pub mod table;
mod text;
pub mod transmission;
mod write;

use std::collections::BTreeMap;
use std::path::Path;

use rigproof_spec::effect::{Mechanism, Motion, Parameter, Quantity};
use rigproof_spec::units::{Dimension, Unit};

use crate::csv::{Hints, TimeColumn};
use crate::error::TraceError;
use crate::store;
use crate::suggest::advice;

pub use apply::{Recording, Signal};
pub use brake::{Brake, Gain, Surface};
pub use characteristic::Characteristic;
pub use protocol::{Drive, Protocol};
pub use servo::{RecordingEntry, Servo};

/// The first line of a description that is written: where an editor finds what may stand in it, beside the file.
pub const SCHEMA_LINE: &str = "#:schema rig.schema.json";

/// Every word for a plant in a description.
const PLANTS: [&str; 4] = ["axis", "bench", "rig", "chain"];

/// What stands in a description that was begun for somebody, wherever something is to be filled in.
pub const FILL_IN: &str = "fill in";

/// A rig: what it is, what is known of it, and how its recordings are to be read.
#[derive(Clone, Debug, PartialEq)]
pub struct Rig {
    /// What people call it.
    pub name: String,
    /// What kind of plant it is.
    pub plant: Plant,
    /// Whether it slides or turns.
    pub motion: Motion,
    /// Where its recordings come from, in free words.
    pub source: Option<String>,
    /// What the channels of its recordings mean.
    pub channels: Channels,
    /// How its recordings are written down, where that cannot be seen in them.
    pub text: Hints,
    /// Parameters of an `axis`; a `bench` has none.
    pub parameters: Option<Parameters>,
    /// The brake that the nominal model holds; only on a turning `bench`.
    pub brake: Option<Brake>,
    /// The brake or damper of a `bench` by its static characteristic.
    pub characteristic: Option<Characteristic>,
    /// The position servo that drives an `axis`: its command is a goal.
    pub servo: Option<Servo>,
    /// What single recordings state of their own.
    pub recordings: Vec<RecordingEntry>,
    /// The physics that the nominal model has.
    pub effects: Vec<RigEffect>,
    /// How free runs are made.
    pub protocol: Protocol,
    /// Where a calibration came from: words of the program that wrote it, by topic.
    pub provenance: BTreeMap<String, String>,
}

/// A kind of plant.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Plant {
    /// One driven joint: command in, position out.
    Axis,
    /// One metered brake or damper: position in, force or torque out.
    Bench,
}

impl Plant {
    /// The name in files and reports.
    pub const fn name(self) -> &'static str {
        match self {
            Plant::Axis => "axis",
            Plant::Bench => "bench",
        }
    }
}

/// The name of a kind of motion in files and reports.
pub const fn motion_name(motion: Motion) -> &'static str {
    match motion {
        Motion::Linear => "linear",
        Motion::Rotary => "rotary",
    }
}

/// The channels of a rig's recordings, by role.
#[derive(Clone, Debug, PartialEq)]
pub struct Channels {
    /// The time, where the header of a recording does not say it.
    pub time: Option<TimeColumn>,
    /// Displacement, m or rad. A static sweep has none.
    pub position: Option<ChannelMap>,
    /// The steady speed of each row of a static sweep, m/s or rad/s.
    pub speed: Option<ChannelMap>,
    /// Command of the drive of an `axis` or of the brake of a `bench`, in any unit.
    pub command: Option<ChannelMap>,
    /// Whether the servo of an `axis` is switched on: 1 or 0; on throughout where it is not recorded.
    pub enabled: Option<ChannelMap>,
    /// Force or torque of a `bench`, N or N·m.
    pub force: Option<ChannelMap>,
    /// Current of a `bench`, A.
    pub current: Option<ChannelMap>,
    /// What somebody's own simulation gives for the force or torque of a `bench`, N or N·m.
    pub simulated: Option<ChannelMap>,
}

impl Channels {
    /// What drives the plant: a command, or the current of a bench.
    pub(crate) fn drive(&self) -> Option<&ChannelMap> {
        self.command.as_ref().or(self.current.as_ref())
    }

    /// What drives a brake: the dimension of the command of a bench; a current where it has none.
    pub(crate) fn driving(&self, plant: Plant) -> Dimension {
        let command = self.command.as_ref().filter(|_| plant == Plant::Bench);
        command.map_or(Dimension::CURRENT, ChannelMap::dimension)
    }

    /// Every channel that is named.
    pub(crate) fn maps(&self) -> Vec<&ChannelMap> {
        let optional = [
            &self.position,
            &self.speed,
            &self.command,
            &self.enabled,
            &self.force,
            &self.current,
            &self.simulated,
        ];
        optional.into_iter().flatten().collect()
    }
}

/// How one channel becomes an SI quantity: sign × scale × (recorded − offset).
#[derive(Clone, Debug, PartialEq)]
pub struct ChannelMap {
    /// The name in the recording.
    pub channel: String,
    /// The unit as printed, in which the numbers of this map are. The column is in it too, unless `column_unit` says otherwise;
    /// a header that states another one is refused.
    pub unit: String,
    /// The unit that the column is in, whatever its header says.
    pub column_unit: Option<String>,
    /// What is subtracted, in `unit`.
    pub offset: f64,
    /// Factor after the offset is gone.
    pub scale: f64,
    /// +1, or −1 for a channel that counts the other way.
    pub sign: f64,
    /// Resolution, in `unit`.
    pub quantum: Option<f64>,
    /// Standard deviation of the noise, in `unit`.
    pub noise: Option<f64>,
    /// Magnitude at which the channel saturates, in `unit`.
    pub limit: Option<f64>,
}

impl ChannelMap {
    /// A channel in a unit, taken as it is.
    pub fn plain(channel: &str, unit: &str) -> ChannelMap {
        ChannelMap {
            channel: channel.to_string(),
            unit: unit.to_string(),
            column_unit: None,
            offset: 0.0,
            scale: 1.0,
            sign: 1.0,
            quantum: None,
            noise: None,
            limit: None,
        }
    }

    /// The unit's dimension; a plain number when the unit is not known.
    pub fn dimension(&self) -> Dimension {
        Unit::parse(&self.unit).map_or(Dimension::NUMBER, |unit| unit.dimension)
    }
}

/// Parameters of an `axis`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameters {
    /// Mass, kg, or moment of inertia, kg·m²/rad.
    pub inertia: Value,
    /// Force or torque for one SI unit of the command.
    pub command_gain: Value,
}

/// How well a value is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Status {
    /// Not to be changed by a fit.
    Known,
    /// Known up to a standard deviation.
    Uncertain,
    /// A start value for a fit.
    Unknown,
}

impl Status {
    /// The name in files.
    pub const fn name(self) -> &'static str {
        match self {
            Status::Known => "known",
            Status::Uncertain => "uncertain",
            Status::Unknown => "unknown",
        }
    }
}

/// A number in SI units and how well it is known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Value {
    /// The number.
    pub value: f64,
    /// How well it is known.
    pub status: Status,
    /// Standard deviation, given exactly when the status is [`Status::Uncertain`].
    pub sd: Option<f64>,
    /// Lower end of the 95 % interval; given together with the upper one.
    pub low95: Option<f64>,
    /// Upper end of the 95 % interval.
    pub high95: Option<f64>,
}

impl Value {
    /// A value that a fit leaves alone.
    pub const fn known(value: f64) -> Value {
        Value::new(value, Status::Known)
    }

    /// A start value for a fit.
    pub const fn unknown(value: f64) -> Value {
        Value::new(value, Status::Unknown)
    }

    const fn new(value: f64, status: Status) -> Value {
        Value {
            value,
            status,
            sd: None,
            low95: None,
            high95: None,
        }
    }
}

/// A mechanism with its parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct RigEffect {
    /// The mechanism.
    pub mechanism: Mechanism,
    /// One value for each of [`Mechanism::parameters`], in that order.
    pub values: Vec<Value>,
    /// When it sets in, s; from the start when absent.
    pub onset: Option<Value>,
    /// Whether its efforts are shares of the torque of the brake at its place.
    pub of_torque: bool,
}

/// The dimension of a parameter, as an effort or as a share of a torque, on a plant of which this drives the brakes.
fn dimension(
    parameter: &Parameter,
    motion: Motion,
    of_torque: bool,
    driving: Dimension,
) -> Dimension {
    match of_torque {
        true => parameter.quantity.dimension_of_share(motion),
        false => parameter.quantity.driven(motion, driving),
    }
}

impl RigEffect {
    /// The dimension of one of its parameters, on a plant that slides or turns and whose brakes this drives.
    pub fn driven(&self, parameter: &Parameter, motion: Motion, driving: Dimension) -> Dimension {
        dimension(parameter, motion, self.of_torque, driving)
    }

    /// The value of the parameter of that name, or `None`.
    pub fn parameter(&self, name: &str) -> Option<&Value> {
        let parameters = self.mechanism.parameters().iter();
        let mut named = parameters.zip(&self.values);
        named
            .find(|(parameter, _)| parameter.name == name)
            .map(|(_, value)| value)
    }
}

impl Rig {
    /// Reads a rig description from a TOML file.
    ///
    /// # Errors
    /// The file cannot be read, or as [`Rig::parse`].
    pub fn read(path: &Path) -> Result<Rig, TraceError> {
        Rig::parse(&store::read_text(path)?, path)
    }

    /// The description with the units that some columns are said to be in, whatever their headers say.
    ///
    /// # Errors
    /// Names a channel that the rig does not have, and those it has.
    pub fn with_column_units(&self, units: &[(String, String)]) -> Result<Rig, String> {
        let mut rig = self.clone();
        let channels = &mut rig.channels;
        let optional = [
            &mut channels.position,
            &mut channels.speed,
            &mut channels.command,
            &mut channels.enabled,
            &mut channels.force,
            &mut channels.current,
            &mut channels.simulated,
        ];
        let maps = optional.into_iter().flatten();
        state_units(maps, &self.name, units)?;
        Ok(rig)
    }

    /// Writes the description as a TOML file, whole or not at all.
    ///
    /// # Errors
    /// The system refuses.
    pub fn write(&self, path: &Path) -> Result<(), TraceError> {
        store::write_aside(path, self.to_toml().as_bytes())
    }

    /// Whether its recordings are static sweeps: settled rows without a time.
    pub fn is_sweep(&self) -> bool {
        self.plant == Plant::Bench && self.protocol.drive == Drive::Static
    }

    /// The dimension of force or torque, whichever the rig has.
    pub fn effort(&self) -> Dimension {
        Quantity::Effort.dimension(self.motion)
    }

    /// What drives a brake: the dimension of its command; a current where it has none.
    pub fn driving(&self) -> Dimension {
        self.channels.driving(self.plant)
    }

    /// The dimension of the command gain, when the rig has a command.
    pub fn command_gain_dimension(&self) -> Option<Dimension> {
        let command = self.channels.command.as_ref()?;
        // A servo makes a voltage of its goal.
        let dimension = match self.servo {
            Some(_) => Dimension::VOLTAGE,
            None => command.dimension(),
        };
        Some(self.effort().per(dimension))
    }
}

/// States the units of columns.
fn state_units<'a>(
    maps: impl Iterator<Item = &'a mut ChannelMap>,
    rig: &str,
    units: &[(String, String)],
) -> Result<(), String> {
    let mut maps: Vec<&mut ChannelMap> = maps.collect();
    for (name, unit) in units {
        let mut of_name = maps
            .iter_mut()
            .filter(|map| map.channel == *name)
            .peekable();
        if of_name.peek().is_none() {
            let names: Vec<&str> = maps.iter().map(|map| map.channel.as_str()).collect();
            let advice = advice(name, "channels of the rig", &names);
            return Err(format!(
                "`{name}` of --unit is no channel of the rig `{rig}`; {advice}"
            ));
        }
        for map in of_name {
            map.column_unit = Some(unit.clone());
        }
    }
    Ok(())
}
