//! This file makes a recording of chosen arrays.

use super::Arrays;
use crate::csv::{LEAST_SAMPLES, time_to_s};
use crate::error::TraceError;
use crate::series::{Channel, Trace};
use crate::suggest::quoted;

/// Which arrays make the recording.
#[derive(Clone, Debug, PartialEq)]
pub struct Selection {
    /// The group that every variable stands in, or none.
    pub group: Option<String>,
    /// The variables, each `name` or `name[k]`.
    pub variables: Vec<String>,
    /// Where the time comes from.
    pub time: TimeSource,
    /// The unit of a variable, by the name it has in `variables` or `time`.
    pub units: Vec<(String, String)>,
}

/// Where the time of a recording comes from.
#[derive(Clone, Debug, PartialEq)]
pub enum TimeSource {
    /// A sampling rate, Hz.
    RateHz(f64),
    /// A variable that holds the sampling rate, Hz.
    RateFrom(String),
    /// A variable that holds time stamps, in s unless a unit is given.
    Stamps(String),
}

impl Arrays {
    /// Makes a recording of the chosen arrays.
    ///
    /// # Errors
    /// A variable is missing or has another length than the others, the rate is not above zero, a time stamp does
    /// not grow, or there are fewer than [`LEAST_SAMPLES`] samples.
    pub fn recording(&self, selection: &Selection) -> Result<Trace, TraceError> {
        let refused = |problem: String| TraceError::recording(&self.path, problem);
        let unit = |name: &str| selection.unit(name);
        let mut channels = Vec::new();
        for name in &selection.variables {
            channels.push(Channel {
                name: name.clone(),
                unit: unit(name).to_string(),
                samples: self.column(&selection.path(name))?,
            });
        }
        let Some(first) = channels.first() else {
            let names = quoted(self.entries.iter().map(|entry| entry.name.as_str()));
            return Err(refused(format!(
                "no variable is chosen; the variables are {names}"
            )));
        };
        let samples = first.samples.len();
        let time_s = self.time_s(selection, samples)?;
        let lengths = channels
            .iter()
            .map(|channel| (&channel.name, channel.samples.len()));
        if let Some((name, other)) = lengths.clone().find(|(_, length)| *length != time_s.len()) {
            let stamps = time_s.len();
            return Err(refused(format!(
                "`{name}` has {other} samples and the time {stamps}; choose variables of equal length"
            )));
        }
        if samples < LEAST_SAMPLES {
            return Err(TraceError::TooFewSamples {
                file: self.path.clone(),
                samples,
                least: LEAST_SAMPLES,
            });
        }
        let stands = time_s
            .windows(2)
            .position(|pair| !matches!(pair, [a, b] if b > a));
        if let Some(index) = stands {
            return Err(refused(format!(
                "time does not grow from sample {} to the next; choose another variable for it",
                index + 1
            )));
        }
        Ok(Trace { time_s, channels })
    }

    fn time_s(&self, selection: &Selection, samples: usize) -> Result<Vec<f64>, TraceError> {
        let refused = |problem: String| TraceError::recording(&self.path, problem);
        let rate_hz = match &selection.time {
            TimeSource::RateHz(rate_hz) => *rate_hz,
            TimeSource::RateFrom(name) => match self.column(&selection.path(name))?.as_slice() {
                &[rate_hz] => rate_hz,
                numbers => {
                    let count = numbers.len();
                    return Err(refused(format!(
                        "`{name}` holds {count} numbers; a rate is one"
                    )));
                }
            },
            TimeSource::Stamps(name) => {
                let unit = selection.unit(name);
                let to_s = time_to_s(unit).ok_or_else(|| {
                    refused(format!(
                        "`{unit}`, the unit of `{name}`, is no unit of time"
                    ))
                })?;
                let stamps = self.column(&selection.path(name))?;
                return Ok(stamps.into_iter().map(|stamp| stamp * to_s).collect());
            }
        };
        if !(rate_hz > 0.0 && rate_hz.is_finite()) {
            return Err(refused(format!(
                "the sampling rate is {rate_hz} Hz; it must be above 0"
            )));
        }
        Ok((0..samples).map(|index| index as f64 / rate_hz).collect())
    }
}

impl Selection {
    fn path(&self, name: &str) -> String {
        match &self.group {
            Some(group) => format!("{}/{name}", group.trim_matches('/')),
            None => name.to_string(),
        }
    }

    fn unit(&self, name: &str) -> &str {
        let stated = self.units.iter().find(|(stated, _)| stated == name);
        stated.map_or("", |(_, unit)| unit)
    }
}
