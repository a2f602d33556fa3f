//! This file says which steps are not taken: where an arm or an elbow would turn too far and where the linkage would no longer be one; and
//! what is seen of brakes that hold under no force.

use rigproof_impl::linkage::Linkage;
use rigproof_impl::plant::motion::{Mechanism, Motion};
use rigproof_impl::plant::turn::{GREATEST_TURN_RAD, is_small};
use rigproof_impl::plant::{Outcome, Parameters, Plant, Scheme};
use rigproof_impl::vector::Vector;
use rigproof_spec::layout::Layout;

const STEP_S: f64 = 1e-3;

fn plant(rates_rad_s: [f64; 2]) -> Plant {
    let parameters = Parameters::of(Layout::FourBrake);
    Plant::new(&parameters, [2.17, 0.83], rates_rad_s, &[]).unwrap()
}

fn mechanism(scheme: Scheme) -> Mechanism<f64> {
    let Parameters { arms, inertia, .. } = Parameters::of(Layout::FourBrake);
    Mechanism::new(&arms, &inertia, scheme)
}

fn motion(theta_rad: [f64; 2], rates_rad_s: [f64; 2]) -> Option<Motion<f64>> {
    Motion::new(
        &mechanism(Scheme::Midpoint),
        theta_rad.into(),
        rates_rad_s.into(),
    )
}

#[test]
fn one_arm_that_turns_too_far_is_enough() {
    let limit = GREATEST_TURN_RAD / (0.5 * STEP_S);
    for rates in [[1.03 * limit, 0.1], [-0.1, -1.03 * limit]] {
        let mut fast = plant(rates);
        let before = fast;
        assert_eq!(fast.step([0.3, -0.7], [0.0; 4], STEP_S), Outcome::TooFast);
        assert_eq!(fast, before);
        let mut free = motion([2.17, 0.83], rates).unwrap();
        let outcome = free.step_free(&mechanism(Scheme::Midpoint), Vector::new(0.3, -0.7), STEP_S);
        assert_eq!(outcome, Outcome::TooFast);
    }
    // Twice half the step is more than an arm may turn in one half.
    let mut brisk = plant([9.3, 8.7]);
    assert_eq!(brisk.step([0.3, -0.7], [0.0; 4], 0.01), Outcome::Moved);
    let mut brisk = motion([2.17, 0.83], [9.3, 8.7]).unwrap();
    let free = mechanism(Scheme::Midpoint);
    assert_eq!(
        brisk.step_free(&free, Vector::new(0.3, -0.7), 0.01),
        Outcome::Moved
    );
    // Where all of the step comes after the forces, the arms turn too far at its end only.
    let mut at_end = motion([2.17, 0.83], [9.3, 8.7]).unwrap();
    let euler = mechanism(Scheme::SemiImplicitEuler);
    assert_eq!(
        at_end.step_free(&euler, Vector::new(0.3, -0.7), 0.01),
        Outcome::TooFast
    );
}

/// The angles of ED against AE and of CD against BC, rad.
fn elbows_rad(linkage: &Linkage<f64>) -> [f64; 2] {
    [(linkage.ae, linkage.ed), (linkage.bc, linkage.cd)]
        .map(|(from, arm)| libm::atan2(from.cross(arm), from.dot(arm)))
}

#[test]
fn one_elbow_that_turns_too_far_is_enough() {
    let [mut only_e, mut only_c] = [0; 2];
    for i in 0..150 {
        for j in 0..150 {
            let theta = [1.3 + 0.011_7 * f64::from(i), 0.1 + 0.010_9 * f64::from(j)];
            let rates = [31.0, -29.0];
            let halfway = [
                theta[0] + rates[0] * 0.5 * STEP_S,
                theta[1] + rates[1] * 0.5 * STEP_S,
            ];
            let (Some(start), Some(middle)) = (motion(theta, rates), motion(halfway, rates)) else {
                continue;
            };
            let turned = elbows_rad(&start.linkage)
                .into_iter()
                .zip(elbows_rad(&middle.linkage));
            let [e, c] = [0, 1].map(|k| {
                turned
                    .clone()
                    .nth(k)
                    .map_or(0.0, |(from, to)| (to - from).abs())
            });
            let (far, near) = (1.01 * GREATEST_TURN_RAD, 0.99 * GREATEST_TURN_RAD);
            if (e > far) == (c > far) || (e > near && c > near) || f64::max(e, c) > 1.5 {
                continue;
            }
            let parameters = Parameters::of(Layout::FourBrake);
            let mut plant = Plant::new(&parameters, theta, rates, &[]).unwrap();
            let before = plant;
            assert_eq!(
                plant.step([0.3, -0.7], [0.0; 4], STEP_S),
                Outcome::TooFast,
                "{theta:?} {e} {c}"
            );
            assert_eq!(plant, before);
            only_e += u32::from(e > far);
            only_c += u32::from(c > far);
        }
    }
    assert!(only_e > 5 && only_c > 5, "{only_e} {only_c}");
}

#[test]
fn small_is_an_angle_and_no_length() {
    for length in [0.003, 0.41, 17.0] {
        let from = Vector::new(0.6, -0.8) * length;
        let turned = |angle: f64| {
            Vector::new(
                0.6 * libm::cos(angle) + 0.8 * libm::sin(angle),
                0.6 * libm::sin(angle) - 0.8 * libm::cos(angle),
            ) * length
        };
        for sign in [1.0, -1.0] {
            assert!(is_small(from, turned(0.062 * sign)));
            assert!(!is_small(from, turned(0.063 * sign)));
        }
        assert!(!is_small(from, turned(3.1)));
    }
}

#[test]
fn a_free_step_that_is_taken_ends_where_there_is_a_linkage() {
    let free = mechanism(Scheme::Midpoint);
    let [mut moved, mut at_end, mut halfway] = [0; 3];
    for i in 0..150 {
        for j in 0..150 {
            // Towards the stretched arms and away from them, from near and far.
            let theta = [0.05 + 0.026 * f64::from(i), 0.031 * f64::from(j) - 1.7];
            let rates = if (i + j) % 2 == 0 {
                [-7.1, 6.3]
            } else {
                [7.3, -6.1]
            };
            let Some(start) = motion(theta, rates) else {
                continue;
            };
            let mut end = start;
            let outcome = end.step_free(&free, Vector::new(0.3, -0.7), 0.01);
            let middle = motion(
                [theta[0] + rates[0] * 5e-3, theta[1] + rates[1] * 5e-3],
                rates,
            );
            if outcome == Outcome::Moved {
                let there = motion(end.theta_rad.into(), end.rates_rad_s.into());
                assert!(middle.is_some() && there.is_some(), "{theta:?}");
                moved += 1;
                continue;
            }
            assert_eq!(end, start);
            if middle.is_none() {
                assert_eq!(outcome, Outcome::Singular, "{theta:?}");
                halfway += 1;
            } else if outcome == Outcome::Singular {
                at_end += 1;
            }
        }
    }
    assert!(
        moved > 100 && halfway > 5 && at_end > 0,
        "{moved} {halfway} {at_end}"
    );
}

#[test]
fn brakes_hold_a_linkage_that_stands_under_no_force() {
    let mut standing = plant([0.0; 2]);
    for _ in 0..3 {
        assert_eq!(
            standing.step([0.0; 2], [0.31, 0.0, 0.17, 0.73], STEP_S),
            Outcome::Moved
        );
        assert_eq!(standing.stuck(), [true; 4]);
        assert_eq!(standing.brake_torques_nm(), [0.0; 4]);
    }
}
