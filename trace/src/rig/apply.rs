//! This file turns a recording into the plant's quantities, as the rig description says.

use std::path::Path;

use rigproof_spec::effect::{Motion, Quantity};
use rigproof_spec::units::{Dimension, Unit};

use super::signals::Recorded;
use super::{ChannelMap, Plant, Rig, Servo};
use crate::csv::{self, Dialect, Hints, Known, Text};
use crate::error::TraceError;
use crate::mcap;
use crate::series::Trace;

/// A recording of a plant, in SI units; every signal is as long as `time_s`, NaN where a sample is missing.
#[derive(Clone, Debug, PartialEq)]
pub struct Recording {
    /// The kind of plant.
    pub plant: Plant,
    /// Whether it slides or turns.
    pub motion: Motion,
    /// Time stamps, s, strictly growing, not always evenly.
    pub time_s: Vec<f64>,
    /// Displacement, m or rad. A static sweep has none, and stands still.
    pub position: Signal,
    /// The steady speed of each row of a static sweep, m/s or rad/s, where it is recorded.
    pub speed: Option<Signal>,
    /// What drives the plant: the command of an axis or a bench in its SI unit, or the current of a bench in A.
    pub drive: Option<Signal>,
    /// Whether the servo is switched on: 1 or 0.
    pub enabled: Option<Signal>,
    /// The servo that drives an axis, with the numbers of this recording: `drive` is then its goal.
    pub servo: Option<Servo>,
    /// Force, N, or torque, N·m, of a bench.
    pub force: Option<Signal>,
    /// What somebody's own simulation gives for it.
    pub simulated: Option<Signal>,
}

/// One quantity of a recording, in SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct Signal {
    /// The channel's name in the recording.
    pub channel: String,
    /// What kind of quantity it is.
    pub dimension: Dimension,
    /// One value for each time stamp; NaN where a sample is missing.
    pub samples: Vec<f64>,
    /// Resolution.
    pub quantum: Option<f64>,
    /// Standard deviation of the noise.
    pub noise: Option<f64>,
    /// Magnitude at which the channel saturates.
    pub limit: Option<f64>,
}

impl Signal {
    /// The position where none is recorded.
    fn nowhere(motion: Motion, samples: usize) -> Signal {
        Signal {
            channel: String::new(),
            dimension: Quantity::Travel.dimension(motion),
            samples: vec![0.0; samples],
            quantum: None,
            noise: None,
            limit: None,
        }
    }

    /// The signal at the samples that are kept.
    pub fn only(&self, kept: &[bool]) -> Signal {
        Signal {
            samples: those(&self.samples, kept),
            ..self.clone()
        }
    }
}

/// The values that are kept.
pub(super) fn those(values: &[f64], kept: &[bool]) -> Vec<f64> {
    let pairs = values.iter().zip(kept);
    pairs.filter(|(_, kept)| **kept).map(|(x, _)| *x).collect()
}

impl Recording {
    /// The recording at the samples that are kept.
    pub fn only(&self, kept: &[bool]) -> Recording {
        let signal = |signal: &Option<Signal>| signal.as_ref().map(|s| s.only(kept));
        Recording {
            time_s: those(&self.time_s, kept),
            position: self.position.only(kept),
            speed: signal(&self.speed),
            drive: signal(&self.drive),
            enabled: signal(&self.enabled),
            force: signal(&self.force),
            simulated: signal(&self.simulated),
            ..*self
        }
    }
}

impl Rig {
    /// Reads a recording of this rig from a text file or an MCAP file, as its content says.
    ///
    /// # Errors
    /// As [`csv::read_text`], [`mcap::read()`] and [`Rig::apply`].
    pub fn read_recording(&self, path: &Path) -> Result<Recording, TraceError> {
        match mcap::is_mcap(path)? {
            true => self.read_mcap(path).map(|(recording, _)| recording),
            false => self
                .read_text(path, &Hints::default())
                .map(|(recording, ..)| recording),
        }
    }

    /// Reads a text recording of this rig whose dialect is partly known, and says in which it was, and what was guessed,
    /// passed over or mended. Columns that the rig does not name are not looked at.
    ///
    /// # Errors
    /// As [`csv::read_text`] and [`Rig::apply`].
    pub fn read_text(
        &self,
        path: &Path,
        hints: &Hints,
    ) -> Result<(Recording, Dialect, Vec<String>), TraceError> {
        let channels = &self.channels;
        let known = Known {
            time: channels.time.as_ref(),
            hints: hints.or(self.text),
            is_sweep: self.is_sweep(),
            ..Known::default()
        };
        read_applied(path, known, &channels.maps(), |t| self.taken(t, path))
    }

    /// Turns a recording into SI quantities; `origin` is the file that messages name.
    ///
    /// # Errors
    /// A channel of the rig is missing, or its unit in the header does not convert to the rig's.
    pub fn apply(&self, trace: &Trace, origin: &Path) -> Result<Recording, TraceError> {
        self.taken(trace.clone(), origin)
    }

    /// The same of a recording that nobody needs afterwards: its numbers are turned where they stand.
    ///
    /// # Errors
    /// As [`Rig::apply`].
    pub fn taken(&self, trace: Trace, origin: &Path) -> Result<Recording, TraceError> {
        let channels = &self.channels;
        let (time_s, mut recorded) = Recorded::of(trace, &channels.maps(), &self.name, origin);
        let mut optional =
            |map: Option<&ChannelMap>| map.map(|own| recorded.signal(own)).transpose();
        let samples = time_s.len();
        let position = optional(channels.position.as_ref())?;
        Ok(Recording {
            plant: self.plant,
            motion: self.motion,
            time_s,
            position: position.unwrap_or_else(|| Signal::nowhere(self.motion, samples)),
            speed: optional(channels.speed.as_ref())?,
            drive: optional(channels.drive())?,
            enabled: optional(channels.enabled.as_ref())?,
            servo: self.servo.map(|servo| servo.of(&self.recordings, origin)),
            force: optional(channels.force.as_ref())?,
            simulated: optional(channels.simulated.as_ref())?,
        })
    }
}

/// Reads the channels of a rig from a text, and says how: where a name suggests another unit than the rig states, too.
fn read_text(
    path: &Path,
    known: Known<'_>,
    maps: &[&ChannelMap],
) -> Result<(Text, Vec<String>), TraceError> {
    let wanted: Vec<&str> = maps.iter().map(|map| map.channel.as_str()).collect();
    let known = Known {
        wanted: Some(&wanted),
        ..known
    };
    let mut text = csv::read_text(path, &known)?;
    let mut remarks = std::mem::take(&mut text.remarks);
    let overruled = text.trace.channels.iter().filter_map(|channel| {
        let map = maps.iter().find(|map| map.channel == channel.name)?;
        let guess = Unit::parse(channel.likely_unit()).filter(|_| channel.unit.is_empty())?;
        let said = Unit::parse(map.column_unit.as_deref().unwrap_or(&map.unit))?;
        let unit = map.column_unit.as_ref().unwrap_or(&map.unit);
        (guess != said).then(|| format!("`{}` in {unit}", channel.name))
    });
    let overruled: Vec<String> = overruled.collect();
    if !overruled.is_empty() {
        remarks.push(format!(
            "units as the rig file states them, and not as the names end: {}",
            overruled.join(", ")
        ));
    }
    Ok((text, remarks))
}

/// Reads a text and applies a description to it: the recording, how the text was read, and what is to be said of it.
pub(super) fn read_applied<T>(
    path: &Path,
    known: Known<'_>,
    maps: &[&ChannelMap],
    apply: impl Fn(Trace) -> Result<T, TraceError>,
) -> Result<(T, Dialect, Vec<String>), TraceError> {
    let (text, remarks) = read_text(path, known, maps)?;
    let applied = apply(text.trace);
    let applied = applied.map_err(|error| with_all_columns(path, known, error, &apply))?;
    Ok((applied, text.dialect, remarks))
}

/// What is wrong with a recording, told with the columns that were passed over: one of them may be the channel that is missing.
fn with_all_columns<T>(
    path: &Path,
    known: Known<'_>,
    error: TraceError,
    apply: impl Fn(Trace) -> Result<T, TraceError>,
) -> TraceError {
    let all = csv::read_text(path, &known).ok();
    all.and_then(|all| apply(all.trace).err()).unwrap_or(error)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::series::Channel;

    const RIG: &str = r#"
        name = "slide"
        plant = "axis"
        motion = "linear"
        [channels]
        position = { channel = "x", unit = "mm", offset = 2.5, scale = 3, sign = -1, quantum = 0.5, limit = 40 }
        command = { channel = "u", unit = "V" }
        [parameters]
        inertia = { value = 1.7, unit = "kg" }
        command_gain = { value = 35.5, unit = "N/V" }
    "#;

    fn apply(channels: &[(&str, &str)]) -> Result<Recording, String> {
        let rig = Rig::parse(RIG, Path::new("rig.toml")).unwrap();
        rig.apply(&trace(channels), Path::new("run.csv"))
            .map_err(|error| error.to_string())
    }

    fn trace(channels: &[(&str, &str)]) -> Trace {
        let channels = channels.iter().map(|(name, unit)| Channel {
            name: name.to_string(),
            unit: unit.to_string(),
            samples: vec![4.5, f64::NAN],
        });
        Trace {
            time_s: vec![0.1, 0.3],
            channels: channels.collect(),
        }
    }

    #[test]
    fn offset_scale_sign_and_unit_apply_in_this_order() {
        let recording = apply(&[("u", ""), ("x", "")]).unwrap();
        let x = &recording.position;
        assert!((x.samples[0] + 3.0 * 2.0e-3).abs() < 1e-18);
        assert!(x.samples[1].is_nan());
        assert!((x.quantum.unwrap() - 1.5e-3).abs() < 1e-18);
        assert!((x.limit.unwrap() - 0.12).abs() < 1e-15);
        assert_eq!(recording.drive.unwrap().samples[0], 4.5);
        assert_eq!(recording.force, None);
    }

    #[test]
    fn a_unit_that_only_a_name_suggests_gives_way_to_the_rig() {
        let rig = |name: &str, unit: &str| {
            let text = RIG.replace(
                "\"x\", unit = \"mm\"",
                &format!("\"{name}\", unit = \"{unit}\""),
            );
            Rig::parse(&text, Path::new("rig.toml")).unwrap()
        };
        for (name, unit) in [
            ("theta_A", "mm"),
            ("slide_V", "mm"),
            ("x_m", "mm"),
            ("x_s", "cm"),
        ] {
            let text = format!("t,{name},u\n")
                + &(0..20)
                    .map(|k| format!("{k},{k}.5,0.1\n"))
                    .collect::<String>();
            let trace = csv::parse(text.as_bytes(), Path::new("run.csv"), None).unwrap();
            let recording = rig(name, unit).apply(&trace, Path::new("run.csv")).unwrap();
            let si = Unit::parse(unit).unwrap().to_si;
            let expected = -3.0 * si * (7.5 - 2.5);
            assert!(
                (recording.position.samples[7] - expected).abs() < 1e-15,
                "{name}"
            );
        }
    }

    #[test]
    fn a_header_that_disagrees_is_a_question_and_the_answer_holds() {
        let message = apply(&[("u", "V"), ("x", "cm")]).unwrap_err();
        for part in [
            "`x` is in `cm`",
            "`slide` says `mm`",
            "between 4.5 and 4.5",
            "`--unit x=cm`",
            "column_unit = \"cm\"",
        ] {
            assert!(message.contains(part), "{message} lacks {part}");
        }
        let with = |unit: &str| {
            let text = RIG.replace(
                "unit = \"mm\"",
                &format!("unit = \"mm\", column_unit = \"{unit}\""),
            );
            let rig = Rig::parse(&text, Path::new("rig.toml"))?;
            rig.apply(&trace(&[("u", "V"), ("x", "cm")]), Path::new("run.csv"))
        };
        for (unit, x_mm) in [("cm", 45.0), ("mm", 4.5), ("m", 4500.0)] {
            let read = with(unit).unwrap().position.samples[0];
            assert!(
                (read + 3.0 * (x_mm - 2.5) * 1e-3).abs() < 1e-14,
                "{unit} {read}"
            );
        }
        assert!(
            with("deg")
                .unwrap_err()
                .to_string()
                .contains("does not convert to `mm`")
        );
        assert!(apply(&[("u", "volt"), ("x", "mm")]).is_err());
    }

    #[test]
    fn counts_with_a_stated_scale_are_no_question() {
        assert!(apply(&[("u", "V"), ("x", "counts")]).is_ok());
        let message = apply(&[("u", "volts dc"), ("x", "mm")]).unwrap_err();
        assert!(
            message.contains("no known unit; if the rig is right, add `--unit u=V`"),
            "{message}"
        );
    }

    #[test]
    fn a_recording_that_does_not_suit_the_rig_is_refused() {
        for (channels, expected) in [
            (
                [("u", "V"), ("x", "deg")],
                "`x` is in `deg`, the rig `slide` says `mm`, which does not convert",
            ),
            (
                [("u", "furlong"), ("x", "mm")],
                "`u` is in `furlong`, the rig `slide` says `V`, and the header's is no known unit",
            ),
            (
                [("U", "V"), ("x", "mm")],
                "`u` of the rig `slide` is missing",
            ),
            (
                [("U", "V"), ("x", "mm")],
                "did you mean `U`? the channels of the recording are `U`, `x`",
            ),
        ] {
            let message = apply(&channels).unwrap_err();
            assert!(
                message.starts_with("run.csv: ") && message.contains(expected),
                "{message}"
            );
        }
    }
}
