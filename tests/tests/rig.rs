//! This file says what holds for the rig in every run: its brakes only take, its energy is accounted for, its linkage stays closed.

use proptest::prelude::*;
use rigproof_model::brake::Brake;
use rigproof_model::error::ModelError;
use rigproof_model::linkage::Pair;
use rigproof_model::linkage::singularity::measure;
use rigproof_model::motion::constraints::constraints;
use rigproof_model::motion::coordinates::coordinates;
use rigproof_model::rig::release::Release;
use rigproof_model::rig::{Parameters, Rig};
use rigproof_spec::geometry::{Arms, arms};
use rigproof_spec::inertia::{ArmInertia, Inertia, inertia};
use rigproof_spec::joint::Joint;
use rigproof_spec::laws::{dissipation, torque_limit, yield_limit};
use rigproof_spec::layout::Layout;
use rigproof_tests::cases;

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
        let yield_nm = rig.yield_torques_nm()[i];
        assert!(
            torques[i].abs() <= yield_nm * (1.0 + 1e-9),
            "{} N·m",
            torques[i]
        );
        assert!(
            rig.brake(joint).is_none() || yield_limit(joint, yield_nm).holds(),
            "{yield_nm} N·m"
        );
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
    #![proptest_config(ProptestConfig { cases: cases(200), failure_persistence: None, ..ProptestConfig::default() })]

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
fn a_rate_that_rounding_puts_back_is_passed_all_the_same() {
    // Found by the property above: while brake E holds, θ̇A passes 4 rpm, where the time constant of brake A changes its form,
    // and taking the last bits of E's rate away puts it back below.
    let [x, y] = middle_m(Layout::FourBrake);
    let start_m = [x + 0.048_784_602_336_851_12, y - 0.024_170_208_328_378_982];
    let mut rig = Rig::new(Layout::FourBrake, start_m).unwrap();
    for (force_n, currents_a, steps) in [
        (
            [-21.263_571_794_570_773, -14.845_988_422_371_025],
            [0.0, 0.339_600_327_830_738_96, 0.0, 1.0],
            37,
        ),
        (
            [1.988_979_717_878_971_7, 10.978_400_711_782_156],
            [0.0, 1.0, 0.391_189_924_890_892_9, 1.0],
            15,
        ),
        (
            [17.712_759_586_943_346, -25.950_690_929_828_92],
            [0.0, 0.721_465_731_545_583_8, 0.475_810_888_382_587_7, 1.0],
            27,
        ),
    ] {
        let force = confined(force_n, middle_m(Layout::FourBrake));
        for _ in 0..steps {
            rig.step_under(&force, currents_a, 0.001_675_487_055_616_519_4)
                .unwrap();
            assert_passive(&rig);
        }
    }
    assert!(rig.events() < 100, "{} changes", rig.events());
}

/// A rig of other lengths and masses, moving; every third has its base joints on one axis, where E and C are parallel.
fn other_rig() -> impl Strategy<Value = Rig> {
    let lengths = prop::array::uniform5(0.17..0.43_f64);
    let masses = prop::array::uniform4((0.3..5.1_f64, 0.004..0.09_f64, 0.02..0.23_f64));
    let start = (
        layout(),
        [1.4..2.3, 0.7..1.6_f64],
        [-2.9..2.9, -2.9..2.9_f64],
    );
    (lengths, masses, start, 0_u8..3, 0.0..1.3_f64).prop_filter_map(
        "the arms do not meet",
        |(lengths, masses, (layout, theta_rad, rates_rad_s), kind, payload_kg)| {
            let [l_ae_m, l_ed_m, l_bc_m, l_cd_m, l_ab_m] = lengths;
            let mut arms = Arms {
                l_ae_m,
                l_ed_m,
                l_bc_m,
                l_cd_m,
                l_ab_m,
            };
            if kind == 0 {
                arms = Arms {
                    l_ae_m,
                    l_ed_m,
                    l_bc_m: l_ed_m,
                    l_cd_m: l_ae_m,
                    l_ab_m: 0.0,
                };
            }
            let [ae, ed, bc, cd] = masses.map(|(mass_kg, inertia_kg_m2, centre_m)| ArmInertia {
                mass_kg,
                inertia_kg_m2,
                centre_m,
            });
            let inertia = Inertia {
                ae,
                ed,
                bc,
                cd,
                payload_kg,
            };
            let parameters = Parameters {
                layout,
                arms,
                inertia,
            };
            Rig::moving(parameters, theta_rad, rates_rad_s).ok()
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig { cases: cases(200), failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_rig_pushed_anywhere_stays_passive_until_it_cannot_close(
        rig in other_rig(), history in prop::collection::vec(stretch(), 1..9),
    ) {
        let mut rig = rig.with_longest_step_s(0.25e-3).unwrap();
        let started_j = rig.kinetic_energy_j();
        for stretch in history {
            let mut currents_a = stretch.currents_a;
            if rig.parameters().layout == Layout::ThreeBrake {
                currents_a[3] = 0.0;
            }
            for _ in 0..stretch.steps {
                match rig.step(stretch.force_n, currents_a, 1e-3) {
                    Ok(()) => assert_passive(&rig),
                    Err(ModelError::Singular { .. } | ModelError::CannotClose { .. }) => return Ok(()),
                    Err(error) => panic!("{error}"),
                }
                let balance_j = started_j + rig.work_j() - rig.kinetic_energy_j() - rig.dissipated_j();
                let passed_j = started_j + rig.dissipated_j() + rig.work_j().abs();
                // Towards a singularity a joint's rate grows without bound and no step is small.
                let clear = Pair::ALL.iter().map(|pair| measure(rig.pose(), *pair)).fold(1.0, f64::min);
                if clear < 0.3 {
                    return Ok(());
                }
                prop_assert!(balance_j.abs() <= 1e-6 * passed_j, "{balance_j} of {passed_j} J, {clear} clear");
            }
        }
    }
}

/// Currents that switch brakes on and off at their own times, now and then all together.
fn switching_a(layout: Layout, time_s: f64) -> [f64; 4] {
    let pulse = |rate: f64, shift: f64| {
        let wave = libm::sin(rate * time_s + shift);
        let all = libm::sin(0.9 * time_s) > 0.87;
        if all || wave > 0.6 {
            0.37 * (1.0 + libm::sin(3.0 * rate * time_s))
        } else {
            0.0
        }
    };
    let last = if layout == Layout::FourBrake {
        pulse(6.1, 0.7)
    } else {
        0.0
    };
    [pulse(5.3, 0.1), pulse(3.9, 1.3), pulse(7.7, 2.1), last]
}

#[test]
fn energy_is_accounted_for_over_a_minute_and_the_linkage_stays_closed() {
    for layout in [Layout::ThreeBrake, Layout::FourBrake] {
        let mut rig = Rig::new(layout, middle_m(layout)).unwrap();
        let (arms, inertia) = (arms(layout), inertia(layout));
        let mut held = [0_u32; 5];
        let (mut worst_j, mut open_m) = (0.0_f64, 0.0_f64);
        for step in 0..60_000_u32 {
            let t = f64::from(step) * 1e-3;
            let push = [
                17.0 * libm::sin(1.7 * t) + 11.0 * libm::sin(7.1 * t),
                19.0 * libm::cos(2.3 * t),
            ];
            let force = confined(push, middle_m(layout));
            rig.step_under(&force, switching_a(layout, t), 1e-3)
                .unwrap();
            assert_passive(&rig);
            held[rig.stuck().iter().filter(|held| **held).count()] += 1;
            let balance_j = rig.work_j() - rig.kinetic_energy_j() - rig.dissipated_j();
            worst_j = worst_j.max(balance_j.abs());
            let q = coordinates(&arms, &inertia, rig.pose());
            open_m = open_m.max(constraints(&arms, &inertia, &q).amax());
        }
        println!(
            "{layout:?}: {} events; steps with 0 to 4 brakes held {held:?}; work {} J, of which {worst_j:e} J unaccounted; open by {open_m:e} m",
            rig.events(),
            rig.work_j()
        );
        // The run must contain what it claims to test: motion, one held brake, standstill, and many changes.
        let standstill = held[layout.brakes().len()];
        assert!(held[0] > 10_000 && held[1] > 1000 && standstill > 100 && rig.events() > 1000);
        assert!(worst_j < 1e-6 * rig.dissipated_j(), "{worst_j:e} J");
        assert!(open_m < 1e-9, "{open_m:e} m");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_course_is_the_brakes_own_step(
        joint in prop::sample::select(Joint::ALL.to_vec()), omega_rad_s in -5.3..5.3_f64,
        currents_a in prop::collection::vec(0.0..1.0_f64, 1..30), step_s in 0.0003..0.02_f64,
    ) {
        let (mut whole, mut followed) = (Brake::new(joint, 0.371), Brake::new(joint, 0.371));
        let mut theta_rad = 0.371;
        for current_a in currents_a {
            theta_rad += omega_rad_s * step_s;
            // The whole step sees the backlash at its end, the course at its beginning.
            let course = followed.course(current_a, omega_rad_s);
            let changes = followed.backlash().is_inside();
            followed.follow(&course, step_s * course.rate_per_s(omega_rad_s), theta_rad);
            whole.step(current_a, theta_rad, omega_rad_s, step_s);
            if changes != followed.backlash().is_inside() {
                followed = whole;
            }
            prop_assert!((whole.yield_torque() - followed.yield_torque()).abs() < 1e-13);
        }
    }
}

#[test]
fn a_held_joint_does_not_creep() {
    // Brake E holds from the end of its backlash on while the tip swings about A, which is not a coordinate's own axis.
    let run = Release::of(Layout::FourBrake, Some(Joint::E))
        .run()
        .unwrap();
    let held: Vec<f64> = run
        .iter()
        .skip_while(|sample| !sample.stuck[1] || sample.time_s < 0.3)
        .map(|sample| sample.joint_angles_rad[1])
        .collect();
    assert!(held.len() > 100);
    let creep_rad = held
        .iter()
        .fold(0.0, |most: f64, angle| most.max((angle - held[0]).abs()));
    println!("{creep_rad:e} rad over {} ms", held.len());
    assert!(creep_rad < 1e-9, "{creep_rad:e} rad");
}

#[test]
fn bad_input_is_a_named_error_and_moves_nothing() {
    let mut rig = Rig::new(Layout::ThreeBrake, [0.031, 0.402]).unwrap();
    rig.step([2.3, -3.9], [0.1, 0.2, 0.3, 0.0], 0.013).unwrap();
    let before = rig.clone();
    for (force_n, currents_a, step_s, says) in [
        ([f64::NAN, 1.3], [0.1; 3], 1e-3, "force on the tip is NaN N"),
        (
            [2.1, f64::INFINITY],
            [0.1; 3],
            1e-3,
            "force on the tip is inf N",
        ),
        (
            [2.1, 1.3],
            [0.1, 1.07, 0.1],
            1e-3,
            "the current of brake E is 1.07 A; it must be between 0 A and 1 A",
        ),
        (
            [2.1, 1.3],
            [-0.003, 0.1, 0.1],
            1e-3,
            "the current of brake A is -0.003 A",
        ),
        (
            [2.1, 1.3],
            [0.1, 0.1, f64::NAN],
            1e-3,
            "the current of brake B is NaN A",
        ),
        (
            [2.1, 1.3],
            [0.1; 3],
            0.0,
            "the step is 0 s; it must be above 0 s and at most 60 s",
        ),
        ([2.1, 1.3], [0.1; 3], f64::NAN, "the step is NaN s"),
        ([2.1, 1.3], [0.1; 3], 71.0, "the step is 71 s"),
    ] {
        let [a, e, b] = currents_a;
        let error = rig.step(force_n, [a, e, b, 0.0], step_s).unwrap_err();
        assert!(error.to_string().contains(says), "{error}");
        assert_eq!(rig, before);
    }
    let error = rig
        .step([2.1, 1.3], [0.1, 0.1, 0.1, 0.2], 1e-3)
        .unwrap_err();
    assert!(
        error.to_string().contains("joint C carries no brake"),
        "{error}"
    );
}

#[test]
fn a_rig_that_cannot_be_is_a_named_error() {
    let error = Rig::new(Layout::FourBrake, [0.037, 0.93]).unwrap_err();
    assert!(matches!(error, ModelError::Unreachable { .. }), "{error}");
    let moving = |change: &dyn Fn(&mut Parameters), rates_rad_s| {
        let mut parameters = Parameters::of(Layout::FourBrake);
        change(&mut parameters);
        Rig::moving(parameters, [1.9, 1.1], rates_rad_s)
            .unwrap_err()
            .to_string()
    };
    let negative = moving(&|p| p.inertia.ed.mass_kg = -2.74, [0.1, 0.2]);
    assert!(
        negative.contains("m_ED of arm ED is -2.74 kg"),
        "{negative}"
    );
    let negative = moving(&|p| p.inertia.payload_kg = -0.3, [0.1, 0.2]);
    assert!(negative.contains("m_D of the tip is -0.3 kg"), "{negative}");
    let nan = moving(&|p| p.inertia.bc.inertia_kg_m2 = f64::NAN, [0.1, 0.2]);
    assert!(nan.contains("I_BC of arm BC is NaN kg·m²"), "{nan}");
    let nan = moving(&|p| p.inertia.cd.centre_m = f64::NAN, [0.1, 0.2]);
    assert!(nan.contains("centre of mass"), "{nan}");
    let nan = moving(&|_| {}, [f64::NAN, 0.2]);
    assert!(nan.contains("rate of a base joint is NaN rad/s"), "{nan}");
}

#[test]
fn a_rig_pushed_out_of_its_assembly_stops_with_an_error() {
    for layout in [Layout::ThreeBrake, Layout::FourBrake] {
        let mut rig = Rig::new(layout, middle_m(layout)).unwrap();
        let (error, before) = loop {
            let before = rig.clone();
            if let Err(error) = rig.step([1.7, 53.0], [0.0; 4], 1e-3) {
                break (error, before);
            }
            assert!(rig.time_s() < 3.0);
        };
        let named = matches!(
            error,
            ModelError::Singular { .. } | ModelError::CannotClose { .. }
        );
        assert!(named, "{error}");
        assert_eq!(rig, before);
    }
}
