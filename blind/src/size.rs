//! This file measures a hidden effect against what the recording's noise allows anybody to see.
//!
//! The unit is the standard deviation of the equivalent effort noise in an average over 80 ms. An effect's
//! generalised force is averaged over the 80 ms blocks in which the mechanism slides; what the nominal model's
//! unknown laws can imitate is taken out by least squares; the rest's root mean square over the blocks where the
//! effect acts, in that unit, is the effect's size.

use crate::law::Law;
use crate::run::Run;
use crate::setup::{Kind, Setup};
use crate::stratum::Stratum;

/// Length of an average, s.
pub const BLOCK_S: f64 = 0.08;
/// Least size of an effect that is called clearly detectable.
pub const CLEAR_SIZE: f64 = 3.0;
/// Least distinctness of an effect in a single, masked or late case.
pub const CLEAR_DISTINCTNESS: f64 = 1.0;
/// Greatest strength of an effect that is called too small: with the whole recording averaged by the best
/// possible filter its signal-to-noise ratio is below one.
pub const FAINT_STRENGTH: f64 = 0.8;

/// How visible one effect is.
#[derive(Clone, Copy, Debug, Default)]
pub struct Size {
    /// Root mean square of what the nominal model cannot imitate, in block noise.
    pub size: f64,
    /// The same after dry friction, damping, bias, a spring and the other hidden effects have imitated it as well.
    pub distinctness: f64,
    /// Signal-to-noise ratio of a matched filter over the whole recording: size times the root of the blocks.
    pub strength: f64,
    /// The lesser of its strengths just before its onset, had it begun by then, and just after it; `None` where it is not asked.
    pub onset_strength: Option<f64>,
}

impl Size {
    /// Whether an effect of this size belongs into a stratum.
    pub fn fits(&self, stratum: Stratum) -> bool {
        match stratum {
            Stratum::Nothing | Stratum::DataFault => true,
            Stratum::TooSmall => self.strength <= FAINT_STRENGTH,
            Stratum::NotInLibrary => self.distinctness >= CLEAR_SIZE,
            Stratum::Unidentifiable | Stratum::WrongInertia => self.size >= CLEAR_SIZE,
            Stratum::Single
            | Stratum::Masked
            | Stratum::LateOnset
            | Stratum::Noisy
            | Stratum::InLoop => self.size >= CLEAR_SIZE && self.distinctness >= CLEAR_DISTINCTNESS,
        }
    }
}

/// Standard deviation of the equivalent effort noise in an 80 ms average, N or N·m.
///
/// Axis: the acceleration fitted to N = 80 ms·rate positions of standard deviation quantum/√12 has the standard
/// deviation √(720/N)·σ/T² (parabola on an even grid), times the inertia; the command adds gain·σ/√N. Bench: σ/√N.
pub fn block_noise(setup: &Setup) -> f64 {
    let count = BLOCK_S * setup.rate_hz;
    match &setup.kind {
        Kind::Axis(drive) => {
            let position = setup.quantum / 12_f64.sqrt();
            let acceleration = (720.0 / count).sqrt() * position / (BLOCK_S * BLOCK_S);
            let command = drive.gain * setup.noise / count.sqrt();
            (drive.inertia * acceleration).hypot(command)
        }
        Kind::Bench(_) => setup.noise / count.sqrt(),
    }
}

/// The sizes of all hidden effects of a run.
pub fn sizes(setup: &Setup, run: &Run, known: &[Law], hidden: &[Law]) -> Vec<Size> {
    let noise = block_noise(setup);
    let blocks = Blocks::new(run, setup.rate_hz);
    let forces: Vec<Vec<f64>> = run.hidden.iter().map(|f| blocks.means(f)).collect();
    let simple: Vec<(&str, Vec<f64>)> = blocks.simple_laws(run);
    let nominal: Vec<&[f64]> = simple
        .iter()
        .filter(|(name, _)| known.iter().any(|law| law.name() == *name))
        .map(|(_, column)| column.as_slice())
        .collect();
    hidden
        .iter()
        .zip(&forces)
        .map(|(law, force)| {
            let others = forces
                .iter()
                .filter(|other| !std::ptr::eq(*other, force))
                .map(Vec::as_slice);
            let imitations: Vec<&[f64]> = simple
                .iter()
                .filter(|(name, _)| !is_own(law, name))
                .map(|(_, column)| column.as_slice())
                .chain(nominal.iter().copied())
                .chain(others)
                .collect();
            let active = force.iter().filter(|f| **f != 0.0).count().max(1) as f64;
            let rms = |columns: &[&[f64]]| (remainder(force, columns) / active).sqrt() / noise;
            let size = rms(&nominal);
            Size {
                size,
                distinctness: rms(&imitations),
                strength: size * active.sqrt(),
                onset_strength: None,
            }
        })
        .collect()
}

/// Whether a simple law is the effect itself, or physically the same as it.
fn is_own(law: &Law, simple: &str) -> bool {
    law.name() == simple || (matches!(law, Law::Asymmetry { .. }) && simple == "constant_bias")
}

/// The 80 ms averages of a run.
struct Blocks {
    length: usize,
    moving: Vec<bool>,
}

impl Blocks {
    fn new(run: &Run, rate_hz: f64) -> Blocks {
        Blocks {
            length: (BLOCK_S * rate_hz).round() as usize,
            moving: run.moving.clone(),
        }
    }

    /// Means over the sliding samples of each block that slides for at least half its time.
    fn means(&self, signal: &[f64]) -> Vec<f64> {
        signal
            .chunks_exact(self.length)
            .zip(self.moving.chunks_exact(self.length))
            .filter_map(|(values, moving)| {
                let sliding = moving.iter().filter(|m| **m).count();
                let sum: f64 = values
                    .iter()
                    .zip(moving)
                    .filter(|(_, moving)| **moving)
                    .map(|(value, _)| value)
                    .sum();
                (2 * sliding >= self.length).then(|| sum / sliding as f64)
            })
            .collect()
    }

    fn simple_laws(&self, run: &Run) -> Vec<(&'static str, Vec<f64>)> {
        let column = |of: fn(f64, f64) -> f64| {
            let values: Vec<f64> = run
                .position
                .iter()
                .zip(&run.velocity)
                .map(|(q, v)| of(*q, *v))
                .collect();
            self.means(&values)
        };
        vec![
            ("dry_offset", column(|_, v| v.signum())),
            ("viscous", column(|_, v| v)),
            ("constant_bias", column(|_, _| 1.0)),
            ("spring", column(|q, _| q)),
        ]
    }
}

/// Sum of squares of what is left of a signal after least squares on columns (modified Gram–Schmidt).
pub fn remainder(signal: &[f64], columns: &[&[f64]]) -> f64 {
    let mut basis: Vec<Vec<f64>> = Vec::new();
    for column in columns {
        let mut direction = column.to_vec();
        let length = dot(&direction, &direction).sqrt();
        remove(&mut direction, &basis);
        let left = dot(&direction, &direction).sqrt();
        if left > 1e-9 * length && left > 0.0 {
            direction.iter_mut().for_each(|x| *x /= left);
            basis.push(direction);
        }
    }
    let mut rest = signal.to_vec();
    remove(&mut rest, &basis);
    dot(&rest, &rest)
}

fn remove(signal: &mut [f64], basis: &[Vec<f64>]) {
    for direction in basis {
        let share = dot(signal, direction);
        for (value, unit) in signal.iter_mut().zip(direction) {
            *value -= share * unit;
        }
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn least_squares_leaves_what_the_columns_cannot_imitate() {
        let line: Vec<f64> = (0..40).map(f64::from).collect();
        let ones = vec![1.0; 40];
        let signal: Vec<f64> = line
            .iter()
            .enumerate()
            .map(|(k, x)| 2.3 + 0.7 * x + if k % 2 == 0 { 0.1 } else { -0.1 })
            .collect();
        let left = remainder(&signal, &[&ones, &line, &ones]);
        assert!((left - 40.0 * 0.01).abs() < 5e-3, "{left}");
        assert!(remainder(&line, &[&line]) < 1e-20);
    }
}
