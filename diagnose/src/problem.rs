//! This file is the regression problem of one recording: what the nominal model leaves over, window by window,
//! and the columns that a mechanism could explain it with.

mod signals;

use crate::filter::gradient;
use crate::run::{PlantKind, Run};
use crate::weak::Windows;
use crate::whiten::{ORDER, Whitener};
use core::cell::RefCell;
use rigproof_model::bench::column;
use rigproof_model::effects::{Form, entry, first_order_lag, law};
use rigproof_spec::effect::Mechanism;
use signals::{numerov, second_difference};
use std::sync::Arc;

pub use signals::{lagged_yield, shifted};

/// One column of the regression over all windows.
#[derive(Clone, Debug)]
pub struct Rows {
    /// Sample by sample.
    pub signal: Vec<f64>,
    /// As averaged by the test function.
    pub raw: Vec<f64>,
    /// After whitening.
    pub white: Vec<f64>,
}

/// A mechanism with its shape fixed: what it adds to the regression.
#[derive(Clone, Debug)]
pub struct Term {
    /// The mechanism.
    pub mechanism: Mechanism,
    /// The parameters that shape it, in the vocabulary's order after the linear ones.
    pub shape: Vec<f64>,
    /// When it begins, s; `None` from the start.
    pub onset_s: Option<f64>,
    /// Columns whose coefficients are the linear parameters.
    pub free: Vec<Arc<Rows>>,
    /// A column that enters with coefficient 1: a change of the drive.
    pub fixed: Option<Arc<Rows>>,
    /// Given values of the linear parameters, where the nominal model states them as known.
    pub known: Option<Vec<f64>>,
}

/// What the nominal model says about one mechanism.
#[derive(Clone, Debug)]
pub struct NominalEffect {
    /// The mechanism.
    pub mechanism: Mechanism,
    /// Its parameters in the vocabulary's order, SI.
    pub parameters: Vec<f64>,
    /// Whether its linear parameters are to be estimated.
    pub unknown: bool,
    /// When it begins, s.
    pub onset_s: Option<f64>,
}

/// The inertia of an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Inertia {
    /// A bench: none.
    None,
    /// Known, kg or kg·m².
    Known(f64),
    /// To be estimated, with a start value.
    Unknown(f64),
}

impl Inertia {
    /// The value that is known or started from, kg or kg·m²; 0 on a bench.
    pub fn start(self) -> f64 {
        match self {
            Inertia::None => 0.0,
            Inertia::Known(value) | Inertia::Unknown(value) => value,
        }
    }
}

/// The regression problem of one recording.
pub struct Problem<'a> {
    /// The recording.
    pub run: &'a Run,
    /// The windows.
    pub windows: Windows,
    /// The noise model.
    pub whitener: Whitener,
    /// Effort less everything the nominal model knows.
    pub target: Rows,
    /// The effort that the nominal model knows, sample by sample: known inertia, predicted effort.
    pub known: Vec<f64>,
    /// The averaged acceleration, when the inertia is to be estimated.
    pub inertia_column: Option<Rows>,
    /// The inertia.
    pub inertia: Inertia,
    /// Predicted standard deviation of one residual from sensor noise alone.
    pub floor: f64,
    /// Terms from the start of the recording that are asked for again and again.
    kept: RefCell<Vec<Term>>,
}

impl<'a> Problem<'a> {
    /// Sets up the problem with a white noise model; `rewhiten` refines it.
    pub fn new(run: &'a Run, windows: Windows, inertia: Inertia) -> Problem<'a> {
        let start = inertia.start();
        let floor = windows.floor(run, start);
        let mut windows = windows;
        if run.plant == PlantKind::Axis {
            windows.avoid_rests(run, floor);
        }
        if let (Some(predicted), Some(_)) = (&run.predicted, &run.current) {
            windows.avoid_steps(predicted, floor);
        }
        let acceleration = second_difference(&run.position, run.step_s);
        let mut known = run
            .predicted
            .clone()
            .unwrap_or_else(|| vec![0.0; run.len()]);
        if let Inertia::Known(value) = inertia {
            add(&mut known, &acceleration, value);
        }
        let target: Vec<f64> = acting_effort(run, &run.effort)
            .iter()
            .zip(&known)
            .map(|(e, k)| e - k)
            .collect();
        let covariance = windows.noise_covariance(run, start, 0.0, ORDER + 1);
        let whitener = Whitener::new(&covariance, &windows.usable);
        let mut problem = Problem {
            run,
            whitener,
            target: rows(&windows, target),
            known,
            inertia_column: matches!(inertia, Inertia::Unknown(_))
                .then(|| rows(&windows, acceleration)),
            inertia,
            floor,
            windows,
            kept: RefCell::default(),
        };
        problem.whiten_own();
        problem
    }

    /// Refines the noise model: what these residuals have beyond the floor counts as unexplained white effort.
    ///
    /// `rms` is the root mean square of the residuals over the usable windows.
    pub fn rewhiten(&mut self, rms: f64) {
        let excess = (rms * rms - self.floor * self.floor).max(0.0);
        let inertia = self.inertia.start();
        let covariance = self
            .windows
            .noise_covariance(self.run, inertia, excess, ORDER + 1);
        self.whitener = Whitener::new(&covariance, &self.windows.usable);
        self.whiten_own();
        let mut kept = self.kept.take();
        for term in &mut kept {
            self.refresh(term);
        }
        self.kept = RefCell::new(kept);
    }

    /// A column given window by window.
    pub fn rows_of(&self, raw: Vec<f64>) -> Rows {
        Rows {
            signal: Vec::new(),
            white: self.whitener.whiten(&raw),
            raw,
        }
    }

    fn whiten_own(&mut self) {
        self.target.white = self.whitener.whiten(&self.target.raw);
        if let Some(column) = &mut self.inertia_column {
            column.white = self.whitener.whiten(&column.raw);
        }
    }

    /// The term of a resistance with this shape; `None` for a mechanism that acts on the drive.
    pub fn term(&self, mechanism: Mechanism, shape: &[f64], onset_s: Option<f64>) -> Option<Term> {
        let entry = entry(mechanism)?;
        if let Form::Drive = entry.form {
            return None;
        }
        let free = match (self.kept(mechanism, shape), onset_s) {
            (Some(kept), None) => return Some(kept),
            (Some(kept), onset_s) => kept
                .free
                .iter()
                .map(|rows| Arc::new(self.rows(rows.signal.clone(), onset_s)))
                .collect(),
            (None, onset_s) => self
                .resistance_columns(mechanism, entry.linear, shape)
                .into_iter()
                .map(|signal| Arc::new(self.rows(self.seen(signal), onset_s)))
                .collect(),
        };
        Some(Term {
            mechanism,
            shape: shape.to_vec(),
            onset_s,
            free,
            fixed: None,
            known: None,
        })
    }

    /// The term of a resistance that acts from the start, kept for the next time: for shapes that are tried in every
    /// step of the search.
    pub fn kept_term(&self, mechanism: Mechanism, shape: &[f64]) -> Option<Term> {
        self.kept(mechanism, shape).or_else(|| {
            let term = self.term(mechanism, shape, None)?;
            self.kept.borrow_mut().push(term.clone());
            Some(term)
        })
    }

    fn kept(&self, mechanism: Mechanism, shape: &[f64]) -> Option<Term> {
        let kept = self.kept.borrow();
        let same = |t: &&Term| t.mechanism == mechanism && t.shape == shape;
        kept.iter().find(same).cloned()
    }

    /// The term of a change of the drive, linearised about `fitted`: the effort, sample by sample, that the model
    /// gives with the other terms. `None` where the mechanism has no meaning on this plant.
    ///
    /// The recorded effort stays the target and the model's side is changed, because a change of the target
    /// would make every residual small that the change itself makes small.
    pub fn drive_term(
        &self,
        mechanism: Mechanism,
        shape: &[f64],
        onset_s: Option<f64>,
        fitted: &[f64],
    ) -> Option<Term> {
        let (free, fixed) = self.drive_columns(mechanism, shape, fitted)?;
        Some(Term {
            mechanism,
            shape: shape.to_vec(),
            onset_s,
            free: free
                .map(|signal| Arc::new(self.rows(signal, onset_s)))
                .into_iter()
                .collect(),
            fixed: fixed.map(|signal| Arc::new(self.rows(signal, onset_s))),
            known: None,
        })
    }

    /// A term of the nominal model: its columns where unknown, else its value as a fixed column.
    pub fn nominal_term(&self, effect: &NominalEffect) -> Option<Term> {
        let linear = entry(effect.mechanism)?.linear;
        let shape = effect.parameters.get(linear..).unwrap_or_default();
        let mut term = self.term(effect.mechanism, shape, effect.onset_s)?;
        if !effect.unknown {
            term.known = Some(effect.parameters.iter().take(linear).copied().collect());
        }
        Some(term)
    }

    /// Whitens a term again after the noise model changed.
    pub fn refresh(&self, term: &mut Term) {
        for rows in term.free.iter_mut().chain(&mut term.fixed) {
            let white = self.whitener.whiten(&rows.raw);
            Arc::make_mut(rows).white = white;
        }
    }

    /// One column for each linear parameter: the law with that parameter 1 and the others 0.
    fn resistance_columns(
        &self,
        mechanism: Mechanism,
        linear: usize,
        shape: &[f64],
    ) -> Vec<Vec<f64>> {
        (0..linear)
            .filter_map(|index| {
                let mut parameters = vec![0.0; linear];
                if let Some(one) = parameters.get_mut(index) {
                    *one = 1.0;
                }
                parameters.extend_from_slice(shape);
                law(mechanism, &parameters)
            })
            .map(|law| column(law.as_ref(), &self.run.motion, self.run.step_s))
            .collect()
    }

    /// A resistance as the discrete second difference of the position sees it: on an axis with Numerov's weights,
    /// exact to fourth order in the step for a signal that is smooth between samples.
    fn seen(&self, signal: Vec<f64>) -> Vec<f64> {
        match self.run.plant {
            PlantKind::Axis => numerov(&signal),
            PlantKind::Bench => signal,
        }
    }

    fn rows(&self, mut signal: Vec<f64>, onset_s: Option<f64>) -> Rows {
        if let Some(onset_s) = onset_s {
            let first = self.run.sample_at(onset_s);
            signal.iter_mut().take(first).for_each(|x| *x = 0.0);
        }
        let mut rows = rows(&self.windows, signal);
        rows.white = self.whitener.whiten(&rows.raw);
        rows
    }

    /// What a recorded drive has more than the one that acts, as the position sees it.
    fn missing_effort(&self, acting: &[f64]) -> Vec<f64> {
        let missing: Vec<f64> = self
            .run
            .effort
            .iter()
            .zip(acting)
            .map(|(e, a)| e - a)
            .collect();
        acting_effort(self.run, &missing)
    }

    /// Column of a mechanism that acts on the drive: a free one, or one with coefficient 1.
    #[expect(
        clippy::type_complexity,
        reason = "a pair of columns is plainer than a type for it"
    )]
    fn drive_columns(
        &self,
        mechanism: Mechanism,
        shape: &[f64],
        fitted: &[f64],
    ) -> Option<(Option<Vec<f64>>, Option<Vec<f64>>)> {
        let value = shape.first().copied().unwrap_or(0.0);
        let step_s = self.run.step_s;
        let less = |changed: Vec<f64>| -> Vec<f64> {
            changed.iter().zip(fitted).map(|(a, b)| a - b).collect()
        };
        match (mechanism, self.run.plant) {
            // With a known inertia the command itself can be delayed: it has less noise than an acceleration.
            (Mechanism::Lag, PlantKind::Axis) if self.inertia_column.is_none() => {
                let acting = first_order_lag(&self.run.effort, step_s, value);
                Some((None, Some(self.missing_effort(&acting))))
            }
            (Mechanism::ChannelSkew, PlantKind::Axis) if self.inertia_column.is_none() => {
                let acting = shifted(&self.run.effort, -value / step_s);
                Some((None, Some(self.missing_effort(&acting))))
            }
            // Else the command is ahead of the effort that moves the joint: gain·u = e + time_constant·de/dt.
            (Mechanism::Lag, PlantKind::Axis) => {
                let slope = gradient(fitted, step_s);
                Some((None, Some(slope.into_iter().map(|s| value * s).collect())))
            }
            (Mechanism::ChannelSkew, PlantKind::Axis) => {
                Some((None, Some(less(shifted(fitted, value / step_s)))))
            }
            // The yield of a brake lags, its sign does not (docs/decisions/0001).
            (Mechanism::Lag, PlantKind::Bench) => match (&self.run.predicted, &self.run.current) {
                (Some(predicted), Some(_)) => {
                    let lagged = lagged_yield(predicted, step_s, value);
                    let change = lagged.iter().zip(predicted).map(|(l, p)| l - p).collect();
                    Some((None, Some(change)))
                }
                _ => Some((None, Some(less(first_order_lag(fitted, step_s, value))))),
            },
            (Mechanism::ChannelSkew, PlantKind::Bench) => {
                Some((None, Some(less(shifted(fitted, -value / step_s)))))
            }
            (Mechanism::GainError, _) if self.inertia_column.is_none() => {
                Some((Some(self.known.clone()), None))
            }
            _ => None,
        }
    }
}

/// A signal with its averages; not yet whitened.
fn rows(windows: &Windows, signal: Vec<f64>) -> Rows {
    Rows {
        raw: windows.average(&signal),
        signal,
        white: Vec::new(),
    }
}

/// The effort as the discrete second difference of the position sees it: half of the last value and half of this
/// one for a drive that holds, Numerov's weights for one that was sampled; the metered effort itself on a bench.
fn acting_effort(run: &Run, effort: &[f64]) -> Vec<f64> {
    match (run.plant, run.held) {
        (PlantKind::Bench, _) => effort.to_vec(),
        (PlantKind::Axis, true) => {
            let before = effort.first().into_iter().chain(effort);
            before.zip(effort).map(|(b, e)| 0.5 * (b + e)).collect()
        }
        (PlantKind::Axis, false) => numerov(effort),
    }
}

/// Adds `times` a signal to another.
pub fn add(to: &mut [f64], what: &[f64], times: f64) {
    for (x, y) in to.iter_mut().zip(what) {
        *x += times * y;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    use crate::recorded::{INERTIA, NOMINAL, exact_axis};
    use crate::regression::reduced_target;
    use crate::run::rms;

    /// The residual of the usable windows when the nominal model knows everything, over the effort.
    fn relative_residual(run: &Run) -> f64 {
        let mut laws = NOMINAL.to_vec();
        laws.push((Mechanism::DryOffset, &[1.73]));
        let problem = Problem::new(run, Windows::new(run, 0.077), Inertia::Known(INERTIA));
        let terms: Vec<Term> = laws
            .iter()
            .filter_map(|(mechanism, parameters)| {
                problem.nominal_term(&NominalEffect {
                    mechanism: *mechanism,
                    parameters: parameters.to_vec(),
                    unknown: false,
                    onset_s: None,
                })
            })
            .collect();
        assert_eq!(terms.len(), 3);
        let residual = reduced_target(&problem, &terms.iter().collect::<Vec<_>>()).raw;
        // The exact motion knows its sense everywhere: windows that hold a reversal are left out here.
        let senses: Vec<f64> = run.motion.iter().map(|now| now.sense).collect();
        let half = problem.windows.bump.len() / 2 + 2;
        let away: Vec<f64> = residual
            .iter()
            .zip(&problem.windows.centres)
            .filter(|(_, c)| {
                senses[**c + 1 - half..**c + half]
                    .iter()
                    .all(|s| *s != 0.0 && *s == senses[**c])
            })
            .map(|(r, _)| *r)
            .collect();
        assert!(away.len() > 100, "{} windows", away.len());
        rms(&away) / rms(&run.effort)
    }

    #[test]
    fn the_weak_form_holds_on_exact_motion_and_only_with_the_right_drive() {
        let mut laws = NOMINAL.to_vec();
        laws.push((Mechanism::DryOffset, &[1.73]));
        // Under a held drive the acceleration jumps at every sample, which costs Numerov's weights an order.
        for (held, most) in [(true, 1e-5), (false, 1e-6)] {
            let mut run = exact_axis(&laws, 5300, held);
            let right = relative_residual(&run);
            assert!(right < most, "held {held}: {right:e}");
            run.held = !held;
            let wrong = relative_residual(&run);
            assert!(
                wrong > 100.0 * right,
                "held {held}: {wrong:e} against {right:e}"
            );
        }
    }

    #[test]
    fn numerov_averages_a_fourth_order_polynomial_as_its_double_integral_does() {
        // f = t²; its double integral t⁴/12 has the second difference t² + 1/6.
        let f: Vec<f64> = (0..9).map(|k| (k as f64 + 0.37).powi(2)).collect();
        let twice: Vec<f64> = (0..9).map(|k| (k as f64 + 0.37).powi(4) / 12.0).collect();
        let (seen, accelerated) = (numerov(&f), second_difference(&twice, 1.0));
        for k in 1..8 {
            assert!((seen[k] - accelerated[k]).abs() < 1e-11, "{k}");
        }
    }

    #[test]
    fn a_shifted_signal_reads_between_its_samples_and_holds_its_ends() {
        let signal = [0.3, 1.7, -2.9, 4.1];
        let ahead = shifted(&signal, 0.25);
        let expected = [0.65, 0.55, -1.15, 4.1];
        for (a, e) in ahead.iter().zip(expected) {
            assert!((a - e).abs() < 1e-12, "{a} {e}");
        }
    }
}
