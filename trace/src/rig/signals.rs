//! This file takes channels out of a recording, one at a time, and turns them into signals in SI units: in place, so that no sample
//! stands in memory twice.

use std::path::Path;

use rigproof_spec::units::Unit;

use super::column_unit::column_unit;
use super::{ChannelMap, Signal, plausible};
use crate::error::TraceError;
use crate::series::{Channel, Trace};
use crate::suggest::advice;

/// A recording whose channels become signals.
pub(super) struct Recorded<'a> {
    channels: Vec<Channel>,
    /// The channels that are still to be taken, one for each signal.
    wanted: Vec<&'a str>,
    /// The name of the description.
    rig: &'a str,
    /// The file that messages name.
    origin: &'a Path,
}

impl<'a> Recorded<'a> {
    /// The time stamps of a recording, and what signals are made of it as these maps say; what none of them names is given up.
    pub(super) fn of(
        trace: Trace,
        maps: &[&'a ChannelMap],
        rig: &'a str,
        origin: &'a Path,
    ) -> (Vec<f64>, Recorded<'a>) {
        let Trace {
            time_s,
            mut channels,
        } = trace;
        let wanted: Vec<&str> = maps.iter().map(|map| map.channel.as_str()).collect();
        for own in &mut channels {
            if !wanted.contains(&own.name.as_str()) {
                own.samples = Vec::new();
            }
        }
        let recorded = Recorded {
            channels,
            wanted,
            rig,
            origin,
        };
        (time_s, recorded)
    }

    /// The samples of a channel as the recording has them; a copy where another signal is made of the same channel.
    fn samples(&mut self, index: usize, name: &str) -> Vec<f64> {
        if let Some(at) = self.wanted.iter().position(|own| *own == name) {
            self.wanted.swap_remove(at);
        }
        let is_wanted_again = self.wanted.contains(&name);
        match self.channels.get_mut(index) {
            Some(channel) if is_wanted_again => channel.samples.clone(),
            Some(channel) => std::mem::take(&mut channel.samples),
            None => Vec::new(),
        }
    }

    /// One channel in SI units.
    pub(super) fn signal(&mut self, map: &ChannelMap) -> Result<Signal, TraceError> {
        let (rig, origin) = (self.rig, self.origin);
        let refused = |problem: String| TraceError::recording(origin, problem);
        let name = map.channel.as_str();
        let mut channels = self.channels.iter().enumerate();
        let Some((index, channel)) = channels.find(|(_, own)| own.name == name) else {
            let names: Vec<&str> = self.channels.iter().map(|c| c.name.as_str()).collect();
            let advice = advice(name, "channels of the recording", &names);
            return Err(refused(format!(
                "the channel `{name}` of the rig `{rig}` is missing: correct the rig file, or it is the recording of another plant; {advice}"
            )));
        };
        let rig_unit = Unit::parse(&map.unit).ok_or_else(|| {
            refused(format!(
                "`{}`, the unit of `{name}` in the rig, is no known unit",
                map.unit
            ))
        })?;
        let column_unit = column_unit(map, rig_unit, rig, channel).map_err(refused)?;
        let to_rig_unit = column_unit.to_si / rig_unit.to_si;
        let mut samples = self.samples(index, name);
        samples.iter_mut().for_each(|x| *x *= to_rig_unit);
        if let Some(problem) = plausible::contradiction(map, &samples) {
            return Err(refused(problem));
        }
        let to_si = map.sign * map.scale * rig_unit.to_si;
        let in_si = |magnitude: Option<f64>| magnitude.map(|x| x * to_si.abs());
        samples
            .iter_mut()
            .for_each(|recorded| *recorded = to_si * (*recorded - map.offset));
        Ok(Signal {
            channel: name.to_string(),
            dimension: rig_unit.dimension,
            samples,
            quantum: in_si(map.quantum),
            noise: in_si(map.noise),
            limit: in_si(map.limit),
        })
    }
}

/// A signal in SI units as the channel has it in its file: what [`signal`] makes of it is the signal.
pub(super) fn printed(
    map: &ChannelMap,
    samples: &[f64],
    origin: &Path,
) -> Result<Channel, TraceError> {
    let unit = Unit::parse(&map.unit).ok_or_else(|| {
        let problem = format!(
            "`{}`, the unit of `{}` in the rig, is no known unit",
            map.unit, map.channel
        );
        TraceError::recording(origin, problem)
    })?;
    let to_si = map.sign * map.scale * unit.to_si;
    Ok(Channel {
        name: map.channel.clone(),
        unit: map.unit.clone(),
        samples: samples.iter().map(|x| x / to_si + map.offset).collect(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const ORIGIN: &str = "run.csv";

    fn map(channel: &str) -> ChannelMap {
        ChannelMap {
            offset: 2.5,
            scale: 3.0,
            sign: -1.0,
            ..ChannelMap::plain(channel, "mm")
        }
    }

    fn channel(name: &str, samples: [f64; 2]) -> Channel {
        Channel {
            name: name.to_owned(),
            unit: String::new(),
            samples: samples.to_vec(),
        }
    }

    #[test]
    fn what_is_printed_reads_back() {
        let (map, own) = (map("x"), [0.0173, -0.0044]);
        let trace = Trace {
            time_s: vec![0.1, 0.3],
            channels: vec![printed(&map, &own, Path::new(ORIGIN)).unwrap()],
        };
        let (_, mut recorded) = Recorded::of(trace, &[&map], "slide", Path::new(ORIGIN));
        let read = recorded.signal(&map).unwrap();
        for (read, own) in read.samples.iter().zip(own) {
            assert!((read - own).abs() < 1e-17, "{read} {own}");
        }
    }

    #[test]
    fn a_channel_of_two_signals_is_there_for_both_and_one_of_none_is_given_up() {
        let (plain, turned) = (ChannelMap::plain("x", "mm"), map("x"));
        let trace = Trace {
            time_s: vec![0.1, 0.3],
            channels: vec![channel("note", [7.5, 8.5]), channel("x", [4.5, 5.5])],
        };
        let maps = [&plain, &turned];
        let (time_s, mut recorded) = Recorded::of(trace, &maps, "slide", Path::new(ORIGIN));
        assert_eq!(time_s, [0.1, 0.3]);
        assert!(recorded.channels[0].samples.is_empty());
        let plain = recorded.signal(&plain).unwrap().samples;
        assert!((plain[1] - 5.5e-3).abs() < 1e-15, "{plain:?}");
        let turned = recorded.signal(&turned).unwrap().samples;
        assert!((turned[1] + 9.0e-3).abs() < 1e-15, "{turned:?}");
        let missing = recorded.signal(&map("y")).unwrap_err().to_string();
        assert!(
            missing.contains("`y`") && missing.contains("note"),
            "{missing}"
        );
    }
}
