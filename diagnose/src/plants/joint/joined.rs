//! This file puts several recordings of one axis or bench one after another, so that one set of numbers explains them all.

use super::run::JointRun;
use crate::align::Fault;
use crate::plant::Columns;
use crate::rules::SAME_STEP;
use core::ops::Range;

/// One run of several recordings in their order, its clock going on from each to the next. No window lies across a seam, and every memory
/// begins anew with each recording.
///
/// # Errors
/// A recording of another sample interval than the first one's: its place, and what is wrong.
pub fn joined(runs: Vec<JointRun>) -> Result<JointRun, (usize, Fault)> {
    let mut own = runs.iter();
    let Some(mut whole) = own.next().cloned() else {
        return Err((0, fault("there is no recording".to_owned())));
    };
    if runs.len() == 1 {
        return Ok(whole);
    }
    for (place, run) in own.enumerate() {
        if (run.step_s / whole.step_s - 1.0).abs() > SAME_STEP {
            let reason = format!(
                "samples every {} s, the first recording every {} s; several recordings are diagnosed together at one rate",
                run.step_s, whole.step_s
            );
            return Err((place + 1, fault(reason)));
        }
        append(&mut whole, run);
    }
    whole.parts = runs;
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

fn append(whole: &mut JointRun, run: &JointRun) {
    // A window that needs the sample before the seam lies across it.
    if let Some(last) = whole.recorded.last_mut() {
        *last = false;
    }
    whole.recorded.extend_from_slice(&run.recorded);
    whole.remarks.extend_from_slice(&run.remarks);
    whole.position.extend_from_slice(&run.position);
    whole.motion.extend_from_slice(&run.motion);
    whole.effort.extend_from_slice(&run.effort);
    whole.untold_speed.extend_from_slice(&run.untold_speed);
    for (own, new) in [
        (&mut whole.predicted, &run.predicted),
        (&mut whole.current, &run.current),
    ] {
        if let (Some(own), Some(new)) = (own, new) {
            own.extend_from_slice(new);
        }
    }
    whole.position_noise = whole.position_noise.max(run.position_noise);
    whole.effort_noise = whole.effort_noise.max(run.effort_noise);
    whole.speed_floor = whole.speed_floor.max(run.speed_floor);
}

/// The samples of each recording in a joined run.
pub fn parts(run: &JointRun) -> impl Iterator<Item = (&JointRun, Range<usize>)> {
    let mut first = 0;
    run.parts.iter().map(move |part| {
        let range = first..first + part.len();
        first = range.end;
        (part, range)
    })
}

/// Columns over a joined run, from what each of its recordings gives.
pub fn over_parts(
    run: &JointRun,
    of: impl Fn(&JointRun, Range<usize>) -> Option<Columns>,
) -> Option<Columns> {
    if run.parts.is_empty() {
        return of(run, 0..run.len());
    }
    let each = parts(run).map(|(part, range)| of(part, range));
    each.collect::<Option<Vec<Columns>>>()?
        .into_iter()
        .reduce(after)
}

/// Columns of two recordings, one after the other.
fn after(before: Columns, next: Columns) -> Columns {
    let chained = |(before, next): (Vec<f64>, Vec<f64>)| [before, next].concat();
    match (before, next) {
        (Columns::Free(before), Columns::Free(next)) => {
            Columns::Free(before.into_iter().zip(next).map(chained).collect())
        }
        (Columns::Fixed(before), Columns::Fixed(next)) => Columns::Fixed(chained((before, next))),
        (before, _) => before,
    }
}
