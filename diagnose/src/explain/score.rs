//! This file gives the posterior of an explanation: its predictive density on left-out blocks, and
//! a prior that prefers few parameters.

use super::fitted::Fitted;
use super::folds::Folds;
use super::kind;
use crate::candidates::{is_plain, searched};
use crate::cause::{Cause, Scales};
use crate::problem::{Problem, Rows, Term};
use crate::regression::dot;
use crate::rules::{A_LINK, A_NUMBER, GIVEN_BACK, MOST_ACTING, RELEVANT_NOISE, USUAL_ODDS};
use rigproof_model::effects::facts::{End, Usual};
use rigproof_model::effects::{entry, facts};
use rigproof_spec::effect::{Mechanism, Quantity, Range};
use std::sync::Arc;

pub struct Judge {
    /// The granted model discrepancy, as a variance of a white row.
    granted: f64,
    /// The number of rows that carry as much information as one independent sample.
    rows_a_sample: f64,
}

impl Judge {
    /// `noise` is the standard deviation of a row before whitening. The discrepancy is a share of
    /// the effort.
    pub fn of(problem: &Problem, noise: f64, rows_a_sample: f64) -> Judge {
        let granted = problem.rules.relevant * problem.effort_size / noise.max(1e-300);
        Judge {
            granted: granted * granted + RELEVANT_NOISE * RELEVANT_NOISE,
            rows_a_sample,
        }
    }

    /// The logarithm of the predictive density of left-out blocks, up to a constant; −∞ for an
    /// effort that would have to be many times the recorded one. A gain that begins where no row is
    /// usable has such a coefficient.
    ///
    /// A change of the drive that shrinks the effort, or its changes, shrinks the residual with it.
    /// Losses are therefore divided by the share of their energy that acts, in the cells where the
    /// effort is changed: a limit shrinks it where it is reached.
    pub fn evidence(&self, folds: &Folds, fitted: &Fitted) -> f64 {
        let driving = &folds.driving_energies;
        let acting = fitted.acting_energies(folds);
        let acting = acting.as_ref().unwrap_or(driving);
        let share = acting_share(acting, driving);
        if share > MOST_ACTING {
            return f64::NEG_INFINITY;
        }
        let cells = folds.counts.iter().zip(&fitted.losses);
        let each = cells.zip(acting.iter().zip(driving));
        let each = each.map(|((rows, loss), (acting, driving))| {
            let share = if acting == driving { 1.0 } else { share };
            let left = loss / rows / share + self.granted;
            -0.5 * rows / self.rows_a_sample * libm::log(left)
        });
        each.sum()
    }

    /// The log posterior of an explanation, up to a constant.
    pub fn score(&self, problem: &Problem, folds: &Folds, fitted: &Fitted) -> f64 {
        self.evidence(folds, fitted) + prior(problem, &fitted.terms)
    }

    /// Whether removing any one term increases the residual by more than the granted discrepancy.
    ///
    /// The residual is that of the fit itself: a block that alone determines a term would make its
    /// left-out residual as large as one likes.
    pub fn all_matter(&self, folds: &Folds, bare: &Fitted, fitted: &Fitted) -> bool {
        let energy = |own: &Fitted| {
            let left = own.residual(folds);
            dot(&left, &left)
        };
        let least = energy(fitted) + self.granted * folds.count();
        (0..fitted.terms.len()).all(|index| {
            let mut others = fitted.terms.clone();
            others.remove(index);
            energy(&bare.of(folds, &others)) >= least
        })
    }
}

/// The share of the energy that acts, of the effort or of its changes, whichever is less, in the cells
/// where the effort is changed; at least 1e-300.
fn acting_share(acting: &[[f64; 2]], driving: &[[f64; 2]]) -> f64 {
    let both = acting.iter().zip(driving);
    let changed = both.filter(|(acting, driving)| acting != driving);
    let sums = changed.fold([[0.0; 2]; 2], |[acts, drives], (acting, driving)| {
        let add = |a: [f64; 2], b: &[f64; 2]| [a[0] + b[0], a[1] + b[1]];
        [add(acts, acting), add(drives, driving)]
    });
    let [acts, drives] = sums;
    let shares = acts.iter().zip(drives).map(|(a, d)| a / d.max(1e-300));
    shares.fold(f64::INFINITY, f64::min).max(1e-300)
}

/// The log prior of a set of terms.
pub fn prior(problem: &Problem, terms: &[Term]) -> f64 {
    let each = terms.iter().enumerate().map(|(index, term)| {
        let before = terms.get(..index).unwrap_or_default();
        odds(problem, term) + known_from_others(problem, term.cause, before)
    });
    each.sum()
}

/// What joints that have a plain mechanism add to the log odds that another joint of the same arm
/// has it too.
///
/// Joints of an arm are alike, but which share of them lacks something is not known. With a beta
/// distribution of that share the odds after k of n joints are ((n + 1)·first + k)/(n + 1 − k), where
/// `first` are the odds of the first one: Laplace's rule of succession, with one joint more that
/// lacks nothing.
fn known_from_others(problem: &Problem, cause: Cause, before: &[Term]) -> f64 {
    let mechanism = plain(problem, cause.mechanism);
    if !problem.rules.many || !is_plain(mechanism) {
        return 0.0;
    }
    let same = |own: &&Term| plain(problem, own.cause.mechanism) == mechanism;
    let known = before.iter().filter(same).count();
    let first = libm::exp(usual(mechanism));
    libm::log(odds_after(known, problem.run.joints(), first) / first)
}

fn odds_after(known: usize, joints: usize, first: f64) -> f64 {
    let (known, joints) = (known as f64, joints as f64);
    ((joints + 1.0) * first + known) / (joints + 1.0 - known).max(1.0)
}

fn odds(problem: &Problem, term: &Term) -> f64 {
    let empty = |rows: &&Arc<Rows>| rows.raw.iter().all(|x| *x == 0.0);
    // Parameters of a link's inertia count as at most `A_LINK`: one description gives them all, so
    // they are wrong together.
    let free = term.free.len() - term.free.iter().filter(empty).count();
    let free = match term.cause.mechanism {
        Mechanism::LinkInertia => free.min(A_LINK),
        _ => free,
    };
    let numbers =
        free.max(1) + searched(problem, term).count() + usize::from(term.onset_s.is_some());
    // Where a term has no coefficient, its first shape parameter takes the coefficient's place and
    // is not counted.
    let numbers = numbers - usize::from(term.free.is_empty() && !term.shape.is_empty());
    let usual = match refines_a_stated_law(problem, term.cause) {
        true => 0.0,
        false => usual(plain(problem, term.cause.mechanism)),
    };
    usual - A_NUMBER * numbers.saturating_sub(1) as f64
}

/// Whether a cause is a stated law of unknown size with a travel besides: all dry friction bends
/// before it slides. It takes the place of the stated law, and only its further numbers cost.
fn refines_a_stated_law(problem: &Problem, cause: Cause) -> bool {
    let linear = |own: Mechanism| entry(own).map(|entry| entry.linear);
    let limit = bends_from(cause.mechanism);
    let limit = limit.filter(|limit| linear(cause.mechanism) == linear(*limit));
    limit.is_some_and(|limit| {
        let stated = |own: &Cause| own.mechanism == limit && own.at == cause.at;
        cause.scales == Scales::Nothing && problem.open.iter().any(stated)
    })
}

/// The law that a law with a travel becomes where the travel goes to 0: all dry friction bends before
/// it slides.
pub fn bends_from(mechanism: Mechanism) -> Option<Mechanism> {
    let mechanism = kind(mechanism);
    let limit = facts(mechanism).and_then(|facts| facts.limit)?;
    let number = mechanism.parameters().get(limit.parameter)?;
    let is_travel = limit.end == End::Nothing && number.quantity == Quantity::Travel;
    is_travel.then_some(limit.of)
}

/// At an arm the plain law of a mechanism: what is asked first is whether a joint has friction.
fn plain(problem: &Problem, mechanism: Mechanism) -> Mechanism {
    let bent = bends_from(mechanism).filter(|_| problem.rules.many);
    bent.unwrap_or(mechanism)
}

/// The log odds that a model leaves this mechanism out.
fn usual(mechanism: Mechanism) -> f64 {
    let usual = facts(mechanism).map_or(Usual::Rare, |facts| facts.usual);
    USUAL_ODDS.get(usual as usize).copied().unwrap_or(0.0)
}

/// Whether a fit is no physics: a passive mechanism gives out energy, beyond what the nominal model
/// already takes, a part is more than the whole, or all inertias are wrong by a share of the effort
/// that no model and no discretisation is exact to.
pub fn is_impossible(problem: &Problem, fitted: &Fitted) -> bool {
    let own = fitted.terms.iter().zip(fitted.by_term());
    own.into_iter().any(|(term, own)| {
        let mechanism = term.cause.mechanism;
        let passive = entry(mechanism).filter(|entry| entry.passive);
        let least = -GIVEN_BACK * problem.run.described(term.cause);
        let mut parts = mechanism.parameters().iter().zip(own);
        // A shape that enters linearly, as the share of friction under load at an arm, is one too.
        passive.is_some_and(|entry| own.iter().take(entry.linear.max(1)).any(|c| *c < least))
            || parts.any(|(number, part)| number.range == Range::Part && *part > 1.0)
            || mechanism == Mechanism::InertiaScale
                && own.iter().all(|share| share.abs() < problem.rules.relevant)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_effort_is_weaker_only_where_it_is_changed() {
        let driving = [[4.0, 1.0], [25.0, 3.0], [9.0, 2.0]];
        // A limit that cuts the second cell, and shrinks changes more than the effort.
        let limited = [driving[0], [5.0, 0.3], driving[2]];
        assert!((acting_share(&limited, &driving) - 0.1).abs() < 1e-15);
        let halved = driving.map(|own| own.map(|energy| 0.25 * energy));
        assert!((acting_share(&halved, &driving) - 0.25).abs() < 1e-15);
    }

    #[test]
    fn a_joint_is_likelier_to_lack_what_others_lack() {
        let first = 0.02;
        assert!((odds_after(0, 7, first) - first).abs() < 1e-15);
        let each: Vec<f64> = (0..7).map(|known| odds_after(known, 7, first)).collect();
        assert!(each.is_sorted(), "{each:?}");
        // Of two joints the second one has less than even odds, of seven the last one more.
        assert!((odds_after(1, 2, first) - 0.53).abs() < 1e-12);
        assert!((odds_after(6, 7, first) - 3.08).abs() < 1e-12);
    }
}
