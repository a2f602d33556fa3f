//! This file says with which order the two schemes near the reference, with brakes switching, sticking and slipping.

use rigproof_impl::plant::Scheme;
use rigproof_model::rig::{Parameters, Rig};
use rigproof_spec::geometry::arms;
use rigproof_spec::inertia::{Inertia, inertia};
use rigproof_spec::layout::Layout;

use crate::impl_plant::rigs::{LAYOUTS, advance, apart_rad, middle_m, plant_of};

/// Time for which force and currents hold, s: longer than the longest step.
const HELD_S: f64 = 8e-3;
const STEPS_S: [f64; 5] = [2e-3, 1e-3, 0.5e-3, 0.25e-3, 0.125e-3];

/// The force while the rig turns around the middle of the workspace, N, held.
fn force_n(k: usize) -> [f64; 2] {
    let time_s = HELD_S * k as f64;
    let (slow, fast) = (
        2.0 * core::f64::consts::PI * 1.3,
        2.0 * core::f64::consts::PI * 2.9,
    );
    [
        17.0 * libm::sin(slow * time_s + 0.4) + 7.0 * libm::sin(fast * time_s),
        -13.0 * libm::cos(slow * time_s) + 9.0 * libm::sin(fast * time_s + 1.1),
    ]
}

fn currents_a(layout: Layout, k: usize, switching: bool) -> [f64; 4] {
    let mut currents_a = [0.0; 4];
    if switching {
        currents_a = [0.11, 0.07, 0.13, 0.09];
        currents_a[(k / 5) % 4] = 0.83;
    }
    if layout == Layout::ThreeBrake {
        currents_a[3] = 0.0;
    }
    currents_a
}

/// The worst difference of an angle over 0.56 s, looked at every 8 ms, rad.
fn error_rad(
    layout: Layout,
    switching: bool,
    scheme: Scheme,
    step_s: f64,
    reference: &[Rig],
) -> f64 {
    let mut plant = plant_of(&reference[0], scheme);
    let mut worst = 0.0_f64;
    for (k, rig) in reference.iter().skip(1).enumerate() {
        let currents_a = currents_a(layout, k, switching);
        advance(&mut plant, force_n(k), currents_a, HELD_S, step_s);
        worst = worst.max(apart_rad(&plant, rig));
    }
    worst
}

fn reference(layout: Layout, switching: bool) -> Vec<Rig> {
    let [x, y] = middle_m(layout);
    let rig = Rig::new(layout, [x + 0.061, y - 0.023]).unwrap();
    run(rig, layout, switching)
}

fn run(rig: Rig, layout: Layout, switching: bool) -> Vec<Rig> {
    let mut rig = rig.with_longest_step_s(0.0625e-3).unwrap();
    let mut rigs = vec![rig.clone()];
    for k in 0..70 {
        rig.step(force_n(k), currents_a(layout, k, switching), HELD_S)
            .unwrap();
        rigs.push(rig.clone());
    }
    rigs
}

#[test]
fn error_falls_with_the_square_of_the_step_also_through_stick_and_slip() {
    for layout in LAYOUTS {
        for switching in [false, true] {
            let rigs = reference(layout, switching);
            let events = rigs.last().unwrap().events();
            println!(
                "{layout:?}, switching {switching}, {events} events: worst angle, rad, at 2, 1, 0.5, 0.25, 0.125 ms"
            );
            assert!(events >= 15);
            let [midpoint, euler] = [Scheme::Midpoint, Scheme::SemiImplicitEuler].map(|scheme| {
                let errors =
                    STEPS_S.map(|step_s| error_rad(layout, switching, scheme, step_s, &rigs));
                let words = errors.map(|error| format!("{error:.1e}"));
                println!("  {scheme:?}: {}", words.join("  "));
                errors
            });
            // Over a factor of 16 in the step: order 2 is 256, order 1 is 16.
            let [falls, euler_falls] = [midpoint, euler].map(|errors| errors[0] / errors[4]);
            if switching {
                assert!(falls > 30.0, "{falls}");
            } else {
                assert!((200.0..330.0).contains(&falls), "{falls}");
            }
            assert!((10.0..30.0).contains(&euler_falls), "{euler_falls}");
            assert!(
                midpoint[1] < 6e-5 && midpoint[1] < 0.06 * euler[1],
                "{midpoint:?} {euler:?}"
            );
        }
    }
}

#[test]
fn brakes_on_parallel_joints_hold_and_slip_as_in_the_reference() {
    // Four brakes on the three-brake arms, whose joints E and C turn alike, with a payload.
    let three = Layout::ThreeBrake;
    let parameters = Parameters {
        layout: Layout::FourBrake,
        arms: arms(three),
        inertia: Inertia {
            payload_kg: 0.37,
            ..inertia(three)
        },
    };
    let angles = Rig::new(three, middle_m(three)).unwrap().base_angles_rad();
    let rig = Rig::moving(parameters, angles, [0.0; 2]).unwrap();
    let rigs = run(rig, Layout::FourBrake, true);
    let both = rigs
        .iter()
        .filter(|rig| rig.stuck()[1] && rig.stuck()[3])
        .count();
    assert!(both > 1, "{both}");
    let errors =
        STEPS_S.map(|step_s| error_rad(Layout::FourBrake, true, Scheme::Midpoint, step_s, &rigs));
    println!("{both} of {} with E and C held: {errors:?}", rigs.len());
    assert!(
        errors[1] < 1e-4 && errors[0] / errors[4] > 30.0,
        "{errors:?}"
    );
}
