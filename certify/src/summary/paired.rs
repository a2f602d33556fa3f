//! This file says whether a metric became better or worse: paired over the scenarios, with a bootstrap interval.

use serde::{Deserialize, Serialize};

use super::exact::{Exact, exact};
use crate::scenario::Draw;

/// Resamples of the bootstrap.
const RESAMPLES: usize = 1000;
/// Fewest pairs of which anything is said.
const FEWEST: usize = 8;

/// The change of a metric from the baseline to the controller.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Change {
    /// Scenarios in which both have it.
    pub pairs: u64,
    /// Mean of the differences, controller less baseline.
    pub mean: f64,
    /// Its 95 % interval, by the percentiles of the bootstrap (Efron 1979).
    pub interval: [f64; 2],
    /// What that says.
    pub word: Word,
    /// The same pairs, compared exactly.
    pub exact: Exact,
}

/// What a change is; less is better.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Word {
    /// The whole interval is below zero.
    Better,
    /// The whole interval is above zero.
    Worse,
    /// Zero is in it.
    NoDifference,
}

/// The change over pairs of baseline and controller; `None` of too few.
pub fn change(pairs: &[[f64; 2]], seed: u64) -> Option<Change> {
    if pairs.len() < FEWEST {
        return None;
    }
    let differences: Vec<f64> = pairs.iter().map(|[before, after]| after - before).collect();
    let count = u32::try_from(differences.len()).ok()?;
    let mean = |sum: f64| sum / f64::from(count);
    let mut draw = Draw::new(seed, 0x0b00_7574);
    let mut means: Vec<f64> = (0..RESAMPLES)
        .map(|_| {
            let one = |_| differences.get(draw.below(count) as usize).unwrap_or(&0.0);
            mean((0..count).map(one).sum())
        })
        .collect();
    means.sort_by(f64::total_cmp);
    let at = |share: f64| means.get((share * RESAMPLES as f64) as usize).copied();
    let interval = [at(0.025)?, at(0.975)?];
    let [low, high] = interval;
    let word = if high < 0.0 {
        Word::Better
    } else if low > 0.0 {
        Word::Worse
    } else {
        Word::NoDifference
    };
    Some(Change {
        pairs: differences.len() as u64,
        mean: mean(differences.iter().sum()),
        interval,
        word,
        exact: exact(&differences)?,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Pairs whose differences are noise about a mean.
    fn pairs(mean: f64) -> Vec<[f64; 2]> {
        let mut draw = Draw::new(17, 3);
        let mut pair = || {
            let before = draw.between(0.3, 0.9);
            [before, before + mean + draw.between(-0.1, 0.1)]
        };
        (0..200).map(|_| pair()).collect()
    }

    #[test]
    fn a_change_is_told_from_none() {
        let of = |mean| change(&pairs(mean), 5).unwrap();
        assert_eq!(of(0.03).word, Word::Worse);
        assert_eq!(of(-0.03).word, Word::Better);
        let change = super::change(&pairs(0.0), 5).unwrap();
        assert!(change.interval[0] < change.mean && change.mean < change.interval[1]);
        // 0.1/√3 over √200, times 1.96 on both sides.
        assert!((change.interval[1] - change.interval[0] - 0.016).abs() < 0.003);
    }

    #[test]
    fn of_a_few_pairs_nothing_is_said() {
        assert_eq!(change(&pairs(0.03)[..7], 5), None);
    }
}
