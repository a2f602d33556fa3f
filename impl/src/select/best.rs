//! This file says which of four brakes comes first.

use rigproof_spec::joint::Joint;

use crate::number::Scalar;

/// A brake that may act.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Candidate<S> {
    /// 0 comes first.
    pub rank: u8,
    /// Component of its vector along the desired direction.
    pub component: S,
    /// Square of that vector's length, above zero.
    pub length_squared: S,
}

/// The brake of the lowest rank; among those the one whose vector lies closest to the desired direction; among those the first
/// in the order A, E, B, C.
#[inline]
pub fn best<S: Scalar>(candidates: [Option<Candidate<S>>; 4]) -> Option<Joint> {
    let [a, e, b, c] = candidates;
    let first = a.map(|a| (Joint::A, a));
    let first = better(first, Joint::E, e);
    let first = better(first, Joint::B, b);
    better(first, Joint::C, c).map(|(joint, _)| joint)
}

/// The first so far, or another that is better.
#[inline(always)]
fn better<S: Scalar>(
    first: Option<(Joint, Candidate<S>)>,
    joint: Joint,
    candidate: Option<Candidate<S>>,
) -> Option<(Joint, Candidate<S>)> {
    match (&first, candidate) {
        (None, Some(candidate)) => Some((joint, candidate)),
        (Some((_, other)), Some(candidate))
            if candidate.rank < other.rank
                || (candidate.rank == other.rank && closer(&candidate, other)) =>
        {
            Some((joint, candidate))
        }
        _ => first,
    }
}

/// Whether one vector makes the smaller angle with the desired direction: c₁/√n₁ > c₂/√n₂, by squares that keep their signs.
#[inline]
pub fn closer<S: Scalar>(one: &Candidate<S>, other: &Candidate<S>) -> bool {
    let signed_square =
        |candidate: &Candidate<S>| candidate.component * candidate.component.magnitude();
    signed_square(one) * other.length_squared > signed_square(other) * one.length_squared
}

#[cfg(test)]
mod tests {
    use super::*;

    fn candidate(rank: u8, component: f64, length_squared: f64) -> Option<Candidate<f64>> {
        Some(Candidate {
            rank,
            component,
            length_squared,
        })
    }

    #[test]
    fn rank_comes_before_closeness_and_closeness_before_order() {
        let (near, far) = (candidate(1, 2.9, 9.1), candidate(1, 1.3, 9.1));
        assert_eq!(
            best([near, candidate(0, 0.2, 9.1), far, None]),
            Some(Joint::E)
        );
        assert_eq!(best([far, None, near, far]), Some(Joint::B));
        assert_eq!(best([None, far, None, far]), Some(Joint::E));
        assert_eq!(best::<f64>([None; 4]), None);
    }

    #[test]
    fn closeness_is_the_cosine_with_its_sign() {
        // Cosines 0.8, 0.6, −0.6 and −0.8.
        let [a, b, c, d] = [(4.0, 25.0), (1.8, 9.0), (-1.2, 4.0), (-5.6, 49.0)]
            .map(|(component, length_squared)| candidate(0, component, length_squared).unwrap());
        for (one, other) in [(a, b), (b, c), (c, d), (a, d)] {
            assert!(closer(&one, &other) && !closer(&other, &one));
        }
        assert!(!closer(&a, &a));
    }
}
