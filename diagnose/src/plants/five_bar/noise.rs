//! This file is the noise model of the five-bar's residuals: the variance that encoders and force
//! sensor give each row, and the covariance between rows.

use super::equations::stacked;
use super::run::FiveBarRun;
use crate::filter::rms;
use crate::rules::MOST_UNTOLD;
use crate::weak::{Windows, is_recorded, overlap};
use crate::whiten::Whitener;
use nalgebra::{Matrix2, Vector2};
use rigproof_model::effects::Instant;
use rigproof_spec::joint::Joint;
use std::sync::OnceLock;

/// Marks rows as unusable whose window has a missing sample, or in which the torque of a brake is
/// too uncertain.
///
/// A torque is too uncertain if its unknown direction (a reversal, a joint at rest or held) or its
/// backlash could change the row by more than half the noise floor. The torque of a held brake is a
/// reaction and measures nothing.
///
/// If this concerns one joint only, one equation is left: the combination of both that is free of
/// that joint.
pub fn keep_told(run: &FiveBarRun, windows: &mut Windows) {
    let most = MOST_UNTOLD * floor(run, windows);
    let untold = run.joints.iter().zip(&run.yields).map(|(motion, yields)| {
        let pairs = motion.iter().zip(yields);
        let told = |now: &Instant| now.sense.abs() >= 1.0;
        let untold = pairs.map(|(now, y)| if told(now) { 0.0 } else { *y });
        untold.collect::<Vec<f64>>()
    });
    let errors = run.yield_errors.iter().cloned();
    let joints: Vec<[Vec<f64>; 2]> = untold.zip(errors).map(|pair| pair.into()).collect();
    windows.combinations = combinations(run);
    let Windows {
        bump,
        outputs,
        centres,
        usable,
        combined,
        ..
    } = windows;
    let rows = usable
        .chunks_mut(*outputs)
        .zip(combined.chunks_mut(*outputs));
    for (&centre, (usable, combined)) in centres.iter().step_by(*outputs).zip(rows) {
        let sums_up = |errors: &Vec<f64>| {
            let window = errors.iter().skip(centre - bump.len() / 2);
            window.zip(&*bump).map(|(y, w)| y * w).sum::<f64>() > most
        };
        let joints = joints.iter().enumerate();
        let mut unknown = joints.filter(|(_, errors)| errors.iter().any(sums_up));
        let first = unknown.next().map(|(joint, _)| joint);
        let is_told = unknown.next().is_none() && is_recorded(&run.recorded, centre, bump);
        for (output, usable) in usable.iter_mut().enumerate() {
            *usable = *usable && is_told && (first.is_none() || output == 0);
        }
        combined.fill(first);
    }
}

/// For every joint, the combination of both equations that is free of any torque at it.
pub fn combinations(run: &FiveBarRun) -> Vec<Vec<f64>> {
    Joint::ALL.map(|joint| without(run, joint)).into()
}

/// The combination of both equations that is free of torque at a joint, of unit length, one value
/// per sample.
fn without(run: &FiveBarRun, joint: Joint) -> Vec<f64> {
    stacked(run.joint_rows(joint).map(|[by_a, by_b]| {
        let length = by_a.hypot(by_b).max(1e-300);
        [-by_b / length, by_a / length]
    }))
}

/// Root mean square over the usable rows of the standard deviation that sensor noise gives them,
/// N·m.
pub fn floor(run: &FiveBarRun, windows: &Windows) -> f64 {
    let noise = Noise::new(run, windows, 0.0);
    let rows = windows.usable.iter().enumerate().filter(|(_, u)| **u);
    let deviations: Vec<f64> = rows
        .map(|(row, _)| noise.covariance(row, row).sqrt())
        .collect();
    rms(&deviations)
}

/// The noise model of the usable rows. `excess` is an additional variance of the effort that
/// nothing explains, equal on both outputs.
pub fn whitener(run: &FiveBarRun, windows: &Windows, excess: f64) -> Whitener {
    let noise = Noise::new(run, windows, excess);
    // Windows share samples up to their own length plus two.
    let reach = (windows.bump.len() + 1) / windows.hop;
    let band = windows.outputs * (reach + 1);
    Whitener::banded(&windows.usable, band, |row, other| {
        noise.covariance(row, other)
    })
}

/// The covariance of both rows of a window, given the first of them, (N·m)². `excess` as in
/// [`whitener`].
pub fn pair_covariances<'a>(
    run: &'a FiveBarRun,
    windows: &'a Windows,
    excess: f64,
) -> impl Fn(usize) -> Matrix2<f64> + 'a {
    let noise = Noise::new(run, windows, excess);
    move |row| Matrix2::from_fn(|i, j| noise.covariance(row + i, row + j))
}

struct Noise<'a> {
    run: &'a FiveBarRun,
    windows: &'a Windows,
    /// The weights of both equations in each row.
    shares: Vec<Vector2<f64>>,
    /// Overlaps of two windows by their distance in hops: of the second differences and of the
    /// bumps.
    overlaps: Vec<OnceLock<[f64; 2]>>,
    excess: f64,
}

impl<'a> Noise<'a> {
    fn new(run: &'a FiveBarRun, windows: &'a Windows, excess: f64) -> Noise<'a> {
        let white = overlap(&windows.bump, 0).max(1e-300);
        Noise {
            run,
            windows,
            shares: (0..windows.centres.len())
                .map(|row| Vector2::from_iterator(windows.shares(row)))
                .collect(),
            overlaps: vec![OnceLock::new(); windows.curvature.len() / windows.hop + 2],
            excess: excess / white,
        }
    }

    fn covariance(&self, row: usize, other: usize) -> f64 {
        let centre = |row: usize| self.windows.centres.get(row).copied().unwrap_or(0);
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
        let (Some(mine), Some(theirs)) = (self.shares.get(row), self.shares.get(other)) else {
            return 0.0;
        };
        let entry = |m: Matrix2<f64>| mine.dot(&(m * theirs));
        let angles = entry(one.mass * two.mass.transpose()) * self.run.theta_noise.powi(2);
        let force = entry(one.tip.transpose() * two.tip) * self.run.force_noise.powi(2);
        let excess = self.excess * mine.dot(theirs);
        angles * curvatures + (force + excess) * bumps
    }
}
