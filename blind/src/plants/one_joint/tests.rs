//! This file claims what holds for every plant and every law of the room.

use super::size::block_noise;
use super::*;
use crate::element::{Element, Instant, sliding_resistance};
use crate::form::Stage;
use crate::make::{make, secret};
use crate::size::{CLEAR_DISTINCTNESS, CLEAR_SIZE, FAINT_STRENGTH};
use proptest::prelude::*;
use std::collections::BTreeMap;
use std::sync::OnceLock;

type Hidden = Secret<Setup, Run>;

/// One case a law and plant, so that a claim about laws speaks of all of them; made once for all claims.
fn one_case_a_law(plant: Plant) -> &'static BTreeMap<&'static str, Hidden> {
    static AXIS: OnceLock<BTreeMap<&'static str, Hidden>> = OnceLock::new();
    static BENCH: OnceLock<BTreeMap<&'static str, Hidden>> = OnceLock::new();
    match plant {
        Plant::Axis => AXIS.get_or_init(|| drawn_until_all(plant, 21)),
        _ => BENCH.get_or_init(|| drawn_until_all(plant, 19)),
    }
}

fn drawn_until_all(plant: Plant, laws: usize) -> BTreeMap<&'static str, Hidden> {
    let mut cases = BTreeMap::new();
    let mut seed = 0;
    while cases.len() < laws {
        assert!(seed < 200, "{:?} are all of 200 seeds", cases.keys());
        for stratum in [Stratum::Single, Stratum::NotInLibrary] {
            let secret = secret(&OneJoint(plant, Forms::Usual), seed, stratum).unwrap();
            cases.entry(secret.drawn.hidden[0].name()).or_insert(secret);
        }
        seed += 1;
    }
    cases
}

fn root_mean_square(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0.0), |(sum, count), x| (sum + x * x, count + 1.0));
    (sum / count).sqrt()
}

/// Halving the fine step moves the position by less than 1e-4 of the travel (measured: 5e-5 at most) and the metered
/// effort by less than a fifth of its noise (measured: 0.15 at most, at the edges of a backlash window), root mean square.
#[test]
fn the_fine_step_is_fine_enough_for_every_law() {
    const { assert!(FINE_STEPS >= 10) };
    for plant in [Plant::Axis, Plant::Bench] {
        for (name, case) in one_case_a_law(plant) {
            let finer = simulate(&case.drawn, 2 * FINE_STEPS);
            let (change, resolution, budget) = match plant {
                Plant::Axis => (
                    difference(&case.run.shown_position, &finer.shown_position),
                    case.drawn.setup.scale.travel,
                    1e-4,
                ),
                _ => (
                    difference(&case.run.shown_effort, &finer.shown_effort),
                    case.drawn.setup.noise,
                    0.2,
                ),
            };
            let share = change / resolution;
            assert!(share < budget, "{} {name}: {share:.2e}", plant.name());
        }
    }
}

fn difference(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    root_mean_square(a.iter().zip(b).map(|(x, y)| x - y))
}

/// The bookkeeping of hidden forces closes the equation of motion, checked by differentiating the motion.
#[test]
fn on_the_axis_the_hidden_force_is_what_the_nominal_equation_lacks() {
    for (name, case) in one_case_a_law(Plant::Axis) {
        let Kind::Axis(drive) = &case.drawn.setup.kind else {
            panic!("an axis case has a drive");
        };
        if *name == "channel_skew" {
            continue;
        }
        let run = &case.run;
        let step_s = run.time_s[1] - run.time_s[0];
        let mut lacking = Vec::new();
        let mut hidden = Vec::new();
        for k in 1..run.time_s.len() - 1 {
            let window = k - 1..=k + 1;
            let same_way = run.velocity[window.clone()].iter().all(|v| *v > 0.0)
                || run.velocity[window].iter().all(|v| *v < 0.0);
            if !same_way {
                continue;
            }
            let acceleration = (run.velocity[k + 1] - run.velocity[k - 1]) / (2.0 * step_s);
            let v = run.velocity[k];
            let nominal = drive.gain * run.shown_input[k] - known_resistance(&case.drawn.known, v);
            let sign = if case.drawn.hidden[0].stage() == Stage::Drive {
                -1.0
            } else {
                1.0
            };
            lacking.push(nominal - drive.inertia * acceleration);
            hidden.push(sign * run.hidden[0][k]);
        }
        let mut rest: Vec<f64> = lacking
            .iter()
            .zip(&hidden)
            .map(|(a, b)| (a - b).abs())
            .collect();
        rest.sort_by(f64::total_cmp);
        let scale = root_mean_square(hidden.into_iter());
        let quantile = |q: f64| rest[(q * rest.len() as f64) as usize] / scale;
        // What is left is the error of the central difference, largest where friction jumps.
        assert!(quantile(0.5) < 0.03, "{name}: {}", quantile(0.5));
        assert!(quantile(0.95) < 0.15, "{name}: {}", quantile(0.95));
    }
}

/// Resistance of the laws a nominal model may know, written out once more.
fn known_resistance(known: &[Effect], velocity: f64) -> f64 {
    known
        .iter()
        .map(|law| match law.form {
            Form::Viscous => law.first() * velocity,
            Form::Coulomb => law.first() * velocity.signum(),
            Form::Bias => law.first(),
            _ => panic!("{} is never nominal", law.name()),
        })
        .sum()
}

#[test]
fn on_the_bench_the_hidden_force_is_what_the_effect_adds() {
    for (name, case) in one_case_a_law(Plant::Bench) {
        let without = Drawn {
            hidden: Vec::new(),
            ..case.drawn.clone()
        };
        let without = simulate(&without, FINE_STEPS);
        let with = &case.run;
        let added = with.shown_effort.iter().zip(&without.shown_effort);
        let worst = added
            .zip(&with.hidden[0])
            .map(|((with, without), hidden)| (with - without - hidden).abs())
            .fold(0.0, f64::max);
        let late_position =
            case.drawn.hidden[0].form == Form::Skew && case.drawn.hidden[0].first() < 0.0;
        if !late_position {
            assert!(
                worst < 1e-9 * case.drawn.setup.scale.effort,
                "{name}: {worst}"
            );
        }
    }
}

#[test]
fn sizes_are_what_the_strata_say() {
    for plant in [Plant::Axis, Plant::Bench] {
        for seed in 1000..1008 {
            for stratum in [Stratum::Single, Stratum::Masked, Stratum::LateOnset] {
                for size in secret(&OneJoint(plant, Forms::Usual), seed, stratum)
                    .unwrap()
                    .sizes
                    .sizes
                {
                    assert!(size.size >= CLEAR_SIZE && size.distinctness >= CLEAR_DISTINCTNESS);
                }
            }
            let faint = secret(&OneJoint(plant, Forms::Usual), seed, Stratum::TooSmall).unwrap();
            let [size] = faint.sizes.sizes[..] else {
                panic!("one effect is hidden");
            };
            assert!(
                size.strength <= FAINT_STRENGTH && size.strength > 0.02,
                "{size:?}"
            );
        }
    }
}

/// The unit of every size is the scatter that 80 ms of recorded noise really have.
#[test]
fn block_noise_is_the_scatter_of_80_ms_averages() {
    let case = secret(&OneJoint(Plant::Bench, Forms::Usual), 5, Stratum::Nothing).unwrap();
    let mut draw = Draw::new(Plant::Bench, 5, "scatter");
    let count = (0.08 * case.drawn.setup.rate_hz) as usize;
    let averages = (0..4000).map(|_| {
        (0..count)
            .map(|_| draw.normal(case.drawn.setup.noise))
            .sum::<f64>()
            / count as f64
    });
    let scatter = root_mean_square(averages);
    assert!((scatter / block_noise(&case.drawn.setup) - 1.0).abs() < 0.04);

    let case = secret(&OneJoint(Plant::Axis, Forms::Usual), 5, Stratum::Nothing).unwrap();
    let Kind::Axis(drive) = &case.drawn.setup.kind else {
        panic!("an axis case has a drive");
    };
    let count = (0.08 * case.drawn.setup.rate_hz) as usize;
    let mut draw = Draw::new(Plant::Axis, 5, "scatter");
    let efforts = (0..4000).map(|_| {
        let half = case.drawn.setup.quantum / 2.0;
        let positions: Vec<f64> = (0..count).map(|_| draw.uniform(-half, half)).collect();
        let command: f64 = (0..count)
            .map(|_| draw.normal(case.drawn.setup.noise))
            .sum();
        drive.inertia * parabola_acceleration(&positions, 1.0 / case.drawn.setup.rate_hz)
            - drive.gain * command / count as f64
    });
    let scatter = root_mean_square(efforts);
    let stated = block_noise(&case.drawn.setup);
    assert!((scatter / stated - 1.0).abs() < 0.08, "{scatter} {stated}");
}

/// Second derivative of the least-squares parabola through evenly spaced values.
fn parabola_acceleration(values: &[f64], step_s: f64) -> f64 {
    let n = values.len() as f64;
    let weight = |k: usize| {
        let x = k as f64 - 0.5 * (n - 1.0);
        x * x - (n * n - 1.0) / 12.0
    };
    let norm: f64 = (0..values.len()).map(|k| weight(k) * weight(k)).sum();
    let moment: f64 = values.iter().enumerate().map(|(k, x)| weight(k) * x).sum();
    2.0 * moment / norm / (step_s * step_s)
}

/// With nothing hidden, the recorded channels alone balance: work put in is work dissipated plus kinetic energy.
#[test]
fn a_case_with_nothing_hidden_balances_its_energy() {
    for seed in 0..12 {
        let secret = secret(&OneJoint(Plant::Axis, Forms::Usual), seed, Stratum::Nothing).unwrap();
        let trace = make(Plant::Axis, seed, Some(Stratum::Nothing))
            .unwrap()
            .trace;
        let Kind::Axis(drive) = &secret.drawn.setup.kind else {
            panic!("an axis case has a drive");
        };
        let position = &trace.channel("position").unwrap().samples;
        let command = &trace.channel("command").unwrap().samples;
        let step_s = 1.0 / secret.drawn.setup.rate_hz;
        let stride = (0.01 / step_s) as usize;
        let (mut put_in, mut turned_over, mut dissipated) = (0.0, 0.0, 0.0);
        for k in (0..position.len() - stride).step_by(stride) {
            let travel = position[k + stride] - position[k];
            let mean_v: f64 = command[k..k + stride].iter().sum::<f64>() / stride as f64;
            let velocity = travel / (stride as f64 * step_s);
            put_in += drive.gain * mean_v * travel;
            turned_over += (drive.gain * mean_v * travel).abs();
            if travel != 0.0 {
                dissipated += known_resistance(&secret.drawn.known, velocity) * travel;
            }
        }
        let end = *secret.run.velocity.last().unwrap();
        let kinetic = 0.5 * drive.inertia * end * end;
        let error = (put_in - dissipated - kinetic).abs() / turned_over;
        assert!(error < 0.02, "seed {seed}: {error}");
    }
}

/// With nothing hidden on a damper, torque minus the nominal law is the stated noise.
#[test]
fn a_damper_with_nothing_hidden_leaves_only_noise() {
    let mut seen = 0;
    for seed in 0..16 {
        let secret = secret(
            &OneJoint(Plant::Bench, Forms::Usual),
            seed,
            Stratum::Nothing,
        )
        .unwrap();
        if secret.drawn.setup.brake().is_some() {
            continue;
        }
        seen += 1;
        let trace = make(Plant::Bench, seed, Some(Stratum::Nothing))
            .unwrap()
            .trace;
        let effort = &trace.channels[1].samples;
        let rest = effort
            .iter()
            .zip(&secret.run.velocity)
            .filter(|(_, v)| **v != 0.0)
            .map(|(effort, v)| effort - known_resistance(&secret.drawn.known, *v));
        let ratio = root_mean_square(rest) / secret.drawn.setup.noise;
        assert!((ratio - 1.0).abs() < 0.03, "seed {seed}: {ratio}");
    }
    assert!(seen >= 4);
}

#[test]
fn brakes_and_dry_friction_never_drive_the_bench() {
    for seed in 0..12 {
        for stratum in [Stratum::Nothing, Stratum::Single, Stratum::NotInLibrary] {
            let case = secret(&OneJoint(Plant::Bench, Forms::Usual), seed, stratum).unwrap();
            let passive = case
                .drawn
                .known
                .iter()
                .chain(&case.drawn.hidden)
                .all(|law| {
                    matches!(
                        law.form,
                        Form::Coulomb
                            | Form::Viscous
                            | Form::Stribeck
                            | Form::Asymmetric
                            | Form::Lag
                            | Form::Gain
                            | Form::Square
                            | Form::WorkFade
                            | Form::Overshoot
                            | Form::Play
                            | Form::Backlash
                    )
                });
            if passive {
                let Run {
                    velocity,
                    shown_effort,
                    ..
                } = &case.run;
                for (v, effort) in velocity.iter().zip(shown_effort) {
                    assert!(v * effort >= 0.0, "{v} rad/s, {effort} N·m");
                }
            }
        }
    }
}

proptest! {
    /// A bristle may give back what it stored, never more: a closed cycle costs energy.
    #[test]
    fn a_closed_cycle_of_hysteresis_costs_energy(
        level in 0.03..2.0_f64,
        travel in 0.003..0.4_f64,
        ratio in -0.8..0.8_f64,
        amplitude in 0.02..1.3_f64,
        bristle: bool,
    ) {
        let law = if bristle {
            Form::Dahl.of([level, travel])
        } else {
            Form::BoucWen.of([level / travel, 1.0 / travel, ratio / travel])
        };
        let mut elements = [Element::new(law)];
        let steps = 20_000;
        let mut work_j = [0.0; 3];
        let mut position = 0.0;
        for k in 0..3 * steps {
            let angle = std::f64::consts::TAU * f64::from(k + 1) / f64::from(steps);
            let next = amplitude * libm::sin(angle);
            let moved = next - position;
            let at = Instant {
                time_s: 0.0,
                position,
                velocity: moved,
                direction: moved.signum(),
                load: 0.0,
                brake: 0.0,
            };
            work_j[(k / steps) as usize] += sliding_resistance(&elements, &at, 0.5 * moved, 0.0) * moved;
            elements[0].advance(&at, moved, 0.0);
            position = next;
        }
        // The first cycle loads the virgin bristle; the later ones are closed.
        prop_assert!(work_j[1] > 0.0 && work_j[2] > 0.0, "{work_j:?}");
    }
}

/// In other forms the bench's books close, and every effect that is drawn is one that the answer names.
#[test]
fn a_bench_in_other_forms_keeps_its_books() {
    let lab = OneJoint(Plant::Bench, Forms::Other);
    for seed in 0..24 {
        let case = secret(&lab, seed, Stratum::Single).unwrap();
        let without = Drawn {
            hidden: Vec::new(),
            ..case.drawn.clone()
        };
        let without = simulate(&without, FINE_STEPS);
        let effect = case.drawn.hidden[0];
        let added = case.run.shown_effort.iter().zip(&without.shown_effort);
        let worst = added
            .zip(&case.run.hidden[0])
            .map(|((with, without), hidden)| (with - without - hidden).abs())
            .fold(0.0, f64::max);
        assert!(
            worst < 1e-9 * case.drawn.setup.scale.effort,
            "{effect:?}: {worst}"
        );
        assert!(case.sizes.ratio.unwrap() >= 1.0);
    }
}
