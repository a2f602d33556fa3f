//! This file says that whatever the rig's laws are told, they keep the laws of `spec`, in both precisions.

use std::collections::BTreeSet;
use std::sync::Mutex;

use proptest::prelude::*;
use rigproof_certify::built_in::Kind;
use rigproof_certify::declared::Solid;
use rigproof_certify::differential::both::{rig_law, rig_path, situation};
use rigproof_certify::differential::tick::Tick;
use rigproof_impl::law::{Field, Law as _};
use rigproof_impl::number::Real;
use rigproof_impl::path::Path as _;
use rigproof_spec::command::{Command, Reason};
use rigproof_spec::laws::{
    Margin, brake_count, braked_joints, current_limit, free_side, gap, lock, undefined_input,
};
use rigproof_tests::cases;

use crate::impl_laws::sample::Sampler;

/// The laws that a command breaks.
fn broken<R: Real>(tick: &Tick, command: &Command) -> Vec<&'static str> {
    let now = situation::<R>(tick);
    let path = rig_path::<R>(&tick.path).expect("checked");
    let nearest = path.nearest(now.linkage.tip_m);
    let offset_m = nearest.offset_m.to_f64();
    let most = match tick.law {
        Kind::Uncontrolled => 0,
        Kind::Sdof { .. } | Kind::Proportional { .. } | Kind::Optimal { .. } => 1,
        Kind::VelocityRatio { .. } | Kind::Impedance { .. } => 2,
    };
    let field = Field::<R>::new(tick.boundary_m).expect("checked");
    let desired = field.desired(&nearest, now.tip_force_n);
    let towards_n = desired
        .towards
        .map_or(R::zero(), |way| way.dot(now.tip_force_n));
    let along_m_s = desired.direction.dot(now.tip_velocity_m_s);
    let vectors = [now.linkage.tip_m, now.tip_velocity_m_s, now.tip_force_n];
    let inputs: Vec<f64> = vectors
        .into_iter()
        .chain(now.rows)
        .flat_map(<[R; 2]>::from)
        .map(R::to_f64)
        .collect();
    let mut checks = vec![
        ("brake_count", brake_count(command, most)),
        ("braked_joints", braked_joints(tick.layout, command)),
        (
            "lock",
            lock(towards_n.to_f64(), along_m_s.to_f64(), command),
        ),
        ("undefined_input", undefined_input(&inputs, command)),
        (
            "reasons",
            Margin(if answers(tick, command.reason) {
                0.0
            } else {
                -1.0
            }),
        ),
    ];
    checks.extend(
        command
            .currents_a
            .map(|current_a| ("current_limit", current_limit(current_a))),
    );
    if let Kind::Sdof { gap_m } = tick.law {
        let gap_m = R::of(gap_m).to_f64();
        checks.push(("gap", gap(offset_m.abs(), gap_m, command)));
    }
    if let Some(solid) = tick.obstacle {
        let depth_m = match solid {
            Solid::Left => offset_m,
            Solid::Right => -offset_m,
        };
        checks.push(("free_side", free_side(depth_m, command)));
    }
    checks
        .into_iter()
        .filter(|(_, margin)| !margin.holds())
        .map(|(law, _)| law)
        .collect()
}

/// Whether a law may give this reason.
fn answers(tick: &Tick, reason: Reason) -> bool {
    use Reason as R;
    let own = match tick.law {
        Kind::Uncontrolled => matches!(reason, R::Uncontrolled),
        Kind::Sdof { .. } => matches!(
            reason,
            R::Chosen(_) | R::LockedPushedAway | R::InsideGap | R::NoneHelps
        ),
        Kind::Proportional { .. } => matches!(
            reason,
            R::Chosen(_) | R::LockedPushedAway | R::LockedMovingBack | R::NoneHelps
        ),
        Kind::VelocityRatio { .. } => {
            matches!(reason, R::Chosen(_) | R::ChosenPair(..) | R::NothingToDo)
        }
        Kind::Optimal { .. } => matches!(reason, R::Chosen(_) | R::NothingToDo | R::NoneHelps),
        Kind::Impedance { .. } => {
            matches!(reason, R::ChosenPair(..) | R::NothingToDo | R::NoneHelps)
        }
    };
    let wrapped = tick.obstacle.is_some() && reason == R::FreeSide;
    own || wrapped || matches!(reason, R::SingularPose | R::UndefinedInput)
}

fn check<R: Real>(tick: &Tick, seen: &Mutex<BTreeSet<String>>) -> Result<(), TestCaseError> {
    let Some(mut law) = rig_law::<R>(tick) else {
        return Ok(());
    };
    let command = Command::from(law.command(&situation(tick)));
    seen.lock().unwrap().insert(format!("{:?}", command.reason));
    let broken = broken::<R>(tick, &command);
    prop_assert!(broken.is_empty(), "{broken:?} by {command:?} in {tick:?}");
    Ok(())
}

static SEEN: Mutex<BTreeSet<String>> = Mutex::new(BTreeSet::new());

fn every_law_is_kept(seed: u64) -> Result<(), TestCaseError> {
    let mut sampler = Sampler::new(seed);
    for tick in [sampler.plain(), sampler.adverse()] {
        check::<f64>(&tick, &SEEN)?;
        check::<f32>(&tick, &SEEN)?;
    }
    Ok(())
}

#[test]
fn every_command_keeps_every_law_and_every_reason_is_met() {
    let config = ProptestConfig {
        cases: cases(30_000),
        failure_persistence: None,
        ..ProptestConfig::default()
    };
    proptest!(config, |(seed in any::<u64>())| every_law_is_kept(seed)?);
    let seen = SEEN.lock().unwrap();
    // Eleven reasons: of the chosen ones four joints and six pairs.
    assert_eq!(seen.len(), 9 + 4 + 6, "{seen:?}");
}
