//! This file says what a driven axis and its controller must keep to.

use super::Margin;

/// Whether an effort is a number and within a limit to either side; the margin is in the effort's unit, N or N·m.
///
/// Source: the continuous rating of the drive, which the description of the trial states.
pub fn effort_limit(effort: f64, greatest: f64) -> Margin {
    Margin(greatest - effort.abs())
}

/// Whether a position lies between two stops; the margin to the nearer one is in m or rad.
///
/// Source: the travel of the axis, which the description of the trial states.
pub fn travel(position: f64, [low, high]: [f64; 2]) -> Margin {
    Margin(position - low).and(Margin(high - position))
}

/// Whether a command turns back no more often than is allowed; the margin is in reversals.
///
/// Source: chatter wears a drive and says nothing of the target.
pub fn reversals(count: u32, most: f64) -> Margin {
    Margin(most - f64::from(count))
}

/// Whether the energy that was given, J, and the energy that a spring holds now are no more than it held at first; the margin is what is left, J.
///
/// `slack` is what a sampled and rounded position may hide.
///
/// Source: a passive port gives no more than it stored: ∫ f·v dt ≤ E(0) − E(t) (Colgate and Schenkel 1997).
pub fn spring_passivity(given: f64, held_first: f64, held_now: f64, slack: f64) -> Margin {
    Margin(held_first + slack - held_now - given)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_effort_without_a_number_or_beyond_its_limit_breaks_the_law() {
        assert_eq!(effort_limit(-7.5, 9.0), Margin(1.5));
        for effort in [9.1, -9.1, f64::NAN, f64::INFINITY] {
            assert!(!effort_limit(effort, 9.0).holds(), "{effort}");
        }
    }

    #[test]
    fn a_position_counts_to_the_nearer_stop() {
        assert_eq!(travel(0.75, [-1.0, 1.0]), Margin(0.25));
        assert_eq!(travel(-1.25, [-1.0, 1.0]), Margin(-0.25));
        assert!(!travel(f64::NAN, [-1.0, 1.0]).holds());
    }

    #[test]
    fn a_command_may_turn_back_so_often_and_no_more() {
        assert!(reversals(7, 7.0).holds() && !reversals(8, 7.5).holds());
    }

    #[test]
    fn energy_that_no_spring_held_breaks_the_law() {
        assert!(spring_passivity(0.31, 0.75, 0.44, 1e-9).holds());
        assert!(!spring_passivity(0.31, 0.75, 0.45, 1e-3).holds());
        assert!(!spring_passivity(f64::NAN, 0.75, 0.0, 1e-3).holds());
    }
}
