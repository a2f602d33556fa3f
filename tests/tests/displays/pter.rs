//! This file says that PTER only takes energy, keeps to the local path of a locked clutch, and when its friction sticks and slips.

use nalgebra::Vector2;
use proptest::prelude::*;
use rigproof_model::displays::{Aim, Display, Pter};
use rigproof_model::linkage::device::Concept;
use rigproof_spec::displays::{ClutchFigures, PTER_CLUTCH};
use rigproof_spec::laws::{dissipation, local_path, power_balance};
use rigproof_spec::methods::SAMPLE_STEP_S;
use rigproof_tests::cases;

use super::hands::hand;

proptest! {
    #![proptest_config(ProptestConfig { cases: cases(300), ..ProptestConfig::default() })]

    //= thesis section 1.1 test
    #[test]
    fn pter_takes_energy_from_every_hand(hand in hand()) {
        let mut display = Pter::new().at(hand.tip_m).unwrap();
        let (mut worst, mut taken_j) = (f64::INFINITY, 0.0);
        // What went to and fro between hand and links: a hand may take back what it gave.
        let (mut last_j, mut gross_j) = (0.0, 0.0);
        hand.moves(&mut display, |plant| {
            let resisted = plant.resisted();
            for (load_nm, rate_rad_s) in resisted.loads.into_iter().zip(resisted.rates) {
                let margin = dissipation(load_nm, rate_rad_s);
                worst = worst.min(if margin.0.is_nan() { f64::NEG_INFINITY } else { margin.0 });
                taken_j -= load_nm * rate_rad_s * 1e-4;
            }
            gross_j += (plant.kinetic_energy_j() - last_j).abs();
            last_j = plant.kinetic_energy_j();
        });
        prop_assert!(worst >= 0.0, "{worst} W");
        // What the clutches took is what the hand gave and the links do not have, to what a step of 0.1 ms loses.
        let plant = display.plant();
        let (work_j, kinetic_j) = (plant.work_j(), plant.kinetic_energy_j());
        let slack_j = 0.005 * (gross_j + taken_j) + 1e-4;
        prop_assert!(power_balance(work_j, kinetic_j, taken_j, slack_j).holds(), "{work_j} {kinetic_j} {taken_j}");
    }

    //= thesis section 1.1 test
    //= thesis section 2.2.2 test
    #[test]
    fn a_locked_clutch_leaves_pter_one_local_path(hand in hand(), clutch in 0_usize..4) {
        let mut display = Pter::new().with_locked(clutch).at(hand.tip_m).unwrap();
        lock(&mut display);
        // The linkage's own Jacobian says where the path of the clutch runs.
        let device = Concept::ScaledPter.device();
        for push in &hand.pushes_n {
            for _ in 0..20 {
                let push = push.map(|n| 0.3 * n);
                let before = display.plant().place().tip_m;
                if display.tick(&Aim::Free, push, SAMPLE_STEP_S, |_| {}).is_err() {
                    return Ok(());
                }
                let velocity = display.plant().tip_velocity_m_s();
                let now = display.plant().place().tip_m;
                let held = display.plant().resisted().held[clutch];
                if let Ok(rows) = device.tip_forces(now) {
                    let row = rows[clutch];
                    // Held in the last step; its motion turned the row by what the tip moved in a step.
                    if held {
                        prop_assert!(local_path(row, velocity, 1e-9).holds(), "{row:?} {velocity:?}");
                    }
                    let moved = Vector2::from(now) - Vector2::from(before);
                    let off = Vector2::from(row).dot(&moved).abs();
                    prop_assert!(!held || off <= 0.02 * Vector2::from(row).norm() * moved.norm() + 1e-9);
                }
            }
        }
    }
}

/// Time for a clutch to close.
fn lock(display: &mut Display) {
    for _ in 0..400 {
        display
            .tick(&Aim::Free, [0.0; 2], SAMPLE_STEP_S, |_| {})
            .unwrap();
    }
}

//= thesis section 2.2.2 test
#[test]
fn the_four_clutches_of_pter_stop_a_link_or_couple_the_two() {
    let mut seen = [[0.0; 2]; 4];
    for (clutch, rates) in seen.iter_mut().enumerate() {
        let mut display = Pter::new().with_locked(clutch).at([0.037, 0.353]).unwrap();
        lock(&mut display);
        for _ in 0..120 {
            display
                .tick(&Aim::Free, [3.3, 2.1], SAMPLE_STEP_S, |_| {})
                .unwrap();
        }
        assert!(display.plant().resisted().held[clutch]);
        *rates = display.plant().rates();
    }
    let near = |one: f64, other: f64| (one - other).abs() < 1e-12;
    let [link_a, link_b, direct, reverse] = seen;
    println!("rates of links A and B, rad/s: {seen:?}");
    assert!(near(link_a[0], 0.0) && link_a[1].abs() > 0.01);
    assert!(near(link_b[1], 0.0) && link_b[0].abs() > 0.01);
    assert!(near(direct[0], direct[1]) && direct[0].abs() > 0.01);
    assert!(near(reverse[0], -reverse[1]) && reverse[0].abs() > 0.01);
}

/// How often the tip stands still and sets off again while a soft spring drags it slowly against clutches of these figures.
fn stops(figures: ClutchFigures) -> u32 {
    // Clutch 1 alone, at its full torque, on a link that a spring turns.
    let mut display = Pter::with_clutches(figures)
        .with_locked(0)
        .at([0.037, 0.353])
        .unwrap();
    lock(&mut display);
    let start = Vector2::from(display.plant().place().tip_m);
    let (mut stops, mut moving) = (0, false);
    for k in 0..6000_u32 {
        // Its end moves at 8 mm/s, so that clutch 1 slips more slowly than its torque takes to become kinetic.
        let end = start + Vector2::new(-0.008, 0.0) * (SAMPLE_STEP_S * f64::from(k));
        let pull = (end - Vector2::from(display.plant().place().tip_m)) * 900.0;
        let drag = Vector2::from(display.plant().tip_velocity_m_s()) * -4.0;
        if display
            .tick(&Aim::Free, (pull + drag).into(), SAMPLE_STEP_S, |_| {})
            .is_err()
        {
            break;
        }
        let rate = display.plant().rates()[0].abs();
        if moving && rate < 1e-6 {
            (stops, moving) = (stops + 1, false);
        } else if rate > 0.02 {
            moving = true;
        }
    }
    stops
}

#[test]
fn friction_that_rises_with_slip_does_not_stick_and_slip() {
    let of = |kinetic_over_static| {
        stops(ClutchFigures {
            kinetic_over_static,
            static_nm: 2.3,
            ..PTER_CLUTCH
        })
    };
    let (printed, exchanged) = (of(1.2), of(1.0 / 1.2));
    println!("stops: kinetic above static {printed}, static above kinetic {exchanged}");
    assert_eq!(printed, 0, "as printed");
    assert!(exchanged > 3, "exchanged: {exchanged}");
}
