//! This file puts several recordings of one rig one after another, so that one set of numbers explains them all.

use super::run::FiveBarRun;
use crate::align::Fault;
use crate::rules::SAME_STEP;

/// One run of several recordings in their order, its clock going on from each to the next. No window lies across a seam, and every memory
/// begins anew with each recording.
///
/// # Errors
/// A recording of another sample interval than the first one's: its place, and what is wrong.
pub fn joined(runs: Vec<FiveBarRun>) -> Result<FiveBarRun, (usize, Fault)> {
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

fn append(whole: &mut FiveBarRun, run: &FiveBarRun) {
    let more = |own: &mut Vec<f64>, new: &Vec<f64>| own.extend_from_slice(new);
    let all = |own: &mut [Vec<f64>], new: &[Vec<f64>]| {
        own.iter_mut()
            .zip(new)
            .for_each(|(own, new)| more(own, new));
    };
    all(&mut whole.theta, &run.theta);
    all(&mut whole.force, &run.force);
    all(&mut whole.yields, &run.yields);
    all(&mut whole.yield_errors, &run.yield_errors);
    let joints = whole.joints.iter_mut().zip(&run.joints);
    joints.for_each(|(own, new)| own.extend_from_slice(new));
    whole.poses.extend_from_slice(&run.poses);
    whole.forms.extend_from_slice(&run.forms);
    let currents = whole.currents.iter_mut().zip(&run.currents);
    currents.for_each(|(own, new)| {
        if let (Some(own), Some(new)) = (own, new) {
            more(own, new);
        }
    });
    // A window that needs the sample before the seam lies across it.
    if let Some(last) = whole.recorded.last_mut() {
        *last = false;
    }
    whole.recorded.extend_from_slice(&run.recorded);
    whole.remarks.extend_from_slice(&run.remarks);
    whole.switched.extend_from_slice(&run.switched);
    whole.theta_noise = whole.theta_noise.max(run.theta_noise);
    whole.still_rad = whole.still_rad.max(run.still_rad);
    whole.cutoff_hz = whole.cutoff_hz.max(run.cutoff_hz);
    whole.force_noise = whole.force_noise.max(run.force_noise);
    whole.speed_floor = whole.speed_floor.max(run.speed_floor);
}

/// Signals of two outputs over a joined run, from what each of its recordings gives.
pub fn over_parts(
    run: &FiveBarRun,
    of: impl Fn(&FiveBarRun) -> Option<Vec<Vec<f64>>>,
) -> Option<Vec<Vec<f64>>> {
    if run.parts.is_empty() {
        return of(run);
    }
    let mut outputs: Vec<[Vec<f64>; 2]> = Vec::new();
    for part in &run.parts {
        let signals = of(part)?;
        outputs.resize(signals.len(), Default::default());
        for ([first, second], signal) in outputs.iter_mut().zip(&signals) {
            let (a, b) = signal.split_at(signal.len() / 2);
            first.extend_from_slice(a);
            second.extend_from_slice(b);
        }
    }
    let whole = |[mut first, second]: [Vec<f64>; 2]| {
        first.extend(second);
        first
    };
    Some(outputs.into_iter().map(whole).collect())
}
