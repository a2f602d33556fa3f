//! This file joins several recordings of one rig into one run, so that one set of parameters is
//! fitted to all of them.

use crate::align::Fault;
use crate::plant::Run;
use crate::rules::SAME_STEP;

/// A run to which further recordings of the same rig can be appended.
pub(crate) trait Joins: Run + Clone {
    /// Appends the samples of another run. The sample before the seam is marked as not recorded, so
    /// that no window spans the seam.
    fn append(&mut self, run: &Self);

    /// Keeps the separate recordings. The memory of every law starts anew in each.
    fn keep_parts(&mut self, parts: Vec<Self>);
}

/// Joins recordings in their order into one run with a continuous clock.
///
/// # Errors
/// A recording has another sample interval than the first: its position, and the fault.
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
