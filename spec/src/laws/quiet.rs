//! This file says when a controller must leave every brake alone, and when it may lock them all.

use super::Margin;
use crate::command::Command;

/// Minus the greatest current of a command, A: zero when every brake is left alone.
fn silence(command: &Command) -> Margin {
    command
        .currents_a
        .iter()
        .fold(Margin(0.0), |margin, current_a| {
            margin.and(Margin(-current_a.abs()))
        })
}

/// Whether no brake acts inside the gap around the path; the margin is minus the greatest current there, A.
///
/// Source: §6.5.1, "a gap surrounding the desired path within which no control action is taken".
pub fn gap(distance_m: f64, gap_m: f64, command: &Command) -> Margin {
    if distance_m <= gap_m {
        silence(command)
    } else {
        Margin(0.0)
    }
}

/// Whether no brake acts on the free side of an obstacle's boundary; the margin is minus the greatest current, A.
///
/// `depth_m` is how far the tip is inside the obstacle, negative on the free side.
///
/// Source: §7.3, "control action would only be taken on the obstacle side of the path".
pub fn free_side(depth_m: f64, command: &Command) -> Margin {
    if depth_m > 0.0 {
        Margin(0.0)
    } else {
        silence(command)
    }
}

/// Whether a command that rests on an undefined input leaves every brake alone; the margin is minus the greatest
/// current, A.
///
/// Source: none in the thesis: a rig that a person holds lets go when it does not know where it is.
pub fn undefined_input(inputs: &[f64], command: &Command) -> Margin {
    if inputs.iter().all(|input| input.is_finite()) {
        Margin(0.0)
    } else {
        silence(command)
    }
}

/// Whether a lock was called for; the margin is the greater of the force away from the path, N, and the speed
/// against the desired direction, m/s.
///
/// `force_towards_path_n` is the operator's force in the direction of the path, `speed_along_desired_m_s` is `v_βx`.
///
/// Source: §6.2, §6.3: locked if the input force points away from the path, or if `v_βx` is less than zero.
pub fn lock(force_towards_path_n: f64, speed_along_desired_m_s: f64, command: &Command) -> Margin {
    if command.reason.is_lock() {
        let undefined = force_towards_path_n.is_nan() || speed_along_desired_m_s.is_nan();
        if undefined {
            Margin(f64::NAN)
        } else {
            Margin((-force_towards_path_n).max(-speed_along_desired_m_s))
        }
    } else {
        Margin(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::command::Reason;
    use crate::joint::Joint;

    const ACTING: Command = Command {
        currents_a: [0.0, 0.43, 0.0, 0.0],
        reason: Reason::Chosen(Joint::E),
    };
    const LOCKED: Command = Command {
        currents_a: [1.0; 4],
        reason: Reason::LockedPushedAway,
    };

    #[test]
    fn current_inside_the_gap_breaks_the_law() {
        assert_eq!(gap(0.0031, 0.0047, &ACTING), Margin(-0.43));
        assert!(gap(0.0053, 0.0047, &ACTING).holds());
        assert!(gap(0.0031, 0.0047, &Command::none(Reason::InsideGap)).holds());
    }

    #[test]
    fn current_on_the_free_side_breaks_the_law() {
        assert!(!free_side(-0.013, &ACTING).holds());
        assert!(!free_side(0.0, &ACTING).holds());
        assert!(!free_side(f64::NAN, &ACTING).holds());
        assert!(free_side(0.013, &ACTING).holds());
    }

    #[test]
    fn current_on_an_undefined_input_breaks_the_law() {
        assert!(!undefined_input(&[0.31, f64::NAN], &ACTING).holds());
        assert!(!undefined_input(&[f64::NEG_INFINITY, 0.31], &LOCKED).holds());
        assert!(undefined_input(&[0.31, 0.17], &ACTING).holds());
        let silent = Command::none(Reason::UndefinedInput);
        assert!(undefined_input(&[f64::NAN], &silent).holds());
    }

    #[test]
    fn a_lock_needs_a_push_away_or_a_motion_back() {
        assert!(lock(-0.7, 0.03, &LOCKED).holds());
        assert!(lock(0.7, -0.03, &LOCKED).holds());
        assert!(!lock(0.7, 0.03, &LOCKED).holds());
        assert!(!lock(f64::NAN, -0.03, &LOCKED).holds());
        assert!(lock(0.7, 0.03, &ACTING).holds());
    }
}
