//! This file holds what is claimed about a whole selection: four brakes, the gate and the locks.

use rigproof_spec::command::Reason;
use rigproof_spec::joint::Joint;

use super::{desired, vector};
use crate::claim::Checker;
use crate::claims;
use crate::number::Scalar;
use crate::select::{Candidate, Decision, Desired, Rows, is_sound, proportional, sdof};
use crate::vector::Vector;

/// All that a selection is told.
struct Told<S> {
    rows: Rows<S>,
    velocity: Vector<S>,
    force: Vector<S>,
    desired: Desired<S>,
}

/// Any rows, each there or not, and anything else.
fn told<C: Checker>(c: &mut C) -> Told<C::Number> {
    let there = [0; 4].map(|_| c.choice(2) == 1);
    told_of(c, there)
}

/// Any two rows at any places, or one, and anything else.
fn told_of_two<C: Checker>(c: &mut C) -> Told<C::Number> {
    let (one, other) = (c.choice(4), c.choice(4));
    told_of(c, [0, 1, 2, 3].map(|place| place == one || place == other))
}

fn told_of<C: Checker>(c: &mut C, there: [bool; 4]) -> Told<C::Number> {
    let rows = there.map(|there| there.then(|| vector(c)));
    let off_path = c.choice(2) == 1;
    Told {
        rows,
        velocity: vector(c),
        force: vector(c),
        desired: desired(c, off_path),
    }
}

impl<S: Scalar> Told<S> {
    fn proportional(&self) -> Decision {
        proportional::decide(&self.rows, self.velocity, self.force, &self.desired)
    }

    fn sdof(&self, in_gap: bool) -> Decision {
        sdof::decide(&self.rows, self.force, &self.desired, in_gap)
    }

    fn is_sound(&self) -> bool {
        is_sound(&self.rows, &[self.velocity, self.force], &self.desired)
    }

    fn pushes_away(&self) -> bool {
        let zero = S::zero();
        self.desired
            .towards
            .is_some_and(|towards| towards.dot(self.force) < zero)
    }
}

/// The one number of a vector list that is not finite, whichever it is.
fn spoil<C: Checker>(c: &mut C, vectors: &mut [Option<&mut Vector<C::Number>>]) -> Option<()> {
    let count = u8::try_from(2 * vectors.len()).ok()?;
    let place = usize::from(c.choice(count));
    let value = c.scalar();
    let greatest = c.greatest();
    c.assume(!value.is_within(greatest))?;
    let vector = vectors.get_mut(place / 2)?.as_mut()?;
    if place % 2 == 0 {
        vector.x = value;
    } else {
        vector.y = value;
    }
    Some(())
}

/// What a decision has to be, given which brakes may act: the first of them, or a lock, or nothing.
fn check_choice<C: Checker>(
    c: &mut C,
    decision: Decision,
    candidates: [Option<Candidate<C::Number>>; 4],
    pushes_away: impl FnOnce() -> bool,
) -> Option<()> {
    let least = candidates
        .iter()
        .flatten()
        .map(|candidate| candidate.rank)
        .min();
    match decision {
        Decision::Act(chosen) => {
            let of_chosen = Joint::ALL
                .into_iter()
                .zip(candidates)
                .find(|(joint, _)| *joint == chosen);
            let rank = of_chosen
                .and_then(|(_, candidate)| candidate)
                .map(|candidate| candidate.rank);
            c.check(rank.is_some() && rank == least)
        }
        Decision::Lock(reason) => {
            c.check(reason == Reason::LockedPushedAway && least.is_none() && pushes_away())
        }
        Decision::Rest(reason) => {
            c.check(reason == Reason::NoneHelps && least.is_none() && !pushes_away())
        }
    }
}

/// Brakes of every kind that proportional control tells apart, for a velocity (1, 1) and a desired direction (1, 0): the row, and its place
/// in the printed order, of those that may act. Two of each rank, one closer than the other, in both senses of the joint.
const KINDS: [([i8; 2], Option<u8>); 9] = [
    ([1, -2], Some(0)),
    ([-1, 2], Some(0)),
    ([1, -3], Some(1)),
    ([0, -1], Some(2)),
    ([0, 2], Some(2)),
    ([-1, -3], Some(3)),
    ([1, 2], Some(4)),
    ([-2, 1], None),
    ([1, -1], None),
];

claims! {
    /// Any four brakes, each absent or of any kind that can be told apart, under proportional control: the first of the best acts; none that may
    /// act is passed over; without one a push away locks. With what is proved of one brake this holds for the controller.
    /// Source: §6.3. Assumes nothing: kinds, places, locks and ties are all there are.
    Finite fn any_four_brakes_are_ranked_by_proportional_control(c) {
        let of = |[x, y]: [i8; 2]| Vector::new(C::Number::from(x), C::Number::from(y));
        let kinds = [0; 4].map(|_| KINDS.into_iter().nth(usize::from(c.choice(10))));
        let (back, push) = (c.choice(2) == 1, c.choice(3));
        let desired = Desired {
            direction: of([if back { -1 } else { 1 }, 0]),
            along: of([1, 0]),
            towards: (push != 0).then(|| of([0, 1])),
        };
        let rows = kinds.map(|kind| kind.map(|(row, _)| of(row)));
        let force = of([1, if push == 1 { -1 } else { 1 }]);
        let decision = proportional::decide(&rows, of([1, 1]), force, &desired);
        let mut first: Option<(u8, Joint)> = None;
        for (joint, kind) in Joint::ALL.into_iter().zip(kinds) {
            if let Some((_, Some(place))) = kind {
                first = Some(first.map_or((place, joint), |first| first.min((place, joint))));
            }
        }
        c.cover("moves back", back);
        c.cover("acts", matches!(decision, Decision::Act(_)));
        c.cover("is pushed away", decision == Decision::Lock(Reason::LockedPushedAway));
        c.check(decision == match first {
            _ if back => Decision::Lock(Reason::LockedMovingBack),
            Some((_, joint)) => Decision::Act(joint),
            None if push == 1 => Decision::Lock(Reason::LockedPushedAway),
            None => Decision::Rest(Reason::NoneHelps),
        })?;
    }

    /// Whichever number is infinite or undefined, proportional control leaves every brake alone.
    /// Source: none in the thesis: law `undefined_input`. Assumes one such number, at any place.
    Numbers fn nothing_undefined_acts_under_proportional_control(c) {
        let mut told = told(c);
        let Told { rows: [a, e, b, c_row], velocity, force, desired, .. } = &mut told;
        let mut places = [
            a.as_mut(), e.as_mut(), b.as_mut(), c_row.as_mut(), Some(velocity), Some(force),
            Some(&mut desired.direction), Some(&mut desired.along), desired.towards.as_mut(),
        ];
        spoil(c, &mut places)?;
        c.cover("any number", true);
        c.check(told.proportional() == Decision::Rest(Reason::UndefinedInput))?;
    }

    /// Whichever number is infinite or undefined, SDOF control leaves every brake alone.
    /// Source: none in the thesis: law `undefined_input`. Assumes one such number, at any place that it reads.
    Numbers fn nothing_undefined_acts_under_sdof_control(c) {
        let mut told = told(c);
        let Told { rows: [a, e, b, c_row], force, desired, .. } = &mut told;
        let mut places = [
            a.as_mut(), e.as_mut(), b.as_mut(), c_row.as_mut(), Some(force),
            Some(&mut desired.direction), Some(&mut desired.along), desired.towards.as_mut(),
        ];
        spoil(c, &mut places)?;
        c.cover("any number", true);
        let in_gap = c.choice(2) == 1;
        c.check(told.sdof(in_gap) == Decision::Rest(Reason::UndefinedInput))?;
    }

    /// Any two brakes at any places under proportional control: the one that acts is one that may act by itself, none of a better rank is
    /// passed over; a lock needs a motion back, or no brake that may act and a push away; and nothing else is decided. Of all four
    /// together: `any_four_brakes_are_ranked_by_proportional_control`.
    /// Source: §6.3. Assumes the gate.
    Numbers fn proportional_control_is_its_brakes_and_its_core(c) {
        let told = told_of_two(c);
        c.assume(told.is_sound())?;
        let decision = told.proportional();
        let moves_back = told.desired.direction.dot(told.velocity) < C::Number::zero();
        c.cover("acts", matches!(decision, Decision::Act(_)));
        c.cover("moves back", moves_back);
        c.cover("is pushed away", decision == Decision::Lock(Reason::LockedPushedAway));
        c.cover("rests", decision == Decision::Rest(Reason::NoneHelps));
        if moves_back {
            c.check(decision == Decision::Lock(Reason::LockedMovingBack))?;
        } else {
            let one = |row| proportional::classify(row, told.velocity, told.desired.direction);
            let candidates = told.rows.map(|row| row.and_then(one));
            check_choice(c, decision, candidates, || told.pushes_away())?;
        }
    }

    /// Four brakes under SDOF control: nothing inside the gap or on the path; else as of proportional control, without its lock of a motion
    /// back.
    /// Source: §6.2, §6.5.1. Assumes the gate.
    Numbers fn sdof_control_is_its_brakes_and_its_core(c) {
        let told = told(c);
        c.assume(told.is_sound())?;
        let in_gap = c.choice(2) == 1;
        let decision = told.sdof(in_gap);
        c.cover("acts", matches!(decision, Decision::Act(_)));
        c.cover("is in the gap", in_gap);
        c.cover("is pushed away", decision == Decision::Lock(Reason::LockedPushedAway));
        c.cover("rests", decision == Decision::Rest(Reason::NoneHelps));
        match told.desired.towards.filter(|_| !in_gap) {
            None => c.check(decision == Decision::Rest(Reason::InsideGap))?,
            Some(towards) => {
                let one = |row| sdof::classify(row, &told.desired, towards);
                let candidates = told.rows.map(|row| row.and_then(one));
                check_choice(c, decision, candidates, || told.pushes_away())?;
            }
        }
    }
}
