//! This file applies changes of the drive to the effort of a free run, and interpolates the effort
//! between samples.

use super::run::{JointRun, PlantKind};
use super::simulate::{Interpolation, Protocol};
use crate::effect::Effect;
use crate::plant::Run;
use crate::signals::shifted;
use rigproof_model::effects::{
    Drive, Form, first_order_lag_held, first_order_lag_straight, form, limited, slewed_held,
};
use rustfft::{FftPlannerScalar, num_complex::Complex64};

/// Effort at the beginning and the end of every integration step.
pub(super) type Efforts = [(f64, f64)];

/// The change of the drive that an effect makes; `None` for other effects.
pub(super) fn drive_of(effect: &Effect) -> Option<Drive> {
    match form(effect.mechanism())? {
        Form::Drive(change) => Some(change),
        _ => None,
    }
}

/// The effort after these changes of the drive, applied in order.
///
/// On an axis `effort` is the command and the result acts on the joint. On a bench `effort` is the
/// resistance and the result is what is metered. `first` is the index of the first sample on the
/// clock of the onsets.
pub(super) fn driven<'a>(
    changes: impl IntoIterator<Item = &'a Effect>,
    effort: &[f64],
    run: &JointRun,
    first: usize,
) -> Vec<f64> {
    let clock = run.clock();
    let mut out = effort.to_vec();
    for effect in changes {
        let Some(change) = drive_of(effect) else {
            continue;
        };
        let changed = changed(change, &effect.parameters, &out, run);
        let begins = effect.first_sample(clock).saturating_sub(first);
        for (o, c) in out.iter_mut().zip(changed).skip(begins) {
            *o = c;
        }
    }
    out
}

/// The effort after one change of the drive.
pub(super) fn changed(of: Drive, numbers: &[f64], effort: &[f64], run: &JointRun) -> Vec<f64> {
    let value = numbers.first().copied().unwrap_or(0.0);
    match of {
        Drive::Gain => effort.iter().map(|e| e * (1.0 + value)).collect(),
        Drive::Skew => shifted(effort, -value / run.step_s),
        Drive::Lag => lagging(run, effort, value),
        Drive::Limit => effort.iter().map(|e| limited(*e, numbers)).collect(),
        Drive::Rate => {
            let mut state = effort.first().copied().unwrap_or(0.0);
            let most = value * run.step_s;
            let each = effort.iter().map(|e| {
                let [mean, end] = slewed_held(state, *e, most);
                state = end;
                if run.held { mean } else { end }
            });
            each.collect()
        }
    }
}

/// An effort that lags by a time constant, s, sample by sample. The drive of an axis may hold each
/// sample until the next one; what is metered on a bench runs straight.
pub(super) fn lagging(run: &JointRun, effort: &[f64], time_constant_s: f64) -> Vec<f64> {
    match run.held && run.plant == PlantKind::Axis {
        true => first_order_lag_held(effort, run.step_s, time_constant_s),
        false => first_order_lag_straight(effort, run.step_s, time_constant_s),
    }
}

/// Effort at the beginning and the end of every integration step.
pub(super) fn fine_effort(effort: &[f64], protocol: &Protocol) -> Vec<(f64, f64)> {
    let n = protocol.substeps;
    let next = |k: usize| effort.get(k + 1).or(effort.last()).copied().unwrap_or(0.0);
    match protocol.interpolation {
        Interpolation::Hold => effort
            .iter()
            .flat_map(|&e| core::iter::repeat_n((e, e), n))
            .collect(),
        Interpolation::Linear => effort
            .iter()
            .enumerate()
            .flat_map(|(k, &e)| {
                let slope = (next(k) - e) / n as f64;
                (0..n).map(move |j| (e + slope * j as f64, e + slope * (j + 1) as f64))
            })
            .collect(),
        Interpolation::Band => {
            let fine = band_limited(effort, n);
            let after = fine.iter().skip(1).chain(fine.first());
            fine.iter().copied().zip(after.copied()).collect()
        }
    }
}

/// A periodic signal at `factor` times its rate, by its Fourier series.
fn band_limited(signal: &[f64], factor: usize) -> Vec<f64> {
    let n = signal.len();
    // The scalar planner gives the same bits on every processor.
    let mut planner = FftPlannerScalar::new();
    let mut spectrum: Vec<Complex64> = signal.iter().map(|&x| Complex64::new(x, 0.0)).collect();
    planner.plan_fft_forward(n).process(&mut spectrum);
    let mut wide = vec![Complex64::default(); n * factor];
    let half = n.div_ceil(2);
    for (to, from) in wide.iter_mut().zip(spectrum.iter().take(half)) {
        *to = *from;
    }
    for (to, from) in wide
        .iter_mut()
        .rev()
        .zip(spectrum.iter().rev().take(n - half))
    {
        *to = *from;
    }
    planner.plan_fft_inverse(n * factor).process(&mut wide);
    wide.into_iter().map(|c| c.re / n as f64).collect()
}

/// Over a short stretch a band-limited effort is interpolated linearly.
pub(super) fn local_interpolation(interpolation: Interpolation) -> Interpolation {
    match interpolation {
        Interpolation::Band => Interpolation::Linear,
        other => other,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::f64::consts::TAU;

    #[test]
    fn band_limited_interpolation_is_exact_on_a_multisine() {
        let value = |at: f64| {
            1.3 * libm::sin(TAU * 3.0 * at + 0.4) - 0.7 * libm::cos(TAU * 11.0 * at) + 0.17
        };
        for count in [48, 49] {
            let signal: Vec<f64> = (0..count).map(|k| value(k as f64 / count as f64)).collect();
            let fine = band_limited(&signal, 7);
            assert_eq!(fine.len(), 7 * count);
            for (k, x) in fine.iter().enumerate() {
                let exact = value(k as f64 / (7 * count) as f64);
                assert!(
                    (x - exact).abs() < 1e-12,
                    "{count} samples, {k}: {x} {exact}"
                );
            }
        }
    }

    #[test]
    fn a_held_effort_and_a_straight_one_differ_inside_the_step() {
        let protocol = |interpolation| Protocol {
            interpolation,
            substeps: 2,
            ..Protocol::default()
        };
        let effort = [0.3, 1.1, -0.7];
        let held = fine_effort(&effort, &protocol(Interpolation::Hold));
        assert_eq!(held[2..4], [(1.1, 1.1), (1.1, 1.1)]);
        let straight = fine_effort(&effort, &protocol(Interpolation::Linear));
        for ((begin, end), expected) in straight[2..4].iter().zip([(1.1, 0.2), (0.2, -0.7)]) {
            assert!((begin - expected.0).abs() + (end - expected.1).abs() < 1e-12);
        }
    }
}
