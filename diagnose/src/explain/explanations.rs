//! This file is the explanations of a recording and what they say of a cause together.

use super::score::bends_from;
use super::sorted;
use crate::cause::Cause;
use crate::problem::Term;
use crate::rules::{AS_ONE, NAMED, OFFERED, SUSPECTED};
use rigproof_model::effects::facts;
use rigproof_model::effects::facts::Shapes;
use rigproof_spec::effect::Mechanism;

/// One explanation: a set of terms on top of the nominal model.
#[derive(Clone, Debug)]
pub struct Explanation {
    pub terms: Vec<Term>,
    /// Its posterior probability among the explanations that were compared.
    pub weight: f64,
    /// Root mean square of its residual on left-out blocks, in standard deviations of the sensor
    /// noise.
    pub leaves: f64,
    /// The logarithm of its predictive density on left-out blocks, without the prior.
    pub evidence: f64,
}

/// The explanations of a recording, the most probable first.
#[derive(Clone, Debug)]
pub struct Explanations {
    /// Those that are weighed; one of an arm may be one of thousands, each of little weight.
    pub living: Vec<Explanation>,
    /// The cause that alone takes away most of what the nominal model leaves, and its share of that.
    pub likest: Option<(Cause, f64)>,
}

impl Explanations {
    /// The probability of a cause: the summed weight of all explanations that hold it.
    ///
    /// An explanation that holds it at another place counts too where no motion tells the places
    /// apart.
    ///
    /// A cause that the leading one holds several times, with several periods, counts where it
    /// stands at least as many `times`.
    pub fn probability(&self, cause: Cause, times: usize) -> f64 {
        let Some(leading) = self.living.first() else {
            return 0.0;
        };
        let holds = |own: &&Explanation| own.forms(cause) >= times || leading.is_as(own, cause);
        self.living.iter().filter(holds).map(|own| own.weight).sum()
    }

    /// The explanations led by one that holds a form of a law, or friction that bends before it
    /// slides, only where that is named.
    ///
    /// Where it is not, one with the plain law in its place leads: it is the surer name.
    pub fn led_by_the_sure(mut self) -> Explanations {
        let terms = self.living.first().map(|own| own.terms.clone());
        for term in terms.unwrap_or_default() {
            let Some(plain) = self.surer(term.cause) else {
                continue;
            };
            let leading = self.living.first().into_iter().flat_map(|own| &own.terms);
            let wanted = leading.map(|own| match own.cause == term.cause {
                true => Cause {
                    mechanism: plain,
                    ..own.cause
                },
                false => own.cause,
            });
            let wanted = sorted(wanted);
            let has = |own: &Explanation| sorted(own.terms.iter().map(|term| term.cause));
            let plainer = self.living.iter().position(|own| wanted == has(own));
            if let Some(place) = plainer {
                let own = self.living.remove(place);
                self.living.insert(0, own);
            }
        }
        self
    }

    /// The plain law of a cause of which the probability does not name it in particular.
    fn surer(&self, cause: Cause) -> Option<Mechanism> {
        let plain = kind(cause.mechanism);
        let is_it = |own: &&Explanation| own.terms.iter().any(|term| term.cause == cause);
        let those = self.living.iter().filter(is_it);
        let in_this_form: f64 = those.map(|own| own.weight).sum();
        match plain == cause.mechanism {
            true => bends_from(plain).filter(|_| self.probability(cause, 1) < NAMED),
            false => Some(plain).filter(|_| in_this_form < NAMED),
        }
    }

    /// The other forms of a cause that explanations hold in its place, each with its probability.
    ///
    /// They are part of the probability of the cause. Only those that reach `OFFERED` are listed.
    pub fn other_forms(&self, cause: Cause) -> Vec<(Mechanism, f64)> {
        let mut forms: Vec<(Mechanism, f64)> = Vec::new();
        for own in self.living.iter().filter(|own| own.holds(cause)) {
            let held = own.terms.iter().filter(|term| includes(term, cause));
            for form in held.map(|term| term.cause).filter(|own| *own != cause) {
                match forms.iter_mut().find(|(own, _)| *own == form.mechanism) {
                    Some((_, weight)) => *weight += own.weight,
                    None => forms.push((form.mechanism, own.weight)),
                }
            }
        }
        forms.retain(|(_, weight)| *weight >= OFFERED);
        forms
    }

    /// The causes that rival explanations hold instead of a cause of the leading one.
    ///
    /// Only causes are listed whose summed weight there, beyond what it would be if they stood beside
    /// the cause as often, reaches `OFFERED`; the heaviest first.
    pub fn instead_of(&self, cause: Cause) -> Vec<Cause> {
        let Some((leading, others)) = self.living.split_first() else {
            return Vec::new();
        };
        let rivals = others.iter().filter(|own| !own.holds(cause));
        let rivals: Vec<&Explanation> = rivals.collect();
        let sum = |held: bool, other: Option<&Cause>| -> f64 {
            let those = self.living.iter().filter(|own| own.holds(cause) == held);
            let those = those.filter(|own| other.is_none_or(|other| own.holds(*other)));
            those.map(|own| own.weight).sum()
        };
        let without = sum(false, None);
        let alike = rivals.iter().filter(|own| leading.is_as(own, cause));
        let alike: Vec<&&Explanation> = alike.collect();
        if without < OFFERED && alike.is_empty() {
            return Vec::new();
        }
        let mut instead: Vec<Cause> = Vec::new();
        for term in rivals.iter().flat_map(|own| &own.terms) {
            if !leading.holds(term.cause) && !instead.contains(&term.cause) {
                instead.push(term.cause);
            }
        }
        let odds = without / sum(true, None).max(f64::MIN_POSITIVE);
        let weight = |other: &Cause| sum(false, Some(other)) - odds * sum(true, Some(other));
        let is_as = |other: &Cause| alike.iter().any(|own| own.holds(*other));
        instead.retain(|other| weight(other) >= OFFERED || is_as(other));
        instead.sort_by(|a, b| weight(b).total_cmp(&weight(a)));
        instead
    }
}

impl Explanation {
    /// Whether `other` differs from this explanation only in the place of `cause` and predicts
    /// equally well. The places are then not identifiable from this motion.
    fn is_as(&self, other: &Explanation, cause: Cause) -> bool {
        let apart = (self.evidence - other.evidence).abs();
        let elsewhere = |own: &&Term| !self.holds(own.cause);
        let mut others = other.terms.iter().filter(elsewhere);
        let same = |own: &Term| are_forms(own.cause.mechanism, cause.mechanism);
        apart < AS_ONE
            && self.terms.len() == other.terms.len()
            && !other.holds(cause)
            && others.next().is_some_and(same)
            && others.next().is_none()
    }

    /// Whether it holds a cause, in any form of its law.
    fn holds(&self, cause: Cause) -> bool {
        self.forms(cause) > 0
    }

    /// How many of its terms are forms of a cause, or become it once they slide.
    fn forms(&self, cause: Cause) -> usize {
        let forms = self.terms.iter().filter(|term| includes(term, cause));
        forms.count()
    }
}

/// The mechanism that this one is a form of, or itself.
pub fn kind(mechanism: Mechanism) -> Mechanism {
    facts(mechanism)
        .and_then(|facts| facts.form_of)
        .unwrap_or(mechanism)
}

/// Whether two mechanisms are forms of one: of the same law, or bristles, whose force builds up over
/// a travel after each reversal and then stays.
fn are_forms(a: Mechanism, b: Mechanism) -> bool {
    let is_bristle = |mechanism| {
        matches!(
            facts(mechanism).map(|facts| facts.shapes),
            Some(Shapes::Bristle | Shapes::BristleCurve | Shapes::Memory)
        )
    };
    kind(a) == kind(b) || is_bristle(a) && is_bristle(b)
}

/// Whether a term is a form of a cause at its place.
pub fn is_form_of(own: &Term, cause: Cause) -> bool {
    own.cause.at == cause.at && are_forms(own.cause.mechanism, cause.mechanism)
}

/// Whether a term is a form of a cause, or becomes it once it slides: friction that bends first is
/// friction in any case.
fn includes(own: &Term, cause: Cause) -> bool {
    is_form_of(own, cause) || becomes(own.cause, cause)
}

/// Whether one cause bends before it becomes the other.
pub fn becomes(own: Cause, plain: Cause) -> bool {
    own.at == plain.at && bends_from(own.mechanism) == Some(plain.mechanism)
}

/// The word for a cause of this probability.
pub const fn status(probability: f64) -> &'static str {
    if probability >= NAMED {
        "named"
    } else if probability >= SUSPECTED {
        "suspected"
    } else {
        "possible"
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plants::five_bar::recorded::{problem, short_run};
    use crate::plants::five_bar::run::at;
    use rigproof_spec::joint::Joint;

    #[test]
    fn friction_that_bends_is_friction_and_leads_where_the_bend_is_sure() {
        let run = short_run();
        let problem = problem(&run);
        let term = |mechanism, shape: &[f64]| {
            let own = problem.whole_term(at(mechanism, Joint::A), shape);
            own.unwrap()
        };
        let [dry, bent] = [
            term(Mechanism::DryOffset, &[]),
            term(Mechanism::Presliding, &[0.01]),
        ];
        let of = |term: &Term, weight: f64| Explanation {
            terms: vec![term.clone()],
            weight,
            leaves: 1.0,
            evidence: 0.0,
        };
        let led = |weight: f64| {
            let living = vec![of(&bent, weight), of(&dry, 1.0 - weight)];
            let likest = None;
            Explanations { living, likest }.led_by_the_sure()
        };
        let leads = |own: &Explanations| own.living[0].terms[0].cause;
        let unsure = led(0.6);
        assert_eq!(leads(&unsure), dry.cause);
        assert!((unsure.probability(dry.cause, 1) - 1.0).abs() < 1e-12);
        assert!((unsure.probability(bent.cause, 1) - 0.6).abs() < 1e-12);
        assert_eq!(
            unsure.other_forms(dry.cause),
            [(Mechanism::Presliding, 0.6)]
        );
        assert_eq!(leads(&led(0.95)), bent.cause);
    }
}
