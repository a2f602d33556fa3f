//! This file measures a hidden effect against what the recording's noise allows anybody to see.
//!
//! The unit is the standard deviation of the equivalent effort noise in an average over 80 ms. An effect's
//! generalised force is averaged over the 80 ms blocks in which the mechanism slides; what the nominal model's
//! unknown laws can imitate is taken out by least squares; the rest's root mean square over the blocks where the
//! effect acts, in that unit, is the effect's size.

use crate::forms::Forms;
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
            Stratum::Nothing | Stratum::DataFault | Stratum::Two | Stratum::Three => true,
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

/// How visible the effects of a case are.
#[derive(Clone, Debug)]
pub struct Sizes {
    pub sizes: Vec<Size>,
    /// Standard deviation of the equivalent effort noise in an 80 ms average, N or N·m.
    pub block_noise: f64,
    /// Share of the recording in which something slides.
    pub sliding: f64,
    /// Root mean square of what the nominal equations lack and no hidden effect accounts for, in block noise: the plant's own error.
    pub left: f64,
    /// Root mean square of what the nominal equations lack, over what the noise of the sensors explains; where it is known.
    pub ratio: Option<f64>,
}

/// Least share of a recording in which something slides.
const LEAST_SLIDING: f64 = 0.5;
/// Greatest error of the plant's own, in block noise.
const GREATEST_LEFT: f64 = 0.5;

impl Sizes {
    /// Whether a case with these sizes belongs into a stratum. In other forms an effect that nobody can see is a case like any other.
    pub fn fit(&self, forms: Forms, stratum: Stratum) -> bool {
        let fits = |size: &Size| forms == Forms::Other || size.fits(stratum);
        self.moves() && self.left <= GREATEST_LEFT && self.sizes.iter().all(fits)
    }

    /// Whether the recording moves enough.
    pub fn moves(&self) -> bool {
        self.sliding >= LEAST_SLIDING
    }
}

/// The size of one of the effects' forces, in averages: beside what the nominal model leaves open, and beside what imitates it too.
pub fn measured(
    own: usize,
    forces: &[Vec<f64>],
    nominal: &[&[f64]],
    imitations: &[&[f64]],
    noise: f64,
) -> Size {
    let force = forces.get(own).map_or(&[][..], Vec::as_slice);
    let others = forces.iter().enumerate().filter(|(other, _)| *other != own);
    let mut all = imitations.to_vec();
    all.extend(nominal);
    all.extend(others.map(|(_, force)| force.as_slice()));
    let active = force.iter().filter(|f| **f != 0.0).count().max(1) as f64;
    let rms = |columns: &[&[f64]]| (remainder(force, columns) / active).sqrt() / noise;
    let size = rms(nominal);
    Size {
        size,
        distinctness: rms(&all),
        strength: size * active.sqrt(),
        onset_strength: None,
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
