//! This file finds a rig's channels in the messages of an MCAP file.

use std::path::Path;

use super::chain::{ChainRecording, ChainRig};
use super::five_bar::{FiveBar, FiveBarRecording};
use super::{ChannelMap, Recording, Rig, TimeColumn};
use crate::error::TraceError;
use crate::mcap::{self, Between, Selection, Wanted};

impl Rig {
    /// Reads a recording of this rig from an MCAP file, and says how: check sums, what is missing, which times, what was
    /// resampled.
    ///
    /// The time is the position's. What is measured goes in straight lines between its samples; a command holds until
    /// the next one.
    ///
    /// # Errors
    /// As [`mcap::read()`] and [`Rig::apply`].
    pub fn read_mcap(&self, path: &Path) -> Result<(Recording, Vec<String>), TraceError> {
        let reading = mcap::read(path, &self.selection())?;
        let mut lines = reading.integrity.lines();
        lines.extend(reading.protocol);
        Ok((self.taken(reading.trace, path)?, lines))
    }

    fn selection(&self) -> Selection {
        let channels = &self.channels;
        let measured = [
            &channels.position,
            &channels.force,
            &channels.current,
            &channels.simulated,
        ];
        let measured = measured.into_iter().flatten();
        let commands = channels.command.iter().chain(&channels.enabled);
        selected(measured, commands, &channels.time)
    }
}

impl FiveBar {
    /// Reads a recording of this rig from an MCAP file, and says how: check sums, what is missing, which times, what was
    /// resampled.
    ///
    /// The time is that of θA. What is measured goes in straight lines between its samples; a current holds until the next one.
    ///
    /// # Errors
    /// As [`mcap::read()`] and [`FiveBar::apply`].
    pub fn read_mcap(&self, path: &Path) -> Result<(FiveBarRecording, Vec<String>), TraceError> {
        let channels = &self.channels;
        let measured = channels.theta.iter().chain(&channels.force);
        let currents = channels.currents.iter().flatten();
        let reading = mcap::read(path, &selected(measured, currents, &channels.time))?;
        let mut lines = reading.integrity.lines();
        lines.extend(reading.protocol);
        Ok((self.taken(reading.trace, path)?, lines))
    }
}

impl ChainRig {
    /// Reads a recording of this arm from an MCAP file, and says how. The time is that of the first joint's position.
    ///
    /// # Errors
    /// As [`mcap::read()`] and [`ChainRig::apply`].
    pub fn read_mcap(&self, path: &Path) -> Result<(ChainRecording, Vec<String>), TraceError> {
        let selection = selected(self.maps().into_iter(), [].into_iter(), &self.time);
        let reading = mcap::read(path, &selection)?;
        let mut lines = reading.integrity.lines();
        lines.extend(reading.protocol);
        Ok((self.taken(reading.trace, path)?, lines))
    }
}

/// What is wanted of a file: what was measured, the first of it with its times, and what was commanded.
fn selected<'a>(
    measured: impl Iterator<Item = &'a ChannelMap>,
    commanded: impl Iterator<Item = &'a ChannelMap>,
    time: &Option<TimeColumn>,
) -> Selection {
    let measured = measured.map(|map| (map, Between::Line));
    let commanded = commanded.map(|map| (map, Between::Held));
    let wanted = measured.chain(commanded).map(|(map, between)| Wanted {
        address: map.channel.clone(),
        between,
    });
    Selection {
        channels: wanted.collect(),
        time: time.clone(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::series::{Channel, Trace};

    const RIG: &str = r#"
        name = "slide"
        plant = "axis"
        motion = "rotary"
        [channels]
        position = { channel = "POSITION", unit = "deg" }
        command = { channel = "u", unit = "V" }
        [parameters]
        inertia = { value = 1.7, unit = "kg·m^2" }
        command_gain = { value = 35.5, unit = "N·m/V" }
    "#;

    fn read(position: &str) -> Result<(Recording, Vec<String>), TraceError> {
        let channel = |name: &str, unit: &str, factor: f64| Channel {
            name: name.into(),
            unit: unit.into(),
            samples: (0..30)
                .map(|k| factor * (1.3 + 0.7 * f64::from(k)))
                .collect(),
        };
        let trace = Trace {
            time_s: (0..30).map(|k| 0.2 + 0.004 * f64::from(k)).collect(),
            channels: vec![channel("elbow", "deg", 0.9), channel("u", "V", 0.01)],
        };
        let folder = tempfile::tempdir().unwrap();
        // The content decides, not the name.
        let path = folder.path().join("run.csv");
        mcap::write(&path, &trace, &mcap::Extras::default()).unwrap();
        let text = RIG.replace("POSITION", position);
        let rig = Rig::parse(&text, Path::new("rig.toml")).unwrap();
        let (recording, lines) = rig.read_mcap(&path)?;
        assert_eq!(rig.read_recording(&path).unwrap(), recording);
        Ok((recording, lines))
    }

    #[test]
    fn a_rig_finds_its_channels_by_name_and_by_address() {
        let (by_name, lines) = read("elbow").unwrap();
        assert_eq!(by_name.time_s[7], 0.2 + 0.004 * 7.0);
        assert_eq!(
            lines[0],
            "check sums: chunks verified, data verified, summary verified"
        );
        let (by_address, lines) = read("/rigproof/run.elbow_deg").unwrap();
        assert_eq!(by_name.position.samples, by_address.position.samples);
        assert_eq!(by_name.drive, by_address.drive);
        assert!(lines[1].contains("time of `/rigproof/run`"), "{lines:?}");
    }

    #[test]
    fn a_channel_that_is_not_there_is_named_with_what_is() {
        let message = |position: &str| read(position).unwrap_err().to_string();
        let of_topic = message("/joint_states.positions[name=elbow]");
        assert!(
            of_topic.contains("in no message of `/joint_states`; did you mean `/joint_states.position[name=elbow]`?"),
            "{of_topic}"
        );
        let of_none = message("/joint_state.position[0]");
        assert!(
            of_none.contains("did you mean `/joint_states`?"),
            "{of_none}"
        );
    }

    #[test]
    fn a_five_bar_is_read_as_its_text_is() {
        let text = "name = \"rig\"\nplant = \"rig\"\nlayout = \"three_brake\"\n[channels]\n\
            theta_a = { channel = \"qa\", unit = \"deg\" }\ntheta_b = { channel = \"qb\", unit = \"deg\" }\n\
            force_x = { channel = \"fx\", unit = \"N\" }\nforce_y = { channel = \"fy\", unit = \"N\" }\n\
            current_a = { channel = \"ia\", unit = \"A\" }\ncurrent_e = { channel = \"ie\", unit = \"A\" }\n\
            current_b = { channel = \"ib\", unit = \"A\" }\n";
        let rig = FiveBar::parse(text, Path::new("rig.toml")).unwrap();
        let channel = |(name, unit, start): (&str, &str, f64)| Channel {
            name: name.into(),
            unit: unit.into(),
            samples: (0..30).map(|k| start + 0.037 * f64::from(k)).collect(),
        };
        let channels = [
            ("qa", "deg", 141.3),
            ("qb", "deg", 41.7),
            ("fx", "N", -1.3),
            ("fy", "N", 2.1),
            ("ia", "A", 0.13),
            ("ie", "A", 0.0),
            ("ib", "A", 0.31),
        ];
        let trace = Trace {
            time_s: (0..30).map(|k| 0.2 + 0.001 * f64::from(k)).collect(),
            channels: channels.map(channel).into(),
        };
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("run");
        mcap::write(&path, &trace, &mcap::Extras::default()).unwrap();
        let (recording, lines) = rig.read_mcap(&path).unwrap();
        assert_eq!(recording, rig.apply(&trace, &path).unwrap());
        assert!(lines[0].starts_with("check sums"), "{lines:?}");
    }
}
