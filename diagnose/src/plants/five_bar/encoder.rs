//! This file computes the columns of an encoder's error: its zero; its scale, or its disc off the
//! centre, each with a zero.
//!
//! The linkage is nonlinear: an error of a few hundredths of a radian is no small step. The shape
//! of such a cause is the steps of a finite difference, ideally its true sizes, so that columns
//! times coefficients are the whole change.
//!
//! An encoder counts from where it was homed. The last column of a scale or of a disc off its centre
//! is therefore the zero.
//!
//! A wrong angle also turns the direction in which a held joint pushes. Its reaction may be as
//! large as any effort and appears in the combination that should be free of it. Rows are therefore
//! averaged with the combinations of the moved linkage.

use super::columns::{driving, known};
use super::from_rig::with_angles;
use super::noise::combinations;
use super::run::{FiveBarRun, joint_at};
use crate::cause::Cause;
use crate::problem::less;
use crate::weak::Windows;
use rigproof_model::effects::{Form, OfSensor, behind_shown, form};
use rigproof_model::linkage::inverse;
use rigproof_spec::joint::Joint;

/// The least finite-difference step of an encoder's zero, rad, of its scale, and of an error once a turn, rad.
const LEAST_STEP: f64 = 1e-3;

/// A tip position near the middle of the workspace of both layouts, m.
const AMIDST_M: [f64; 2] = [0.0, 0.4];

/// The signals of a linkage: its balance of efforts, and for each joint the combination without
/// that joint.
const SIGNALS: usize = 1 + Joint::ALL.len();

/// A change of an encoder.
pub(crate) struct Encoder {
    output: usize,
    of: OfSensor,
    /// The size of each part of the error: those of the mechanism, then a zero, rad.
    parts: Vec<f64>,
    /// The angle at which a scale error leaves the encoder right, rad. In the middle of the
    /// workspace, scale and zero correlate least.
    pivot_rad: f64,
}

impl Encoder {
    /// The encoder error that a cause is; `None` for other causes.
    pub(crate) fn of(run: &FiveBarRun, cause: Cause, shape: &[f64]) -> Option<Encoder> {
        let output = match joint_at(cause.at)? {
            Joint::A => 0,
            Joint::B => 1,
            Joint::E | Joint::C => return None,
        };
        let (of, count, sizes) = match form(cause.mechanism)? {
            Form::Sensor(of @ OfSensor::EncoderScale) => (of, 2, shape),
            Form::Sensor(of @ OfSensor::EncoderOffset) => (of, 1, shape),
            // The first number of its shape is the pitch.
            Form::Sensor(of @ OfSensor::Eccentric) => (of, 3, shape.get(1..).unwrap_or_default()),
            _ => return None,
        };
        Some(Encoder {
            output,
            of,
            parts: (0..count).map(|k| step(sizes.get(k).copied())).collect(),
            pivot_rad: *amidst(run)?.get(output)?,
        })
    }

    /// The imbalance of the moved linkage and its combinations: with the first part of the error, and
    /// with each further one as well.
    pub(super) fn signals(&self, run: &FiveBarRun) -> Option<Vec<Vec<f64>>> {
        let with = |count: usize| {
            let parts = self.parts.get(..count)?;
            let mut theta = run.theta.clone();
            let own = theta.get_mut(self.output)?;
            own.iter_mut()
                .for_each(|theta| *theta = self.behind(*theta, parts));
            with_angles(run, theta).ok().map(|moved| seen_by(&moved))
        };
        let states: Option<Vec<_>> = (1..=self.parts.len()).map(with).collect();
        Some(states?.concat())
    }

    /// The angle behind a shown one, rad. Parts that are not given are 0.
    fn behind(&self, shown: f64, parts: &[f64]) -> f64 {
        let part = |k: usize| parts.get(k).copied().unwrap_or(0.0);
        match self.of {
            OfSensor::EncoderScale => {
                self.pivot_rad + (shown - self.pivot_rad) / (1.0 + part(0)) - part(1)
            }
            OfSensor::Eccentric => behind_shown(shown, &[part(0), part(1)]) - part(2),
            _ => shown - part(0),
        }
    }

    /// The columns, row by row, from the recorded balance and the signals of the moved linkage.
    /// `first` is the sample of the onset.
    pub(super) fn rows(
        &self,
        windows: &Windows,
        recorded: &[f64],
        signals: &[Vec<f64>],
        first: usize,
    ) -> Vec<Vec<f64>> {
        let from = |signal: &[f64]| windows.since(signal, first);
        let mut before = windows.average(&from(recorded));
        let states = signals.chunks(SIGNALS).zip(&self.parts);
        states
            .filter_map(|(state, part)| {
                let (balance, combinations) = state.split_first()?;
                let after = windows.average_with(&from(balance), combinations);
                let change = less(&before, &after);
                before = after;
                Some(change.into_iter().map(|x| x / part).collect())
            })
            .collect()
    }

    /// The error besides the mechanism's own numbers, where the encoder shows zero, rad.
    pub(super) fn zero_rad(&self, coefficients: &[f64]) -> Option<f64> {
        match (self.of, coefficients) {
            (OfSensor::EncoderScale, [scale, zero, ..]) => {
                Some(zero - self.pivot_rad * scale / (1.0 + scale))
            }
            (OfSensor::Eccentric, [_, _, zero, ..]) => Some(*zero),
            _ => None,
        }
    }

    /// The shape at which the finite difference spans the whole change that the coefficients state.
    pub(crate) fn over(&self, coefficients: &[f64]) -> Option<Vec<f64>> {
        let sizes = coefficients.get(..self.parts.len())?;
        Some(match self.of {
            // A pitch of 0 means a turn.
            OfSensor::Eccentric => [&[0.0], sizes].concat(),
            _ => sizes.to_vec(),
        })
    }
}

/// θA and θB with the tip in the middle of the workspace, rad.
fn amidst(run: &FiveBarRun) -> Option<[f64; 2]> {
    let pose = inverse::pose(&run.parameters.arms, AMIDST_M).ok()?;
    Some([pose.theta_a_rad, pose.theta_b_rad])
}

fn seen_by(run: &FiveBarRun) -> Vec<Vec<f64>> {
    let balance = less(&driving(run, run.forces()), &known(run));
    [vec![balance], combinations(run)].concat()
}

fn step(size: Option<f64>) -> f64 {
    let step = size.unwrap_or(0.0);
    step.abs().max(LEAST_STEP).copysign(step)
}
