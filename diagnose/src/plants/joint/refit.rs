//! This file fits the plant's parameters so that its free run matches the recording (output error).

use crate::plants::joint::run::{JointRun, PlantKind};
use crate::plants::joint::simulate::{Model, Protocol, output};
use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt};
use nalgebra::{DMatrix, DVector, Dyn, Owned};
use rigproof_spec::effect::Range;

/// A parameter that is fitted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Free {
    /// `None` for the inertia, otherwise the index of the effect and of its parameter.
    pub place: Option<(usize, usize)>,
    /// The size of change that the fit uses as a unit.
    pub scale: f64,
}

/// The outcome of an output-error refit.
#[derive(Clone, Debug)]
pub struct Refit {
    /// The refitted plant.
    pub plant: Model,
    /// Root-mean-square error of its free run.
    pub error: f64,
}

/// Fits the free parameters of a plant to a recording.
pub fn refit(plant: &Model, free: &[Free], run: &JointRun, protocol: &Protocol) -> Refit {
    let problem = OutputError {
        start: plant,
        free,
        run,
        protocol,
        x: DVector::zeros(free.len()),
    };
    let before = error_rms(plant, run, protocol);
    let unchanged = Refit {
        plant: plant.clone(),
        error: before,
    };
    if free.is_empty() {
        return unchanged;
    }
    let (solved, _) = LevenbergMarquardt::new()
        .with_stepbound(1.0)
        .with_patience(30)
        .with_ftol(1e-9)
        .with_xtol(1e-9)
        .with_gtol(0.0)
        .minimize(problem);
    let found = solved.plant();
    let error = error_rms(&found, run, protocol);
    // A refit that made the error larger is discarded.
    if error.is_nan() || error > before {
        return unchanged;
    }
    Refit {
        plant: found,
        error,
    }
}

/// The first sample whose error counts: those before it gave the start state.
fn counted(run: &JointRun, protocol: &Protocol) -> usize {
    if protocol.warm_up_periods > 0 || run.plant == PlantKind::Bench {
        0
    } else {
        protocol.start_samples
    }
}

/// Simulated less recorded output, one value for each sample that counts.
pub fn errors(plant: &Model, run: &JointRun, protocol: &Protocol) -> Vec<f64> {
    let simulated = output(plant, run, protocol);
    let recorded = match run.plant {
        PlantKind::Axis => &run.position,
        PlantKind::Bench => &run.effort,
    };
    simulated
        .iter()
        .zip(recorded)
        .zip(&run.recorded)
        .skip(counted(run, protocol))
        .map(|((s, r), ok)| if *ok { s - r } else { 0.0 })
        .collect()
}

/// Root-mean-square error of the free run over the samples that count.
pub fn error_rms(plant: &Model, run: &JointRun, protocol: &Protocol) -> f64 {
    crate::filter::rms(&errors(plant, run, protocol))
}

struct OutputError<'a> {
    start: &'a Model,
    free: &'a [Free],
    run: &'a JointRun,
    protocol: &'a Protocol,
    /// Departure from the start value, in units of each parameter's scale.
    x: DVector<f64>,
}

/// The nearest number that has a meaning; what must be above zero keeps a thousandth of where it
/// started.
fn within(range: Range, number: f64, start: f64) -> f64 {
    let [least, most] = range.ends();
    let least = match range {
        Range::Sign => return start,
        Range::AboveZero => 1e-3 * start,
        _ => least,
    };
    number.max(least).min(most)
}

/// Step of the finite differences, in scales.
const STEP: f64 = 1e-3;

impl OutputError<'_> {
    fn plant(&self) -> Model {
        self.plant_at(&self.x)
    }

    fn plant_at(&self, x: &DVector<f64>) -> Model {
        let mut plant = self.start.clone();
        for (free, departure) in self.free.iter().zip(x.iter()) {
            let moved = |number: f64| number + departure * free.scale;
            let Some((effect, parameter)) = free.place else {
                plant.inertia = moved(plant.inertia);
                continue;
            };
            let own = plant.effects.get_mut(effect);
            let Some(own) = own else { continue };
            let range = own.mechanism().parameters().get(parameter);
            let range = range.map_or(Range::Any, |own| own.range);
            if let Some(number) = own.parameters.get_mut(parameter) {
                *number = within(range, moved(*number), *number);
            }
        }
        plant.inertia = within(Range::AboveZero, plant.inertia, self.start.inertia);
        plant
    }

    fn errors_at(&self, x: &DVector<f64>) -> DVector<f64> {
        DVector::from_vec(errors(&self.plant_at(x), self.run, self.protocol))
    }
}

impl LeastSquaresProblem<f64, Dyn, Dyn> for OutputError<'_> {
    type ParameterStorage = Owned<f64, Dyn>;
    type ResidualStorage = Owned<f64, Dyn>;
    type JacobianStorage = Owned<f64, Dyn, Dyn>;

    fn set_params(&mut self, x: &DVector<f64>) {
        self.x.copy_from(x);
    }

    fn params(&self) -> DVector<f64> {
        self.x.clone()
    }

    fn residuals(&self) -> Option<DVector<f64>> {
        let errors = self.errors_at(&self.x);
        errors.iter().all(|e| e.is_finite()).then_some(errors)
    }

    #[expect(
        clippy::indexing_slicing,
        reason = "an index below the vector's own length"
    )]
    fn jacobian(&self) -> Option<DMatrix<f64>> {
        let columns: Vec<DVector<f64>> = (0..self.x.len())
            .map(|k| {
                let mut ahead = self.x.clone();
                let mut behind = self.x.clone();
                ahead[k] += STEP;
                behind[k] -= STEP;
                (self.errors_at(&ahead) - self.errors_at(&behind)) / (2.0 * STEP)
            })
            .collect();
        let jacobian = DMatrix::from_columns(&columns);
        jacobian.iter().all(|e| e.is_finite()).then_some(jacobian)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    use crate::effect::Effect;
    use crate::plants::joint::recorded::{INERTIA, NOMINAL, exact_axis};
    use rigproof_spec::effect::Mechanism;

    fn plant(inertia: f64, viscous: f64, dry: f64) -> Model {
        let effect = |mechanism, value: f64| Effect::of(mechanism, &[value]);
        Model {
            inertia,
            described: 2,
            effects: vec![
                effect(Mechanism::Viscous, viscous),
                effect(Mechanism::Spring, 41.7),
                effect(Mechanism::DryOffset, dry),
            ],
        }
    }

    #[test]
    fn a_refit_of_the_free_run_recovers_planted_numbers() {
        let mut laws = NOMINAL.to_vec();
        laws.push((Mechanism::DryOffset, &[1.73]));
        let run = exact_axis(&laws, 2900, true);
        let free = [
            Free {
                place: None,
                scale: 0.027,
            },
            Free {
                place: Some((0, 0)),
                scale: 0.13,
            },
            Free {
                place: Some((2, 0)),
                scale: 0.034,
            },
        ];
        let start = plant(1.19, 8.1, 1.31);
        let protocol = Protocol::default();
        let before = error_rms(&start, &run, &protocol);
        let refitted = refit(&start, &free, &run, &protocol);
        let numbers = [
            (refitted.plant.inertia, INERTIA),
            (refitted.plant.effects[0].parameters[0], 7.3),
            (refitted.plant.effects[1].parameters[0], 41.7),
            (refitted.plant.effects[2].parameters[0], 1.73),
        ];
        for (found, planted) in numbers {
            assert!((found / planted - 1.0).abs() < 2e-3, "{found} {planted}");
        }
        assert!(
            refitted.error < 1e-2 * before,
            "{} {before}",
            refitted.error
        );
    }

    #[test]
    fn a_refit_without_free_numbers_changes_nothing() {
        let run = exact_axis(NOMINAL, 700, true);
        let start = plant(1.19, 8.1, 1.31);
        let refitted = refit(&start, &[], &run, &Protocol::default());
        assert_eq!(refitted.plant, start);
        assert_eq!(
            refitted.error,
            error_rms(&start, &run, &Protocol::default())
        );
    }
}
