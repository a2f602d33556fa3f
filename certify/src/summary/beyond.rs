//! This file says of every limit of `certify.toml` what a metric comes to beside it, and whether it holds.

use serde::{Deserialize, Serialize};

use super::paired::Change;
use crate::metrics::Metric;

/// A kind of limit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Bound {
    /// `[limits]`: what 95 of 100 trials must not exceed.
    Trials,
    /// `[regressions]`: by how much the mean may be worse than the baseline's.
    Mean,
}

/// A limit that was given, and what stands beside it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Limited {
    /// Which limit.
    pub bound: Bound,
    /// What is set beside it, in the metric's unit: what 95 of 100 trials do not exceed, or the upper end of the change's interval. None where there
    /// is too little to measure.
    pub value: Option<f64>,
    /// The limit.
    pub most: f64,
    /// Whether it holds.
    pub holds: bool,
    /// That as a sentence.
    pub words: String,
}

/// Of the trials' values those that the limit is about; `trials` is of how many they are.
pub fn of_trials(metric: Metric, own: &[f64], trials: usize, most: f64) -> Limited {
    let inside = own.iter().filter(|value| **value <= most).count();
    let holds = trials > 0 && inside * 100 >= trials * 95;
    let mut sorted = own.to_vec();
    sorted.sort_by(f64::total_cmp);
    // The fewest trials that are 95 of 100.
    let place = (trials * 95).div_ceil(100).checked_sub(1);
    let value = place.and_then(|place| sorted.get(place)).copied();
    let (key, unit) = (metric.key(), metric.unit());
    let is = match (value, metric) {
        (Some(value), _) => format!("95 of 100 trials come to {} {unit}", shown(value, most)),
        (None, Metric::Finish) if trials > 0 => {
            format!(
                "only {} of {trials} trials came to the path's end",
                own.len()
            )
        }
        (None, _) => "no trial was measured".to_owned(),
    };
    Limited {
        bound: Bound::Trials,
        value,
        most,
        holds,
        words: format!("{key}: {is}, where certify.toml allows {most} {unit}"),
    }
}

/// The change from the baseline, beside what the mean may be worse by.
pub fn of_mean(metric: Metric, change: Option<&Change>, most: f64) -> Limited {
    let value = change.map(|change| {
        let [_, high] = change.interval;
        high
    });
    let (key, unit) = (metric.key(), metric.unit());
    let is = match value {
        Some(high) => format!(
            "the mean may be worse than the baseline's by {} {unit}, the upper end of its 95 % interval",
            shown(high, most)
        ),
        None => {
            "too few trials stand beside the baseline to say how much worse the mean is".to_owned()
        }
    };
    Limited {
        bound: Bound::Mean,
        value,
        most,
        holds: value.is_some_and(|high| high <= most),
        words: format!("{key}: {is}, where certify.toml allows {most} {unit}"),
    }
}

/// A value in four digits, or in all of them where four would not show on which side of the limit it is.
fn shown(value: f64, most: f64) -> f64 {
    let short = format!("{value:.3e}").parse().unwrap_or(value);
    let is_told = (short > most) == (value > most);
    if is_told { short } else { value }
}

#[cfg(test)]
mod tests {
    use super::super::exact::exact;
    use super::super::paired::Word;
    use super::*;

    #[test]
    fn what_95_of_100_trials_come_to_is_said() {
        let own: Vec<f64> = (0..40).map(|k| 0.7 + 0.01 * f64::from(k)).collect();
        // The 38th of 40 is what 95 of 100 do not exceed.
        let within = of_trials(Metric::TipForce, &own, 40, 1.071);
        assert!(within.holds && within.value == Some(0.7 + 0.01 * 37.0));
        assert_eq!(
            within.words,
            "tip_force_n: 95 of 100 trials come to 1.07 N, where certify.toml allows 1.071 N"
        );
        let beyond = of_trials(Metric::TipForce, &own, 40, 1.069);
        assert!(!beyond.holds && beyond.bound == Bound::Trials);
        assert_eq!(
            beyond.words,
            "tip_force_n: 95 of 100 trials come to 1.07 N, where certify.toml allows 1.069 N"
        );
        let unmeasured = of_trials(Metric::TipForce, &[], 0, 1.069);
        assert!(!unmeasured.holds && unmeasured.words.contains("no trial was measured"));
        let late = of_trials(Metric::Finish, &own, 60, 9.3);
        assert!(!late.holds);
        assert_eq!(
            late.words,
            "finish_s: only 40 of 60 trials came to the path's end, where certify.toml allows 9.3 s"
        );
    }

    #[test]
    fn by_how_much_the_mean_may_be_worse_is_said() {
        let change = Change {
            pairs: 48,
            mean: 0.31,
            interval: [0.17, 0.430_000_1],
            word: Word::Worse,
            exact: exact(&[0.2, 0.3, 0.5]).unwrap(),
        };
        let within = of_mean(Metric::TipForce, Some(&change), 0.431);
        assert!(within.holds && within.words.contains("by 0.43 N"));
        let beyond = of_mean(Metric::TipForce, Some(&change), 0.43);
        assert!(!beyond.holds && beyond.bound == Bound::Mean);
        assert_eq!(beyond.value, Some(0.430_000_1));
        assert!(beyond.words.contains("by 0.4300001 N"), "{}", beyond.words);
        let few = of_mean(Metric::TipForce, None, 0.43);
        assert!(!few.holds && few.value.is_none() && few.words.contains("too few trials"));
    }
}
