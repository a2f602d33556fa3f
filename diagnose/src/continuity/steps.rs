//! This file compares each step of a position with its neighbours.

use super::{Position, Stamps};
use crate::rules::{
    BLOCK_STEPS, JUMP_QUANTA, JUMP_SIGMAS, LATE_SAMPLE, STEP_TIMES, STEPS_AROUND, USUAL_QUANTILE,
};

/// The steps between the recorded samples of a position.
pub struct Steps {
    /// The recorded samples.
    pub index: Vec<usize>,
    /// The step to the next recorded sample per sample interval, m or rad.
    pub step: Vec<f64>,
    /// The number of sample intervals in each step.
    pub places: Vec<f64>,
}

impl Steps {
    pub fn of(stamps: Stamps<'_>, own: &Position) -> Steps {
        let samples = own.samples.iter().enumerate();
        let known: Vec<(usize, f64)> = samples
            .filter(|(_, x)| !x.is_nan())
            .map(|(k, x)| (k, *x))
            .collect();
        let pairs = || {
            known.windows(2).filter_map(|pair| match pair {
                [(k, from), (next, to)] => Some((stamps.places(*k, *next), to - from)),
                _ => None,
            })
        };
        Steps {
            index: known.iter().map(|(k, _)| *k).collect(),
            step: pairs().map(|(places, step)| step / places).collect(),
            places: pairs().map(|(places, _)| places).collect(),
        }
    }

    /// The step that the neighbours suggest, and their scatter.
    pub fn expected(&self, j: usize) -> (f64, f64) {
        let before = self.step.get(j.saturating_sub(STEPS_AROUND)..j);
        let after = self
            .step
            .get(j + 1..(j + 1 + STEPS_AROUND).min(self.step.len()));
        let around = [before.unwrap_or_default(), after.unwrap_or_default()].concat();
        let middle = median(around.clone());
        let apart = around.iter().map(|s| (s - middle).abs()).collect();
        (middle, median(apart))
    }

    /// The mean step before one sample and after another.
    pub fn beside(&self, j: usize, next: usize) -> [f64; 2] {
        let before = self.step.get(j.saturating_sub(STEPS_AROUND)..j);
        let after = self
            .step
            .get(next..(next + STEPS_AROUND).min(self.step.len()));
        [before, after].map(|own| median(own.unwrap_or_default().to_vec()))
    }

    /// The excess of each step over the one that its neighbours suggest, and the greatest excess
    /// that is no jump.
    pub fn excesses(&self, own: &Position) -> Vec<(f64, f64)> {
        let each = (0..self.step.len()).map(|j| {
            let (middle, apart) = self.expected(j);
            (self.step.get(j).unwrap_or(&0.0) - middle, apart)
        });
        let each: Vec<(f64, f64)> = each.collect();
        let usual: Vec<f64> = each
            .chunks(BLOCK_STEPS)
            .map(|block| usual(block.iter().map(|(excess, _)| excess.abs()).collect()))
            .collect();
        let near = |block: usize| {
            let blocks = usual.get(block.saturating_sub(1)..(block + 2).min(usual.len()));
            blocks
                .unwrap_or_default()
                .iter()
                .copied()
                .fold(0.0, f64::max)
        };
        let least = (JUMP_QUANTA * own.quantum).max(JUMP_SIGMAS * own.noise);
        each.iter()
            .enumerate()
            .map(|(j, (excess, apart))| {
                let times = STEP_TIMES * apart.max(near(j / BLOCK_STEPS));
                let late = LATE_SAMPLE * self.expected(j).0.abs();
                (*excess, times.max(least).max(late))
            })
            .collect()
    }
}

/// The median; 0 of none.
pub fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    let half = values.len() / 2;
    let at = |k: usize| values.get(k).copied().unwrap_or(0.0);
    match values.len() % 2 {
        0 if half > 0 => 0.5 * (at(half - 1) + at(half)),
        _ => at(half),
    }
}

fn usual(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    let k = (USUAL_QUANTILE * values.len() as f64) as usize;
    values.get(k).or(values.last()).copied().unwrap_or(0.0)
}
