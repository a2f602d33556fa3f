//! This file runs controller, hand and plant together, once on the reference and once on the plant, and says how far they may part.
//!
//! `RIGPROOF_CAMPAIGN=10000` runs as many of them; it took 14 minutes on two shared cores.

use core::f64::consts::TAU;

use rayon::prelude::*;
use rigproof_impl::plant::{Outcome, Plant, Scheme};
use rigproof_model::control::path::Line;
use rigproof_model::control::{Actuation, Controller, GainUnit, Sensed, controller};
use rigproof_model::linkage::forward;
use rigproof_model::rig::Rig;
use rigproof_spec::layout::Layout;
use rigproof_spec::methods::{Method, SAMPLE_STEP_S};

use crate::budget::assert_within_budget;
use crate::impl_plant::rigs::{Draw, LAYOUTS, campaign, middle_m, plant_of};

/// Length of a run, s.
const RUN_S: f64 = 0.4;
const METHODS: [Method; 5] = [
    Method::Uncontrolled,
    Method::Sdof,
    Method::SdofWithGap,
    Method::ProportionalLow,
    Method::ProportionalHigh,
];

/// How two runs may differ in which the same controller led and the same hand pushed, one on the reference and one on the plant.
///
/// As long as both controllers chose the same, the runs differ by what the plant's scheme makes of a tick: that has a tight budget.
/// A stick, a slip or a way out of the backlash that comes a part of a tick earlier may change a choice, and from there on the two runs
/// are two runs, as are two of the reference whose hands differ by a millionth: those have a budget of quantiles only.
/// With shorter steps of the plant (the controller's tick stays) the disagreement must shrink.
#[derive(Clone, Copy, Debug)]
struct Disagreement {
    /// Greatest distance between the tips during the run, m.
    tip_m: f64,
    /// Greatest distance between their velocities at the end of a tick, m/s.
    velocity_m_s: f64,
    /// Part of the ticks with another command.
    commands: f64,
}

struct Hand {
    sines: [[f64; 3]; 6],
}

impl Hand {
    fn new(draw: &mut Draw) -> Hand {
        let mut sine = || {
            [
                draw.between(1.3, 9.7),
                TAU * draw.between(0.3, 4.1),
                draw.between(0.0, TAU),
            ]
        };
        Hand {
            sines: [sine(), sine(), sine(), sine(), sine(), sine()],
        }
    }

    fn force_n(&self, time_s: f64) -> [f64; 2] {
        let sine = |[size_n, rate, phase]: [f64; 3]| size_n * libm::sin(rate * time_s + phase);
        let [a, b, c, d, e, f] = self.sines.map(sine);
        [a + b + c, d + e + f]
    }
}

struct Case {
    rig: Rig,
    line: Line,
    method: Method,
    hand: Hand,
}

impl Case {
    fn new(seed: u64) -> Case {
        let mut draw = Draw::new(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ 4127);
        let layout = LAYOUTS[(seed % 2) as usize];
        let [x, y] = middle_m(layout);
        let from = [x + draw.between(-0.05, 0.05), y + draw.between(-0.05, 0.05)];
        let angle = draw.between(0.0, TAU);
        let to = [
            from[0] + 0.1 * libm::cos(angle),
            from[1] + 0.1 * libm::sin(angle),
        ];
        Case {
            rig: Rig::new(layout, from).unwrap(),
            line: Line::through(from, to).unwrap(),
            method: METHODS[(seed / 2) as usize % METHODS.len()],
            hand: Hand::new(&mut draw),
        }
    }

    fn layout(&self) -> Layout {
        self.rig.parameters().layout
    }

    fn controller(&self) -> Box<dyn Controller> {
        let actuation = Actuation::thesis(self.layout());
        controller(self.method, GainUnit::PerCentimetre, actuation, self.line).unwrap()
    }

    /// Two runs of the reference whose hands differ by a millionth.
    fn sensitivity(&self) -> Option<f64> {
        let (mut one, mut other) = (self.rig.clone(), self.rig.clone());
        let (mut of_one, mut of_other) = (self.controller(), self.controller());
        let mut worst = 0.0_f64;
        for tick in 0..libm::round(RUN_S / SAMPLE_STEP_S) as u32 {
            let force_n = self.hand.force_n(f64::from(tick) * SAMPLE_STEP_S);
            let step = |rig: &mut Rig, controller: &mut Box<dyn Controller>, tip_force_n| {
                let command = controller.command(&Sensed {
                    pose: *rig.pose(),
                    tip_velocity_m_s: rig.tip_velocity_m_s(),
                    omega_rad_s: rig.joint_rates_rad_s(),
                    tip_force_n,
                });
                rig.step(tip_force_n, command.currents_a, SAMPLE_STEP_S)
                    .ok()
            };
            step(&mut one, &mut of_one, force_n)?;
            step(
                &mut other,
                &mut of_other,
                force_n.map(|part| part * (1.0 + 1e-6)),
            )?;
            let ([x, y], [other_x, other_y]) = (one.tip_m(), other.tip_m());
            worst = worst.max(libm::hypot(x - other_x, y - other_y));
        }
        Some(worst)
    }

    /// Runs both; none where the hand pulls the reference out of its workspace.
    fn disagreement(&self, steps_a_tick: u32) -> Option<Disagreement> {
        let mut rig = self.rig.clone();
        let mut plant = plant_of(&self.rig, Scheme::Midpoint);
        let (mut of_rig, mut of_plant) = (self.controller(), self.controller());
        let ticks = libm::round(RUN_S / SAMPLE_STEP_S) as u32;
        let mut worst = Disagreement {
            tip_m: 0.0,
            velocity_m_s: 0.0,
            commands: 0.0,
        };
        for tick in 0..ticks {
            let force_n = self.hand.force_n(f64::from(tick) * SAMPLE_STEP_S);
            let command = of_rig.command(&Sensed {
                pose: *rig.pose(),
                tip_velocity_m_s: rig.tip_velocity_m_s(),
                omega_rad_s: rig.joint_rates_rad_s(),
                tip_force_n: force_n,
            });
            let own = of_plant.command(&self.sensed(&plant, force_n)?);
            if own.reason != command.reason {
                worst.commands += 1.0 / f64::from(ticks);
            }
            rig.step(force_n, command.currents_a, SAMPLE_STEP_S).ok()?;
            for _ in 0..steps_a_tick {
                let step_s = SAMPLE_STEP_S / f64::from(steps_a_tick);
                if plant.step(force_n, own.currents_a, step_s) != Outcome::Moved {
                    return None;
                }
            }
            let (tip_m, velocity) = (plant.tip_m(), plant.tip_velocity_m_s());
            let [x, y] = rig.tip_m();
            worst.tip_m = worst.tip_m.max(libm::hypot(tip_m.x - x, tip_m.y - y));
            let [x, y] = rig.tip_velocity_m_s();
            worst.velocity_m_s = worst
                .velocity_m_s
                .max(libm::hypot(velocity.x - x, velocity.y - y));
        }
        Some(worst)
    }

    fn sensed(&self, plant: &Plant, tip_force_n: [f64; 2]) -> Option<Sensed> {
        let [theta_a, theta_b] = plant.base_angles_rad();
        Some(Sensed {
            pose: forward::pose(&self.rig.parameters().arms, theta_a, theta_b).ok()?,
            tip_velocity_m_s: plant.tip_velocity_m_s().into(),
            omega_rad_s: plant.joint_rates_rad_s(),
            tip_force_n,
        })
    }
}

/// Prints quantiles and returns the median.
fn print(what: &str, mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    let at = |rank: f64| values[((values.len() - 1) as f64 * rank) as usize];
    println!(
        "{what}: median {:.1e}, 75 % {:.1e}, 99 % {:.1e}, greatest {:.1e}",
        at(0.5),
        at(0.75),
        at(0.99),
        at(1.0)
    );
    at(0.5)
}

#[test]
fn closed_loops_on_the_plant_are_those_on_the_reference() {
    let runs = campaign(160) as u64;
    let both = |seed: u64| {
        let case = Case::new(seed);
        let sensitivity_m = case.sensitivity()?;
        Some((
            [case.disagreement(1)?, case.disagreement(8)?],
            sensitivity_m,
        ))
    };
    let found: Vec<_> = (0..runs).into_par_iter().filter_map(both).collect();
    println!("{} of {runs} runs stay in the workspace", found.len());
    assert!(found.len() as u64 > runs / 2);
    let tips =
        |place: usize| -> Vec<f64> { found.iter().map(|(pair, _)| pair[place].tip_m).collect() };
    let velocities = |place: usize| -> Vec<f64> {
        found
            .iter()
            .map(|(pair, _)| pair[place].velocity_m_s)
            .collect()
    };
    let [at_1, at_8] = [(0, 1), (1, 8)].map(|(place, steps)| {
        print(
            &format!("{steps} step(s) a tick, velocity, m/s"),
            velocities(place),
        );
        let commands = found.iter().map(|(pair, _)| pair[place].commands).collect();
        print(&format!("{steps} step(s) a tick, other commands"), commands);
        print(&format!("{steps} step(s) a tick, tip, m"), tips(place))
    });
    print(
        "the reference against itself, hand stronger by 1e-6, tip, m",
        found.iter().map(|(_, off)| *off).collect(),
    );
    assert!(at_8 < 0.1 * at_1, "{at_8:e} of {at_1:e} m");
    let same = |(pair, _): &&([Disagreement; 2], f64)| pair[0].commands == 0.0;
    let alike: Vec<f64> = found
        .iter()
        .filter(same)
        .map(|(pair, _)| pair[0].tip_m)
        .collect();
    println!("{} runs with the same commands throughout", alike.len());
    assert!(alike.len() > found.len() / 2);
    assert_within_budget("plant_closed_loop_same_commands", alike);
    assert_within_budget("plant_closed_loop_tip", tips(0));
    assert_within_budget("plant_closed_loop_velocity", velocities(0));
}
