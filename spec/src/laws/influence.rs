//! This file says which brakes may act on an unwanted velocity, and which of them comes first.

use super::Margin;

/// Rank of the influence coefficients of a brake on the desired and the unwanted component of velocity: 0 comes
/// first; `None` may not act.
///
/// Source: §6.3: [1, −1], then [0, −1], then [−1, −1]; with any other set no brake is actuated.
pub const fn influence_rank(influence: [i8; 2]) -> Option<u8> {
    match influence {
        [1, -1] => Some(0),
        [0, -1] => Some(1),
        [-1, -1] => Some(2),
        _ => None,
    }
}

/// Whether the chosen coefficients, or their absence, come first among what was available; the margin is minus the
/// number of ranks given away.
///
/// Source: §6.3.
pub fn best_influence(chosen: Option<[i8; 2]>, available: &[[i8; 2]]) -> Margin {
    /// One more than any rank: nothing acts.
    const NOTHING: u8 = 3;
    let best = available
        .iter()
        .filter_map(|influence| influence_rank(*influence))
        .fold(NOTHING, u8::min);
    match chosen {
        None => Margin(f64::from(best) - f64::from(NOTHING)),
        Some(influence) => match influence_rank(influence) {
            Some(rank) if available.contains(&influence) => {
                Margin(f64::from(best) - f64::from(rank))
            }
            _ => Margin(-f64::from(NOTHING)),
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_three_sets_may_act_in_the_printed_order() {
        // The example (6.12): five brakes, the first is the best.
        let example = [[1, -1], [0, -1], [-1, -1], [-1, 0], [-1, 1]];
        assert_eq!(
            example.map(influence_rank),
            [Some(0), Some(1), Some(2), None, None]
        );
        assert!(best_influence(Some([1, -1]), &example).holds());
        assert!(!best_influence(Some([0, -1]), &example).holds());
        assert!(!best_influence(None, &example).holds());
    }

    #[test]
    fn a_set_that_may_not_act_is_never_the_best() {
        let useless = [[1, 1], [-1, 1], [0, 1], [1, 0]];
        assert!(best_influence(None, &useless).holds());
        for set in useless {
            assert!(!best_influence(Some(set), &useless).holds());
        }
        assert!(!best_influence(Some([1, -1]), &[[-1, -1]]).holds());
    }
}
