//! This file says what the difference of two controllers' commands looks like: a factor, a delay, brakes exchanged, a sign.

use rigproof_spec::joint::Joint;
use serde::Serialize;

/// What a difference looks like. It is a hint for whoever looks for the cause, and decides nothing.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Looks {
    /// The currents that differ are so many times the old ones.
    Times(f64),
    /// They are the old ones of so many samples before.
    Later(usize),
    /// Two brakes have each other's currents.
    Exchanged(&'static str, &'static str),
    /// A brake's currents have the other sign.
    Sign(&'static str),
}

/// In which share of the samples that differ a likeness has to hold.
const NEARLY_ALL: f64 = 0.95;
/// Samples that have to differ before anything is said of them.
const LEAST: usize = 20;
/// Most samples of a delay that is looked for.
const MOST_LATER: usize = 32;
/// Beside which share of a current two count as the same.
const SAME: f64 = 1e-6;

/// What the difference of two runs of commands, A, looks like.
pub fn looks(old: &[[f64; 4]], new: &[[f64; 4]]) -> Vec<Looks> {
    let is_other = |k: &usize| old.get(*k) != new.get(*k);
    let differing: Vec<usize> = (0..old.len().min(new.len())).filter(is_other).collect();
    if differing.len() < LEAST {
        return Vec::new();
    }
    let nearly_all = |is: &dyn Fn(usize) -> bool| {
        let count = differing.iter().filter(|k| is(**k)).count();
        count as f64 >= NEARLY_ALL * differing.len() as f64
    };
    let at = |of: &[[f64; 4]], k: usize| of.get(k).copied().unwrap_or([f64::NAN; 4]);
    let mut found = Vec::new();
    let factor = median(&differing, old, new);
    if nearly_all(&|k| near(at(old, k).map(|a| a * factor), at(new, k))) {
        // A factor of −1 is a sign, and which brake it is of says more.
        if factor > 0.0 {
            found.push(Looks::Times(factor));
        }
    }
    let is_later = |by: usize| nearly_all(&|k| k >= by && near(at(old, k - by), at(new, k)));
    found.extend((1..=MOST_LATER).find(|by| is_later(*by)).map(Looks::Later));
    for (one, first) in Joint::ALL.into_iter().enumerate() {
        let negated = |mut a: [f64; 4]| {
            a.iter_mut().skip(one).take(1).for_each(|a| *a = -*a);
            a
        };
        if nearly_all(&|k| near(negated(at(old, k)), at(new, k))) {
            found.push(Looks::Sign(first.letter()));
        }
        for (other, second) in Joint::ALL.into_iter().enumerate().skip(one + 1) {
            let exchanged = |mut a: [f64; 4]| {
                a.swap(one, other);
                a
            };
            if nearly_all(&|k| near(exchanged(at(old, k)), at(new, k))) {
                found.push(Looks::Exchanged(first.letter(), second.letter()));
            }
        }
    }
    found
}

/// Whether two commands are the same but for rounding.
fn near(one: [f64; 4], other: [f64; 4]) -> bool {
    let mut pairs = one.into_iter().zip(other);
    pairs.all(|(one, other)| (one - other).abs() <= SAME * one.abs())
}

/// The median of the ratios of the commands that differ.
fn median(differing: &[usize], old: &[[f64; 4]], new: &[[f64; 4]]) -> f64 {
    let pairs = differing
        .iter()
        .filter_map(|k| Some((old.get(*k)?, new.get(*k)?)));
    let pairs = pairs.flat_map(|(old, new)| old.iter().zip(new));
    let ratios = pairs
        .filter(|(old, _)| **old != 0.0)
        .map(|(old, new)| new / old);
    let mut ratios: Vec<f64> = ratios.filter(|ratio| ratio.is_finite()).collect();
    ratios.sort_unstable_by(f64::total_cmp);
    ratios.get(ratios.len() / 2).copied().unwrap_or(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Commands that turn from brake to brake.
    fn commands() -> Vec<[f64; 4]> {
        let at = |k: usize| 0.11 + 0.07 * ((k * k + 3 * k) % 11) as f64 / 11.0;
        (0..200)
            .map(|k| {
                let mut a = [0.0; 4];
                a[k / 7 % 4] = at(k);
                a
            })
            .collect()
    }

    #[test]
    fn a_factor_a_delay_an_exchange_and_a_sign_are_told_apart() {
        let old = commands();
        let of = |change: &dyn Fn(usize, [f64; 4]) -> [f64; 4]| {
            let new: Vec<_> = old.iter().enumerate().map(|(k, a)| change(k, *a)).collect();
            looks(&old, &new)
        };
        let times = of(&|_, a| a.map(|a| 1.25 * a));
        assert!(matches!(times[..], [Looks::Times(factor)] if (factor - 1.25).abs() < 1e-12));
        let later = of(&|k, _| old[k.saturating_sub(3)]);
        assert_eq!(later, [Looks::Later(3)]);
        assert_eq!(
            of(&|_, [a, e, b, c]| [a, b, e, c]),
            [Looks::Exchanged("E", "B")]
        );
        assert_eq!(of(&|_, [a, e, b, c]| [a, e, -b, c]), [Looks::Sign("B")]);
        assert_eq!(of(&|_, a| a), []);
        // Noise looks like nothing.
        assert_eq!(of(&|k, a| a.map(|a| a + 1e-3 * (k % 5 + 1) as f64)), []);
    }
}
