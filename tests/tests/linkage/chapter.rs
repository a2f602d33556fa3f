//! This file shows what chapter 4 says otherwise than its own numbers do.

use core::f64::consts::PI;

use rigproof_model::linkage::device::Concept;
use rigproof_model::linkage::{forward, limits, workspace};
use rigproof_spec::geometry::{Angle, AngleRange, AngleRanges, STOPS, arms};
use rigproof_spec::layout::Layout;

use crate::linkage::oracle::rad;

#[test]
fn the_arms_of_about_ninety_percent_are_l_ae_and_l_ab() {
    let built = arms(Layout::FourBrake);
    for length_m in [built.l_ae_m, built.l_ab_m] {
        let share = length_m / built.l_ed_m;
        println!("{share}");
        // Nearer to nine tenths than half an increment of a tenth.
        assert!((share - 0.9).abs() < 0.05, "{share}");
    }
    // As printed, L_ED would be 90 % of a length; no arm is 1/0.9 of it.
    for length_m in [built.l_ae_m, built.l_bc_m, built.l_cd_m, built.l_ab_m] {
        assert!((built.l_ed_m / length_m - 0.9).abs() > 0.05, "{length_m}");
    }
}

#[test]
fn without_a_stop_at_the_tip_the_four_brake_layout_reaches_its_forward_singularity() {
    let open = AngleRange::new(f64::NEG_INFINITY, f64::INFINITY);
    let rings = AngleRanges { d: open, ..STOPS };
    let four = arms(Layout::FourBrake);
    // E and C as far apart as ED and CD together reach, and 0.1 mm less: L_AB − 2·L_AE·cos θA = 2·L_ED on the mirror line.
    let theta_a = |apart_m: f64| libm::acos((0.267 - apart_m) / (2.0 * 0.264));
    let near = theta_a(0.61 - 1e-4);
    let pose = forward::pose(&four, near, PI - near).unwrap();
    println!("θD {}°", pose.theta_d_rad * 180.0 / PI);
    assert!(pose.theta_d_rad > rad(177.0));
    assert!(limits::inside(&rings, &pose).is_ok());
    assert!(limits::inside(&STOPS, &pose).is_err());
    let beyond = theta_a(0.61 + 1e-4);
    assert!(forward::pose(&four, beyond, PI - beyond).is_err());
    // On the 3-brake layout θD is what is left of θE, which has a ring.
    let three = arms(Layout::ThreeBrake);
    for (a, b) in [(171.3, 2.9), (93.1, 81.7), (121.9, 43.3)] {
        let pose = forward::pose(&three, rad(a), rad(b)).unwrap();
        let sum = pose.angle_rad(Angle::D) + pose.angle_rad(Angle::E);
        assert!((sum - 2.0 * PI).abs() < 1e-12, "{sum}");
    }
}

#[test]
fn the_paths_of_pter_are_well_spaced_everywhere_and_those_of_both_layouts_are_not() {
    let well_spaced = |concept: Concept| {
        let map = workspace::map(&concept.device(), 0.0043).unwrap();
        let figures = map.figures().unwrap();
        figures.well_spaced_m2 / figures.area_m2
    };
    let [pter, four, three] =
        [Concept::ScaledPter, Concept::FourBrake, Concept::ThreeBrake].map(well_spaced);
    println!("PTER {pter:.4}, 4-brake {four:.4}, 3-brake {three:.4}");
    assert_eq!(pter, 1.0);
    assert!((four - 0.76).abs() < 0.01 && (three - 0.32).abs() < 0.01);
}
