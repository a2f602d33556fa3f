//! This file draws bounds from joints at rest: a joint that was pushed and did not move is held by
//! at least that torque.
//!
//! The torque that a held joint transmits is a reaction and measures no law. It only bounds the sum
//! of brake and friction torque from below (Coulomb 1785). The equation in which it occurs is not
//! fitted, so it is independent evidence for what was named.

use super::columns::{driving, free};
use super::noise::pair_covariances;
use super::run::{FiveBarRun, at, place, place_of};
use crate::diagnose::balance::modelled;
use crate::evidence::coefficients_by_term;
use crate::plant::Run;
use crate::problem::{Problem, Term, add};
use crate::regression::dot;
use crate::report::{HeldJoint, HeldReport};
use crate::rules::BEYOND_SIGMAS;
use crate::selection::{Selection, refs, usable_rms};
use crate::weak::{Windows, is_recorded};
use nalgebra::Vector2;
use rigproof_model::effects::facts::AtRest;
use rigproof_model::effects::{Form, facts, form};
use rigproof_spec::effect::Mechanism;
use rigproof_spec::joint::Joint;
use rigproof_spec::layout::Layout;

/// Compares what is named with the windows in which a single brake is at rest.
///
/// Where all brakes rest, two equations cannot be divided among three or four joints, and nothing
/// is attributed. `None` where an encoder error was named: the recorded angles are then not the
/// true ones.
pub fn held(problem: &Problem, run: &FiveBarRun, selection: &Selection) -> Option<HeldReport> {
    let terms = refs(&selection.nominal, &selection.found);
    if terms.iter().any(|term| run.moves(term.cause)) {
        return None;
    }
    let (alone, all) = at_rest(problem, run);
    let joints = run.parameters.layout.brakes().iter();
    let joints = joints.filter(|joint| {
        let own = terms.iter().filter(|term| is_at(run, term, **joint));
        let mut own = own.filter_map(|term| form(term.cause.mechanism));
        // No bound is given where the holding torque depends on past currents.
        alone.contains(&Some(**joint)) && !own.any(Form::goes_by_past_current)
    });
    Some(HeldReport {
        joints: joints
            .filter_map(|joint| {
                let reactions = reactions(problem, run, selection, &alone, *joint);
                told(problem, run, selection, *joint, &reactions)
            })
            .collect(),
        all_seen_s: all as f64 * hop_s(problem),
        unit: "N·m".to_owned(),
    })
}

fn hop_s(problem: &Problem) -> f64 {
    problem.windows.hop as f64 * problem.windows.step_s
}

/// Whether a law acts at a joint. With three brakes, the bearing at C turns as E does.
fn is_at(run: &FiveBarRun, term: &Term, joint: Joint) -> bool {
    let turns_alike = run.parameters.layout == Layout::ThreeBrake
        && joint == Joint::E
        && term.cause.mechanism == Mechanism::BearingFriction;
    term.cause.at == place_of(Some(joint)) || turns_alike
}

/// For every window, the joint that alone is at rest throughout, provided that the directions of
/// the others are known. Also the number of windows in which every brake is at rest.
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

/// Whether a joint is at rest at each sample: its direction is unknown and its recorded angle does
/// not show motion.
fn resting(run: &FiveBarRun, joint: Joint) -> Vec<bool> {
    let motion = run.motion_of(joint).iter().zip(run.known_travel(joint));
    motion
        .map(|(now, travel)| now.sense == 0.0 && travel == 0.0)
        .collect()
}

/// The torque that a joint at rest transmits in a window.
struct Reaction {
    centre: usize,
    /// Positive against a motion in the positive direction, N·m.
    torque: f64,
    /// Its standard deviation from sensor noise and from the residual of the fitted rows, N·m.
    deviation: f64,
}

/// The reactions of joints that are alone at rest, given by both equations. Everything else acts as
/// named.
fn reactions(
    fitted: &Problem,
    run: &FiveBarRun,
    selection: &Selection,
    alone: &[Option<Joint>],
    joint: Joint,
) -> Vec<Reaction> {
    let width_s = fitted.windows.width_s();
    let mut windows = Windows::over(run.len(), 2, (run.step_s, run.start_s), width_s);
    for (usable, own) in windows.usable.chunks_mut(2).zip(alone) {
        usable.fill(*own == Some(joint));
    }
    let problem = Problem::new(run, windows);
    let windows = &problem.windows;
    let holds = |term: &Term| {
        is_at(run, term, joint) && !matches!(at_rest_of(term.cause.mechanism), AtRest::Nothing)
    };
    let mut lacking = windows.average(&driving(run, run.forces()));
    add(
        &mut lacking,
        &modelled(&problem, selection, |term| !holds(term)),
        -1.0,
    );
    let left = usable_rms(fitted, &selection.after.residual);
    let excess = (left * left - fitted.floor * fitted.floor).max(0.0);
    let covariance = pair_covariances(run, windows, excess);
    let unit = at(Mechanism::ConstantBias, joint);
    let unit = free(run, unit, &[]).and_then(|signals| signals.into_iter().next());
    let along = windows.average(&unit.unwrap_or_default());
    let pair = |rows: &[f64], row: usize| {
        let both = rows.get(row..row + 2).unwrap_or(&[0.0; 2]);
        Vector2::from_iterator(both.iter().copied())
    };
    let rows = windows.usable.iter().enumerate().step_by(2);
    rows.filter(|(_, usable)| **usable)
        .filter_map(|(row, _)| {
            let along = pair(&along, row);
            let weights = covariance(row).try_inverse()? * along;
            let information = weights.dot(&along);
            Some(Reaction {
                centre: *windows.centres.get(row)?,
                torque: weights.dot(&pair(&lacking, row)) / information,
                deviation: information.sqrt().recip(),
            })
        })
        .collect()
}

/// The summary of all windows of a joint; `None` if there are none.
fn told(
    problem: &Problem,
    run: &FiveBarRun,
    selection: &Selection,
    joint: Joint,
    reactions: &[Reaction],
) -> Option<HeldJoint> {
    let bump = &problem.windows.bump;
    let [nominal, named] = [selection.nominal.len(), usize::MAX]
        .map(|count| holding(problem, run, selection, joint, count));
    let each = reactions.iter().map(|own| {
        let first = own.centre - bump.len() / 2;
        let average = |all: &[f64]| {
            let window = all.get(first..first + bump.len());
            dot(bump, window.unwrap_or_default())
        };
        let beyond =
            |holds: f64| (own.torque.abs() - holds - BEYOND_SIGMAS * own.deviation).max(0.0);
        let (nominal, named) = (average(&nominal), average(&named));
        HeldJoint {
            joint: joint.letter(),
            seen_s: reactions.len() as f64 * hop_s(problem),
            at_s: run.start_s + own.centre as f64 * run.step_s,
            pushed: own.torque.abs(),
            pushed_deviation: own.deviation,
            holds_nominal: nominal,
            holds: named,
            named_at_least: beyond(nominal),
            missing: beyond(named),
        }
    });
    // The window in which most torque is missing. If none is missing, the window that comes closest
    // to the limit.
    each.max_by(|a, b| {
        let least = |own: &HeldJoint| own.holds_nominal - own.pushed;
        let missing = a.missing.total_cmp(&b.missing);
        let asked = a.named_at_least.total_cmp(&b.named_at_least);
        missing.then(asked).then(least(b).total_cmp(&least(a)))
    })
}

/// The greatest holding torque of the nominal brake and the first `count` terms, one value per
/// sample, N·m.
fn holding(
    problem: &Problem,
    run: &FiveBarRun,
    selection: &Selection,
    joint: Joint,
    count: usize,
) -> Vec<f64> {
    let of = |all: &[Vec<f64>; 4]| all.get(place(joint)).cloned().unwrap_or_default();
    let yields = of(&run.yields);
    let mut sum = yields.clone();
    // The start and end of a backlash are known to a few counts.
    add(&mut sum, &of(&run.yield_errors), 1.0);
    let terms = refs(&selection.nominal, &selection.found);
    let (_, coefficients) = coefficients_by_term(problem, selection);
    let terms = terms.into_iter().zip(&coefficients).take(count);
    for (term, own) in terms.filter(|(term, _)| is_at(run, term, joint)) {
        let numbers = term.known.as_ref().unwrap_or(own);
        let onset = term
            .onset_s
            .map_or(0, |onset_s| run.clock().sample_at(onset_s));
        let more = level(run, &yields, term.cause.mechanism, numbers);
        let late = sum.iter_mut().zip(&more).skip(onset);
        late.for_each(|(sum, more)| *sum += more);
    }
    sum.into_iter().map(|most| most.max(0.0)).collect()
}

/// The greatest holding torque of a law at its joint, one value per sample, N·m.
fn level(run: &FiveBarRun, yields: &[f64], law: Mechanism, numbers: &[f64]) -> Vec<f64> {
    let times = |signal: &[f64], share: f64| signal.iter().map(|x| share * x).collect();
    match at_rest_of(law) {
        AtRest::Nothing => vec![0.0; run.len()],
        AtRest::Dry(most) | AtRest::Level(most) => vec![most(numbers); run.len()],
        AtRest::OfBrake(share) => times(yields, share(numbers)),
        AtRest::OfLoad(arm) => {
            let loads: Vec<f64> = run.forces().map(|[x, y]| x.hypot(y)).collect();
            times(&loads, arm(numbers))
        }
    }
}

/// What a law holds at rest.
fn at_rest_of(law: Mechanism) -> AtRest {
    facts(law).map_or(AtRest::Nothing, |facts| facts.at_rest)
}

#[cfg(test)]
mod tests {
    use super::*;

    use crate::plants::five_bar::from_rig::aligned;
    use crate::plants::five_bar::recorded::{self, nothing, recording, rig};
    use crate::regression::{Blocks, fit};
    use crate::selection::Found;
    use rigproof_spec::layout::Layout;

    fn run() -> FiveBarRun {
        let recording = recording(Layout::FourBrake, 6.0, 23, &nothing);
        aligned(&rig(Layout::FourBrake), &recording).unwrap()
    }

    /// The report with a law at every brake, its parameters changed from the fitted ones.
    fn said(
        run: &FiveBarRun,
        law: Option<(Mechanism, &[f64])>,
        change: impl Fn(&mut [f64]),
    ) -> HeldReport {
        let problem = recorded::problem(run);
        let brakes = run.parameters.layout.brakes().iter();
        let found = brakes
            .zip(core::iter::repeat(law))
            .filter_map(|(joint, law)| {
                let (mechanism, shape) = law?;
                Some(Found {
                    term: problem.term(at(mechanism, *joint), shape, None)?,
                    z: 3.7,
                    share: 0.7,
                    probability: 1.0,
                })
            });
        let found: Vec<Found> = found.collect();
        let blocks = Blocks::new(&problem);
        let before = fit(&problem, &[], &blocks);
        let mut after = fit(&problem, &refs(&[], &found), &blocks);
        change(&mut after.coefficients);
        let selection = Selection {
            nominal: Vec::new(),
            stages: Vec::new(),
            before,
            after,
            found,
        };
        held(&problem, run, &selection).unwrap()
    }

    #[test]
    fn what_a_weak_model_cannot_hold_is_missing_and_the_gain_of_the_moving_brake_holds_it() {
        let mut run = run();
        let honest = said(&run, None, |_| ());
        assert!(honest.joints.len() > 1, "{honest:?}");
        for own in &honest.joints {
            assert_eq!([own.missing, own.named_at_least], [0.0; 2], "{own:?}");
        }
        for (yields, errors) in run.yields.iter_mut().zip(&mut run.yield_errors) {
            yields.iter_mut().for_each(|y| *y *= 0.37);
            errors.iter_mut().for_each(|e| *e *= 0.37);
        }
        let gain = Some((Mechanism::GainError, &[][..]));
        let weak = said(&run, gain, |gains| gains[1] = 0.0);
        let missing = weak.joints.iter().map(|own| own.missing);
        assert!(missing.fold(0.0, f64::max) > 0.1, "{weak:?}");
        let mended = said(&run, gain, |_| ());
        let asked = mended.joints.iter().map(|own| own.named_at_least);
        assert!(asked.fold(0.0, f64::max) > 0.1, "{mended:?}");
        for own in &mended.joints {
            assert_eq!(own.missing, 0.0, "{own:?}");
        }
    }

    #[test]
    fn a_brake_that_slides_transmits_its_yield_torque() {
        let run = run();
        let fitted = recorded::problem(&run);
        let blocks = Blocks::new(&fitted);
        let none = fit(&fitted, &[], &blocks);
        let selection = Selection {
            nominal: Vec::new(),
            found: Vec::new(),
            stages: Vec::new(),
            before: none.clone(),
            after: none,
        };
        let Windows {
            bump,
            centres,
            usable,
            combined,
            ..
        } = &fitted.windows;
        let rows = centres
            .chunks(2)
            .zip(usable.chunks(2))
            .zip(combined.chunks(2));
        let alone = rows.map(|((centres, usable), combined)| {
            let first = centres[0] - bump.len() / 2;
            let motion = &run.motion_of(Joint::E)[first..first + bump.len()];
            let slides = motion.iter().all(|now| now.sense == motion[0].sense);
            (usable[0] && combined[0].is_none() && slides).then_some(Joint::E)
        });
        let alone: Vec<Option<Joint>> = alone.collect();
        let mut without = run.clone();
        without.yields[1].fill(0.0);
        let told = reactions(&fitted, &without, &selection, &alone, Joint::E);
        assert!(told.len() > 40);
        let torque = run.brake_torque(Joint::E);
        for own in told {
            let first = own.centre - bump.len() / 2;
            let brake = dot(bump, &torque[first..first + bump.len()]);
            let doubt = dot(bump, &run.yield_errors[1][first..first + bump.len()]);
            // Torque and Jacobian row both change within a window; the reaction is the mean of
            // their product.
            let off = (own.torque - brake).abs() - doubt - 0.02 * brake.abs();
            assert!(
                off < BEYOND_SIGMAS * own.deviation,
                "{off} N·m off {brake} N·m, deviation {}",
                own.deviation
            );
        }
    }

    #[test]
    fn a_bristle_at_the_joint_holds_and_takes_nothing_from_the_push() {
        let run = run();
        let bare = said(&run, None, |_| ());
        let bristles = said(&run, Some((Mechanism::Presliding, &[0.013])), |levels| {
            levels.fill(0.41);
        });
        let pairs = bare.joints.iter().zip(&bristles.joints);
        let same = pairs.filter(|(bare, own)| {
            let more = own.holds - bare.holds;
            bare.at_s == own.at_s && (more - 0.41).abs() < 1e-9
        });
        assert_eq!(same.count(), bare.joints.len());
        // The friction of the other joints, which move, is subtracted from the push.
        let moved = bare.joints.iter().zip(&bristles.joints);
        let mut moved = moved.map(|(bare, own)| (bare.pushed - own.pushed).abs());
        assert!(moved.any(|by| by > 0.01));
    }

    #[test]
    fn nothing_is_said_of_a_joint_whose_brake_goes_by_its_past_or_where_an_encoder_is_off() {
        let run = run();
        let plays = said(
            &run,
            Some((Mechanism::CurrentHysteresis, &[0.07, 0.3])),
            |_| (),
        );
        assert!(plays.joints.is_empty());
        let problem = recorded::problem(&run);
        let blocks = Blocks::new(&problem);
        let cause = at(Mechanism::EncoderOffset, Joint::A);
        let found = vec![Found {
            term: problem.term(cause, &[0.007], None).unwrap(),
            z: 3.7,
            share: 0.7,
            probability: 1.0,
        }];
        let selection = Selection {
            nominal: Vec::new(),
            stages: Vec::new(),
            before: fit(&problem, &[], &blocks),
            after: fit(&problem, &refs(&[], &found), &blocks),
            found,
        };
        assert!(held(&problem, &run, &selection).is_none());
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
        let said = said(&run, None, |_| ());
        assert!(said.joints.is_empty());
        assert!((said.all_seen_s - run.clock().duration_s()).abs() < 0.1);
    }
}
