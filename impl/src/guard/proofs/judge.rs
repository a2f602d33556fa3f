//! This file holds what is claimed about what comes into a tick: one sample after any others.

use rigproof_spec::command::Reason;

use crate::claim::Checker;
use crate::claims;
use crate::guard::{Guard, Verdict};
use crate::number::Scalar;
use crate::tick::GREATEST_FORCE_RANGE_N;

/// Most counts a sample, A and B.
const GREATEST_STEP: [u32; 2] = [479, 97];
/// Good samples in a row before the one that a law is asked about, and ticks without a new sample that are let pass (decision 0074).
const WINDOW: u8 = 8;
const REPEATS: u8 = 2;

/// One sample in the hands of a guard.
struct Step<S> {
    before: Guard<S>,
    after: Guard<S>,
    number: u32,
    travels: [i32; 2],
    verdict: Verdict,
    /// Whether a joint is where it cannot be, or further from where it was believed than it can move.
    jumped: bool,
}

impl<S> Step<S> {
    /// Whether it is the sample that was known already.
    fn is_again(&self) -> bool {
        self.before.last_number == Some(self.number)
    }
}

/// The one of a list that is chosen.
fn one_of<C: Checker, T: Copy, const N: usize>(c: &mut C, all: [T; N]) -> Option<T> {
    let count = u8::try_from(N).ok()?;
    all.into_iter().nth(usize::from(c.choice(count)))
}

/// Any sample after any others: every state of the guard and every sample, of each kind that it tells apart the ends.
fn step<C: Checker>(c: &mut C) -> Option<Step<C::Number>> {
    let last_number = one_of(c, [None, Some(41), Some(u32::MAX)])?;
    let believed = one_of(c, [None, Some([613, -287]), Some([i32::MAX, i32::MIN])])?;
    let greatest_force_n = C::Number::of(200.0);
    let before = Guard {
        greatest_step: GREATEST_STEP,
        greatest_force_n,
        last_number,
        believed,
        repeats: one_of(c, [0, 1, 2, 3, u8::MAX])?,
        good: one_of(c, [0, 1, WINDOW - 1, WINDOW, WINDOW + 1, u8::MAX])?,
    };
    let last = last_number.unwrap_or(7);
    let number = one_of(c, [0, 1, 2, u32::MAX])?;
    let number = last.wrapping_add(number);
    let [a, b] = believed.unwrap_or([17, 23]);
    let a = a.wrapping_add(one_of(c, [0, 479, -479, 480, -480, i32::MIN])?);
    let b = b.wrapping_add(one_of(c, [0, 97, 98])?);
    let travels = [a, b];
    let reached = c.choice(2) == 1;
    let force = one_of(c, [200.0, 200.5, f64::NAN])?;
    let force_n = [C::Number::of(-1.5), C::Number::of(force)];
    let far = |believed: [i32; 2]| {
        let apart = |one: i32, other: i32| (i64::from(one) - i64::from(other)).unsigned_abs();
        let [of_a, of_b] = believed;
        apart(a, of_a) > 479 || apart(b, of_b) > 97
    };
    let mut after = before;
    let verdict = after.judge(number, travels, reached, force_n);
    Some(Step {
        before,
        after,
        number,
        travels,
        verdict,
        jumped: !reached || believed.is_some_and(far),
    })
}

claims! {
    /// A new sample is refused as jumped if and only if a joint is where it cannot be, or further from where it was last believed than it can
    /// move in one sample. What is refused so is not believed, everything else is: counts that were lost are never believed, however many
    /// samples go by.
    /// Source: decision 0074. Assumes nothing; of counts and numbers, which are only compared, the ends of every kind stand for the kind.
    Finite fn what_jumped_has_to_come_back(c) {
        let step = step(c)?;
        c.assume(!step.is_again())?;
        c.cover("jumped", step.jumped);
        c.cover("came back", !step.jumped);
        c.check((step.verdict == Verdict::Fault(Reason::JumpedCounts)) == step.jumped)?;
        let believed = if step.jumped { step.before.believed } else { Some(step.travels) };
        c.check(step.after.believed == believed)?;
    }

    /// A law is asked about a sample if and only if it and at least eight before it in a row were good: every fault begins the count anew, and
    /// a repeated sample does not count.
    /// Source: decision 0074. Assumes nothing; as above.
    Finite fn a_law_is_asked_after_a_whole_window_only(c) {
        let step = step(c)?;
        let (before, after) = (step.before.good, step.after.good);
        c.cover("good", step.verdict == Verdict::Good);
        c.cover("early", step.verdict == Verdict::Early);
        let counted = after == before.saturating_add(1);
        c.check(match step.verdict {
            Verdict::Good => before >= WINDOW && counted,
            Verdict::Early => before < WINDOW && counted,
            Verdict::Repeated => after == before,
            Verdict::Fault(_) => after == 0,
        })?;
    }

    /// A sample that is known already passes twice and is stale from then on, whatever else it says; nothing of it is believed.
    /// Source: decision 0074. Assumes nothing; as above.
    Finite fn a_repeated_sample_passes_twice(c) {
        let step = step(c)?;
        let passes = step.before.repeats < REPEATS;
        c.cover("passes", step.is_again() && passes);
        c.cover("is stale", step.is_again() && !passes);
        if step.is_again() {
            let stale = Verdict::Fault(Reason::StaleSample);
            c.check(step.verdict == if passes { Verdict::Repeated } else { stale })?;
            c.check(step.after.believed == step.before.believed)?;
            c.check(step.after.last_number == step.before.last_number)?;
            c.check(step.after.repeats == step.before.repeats.saturating_add(1))?;
        } else {
            c.check(step.verdict != Verdict::Repeated && step.after.repeats == 0)?;
            c.check(step.after.last_number == Some(step.number))?;
        }
    }

    /// A new sample is stale if and only if its number is not the next one, beyond 2³² − 1 the first one, and nothing jumped; before the first
    /// sample none was missed.
    /// Source: decision 0074. Assumes nothing; as above.
    Finite fn a_missed_sample_is_stale(c) {
        let step = step(c)?;
        c.assume(!step.is_again())?;
        let next = |last: u32| if last == u32::MAX { 0 } else { last + 1 };
        let missed = step.before.last_number.is_some_and(|last| step.number != next(last));
        c.cover("missed", missed && !step.jumped);
        c.cover("in turn", !missed);
        let stale = step.verdict == Verdict::Fault(Reason::StaleSample);
        c.check(stale == (missed && !step.jumped))?;
    }

    /// A sample in turn is used if and only if both components of its force are numbers of at most the sensor's greatest.
    /// Source: decision 0074, law `undefined_input`. Assumes a greatest force that settings allow.
    Numbers fn a_force_beyond_its_sensor_is_not_used(c) {
        let (x, y, greatest_n) = (c.scalar(), c.scalar(), c.scalar());
        let [_, most_n] = GREATEST_FORCE_RANGE_N.map(C::Number::of);
        c.assume(greatest_n.is_within(most_n))?;
        let mut guard = Guard::new(GREATEST_STEP, greatest_n);
        let verdict = guard.judge(41, [613, -287], true, [x, y]);
        let inside = |force: C::Number| -greatest_n <= force && force <= greatest_n;
        let sound = inside(x) && inside(y);
        c.cover("used", sound);
        c.cover("refused", !sound);
        c.check(verdict == if sound { Verdict::Early } else { Verdict::Fault(Reason::UndefinedInput) })?;
    }
}
