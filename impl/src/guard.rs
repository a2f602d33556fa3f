//! This file says what may come into a tick and what may leave it; whatever else comes, the brakes are let go (decision 0074).

#[cfg(any(kani, feature = "claims"))]
pub mod proofs;

use rigproof_spec::command::Reason;
use rigproof_spec::joint::Joint;
use rigproof_spec::tables::GREATEST_CURRENT_A;

use crate::command::Command;
use crate::number::{Scalar, least, most};
use crate::velocity::LONGEST_WINDOW;

/// Ticks without a new sample over which the last command holds; in the next one the brakes are let go.
pub const MOST_REPEATS: u8 = 2;
/// How far beside the amplifiers' range a law's current may lie, A: a hundredth of it, far beyond rounding.
pub const SLACK_A: f64 = 0.01 * GREATEST_CURRENT_A;
/// Good samples in a row after a start or a fault from which on a law is asked: the newest and a whole window of velocity before it.
pub const RECOVERY_SAMPLES: u8 = LONGEST_WINDOW as u8 + 1;

/// What the guard makes of a sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// New and sound.
    Good,
    /// New and sound, but one of the first.
    Early,
    /// The one that is known already, and not for long.
    Repeated,
    /// Not to be used.
    Fault(Reason),
}

/// What watches the samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Guard<S> {
    /// Most counts from one sample to the next, A and B.
    greatest_step: [u32; 2],
    greatest_force_n: S,
    last_number: Option<u32>,
    /// The last travels that were possible: whatever comes later has to lie beside them.
    believed: Option<[i32; 2]>,
    repeats: u8,
    good: u8,
}

impl<S: Scalar> Guard<S> {
    /// A guard that has seen nothing: most counts a sample of A and B, and the greatest force that the sensor gives, N.
    pub fn new(greatest_step: [u32; 2], greatest_force_n: S) -> Guard<S> {
        Guard {
            greatest_step,
            greatest_force_n,
            last_number: None,
            believed: None,
            repeats: 0,
            good: 0,
        }
    }

    /// Judges a sample: its number, the travels of A and B and whether they are possible, the force on the tip, N.
    #[inline]
    pub fn judge(
        &mut self,
        number: u32,
        travels: [i32; 2],
        reached: bool,
        force_n: [S; 2],
    ) -> Verdict {
        if self.last_number == Some(number) {
            return self.repeat();
        }
        let jumped = !reached || self.has_jumped(travels);
        let fault = if jumped {
            Some(Reason::JumpedCounts)
        } else if self.has_missed(number) {
            Some(Reason::StaleSample)
        } else if !force_n
            .into_iter()
            .all(|component| component.is_within(self.greatest_force_n))
        {
            Some(Reason::UndefinedInput)
        } else {
            None
        };
        self.last_number = Some(number);
        if !jumped {
            self.believed = Some(travels);
        }
        self.repeats = 0;
        if let Some(reason) = fault {
            self.good = 0;
            return Verdict::Fault(reason);
        }
        self.good = self.good.saturating_add(1);
        if self.good < RECOVERY_SAMPLES {
            Verdict::Early
        } else {
            Verdict::Good
        }
    }

    fn repeat(&mut self) -> Verdict {
        self.repeats = self.repeats.saturating_add(1);
        if self.repeats <= MOST_REPEATS {
            return Verdict::Repeated;
        }
        self.good = 0;
        Verdict::Fault(Reason::StaleSample)
    }

    /// Whether a sample came out of turn.
    fn has_missed(&self, number: u32) -> bool {
        self.last_number
            .is_some_and(|last| number != last.wrapping_add(1))
    }

    /// Whether a joint is further from where it was last believed than it can move in one sample. Counts that were lost stay lost: the
    /// brakes are free until the counter is back or the controller is made anew.
    fn has_jumped(&self, travels: [i32; 2]) -> bool {
        let Some(believed) = self.believed else {
            return false;
        };
        travels
            .into_iter()
            .zip(believed)
            .zip(self.greatest_step)
            .any(|((travel, believed), greatest)| travel.abs_diff(believed) > greatest)
    }
}

/// What may leave: currents of 0 to 1 A on brakes that are there and that the reason names. A law that asks for anything else is
/// taken for broken and the brakes are let go; only what lies beside the range by [`SLACK_A`] or less is put at its end (decision 0101).
///
/// A brake takes power from its joint whichever way that turns, so that a current has no sign to be wrong; which brake may act is
/// the law's to know.
#[inline]
pub fn release<S: Scalar>(command: Command<S>, braked: [bool; 4]) -> Command<S> {
    let [with_a, with_e, with_b, with_c] = braked;
    let [named_a, named_e, named_b, named_c] = named(command.reason);
    let [a, e, b, c] = command.currents_a;
    let allowed =
        |may_act: bool, current_a: S| (current_a == S::zero()) | (may_act & is_in_range(current_a));
    if allowed(with_a & named_a, a)
        & allowed(with_e & named_e, e)
        & allowed(with_b & named_b, b)
        & allowed(with_c & named_c, c)
    {
        Command {
            currents_a: [clamped(a), clamped(e), clamped(b), clamped(c)],
            reason: command.reason,
        }
    } else {
        Command::none(Reason::RefusedCommand)
    }
}

/// Whether a current is in the amplifiers' range, or beside it by [`SLACK_A`] or less; what is no number is not.
#[inline]
fn is_in_range<S: Scalar>(current_a: S) -> bool {
    (S::of(-SLACK_A) <= current_a) & (current_a <= S::of(GREATEST_CURRENT_A + SLACK_A))
}

/// A current put inside what the amplifiers take, A; none for what is no number.
fn clamped<S: Scalar>(current_a: S) -> S {
    most(least(S::of(GREATEST_CURRENT_A), current_a), S::zero())
}

/// The joints, A, E, B, C, to whose brakes a reason gives current.
#[inline(always)]
fn named(reason: Reason) -> [bool; 4] {
    match reason {
        Reason::Chosen(chosen) => Joint::ALL.map(|joint| joint == chosen),
        Reason::ChosenPair(one, other) => Joint::ALL.map(|joint| joint == one || joint == other),
        reason => [reason.is_lock(); 4],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FORCE_N: [f64; 2] = [3.7, -1.9];

    /// A guard after so many good samples, the last of number 41 + `samples` at travels (613, −287).
    fn running(samples: u32) -> Guard<f64> {
        let mut guard = Guard::new([479, 97], 200.0);
        for number in 42..42 + samples {
            guard.judge(number, [613, -287], true, FORCE_N);
        }
        guard
    }

    #[test]
    fn a_law_is_asked_after_a_whole_window_of_good_samples() {
        let mut guard = running(u32::from(RECOVERY_SAMPLES) - 2);
        assert_eq!(guard.judge(49, [613, -287], true, FORCE_N), Verdict::Early);
        assert_eq!(guard.judge(50, [613, -287], true, FORCE_N), Verdict::Good);
    }

    #[test]
    fn a_number_may_wrap_round() {
        let mut guard = Guard::<f64>::new([479, 97], 200.0);
        guard.judge(u32::MAX, [613, -287], true, FORCE_N);
        assert_eq!(guard.judge(0, [613, -287], true, FORCE_N), Verdict::Early);
    }

    #[test]
    fn a_missed_sample_is_a_fault_until_the_window_is_full_again() {
        let mut guard = running(20);
        let stale = Verdict::Fault(Reason::StaleSample);
        assert_eq!(guard.judge(63, [613, -287], true, FORCE_N), stale);
        for number in 64..72 {
            assert_eq!(
                guard.judge(number, [613, -287], true, FORCE_N),
                Verdict::Early
            );
        }
        assert_eq!(guard.judge(72, [613, -287], true, FORCE_N), Verdict::Good);
        assert_eq!(guard.judge(70, [613, -287], true, FORCE_N), stale);
    }

    #[test]
    fn a_sample_may_repeat_twice() {
        let mut guard = running(20);
        let mut again = || guard.judge(61, [613, -287], true, FORCE_N);
        assert_eq!([again(), again()], [Verdict::Repeated; 2]);
        for _ in 0..600 {
            assert_eq!(again(), Verdict::Fault(Reason::StaleSample));
        }
        assert_eq!(guard.judge(62, [613, -287], true, FORCE_N), Verdict::Early);
    }

    #[test]
    fn lost_counts_are_never_believed_again() {
        let jumped = Verdict::Fault(Reason::JumpedCounts);
        let mut guard = running(20);
        // The number of the first is missed as well.
        for number in 63..900 {
            assert_eq!(
                guard.judge(number, [613 - 5000, -287], true, FORCE_N),
                jumped
            );
        }
        for number in 900..908 {
            assert_eq!(
                guard.judge(number, [620, -287], true, FORCE_N),
                Verdict::Early
            );
        }
        assert_eq!(guard.judge(908, [620, -287], true, FORCE_N), Verdict::Good);
    }

    #[test]
    fn a_joint_that_jumps_or_stands_where_it_cannot_is_a_fault() {
        let jumped = Verdict::Fault(Reason::JumpedCounts);
        for (travels, expected) in [
            ([613 + 479, -287 - 97], Verdict::Good),
            ([613 + 480, -287], jumped),
            ([613, -287 - 98], jumped),
            ([i32::MIN, -287], jumped),
        ] {
            assert_eq!(running(20).judge(62, travels, true, FORCE_N), expected);
        }
        assert_eq!(running(20).judge(62, [613, -287], false, FORCE_N), jumped);
    }

    #[test]
    fn a_force_that_is_none_or_beyond_its_sensor_is_a_fault() {
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 200.1, -1e300] {
            for force_n in [[bad, 1.3], [1.3, bad]] {
                let verdict = running(20).judge(62, [613, -287], true, force_n);
                assert_eq!(verdict, Verdict::Fault(Reason::UndefinedInput));
            }
        }
    }

    #[test]
    fn what_no_brake_may_be_given_is_refused() {
        let all = [true; 4];
        let three = [true, true, true, false];
        for (currents_a, reason, braked) in [
            ([f64::NAN, 0.0, 0.0, 0.0], Reason::Chosen(Joint::A), all),
            (
                [0.0, f64::INFINITY, 0.0, 0.0],
                Reason::LockedMovingBack,
                all,
            ),
            ([0.0, 0.0, 1.011, 0.0], Reason::Chosen(Joint::B), all),
            ([-0.011, 0.0, 0.0, 0.0], Reason::Chosen(Joint::A), all),
            ([0.31, 0.7, 1.9, 0.2], Reason::LockedMovingBack, all),
            ([0.31, 0.0, 0.0, 0.0], Reason::Chosen(Joint::E), all),
            ([0.0, 0.0, 0.31, 0.0], Reason::NoneHelps, all),
            ([0.0, 0.0, 0.0, 0.31], Reason::Chosen(Joint::C), three),
            ([0.31, 0.7, 0.2, 0.31], Reason::LockedPushedAway, three),
            (
                [0.31, 0.7, 0.2, 0.0],
                Reason::ChosenPair(Joint::A, Joint::B),
                all,
            ),
        ] {
            let released = release(Command { currents_a, reason }, braked);
            assert_eq!(released, Command::none(Reason::RefusedCommand));
        }
    }

    #[test]
    fn a_current_beside_the_range_is_put_at_its_end() {
        let reason = Reason::LockedMovingBack;
        let currents_a = [1.000_7, -0.003, 0.37, 0.999_3];
        let released = release(Command { currents_a, reason }, [true; 4]);
        assert_eq!(released.currents_a, [1.0, 0.0, 0.37, 0.999_3]);
        assert_eq!(released.reason, reason);
    }

    #[test]
    fn a_current_of_minus_zero_leaves_without_its_sign() {
        let asked = Command {
            currents_a: [-0.0, 0.37, -0.0, 0.0],
            reason: Reason::Chosen(Joint::E),
        };
        let currents_a: [f64; 4] = release(asked, [true; 4]).currents_a;
        assert_eq!(currents_a, [0.0, 0.37, 0.0, 0.0]);
        assert!(
            currents_a
                .iter()
                .all(|current_a| current_a.is_sign_positive())
        );
    }

    #[test]
    fn a_named_brake_may_be_given_no_current() {
        for (currents_a, reason) in [
            ([0.0; 4], Reason::Chosen(Joint::B)),
            (
                [0.31, 0.0, 0.0, 0.0],
                Reason::ChosenPair(Joint::A, Joint::C),
            ),
            (
                [0.0, 0.0, 0.0, 0.31],
                Reason::ChosenPair(Joint::A, Joint::C),
            ),
            ([0.31, 0.0, 0.7, 0.2], Reason::LockedPushedAway),
        ] {
            let asked = Command { currents_a, reason };
            assert_eq!(release(asked, [true; 4]), asked);
        }
    }
}
