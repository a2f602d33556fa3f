//! This file says that a linkage at or beyond a singularity, out of reach, or no linkage at all is a named error.

use proptest::prelude::*;
use rigproof_model::ModelError;
use rigproof_model::linkage::jacobian::jacobian;
use rigproof_model::linkage::singularity::{LEAST_MEASURE, measure};
use rigproof_model::linkage::{Pair, forward, inverse, limits};
use rigproof_spec::geometry::{Angle, AngleRange, Arms, angle_ranges, arms};
use rigproof_spec::layout::Layout;
use rigproof_tests::cases;

use crate::linkage::oracle::{linkages, make, rad, three_brake};

fn pair_of(error: ModelError) -> Option<Pair> {
    match error {
        ModelError::Singular { pair, .. } => Some(pair),
        _ => None,
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: cases(20_000), max_global_rejects: 4 * cases(20_000), ..ProptestConfig::default() })]

    #[test]
    fn beyond_a_singularity_of_the_left_side_is_an_error(made in linkages(), e in 10.0..170.0_f64, at_tip in 5.0..175.0_f64) {
        let Arms { l_ae_m, l_ed_m, l_bc_m, l_cd_m, .. } = made.arms;
        let folded = make([l_ae_m, l_ed_m, l_bc_m, l_cd_m], [rad(e), made.theta_c_rad, rad(at_tip)]);
        // The elbow bends the other way; where the tip is still to the left of the way from E to C it is the tip that is found.
        prop_assume!(libm::sin(folded.theta_d_rad) > 0.1);
        let error = forward::pose(&folded.arms, folded.theta_a_rad, folded.theta_b_rad).unwrap_err();
        prop_assert_eq!(pair_of(error), Some(Pair::AeEd), "{}", error);
    }

    #[test]
    fn beyond_a_singularity_of_the_outer_arms_is_an_error(made in linkages()) {
        prop_assume!(libm::sin(made.theta_d_rad) < -0.1);
        let error = inverse::pose(&made.arms, made.tip_m).unwrap_err();
        prop_assert_eq!(pair_of(error), Some(Pair::EdCd), "{}", error);
    }

    #[test]
    fn the_three_brake_layout_has_no_pose_with_its_arms_passed([a, b] in three_brake()) {
        let arms = arms(Layout::ThreeBrake);
        prop_assert!(pair_of(forward::pose(&arms, b, a).unwrap_err()).is_some());
        prop_assert!(pair_of(forward::pose(&arms, a, a).unwrap_err()).is_some());
    }

    #[test]
    fn a_tip_out_of_reach_names_the_base_joint(made in linkages(), direction in -3.1..3.1_f64, excess in 1.001..9.0_f64) {
        let arms = made.arms;
        let far = (arms.l_ae_m + arms.l_ed_m) * excess;
        let tip = [far * libm::cos(direction) - arms.l_ab_m / 2.0, far * libm::sin(direction)];
        let error = inverse::pose(&arms, tip).unwrap_err();
        let ModelError::Unreachable { base: "A", distance_m, greatest_m, .. } = error else {
            return Err(TestCaseError::fail(error.to_string()));
        };
        prop_assert!((distance_m / far - 1.0).abs() < 1e-12 && greatest_m < distance_m);
    }
}

#[test]
fn the_measure_falls_to_its_least_value_and_then_the_pose_is_refused() {
    let four = arms(Layout::FourBrake);
    let lengths = [four.l_ae_m, four.l_ed_m, four.l_bc_m, four.l_cd_m];
    let mut refused = [0; 3];
    for (which, pair) in Pair::ALL.into_iter().enumerate() {
        let mut last = f64::INFINITY;
        for power in 1..9 {
            let near_rad = 1.07 * libm::pow(10.0, -f64::from(power));
            let (e, c) = match pair {
                Pair::AeEd => (rad(180.0) + near_rad, rad(77.0)),
                Pair::BcCd => (rad(283.0), near_rad),
                // Equal and opposite elbows make the two sides mirror each other.
                Pair::EdCd => (rad(281.0), rad(79.0)),
            };
            let at_tip = match pair {
                Pair::EdCd => {
                    // θD is the angle at the tip plus what both elbows add; it is driven to π from below.
                    let made = make(lengths, [e, c, rad(60.0)]);
                    rad(60.0) + (rad(180.0) - near_rad - made.theta_d_rad)
                }
                _ => rad(41.0),
            };
            let made = make(lengths, [e, c, at_tip]);
            match inverse::pose(&made.arms, made.tip_m) {
                Ok(pose) => {
                    let here = measure(&pose, pair);
                    assert!(
                        (here / libm::sin(near_rad) - 1.0).abs() < 1e-4,
                        "{pair:?} {here:e}"
                    );
                    assert!(here < last && here >= LEAST_MEASURE);
                    assert!(jacobian(&made.arms, &pose).is_ok());
                    let (a, b) = (pose.theta_a_rad, pose.theta_b_rad);
                    let there = forward::pose(&made.arms, a, b).unwrap();
                    let back = inverse::pose(&made.arms, there.tip_m).unwrap();
                    let off = (back.theta_a_rad - a)
                        .abs()
                        .max((back.theta_b_rad - b).abs());
                    println!("{pair:?} {near_rad:e} rad away: round trip {off:e} rad");
                    assert!(off < 1e-10, "{pair:?} {near_rad:e}: {off:e}");
                    last = here;
                }
                Err(error) => {
                    assert_eq!(pair_of(error), Some(pair), "{near_rad:e}: {error}");
                    assert!(near_rad < 1.1 * LEAST_MEASURE, "{near_rad:e}");
                    refused[which] += 1;
                }
            }
        }
    }
    assert!(
        refused.iter().all(|count| (3..=4).contains(count)),
        "{refused:?}"
    );
}

#[test]
fn outer_arms_that_do_not_meet_are_an_error_with_the_distances() {
    let four = arms(Layout::FourBrake);
    let error = forward::pose(&four, rad(171.0), rad(3.0)).unwrap_err();
    let ModelError::CannotClose {
        distance_m,
        greatest_m,
        ..
    } = error
    else {
        panic!("{error}");
    };
    assert!(distance_m > 0.78 && (greatest_m - 0.61).abs() < 1e-15);
    let short = Arms {
        l_ed_m: 0.113,
        ..four
    };
    let error = forward::pose(&short, rad(91.0), rad(88.0)).unwrap_err();
    assert!(matches!(error, ModelError::CannotClose { .. }) || pair_of(error).is_some());
}

#[test]
fn the_base_joint_itself_is_a_singularity_of_equal_arms() {
    let arms = arms(Layout::ThreeBrake);
    let error = inverse::pose(&arms, [0.0, 0.0]).unwrap_err();
    assert_eq!(pair_of(error), Some(Pair::AeEd));
}

#[test]
fn numbers_that_are_no_linkage_are_refused_by_name() {
    let good = arms(Layout::FourBrake);
    for (arms, name) in [
        (
            Arms {
                l_ae_m: -0.264,
                ..good
            },
            "L_AE",
        ),
        (
            Arms {
                l_ed_m: f64::NAN,
                ..good
            },
            "L_ED",
        ),
        (
            Arms {
                l_bc_m: f64::INFINITY,
                ..good
            },
            "L_BC",
        ),
        (
            Arms {
                l_cd_m: 305.0,
                ..good
            },
            "L_CD",
        ),
        (
            Arms {
                l_ab_m: -0.011,
                ..good
            },
            "L_AB",
        ),
    ] {
        for error in [
            forward::pose(&arms, rad(121.0), rad(57.0)).unwrap_err(),
            inverse::pose(&arms, [0.031, 0.417]).unwrap_err(),
        ] {
            let message = error.to_string();
            assert!(matches!(error, ModelError::ArmLength { .. }), "{message}");
            assert!(
                message.contains(name) && message.contains("at most 300 m"),
                "{message}"
            );
        }
    }
    for error in [
        forward::pose(&good, f64::NAN, rad(57.0)).unwrap_err(),
        forward::pose(&good, rad(121.0), f64::NEG_INFINITY).unwrap_err(),
        inverse::pose(&good, [f64::NAN, 0.41]).unwrap_err(),
        inverse::pose(&good, [0.03, f64::INFINITY]).unwrap_err(),
    ] {
        assert!(matches!(error, ModelError::NotFinite { .. }), "{error}");
    }
}

#[test]
fn joint_limits_are_checked_angle_by_angle() {
    let four = arms(Layout::FourBrake);
    let ranges = angle_ranges(Layout::FourBrake);
    let pose = forward::pose(&four, rad(113.0), rad(61.0)).unwrap();
    limits::check(&ranges, &pose).unwrap();
    for angle in Angle::ALL {
        let value_deg = pose.angle_rad(angle) / rad(1.0);
        let mut narrow = ranges;
        let beyond = AngleRange::new(value_deg + 0.01, value_deg + 9.0);
        match angle {
            Angle::A => narrow.a = beyond,
            Angle::E => narrow.e = beyond,
            Angle::B => narrow.b = beyond,
            Angle::C => narrow.c = beyond,
            Angle::D => narrow.d = beyond,
        }
        let error = limits::check(&narrow, &pose).unwrap_err();
        assert!(
            matches!(error, ModelError::AngleRange { angle: found, .. } if found == angle),
            "{error}"
        );
        let message = error.to_string();
        assert!(
            message.contains(&format!("joint {}", angle.letter())),
            "{message}"
        );
    }
    let crossed = AngleRange::new(143.0, 37.0);
    let error = limits::check_ranges(&rigproof_spec::geometry::AngleRanges {
        a: crossed,
        ..ranges
    })
    .unwrap_err();
    assert!(
        matches!(
            error,
            ModelError::AngleRangeCrossed {
                angle: Angle::A,
                ..
            }
        ),
        "{error}"
    );
    let undefined = AngleRange::new(f64::NAN, 37.0);
    assert!(
        limits::check_ranges(&rigproof_spec::geometry::AngleRanges {
            e: undefined,
            ..ranges
        })
        .is_err()
    );
}
