//! This file says how far a statistic must go that unchanged rigs hardly ever reach: the tail of what they came to, extrapolated.
//!
//! Peaks over a threshold: the greatest values of runs above the threshold exceed it by an exponentially distributed amount, whose mean is
//! estimated by maximum likelihood (Coles, An Introduction to Statistical Modeling of Extreme Values, Springer 2001, chapter 4, with the
//! shape 0). The shape is not estimated: of some tens of peaks its standard error is as large as itself.

use serde::Serialize;

/// Peaks that a tail is fitted to at most, and one in so many runs at most: a tail of more would be fitted to what is no tail.
const MOST_PEAKS: usize = 30;
const RUNS_A_PEAK: usize = 8;
/// False alarms of one statistic in ten hours of use that are expected at its level: of ten numbers and the surprise one in 18 hours. Fewer
/// would cost changes: at 0.02, six of 108 frictions on four brakes were missed. The tails that were seen end sooner than exponential ones.
const EXPECTED: f64 = 0.05;
/// The time of that, h.
const IN_HOURS: f64 = 10.0;

/// The tail of one statistic, in its unit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Tail {
    /// Runs whose greatest value is above the threshold.
    pub peaks: usize,
    /// The threshold.
    pub threshold: f64,
    /// By how much they exceed it in the mean.
    pub mean_excess: f64,
    /// The greatest value of all.
    pub greatest: f64,
    /// What raises an alarm.
    pub level: f64,
}

/// The tail of the greatest values of runs, of so many hours in all, none below 0; its level is never below `least`, nor below what was
/// reached.
pub fn tail(greatest: &[f64], hours: f64, least: f64) -> Tail {
    let mut all = greatest.to_vec();
    all.sort_by(|one, other| other.total_cmp(one));
    let first = all.first().copied().unwrap_or(0.0);
    let most = MOST_PEAKS.min(all.len() / RUNS_A_PEAK);
    let threshold = all.get(most).copied().unwrap_or(first);
    let peaks: Vec<f64> = all.into_iter().filter(|own| *own > threshold).collect();
    let mut own = Tail {
        peaks: peaks.len(),
        threshold,
        mean_excess: 0.0,
        greatest: first,
        level: least.max(first),
    };
    if !peaks.is_empty() && hours > 0.0 {
        let excess: f64 = peaks.iter().map(|peak| peak - threshold).sum();
        own.mean_excess = excess / peaks.len() as f64;
        // What passes a level is so much rarer than what passes the threshold: exp(−(level − threshold)/mean).
        let expected = peaks.len() as f64 / hours * IN_HOURS;
        let level = threshold + own.mean_excess * libm::log(expected / EXPECTED);
        own.level = own.level.max(level);
    }
    own
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Quantiles of an exponential distribution of mean 0.4, in no order.
    fn exponential(count: usize) -> Vec<f64> {
        let quantile = |own: usize| -0.4 * libm::log(1.0 - (own as f64 + 0.5) / count as f64);
        (0..count)
            .map(|own| quantile((own * 7 + 3) % count))
            .collect()
    }

    #[test]
    fn a_level_of_exponential_runs_is_where_as_few_come_as_are_allowed() {
        // 799 runs in 8 hours: 998.75 in ten hours pass exp(−x/0.4), and 0.05 do at x = 0.4·ln(19975).
        let own = tail(&exponential(799), 8.0, 3.0);
        let expected = 0.4 * libm::log(19_975.0);
        assert_eq!(own.peaks, 30);
        assert!((own.mean_excess - 0.4).abs() < 0.02, "{own:?}");
        assert!((own.level - expected).abs() < 0.25, "{own:?} {expected}");
    }

    #[test]
    fn a_level_is_never_below_the_least_or_what_was_reached() {
        assert_eq!(tail(&[0.0; 90], 2.0, 3.0).level, 3.0);
        assert_eq!(tail(&[], 0.0, 3.0).level, 3.0);
        let mut once = [0.1; 7];
        once[4] = 5.7;
        assert_eq!(tail(&once, 1.0, 3.0).level, 5.7);
    }
}
