//! This file parts recordings of a five-bar into what is fitted and what shows the result.

use super::joined::joined;
use super::run::FiveBarRun;
use super::undone::described;
use crate::Options;
use crate::align::Fault;
use crate::rules::MANY_RECORDINGS;
use rigproof_trace::rig::five_bar::{FiveBar, FiveBarRecording};

/// What is fitted, and what shows the result.
pub struct Parts {
    /// The fitted recordings, one after another.
    pub train: FiveBarRun,
    /// The recording that shows the result.
    pub test: FiveBarRun,
    /// Where its held-out part begins, s after its first sample.
    pub test_from_s: f64,
    /// Whether it is a recording of its own.
    pub other_recording: bool,
}

impl Parts {
    /// Recordings of which another one shows the result, or the last of many, or the end of the last.
    ///
    /// # Errors
    /// What the recording is called that cannot be used, and why.
    pub fn of(
        rig: &FiveBar,
        recordings: &[&FiveBarRecording],
        held_out: Option<&FiveBarRecording>,
        options: &Options,
    ) -> Result<Parts, (String, Fault)> {
        let count = recordings.len();
        let mut runs = Vec::with_capacity(count);
        for (place, recording) in recordings.iter().enumerate() {
            let lengths_s = runs
                .iter()
                .map(|run: &FiveBarRun| run.len() as f64 * run.step_s);
            let before_s = lengths_s.sum();
            let run = described(rig, recording, before_s);
            runs.push(run.map_err(|fault| (which(place, count), fault))?);
        }
        let other = match held_out {
            Some(recording) => {
                let named = |fault| ("held-out recording".to_owned(), fault);
                Some(described(rig, recording, 0.0).map_err(named)?)
            }
            None if count >= MANY_RECORDINGS => runs.pop(),
            None => None,
        };
        let other_recording = other.is_some();
        let (test, test_from_s) = match (other, runs.pop()) {
            (Some(test), last) => {
                runs.extend(last);
                (test, 0.0)
            }
            (None, Some(mut last)) => {
                // What is held out of the same recording keeps its past: brakes, heat and memories begin at its first sample.
                let cut = ((1.0 - options.hold_out_share) * last.len() as f64).round() as usize;
                let before = runs.iter().map(FiveBarRun::len).sum::<usize>();
                runs.push(last.slice(0, cut));
                // An onset is a time on the clock of all of them.
                last.start_s += before as f64 * last.step_s;
                let from_s = cut as f64 * last.step_s;
                (last, from_s)
            }
            (None, None) => return Err(("recording".to_owned(), nothing())),
        };
        let named = |(place, fault)| (which(place, count), fault);
        Ok(Parts {
            train: joined(runs).map_err(named)?,
            test,
            test_from_s,
            other_recording,
        })
    }
}

/// What a recording is called.
fn which(place: usize, of: usize) -> String {
    match of {
        1 => "recording".to_owned(),
        _ => format!("recording {} of {of}", place + 1),
    }
}

fn nothing() -> Fault {
    Fault {
        channel: "time",
        from_s: 0.0,
        to_s: 0.0,
        reason: "there is no recording".to_owned(),
    }
}
