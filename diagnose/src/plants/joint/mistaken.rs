//! This file finds descriptions of a plant of one joint that the recording contradicts: a brake
//! that is missing, a drive with a wrong unit or sign.

use super::columns::is_of_brake;
use super::from_rig;
use super::inertia::Inertia;
use super::run::{JointRun, PlantKind};
use crate::align::Fault;
use crate::cause::{Cause, Scales};
use crate::continuity::Remark;
use crate::evidence::{Intervals, coefficients_by_term, intervals};
use crate::problem::Problem;
use crate::regression::Fit;
use crate::rules::{ANOTHER_INERTIA, ANOTHER_UNIT, DRAG_HALVES, EXPLAINED_LEFT};
use crate::selection::{Selection, is_noise, usable_rms};
use rigproof_model::effects::entry;
use rigproof_spec::effect::Mechanism;
use rigproof_trace::rig::Rig;

/// A description that states an effect of a brake, for a plant without a brake and its current.
pub fn without_brake(rig: &Rig, run: &JointRun) -> Option<Fault> {
    let effects = from_rig::nominal(rig);
    let effect = effects
        .iter()
        .find(|n| is_of_brake(n.cause) && run.brake().is_none())?;
    Some(Fault {
        channel: "effect",
        from_s: 0.0,
        to_s: 0.0,
        reason: format!(
            "`{}` is something that a brake does; take it out, or describe the brake and its current",
            effect.cause.mechanism.name()
        ),
    })
}

/// Whether an axis that lacks nothing else would have another unit or sign of its drive, of its
/// position or of its inertia.
pub fn is_another_unit(run: &JointRun, cause: Cause, coefficients: &[f64]) -> bool {
    let (Some(own), PlantKind::Axis) = (coefficients.first(), run.plant) else {
        return false;
    };
    let (times, most) = match (cause.mechanism, run.inertia) {
        // Shares of the effort and of the motion that were described.
        (Mechanism::GainError | Mechanism::EncoderScale, _) => (1.0 + own, ANOTHER_UNIT),
        (Mechanism::AddedInertia, Inertia::Known(stated)) => (1.0 + own / stated, ANOTHER_INERTIA),
        _ => return false,
    };
    !is_of_one_unit(times, most)
}

/// Whether a number of this many times the described one, and at most of `most` times, has its unit
/// and sign.
fn is_of_one_unit(times: f64, most: f64) -> bool {
    (1.0 / ANOTHER_UNIT..most).contains(&times)
}

/// A wrong sign or unit of the drive, shown by an impossible gain.
///
/// A gain that begins late is no such error. If the fit leaves a large residual, other physics is
/// missing and nothing is concluded.
pub fn another_drive(problem: &Problem, selection: &Selection) -> Option<Fault> {
    let (index, gain) = impossible_gain(problem, selection)?;
    let begins_late = selection
        .found
        .get(index)
        .is_some_and(|own| own.term.onset_s.is_some());
    if begins_late || !explains(problem, selection) {
        return None;
    }
    let reason = if gain < 0.0 {
        "the plant answers against its drive: the command, the force or the position has the wrong sign (set `sign = -1`), or the two channels are swapped".to_owned()
    } else {
        format!(
            "the plant answers as if its drive were {gain:.3} times what is described: the unit of the position or of the command is another one (degrees for radians make 57.3 or 0.0175, thousandths 1000 or 0.001), or the two channels are swapped; correct the description"
        )
    };
    Some(throughout(problem, "drive", reason))
}

/// The index of a found gain outside the range of real drives, and the gain.
fn impossible_gain(problem: &Problem, selection: &Selection) -> Option<(usize, f64)> {
    let (_, coefficients) = coefficients_by_term(problem, selection);
    let own = coefficients.iter().skip(selection.nominal.len());
    let found: Vec<_> = selection.found.iter().zip(own).collect();
    let is_gain = |cause: Cause| cause.mechanism == Mechanism::GainError;
    let index = found.iter().position(|(own, _)| is_gain(own.term.cause))?;
    let (gained, fraction) = found.get(index)?;
    let fraction = problem.run.linear(gained.term.cause.mechanism, fraction);
    // What else is a share of a brake's torque gives back what the gain takes: the brake's own
    // friction follows another law.
    let shares = found
        .iter()
        .filter(|(own, _)| own.term.cause.scales == Scales::Torque);
    let shares: f64 = shares.filter_map(|(_, shares)| shares.first()).sum();
    let gain = 1.0 + fraction.first()? + shares;
    (!is_of_one_unit(gain, ANOTHER_UNIT)).then_some((index, gain))
}

/// A found inertia so far from the stated one that the stated one must have another unit.
pub fn another_inertia(run: &JointRun, problem: &Problem, selection: &Selection) -> Option<Fault> {
    let Inertia::Known(stated) = run.inertia else {
        return None;
    };
    let (_, coefficients) = coefficients_by_term(problem, selection);
    let own = coefficients.iter().skip(selection.nominal.len());
    let added = selection.found.iter().zip(own).find_map(|(found, own)| {
        let is_inertia = found.term.cause.mechanism == Mechanism::AddedInertia;
        (is_inertia && found.term.onset_s.is_none()).then(|| own.first().copied())?
    })?;
    let times = 1.0 + added / stated;
    if is_of_one_unit(times, ANOTHER_INERTIA) || !explains(problem, selection) {
        return None;
    }
    if times < 0.0 {
        return Some(throughout(
            problem,
            "drive",
            format!(
                "the plant answers as if its inertia were {times:.3} times the stated one: the command or the position has the wrong sign (set `sign = -1`), or the two channels are swapped"
            ),
        ));
    }
    Some(throughout(
        problem,
        "inertia",
        format!(
            "the plant answers as if its inertia were {times:.3e} times the stated one: the unit of the position or of the command is another one (degrees for radians make 0.0175, thousandths 1000 or 0.001), the command is dead, the two channels are swapped, or the stated inertia is another one's; correct the description"
        ),
    ))
}

/// The cause of an impossible gain that is no error of the description either: a substitute for
/// missing physics.
pub fn beyond_reason(problem: &Problem, selection: &Selection) -> Option<Cause> {
    let (index, _) = impossible_gain(problem, selection)?;
    selection.found.get(index).map(|own| own.term.cause)
}

/// Whether the found mechanisms leave little of the nominal residual.
fn explains(problem: &Problem, selection: &Selection) -> bool {
    let rms = |fit: &Fit| usable_rms(problem, &fit.residual);
    is_noise(problem, &selection.after)
        || rms(&selection.after) < EXPLAINED_LEFT * rms(&selection.before)
}

fn throughout(problem: &Problem, channel: &'static str, reason: String) -> Fault {
    let clock = problem.run.clock();
    Fault {
        channel,
        from_s: clock.start_s,
        to_s: clock.start_s + clock.duration_s(),
        reason,
    }
}

/// The fitted inertia and the half width of its interval; `None` without an interval.
fn fitted_inertia(
    problem: &Problem,
    selection: &Selection,
    intervals: &Intervals,
) -> Option<(f64, f64)> {
    let (nuisances, _) = coefficients_by_term(problem, selection);
    let half = intervals.nuisances.first().filter(|half| half.is_finite());
    nuisances.first().copied().zip(half.copied())
}

/// The stated inertia and what is said of it, if it is unknown and its interval holds it and 0, and
/// nothing is explained: it may be as stated, and this recording does not tell.
pub fn inertia_as_stated(
    run: &JointRun,
    problem: &Problem,
    selection: &Selection,
) -> Option<(f64, Remark)> {
    let Inertia::Unknown(stated) = run.inertia else {
        return None;
    };
    if explains(problem, selection) {
        return None;
    }
    let (inertia, half) = fitted_inertia(problem, selection, &intervals(problem, selection))?;
    let is_open = inertia.abs() <= half && (inertia - stated).abs() <= half;
    let words = format!(
        "this recording does not determine the inertia, which comes out as {inertia:.1e} ± {half:.1e} (SI): it is taken as stated, {stated:.3e}; record faster motion to check it"
    );
    let clock = problem.run.clock();
    let remark = Remark::throughout(clock, "inertia_as_stated", "inertia", words);
    is_open.then_some((stated, remark))
}

/// An unknown inertia or friction whose estimate no plant has. A wrong sign or unit of a channel
/// drives such estimates anywhere.
pub fn impossible_numbers(
    run: &JointRun,
    problem: &Problem,
    selection: &Selection,
) -> Option<Fault> {
    let Inertia::Unknown(start) = run.inertia else {
        let fault = explains_nothing(problem, selection);
        return fault.or_else(|| negative_drag(problem, selection, &intervals(problem, selection)));
    };
    let intervals = intervals(problem, selection);
    let (inertia, half) = fitted_inertia(problem, selection, &intervals)?;
    let is_told = inertia.abs() > half;
    let reason = if is_told && inertia < 0.0 {
        Some(format!(
            "the inertia comes out as {inertia:.3e} (SI), which is negative: the command or the position has the wrong sign (set `sign = -1`), or the two channels are swapped"
        ))
    } else if is_told && !(1.0 / ANOTHER_INERTIA..ANOTHER_INERTIA).contains(&(inertia / start)) {
        Some(format!(
            "the inertia comes out as {inertia:.3e} (SI), {:.3e} times the value to start from: the unit of the position or of the command is another one (degrees for radians make 0.0175, thousandths 1000 or 0.001), or another column is the position or the command; correct the description, or the inertia's `value` if it was a guess",
            inertia / start
        ))
    } else if !is_told && !explains(problem, selection) {
        Some(format!(
            "the inertia comes out as {inertia:.1e} ± {half:.1e} (SI): the acceleration of the position has nothing to do with the command; another column is the position or the command, or the plant hardly accelerates (state its inertia as known)"
        ))
    } else {
        None
    };
    match reason {
        Some(reason) => Some(throughout(problem, "inertia", reason)),
        None => negative_drag(problem, selection, &intervals),
    }
}

/// A nominal model whose residual is larger than the effort itself, and nothing explains it.
fn explains_nothing(problem: &Problem, selection: &Selection) -> Option<Fault> {
    let left = usable_rms(problem, &selection.before.residual);
    let is_nothing = left > problem.effort_size && !explains(problem, selection);
    is_nothing.then(|| {
        throughout(
            problem,
            "position",
            format!(
                "the nominal model explains nothing of the effort: it leaves {left:.3e} of {:.3e} (SI, root mean square); another column is the position or the command, one of them has another unit, or the stated inertia is another plant's",
                problem.effort_size
            ),
        )
    })
}

/// A nominal friction whose coefficient is negative, together with what else is stated of it: a
/// calibration lists a correction beside the law that it corrects.
fn negative_drag(problem: &Problem, selection: &Selection, intervals: &Intervals) -> Option<Fault> {
    let (_, coefficients) = coefficients_by_term(problem, selection);
    let nominal = selection
        .nominal
        .iter()
        .zip(&coefficients)
        .zip(&intervals.terms);
    let (term, value) = nominal.into_iter().find_map(|((term, own), halves)| {
        let is_friction = entry(term.cause.mechanism).is_some_and(|entry| entry.passive);
        let known = match term.known {
            Some(_) => 0.0,
            None => problem.run.described(term.cause),
        };
        let (value, half) = (known + *own.first()?, *halves.first()?);
        (is_friction && value + DRAG_HALVES * half < 0.0).then_some((term, value))
    })?;
    Some(throughout(
        problem,
        "drive",
        format!(
            "the nominal `{}` comes out as {value:.3e} (SI), which is negative: the friction would drive the plant; the command, the force or the position has the wrong sign (set `sign = -1`), or a channel is another one",
            term.cause.mechanism.name()
        ),
    ))
}

#[cfg(test)]
mod tests {
    use super::super::recorded::{NOMINAL, exact_axis, exact_bench};
    use super::*;

    #[test]
    fn another_unit_is_a_gain_a_scale_or_an_inertia_that_no_axis_has() {
        let mut axis = exact_axis(NOMINAL, 300, true);
        axis.inertia = Inertia::Known(2.0);
        let is_odd = |run: &JointRun, mechanism, number: f64| {
            is_another_unit(run, Cause::of(mechanism), &[number])
        };
        let cases = [
            (Mechanism::GainError, -0.5, false),
            (Mechanism::GainError, -0.95, true),
            (Mechanism::EncoderScale, -1.3, true),
            (Mechanism::AddedInertia, -1.9, true),
            (Mechanism::AddedInertia, 20.0, false),
            (Mechanism::Viscous, -9.0, false),
        ];
        for (mechanism, number, odd) in cases {
            assert_eq!(
                is_odd(&axis, mechanism, number),
                odd,
                "{mechanism:?} {number}"
            );
        }
        axis.inertia = Inertia::Unknown(2.0);
        assert!(!is_odd(&axis, Mechanism::AddedInertia, -9.0));
        assert!(!is_odd(
            &exact_bench(NOMINAL, 300),
            Mechanism::GainError,
            -0.95
        ));
    }
}
