//! This file detects trials of a brake that differ only in gain: the law is the same, but each
//! trial has more or less of it.

use crate::candidates::modelled_effort;
use crate::filter::{rms, usable_rms};
use crate::plant::Run;
use crate::problem::{Problem, Term, less};
use crate::regression::Fit;
use crate::report::Unknown;
use crate::rules::{FEWEST_TRIALS, TRIAL_JUMP, TRIALS_SHARE, WINDOWS_A_TRIAL};
use crate::weak::Windows;

/// The trials of a brake on a bench. Each begins at a jump of the current.
#[derive(Clone, Debug)]
pub struct Trials {
    /// The trial of every row.
    of_row: Vec<usize>,
    /// When every trial begins, s.
    start_s: Vec<f64>,
    /// The nominal brake's torque, row by row, N·m.
    torque: Vec<f64>,
}

/// The scatter of a brake's torque from trial to trial.
#[derive(Clone, Debug)]
pub struct Scatter {
    /// Standard deviation of the trials' gains.
    deviation: f64,
    /// The same in N·m at the greatest torque of the recording.
    torque_nm: f64,
    /// Share of the residual that the gains remove.
    share: f64,
    /// Start of every trial, s, and its excess torque as a share.
    gains: Vec<(f64, f64)>,
}

impl Trials {
    /// The trials of a run; `None` without a brake, or if too few trials show enough torque.
    pub fn of(run: &dyn Run, windows: &Windows) -> Option<Trials> {
        let (predicted, current) = run.brake()?;
        let clock = run.clock();
        let mut start_s = vec![clock.start_s];
        let mut jumps = vec![0];
        for (k, pair) in current.windows(2).enumerate() {
            if let [before, after] = pair
                && (after - before).abs() > TRIAL_JUMP * run.full_current()
            {
                jumps.push(k + 1);
                start_s.push(clock.start_s + (k + 1) as f64 * clock.step_s);
            }
        }
        let trial = |centre: &usize| jumps.partition_point(|jump| jump <= centre) - 1;
        let of_row: Vec<usize> = windows.centres.iter().map(trial).collect();
        let usable = windows.usable.iter().filter(|u| **u).count();
        let enough = jumps.len() >= FEWEST_TRIALS && usable >= WINDOWS_A_TRIAL * jumps.len();
        enough.then(|| Trials {
            of_row,
            start_s,
            torque: windows.average(predicted),
        })
    }

    /// The number of trials.
    /// The least-squares gain of each trial; 0 without rows.
    fn gains(&self, rows: &[f64], usable: &[bool]) -> Vec<f64> {
        let mut sums = vec![(0.0, 0.0); self.start_s.len()];
        let each = self
            .of_row
            .iter()
            .zip(&self.torque)
            .zip(rows.iter().zip(usable));
        for ((&trial, torque), (row, _)) in each.filter(|(_, (_, usable))| **usable) {
            if let Some((moment, square)) = sums.get_mut(trial) {
                *moment += torque * row;
                *square += torque * torque;
            }
        }
        let gain = |(moment, square): (f64, f64)| if square > 0.0 { moment / square } else { 0.0 };
        sums.into_iter().map(gain).collect()
    }

    /// Projects the gains of all trials out of rows.
    pub fn take_out(&self, rows: &mut [f64], usable: &[bool]) {
        let gains = self.gains(rows, usable);
        for (row, (trial, torque)) in rows.iter_mut().zip(self.of_row.iter().zip(&self.torque)) {
            *row -= gains.get(*trial).copied().unwrap_or(0.0) * torque;
        }
    }

    /// The scatter of the trials; `None` if the residual is below `least`, N·m, or if gains do not
    /// explain it.
    pub fn scatter(&self, residual: &[f64], usable: &[bool], least: f64) -> Option<Scatter> {
        let size = |rows: &[f64]| usable_rms(rows, usable);
        let mut within = residual.to_vec();
        self.take_out(&mut within, usable);
        let (all, rest) = (size(residual), size(&within));
        let share = 1.0 - (rest / all).powi(2);
        if all <= least || share < TRIALS_SHARE {
            return None;
        }
        let gains = self.gains(residual, usable);
        let seen: Vec<f64> = gains.iter().copied().filter(|gain| *gain != 0.0).collect();
        let mean = seen.iter().sum::<f64>() / seen.len().max(1) as f64;
        let deviation = rms(&seen.iter().map(|gain| gain - mean).collect::<Vec<f64>>());
        let greatest = self.torque.iter().fold(0.0f64, |most, t| most.max(t.abs()));
        Some(Scatter {
            deviation,
            torque_nm: deviation * greatest,
            share,
            gains: self.start_s.iter().copied().zip(gains).collect(),
        })
    }
}

impl Scatter {
    /// The scatter as a report states it: a shape without a law.
    pub fn described(&self) -> Unknown {
        Unknown {
            variable: "trial",
            joint: None,
            variable_unit: "s".to_owned(),
            along_motion: true,
            share: self.share,
            shape: self.gains.clone(),
            memory: false,
            parity: "neither",
            suggestion: format!(
                "the brake gives more or less of the same torque from trial to trial: standard deviation {:.1} %, {:.2} N·m at the greatest torque; nothing recorded says when, so no law is named for it (temperature and settled particles do this); what is named was told within the trials",
                100.0 * self.deviation,
                self.torque_nm
            ),
        }
    }
}

/// The residual of a fit in the effort, row by row, including the gains of the trials.
pub fn left_over(problem: &Problem, terms: &[&Term], fitted: &Fit) -> Vec<f64> {
    let modelled = modelled_effort(problem, terms, fitted);
    problem
        .windows
        .average(&less(&problem.run.effort(), &modelled))
}
