//! This file aligns a static sweep: rows that were taken after everything had settled, without a
//! time.

mod regimes;
mod scatter;

use super::align::{Signals, check_sign};
use super::inertia::Inertia;
use super::run::JointRun;
use crate::align::{Fault, check_missing, smallest_step};
use crate::cause::Cause;
use crate::continuity::Remark;
use crate::rules::FEWEST_BLOCKS;
use rigproof_model::effects::Instant;
use rigproof_model::effects::facts::{Facts, Family};
use rigproof_spec::effect::Mechanism;
use rigproof_trace::rig::Recording;
use scatter::scatter;

/// The time from row to row, s. No law of a sweep goes by time.
const ROW_S: f64 = 1.0;

/// The rows of a sweep in their order. Those that lack a number are left out.
///
/// # Errors
/// Too many efforts are missing, or they drive the motion.
pub(super) fn align(signals: &Signals, recording: &Recording) -> Result<JointRun, Fault> {
    let speeds = recording.speed.as_ref().map(|own| own.samples.as_slice());
    let is_stated = recording
        .force
        .as_ref()
        .is_some_and(|own| own.noise.is_some());
    let all = signals.effort.len();
    check_missing("effort", &signals.time_s, &signals.effort)?;
    let others = [&signals.current, &signals.predicted];
    let whole = |k: &usize| {
        let others = others.into_iter().flatten().map(Vec::as_slice);
        let mut each = others.chain(speeds).chain([signals.effort.as_slice()]);
        each.all(|own| own.get(*k).is_some_and(|x| x.is_finite()))
    };
    let kept: Vec<usize> = (0..all).filter(whole).collect();
    let of = |own: &[f64]| -> Vec<f64> {
        let values = kept.iter().filter_map(|k| own.get(*k));
        values.copied().collect()
    };
    let speeds = speeds.map(of);
    let effort = of(&signals.effort);
    let current = signals.current.as_deref().map(of);
    let scatter = scatter(&effort, current.as_deref(), speeds.as_deref()).unwrap_or(0.0);
    let rounding = smallest_step(&effort) / 12f64.sqrt();
    let least = signals.effort_noise.unwrap_or(rounding);
    let effort_noise = match is_stated {
        true => least,
        false => scatter.max(least),
    };
    let motion = (0..kept.len()).map(|k| {
        let speed = speeds.as_ref().and_then(|own| own.get(k)).copied();
        Instant {
            time_s: k as f64 * ROW_S,
            position: 0.0,
            speed: speed.unwrap_or(0.0),
            sense: speed.map_or(1.0, sense),
        }
    });
    let run = JointRun {
        plant: signals.plant,
        kind: signals.kind,
        inertia: Inertia::None,
        described: Vec::new(),
        step_s: ROW_S,
        start_s: 0.0,
        held: false,
        rows: Some((0..kept.len()).collect()),
        position: vec![0.0; kept.len()],
        motion: motion.collect(),
        predicted: signals.predicted.as_deref().map(of),
        current,
        law: None,
        position_noise: 0.0,
        effort_noise,
        recorded: vec![true; kept.len()],
        speed_floor: 0.0,
        untold_speed: vec![0.0; kept.len()],
        metered_by: Vec::new(),
        servo: None,
        parts: Vec::new(),
        remarks: vec![said(kept.len(), all)],
        effort,
    };
    check_sign(&run, 0.0)?;
    Ok(run)
}

/// The direction of a speed; 0 of none.
fn sense(speed: f64) -> f64 {
    match speed == 0.0 {
        true => 0.0,
        false => speed.signum(),
    }
}

/// What is to be said of a sweep of which so many rows of all are kept.
fn said(kept: usize, all: usize) -> Remark {
    let lacking = match all - kept {
        0 => String::new(),
        lacking => format!("; {lacking} rows lack a number and are left out"),
    };
    Remark {
        channel: "effort",
        what: "swept",
        from_s: 0.0,
        to_s: ROW_S * kept.saturating_sub(1) as f64,
        count: kept,
        words: format!(
            "a static sweep of {kept} settled rows: what acts by time or travel is no candidate, and the rows are dealt like cards, every {FEWEST_BLOCKS}th first, so that each part covers the whole sweep; a time is the place of a row in that order{lacking}"
        ),
        cause: None,
    }
}

impl JointRun {
    /// Whether it is a static sweep.
    pub(super) fn is_sweep(&self) -> bool {
        self.rows.is_some()
    }

    /// The rows of a static sweep, dealt like cards, so that each part of them covers the sweep. What
    /// was recorded over time stays as it is.
    pub(super) fn dealt(self) -> JointRun {
        let Some(rows) = &self.rows else {
            return self;
        };
        let order: Vec<usize> = (0..FEWEST_BLOCKS)
            .flat_map(|first| (first..rows.len()).step_by(FEWEST_BLOCKS))
            .collect();
        let of = |own: &Vec<f64>| -> Vec<f64> {
            let values = order.iter().filter_map(|k| own.get(*k));
            values.copied().collect()
        };
        let motion = order.iter().filter_map(|k| self.motion.get(*k)).enumerate();
        JointRun {
            motion: motion
                .map(|(k, now)| Instant {
                    time_s: k as f64 * ROW_S,
                    ..*now
                })
                .collect(),
            effort: of(&self.effort),
            predicted: self.predicted.as_ref().map(of),
            current: self.current.as_ref().map(of),
            rows: Some(order),
            ..self
        }
    }

    /// Whether a mechanism shows in this recording: in a static sweep only what needs neither time
    /// nor travel, and friction of motion only where the speed is recorded.
    pub(super) fn shows(&self, facts: &Facts) -> bool {
        let is_of_motion = facts.family == Family::FrictionOfMotion;
        !self.is_sweep() || facts.in_a_sweep && (!is_of_motion || self.is_turned())
    }

    /// Whether a speed is recorded.
    fn is_turned(&self) -> bool {
        self.motion.iter().any(|now| now.speed != 0.0)
    }

    /// What a constant cannot be told from: in a sweep at one unrecorded speed, dry friction.
    pub(super) fn twin_here(&self, twin: Mechanism) -> Cause {
        Cause::of(match self.is_sweep() && !self.is_turned() {
            true => Mechanism::DryOffset,
            false => twin,
        })
    }
}
