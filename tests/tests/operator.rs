//! This file says what the five methods of table 6.1 do in a closed loop: under the constant push of §6.4 and under a
//! simulated operator.

use std::sync::LazyLock;

use rigproof_model::ModelError;
use rigproof_model::control::path::Line;
use rigproof_model::control::{
    Actuation, Controller, GainUnit, Impedance, Obstacle, Optimal, Proportional, Sdof, Side,
    Uncontrolled, VelocityRatio, Virtual, Weights, controller, tip_mass,
};
use rigproof_model::linkage::Pose;
use rigproof_model::operator::{Abilities, ConstantPush, Hand, Operator};
use rigproof_model::rig::{Parameters, Rig};
use rigproof_model::trial::{LINES, Metrics, Record, Segment, run, trial};
use rigproof_spec::laws::{brake_count, braked_joints, current_limit};
use rigproof_spec::layout::Layout;
use rigproof_spec::methods::{Method, SAMPLE_STEP_S};

const LAYOUTS: [Layout; 2] = [Layout::ThreeBrake, Layout::FourBrake];
const SEEDS: u64 = 15;

/// §6.4: line y = 38 cm, started 4 cm below it, pushed with 7 N along and 3 N towards it. Where along it the run starts
/// is not said; here from x = -15 cm to 15 cm.
fn proof_of_concept(layout: Layout, method: Method, unit: GainUnit) -> Record {
    let line = Line::through([-0.3, 0.38], [0.3, 0.38]).unwrap();
    let mut controller = controller(method, unit, Actuation::thesis(layout), line).unwrap();
    let mut rig = Rig::new(layout, [-0.15, 0.34]).unwrap();
    let mut push = ConstantPush([7.0, 3.0]);
    let record = run(&mut rig, &mut *controller, &mut push, 6.0, |[x, _]| {
        x > 0.15
    })
    .unwrap();
    assert!(record.arrived, "{layout:?} {method:?} did not arrive");
    let balance_j = rig.work_j() - rig.kinetic_energy_j() - rig.dissipated_j();
    assert!(
        balance_j.abs() < 1e-6 * rig.work_j(),
        "{balance_j} J appear"
    );
    record
}

/// Average distance from the line y = 38 cm over the last third of the run, when the path has been reached, m.
fn settled_error_m(record: &Record) -> f64 {
    let late = record.tips_m.iter().filter(|[x, _]| *x > 0.05);
    let errors: Vec<f64> = late.map(|[_, y]| (y - 0.38).abs()).collect();
    errors.iter().sum::<f64>() / errors.len() as f64
}

fn switches(record: &Record) -> usize {
    let next = record.commands.iter().skip(1);
    let pairs = record.commands.iter().zip(next);
    pairs.filter(|(a, b)| a.reason != b.reason).count()
}

#[test]
fn proportional_control_is_more_accurate_than_sdof_and_switches_more() {
    for layout in LAYOUTS {
        let sdof = proof_of_concept(layout, Method::Sdof, GainUnit::PerMetre);
        let proportional = proof_of_concept(layout, Method::ProportionalHigh, GainUnit::PerMetre);
        let (theirs_m, ours_m) = (settled_error_m(&sdof), settled_error_m(&proportional));
        println!("{layout:?}: SDOF {theirs_m} m, proportional {ours_m} m");
        assert!(
            ours_m < 0.25 * theirs_m,
            "{layout:?}: {ours_m} m against {theirs_m} m"
        );
        assert!(switches(&proportional) > 5 * switches(&sdof));
    }
}

#[test]
fn four_brakes_have_slightly_less_path_error_under_a_constant_push() {
    let line = Line::through([-0.3, 0.38], [0.3, 0.38]).unwrap();
    for method in [Method::Sdof, Method::ProportionalHigh] {
        let [three_m, four_m] = LAYOUTS.map(|layout| {
            let record = proof_of_concept(layout, method, GainUnit::PerMetre);
            record.metrics(&line).unwrap().path_error_m
        });
        println!("{method:?}: 3-brake {three_m} m, 4-brake {four_m} m");
        assert!(four_m < three_m && four_m > 0.5 * three_m, "{method:?}");
    }
}

#[test]
fn a_low_gain_of_5_newton_seconds_a_metre_does_not_hold_the_path() {
    let line = Line::through([-0.3, 0.38], [0.3, 0.38]).unwrap();
    for layout in LAYOUTS {
        let error_m = |method, unit| {
            let record = proof_of_concept(layout, method, unit);
            record.metrics(&line).unwrap().path_error_m
        };
        let none_m = error_m(Method::Uncontrolled, GainUnit::PerMetre);
        let printed_m = error_m(Method::ProportionalLow, GainUnit::PerMetre);
        let meant_m = error_m(Method::ProportionalLow, GainUnit::PerCentimetre);
        let high_m = error_m(Method::ProportionalHigh, GainUnit::PerMetre);
        println!(
            "{layout:?}: none {none_m} m, 5 N·s/m {printed_m} m, 5 N·s/cm {meant_m} m, high {high_m} m"
        );
        assert!(printed_m > 0.8 * none_m, "{layout:?}");
        // "A significant reduction in workload … with little change in accuracy" (§6.6).
        assert!((meant_m / high_m - 1.0).abs() < 0.05, "{layout:?}");
    }
}

/// Medians over the seeds, by layout, line and method.
static MEDIANS: LazyLock<Vec<(Layout, usize, Method, Metrics)>> = LazyLock::new(|| {
    let groups: Vec<(Layout, usize)> = LAYOUTS
        .into_iter()
        .flat_map(|layout| [(layout, 0), (layout, 1)])
        .collect();
    std::thread::scope(|scope| {
        let running: Vec<_> = groups
            .into_iter()
            .map(|(layout, line)| {
                scope.spawn(move || {
                    Method::ALL.map(|method| {
                        (
                            layout,
                            line,
                            method,
                            median_of(layout, method, line, Abilities::CAREFUL, SEEDS),
                        )
                    })
                })
            })
            .collect();
        running
            .into_iter()
            .flat_map(|thread| thread.join().unwrap())
            .collect()
    })
});

fn medians(layout: Layout, line: usize, method: Method) -> Metrics {
    let same = |entry: &&(Layout, usize, Method, Metrics)| {
        (entry.0, entry.1, entry.2) == (layout, line, method)
    };
    MEDIANS.iter().find(same).unwrap().3
}

fn median_of(
    layout: Layout,
    method: Method,
    line: usize,
    abilities: Abilities,
    seeds: u64,
) -> Metrics {
    let segment = LINES[line];
    let path = Line::through(segment.from_m, segment.to_m).unwrap();
    let all: Vec<Metrics> = (0..seeds)
        .map(|seed| {
            let (seed, unit) = (7919 * seed + 13, GainUnit::PerCentimetre);
            let record = trial(layout, method, unit, segment, abilities, seed).unwrap();
            assert!(
                record.arrived,
                "{layout:?} {method:?} {seed} did not arrive"
            );
            for command in &record.commands {
                assert!(brake_count(command, 1).holds() && braked_joints(layout, command).holds());
                assert!(
                    command
                        .currents_a
                        .iter()
                        .all(|current_a| current_limit(*current_a).holds())
                );
            }
            record.metrics(&path).unwrap()
        })
        .collect();
    let median = |quantity: fn(&Metrics) -> f64| {
        let mut values: Vec<f64> = all.iter().map(quantity).collect();
        values.sort_by(f64::total_cmp);
        values[values.len() / 2]
    };
    Metrics {
        path_error_m: median(|metrics| metrics.path_error_m),
        tip_force_n: median(|metrics| metrics.tip_force_n),
        dft_sum_m_s3: median(|metrics| metrics.dft_sum_m_s3),
    }
}

#[test]
fn a_simulated_operator_orders_the_five_methods_as_people_did() {
    for layout in LAYOUTS {
        for line in [0, 1] {
            let [none, sdof, gap, low, high] =
                Method::ALL.map(|method| medians(layout, line, method));
            for (name, m) in [
                ("N", none),
                ("S", sdof),
                ("G", gap),
                ("H", high),
                ("L", low),
            ] {
                println!(
                    "{layout:?} line {} {name}: {:.3} cm {:.2} N {:.3e} m/s³",
                    line + 1,
                    m.path_error_m * 100.0,
                    m.tip_force_n,
                    m.dft_sum_m_s3
                );
            }
            // "Both controllers reduced path error significantly, regardless of the gain used."
            for controlled in [sdof, gap, low, high] {
                assert!(controlled.path_error_m < 0.65 * none.path_error_m);
            }
            // "Adding an uncontrolled gap … increased smoothness and decreased workload"; lowering the gain the workload.
            assert!(gap.tip_force_n < sdof.tip_force_n && gap.dft_sum_m_s3 < sdof.dft_sum_m_s3);
            assert!(low.tip_force_n < 0.75 * high.tip_force_n);
            // "Similar levels of workload … to the uncontrolled experiment."
            assert!(low.tip_force_n < 1.4 * none.tip_force_n);
            // "Overall the proportional controller exhibited … higher levels of smoothness than the SDOF controller."
            assert!(high.dft_sum_m_s3 < sdof.dft_sum_m_s3 && low.dft_sum_m_s3 < gap.dft_sum_m_s3);
        }
    }
}

#[test]
fn what_holds_for_one_operator_holds_for_a_slower_eye_and_a_softer_hand() {
    let careful = Abilities::CAREFUL;
    let slow_eye = Abilities {
        delay_s: 0.22,
        ..careful
    };
    let soft = Abilities {
        correction_n_per_m: 35.0,
        damping_n_s_per_m: 14.0,
        ..careful
    };
    for abilities in [slow_eye, soft] {
        for layout in LAYOUTS {
            let of = |method| median_of(layout, method, 1, abilities, 5);
            let [none, sdof, gap, low, high] = Method::ALL.map(of);
            for controlled in [sdof, gap, low, high] {
                assert!(controlled.path_error_m < none.path_error_m);
            }
            assert!(gap.tip_force_n < sdof.tip_force_n && gap.dft_sum_m_s3 < sdof.dft_sum_m_s3);
            assert!(low.tip_force_n < high.tip_force_n && high.dft_sum_m_s3 < sdof.dft_sum_m_s3);
        }
    }
}

#[test]
fn the_low_gain_is_as_smooth_as_no_control_but_on_line_2_of_three_brakes() {
    // What does not come out there: no brake may help, and then every brake locks for a moment.
    for (layout, line, range) in [
        (Layout::FourBrake, 0, 0.8..1.5),
        (Layout::FourBrake, 1, 0.8..1.5),
        (Layout::ThreeBrake, 0, 0.8..1.5),
        (Layout::ThreeBrake, 1, 1.5..3.0),
    ] {
        let of = |method| medians(layout, line, method).dft_sum_m_s3;
        let ratio = of(Method::ProportionalLow) / of(Method::Uncontrolled);
        println!("{layout:?} line {}: {ratio}", line + 1);
        assert!(range.contains(&ratio), "{layout:?} {line}: {ratio}");
    }
}

#[test]
fn the_gap_costs_a_simulated_operator_more_than_people() {
    // People lost nothing (0.24 cm in the mean of tables C with and without); here the gap of 0.5 cm fills with the
    // aim's error. On four brakes it stays rougher than the high gain, where people found it smoother.
    for layout in LAYOUTS {
        for line in [0, 1] {
            let of = |method| medians(layout, line, method);
            let (gap, sdof, high) = (
                of(Method::SdofWithGap),
                of(Method::Sdof),
                of(Method::ProportionalHigh),
            );
            assert!(gap.path_error_m > 2.5 * sdof.path_error_m);
            println!(
                "{layout:?} line {}: {}",
                line + 1,
                gap.dft_sum_m_s3 / high.dft_sum_m_s3
            );
        }
    }
}

/// The controllers of chapter 2 and of §7.3 on a line, each with settings of its own.
fn others(layout: Layout, line: Line) -> Vec<(&'static str, Box<dyn Controller>)> {
    let actuation = Actuation::thesis(layout);
    let elements = Virtual {
        stiffness_n_per_m: 3000.0,
        damping_across_n_s_per_m: 300.0,
        damping_along_n_s_per_m: 100.0,
    };
    let weights = Weights {
        angle: 1.0,
        energy: 0.01,
        horizon_s: 0.03,
    };
    let inertia = move |pose: &Pose| tip_mass(&Parameters::of(layout), pose);
    vec![
        (
            "velocity ratio",
            Box::new(VelocityRatio::new(actuation, line, 0.05, 30.0).unwrap()),
        ),
        (
            "optimal",
            Box::new(Optimal::new(actuation, line, 0.05, weights, inertia).unwrap()),
        ),
        (
            "impedance",
            Box::new(Impedance::new(actuation, line, elements).unwrap()),
        ),
    ]
}

#[test]
fn the_controllers_of_chapter_2_lead_a_simulated_operator_closer_to_the_path() {
    for layout in LAYOUTS {
        let segment = LINES[1];
        let line = Line::through(segment.from_m, segment.to_m).unwrap();
        let none_m = medians(layout, 1, Method::Uncontrolled).path_error_m;
        for (name, mut controller) in others(layout, line) {
            let mut errors_m = Vec::new();
            for seed in 0..5 {
                let mut operator =
                    Operator::new(line, Abilities::CAREFUL, 7919 * seed + 13).unwrap();
                let mut rig = Rig::new(layout, segment.from_m).unwrap();
                let past = |[x, y]: [f64; 2]| 0.17 * (x - 0.09) + 0.14 * (y - 0.43) >= 0.0;
                let record = run(&mut rig, &mut *controller, &mut operator, 20.0, past).unwrap();
                assert!(record.arrived, "{layout:?} {name} did not arrive");
                for command in &record.commands {
                    assert!(
                        brake_count(command, 2).holds() && braked_joints(layout, command).holds()
                    );
                }
                let balance_j = rig.work_j() - rig.kinetic_energy_j() - rig.dissipated_j();
                assert!(
                    balance_j.abs() < 1e-6 * rig.work_j(),
                    "{balance_j} J appear"
                );
                errors_m.push(record.metrics(&line).unwrap().path_error_m);
            }
            errors_m.sort_by(f64::total_cmp);
            println!(
                "{layout:?} {name}: {} m, uncontrolled {none_m} m",
                errors_m[2]
            );
            assert!(
                errors_m[2] < 0.8 * none_m,
                "{layout:?} {name}: {} m",
                errors_m[2]
            );
        }
    }
}

#[test]
fn an_obstacle_is_entered_by_millimetres_where_an_open_rig_goes_through() {
    // A wall y = 0.39 m, solid above; pushed along it with 4 N and into it with 3 N from 3 cm below.
    let wall = Line::through([-0.3, 0.39], [0.3, 0.39]).unwrap();
    for layout in LAYOUTS {
        let depth_m = |controller: &mut dyn Controller| {
            let mut rig = Rig::new(layout, [-0.12, 0.36]).unwrap();
            let mut push = ConstantPush([4.0, 3.0]);
            let record = run(&mut rig, controller, &mut push, 3.0, |[x, _]| x > 0.12).unwrap();
            record
                .tips_m
                .iter()
                .map(|[_, y]| y - 0.39)
                .fold(f64::NEG_INFINITY, f64::max)
        };
        let actuation = Actuation::thesis(layout);
        let sdof = Sdof::new(actuation, wall, 0.05, 0.0).unwrap();
        let proportional = Proportional::new(actuation, wall, 0.05, 10_000.0).unwrap();
        let through_m = depth_m(&mut Uncontrolled);
        let with_sdof_m = depth_m(&mut Obstacle::new(wall, Side::Left, sdof));
        let with_proportional_m = depth_m(&mut Obstacle::new(wall, Side::Left, proportional));
        println!(
            "{layout:?}: open {through_m} m, SDOF {with_sdof_m} m, proportional {with_proportional_m} m"
        );
        assert!(with_sdof_m < 0.012 && with_proportional_m < 0.012 && through_m > 0.02);
    }
}

#[test]
fn tip_mass_carries_the_kinetic_energy_of_the_rig() {
    for layout in LAYOUTS {
        let parameters = Parameters::of(layout);
        let rig = Rig::moving(parameters, [2.1, 1.13], [0.37, -0.53]).unwrap();
        let [x, y] = rig.tip_velocity_m_s();
        let mass = tip_mass(&parameters, rig.pose()).unwrap();
        let energy_j = 0.5 * (mass.m11 * x * x + 2.0 * mass.m12 * x * y + mass.m22 * y * y);
        assert!(
            (energy_j / rig.kinetic_energy_j() - 1.0).abs() < 1e-12,
            "{mass}"
        );
    }
}

#[test]
fn a_seed_makes_one_operator() {
    let of = |seed| {
        let (gap, unit) = (Method::SdofWithGap, GainUnit::PerCentimetre);
        trial(
            Layout::FourBrake,
            gap,
            unit,
            LINES[1],
            Abilities::CAREFUL,
            seed,
        )
        .unwrap()
    };
    let (first, again, other) = (of(41), of(41), of(42));
    assert_eq!(first, again);
    assert!(first.tips_m != other.tips_m);
}

#[test]
fn an_operator_sees_late_trembles_between_8_and_12_hertz_and_pushes_with_bounded_force() {
    let line = Line::through(LINES[0].from_m, LINES[0].to_m).unwrap();
    let abilities = Abilities {
        tremor_n: 0.0,
        aim_error_m: 0.0,
        ..Abilities::CAREFUL
    };
    let start = LINES[0].from_m;
    let mut calm = Operator::new(line, abilities, 3).unwrap();
    let mut pushed = Operator::new(line, abilities, 3).unwrap();
    // One tip jumps off the path by 3 cm: nothing changes until 160 ms later.
    let away = [start[0], start[1] + 0.03];
    let mut first = None;
    for tick in 0..600 {
        let still = calm.push(start, [0.0; 2], SAMPLE_STEP_S);
        let jumped = pushed.push(
            if tick < 100 { start } else { away },
            [0.0; 2],
            SAMPLE_STEP_S,
        );
        if first.is_none() && still != jumped {
            first = Some(tick);
        }
    }
    assert_eq!(first, Some(100 + 160));
    // A tip that cannot move: the force grows to its bound and no further.
    let mut stuck = Operator::new(line, Abilities::CAREFUL, 3).unwrap();
    let mut greatest_n: f64 = 0.0;
    let mut forces_n = Vec::new();
    for _ in 0..16_000 {
        let [x, y] = stuck.push(start, [0.0; 2], SAMPLE_STEP_S);
        greatest_n = greatest_n.max(libm::hypot(x, y));
        forces_n.push(y);
    }
    assert!(
        greatest_n > 19.0 && greatest_n <= 20.0 * (1.0 + 1e-12),
        "{greatest_n} N"
    );
    // Across the path the slow aim and the tremor are apart: count how much lies in the band of the tremor.
    let spectrum = rigproof_model::metrics::dft_magnitudes(&forces_n[..4000]);
    let power = |from: usize, to: usize| spectrum[from..to].iter().map(|a| a * a).sum::<f64>();
    // 4 s of record: 0.25 Hz a line.
    let (slow, tremor, rest) = (power(1, 20), power(31, 50), power(56, 2000));
    assert!(slow > rest && tremor > 5.0 * rest, "{slow} {tremor} {rest}");
}

#[test]
fn abilities_out_of_range_are_named() {
    let line = Line::through(LINES[0].from_m, LINES[0].to_m).unwrap();
    for (abilities, expected) in [
        (
            Abilities {
                delay_s: -0.1,
                ..Abilities::CAREFUL
            },
            "the delay is -0.1 s; it must lie between 0 s and 1 s",
        ),
        (
            Abilities {
                tremor_n: f64::NAN,
                ..Abilities::CAREFUL
            },
            "the tremor is NaN N; it must lie between 0 N and 1000000 N",
        ),
    ] {
        let error = Operator::new(line, abilities, 3).unwrap_err();
        assert_eq!(error.to_string(), expected);
    }
    let nowhere = Segment {
        from_m: [0.01, 0.38],
        to_m: [0.01, 0.38],
    };
    let (method, unit) = (Method::Sdof, GainUnit::PerMetre);
    let error = trial(
        Layout::FourBrake,
        method,
        unit,
        nowhere,
        Abilities::CAREFUL,
        3,
    )
    .unwrap_err();
    assert!(matches!(error, ModelError::PathPiece { .. }));
}
