//! This file says with which order the rig's integrator converges, also through stick and slip, and why backlash needs an entry travel.

use rigproof_model::rig::Rig;
use rigproof_spec::layout::Layout;
use rigproof_spec::units::RAD_PER_DEG;

fn middle_m(layout: Layout) -> [f64; 2] {
    match layout {
        Layout::ThreeBrake => [0.013, 0.417],
        Layout::FourBrake => [0.017, 0.389],
    }
}

/// A spring to the middle of the workspace that also drives around it.
fn swirl(layout: Layout) -> impl Fn([f64; 2], [f64; 2]) -> [f64; 2] {
    let [m_x, m_y] = middle_m(layout);
    move |[x, y], [v_x, v_y]| {
        let (d_x, d_y) = (x - m_x, y - m_y);
        [
            -310.0 * d_x - 170.0 * d_y - 3.1 * v_x,
            -310.0 * d_y + 170.0 * d_x - 3.1 * v_y,
        ]
    }
}

fn start(layout: Layout, longest_step_s: f64) -> Rig {
    let [m_x, m_y] = middle_m(layout);
    let rig = Rig::new(layout, [m_x + 0.061, m_y - 0.023]).unwrap();
    rig.with_longest_step_s(longest_step_s).unwrap()
}

/// Runs 0.48 s; `switching` currents stop and release brakes every 40 ms.
fn study(layout: Layout, longest_step_s: f64, switching: bool) -> Rig {
    let mut rig = start(layout, longest_step_s);
    for k in 0..60_usize {
        let mut currents_a = [0.0; 4];
        if switching {
            currents_a = [0.31, 0.17, 0.23, 0.29];
            currents_a[(k / 5) % 4] = 0.83;
        }
        if layout == Layout::ThreeBrake {
            currents_a[3] = 0.0;
        }
        rig.step_under(&swirl(layout), currents_a, 8e-3).unwrap();
    }
    rig
}

fn apart_rad(one: &Rig, other: &Rig) -> f64 {
    let (one, other) = (one.joint_angles_rad(), other.joint_angles_rad());
    one.iter()
        .zip(other)
        .fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()))
}

#[test]
fn error_falls_sixteenfold_at_half_the_step_also_through_stick_and_slip() {
    for (layout, switching, least_events) in [
        (Layout::ThreeBrake, false, 10),
        (Layout::ThreeBrake, true, 30),
        (Layout::FourBrake, false, 20),
        (Layout::FourBrake, true, 40),
    ] {
        let exact = study(layout, 0.0625e-3, switching);
        assert!(exact.events() >= least_events);
        let errors = [4e-3, 2e-3, 1e-3, 0.5e-3, 0.25e-3].map(|h| {
            let rig = study(layout, h, switching);
            (apart_rad(&rig, &exact), rig.events())
        });
        println!(
            "{layout:?}, switching {switching}: (error in rad, events) at 4, 2, 1, 0.5, 0.25 ms: {errors:?}"
        );
        let [_, _, at_1, at_half, at_quarter] = errors.map(|(error, _)| error);
        assert!(at_1 < 1e-8, "{at_1:e} rad at 1 ms");
        for ratio in [at_1 / at_half, at_half / at_quarter] {
            assert!((11.0..23.0).contains(&ratio), "{ratio}");
        }
    }
}

/// The rig after 2 s in which it is stopped and let go again, with a backlash that is entered after `entry_deg`.
fn backlash_study(layout: Layout, entry_deg: f64, longest_step_s: f64) -> Rig {
    let mut rig = start(layout, longest_step_s).with_backlash_entry_deg(entry_deg);
    for k in 0..2000_usize {
        let mut currents_a = [0.31, 0.17, 0.23, 0.29];
        currents_a[(k / 53) % 4] = 0.83;
        if k % 400 > 290 {
            currents_a = [0.97; 4];
        }
        if layout == Layout::ThreeBrake {
            currents_a[3] = 0.0;
        }
        rig.step_under(&swirl(layout), currents_a, 1e-3).unwrap();
    }
    rig
}

#[test]
fn without_an_entry_travel_the_backlash_has_no_limit() {
    for layout in [Layout::ThreeBrake, Layout::FourBrake] {
        for entry_deg in [0.0, 0.005, 0.02, 0.1] {
            let finest = backlash_study(layout, entry_deg, 0.125e-3);
            let apart_deg = [1e-3, 0.5e-3, 0.25e-3]
                .map(|h| apart_rad(&backlash_study(layout, entry_deg, h), &finest) / RAD_PER_DEG);
            println!(
                "{layout:?}, entry after {entry_deg}°: at 1, 0.5, 0.25 ms {apart_deg:?}° from 0.125 ms"
            );
            let [coarse, _, fine] = apart_deg;
            if entry_deg > 0.0 {
                assert!(coarse < 1e-6 && fine < 2e-8, "{apart_deg:?}");
            } else {
                // Each held joint enters by its last bit: a shorter step changes the answer, not its error.
                assert!(apart_deg.iter().any(|apart| *apart > 5e-4), "{apart_deg:?}");
            }
        }
    }
}
