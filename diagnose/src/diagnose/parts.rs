//! This file divides recordings of one rig into a fitted and a held-out part.

use crate::Options;
use crate::align::Fault;
use crate::plant::{Plant, Run};
use crate::rules::MANY_RECORDINGS;

/// The fitted and the held-out part.
pub struct Parts<P: Plant> {
    /// The fitted recordings, joined.
    pub train: P::Run,
    /// The recording on which the result is shown.
    pub test: P::Run,
    /// Time at which its held-out part begins, s after its first sample.
    pub test_from_s: f64,
    /// Whether it is a separate recording.
    pub other_recording: bool,
}

impl<P: Plant> Parts<P> {
    /// The result is shown on `held_out`. Without it, the last of many recordings is held out, or
    /// the end of the last.
    ///
    /// # Errors
    /// The name of the recording that cannot be used, and why.
    pub fn of(
        plant: &P,
        recordings: &[&P::Recording],
        held_out: Option<&P::Recording>,
        options: &Options,
    ) -> Result<Parts<P>, (String, Fault)> {
        let count = recordings.len();
        let mut runs: Vec<P::Run> = Vec::with_capacity(count);
        for (place, recording) in recordings.iter().enumerate() {
            let clocks = runs.iter().map(Run::clock);
            let before_s = clocks.map(|clock| clock.samples as f64 * clock.step_s);
            let run = plant.aligned(recording, before_s.sum());
            runs.push(run.map_err(|fault| (which(place, count), fault))?);
        }
        let other = match held_out {
            Some(recording) => {
                let named = |fault| ("held-out recording".to_owned(), fault);
                Some(plant.aligned(recording, 0.0).map_err(named)?)
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
            (None, Some(last)) => {
                let samples = last.clock().samples;
                let cut = ((1.0 - options.hold_out_share) * samples as f64).round() as usize;
                let before = runs.iter().map(|run| run.clock().samples).sum();
                let (fitted, test, from_s) = P::parted(last, cut, before);
                runs.push(fitted);
                (test, from_s)
            }
            (None, None) => return Err(("recording".to_owned(), nothing())),
        };
        let named = |(place, fault)| (which(place, count), fault);
        Ok(Parts {
            train: P::joined(runs).map_err(named)?,
            test,
            test_from_s,
            other_recording,
        })
    }
}

/// The name of a recording.
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
