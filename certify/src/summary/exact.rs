//! This file says in how many pairs one controller is better than the other, and how likely chance alone does that: exactly, whatever the distribution.

use serde::{Deserialize, Serialize};

/// An exact paired comparison; less is better.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Exact {
    /// Pairs in which the controller is better than the baseline.
    pub better: u64,
    /// Pairs in which it is worse.
    pub worse: u64,
    /// Pairs in which both are the same.
    pub same: u64,
    /// How likely a coin is to be as uneven as better and worse, on either side: the exact sign test. Of outcomes that are yes or no it is that of
    /// McNemar.
    pub p: f64,
    /// The median of the differences, controller less baseline.
    pub median: f64,
    /// Its interval by two of the differences, which holds the median with at least 95 %; all of them where they are too few.
    pub interval: [f64; 2],
}

/// The comparison over differences, controller less baseline; `None` of none.
pub fn exact(differences: &[f64]) -> Option<Exact> {
    let mut sorted = differences.to_vec();
    sorted.sort_by(f64::total_cmp);
    let count = |is: fn(&&f64) -> bool| differences.iter().filter(is).count() as u64;
    let (better, worse) = (count(|own| **own < 0.0), count(|own| **own > 0.0));
    let all = sorted.len() as u64;
    let at = |place: u64| sorted.get(usize::try_from(place).ok()?).copied();
    // The greatest number of differences that may be left out at either end.
    let (mut least, mut most) = (0, all / 2);
    while least < most {
        let middle = least + (most - least).div_ceil(2);
        match tail(all, middle - 1) <= 0.025 {
            true => least = middle,
            false => most = middle - 1,
        }
    }
    let left_out = least.saturating_sub(1);
    let last = all.checked_sub(1)?;
    Some(Exact {
        better,
        worse,
        same: all - better - worse,
        p: (2.0 * tail(better + worse, better.min(worse))).min(1.0),
        median: 0.5 * (at(last / 2)? + at(last - last / 2)?),
        interval: [at(left_out)?, at(last - left_out)?],
    })
}

/// How likely of so many throws of a coin at most so many are heads.
fn tail(throws: u64, heads: u64) -> f64 {
    let (n, k) = (throws as f64, heads.min(throws) as f64);
    let log = libm::lgamma(n + 1.0) - libm::lgamma(k + 1.0) - libm::lgamma(n - k + 1.0);
    let mut term = libm::exp(log - n * core::f64::consts::LN_2);
    let (mut sum, mut k) = (term, k);
    while k > 0.0 && term > 1e-18 * sum {
        term *= k / (n - k + 1.0);
        k -= 1.0;
        sum += term;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The same by adding Pascal's triangle up in whole numbers.
    fn by_counting(throws: u32, heads: u32) -> f64 {
        let mut row = vec![1_u128];
        for _ in 0..throws {
            let next = row.windows(2).map(|pair| pair[0] + pair[1]);
            row = [vec![1], next.collect(), vec![1]].concat();
        }
        let some: u128 = row.iter().take(heads as usize + 1).sum();
        some as f64 / 2_f64.powi(throws as i32)
    }

    #[test]
    fn a_coin_is_thrown_as_counting_says() {
        for (throws, heads) in [(1, 0), (7, 2), (13, 6), (40, 9), (90, 41), (90, 3)] {
            let (own, counted) = (
                tail(throws.into(), heads.into()),
                by_counting(throws, heads),
            );
            assert!(
                (own / counted - 1.0).abs() < 1e-11,
                "{throws} {heads}: {own} {counted}"
            );
        }
        // Nothing of it is lost in large numbers: of 100 000 throws half are at most 50 000, and a little more.
        assert!((tail(100_000, 50_000) - 0.501_26).abs() < 1e-4);
    }

    #[test]
    fn better_worse_and_the_interval_of_the_median_are_exact() {
        // Of ten pairs nine are better, one is worse: 2·(1 + 10)/1024.
        let differences: Vec<f64> = (0..10).map(|k| f64::from(k) - 8.5).collect();
        let own = exact(&differences).unwrap();
        assert_eq!((own.better, own.worse, own.same), (9, 1, 0));
        assert!((own.p - 22.0 / 1024.0).abs() < 1e-12);
        assert_eq!(own.median, -4.0);
        // The second of ten from either end: outside of it is 2·11/1024 < 5 %, outside the third 2·56/1024 > 5 %.
        assert_eq!(own.interval, [-7.5, -0.5]);
        let same = exact(&[0.0, 0.0, 1.0]).unwrap();
        assert_eq!((same.better, same.worse, same.same, same.p), (0, 1, 2, 1.0));
        assert_eq!(same.interval, [0.0, 1.0]);
        assert_eq!(exact(&[]), None);
    }
}
