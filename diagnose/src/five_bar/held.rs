//! This file says what a joint at rest tells: it was pushed with so much and did not move.
//!
//! What a held joint transmits is a reaction and no measurement of any law, but a bound on all of them together: its brake and its friction
//! hold at least as much (Coulomb 1785). No such window is fitted, so these are evidence of their own for what was named.

use super::brakes;
use super::columns::{driving, free};
use super::diagnose::modelled;
use super::noise::pair_covariances;
use super::run::{FiveBarRun, place};
use crate::evidence::coefficients_by_term;
use crate::problem::{Cause, Problem, Term, add};
use crate::regression::dot;
use crate::report::{HeldJoint, HeldReport};
use crate::select::{Selection, refs, usable_rms};
use crate::weak::{Windows, is_recorded};
use nalgebra::Vector2;
use rigproof_spec::effect::Mechanism;
use rigproof_spec::joint::Joint;

/// Standard deviations of its noise by which a reaction must be beyond what holds the joint before something is said to be missing: several
/// thousand windows are looked at.
const BEYOND_SIGMAS: f64 = 5.0;

/// What the windows say in which one brake alone is at rest. Where every brake is, three or four share what two equations tell: nothing is
/// attributed.
pub fn held(problem: &Problem, run: &FiveBarRun, selection: &Selection) -> HeldReport {
    let (alone, all) = at_rest(problem, run);
    let window_s = problem.windows.hop as f64 * problem.windows.step_s;
    let reactions = reactions(problem, run, selection, &alone);
    let joints = run.parameters.layout.brakes().iter();
    HeldReport {
        joints: joints
            .filter_map(|joint| {
                let own: Vec<&Reaction> = reactions.iter().filter(|r| r.joint == *joint).collect();
                told(problem, run, selection, *joint, &own)
            })
            .collect(),
        all_held_s: all as f64 * window_s,
        unit: "N·m".to_owned(),
    }
}

/// For every window the joint that alone is at rest in all of it, if the others are told; and in how many windows every brake is at rest.
fn at_rest(problem: &Problem, run: &FiveBarRun) -> (Vec<Option<Joint>>, usize) {
    let Windows {
        bump,
        outputs,
        centres,
        usable,
        combined,
        ..
    } = &problem.windows;
    let resting = Joint::ALL.map(|joint| resting(run, joint));
    let rests = |joint: Joint, centre: usize| {
        let first = centre - bump.len() / 2;
        let samples = resting.get(place(joint));
        let window = samples.and_then(|all| all.get(first..first + bump.len()));
        window.is_some_and(|window| window.iter().all(|rests| *rests))
    };
    let brakes = run.parameters.layout.brakes();
    let mut all = 0;
    let rows = centres.chunks(*outputs).zip(usable.chunks(*outputs));
    let alone = rows.zip(combined.chunks(*outputs));
    let alone = alone.map(|((centres, usable), combined)| {
        let centre = *centres.first()?;
        let every = brakes.iter().all(|joint| rests(*joint, centre));
        all += usize::from(every && is_recorded(&run.recorded, centre, bump));
        let unknown = combined.first().copied().flatten();
        let joint = unknown.and_then(|place| Joint::ALL.get(place).copied())?;
        (usable.first() == Some(&true) && rests(joint, centre)).then_some(joint)
    });
    (alone.collect(), all)
}

/// Whether a joint is at rest at each sample: without a sense, and its recorded angle does not tell that it moves.
fn resting(run: &FiveBarRun, joint: Joint) -> Vec<bool> {
    let motion = run.motion(joint).iter().zip(run.known_travel(joint));
    motion
        .map(|(now, travel)| now.sense == 0.0 && travel == 0.0)
        .collect()
}

/// What a joint at rest transmits in a window.
struct Reaction {
    joint: Joint,
    centre: usize,
    /// Against a motion in the positive sense, N·m.
    torque: f64,
    /// Its standard deviation by the noise of the sensors and what is left unexplained elsewhere, N·m.
    deviation: f64,
}

/// The reactions that both equations tell, everything else being as named.
fn reactions(
    fitted: &Problem,
    run: &FiveBarRun,
    selection: &Selection,
    alone: &[Option<Joint>],
) -> Vec<Reaction> {
    if alone.iter().all(Option::is_none) {
        return Vec::new();
    }
    let width_s = (fitted.windows.bump.len() - 1) as f64 * run.step_s;
    let mut windows = Windows::over(run.len(), 2, (run.step_s, run.start_s), width_s);
    for (usable, joint) in windows.usable.chunks_mut(2).zip(alone) {
        usable.fill(joint.is_some());
    }
    let problem = Problem::over_windows(run, windows);
    let windows = &problem.windows;
    let mut lacking = windows.average(&driving(run, run.forces()));
    add(&mut lacking, &modelled(&problem, selection), -1.0);
    let left = usable_rms(fitted, &selection.after.residual);
    let excess = (left * left - fitted.floor * fitted.floor).max(0.0);
    let covariance = pair_covariances(run, windows, excess);
    let units = Joint::ALL.map(|joint| {
        let cause = Cause {
            mechanism: Mechanism::ConstantBias,
            joint: Some(joint),
        };
        let signal = free(run, cause, &[]).and_then(|signals| signals.into_iter().next());
        signal.map(|signal| windows.average(&signal))
    });
    let pair = |rows: &[f64], row: usize| {
        let both = rows.get(row..row + 2).unwrap_or(&[0.0; 2]);
        Vector2::from_iterator(both.iter().copied())
    };
    let held = alone.iter().enumerate();
    let held = held.filter_map(|(window, joint)| Some((2 * window, (*joint)?)));
    held.filter_map(|(row, joint)| {
        let along = pair(units.get(place(joint))?.as_ref()?, row);
        let weights = covariance(row).try_inverse()? * along;
        let information = weights.dot(&along);
        Some(Reaction {
            joint,
            centre: *windows.centres.get(row)?,
            torque: weights.dot(&pair(&lacking, row)) / information,
            deviation: information.sqrt().recip(),
        })
    })
    .collect()
}

/// What all windows of a joint say together; nothing where there is none.
fn told(
    problem: &Problem,
    run: &FiveBarRun,
    selection: &Selection,
    joint: Joint,
    reactions: &[&Reaction],
) -> Option<HeldJoint> {
    let holding = [selection.nominal.len(), usize::MAX]
        .map(|count| holding(problem, run, selection, joint, count));
    let bump = &problem.windows.bump;
    let held = reactions.iter().map(|own| {
        let first = own.centre - bump.len() / 2;
        let holds = holding.each_ref().map(|all| {
            let window = all.get(first..first + bump.len());
            dot(bump, window.unwrap_or_default())
        });
        (own, holds)
    });
    let held: Vec<(&&Reaction, [f64; 2])> = held.collect();
    let most = |missing: &dyn Fn(&Reaction, &[f64; 2]) -> f64| {
        let all = held.iter().map(|(own, holds)| missing(own, holds));
        all.fold(0.0, f64::max)
    };
    let beyond =
        |own: &Reaction, holds: f64| own.torque.abs() - holds - BEYOND_SIGMAS * own.deviation;
    let (own, [holds_before, holds_after]) = held
        .iter()
        .max_by(|(a, [x, _]), (b, [y, _])| beyond(a, *x).total_cmp(&beyond(b, *y)))?;
    Some(HeldJoint {
        joint: joint.letter(),
        held_s: held.len() as f64 * problem.windows.hop as f64 * run.step_s,
        at_s: run.start_s + own.centre as f64 * run.step_s,
        pushed: own.torque.abs(),
        pushed_deviation: own.deviation,
        holds_before: *holds_before,
        holds_after: *holds_after,
        missing_before: most(&|own, [before, _]| beyond(own, *before)),
        missing_after: most(&|own, [_, after]| beyond(own, *after)),
    })
}

/// The most that holds a joint with the nominal brake and the first `count` terms, sample by sample, N·m: where a law goes from one level to
/// another the higher one.
fn holding(
    problem: &Problem,
    run: &FiveBarRun,
    selection: &Selection,
    joint: Joint,
    count: usize,
) -> Vec<f64> {
    let of = |all: &[Vec<f64>; 4]| all.get(place(joint)).cloned().unwrap_or_default();
    let mut sum = of(&run.yields);
    // Where a backlash begins and ends is known to a few counts.
    add(&mut sum, &of(&run.yield_errors), 1.0);
    let terms = refs(&selection.nominal, &selection.found);
    let (_, coefficients) = coefficients_by_term(problem, selection);
    for (term, own) in terms.into_iter().zip(&coefficients).take(count) {
        if term.cause.joint == Some(joint) {
            let numbers = term.known.as_ref().unwrap_or(own);
            let more = held_by(run, term, joint, numbers).unwrap_or_default();
            let onset = term.onset_s.map_or(0, |onset_s| run.sample_at(onset_s));
            let late = sum.iter_mut().zip(&more).skip(onset);
            late.for_each(|(sum, more)| *sum += more);
        }
    }
    sum.into_iter().map(|most| most.max(0.0)).collect()
}

/// The most that a law adds to what holds its joint, sample by sample, N·m; `None` for one that holds nothing.
fn held_by(run: &FiveBarRun, term: &Term, joint: Joint, numbers: &[f64]) -> Option<Vec<f64>> {
    let own = run.yields.get(place(joint))?;
    let greatest = numbers.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let times = |signal: &[f64]| signal.iter().map(|x| greatest * x).collect();
    match term.cause.mechanism {
        Mechanism::DryOffset
        | Mechanism::Stribeck
        | Mechanism::Presliding
        | Mechanism::AsymmetricPresliding
        | Mechanism::Settling => Some(vec![greatest; run.len()]),
        Mechanism::GainError | Mechanism::ReversalOvershoot => Some(times(own)),
        Mechanism::LoadDependent => {
            let loads: Vec<f64> = run.forces().map(|[x, y]| x.hypot(y)).collect();
            Some(times(&loads))
        }
        mechanism @ (Mechanism::CurrentHysteresis | Mechanism::ThermalFade) => {
            Some(times(&brakes::unit(run, mechanism, joint, &term.shape)?))
        }
        mechanism => brakes::change(run, mechanism, joint, *term.shape.first()?),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    use crate::five_bar::from_rig::aligned;
    use crate::five_bar::recorded::{self, nothing, recording, rig};
    use crate::regression::{Blocks, fit};
    use crate::select::Found;
    use rigproof_spec::layout::Layout;

    fn run() -> FiveBarRun {
        let recording = recording(Layout::FourBrake, 6.0, 23, &nothing);
        aligned(&rig(Layout::FourBrake), &recording).unwrap()
    }

    /// What is said with a gain error at these joints, as the rows that are fitted have it.
    fn said(run: &FiveBarRun, gains: &[Joint]) -> HeldReport {
        let problem = recorded::problem(run);
        let gains = gains.iter().map(|joint| Found {
            term: problem
                .term(
                    Cause {
                        mechanism: Mechanism::GainError,
                        joint: Some(*joint),
                    },
                    &[],
                    None,
                )
                .unwrap(),
            z: 3.7,
            share: 0.7,
            at_floor: true,
        });
        let found: Vec<Found> = gains.collect();
        let blocks = Blocks::new(&problem);
        let selection = Selection {
            nominal: Vec::new(),
            too_small: Vec::new(),
            stages: Vec::new(),
            before: fit(&problem, &[], &blocks),
            after: fit(&problem, &refs(&[], &found), &blocks),
            found,
        };
        held(&problem, run, &selection)
    }

    #[test]
    fn what_a_weak_model_cannot_hold_is_missing_and_the_gain_of_the_moving_brake_holds_it() {
        let mut run = run();
        let honest = said(&run, &[]);
        assert!(honest.joints.len() > 1, "{honest:?}");
        for own in &honest.joints {
            assert_eq!(own.missing_before, 0.0, "{own:?}");
        }
        for (yields, errors) in run.yields.iter_mut().zip(&mut run.yield_errors) {
            yields.iter_mut().for_each(|y| *y *= 0.37);
            errors.iter_mut().for_each(|e| *e *= 0.37);
        }
        let weak = said(&run, &Joint::ALL);
        let most = weak.joints.iter().map(|own| own.missing_before);
        assert!(most.fold(0.0, f64::max) > 0.1, "{weak:?}");
        for own in &weak.joints {
            assert!(own.holds_after > own.pushed, "{own:?}");
            assert_eq!(own.missing_after, 0.0, "{own:?}");
        }
    }

    #[test]
    fn where_every_brake_is_at_rest_nothing_is_attributed() {
        let mut run = run();
        let count = run.len();
        for (theta, place) in run.theta.iter_mut().zip([0, 2]) {
            let angle = run.joints[place][0].position;
            *theta = vec![angle; count];
        }
        for motion in &mut run.joints {
            let first = motion[0].position;
            for now in motion.iter_mut() {
                (now.position, now.speed, now.sense) = (first, 0.0, 0.0);
            }
        }
        let said = said(&run, &[]);
        assert!(said.joints.is_empty());
        assert!((said.all_held_s - run.duration_s()).abs() < 0.2);
    }
}
