//! This file runs the rig's tick and the rig's plant together, and beside them, in lock-step, the reference: at every tick its controller
//! decides on what was sensed, and its rig makes the same step from the same state.
//!
//! `RIGPROOF_CAMPAIGN` is the number of runs; without it a slice runs.

use std::collections::BTreeMap;

use rayon::prelude::*;
use rigproof_certify::built_in::Kind as Law;
use rigproof_certify::differential::both::{Seen, View, reference_path, rig_law, sense};
use rigproof_certify::differential::nudger::Nudger;
use rigproof_certify::differential::tick::{PathKind, Tick};
use rigproof_impl::plant::{Outcome, Parameters as PlantParameters, Plant};
use rigproof_impl::tick::{Sensed, Settings, Tick as RigTick};
use rigproof_model::brake::{Backlash, BrakeState};
use rigproof_model::encoder::Encoder;
use rigproof_model::linkage::singularity::{Pair, measure};
use rigproof_model::operator::{Abilities, Hand as _, Operator};
use rigproof_model::rig::{Moment, Parameters, Rig};
use rigproof_model::velocity::AdaptiveWindow;
use rigproof_spec::command::{Command, Reason};
use rigproof_spec::geometry::arms;
use rigproof_spec::joint::Joint;
use rigproof_spec::layout::Layout;
use rigproof_spec::methods::SAMPLE_STEP_S;

use crate::budget::assert_within_budget;
use crate::impl_laws::sample::Sampler;
use crate::impl_laws::tally::{Answers, quantiles};

/// Runs of the slice that every test run takes.
const SLICE: u64 = 200;
/// Ticks of a run.
const TICKS: u32 = 400;
/// Least sine between two arms inside table 4.2: that of 10°.
const LEAST_SINE: f64 = 0.173_648;
/// Laws that take turns.
const LAWS: u64 = 6;

/// What a step was, as far as it bears on how well a fixed step can meet it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Kind {
    /// Nothing changed what it does.
    Even,
    /// A joint stuck, slipped or turned back, or a brake came to another course, somewhere within the step.
    Eventful,
    /// The plant had passed a boundary of a backlash after it last looked, half a step before: it takes that back in this step, and the
    /// reference, put into the same state, cannot.
    Passed,
    /// Two arms are nearer to a line than table 4.2 allows: what turns there turns at once.
    Stretched,
}

/// How far two steps from one state ended apart.
#[derive(Default)]
struct Apart {
    place_rad: Vec<f64>,
    rate_rad_s: Vec<f64>,
    yield_nm: Vec<f64>,
}

/// What became of many runs.
#[derive(Default)]
struct Tally {
    ticks: u64,
    left: u64,
    answers: Answers,
    apart: BTreeMap<Kind, Apart>,
    held_otherwise: u64,
}

impl Tally {
    fn join(mut self, other: Tally) -> Tally {
        self.ticks += other.ticks;
        self.left += other.left;
        self.held_otherwise += other.held_otherwise;
        self.answers.join(other.answers);
        for (kind, apart) in other.apart {
            let into = self.apart.entry(kind).or_default();
            into.place_rad.extend(apart.place_rad);
            into.rate_rad_s.extend(apart.rate_rad_s);
            into.yield_nm.extend(apart.yield_nm);
        }
        self
    }
}

/// A hand: an operator on the path, a shaking, or both.
struct Hand {
    operator: Option<Operator<Seen>>,
    sines: [[f64; 3]; 6],
}

impl Hand {
    fn force_n(&mut self, plant: &Plant, time_s: f64) -> [f64; 2] {
        let sine = |[size_n, rate, phase]: [f64; 3]| size_n * libm::sin(rate * time_s + phase);
        let [a, b, c, d, e, f] = self.sines.map(sine);
        let (tip_m, velocity_m_s) = (plant.tip_m().into(), plant.tip_velocity_m_s().into());
        let [x, y] = match &mut self.operator {
            Some(operator) => operator.push(tip_m, velocity_m_s, SAMPLE_STEP_S),
            None => [0.0; 2],
        };
        [x + a + b + c, y + d + e + f]
    }
}

/// One run: a rig under a law, and who pushes it.
struct Run {
    /// The law, its path and settings; pose and motion are those of the last sample.
    tick: Tick,
    parameters: Parameters,
    plant: Plant,
    hand: Hand,
}

impl Run {
    fn new(seed: u64, sampler: &mut Sampler) -> Run {
        let layout = [Layout::ThreeBrake, Layout::FourBrake][(seed / LAWS % 2) as usize];
        let mut tick = loop {
            let tick = sampler.plain();
            if place(tick.law) == seed % LAWS && tick.layout == layout {
                break tick;
            }
        };
        tick.arms = arms(layout);
        let mut near = |size: f64| [size * sampler.nudge(), size * sampler.nudge()];
        let [start_x, start_y] = near(0.07);
        let start_m = [0.015 + start_x, 0.403 + start_y];
        // Half of the paths pass near the start.
        let [off_x, off_y] = near(0.02);
        if (seed / (2 * LAWS)).is_multiple_of(2) {
            move_to(&mut tick.path, [start_m[0] + off_x, start_m[1] + off_y]);
        }
        let rig = Rig::new(layout, start_m).unwrap();
        let parameters = PlantParameters::of(layout);
        let plant = Plant::new(&parameters, rig.base_angles_rad(), [0.0; 2], &[]).unwrap();
        let size_n = [0.0, 9.7, 3.1][(seed % 3) as usize];
        let mut sine = || {
            let rate = 13.8 + 11.9 * sampler.nudge();
            [size_n * sampler.nudge(), rate, 3.1 * sampler.nudge()]
        };
        let sines = [sine(), sine(), sine(), sine(), sine(), sine()];
        let operator = (seed % 3 != 1).then(|| {
            let path = Seen(reference_path(&tick.path).unwrap(), View::EXACT);
            Operator::new(path, Abilities::CAREFUL, seed).unwrap()
        });
        Run {
            tick,
            parameters: Parameters::of(layout),
            plant,
            hand: Hand { operator, sines },
        }
    }

    fn moment(&self) -> Moment {
        Moment {
            theta_rad: self.plant.base_angles_rad(),
            rates_rad_s: self.plant.base_rates_rad_s(),
            brakes: self.plant.brakes().map(|brake| BrakeState {
                yield_nm: brake.yield_nm(),
                fall_origin_a: brake.fall_origin_a(),
                boundary_rad: brake.backlash().boundaries_rad()[0],
                is_inside: brake.backlash().is_inside(),
            }),
            held: self.plant.stuck(),
        }
    }

    /// Whether a shaft has passed a boundary since the plant looked.
    fn has_passed(&self) -> bool {
        let angles = self.plant.joint_angles_rad();
        let each = Joint::ALL.into_iter().zip(self.moment().brakes).zip(angles);
        each.filter(|((joint, _), _)| self.parameters.layout.brakes().contains(joint))
            .any(|((joint, state), angle_rad)| {
                let mut backlash = Backlash::resumed(joint, state.boundary_rad, state.is_inside);
                backlash.update(angle_rad) != state.is_inside
            })
    }

    /// One step of both from where the plant is; `None` where either leaves the workspace.
    fn step(&mut self, force_n: [f64; 2], currents_a: [f64; 4], tally: &mut Tally) -> Option<()> {
        let mut rig = Rig::resumed(self.parameters, &self.moment()).ok()?;
        let (passed, held) = (self.has_passed(), self.plant.stuck());
        rig.step(force_n, currents_a, SAMPLE_STEP_S).ok()?;
        if self.plant.step(force_n, currents_a, SAMPLE_STEP_S) != Outcome::Moved {
            return None;
        }
        let stretched = Pair::ALL
            .into_iter()
            .any(|pair| measure(rig.pose(), pair) < LEAST_SINE);
        let eventful = rig.events() > 0 || held != rig.stuck() || held != self.plant.stuck();
        let kind = match () {
            () if stretched => Kind::Stretched,
            () if passed => Kind::Passed,
            () if eventful => Kind::Eventful,
            () => Kind::Even,
        };
        let greatest = |one: &[f64], other: &[f64]| {
            let pairs = one.iter().zip(other);
            pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
        };
        let plant = &self.plant;
        let apart = tally.apart.entry(kind).or_default();
        let places = [plant.base_angles_rad(), rig.base_angles_rad()];
        apart.place_rad.push(greatest(&places[0], &places[1]));
        let rates = [plant.base_rates_rad_s(), rig.base_rates_rad_s()];
        apart.rate_rad_s.push(greatest(&rates[0], &rates[1]));
        let yields = [plant.yield_torques_nm(), rig.yield_torques_nm()];
        apart.yield_nm.push(greatest(&yields[0], &yields[1]));
        tally.held_otherwise += u64::from(plant.stuck() != rig.stuck());
        Some(())
    }
}

fn place(law: Law) -> u64 {
    match law {
        Law::Uncontrolled => 0,
        Law::Sdof { .. } => 1,
        Law::Proportional { .. } => 2,
        Law::VelocityRatio { .. } => 3,
        Law::Optimal { .. } => 4,
        Law::Impedance { .. } => 5,
    }
}

/// Moves a path so that it begins at a point.
fn move_to(path: &mut PathKind, [x, y]: [f64; 2]) {
    let [from_x, from_y] = match path {
        PathKind::Line([from_m, _]) => *from_m,
        PathKind::Arc([x, y], [radius_m, start_rad, _]) => {
            let (sine, cosine) = libm::sincos(*start_rad);
            [*x + *radius_m * cosine, *y + *radius_m * sine]
        }
        PathKind::Polyline(points, _) | PathKind::Spline(points) => points[0],
    };
    let moved = |point: &mut [f64; 2]| {
        *point = [point[0] + x - from_x, point[1] + y - from_y];
    };
    match path {
        PathKind::Line(points) => points.iter_mut().for_each(moved),
        PathKind::Arc(centre_m, _) => [centre_m].into_iter().for_each(moved),
        PathKind::Polyline(points, _) | PathKind::Spline(points) => {
            points.iter_mut().for_each(moved);
        }
    }
}

fn tally(seed: u64) -> Tally {
    let (mut sampler, mut nudger) = (Sampler::new(seed), Nudger::new(!seed));
    let mut tally = Tally::default();
    let mut run = Run::new(seed, &mut sampler);
    let settings = Settings {
        zero_counts: [20_011, -31_013],
        ..Settings::thesis(run.tick.layout)
    };
    let encoders = settings.counts_per_turn.map(Encoder::new);
    let mut law = RigTick::new(&settings, rig_law::<f64>(&run.tick).unwrap()).unwrap();
    let mut estimators: Option<[AdaptiveWindow; 2]> = None;
    for number in 0..TICKS {
        let force_n = run
            .hand
            .force_n(&run.plant, f64::from(number) * SAMPLE_STEP_S);
        let angles = run.plant.base_angles_rad();
        let travels = [0, 1].map(|joint| encoders[joint].count(angles[joint]));
        let rig = law.tick(&Sensed {
            number,
            counts: [0, 1].map(|joint| travels[joint] as i32 + settings.zero_counts[joint]),
            tip_force_n: force_n.into(),
        });
        let rig = Command::from(rig);
        let [of_a, of_b] = estimators.get_or_insert_with(|| {
            [0, 1].map(|joint| AdaptiveWindow::new(encoders[joint], SAMPLE_STEP_S, travels[joint]))
        });
        let rates_rad_s = [of_a.update(travels[0]), of_b.update(travels[1])];
        sense(
            &mut run.tick,
            [0, 1].map(|joint| travels[joint] as f64 * encoders[joint].resolution_rad()),
            rates_rad_s,
            force_n,
        );
        tally.ticks += 1;
        if rig.reason != Reason::Starting {
            let place = format!("seed {seed}, tick {number}");
            tally.answers.add(&run.tick, rig, &mut nudger, &place);
        }
        if run.step(force_n, rig.currents_a, &mut tally).is_none() {
            tally.left += 1;
            break;
        }
    }
    tally
}

#[test]
fn tick_and_plant_joined_are_the_reference_in_every_tick() {
    let runs = std::env::var("RIGPROOF_CAMPAIGN").map_or(SLICE, |text| text.parse().unwrap());
    let seeds = 83_000_000..83_000_000 + runs;
    let all = seeds
        .into_par_iter()
        .map(tally)
        .reduce(Tally::default, Tally::join);
    println!(
        "{runs} runs, {} left the workspace; {} ticks, at the start or {}",
        all.left,
        all.ticks,
        all.answers.counts()
    );
    println!("currents: {}", quantiles(&all.answers.rounding_a));
    for (kind, apart) in &all.apart {
        println!("{kind:?}: {} steps", apart.place_rad.len());
        println!("  place, rad: {}", quantiles(&apart.place_rad));
        println!("  rate, rad/s: {}", quantiles(&apart.rate_rad_s));
        println!("  yield, N·m: {}", quantiles(&apart.yield_nm));
    }
    println!("{} steps end with another brake held", all.held_otherwise);
    all.answers.assert_none_wrong();
    assert!(all.ticks > runs * u64::from(TICKS) / 2);
    // When in a step a joint comes to stand is the greatest of what the plant does not resolve.
    assert!(
        all.held_otherwise * 500 < all.ticks,
        "{} steps",
        all.held_otherwise
    );
    assert_within_budget("joined_current", all.answers.rounding_a);
    for (kind, apart) in all.apart {
        let kind = format!("{kind:?}").to_lowercase();
        assert_within_budget(&format!("joined_{kind}_place"), apart.place_rad);
        assert_within_budget(&format!("joined_{kind}_rate"), apart.rate_rad_s);
        assert_within_budget(&format!("joined_{kind}_yield"), apart.yield_nm);
    }
}
