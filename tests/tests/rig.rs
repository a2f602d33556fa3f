//! This file says what holds for the rig in every run: its brakes only take, its energy is accounted for, its linkage stays closed.

use proptest::prelude::*;
use rigproof_model::rig::Rig;
use rigproof_spec::joint::Joint;
use rigproof_spec::laws::{dissipation, torque_limit};
use rigproof_spec::layout::Layout;

/// Force and currents that hold for a while.
#[derive(Clone, Copy, Debug)]
struct Stretch {
    force_n: [f64; 2],
    currents_a: [f64; 4],
    steps: u32,
}

fn layout() -> impl Strategy<Value = Layout> {
    prop::sample::select(vec![Layout::ThreeBrake, Layout::FourBrake])
}

fn current_a() -> impl Strategy<Value = f64> {
    prop_oneof![Just(0.0), 0.003..0.997_f64, Just(1.0)]
}

fn stretch() -> impl Strategy<Value = Stretch> {
    let force_n = [-31.0..31.0, -31.0..31.0_f64];
    let currents_a = [current_a(), current_a(), current_a(), current_a()];
    (force_n, currents_a, 1_u32..60).prop_map(|(force_n, currents_a, steps)| Stretch {
        force_n,
        currents_a,
        steps,
    })
}

/// A spring and a damper that keep the tip in the middle of the workspace, beside the force of a stretch.
fn confined(force_n: [f64; 2], middle_m: [f64; 2]) -> impl Fn([f64; 2], [f64; 2]) -> [f64; 2] {
    move |[x, y], [v_x, v_y]| {
        let [f_x, f_y] = force_n;
        let [m_x, m_y] = middle_m;
        [
            f_x - 310.0 * (x - m_x) - 3.1 * v_x,
            f_y - 310.0 * (y - m_y) - 3.1 * v_y,
        ]
    }
}

fn middle_m(layout: Layout) -> [f64; 2] {
    match layout {
        Layout::ThreeBrake => [0.013, 0.417],
        Layout::FourBrake => [0.017, 0.389],
    }
}

fn assert_passive(rig: &Rig) {
    let (torques, rates) = (rig.brake_torques_nm(), rig.joint_rates_rad_s());
    for (i, joint) in Joint::ALL.into_iter().enumerate() {
        let power = dissipation(torques[i], rates[i]);
        assert!(
            power.holds(),
            "brake {}: {} N·m at {} rad/s",
            joint.letter(),
            torques[i],
            rates[i]
        );
        // A held brake may carry its bound and the 1e-10 that rounding is allowed.
        let within = torque_limit(joint, torques[i] / (1.0 + 1e-9));
        assert!(
            within.holds(),
            "brake {}: {} N·m",
            joint.letter(),
            torques[i]
        );
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn brake_power_is_never_positive_in_any_sample(
        layout in layout(), shift in [-0.07..0.07, -0.07..0.07_f64],
        history in prop::collection::vec(stretch(), 1..17), step_s in 0.0003..0.0017_f64,
    ) {
        let [x, y] = middle_m(layout);
        let mut rig = Rig::new(layout, [x + shift[0], y + shift[1]]).unwrap();
        let mut dissipated_j = 0.0;
        for stretch in history {
            let mut currents_a = stretch.currents_a;
            if layout == Layout::ThreeBrake {
                currents_a[3] = 0.0;
            }
            let force = confined(stretch.force_n, middle_m(layout));
            for _ in 0..stretch.steps {
                rig.step_under(&force, currents_a, step_s).unwrap();
                assert_passive(&rig);
                prop_assert!(rig.dissipated_j() >= dissipated_j - 1e-15, "{} J back", dissipated_j - rig.dissipated_j());
                dissipated_j = rig.dissipated_j();
            }
        }
        let balance_j = rig.work_j() - rig.kinetic_energy_j() - rig.dissipated_j();
        prop_assert!(balance_j.abs() <= 1e-6 * rig.dissipated_j().max(1e-3), "{balance_j} of {} J", rig.dissipated_j());
    }
}

#[test]
fn probe() {
    for layout in [Layout::ThreeBrake, Layout::FourBrake] {
        let mut rig = Rig::new(layout, middle_m(layout)).unwrap();
        let start = std::time::Instant::now();
        let mut stuck = [0; 5];
        let mut worst: f64 = 0.0;
        for k in 0..60_000_u32 {
            let t = f64::from(k) * 1e-3;
            let f = [
                17.0 * libm::sin(1.7 * t) + 11.0 * libm::sin(7.1 * t),
                19.0 * libm::cos(2.3 * t),
            ];
            let c = |p: f64, q: f64| {
                if libm::sin(p * t + q) > 0.6 {
                    0.37 * (1.0 + libm::sin(3.0 * p * t))
                } else {
                    0.0
                }
            };
            let mut currents = [c(5.3, 0.1), c(3.9, 1.3), c(7.7, 2.1), c(6.1, 0.7)];
            if layout == Layout::ThreeBrake {
                currents[3] = 0.0;
            }
            rig.step_under(&confined(f, middle_m(layout)), currents, 1e-3)
                .unwrap();
            stuck[rig.stuck().iter().filter(|s| **s).count()] += 1;
            let balance = rig.work_j() - rig.kinetic_energy_j() - rig.dissipated_j();
            worst = worst.max(balance.abs());
        }
        println!(
            "{layout:?} {:?} stuck {stuck:?} work {} worst {worst:e} dissip {}",
            start.elapsed(),
            rig.work_j(),
            rig.dissipated_j()
        );
    }
}
