//! This file is the noise of the five-bar's residuals: what encoders and force sensor put into each row, and how rows share it.

use super::run::FiveBarRun;
use crate::run::rms;
use crate::weak::{Windows, is_recorded, overlap};
use crate::whiten::Whitener;
use core::cell::OnceCell;
use nalgebra::Matrix2;

/// What the brakes may do where the sense of motion cannot be told, in floors.
const MOST_UNTOLD: f64 = 0.5;

/// Samples by which an entry into the backlash, or its end, may be mistaken.
const ENTRY_SAMPLES: f64 = 3.0;

/// Gives up the rows whose window holds a missing sample; in which a brake could do more than half the floor where its
/// joint's sense cannot be told: a reversal, a joint at rest or held (what a held brake transmits is no measurement); or in
/// which the torque steps by as much where the backlash begins or ends, because its angle is known to a few counts only.
pub fn keep_moving(run: &FiveBarRun, windows: &mut Windows) {
    let most = MOST_UNTOLD * floor(run, windows);
    let untold: Vec<Vec<f64>> = run
        .joints
        .iter()
        .zip(&run.yields)
        .map(|(motion, yields)| {
            let pairs = motion.iter().zip(yields);
            pairs
                .map(|(now, y)| if now.sense.abs() < 1.0 { *y } else { 0.0 })
                .collect()
        })
        .collect();
    let steps = run.backlash_steps.each_ref().map(|steps| {
        let errors = steps.iter().map(|step| ENTRY_SAMPLES * step);
        errors.collect::<Vec<f64>>()
    });
    windows.keep(|centre, bump| {
        let first = centre - bump.len() / 2;
        is_recorded(&run.recorded, centre, bump)
            && untold.iter().chain(&steps).all(|untold| {
                let window = untold.iter().skip(first);
                window.zip(bump).map(|(y, w)| y * w).sum::<f64>() <= most
            })
    });
}

/// Root mean square over the usable rows of the standard deviation that sensor noise gives them, N·m.
pub fn floor(run: &FiveBarRun, windows: &Windows) -> f64 {
    let noise = Noise::new(run, windows, 0.0);
    let rows = windows.usable.iter().enumerate().filter(|(_, u)| **u);
    let deviations: Vec<f64> = rows
        .map(|(row, _)| noise.covariance(row, row).sqrt())
        .collect();
    rms(&deviations)
}

/// The noise model of the usable rows; `excess` is a variance of effort that nothing explains, the same on both outputs.
pub fn whitener(run: &FiveBarRun, windows: &Windows, excess: f64) -> Whitener {
    let noise = Noise::new(run, windows, excess);
    // Windows share samples up to their own length and two more.
    let reach = (windows.bump.len() + 1) / windows.hop;
    let band = windows.outputs * (reach + 1);
    Whitener::banded(&windows.usable, band, |row, other| {
        noise.covariance(row, other)
    })
}

struct Noise<'a> {
    run: &'a FiveBarRun,
    windows: &'a Windows,
    /// Overlaps of two windows by their distance in hops: of the curvatures and of the bumps.
    overlaps: Vec<OnceCell<[f64; 2]>>,
    excess: f64,
}

impl<'a> Noise<'a> {
    fn new(run: &'a FiveBarRun, windows: &'a Windows, excess: f64) -> Noise<'a> {
        let white = overlap(&windows.bump, 0).max(1e-300);
        Noise {
            run,
            windows,
            overlaps: vec![OnceCell::new(); windows.curvature.len() / windows.hop + 2],
            excess: excess / white,
        }
    }

    /// Covariance of two rows, (N·m)².
    fn covariance(&self, row: usize, other: usize) -> f64 {
        let Windows {
            centres, outputs, ..
        } = self.windows;
        let centre = |row: usize| centres.get(row).copied().unwrap_or(0);
        let (here, there) = (centre(row), centre(other));
        let shift = here.abs_diff(there);
        let Some(cell) = self.overlaps.get(shift / self.windows.hop) else {
            return 0.0;
        };
        let [curvatures, bumps] = *cell.get_or_init(|| {
            [&self.windows.curvature, &self.windows.bump].map(|weights| overlap(weights, shift))
        });
        let form = |k: usize| self.run.forms.get(k);
        let (Some(one), Some(two)) = (form(here), form(there)) else {
            return 0.0;
        };
        let (a, b) = (row % outputs, other % outputs);
        let entry = |m: Matrix2<f64>| m.get((a, b)).copied().unwrap_or(0.0);
        let angles = entry(one.mass * two.mass.transpose()) * self.run.theta_noise.powi(2);
        let force = entry(one.tip.transpose() * two.tip) * self.run.force_noise.powi(2);
        let excess = if a == b { self.excess } else { 0.0 };
        angles * curvatures + (force + excess) * bumps
    }
}
