//! This file says where the rig's code may answer otherwise than the reference, and checks that it does so nowhere else.
//!
//! A tie is a tick whose decision turns within rounding: the reference itself takes the rig's decision when one of its inputs is nudged by
//! at most `NUDGES` of itself. Nothing else is called a tie but the exceptions that [`Tie`] names, each with its own check.

use nalgebra::Vector2;
use rigproof_impl::law::Situation;
use rigproof_impl::path::Path as _;
use rigproof_impl::select::{GREATEST_INPUT, LEAST_ROW_SQUARED_PER_M2};
use rigproof_model::brake::torque_gain;
use rigproof_model::control::path::Nearest;
use rigproof_spec::command::{Command, Reason};
use rigproof_spec::geometry::Arms;
use rigproof_spec::joint::Joint;
use rigproof_spec::settings::RATIO_GAIN_RANGE_NM_S_PER_RAD;

use super::answer::{Answer, apart_a};
use super::both::{
    View, reference_command, reference_nearest, reference_path, rig_path, situation,
};
use super::idle;
use super::level::cost_the_same;
use super::nudger::Nudger;
use super::tick::Tick;
use super::tie::Tie;
use crate::built_in::Kind;

/// Sizes of the nudges, relative to what is nudged; of an angle, rad, of the distance from the path, m.
const NUDGES: [f64; 3] = [1e-15, 3e-14, 1e-12];
/// A nudge of the last one or two digits.
pub const LAST_DIGITS: f64 = 1e-14;
/// How far two programs may lie apart, by how far [`LAST_DIGITS`] move one of them: both round.
const BOTH_ROUND: f64 = 2.0;
/// Nudges of each kind and size that are tried.
const TRIES: u32 = 100;
/// Currents that differ by no more than this differ by rounding, A. What differs by more has to be amplified.
const ROUNDING_A: f64 = 1e-12;
/// Currents that may at all count as equal, A. What is neither amplified nor beyond this goes to the budget of `tests/budgets.toml`, which is
/// nearer to `ROUNDING_A`.
pub const EQUAL_A: f64 = 1e-8;
/// How far beyond the currents of nudged ticks a current may lie, A.
const AMONG_A: f64 = 1e-7;
/// How far two torques may be apart that are one before the current gain, N·m.
const EQUAL_NM: f64 = 1e-7;
/// How far two feet may be from the path, and their distances from each other, m.
const EQUAL_M: f64 = 1e-11;

/// What may be between the reference's command and the rig's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Permitted {
    /// The same command, bit for bit.
    Same,
    /// The same decision; the currents differ by this much, A.
    Rounding(f64),
    /// Another decision, or other currents, where a decision turns or rounding is amplified.
    Tie(Tie),
}

/// What is between the reference's command and an answer to the same sample, or what is wrong.
///
/// # Errors
/// Both and the sample, in words: no tie was found.
pub fn permitted(
    tick: &Tick,
    reference: Option<Command>,
    answer: impl Into<Answer>,
    nudger: &mut Nudger,
) -> Result<Permitted, String> {
    let answer = answer.into();
    let Some(reference) = reference else {
        return without_pose(tick, &answer, nudger);
    };
    if answer.may_be(&reference) {
        return Ok(Permitted::Same);
    }
    if answer.may_mean(reference.reason)
        && let Some(permitted) = same_decision(tick, &reference, &answer, nudger)
    {
        return Ok(permitted);
    }
    let is_beyond = is_beyond(&situation::<f64>(tick));
    if is_beyond && answer.is_silent(&[Reason::UndefinedInput]) {
        return Ok(Permitted::Tie(Tie::Gate));
    }
    match other_decision(tick, &reference, &answer, nudger) {
        Some(tie) => Ok(Permitted::Tie(tie)),
        None => Err(format!(
            "{reference:?}\nbut the rig {answer:?}\nin {tick:?}"
        )),
    }
}

/// What is between two answers of one decision.
fn same_decision(
    tick: &Tick,
    reference: &Command,
    answer: &Answer,
    nudger: &mut Nudger,
) -> Option<Permitted> {
    let apart_a = answer.apart_a(reference);
    if apart_a <= ROUNDING_A {
        return Some(Permitted::Rounding(apart_a));
    }
    if is_step(reference, answer) {
        return Some(Permitted::Tie(Tie::CurrentStep));
    }
    let is_amplified = nudged(tick, &KINDS, LAST_DIGITS, nudger).any(|other| {
        let moved_a = self::apart_a(reference.currents_a, other.currents_a);
        other.reason == reference.reason && apart_a <= BOTH_ROUND * moved_a
    });
    if is_amplified {
        return Some(Permitted::Tie(Tie::Amplified));
    }
    (apart_a <= EQUAL_A).then_some(Permitted::Rounding(apart_a))
}

/// The tie between two decisions.
fn other_decision(
    tick: &Tick,
    reference: &Command,
    answer: &Answer,
    nudger: &mut Nudger,
) -> Option<Tie> {
    let seen = as_seen(tick);
    let seen_view = seen.map(View::Given);
    if let Some(view) = seen_view
        && let Some(other) = reference_command(tick, view)
        && answer.may_mean(other.reason)
        && answer.apart_a(&other) <= AMONG_A
    {
        return Some(Tie::Foot);
    }
    let may_be_idle = matches!(reference.reason, Reason::ChosenPair(..) | Reason::NoneHelps);
    if may_be_idle
        && [reference_nearest(tick), seen]
            .into_iter()
            .flatten()
            .any(|nearest| is_beside_an_idle_brake(tick, &nearest, answer))
    {
        return Some(Tie::IdleBrake);
    }
    if let Some(tie) = tie(tick, answer, nudger) {
        return Some(tie);
    }
    if cost_the_same(tick, reference, *answer, f64::EPSILON) {
        return Some(Tie::Level);
    }
    let is_even = answer.is_silent(&[Reason::NothingToDo])
        && [Some(View::EXACT), seen_view]
            .into_iter()
            .flatten()
            .any(|view| is_even(tick, view));
    is_even.then_some(Tie::Even)
}

/// Where the reference knows no pose every brake is left alone, for one of the reasons that say so.
fn without_pose(tick: &Tick, answer: &Answer, nudger: &mut Nudger) -> Result<Permitted, String> {
    let silent = [
        Reason::SingularPose,
        Reason::UndefinedInput,
        Reason::Uncontrolled,
        Reason::FreeSide,
    ];
    if answer.is_silent(&silent) {
        return Ok(Permitted::Same);
    }
    match tie(tick, answer, nudger) {
        Some(tie) => Ok(Permitted::Tie(tie)),
        None => Err(format!("no pose, but the rig {answer:?}\nin {tick:?}")),
    }
}

/// The first kind of nudge, of the smallest size, with which the reference decides as was answered; the currents of the answer lie among
/// those that it then asks for with that decision.
fn tie(tick: &Tick, answer: &Answer, nudger: &mut Nudger) -> Option<Tie> {
    let each = KINDS.map(|kind| (kind.0, vec![kind]));
    let kinds = each.into_iter().chain([(Tie::Together, KINDS.to_vec())]);
    let kinds: Vec<_> = kinds.collect();
    NUDGES.into_iter().find_map(|size| {
        kinds.iter().find_map(|(tie, kinds)| {
            let mut decisions: Vec<(Reason, Ranges)> = Vec::new();
            let mut others = nudged(tick, kinds, size, nudger);
            let reached = others.any(|other| {
                answer.may_mean(other.reason) && among(&mut decisions, &other, answer)
            });
            reached.then_some(*tie)
        })
    })
}

/// Between which currents, A, one decision was seen to ask.
type Ranges = [(f64, f64); 4];

/// Adds a command to what its decision was seen to ask for; says whether the currents of the answer lie among that.
fn among(decisions: &mut Vec<(Reason, Ranges)>, other: &Command, answer: &Answer) -> bool {
    let known = decisions
        .iter()
        .position(|(reason, _)| *reason == other.reason);
    let place = known.unwrap_or_else(|| {
        decisions.push((other.reason, [(f64::INFINITY, f64::NEG_INFINITY); 4]));
        decisions.len() - 1
    });
    let Some((_, ranges_a)) = decisions.get_mut(place) else {
        return false;
    };
    for ((least, greatest), current_a) in ranges_a.iter_mut().zip(other.currents_a) {
        *least = least.min(current_a - AMONG_A);
        *greatest = greatest.max(current_a + AMONG_A);
    }
    let mut currents_a = ranges_a.iter().zip(answer.currents_a);
    currents_a.all(|((least, greatest), current_a)| (*least..=*greatest).contains(&current_a))
}

/// A kind of nudge: its name, and what it does.
type Nudge = (Tie, fn(&mut Tick, &mut View, f64, &mut Nudger));

const KINDS: [Nudge; 4] = [
    (Tie::Path, |tick, view, size, nudger| {
        let nudged = View::Nudged {
            offset_m: size * nudger.nudge(),
            turn_rad: size * nudger.nudge(),
        };
        // Now and then as the rig's code sees it, where zero may be exact.
        *view = match as_seen(tick) {
            Some(mut seen) if nudger.nudge() < 0.0 => {
                if nudger.nudge() < 0.0 {
                    let left = Vector2::new(-seen.tangent.y, seen.tangent.x);
                    seen.tangent += left * (size * nudger.nudge());
                }
                View::Given(seen)
            }
            _ => nudged,
        };
    }),
    (Tie::Push, |tick, _, size, nudger| {
        tick.force_n = moved(tick.force_n, size, nudger);
    }),
    (Tie::Velocity, |tick, _, size, nudger| {
        tick.velocity_m_s = moved(tick.velocity_m_s, size, nudger);
    }),
    (Tie::Pose, |tick, _, size, nudger| {
        tick.base_rad = tick
            .base_rad
            .map(|angle_rad| angle_rad + size * nudger.nudge());
        // Where the outer arms are all but stretched, the tip hardly depends on the angles, and all the more on the lengths.
        let Arms { l_ed_m, l_cd_m, .. } = &mut tick.arms;
        for length_m in [l_ed_m, l_cd_m] {
            *length_m *= 1.0 + size * nudger.nudge();
        }
    }),
];

/// A vector moved by a share of its length.
fn moved([x, y]: [f64; 2], size: f64, nudger: &mut Nudger) -> [f64; 2] {
    let length = libm::hypot(x, y);
    [x, y].map(|component| component + size * length * nudger.nudge())
}

/// What the reference asks for when the tick is nudged; silent where that leaves no pose.
fn nudged<'a>(
    tick: &'a Tick,
    kinds: &'a [Nudge],
    size: f64,
    nudger: &'a mut Nudger,
) -> impl Iterator<Item = Command> + 'a {
    (0..TRIES).map(move |_| {
        let (mut tick, mut view) = (tick.clone(), View::EXACT);
        for (_, nudge) in kinds {
            nudge(&mut tick, &mut view, size, nudger);
        }
        reference_command(&tick, view).unwrap_or(Command::none(Reason::SingularPose))
    })
}

/// Whether the currents that differ give the same torques, from both sides of 0.2 A.
fn is_step(one: &Command, other: &Answer) -> bool {
    let pairs = one.currents_a.into_iter().zip(other.currents_a);
    let mut joints = Joint::ALL.into_iter().zip(pairs);
    let all = joints.all(|(joint, (a, b))| {
        let torques_nm = [a, b].map(|current_a| torque_gain(joint, current_a));
        let same_torque = (torques_nm[0] - torques_nm[1]).abs() <= EQUAL_NM;
        (a - b).abs() <= EQUAL_A || ((a < 0.2) != (b < 0.2) && same_torque)
    });
    all && other.apart_a(one) > EQUAL_A
}

/// Whether a brake makes a wanted force alone, and the answer is one of those that this leaves.
fn is_beside_an_idle_brake(tick: &Tick, nearest: &Nearest, answer: &Answer) -> bool {
    idle::answers(tick, nearest).iter().any(|command| {
        answer.may_mean(command.reason)
            && (answer.apart_a(command) <= AMONG_A || is_step(command, answer))
    })
}

/// Whether no link is faster than its share by a speed for which even the greatest gain asks for a current.
fn is_even(tick: &Tick, view: View) -> bool {
    let Kind::VelocityRatio { .. } = tick.law else {
        return false;
    };
    let [_, gain_nm_s_per_rad] = RATIO_GAIN_RANGE_NM_S_PER_RAD;
    let mut strongest = tick.clone();
    strongest.law = Kind::VelocityRatio { gain_nm_s_per_rad };
    reference_command(&strongest, view).is_some_and(|command| command.currents_a == [0.0; 4])
}

/// Whether an input lies beyond what the rig's code takes.
fn is_beyond(now: &Situation<f64>) -> bool {
    let rows = now.rows;
    let short = |row: &_| {
        let [x, y] = <[f64; 2]>::from(*row);
        x * x + y * y < LEAST_ROW_SQUARED_PER_M2
    };
    let vectors = [now.tip_velocity_m_s, now.tip_force_n];
    let beyond = |vector| {
        let components: [f64; 2] = vector;
        components
            .into_iter()
            .any(|value| value.abs() > GREATEST_INPUT)
    };
    rows.iter().any(short)
        || vectors
            .into_iter()
            .chain(rows)
            .any(|vector| beyond(vector.into()))
}

/// The nearest point of the path as the rig's code sees it, if the reference finds it on the path and as near as its own.
fn as_seen(tick: &Tick) -> Option<Nearest> {
    let path = reference_path(&tick.path).ok()?;
    let tip_m = situation::<f64>(tick).linkage.tip_m;
    let seen = rig_path::<f64>(&tick.path)?.nearest(tip_m);
    let tip_m = <[f64; 2]>::from(tip_m);
    let tangent = Vector2::from(<[f64; 2]>::from(seen.tangent));
    let left = Vector2::new(-tangent.y, tangent.x);
    let nearest = Nearest {
        foot_m: Vector2::from(tip_m) - left * seen.offset_m,
        tangent,
        offset_m: seen.offset_m,
    };
    let as_near = (nearest.distance_m() - path.nearest(tip_m).distance_m()).abs() <= EQUAL_M;
    let on_path = path.nearest(nearest.foot_m.into()).distance_m() <= EQUAL_M;
    (as_near && on_path).then_some(nearest)
}
