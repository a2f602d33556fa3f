//! This file computes the columns of an encoder's zero error, and of its scale error with a zero.
//!
//! The linkage is nonlinear: an error of a few hundredths of a radian is no small step. The shape
//! of such a cause is the step of the finite difference, ideally its true size, so that column
//! times coefficient is the whole change.
//!
//! An encoder counts from where it was homed. The second column of a scale error is therefore its
//! zero, and the shape may give that zero at the step.
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
use rigproof_model::effects::{Form, OfSensor, form};
use rigproof_model::linkage::inverse;
use rigproof_spec::joint::Joint;

/// The least finite-difference step of an encoder's zero, rad, and of its scale.
const LEAST_STEP: f64 = 1e-3;

/// A tip position near the middle of the workspace of both layouts, m.
const AMIDST_M: [f64; 2] = [0.0, 0.4];

/// The signals of a linkage: its balance of efforts, and for each joint the combination without
/// that joint.
const SIGNALS: usize = 1 + Joint::ALL.len();

/// A change of an encoder: the output, its kind and its size.
pub(crate) struct Encoder {
    output: usize,
    is_scale: bool,
    step: f64,
    /// The zero error of a scale at the step, rad.
    zero_rad: f64,
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
        let is_scale = match form(cause.mechanism)? {
            Form::Sensor(OfSensor::EncoderScale) => true,
            Form::Sensor(OfSensor::EncoderOffset) => false,
            Form::Sensor(
                OfSensor::Eccentric
                | OfSensor::Clock
                | OfSensor::ForceGain
                | OfSensor::ForceBias
                | OfSensor::ForceRotation,
            )
            | Form::Resistance(_)
            | Form::ShareOfBrake(_)
            | Form::Drive(_)
            | Form::Brake(_)
            | Form::Linkage(_)
            | Form::Joint(_) => return None,
        };
        Some(Encoder {
            output,
            is_scale,
            step: step(shape),
            zero_rad: shape.get(1).copied().unwrap_or(0.0),
            pivot_rad: *amidst(run)?.get(output)?,
        })
    }

    /// The imbalance of the moved linkage and its combinations: at the step, and for a scale with
    /// its zero moved as well.
    pub(super) fn signals(&self, run: &FiveBarRun) -> Option<Vec<Vec<f64>>> {
        let with = |run: &FiveBarRun, moved: &dyn Fn(f64) -> f64| {
            let mut theta = run.theta.clone();
            let own = theta.get_mut(self.output)?;
            own.iter_mut().for_each(|theta| *theta = moved(*theta));
            with_angles(run, theta).ok()
        };
        if self.is_scale {
            let scaled = with(run, &|theta| self.unscaled(theta))?;
            let moved = with(&scaled, &|theta| theta - LEAST_STEP)?;
            return Some([seen_by(&scaled), seen_by(&moved)].concat());
        }
        with(run, &|theta| theta - self.step).map(|moved| seen_by(&moved))
    }

    fn unscaled(&self, shown: f64) -> f64 {
        self.pivot_rad + (shown - self.pivot_rad) / (1.0 + self.step) - self.zero_rad
    }

    /// The error of the encoder where it shows zero, rad, from the two coefficients of a scale.
    pub(super) fn zero_at_zero_rad(&self, [scale, zero]: [f64; 2]) -> f64 {
        self.zero_off_rad([scale, zero]) - self.pivot_rad * scale / (1.0 + scale)
    }

    fn zero_off_rad(&self, [scale, zero]: [f64; 2]) -> f64 {
        self.zero_rad * scale / self.step + zero
    }

    /// The shape at which the finite difference spans the whole change that the coefficients state.
    pub(crate) fn over(&self, coefficients: &[f64]) -> Option<Vec<f64>> {
        let size = *coefficients.first()?;
        if self.is_scale {
            return Some(vec![size, self.zero_off_rad([size, *coefficients.get(1)?])]);
        }
        Some(vec![size])
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

/// The columns, row by row, from the recorded balance and the signals of the moved linkage. `first`
/// is the sample of the onset.
pub(crate) fn rows(
    windows: &Windows,
    recorded: &[f64],
    signals: &[Vec<f64>],
    shape: &[f64],
    first: usize,
) -> Vec<Vec<f64>> {
    let from = |signal: &[f64]| windows.since(signal, first);
    let mut before = windows.average(&from(recorded));
    let steps = [step(shape), LEAST_STEP];
    let states = signals.chunks(SIGNALS).zip(steps);
    states
        .filter_map(|(state, step)| {
            let (balance, combinations) = state.split_first()?;
            let after = windows.average_with(&from(balance), combinations);
            let change = less(&before, &after);
            before = after;
            Some(change.into_iter().map(|x| x / step).collect())
        })
        .collect()
}

fn step(shape: &[f64]) -> f64 {
    let step = shape.first().copied().unwrap_or(0.0);
    step.abs().max(LEAST_STEP).copysign(step)
}
