//! This file computes the equations of motion of the linkage along a recording.

use super::run::FiveBarRun;
use nalgebra::{Matrix2, Vector2};
use rigproof_model::effects::Instant;
use rigproof_model::error::ModelError;
use rigproof_model::linkage::{Pose, forward};
use rigproof_model::motion::two_coordinate::{TwoCoordinate, two_coordinate};
use rigproof_model::rig::Parameters;

/// Pairs of values as one signal: the first of every pair, then the second.
pub fn stacked(pairs: impl Iterator<Item = [f64; 2]>) -> Vec<f64> {
    let pairs: Vec<[f64; 2]> = pairs.collect();
    let mut both = Vec::with_capacity(2 * pairs.len());
    both.extend(pairs.iter().map(|[first, _]| first));
    both.extend(pairs.iter().map(|[_, second]| second));
    both
}

/// Poses and equations of motion along a smoothed motion of θA and θB.
///
/// # Errors
/// The linkage cannot be assembled at some sample: its index, and why.
pub fn forms(
    parameters: &Parameters,
    base: &[Vec<Instant>; 2],
) -> Result<(Vec<Pose>, Vec<TwoCoordinate>), (usize, ModelError)> {
    let [a, b] = base;
    let mut poses = Vec::with_capacity(a.len());
    let mut forms = Vec::with_capacity(a.len());
    for (k, (a, b)) in a.iter().zip(b).enumerate() {
        let pose = forward::pose(&parameters.arms, a.position, b.position).map_err(|e| (k, e))?;
        let rates = [a.speed, b.speed];
        let form = two_coordinate(&parameters.arms, &parameters.inertia, &pose, rates);
        poses.push(pose);
        forms.push(form);
    }
    Ok((poses, forms))
}

/// The efforts of θA and θB per unit of torque at A, E, B, C.
pub fn levers(forms: &[TwoCoordinate]) -> [[Vec<f64>; 2]; 4] {
    let lever = |joint: usize, base: usize| {
        let each = forms.iter();
        each.map(|form| form.joints.get((joint, base)).copied().unwrap_or(0.0))
            .collect()
    };
    [0, 1, 2, 3].map(|joint| [0, 1].map(|base| lever(joint, base)))
}

/// The inertial effort of some mass matrices, as the second difference of the angles shows it:
/// d/dt(M·q̇) − ½·∂(q̇ᵀ·M·q̇)/∂q; θA's samples first.
pub fn inertial(run: &FiveBarRun, forms: &[TwoCoordinate]) -> Vec<f64> {
    let step_s = run.step_s;
    let count = forms.len();
    let [a, b] = &run.theta;
    let at = |k: usize| {
        let angle = |theta: &Vec<f64>| theta.get(k).copied().unwrap_or(0.0);
        Vector2::new(angle(a), angle(b))
    };
    let mass = |k: usize| forms.get(k).map_or(Matrix2::zeros(), |form| form.mass);
    let momentum = |k: usize| (mass(k) + mass(k + 1)) * (at(k + 1) - at(k)) * (0.5 / step_s);
    let [joint_a, _, joint_b, _] = &run.joints;
    let rates = joint_a.iter().zip(joint_b);
    let pairs = forms.iter().zip(rates).enumerate();
    stacked(pairs.map(|(k, (form, (a, b)))| {
        if k == 0 || k + 1 >= count {
            return [0.0; 2];
        }
        let mass_rate = (mass(k + 1) - mass(k - 1)) * (0.5 / step_s);
        let rest = form.bias - mass_rate * Vector2::new(a.speed, b.speed);
        ((momentum(k) - momentum(k - 1)) / step_s + rest).into()
    }))
}
