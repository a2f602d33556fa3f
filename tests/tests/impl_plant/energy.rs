//! This file says that the plant's brakes never drive it, that no energy comes from nowhere and that what is held stands.

use rigproof_impl::plant::friction::Contact;
use rigproof_impl::plant::{Outcome, Plant, Scheme};
use rigproof_impl::vector::Vector;
use rigproof_model::rig::Rig;
use rigproof_spec::laws::dissipation;
use rigproof_spec::layout::Layout;

use crate::impl_plant::rigs::{Draw, LAYOUTS, middle_m, plant_of};

const STEP_S: f64 = 1e-3;

fn start(layout: Layout) -> Plant {
    plant_of(
        &Rig::new(layout, middle_m(layout)).unwrap(),
        Scheme::Midpoint,
    )
}

fn no_current_without_brake(layout: Layout, mut currents_a: [f64; 4]) -> [f64; 4] {
    if layout == Layout::ThreeBrake {
        currents_a[3] = 0.0;
    }
    currents_a
}

#[test]
fn brakes_take_power_in_every_sample_and_energy_in_the_whole() {
    for layout in LAYOUTS {
        let mut draw = Draw::new(271);
        let mut plant = start(layout);
        let middle_m = plant.tip_m();
        let (mut work_j, mut currents_a, mut push_n) = (0.0, [0.0; 4], Vector::zero());
        let (mut held, mut slipping, mut least_j) = (0, 0, f64::INFINITY);
        let mut worst_w = f64::INFINITY;
        let (mut least_held_w, mut least_slipping_w) = (f64::INFINITY, f64::INFINITY);
        for _ in 0..200_000 {
            if draw.one_in(40) {
                currents_a = [0.0; 4].map(|_: f64| libm::pow(draw.between(0.0, 1.0), 3.0));
                push_n = Vector::new(draw.between(-17.0, 17.0), draw.between(-17.0, 17.0));
            }
            let off_m = plant.tip_m() - middle_m;
            let force_n = push_n - off_m * 430.0;
            let from_m = plant.tip_m();
            let before_j = plant.kinetic_energy_j();
            let currents_a = no_current_without_brake(layout, currents_a);
            assert_eq!(
                plant.step(force_n.into(), currents_a, STEP_S),
                Outcome::Moved
            );
            work_j += force_n.dot(plant.tip_m() - from_m);
            let brakes = plant
                .brake_torques_nm()
                .into_iter()
                .zip(rates_rad_s(&plant));
            for ((torque_nm, rate), held) in brakes.zip(plant.stuck()) {
                let taken_w = dissipation(torque_nm, rate).0;
                if held {
                    // A held joint's rate is zero at the end that the step foresees.
                    least_held_w = least_held_w.min(taken_w);
                } else {
                    least_slipping_w = least_slipping_w.min(taken_w);
                }
            }
            // What the step took, by the tip's way and the kinetic energy.
            let took_j =
                force_n.dot(plant.tip_m() - from_m) - (plant.kinetic_energy_j() - before_j);
            worst_w = worst_w.min(took_j / STEP_S);
            least_j = f64::min(least_j, work_j - plant.kinetic_energy_j());
            match plant.contact() {
                Contact::Slipping(_) => slipping += 1,
                _ => held += 1,
            }
        }
        println!(
            "{layout:?}: {held} steps held, {slipping} slipping; {work_j:.1} J done, least balance {least_j:.1e} J, \
             least power taken {worst_w:.1e} W"
        );
        println!("least taken: {least_slipping_w:.1e} W slipping, {least_held_w:.1e} W held");
        assert!(held > 20_000 && slipping > 20_000, "{held} {slipping}");
        assert!(least_slipping_w >= 0.0, "{least_slipping_w:e} W");
        assert!(least_held_w > -1e-4, "{least_held_w:e} W");
        // The tip's way in a step differs from the scheme's by the third power of the step.
        assert!(least_j > -1e-4, "{least_j:e} J");
        assert!(worst_w > -0.05, "{worst_w:e} W");
    }
}

#[test]
fn what_locked_brakes_hold_does_not_creep_in_a_minute() {
    for layout in LAYOUTS {
        let mut plant = start(layout);
        let currents_a = no_current_without_brake(layout, [0.93; 4]);
        for _ in 0..300 {
            assert_eq!(plant.step([0.0; 2], currents_a, STEP_S), Outcome::Moved);
        }
        // Out of the backlash first: it is pushed until its brakes hold it.
        for _ in 0..3000 {
            assert_eq!(plant.step([5.6, -3.7], currents_a, STEP_S), Outcome::Moved);
        }
        let (tip_m, angles_rad) = (plant.tip_m(), plant.joint_angles_rad());
        let mut load_n = 0.0_f64;
        for k in 0..60_000_u32 {
            let part = libm::sin(1e-3 * f64::from(k) * 5.3);
            let force_n = [4.7 + 0.9 * part, -2.9 + 0.7 * part];
            load_n = load_n.max(libm::hypot(force_n[0], force_n[1]));
            assert_eq!(plant.step(force_n, currents_a, STEP_S), Outcome::Moved);
            assert_eq!(plant.contact(), Contact::Rest);
        }
        assert!(load_n > 5.0);
        assert_eq!(plant.tip_m(), tip_m);
        assert_eq!(plant.joint_angles_rad(), angles_rad);
    }
}

#[test]
fn a_step_that_cannot_be_taken_changes_nothing() {
    let mut plant = start(Layout::FourBrake);
    for _ in 0..50 {
        plant.step([7.0, 3.0], [0.1, 0.2, 0.3, 0.4], STEP_S);
    }
    let before = plant;
    for (force_n, currents_a, step_s) in [
        ([f64::NAN, 1.3], [0.1; 4], STEP_S),
        ([1.3, f64::INFINITY], [0.1; 4], STEP_S),
        ([1.3, 2.1], [0.1, 1.01, 0.1, 0.1], STEP_S),
        ([1.3, 2.1], [0.1, 0.1, f64::NAN, 0.1], STEP_S),
        ([1.3, 2.1], [0.1, 0.1, -0.01, 0.1], STEP_S),
        ([1.3, 2.1], [0.1; 4], 0.0),
        ([1.3, 2.1], [0.1; 4], -STEP_S),
        ([1.3, 2.1], [0.1; 4], 0.011),
        ([1.3, 2.1], [0.1; 4], f64::NAN),
    ] {
        assert_eq!(plant.step(force_n, currents_a, step_s), Outcome::Undefined);
        assert_eq!(plant, before);
    }
    assert_eq!(plant.step([-9e5, 7e5], [0.1; 4], 0.01), Outcome::TooFast);
    assert_eq!(plant, before);
    // Pulled out of its reach it stops at its last sound place.
    let mut outcome = Outcome::Moved;
    let mut last = plant;
    for _ in 0..20_000 {
        last = plant;
        outcome = plant.step([0.0, 41.0], [0.0; 4], STEP_S);
        if outcome != Outcome::Moved {
            break;
        }
    }
    assert_ne!(outcome, Outcome::Moved);
    assert_eq!(plant, last);
    assert!(plant.linkage().is_sound(plant.shape()));
}

/// The rates of the joints from those of the base alone, without what the plant knows of its brakes, rad/s.
fn rates_rad_s(plant: &Plant) -> [f64; 4] {
    let [a, b] = plant.base_rates_rad_s();
    let [ed, cd] = plant
        .linkage()
        .turning()
        .map(|row| row.dot(Vector::new(a, b)));
    [a, ed - a, b, cd - b]
}
