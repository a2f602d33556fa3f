//! This file says what holds for a rig with left-out physics: energy, passivity, onset, and the state a led rig comes to.

use crate::budget::assert_within_budget;
use rigproof_model::rig::{JointEffect, Rig};
use rigproof_spec::effect::Mechanism::{self, *};
use rigproof_spec::joint::Joint;
use rigproof_spec::layout::Layout;

fn at(joint: Joint, mechanism: Mechanism, parameters: &[f64]) -> JointEffect {
    JointEffect {
        mechanism,
        joint: Some(joint),
        of_torque: false,
        parameters: parameters.to_vec(),
        onset_s: None,
    }
}

fn whole(mechanism: Mechanism, parameters: &[f64]) -> JointEffect {
    JointEffect {
        joint: None,
        ..at(Joint::A, mechanism, parameters)
    }
}

/// What only takes energy, instant by instant.
fn takers() -> Vec<JointEffect> {
    vec![
        at(Joint::E, DryOffset, &[0.137]),
        at(Joint::A, Viscous, &[0.083]),
        at(Joint::B, Stribeck, &[0.31, 0.23, 1.7]),
        at(Joint::C, ReversalOvershoot, &[0.29, 0.061]),
        at(Joint::E, Settling, &[0.37, 0.71]),
        at(Joint::B, GainError, &[0.19]),
        at(Joint::A, ThermalFade, &[0.043, 5.3]),
        at(Joint::A, LoadDependent, &[0.0071]),
        at(Joint::C, CurrentHysteresis, &[0.041, 0.31, 0.37]),
    ]
}

/// What stores energy, gives it, or changes when a brake acts.
fn others() -> Vec<JointEffect> {
    vec![
        at(Joint::C, ConstantBias, &[-0.083]),
        at(Joint::E, DirectionAsymmetry, &[0.017, 0.053]),
        at(Joint::A, Presliding, &[0.23, 0.011]),
        at(Joint::E, Stribeck, &[0.19, 0.41, 1.7, 0.023]),
        at(Joint::B, Hysteresis, &[2.3, 9.7, 3.1]),
        at(Joint::A, Ripple, &[0.071, 0.043, 0.217]),
        at(Joint::A, UnevenFriction, &[0.031, -0.023, 0.31]),
        at(Joint::E, Spring, &[0.113]),
        at(Joint::C, NonlinearSpring, &[0.037]),
        at(Joint::A, JointStop, &[0.131, 0.71, 1.0]),
        at(Joint::B, BiasDrift, &[0.071, 1.3]),
        at(Joint::A, Lag, &[0.029]),
        at(Joint::E, DeadTime, &[0.0173]),
        at(Joint::B, Saturation, &[0.17]),
        at(Joint::B, Saturation, &[0.27, 2.3]),
        at(Joint::C, BacklashWidth, &[0.037]),
        whole(Gravity, &[0.071, -0.093]),
        whole(Payload, &[0.31]),
        whole(InertiaScale, &[-0.11]),
        whole(InertiaError, &[0.0113, -0.0053, 0.0037, 0.0071, 0.053]),
    ]
}

/// Steps of 1 ms.
const STEPS: usize = 1700;

/// A hand that leads the tip to and fro while brakes come and go, and the currents, A.
fn step(rig: &mut Rig, k: usize) {
    let time_s = k as f64 * 1e-3;
    let goal_m = [
        0.023 + 0.079 * libm::sin(5.3 * time_s + 0.7),
        0.397 + 0.047 * libm::sin(7.1 * time_s + 1.9),
    ];
    let pull = |tip_m: [f64; 2], velocity_m_s: [f64; 2]| {
        [0, 1].map(|i| 290.0 * (goal_m[i] - tip_m[i]) - 9.0 * velocity_m_s[i])
    };
    let on = |phase: f64| f64::from(libm::sin(9.1 * time_s + phase) > 0.4);
    let mut currents_a = [
        0.31 * on(0.3),
        0.23 * on(1.7),
        0.37 * on(3.1),
        0.29 * on(4.9),
    ];
    if rig.parameters().layout == Layout::ThreeBrake {
        currents_a[3] = 0.0;
    }
    rig.step_under(&pull, currents_a, 1e-3).unwrap();
}

fn rig(layout: Layout, effects: &[JointEffect]) -> Rig {
    let rig = Rig::new(layout, [0.037, 0.411]).unwrap();
    rig.with_effects(effects).unwrap()
}

/// The energy that is not accounted for, as a share of what was dissipated; brakes are held to be passive on the way.
fn unaccounted(effects: &[JointEffect], takes_only: bool) -> f64 {
    let layout = match effects {
        [own] if own.mechanism == BearingFriction => Layout::ThreeBrake,
        _ => Layout::FourBrake,
    };
    let mut rig = rig(layout, effects);
    let mut dissipated_j = 0.0;
    for k in 0..STEPS {
        step(&mut rig, k);
        let torques = rig.brake_torques_nm().into_iter();
        let all = torques
            .zip(rig.joint_rates_rad_s())
            .zip(rig.yield_torques_nm());
        for ((torque, rate), yield_nm) in all {
            assert!(
                torque * rate <= 0.0,
                "{effects:?}: {torque} N·m at {rate} rad/s"
            );
            assert!(
                torque.abs() <= yield_nm * (1.0 + 1e-9),
                "{effects:?}: {torque} N·m"
            );
        }
        assert!(
            !takes_only || rig.dissipated_j() >= dissipated_j - 1e-12,
            "{effects:?} gives {} J",
            dissipated_j - rig.dissipated_j()
        );
        dissipated_j = rig.dissipated_j();
    }
    let events = rig.events();
    assert!(
        events > 30 && dissipated_j > 0.3,
        "{events} events, {dissipated_j} J"
    );
    (rig.work_j() - rig.kinetic_energy_j() - dissipated_j).abs() / dissipated_j
}

#[test]
fn energy_is_accounted_for_with_every_effect_and_brakes_only_take() {
    let mut shares = vec![unaccounted(&takers(), true)];
    for effect in takers() {
        shares.push(unaccounted(&[effect], true));
    }
    let bearing = at(Joint::C, BearingFriction, &[0.127]);
    shares.push(unaccounted(&[bearing], true));
    for effect in others() {
        shares.push(unaccounted(&[effect], false));
    }
    assert_within_budget("rig_effects_energy", shares);
}

#[test]
fn an_effect_changes_nothing_to_the_bit_before_its_onset_and_something_after() {
    let onset_s = 0.7113;
    for effect in takers().into_iter().chain(others()) {
        let late = JointEffect {
            onset_s: Some(onset_s),
            ..effect
        };
        let mut bare = rig(Layout::FourBrake, &[]);
        let mut own = rig(Layout::FourBrake, std::slice::from_ref(&late));
        for k in 0..STEPS {
            step(&mut bare, k);
            step(&mut own, k);
            let same = bare.base_angles_rad() == own.base_angles_rad();
            // The first step that begins after the onset is number 712.
            assert!(same || k >= 712, "{late:?} acts in step {k}");
        }
        assert_ne!(bare.base_angles_rad(), own.base_angles_rad(), "{late:?}");
    }
}

#[test]
fn a_rig_that_was_led_goes_on_as_the_one_that_went_there() {
    let (mut torques, mut angles) = (Vec::new(), Vec::new());
    for effect in takers().into_iter().chain(others()) {
        let mut free = rig(Layout::FourBrake, std::slice::from_ref(&effect));
        let mut led = free.clone();
        for k in 0..STEPS {
            let before_s = free.time_s();
            let mut currents_a = [0.0; 4];
            let on = |phase: f64| f64::from(libm::sin(9.1 * k as f64 * 1e-3 + phase) > 0.4);
            for (current_a, (size, phase)) in
                currents_a
                    .iter_mut()
                    .zip([(0.31, 0.3), (0.23, 1.7), (0.37, 3.1), (0.29, 4.9)])
            {
                *current_a = size * on(phase);
            }
            step(&mut free, k);
            let step_s = free.time_s() - before_s;
            led.lead(
                free.base_angles_rad(),
                free.base_rates_rad_s(),
                currents_a,
                [true; 4],
                step_s,
            )
            .unwrap();
            if k % 53 == 17 {
                let pairs = free
                    .yield_torques_nm()
                    .into_iter()
                    .zip(led.yield_torques_nm());
                // A led rig feels no force on its tip before it is let go.
                if effect.mechanism != LoadDependent {
                    torques.extend(pairs.map(|(free, led)| (free - led).abs()));
                }
                let mut ends = [free.clone(), led.clone()].map(|mut rig| {
                    for later in 0..50 {
                        step(&mut rig, k + 1 + later);
                    }
                    rig.base_angles_rad()
                });
                let [a, b] = &mut ends;
                angles.extend([0, 1].map(|i| (a[i] - b[i]).abs()));
            }
        }
    }
    assert_within_budget("rig_led_yields", torques);
    assert_within_budget("rig_led_angles", angles);
}

#[test]
fn a_delay_a_limit_and_a_lag_act_in_one_order_however_they_are_given() {
    let mut given = [
        at(Joint::B, DeadTime, &[0.0173]),
        at(Joint::B, Saturation, &[0.17]),
        at(Joint::B, Lag, &[0.029]),
    ];
    let end = |effects: &[JointEffect]| {
        let mut rig = rig(Layout::FourBrake, effects);
        (0..STEPS).for_each(|k| step(&mut rig, k));
        rig.base_angles_rad()
    };
    let forth = end(&given);
    assert_ne!(forth, end(&given[..2]));
    assert_ne!(forth, end(&given[1..]));
    given.reverse();
    assert_eq!(forth, end(&given));
}

#[test]
fn what_no_rig_can_have_is_refused_by_name() {
    let long = at(Joint::A, Viscous, &[0.1, 0.2]);
    for (effect, expected) in [
        (whole(ForceGain, &[0.07]), "`force_gain` at no joint"),
        (at(Joint::A, EncoderScale, &[0.013]), "`encoder_scale` at A"),
        (whole(ChannelSkew, &[0.007]), "`channel_skew`"),
        (whole(Viscous, &[0.07]), "it needs a joint"),
        (at(Joint::C, Lag, &[0.013]), "that joint has no brake"),
        (at(Joint::B, Payload, &[0.13]), "it is of the whole linkage"),
        (
            at(Joint::B, Presliding, &[0.13, -0.7]),
            "`travel` is -0.7 in SI units and has to be above 0",
        ),
        (at(Joint::B, DryOffset, &[f64::NAN]), "`level` is NaN"),
        (at(Joint::B, Saturation, &[-0.13]), "`limit` is -0.13"),
        (long, "another number of parameters"),
        (at(Joint::A, LoadDependent, &[]), "`load_dependent` at A"),
        (
            at(Joint::C, LoadDependent, &[0.007]),
            "that joint has no brake",
        ),
        (whole(Payload, &[-7.7]), "m_D of the tip is -7"),
    ] {
        let rig = Rig::new(Layout::ThreeBrake, [0.037, 0.411]).unwrap();
        let error = rig.with_effects(&[effect]).unwrap_err().to_string();
        assert!(error.contains(expected), "{error} lacks {expected}");
    }
}
