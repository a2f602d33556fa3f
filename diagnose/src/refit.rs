//! This file adjusts the plant's numbers so that its free run meets the recording (output error).

use crate::run::{PlantKind, Run};
use crate::simulate::{Plant, Protocol, output};
use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt};
use nalgebra::{DMatrix, DVector, Dyn, Owned};

/// Which number of a plant is adjusted, and over what distance it is felt.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Free {
    /// `None` for the inertia, else the effect's index and the parameter's index in it.
    pub place: Option<(usize, usize)>,
    /// Scale of the number.
    pub scale: f64,
}

/// The outcome of an output-error refit.
#[derive(Clone, Debug)]
pub struct Refit {
    /// The adjusted plant.
    pub plant: Plant,
    /// Root-mean-square error of the free run before and after.
    pub before: f64,
    /// After.
    pub after: f64,
}

/// Adjusts the free numbers of a plant over a recording.
pub fn refit(plant: &Plant, free: &[Free], run: &Run, protocol: &Protocol) -> Refit {
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
        before,
        after: before,
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
    let after = error_rms(&found, run, protocol);
    // A refit that made it worse is no refit.
    if after.is_nan() || after > before {
        return unchanged;
    }
    Refit {
        plant: found,
        before,
        after,
    }
}

/// Samples whose error counts: past those that gave the start state, and recorded ones only.
fn counted(run: &Run, protocol: &Protocol) -> usize {
    if protocol.warm_up_periods > 0 || run.plant == PlantKind::Bench {
        0
    } else {
        protocol.start_samples
    }
}

/// Simulated less recorded output, one value a counted sample.
pub fn errors(plant: &Plant, run: &Run, protocol: &Protocol) -> Vec<f64> {
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

/// Root-mean-square error of the free run over the counted samples.
pub fn error_rms(plant: &Plant, run: &Run, protocol: &Protocol) -> f64 {
    crate::run::rms(&errors(plant, run, protocol))
}

struct OutputError<'a> {
    start: &'a Plant,
    free: &'a [Free],
    run: &'a Run,
    protocol: &'a Protocol,
    /// Departure from the start in units of each number's scale.
    x: DVector<f64>,
}

/// Difference step of the sensitivities, in scales.
const STEP: f64 = 1e-3;

impl OutputError<'_> {
    fn plant(&self) -> Plant {
        self.plant_at(&self.x)
    }

    fn plant_at(&self, x: &DVector<f64>) -> Plant {
        let mut plant = self.start.clone();
        for (free, departure) in self.free.iter().zip(x.iter()) {
            let number = match free.place {
                None => Some(&mut plant.inertia),
                Some((effect, parameter)) => plant
                    .effects
                    .get_mut(effect)
                    .and_then(|e| e.parameters.get_mut(parameter)),
            };
            if let Some(number) = number {
                *number += departure * free.scale;
            }
        }
        plant.inertia = plant.inertia.max(1e-3 * self.start.inertia);
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
