//! This file is the inverse model by the published protocol of robot identification (Janot,
//! Gautier, Brunot 2019): filter, differentiate, decimate, least squares.

use crate::filter::{LowPass, decimate, gradient};
use crate::plants::joint::run::{JointRun, PlantKind};
use nalgebra::{DMatrix, DVector};
use rigproof_model::bench::column;
use rigproof_model::effects::{Instant, entry, law, linear};
use rigproof_spec::effect::Mechanism;

/// Order of the position filter (Butterworth, forward and backward), as published.
pub const FILTER_ORDER: usize = 4;
/// Cut-off of the position filter, Hz, as published for 1 kHz recordings.
pub const CUTOFF_HZ: f64 = 100.0;
/// Decimation factor, as published.
pub const DECIMATION: usize = 10;
/// Samples dropped at each end, where the filters see no data.
const BORDER: usize = 50;

/// Least-squares parameters and the relative error.
#[derive(Clone, Debug)]
pub struct InverseModel {
    /// Mass or moment of inertia.
    pub inertia: f64,
    /// Linear parameters of each mechanism, in order.
    pub parameters: Vec<(Mechanism, Vec<f64>)>,
    /// 100·‖effort − model‖ / ‖effort‖.
    pub error_percent: f64,
}

/// Fits the inverse model of an axis with these memoryless mechanisms (given with their shapes).
///
/// `None` on a bench, on a recording slower than 400 Hz, or with a mechanism that has memory or
/// acts on the drive.
pub fn inverse_model(run: &JointRun, mechanisms: &[(Mechanism, Vec<f64>)]) -> Option<InverseModel> {
    let rate_hz = 1.0 / run.step_s;
    if run.plant == PlantKind::Bench || !run.parts.is_empty() || rate_hz < 4.0 * CUTOFF_HZ {
        return None;
    }
    let position =
        LowPass::butterworth(FILTER_ORDER, 2.0 * CUTOFF_HZ / rate_hz).zero_phase(&run.position);
    let speed = gradient(&position, run.step_s);
    let acceleration = gradient(&speed, run.step_s);
    let motion: Vec<Instant> = position
        .iter()
        .zip(&speed)
        .enumerate()
        .map(|(k, (&position, &speed))| Instant {
            time_s: run.start_s + k as f64 * run.step_s,
            position,
            speed,
            sense: if speed == 0.0 { 0.0 } else { speed.signum() },
        })
        .collect();
    let mut columns = vec![decimated(&acceleration)];
    for (mechanism, shape) in mechanisms {
        for index in 0..entry(*mechanism)?.linear {
            let mut parameters = vec![0.0; entry(*mechanism)?.linear];
            *parameters.get_mut(index)? = 1.0;
            parameters.extend_from_slice(shape);
            let law = law(*mechanism, &parameters).filter(|law| !law.remembers())?;
            columns.push(decimated(&column(law.as_ref(), &motion, run.step_s)));
        }
    }
    solve(&columns, &decimated(&run.effort), mechanisms)
}

/// The protocol in words.
pub fn protocol() -> String {
    format!(
        "position through a Butterworth low-pass of order {FILTER_ORDER} at {CUTOFF_HZ} Hz, forward and backward; central differences; {BORDER} samples dropped at each end; every {DECIMATION}th sample of all columns after a Chebyshev low-pass of order 8; ordinary least squares of the inertia and of every linear number; 100·‖effort − model‖ / ‖effort‖"
    )
}

fn decimated(signal: &[f64]) -> Vec<f64> {
    let inner = signal
        .get(BORDER..signal.len().saturating_sub(BORDER))
        .unwrap_or_default();
    decimate(inner, DECIMATION)
}

fn solve(
    columns: &[Vec<f64>],
    effort: &[f64],
    mechanisms: &[(Mechanism, Vec<f64>)],
) -> Option<InverseModel> {
    let matrix = DMatrix::from_fn(effort.len(), columns.len(), |i, j| {
        columns
            .get(j)
            .and_then(|c| c.get(i))
            .copied()
            .unwrap_or(0.0)
    });
    let target = DVector::from_column_slice(effort);
    let solution = matrix.clone().svd(true, true).solve(&target, 1e-12).ok()?;
    let error = (&target - &matrix * &solution).norm();
    let mut values = solution.iter().copied();
    let inertia = values.next()?;
    let parameters = mechanisms
        .iter()
        .map(|(m, _)| (*m, values.by_ref().take(linear(*m)).collect()))
        .collect();
    Some(InverseModel {
        inertia,
        parameters,
        error_percent: 100.0 * error / target.norm(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    use crate::plants::joint::recorded::{INERTIA, NOMINAL, exact_axis};

    #[test]
    fn the_inverse_model_of_an_exact_recording_has_its_numbers() {
        let run = exact_axis(NOMINAL, 6100, true);
        let mechanisms = [(Mechanism::Viscous, vec![]), (Mechanism::Spring, vec![])];
        let model = inverse_model(&run, &mechanisms).unwrap();
        let near = |found: f64, planted: f64| {
            assert!((found / planted - 1.0).abs() < 0.01, "{found} {planted}");
        };
        near(model.inertia, INERTIA);
        near(model.parameters[0].1[0], 7.3);
        near(model.parameters[1].1[0], 41.7);
        assert!(model.error_percent < 1.0, "{} %", model.error_percent);
    }
}
