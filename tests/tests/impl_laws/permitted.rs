//! This file says where the rig's code may answer otherwise than the reference, and checks that it does so nowhere else.
//!
//! A tie is a tick whose decision turns within rounding: the reference itself takes the rig's decision when one of its inputs is nudged by
//! at most [`NUDGES`] of itself. Nothing else is called a tie but the exceptions that [`Tie`] names, each with its own check.

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

use crate::impl_laws::both::{
    View, reference_command, reference_nearest, reference_path, rig_path, situation,
};
use crate::impl_laws::idle;
use crate::impl_laws::level::cost_the_same;
use crate::impl_laws::sample::{LawKind, Sampler, Tick};

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
/// nearer to [`ROUNDING_A`].
const EQUAL_A: f64 = 1e-8;
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
    /// The same decision where nudging the tick by [`LAST_DIGITS`] moves the reference's currents half as much: near a singularity, or where a
    /// great gain multiplies the rounding of a great velocity.
    Amplified(f64),
    /// Another decision, or another of two currents, where the decision turns.
    Tie(Tie),
}

/// Where a decision turns.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Tie {
    /// Two points of the path are as near, or one to rounding; the reference agrees when it is given the one that the rig's code sees.
    Foot,
    /// The path: on it, at the end of the gap, at a corner, exactly across the push.
    Path,
    /// The push: exactly across the path, or towards it by nothing.
    Push,
    /// The velocity: across the desired direction, along it, or across a joint's row.
    Velocity,
    /// The pose: two brakes are as good, or a local path ends its quarter turn; or it is singular by a last digit.
    Pose,
    /// Several of these at once.
    Together,
    /// Exception: a torque in the step of (3.3) at 0.2 A, which two currents give.
    CurrentStep,
    /// Exception: velocity ratio control finds both ratios equal, the reference all but equal.
    Even,
    /// Exception: optimal control takes another brake or level, whose cost is the same to the last digits of what costs are made of.
    Level,
    /// Exception: one brake makes the force of impedance control alone; the two name different idle ones beside it, or one of them no pair.
    IdleBrake,
    /// Exception: an input beyond what the rig's code takes, which lets go.
    Gate,
}

/// What is between two commands for one tick, or what is wrong.
pub fn permitted(
    tick: &Tick,
    reference: Option<Command>,
    rig: Command,
    nudger: &mut Sampler,
) -> Result<Permitted, String> {
    let now = situation::<f64>(tick);
    let Some(reference) = reference else {
        return without_pose(tick, rig, nudger);
    };
    if reference == rig {
        return Ok(Permitted::Same);
    }
    let apart_a = apart_a(&reference, &rig);
    if reference.reason == rig.reason {
        if apart_a <= ROUNDING_A {
            return Ok(Permitted::Rounding(apart_a));
        }
        if is_step(&reference, &rig) {
            return Ok(Permitted::Tie(Tie::CurrentStep));
        }
        if nudged(tick, &KINDS, LAST_DIGITS, nudger).any(|other| {
            other.reason == rig.reason && apart_a <= BOTH_ROUND * self::apart_a(&reference, &other)
        }) {
            return Ok(Permitted::Amplified(apart_a));
        }
        if apart_a <= EQUAL_A {
            return Ok(Permitted::Rounding(apart_a));
        }
    }
    if is_beyond(&now) && rig == Command::none(Reason::UndefinedInput) {
        return Ok(Permitted::Tie(Tie::Gate));
    }
    let seen = as_seen(tick);
    let seen_view = seen.map(View::Given);
    if let Some(view) = seen_view
        && let Some(other) = reference_command(tick, view)
        && other.reason == rig.reason
        && self::apart_a(&other, &rig) <= AMONG_A
    {
        return Ok(Permitted::Tie(Tie::Foot));
    }
    let may_be_idle = matches!(reference.reason, Reason::ChosenPair(..) | Reason::NoneHelps);
    if may_be_idle
        && [reference_nearest(tick), seen]
            .into_iter()
            .flatten()
            .any(|nearest| is_beside_an_idle_brake(tick, &nearest, &rig))
    {
        return Ok(Permitted::Tie(Tie::IdleBrake));
    }
    if let Some(tie) = tie(tick, &rig, nudger) {
        return Ok(Permitted::Tie(tie));
    }
    if cost_the_same(tick, &reference, &rig, f64::EPSILON) {
        return Ok(Permitted::Tie(Tie::Level));
    }
    if rig == Command::none(Reason::NothingToDo)
        && [Some(View::EXACT), seen_view]
            .into_iter()
            .flatten()
            .any(|view| is_even(tick, view))
    {
        return Ok(Permitted::Tie(Tie::Even));
    }
    Err(format!("{reference:?}\nbut the rig {rig:?}\nin {tick:?}"))
}

/// Where the reference knows no pose every brake is left alone, for one of the reasons that say so.
fn without_pose(tick: &Tick, rig: Command, nudger: &mut Sampler) -> Result<Permitted, String> {
    let silent = [
        Reason::SingularPose,
        Reason::UndefinedInput,
        Reason::Uncontrolled,
        Reason::FreeSide,
    ];
    if silent.contains(&rig.reason) && rig == Command::none(rig.reason) {
        return Ok(Permitted::Same);
    }
    match tie(tick, &rig, nudger) {
        Some(tie) => Ok(Permitted::Tie(tie)),
        None => Err(format!("no pose, but the rig {rig:?}\nin {tick:?}")),
    }
}

/// The first kind of nudge, of the smallest size, with which the reference decides as the rig's code; the rig's currents lie among
/// those that it then asks for.
fn tie(tick: &Tick, rig: &Command, nudger: &mut Sampler) -> Option<Tie> {
    let each = KINDS.map(|kind| (kind.0, vec![kind]));
    let kinds = each.into_iter().chain([(Tie::Together, KINDS.to_vec())]);
    let kinds: Vec<_> = kinds.collect();
    NUDGES.into_iter().find_map(|size| {
        kinds.iter().find_map(|(tie, kinds)| {
            let mut ranges_a = [(f64::INFINITY, f64::NEG_INFINITY); 4];
            let mut others = nudged(tick, kinds, size, nudger);
            let reached = others.any(|other| {
                if other.reason != rig.reason {
                    return false;
                }
                for ((least, greatest), current_a) in ranges_a.iter_mut().zip(other.currents_a) {
                    *least = least.min(current_a - AMONG_A);
                    *greatest = greatest.max(current_a + AMONG_A);
                }
                let mut currents_a = ranges_a.into_iter().zip(rig.currents_a);
                currents_a
                    .all(|((least, greatest), current_a)| (least..=greatest).contains(&current_a))
            });
            reached.then_some(*tie)
        })
    })
}

/// A kind of nudge: its name, and what it does.
type Kind = (Tie, fn(&mut Tick, &mut View, f64, &mut Sampler));

const KINDS: [Kind; 4] = [
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
fn moved([x, y]: [f64; 2], size: f64, nudger: &mut Sampler) -> [f64; 2] {
    let length = libm::hypot(x, y);
    [x, y].map(|component| component + size * length * nudger.nudge())
}

/// What the reference asks for when the tick is nudged; silent where that leaves no pose.
fn nudged<'a>(
    tick: &'a Tick,
    kinds: &'a [Kind],
    size: f64,
    nudger: &'a mut Sampler,
) -> impl Iterator<Item = Command> + 'a {
    (0..TRIES).map(move |_| {
        let (mut tick, mut view) = (tick.clone(), View::EXACT);
        for (_, nudge) in kinds {
            nudge(&mut tick, &mut view, size, nudger);
        }
        reference_command(&tick, view).unwrap_or(Command::none(Reason::SingularPose))
    })
}

/// The greatest difference of two commands' currents, A; infinite where one is undefined.
pub fn apart_a(one: &Command, other: &Command) -> f64 {
    let pairs = one.currents_a.iter().zip(other.currents_a);
    pairs
        .map(|(a, b)| (a - b).abs())
        .map(|apart_a| {
            if apart_a.is_nan() {
                f64::INFINITY
            } else {
                apart_a
            }
        })
        .fold(0.0, f64::max)
}

/// Whether the currents that differ give the same torques, from both sides of 0.2 A.
fn is_step(one: &Command, other: &Command) -> bool {
    let pairs = one.currents_a.into_iter().zip(other.currents_a);
    let mut joints = Joint::ALL.into_iter().zip(pairs);
    let all = joints.all(|(joint, (a, b))| {
        let torques_nm = [a, b].map(|current_a| torque_gain(joint, current_a));
        let same_torque = (torques_nm[0] - torques_nm[1]).abs() <= EQUAL_NM;
        (a - b).abs() <= EQUAL_A || ((a < 0.2) != (b < 0.2) && same_torque)
    });
    all && apart_a(one, other) > EQUAL_A
}

/// Whether a brake makes a wanted force alone, and the rig's command is one of those that this leaves.
fn is_beside_an_idle_brake(tick: &Tick, nearest: &Nearest, rig: &Command) -> bool {
    idle::answers(tick, nearest).iter().any(|answer| {
        answer.reason == rig.reason && (apart_a(answer, rig) <= AMONG_A || is_step(answer, rig))
    })
}

/// Whether no link is faster than its share by a speed for which even the greatest gain asks for a current.
fn is_even(tick: &Tick, view: View) -> bool {
    let LawKind::Ratio(_) = tick.law else {
        return false;
    };
    let mut strongest = tick.clone();
    strongest.law = LawKind::Ratio(RATIO_GAIN_RANGE_NM_S_PER_RAD[1]);
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
