//! This file bounds the probabilities of names by what the data leave open.

use crate::candidates::is_periodic;
use crate::cause::{Cause, Scales};
use crate::evidence::{Intervals, coefficients_by_term};
use crate::filter::ends;
use crate::problem::{Problem, Term};
use crate::rules::{LEAST_BESIDE_POSITION, PERIOD_KNOWN, POSITION_BINS, SUSPECTED};
use crate::selection::{Selection, is_noise};
use rigproof_model::effects::facts;
use rigproof_model::effects::facts::Family;
use rigproof_spec::effect::{Mechanism, Quantity};

/// Bounds the probabilities of what is named.
///
/// If the residual is more than noise, a mechanism that explains little beside the rest may be a part
/// of the unexplained physics. Its probability is at most one half plus the share of the loss that it
/// removes. A mechanism beside others whose numbers may all be those of nothing is at most suspected:
/// the others, with other numbers, do without it. So is a gain whose loss another law of the torque
/// gives back, and a friction that nothing but a function of the position is on this motion.
pub(super) fn bound(problem: &Problem, selection: &mut Selection, intervals: &Intervals) {
    let is_noise = is_noise(problem, &selection.after);
    let numbers = numbers_of_found(problem, selection, intervals);
    // Of a plant of many places delays are measured without an interval.
    let beside = selection.found.len() > 1 && !problem.rules.many;
    let given_back = given_back(selection, &numbers);
    for (found, (values, halves)) in selection.found.iter_mut().zip(&numbers) {
        if beside && may_be_nothing(&found.term, values, halves)
            || given_back == Some(found.term.cause)
            || is_of_position(problem, &found.term, values)
        {
            found.probability = found.probability.min(SUSPECTED);
        }
        if !is_noise {
            found.probability = found.probability.min(SUSPECTED + found.share.max(0.0));
        }
    }
}

/// A loss of a brake's gain that another law of its torque gives back within their intervals: the
/// brake's own friction follows that law, and nothing is weaker.
fn given_back(selection: &Selection, numbers: &[(Vec<f64>, &Vec<f64>)]) -> Option<Cause> {
    let first = |(values, halves): &(Vec<f64>, &Vec<f64>)| {
        values.first().copied().zip(halves.first().copied())
    };
    let causes = selection.found.iter().map(|own| own.term.cause);
    let found: Vec<_> = causes.zip(numbers).collect();
    let is_gain = |(own, _): &&(Cause, _)| own.mechanism == Mechanism::GainError;
    let (gain, own) = *found.iter().find(is_gain)?;
    let (loss, half) = first(own)?;
    let is_share = |own: Cause| own.scales == Scales::Torque && own.at == gain.at;
    let is_as_much =
        |(share, its_half): (f64, f64)| share > 0.0 && (share + loss).abs() < half + its_half;
    found
        .iter()
        .any(|(cause, own)| is_share(*cause) && first(own).is_some_and(is_as_much))
        .then_some(gain)
}

/// The coefficients of each found term, and the half widths of the intervals of its numbers.
fn numbers_of_found<'a>(
    problem: &Problem,
    selection: &Selection,
    intervals: &'a Intervals,
) -> Vec<(Vec<f64>, &'a Vec<f64>)> {
    let (_, coefficients) = coefficients_by_term(problem, selection);
    let numbers = coefficients.into_iter().zip(&intervals.terms);
    numbers.skip(selection.nominal.len()).collect()
}

/// Whether every coefficient may be 0 by its interval; of a law without one whether its numbers may be
/// the one at which it does nothing.
fn may_be_nothing(term: &Term, values: &[f64], halves: &[f64]) -> bool {
    let nothing = facts(term.cause.mechanism).and_then(|facts| facts.nothing);
    match (values, nothing) {
        ([], Some(nothing)) => {
            // A number without an interval is given, such as the end of a scale.
            let numbers = term.shape.iter().zip(halves);
            let mut found = numbers.filter(|(_, half)| **half > 0.0).peekable();
            found.peek().is_some() && found.all(|(own, half)| (own - nothing).abs() < *half)
        }
        ([], None) => false,
        _ => values
            .iter()
            .zip(halves)
            .all(|(value, half)| *value == 0.0 || value.abs() < *half),
    }
}

/// The laws that were found with numbers that no such law has: a periodic one whose period is not
/// known, since no periods were seen, and a loss of more than a brake's whole torque.
pub(super) fn untenable(
    problem: &Problem,
    selection: &Selection,
    intervals: &Intervals,
) -> Vec<Cause> {
    let numbers = numbers_of_found(problem, selection, intervals);
    let found = selection.found.iter().zip(&numbers);
    let untenable = found.filter(|(found, (values, halves))| {
        is_vague(&found.term, halves) || loses_all(found.term.cause, values)
    });
    untenable.map(|(found, _)| found.term.cause).collect()
}

fn is_vague(term: &Term, halves: &[f64]) -> bool {
    let own = term.numbers().first().zip(halves.last());
    is_periodic(term.cause) && own.is_some_and(|(period, half)| *half > PERIOD_KNOWN * period)
}

/// Whether a share of a brake's torque takes away more than all of it.
fn loses_all(cause: Cause, shares: &[f64]) -> bool {
    let mut numbers = cause.mechanism.parameters().iter().zip(shares);
    cause.scales == Scales::Torque
        && numbers.any(|(number, share)| number.quantity == Quantity::Effort && *share < -1.0)
}

/// Whether the effort of a friction is a function of the position alone on this motion. A single sine
/// passes each position at one speed: friction that is equal in both directions is then a spring or
/// a ripple as well.
fn is_of_position(problem: &Problem, term: &Term, values: &[f64]) -> bool {
    let family = facts(term.cause.mechanism).map(|facts| facts.family);
    let is_asked = family == Some(Family::FrictionOfMotion) && problem.run.outputs() == 1;
    if !is_asked || values.is_empty() {
        return false;
    }
    let motion = problem.run.motion(term.cause.at).iter();
    let position: Vec<f64> = motion.map(|now| now.position).collect();
    let position = problem.windows.average(&position);
    let effort = weighted(
        term.free.iter().map(|own| &own.raw[..]).zip(values),
        position.len(),
    );
    left_beside(&position, &effort) < LEAST_BESIDE_POSITION
}

/// The sum of signals of one length, each with its coefficient.
fn weighted<'a>(signals: impl Iterator<Item = (&'a [f64], &'a f64)>, len: usize) -> Vec<f64> {
    let mut sum = vec![0.0; len];
    for (signal, coefficient) in signals {
        for (sum, own) in sum.iter_mut().zip(signal) {
            *sum += coefficient * own;
        }
    }
    sum
}

/// The share of the variance of `effort` that its mean in each of `POSITION_BINS` bins of the position leaves.
fn left_beside(position: &[f64], effort: &[f64]) -> f64 {
    let [low, high] = ends(position.iter().copied());
    let width = (high - low) / POSITION_BINS as f64;
    let mut bins = vec![Vec::new(); POSITION_BINS + 1];
    for (position, effort) in position.iter().zip(effort) {
        if let Some(bin) = bins.get_mut(((position - low) / width) as usize) {
            bin.push(*effort);
        }
    }
    let within: f64 = bins.iter().map(|own| scatter(own)).sum();
    within / scatter(effort).max(1e-300)
}

/// The sum of squares about the mean.
fn scatter(own: &[f64]) -> f64 {
    let mean = own.iter().sum::<f64>() / own.len().max(1) as f64;
    own.iter().map(|own| (own - mean).powi(2)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Position and speed of a sum of sines of unit speed, each with its angular frequency.
    fn moving(frequencies: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let at = |k: usize| {
            let time = 0.01 * f64::from(k as u32);
            let each = frequencies
                .iter()
                .map(|w| (libm::sin(w * time) / w, libm::cos(w * time)));
            each.fold((0.0, 0.0), |sum, own| (sum.0 + own.0, sum.1 + own.1))
        };
        (0..4000).map(at).unzip()
    }

    #[test]
    fn one_sine_passes_each_position_at_one_speed_and_two_do_not() {
        let magnitude = |speed: &[f64]| -> Vec<f64> { speed.iter().map(|v| v.abs()).collect() };
        let (position, speed) = moving(&[1.9]);
        let own = left_beside(&position, &magnitude(&speed));
        assert!(own < LEAST_BESIDE_POSITION, "{own}");
        let own = left_beside(&position, &speed);
        assert!(own > 0.95, "against the motion: {own}");
        let (position, speed) = moving(&[1.9, 3.1]);
        let own = left_beside(&position, &magnitude(&speed));
        assert!(own > 0.5, "{own}");
    }
}
