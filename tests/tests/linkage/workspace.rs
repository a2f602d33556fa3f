//! This file says how large the workspaces are, which limits bound them, and how evenly their paths are spread.

use core::f64::consts::PI;

use proptest::prelude::*;
use rigproof_model::ModelError;
use rigproof_model::linkage::device::{Concept, Device};
use rigproof_model::linkage::paths::{directions_rad, greatest_angle_rad};
use rigproof_model::linkage::{forward, sweep, workspace};
use rigproof_spec::geometry::{Angle, STOPS, angle_ranges, arms};
use rigproof_spec::layout::Layout;
use rigproof_tests::cases;

use crate::linkage::oracle::{four_brake, rad, three_brake};

#[test]
fn the_four_brake_ranges_of_table_4_2_follow_from_the_stops() {
    let table = angle_ranges(Layout::FourBrake);
    let derived = workspace::attained_ranges(&arms(Layout::FourBrake), &STOPS)
        .unwrap()
        .unwrap();
    for angle in Angle::ALL {
        let (derived, table) = (derived.of(angle), table.of(angle));
        println!(
            "θ{}: derived {:.4}° to {:.4}°, table {}° to {}°",
            angle.letter(),
            derived.least_deg,
            derived.greatest_deg,
            table.least_deg,
            table.greatest_deg
        );
        // The table is the derived range with its ends rounded outward to whole degrees.
        let tiny = 1e-6;
        assert_eq!((derived.least_deg + tiny).floor(), table.least_deg);
        assert_eq!((derived.greatest_deg - tiny).ceil(), table.greatest_deg);
    }
    // θD is least where AE and BC are parallel: the triangle ECD then has the base L_AB.
    let least_deg = 2.0 * libm::asin(0.267 / 2.0 / 0.305) * 180.0 / PI;
    assert!(
        (derived.d.least_deg - least_deg).abs() < 1e-6,
        "{least_deg}"
    );
}

#[test]
fn the_three_brake_ranges_of_table_4_2_follow_from_the_stops() {
    let table = angle_ranges(Layout::ThreeBrake);
    let derived = workspace::attained_ranges(&arms(Layout::ThreeBrake), &STOPS)
        .unwrap()
        .unwrap();
    for angle in Angle::ALL {
        let (derived, table) = (derived.of(angle), table.of(angle));
        assert!(
            (derived.least_deg - table.least_deg).abs() < 1e-6,
            "{derived:?}"
        );
        assert!(
            (derived.greatest_deg - table.greatest_deg).abs() < 1e-6,
            "{derived:?}"
        );
    }
}

#[test]
fn without_the_order_of_the_base_arms_theta_d_falls_below_its_range() {
    let four = arms(Layout::FourBrake);
    // Inside every stop of §4.5, and θD far below the table's 51°.
    let pose = forward::pose(&four, rad(85.3), rad(94.9)).unwrap();
    for angle in [Angle::E, Angle::C, Angle::D] {
        let value_deg = pose.angle_rad(angle) / rad(1.0);
        let stop = STOPS.of(angle);
        assert!(
            (stop.least_deg..stop.greatest_deg).contains(&value_deg),
            "{angle:?} {value_deg}"
        );
    }
    assert!(pose.theta_d_rad < rad(45.0));
    let device = Device::layout(Layout::FourBrake);
    assert!(device.tip_forces(pose.tip_m).is_err());
}

/// L²·∫(π − δ)·sin δ dδ from 10° to 170°: θA − θB = δ, θB from 0 to π − δ, |∂(x, y)/∂(θA, θB)| = L²·sin δ.
fn three_brake_area_m2() -> f64 {
    let integral = |delta: f64| -(PI - delta) * libm::cos(delta) - libm::sin(delta);
    0.305 * 0.305 * (integral(rad(170.0)) - integral(rad(10.0)))
}

#[test]
fn the_three_brake_area_is_that_of_its_closed_form() {
    let device = Device::layout(Layout::ThreeBrake);
    let exact = three_brake_area_m2();
    let counted = workspace::map(&device, 0.0023).unwrap().figures().unwrap();
    let traced = workspace::boundary(&device, 0.0023).unwrap();
    println!(
        "3-brake workspace {exact:.6} m²: counted {:.6}, traced {:.6}",
        counted.area_m2,
        traced.area_m2()
    );
    assert!((counted.area_m2 / exact - 1.0).abs() < 2e-3);
    assert!((traced.area_m2() / exact - 1.0).abs() < 5e-4);
}

#[test]
fn the_four_brake_area_is_that_of_its_joint_space() {
    // The same area by the other way: base angles on a grid, weighted with the area they sweep.
    let arms = arms(Layout::FourBrake);
    let ranges = angle_ranges(Layout::FourBrake);
    let (cells, mut area) = (700, 0.0);
    for i in 0..cells {
        for k in 0..cells {
            let at = |index: i32| PI * (f64::from(index) + 0.5) / f64::from(cells);
            let (a, b) = (at(i), at(k));
            let Ok(pose) = forward::pose(&arms, a, b) else {
                continue;
            };
            let inside = Angle::ALL.into_iter().all(|angle| {
                let range = ranges.of(angle);
                (range.least_deg..=range.greatest_deg)
                    .contains(&(pose.angle_rad(angle) * 180.0 / PI))
            });
            if inside && a >= b {
                let sines = libm::sin(-pose.theta_e_rad) * libm::sin(pose.theta_c_rad)
                    / libm::sin(pose.theta_d_rad);
                area += arms.l_ae_m * arms.l_bc_m * sines * PI * PI / f64::from(cells * cells);
            }
        }
    }
    let device = Device::layout(Layout::FourBrake);
    let counted = workspace::map(&device, 0.0019)
        .unwrap()
        .figures()
        .unwrap()
        .area_m2;
    let traced = workspace::boundary(&device, 0.0047).unwrap().area_m2();
    println!(
        "4-brake workspace: joint space {area:.6} m², counted {counted:.6}, traced {traced:.6}"
    );
    assert!((counted / area - 1.0).abs() < 4e-3 && (traced / area - 1.0).abs() < 4e-3);
}

#[test]
fn every_piece_of_a_boundary_is_a_limit_and_every_limit_bounds() {
    for (layout, bounding) in [
        (Layout::ThreeBrake, vec![Angle::A, Angle::E, Angle::B]),
        (
            Layout::FourBrake,
            vec![Angle::A, Angle::E, Angle::B, Angle::C],
        ),
    ] {
        let traced = workspace::boundary(&Device::layout(layout), 0.0061).unwrap();
        let mut found: Vec<Angle> = Vec::new();
        for (point, limit) in traced.loops.iter().flatten() {
            match limit {
                ModelError::AngleRange { angle, .. } => found.push(*angle),
                ModelError::BaseArmsCrossed { .. } => {}
                other => panic!("{point:?}: {other}"),
            }
        }
        for angle in bounding {
            assert!(found.contains(&angle), "{layout:?} {angle:?}");
        }
        assert!(traced.area_m2() > 0.1);
    }
}

fn forces(concept: Concept, tip_m: [f64; 2]) -> Vec<[f64; 2]> {
    concept.device().tip_forces(tip_m).unwrap()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: cases(3_000), max_local_rejects: 10 * cases(3_000), ..ProptestConfig::default() })]

    #[test]
    fn parallelograms_have_path_angles_in_closed_form([a, b] in three_brake()) {
        let between = a - b;
        prop_assume!((rad(10.001)..rad(169.999)).contains(&between) && b > 1e-6 && a < PI - 1e-6);
        let arms = arms(Layout::ThreeBrake);
        let tip_m = forward::pose(&arms, a, b)?.tip_m;
        let three = greatest_angle_rad(&forces(Concept::ThreeBrake, tip_m));
        prop_assert!((three - (PI - between).max(between / 2.0)).abs() < 1e-9, "{three}");
        let pter = greatest_angle_rad(&forces(Concept::ScaledPter, tip_m));
        prop_assert!((pter - (between / 2.0).max(PI / 2.0 - between / 2.0)).abs() < 1e-9, "{pter}");
    }

    #[test]
    fn a_locked_brake_leaves_the_path_that_geometry_gives([a, b] in four_brake()) {
        let arms = arms(Layout::FourBrake);
        let pose = forward::pose(&arms, a, b)?;
        let device = Device::layout(Layout::FourBrake);
        let Ok(forces) = device.tip_forces(pose.tip_m) else { return Ok(()) };
        let half = arms.l_ab_m / 2.0;
        // Lock A: about E. Lock E: about A. Lock B: about C. Lock C: about B.
        let centres = [pose.point_e_m, [-half, 0.0], pose.point_c_m, [half, 0.0]];
        for (path, [x, y]) in directions_rad(&forces).into_iter().zip(centres) {
            let (dx, dy) = (pose.tip_m[0] - x, pose.tip_m[1] - y);
            let along = (dx * libm::cos(path) + dy * libm::sin(path)) / libm::hypot(dx, dy);
            prop_assert!(along.abs() < 1e-9, "{along}");
        }
        let greatest = greatest_angle_rad(&forces);
        prop_assert!((PI / 4.0 - 1e-12..PI).contains(&greatest), "{greatest}");
    }
}

#[test]
fn the_table_spreads_its_paths_evenly_everywhere_and_the_linkages_do_not() {
    for (concept, least_deg, greatest_deg) in [
        (Concept::XyTable, 45.0, 45.0),
        (Concept::ScaledPter, 45.0, 85.0),
        (Concept::ThreeBrake, 60.0, 170.0),
    ] {
        let figures = workspace::map(&concept.device(), 0.0029)
            .unwrap()
            .figures()
            .unwrap();
        let (least, greatest) = (
            figures.least_rad * 180.0 / PI,
            figures.greatest_rad * 180.0 / PI,
        );
        println!(
            "{}: {least:.2}° to {greatest:.2}°, mean {:.2}°",
            concept.name(),
            figures.mean_rad * 180.0 / PI
        );
        assert!(
            least >= least_deg - 1e-9 && least < least_deg + 0.1,
            "{least}"
        );
        assert!(
            greatest <= greatest_deg + 1e-9 && greatest > greatest_deg - 0.6,
            "{greatest}"
        );
    }
    let forces = Concept::XyTable
        .device()
        .tip_forces([0.011, -0.17])
        .unwrap();
    assert_eq!(forces.len(), 4);
    let error = Concept::XyTable
        .device()
        .tip_forces([0.31, f64::NAN])
        .unwrap_err();
    assert!(matches!(error, ModelError::OffTable { .. }), "{error}");
}

#[test]
fn a_grid_is_neither_coarse_nor_endless() {
    let device = Device::layout(Layout::FourBrake);
    for step_m in [0.3, 1e-7, f64::NAN, -0.01, 0.0] {
        let error = workspace::map(&device, step_m).unwrap_err();
        assert!(matches!(error, ModelError::Step { .. }), "{error}");
    }
}

/// The score of §4.3's pairs, best first.
fn ranked() -> Vec<sweep::Candidate> {
    let candidates = sweep::pairs().map(|pair| sweep::candidate(pair, &STOPS).unwrap());
    let mut ranked: Vec<sweep::Candidate> = candidates.collect();
    ranked.sort_by(|a, b| b.score().total_cmp(&a.score()));
    ranked
}

#[test]
fn the_chosen_arms_are_near_the_best_of_the_sweep() {
    let ranked = ranked();
    assert_eq!(ranked.len(), 20 * 21);
    let place = ranked
        .iter()
        .position(|c| c.l_ae == 0.9 && c.l_ab == 0.9)
        .unwrap();
    let share = ranked[place].score() / ranked[0].score();
    println!(
        "0.9/0.9 is number {} of {}, {:.1} % of the best score",
        place + 1,
        ranked.len(),
        100.0 * share
    );
    assert!(share > 0.9 && place > 0, "{share}");
    // Of L_AE = 0.9 the well-spaced area alone is greatest at L_AB = 0.9 or beside it.
    let well_spaced =
        |c: &&sweep::Candidate| c.figures.map_or(0.0, |figures| figures.well_spaced_m2);
    let same_arms = ranked.iter().filter(|c| c.l_ae == 0.9);
    let best = same_arms
        .max_by(|a, b| well_spaced(a).total_cmp(&well_spaced(b)))
        .unwrap();
    println!(
        "L_AE = 0.9: most well-spaced area, {:.3}, at L_AB = {}",
        well_spaced(&best),
        best.l_ab
    );
    assert!((best.l_ab - 0.9).abs() < 0.11, "{}", best.l_ab);
    // The longest arms have the largest workspace, and a workspace needs arms that reach across the base.
    let area = |c: &&sweep::Candidate| c.figures.map_or(0.0, |figures| figures.area_m2);
    let largest = ranked
        .iter()
        .max_by(|a, b| area(a).total_cmp(&area(b)))
        .unwrap();
    assert_eq!((largest.l_ae, largest.l_ab), (2.0, 0.0));
}

#[test]
fn the_share_of_the_rectangle_is_known_to_a_per_cent_at_a_fiftieth_of_the_reach() {
    // The 3-brake workspace by hand: from θA = 180°, θB = 170° to its mirror image, and from θA = 180°, θB = 10° up to arms
    // symmetric about the y axis at 10°. A grid cuts the tips of its cusps off.
    let device = Device::layout(Layout::ThreeBrake);
    let width_m = 2.0 * 0.305 * (1.0 + libm::cos(rad(10.0)));
    let (highest_m, lowest_m) = (
        2.0 * 0.305 * libm::cos(rad(5.0)),
        0.305 * libm::sin(rad(10.0)),
    );
    let exact = three_brake_area_m2() / (width_m * (highest_m - lowest_m));
    for step_m in [0.0117, 0.0083, 0.0041] {
        let fill = workspace::boundary(&device, step_m).unwrap().fill();
        println!("{step_m} m: fills {fill:.5}, by hand {exact:.5}");
        assert!((fill / exact - 1.0).abs() < 1e-2, "{fill} {exact}");
    }
}
