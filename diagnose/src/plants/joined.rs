//! This file puts several recordings of one rig one after another, so that one set of numbers explains them all.

use crate::align::Fault;
use crate::plant::Run;
use crate::rules::SAME_STEP;

/// A run that others of the same rig can follow.
pub(crate) trait Joins: Run + Clone {
    /// Takes the samples of another run after its own. The sample before the seam counts as not recorded: no window lies across it.
    fn append(&mut self, run: &Self);

    /// Keeps the recordings that it was joined from, in which every memory begins anew.
    fn keep_parts(&mut self, parts: Vec<Self>);
}

/// One run of several recordings in their order, its clock going on from each to the next.
///
/// # Errors
/// A recording of another sample interval than the first one's: its place, and what is wrong.
pub(crate) fn joined<R: Joins>(runs: Vec<R>) -> Result<R, (usize, Fault)> {
    let mut own = runs.iter();
    let Some(mut whole) = own.next().cloned() else {
        return Err((0, fault("there is no recording".to_owned())));
    };
    if runs.len() == 1 {
        return Ok(whole);
    }
    let first_s = whole.clock().step_s;
    for (place, run) in own.enumerate() {
        let step_s = run.clock().step_s;
        if (step_s / first_s - 1.0).abs() > SAME_STEP {
            let reason = format!(
                "samples every {step_s} s, the first recording every {first_s} s; several recordings are diagnosed together at one rate"
            );
            return Err((place + 1, fault(reason)));
        }
        whole.append(run);
    }
    whole.keep_parts(runs);
    Ok(whole)
}

fn fault(reason: String) -> Fault {
    Fault {
        channel: "time",
        from_s: 0.0,
        to_s: 0.0,
        reason,
    }
}
