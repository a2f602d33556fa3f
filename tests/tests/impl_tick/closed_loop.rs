//! This file runs the reference rig under the rig's own tick, beside the reference's controller that is told what the encoders say.

use nalgebra::Vector2;
use rayon::prelude::*;
use rigproof_impl::actuation::Actuation as TickActuation;
use rigproof_impl::law::{Law, Proportional, Sdof};
use rigproof_impl::number::Real;
use rigproof_impl::path::Line as TickLine;
use rigproof_impl::tick::{Sensed as Sample, Settings, Tick};
use rigproof_model::control::force_angle::joint_rate;
use rigproof_model::control::path::Line;
use rigproof_model::control::{Actuation, Controller, GainUnit, Sensed, controller};
use rigproof_model::encoder::Encoder;
use rigproof_model::linkage::{forward, jacobian::jacobian};
use rigproof_model::motion::two_coordinate::two_coordinate;
use rigproof_model::operator::{Abilities, Hand, Operator};
use rigproof_model::rig::Rig;
use rigproof_model::trial::{LINES, Segment};
use rigproof_model::velocity::AdaptiveWindow;
use rigproof_spec::command::{Command, Reason};
use rigproof_spec::inertia::inertia;
use rigproof_spec::layout::Layout;
use rigproof_spec::methods::{BLEND_BOUNDARY_M, Method, SAMPLE_STEP_S, Setting};
use rigproof_spec::units::M_PER_CM;

use crate::budget::assert_within_budget;

/// One trial: which rig, line and method, and which operator.
#[derive(Clone, Copy, Debug)]
pub struct Trial {
    pub layout: Layout,
    pub segment: Segment,
    pub method: Method,
    pub seed: u64,
}

/// Every method that brakes, on both lines and layouts.
pub fn trials(seed: u64) -> Vec<Trial> {
    let mut trials = Vec::new();
    for layout in [Layout::ThreeBrake, Layout::FourBrake] {
        for segment in LINES {
            for method in Method::ALL {
                if method.setting() != Setting::Nothing {
                    trials.push(Trial {
                        layout,
                        segment,
                        method,
                        seed,
                    });
                }
            }
        }
    }
    trials
}

/// The trial's law.
pub fn law<R: Real + 'static>(trial: &Trial) -> Box<dyn Law<R>> {
    let line = TickLine::<R>::through(trial.segment.from_m, trial.segment.to_m).unwrap();
    let actuation = TickActuation::<R>::thesis(trial.layout);
    match trial.method.setting() {
        Setting::GainPrinted(gain) => {
            let gain = gain * GainUnit::PerCentimetre.to_si();
            Box::new(Proportional::new(actuation, line, BLEND_BOUNDARY_M, gain).unwrap())
        }
        Setting::GapCm(gap_cm) => {
            let gap_m = gap_cm * M_PER_CM;
            Box::new(Sdof::new(actuation, line, BLEND_BOUNDARY_M, gap_m).unwrap())
        }
        Setting::Nothing => panic!("an uncontrolled trial has no law"),
    }
}

/// A tick with the trial's law.
pub fn tick<R: Real + 'static>(trial: &Trial) -> impl FnMut(&Sample<R>) -> Command + use<R> {
    let mut tick = Tick::new(&Settings::thesis(trial.layout), Boxed(law(trial))).unwrap();
    move |sample| tick.tick(sample).into()
}

struct Boxed<R>(Box<dyn Law<R>>);

impl<R> Law<R> for Boxed<R> {
    fn command(
        &mut self,
        now: &rigproof_impl::law::Situation<R>,
    ) -> rigproof_impl::command::Command<R> {
        self.0.command(now)
    }

    fn actuation(&self) -> Option<&TickActuation<R>> {
        self.0.actuation()
    }
}

/// Runs a trial with the tick in f64 in the loop; `watch` sees each sample and command.
pub fn run(trial: &Trial, watch: &mut dyn FnMut(&Sample<f64>, Command)) {
    let Segment { from_m, to_m } = trial.segment;
    let line = Line::through(from_m, to_m).unwrap();
    let mut operator = Operator::new(line, Abilities::CAREFUL, trial.seed).unwrap();
    let mut rig = Rig::new(trial.layout, from_m).unwrap();
    let mut tick = tick::<f64>(trial);
    let encoder = Encoder::default();
    let [way_x, way_y] = [to_m[0] - from_m[0], to_m[1] - from_m[1]];
    for number in 0..4000 {
        let [x, y] = rig.tip_m();
        if (x - to_m[0]) * way_x + (y - to_m[1]) * way_y >= 0.0 {
            break;
        }
        let force_n = operator.push(rig.tip_m(), rig.tip_velocity_m_s(), SAMPLE_STEP_S);
        let counts = rig
            .base_angles_rad()
            .map(|angle| encoder.count(angle) as i32);
        let sample = Sample {
            number,
            counts,
            tip_force_n: force_n.into(),
        };
        let command = tick(&sample);
        watch(&sample, command);
        rig.step(force_n, command.currents_a, SAMPLE_STEP_S)
            .unwrap();
    }
}

/// The reference's controller with the reference's estimator of velocity in front of it.
pub struct Reference {
    trial: Trial,
    encoder: Encoder,
    estimators: Option<[AdaptiveWindow; 2]>,
    controller: Box<dyn Controller>,
}

impl Reference {
    pub fn new(trial: Trial) -> Reference {
        let line = Line::through(trial.segment.from_m, trial.segment.to_m).unwrap();
        let actuation = Actuation::thesis(trial.layout);
        Reference {
            trial,
            encoder: Encoder::default(),
            estimators: None,
            controller: controller(trial.method, GainUnit::PerCentimetre, actuation, line).unwrap(),
        }
    }

    /// What it asks for, and whether a braked joint stands while the tip moves.
    pub fn command(&mut self, sample: &Sample<f64>) -> (Command, bool) {
        let counts = sample.counts.map(i64::from);
        let encoder = self.encoder;
        let estimators = self.estimators.get_or_insert_with(|| {
            counts.map(|count| AdaptiveWindow::new(encoder, SAMPLE_STEP_S, count))
        });
        let [a, b] = estimators;
        let rates_rad_s = [a.update(counts[0]), b.update(counts[1])];
        let arms = rigproof_spec::geometry::arms(self.trial.layout);
        let [theta_a, theta_b] = counts.map(|count| count as f64 * encoder.resolution_rad());
        let pose = forward::pose(&arms, theta_a, theta_b).unwrap();
        let form = two_coordinate(&arms, &inertia(self.trial.layout), &pose, rates_rad_s);
        let tip_velocity_m_s = form.tip_velocity_m_s(rates_rad_s);
        let command = self.controller.command(&Sensed {
            pose,
            tip_velocity_m_s,
            omega_rad_s: form.joint_rates_rad_s(rates_rad_s),
            tip_force_n: sample.tip_force_n.into(),
        });
        let rows = jacobian(&arms, &pose).unwrap();
        let velocity_m_s = Vector2::from(tip_velocity_m_s);
        let stands = self.trial.layout.brakes().iter().any(|joint| {
            let row = rows.row(*joint as usize).transpose();
            velocity_m_s.norm() > 0.0 && joint_rate(row, velocity_m_s) == 0.0
        });
        (command, stands)
    }
}

#[test]
fn inside_the_loop_tick_and_reference_decide_alike() {
    let outcomes: Vec<(u64, u64, Vec<f64>)> = trials(11)
        .into_par_iter()
        .map(|trial| {
            let mut reference = Reference::new(trial);
            let (mut asked, mut standing, mut differences) = (0, 0, Vec::new());
            run(&trial, &mut |sample, command| {
                let (expected, stands) = reference.command(sample);
                if command.reason == Reason::Starting {
                    return;
                }
                asked += 1;
                standing += u64::from(stands);
                assert_eq!(command.reason, expected.reason, "{trial:?} {sample:?}");
                let pairs = command.currents_a.into_iter().zip(expected.currents_a);
                differences.extend(pairs.map(|(a, b)| (a - b).abs()));
            });
            (asked, standing, differences)
        })
        .collect();
    let asked: u64 = outcomes.iter().map(|(asked, ..)| asked).sum();
    let standing: u64 = outcomes.iter().map(|(_, standing, _)| standing).sum();
    println!("{asked} ticks inside the loop, {standing} with a joint that stands");
    assert!(asked > 20_000 && standing > asked / 100);
    let differences = outcomes
        .into_iter()
        .flat_map(|(.., differences)| differences);
    assert_within_budget("rig_tick_current_in_the_loop", differences.collect());
}
