//! This file runs one trial of an axis: its controller in closed loop, sample by sample, held to the laws.

use std::collections::VecDeque;

use rigproof_spec::laws::{Margin, effort_limit, reversals, spring_passivity, travel};
use serde::{Deserialize, Serialize};

use super::controller::{Controller, Place, Sensed, Source};
use super::law::{LAWS, Law};
use super::plan::Plan;
use super::plant::Plant;
use super::scenario::Scenario;
use crate::controller::Failure;
use crate::law::Fared;
use crate::scenario::Draw;

/// How a trial ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Ending {
    /// Its time was over.
    Time,
    /// The axis came to a stop of its travel.
    AtStop,
    /// The controller did not answer any more.
    NoAnswer,
}

/// What came of a trial.
#[derive(Clone, Debug, PartialEq)]
pub struct Ran {
    /// How it ended.
    pub ending: Ending,
    /// How every law fared, in the order of [`Law::ALL`].
    pub fared: [Fared; LAWS],
    /// The metrics, in their order.
    pub measured: [Option<f64>; 2],
    /// How the controller broke, if it did.
    pub failure: Option<Failure>,
    /// What it was told, the effort that it commanded, and where the axis was, sample by sample.
    pub told: Vec<(Sensed, f64, f64)>,
}

/// A turn of the effort that counts, as a share of its limit.
const TURN_SHARE: f64 = 0.02;
/// The time over which turns are counted, s.
const COUNTED_S: f64 = 1.0;
/// Standard deviations of the noise within which nearly every sample lies.
const DEVIATIONS: f64 = 3.0;

/// Runs the trial of an index. Whether it repeats itself is judged of what is to be certified alone.
pub fn run(plan: &Plan, source: &dyn Source, index: u64, is_judged: bool) -> Ran {
    let scenario = Scenario::drawn(plan, index);
    let mut trial = Trial::new(plan, &scenario);
    match source.begin(&plan.settings(), Place::Any) {
        Ok(mut controller) => trial.go(controller.as_mut()),
        Err(failure) => trial.fail(failure),
    }
    for place in [Place::Same, Place::New] {
        if is_judged && trial.ran.failure.is_none() {
            trial.repeat(source, place);
        }
    }
    trial.ran.measured = trial.measured();
    trial.ran
}

struct Trial<'a> {
    plan: &'a Plan,
    scenario: &'a Scenario,
    plant: Plant,
    sensors: Sensors,
    turns: Turns,
    spring: Option<Spring>,
    squares: [f64; 2],
    ran: Ran,
}

impl<'a> Trial<'a> {
    fn new(plan: &'a Plan, scenario: &'a Scenario) -> Trial<'a> {
        let [position, speed] = scenario.start;
        Trial {
            plant: Plant::new(&scenario.drawn, position, speed, plan.asked.sample_s),
            sensors: Sensors {
                noise: Draw::new(scenario.seed, 1),
                seen: VecDeque::new(),
            },
            turns: Turns::default(),
            spring: None,
            squares: [0.0; 2],
            ran: Ran {
                ending: Ending::Time,
                fared: [Fared::default(); LAWS],
                measured: [None; 2],
                failure: None,
                told: Vec::with_capacity(plan.ticks as usize),
            },
            plan,
            scenario,
        }
    }

    fn go(&mut self, controller: &mut dyn Controller) {
        for tick in 0..self.plan.ticks {
            match self.step(controller, tick) {
                Ok(()) if self.ran.ending == Ending::Time => {}
                Ok(()) => break,
                Err(failure) => return self.fail(failure),
            }
        }
        if let Err(failure) = controller.end() {
            self.fail(failure);
        }
    }

    /// One sample and one step of the axis.
    fn step(&mut self, controller: &mut dyn Controller, tick: u32) -> Result<(), Failure> {
        let limits = &self.plan.asked.limits;
        let [target_position, target_velocity] = self
            .scenario
            .target
            .at(self.plan.asked.sample_s * f64::from(tick));
        let (shown, position) = (self.plant.shown(), self.plant.position());
        let [seen, velocity] = self.sensors.read(self.plan, self.scenario, shown);
        let sensed = Sensed {
            number: tick,
            position: seen,
            velocity,
            effort: self.plant.effort,
            target_position,
            target_velocity,
        };
        let effort = controller.tick(&sensed)?;
        self.add(Law::Answers, tick, Margin(0.0));
        self.add(Law::EffortLimit, tick, effort_limit(effort, limits.effort));
        let turned = self.turns.count(self.plan, tick, effort);
        self.add(
            Law::Chatter,
            tick,
            reversals(turned, limits.reversals_per_s),
        );
        self.ran.told.push((sensed, effort, position));
        let error = position - target_position;
        self.squares = [
            self.squares[0] + error * error,
            self.squares[1] + effort * effort,
        ];
        // A drive gives no more than its limit, and nothing of what is no number.
        let given = match effort.is_nan() {
            true => 0.0,
            false => effort.clamp(-limits.effort, limits.effort),
        };
        self.plant.step(given);
        let inside = travel(self.plant.position(), [limits.low, limits.high]);
        self.add(Law::Travel, tick, inside);
        if !inside.holds() {
            self.ran.ending = Ending::AtStop;
        }
        self.spring(tick, [target_position, target_velocity], shown, given);
        Ok(())
    }

    /// Holds a step to the declared spring: what it gives at the position that it sees.
    fn spring(&mut self, tick: u32, target: [f64; 2], shown: f64, given: f64) {
        let Some(stiffness) = self.plan.asked.stiffness else {
            return;
        };
        let [position, velocity] = target;
        // Before the first velocity a controller cannot damp.
        if velocity != 0.0 || tick < self.plan.asked.velocity_samples {
            self.spring = None;
            return;
        }
        let limit = self.plan.asked.limits.effort;
        let held = |shown: f64| spring_energy(stiffness, position - shown, limit);
        let mut spring = match self.spring {
            Some(own) if own.target == position => own,
            _ => Spring {
                target: position,
                first: held(shown),
                given: 0.0,
            },
        };
        let now = self.plant.shown();
        spring.given += given * (now - shown);
        self.spring = Some(spring);
        let axis = &self.plan.axis;
        // A position that is rounded and noisy hides so much of a spring's energy.
        let hidden = axis.quantum + DEVIATIONS * self.scenario.noise;
        let margin = spring_passivity(spring.given, spring.first, held(now), limit * hidden);
        self.add(Law::Passivity, tick, margin);
    }

    fn add(&mut self, law: Law, tick: u32, margin: Margin) {
        if let Some(fared) = self.ran.fared.get_mut(law as usize) {
            fared.add(tick, margin);
        }
    }

    fn fail(&mut self, failure: Failure) {
        self.add(Law::Answers, self.ran.told.len() as u32, Margin(-1.0));
        self.ran.ending = Ending::NoAnswer;
        self.ran.failure = Some(failure);
    }

    /// Tells a fresh controller the same samples again, up to its first other answer.
    fn repeat(&mut self, source: &dyn Source, place: Place) {
        let mut fresh = match source.begin(&self.plan.settings(), place) {
            Ok(fresh) => fresh,
            Err(failure) => return self.fail(failure),
        };
        for index in 0..self.ran.told.len() {
            let Some((sensed, effort, _)) = self.ran.told.get(index).copied() else {
                break;
            };
            let margin = match fresh.tick(&sensed) {
                Ok(again) => same(effort, again),
                Err(_) => Margin(f64::NAN),
            };
            self.add(Law::Repeats, index as u32, margin);
            if !margin.holds() {
                return;
            }
        }
        if let Err(failure) = fresh.end() {
            self.fail(failure);
        }
    }

    /// Root mean squares of error and effort; nothing of a trial without a sample.
    fn measured(&self) -> [Option<f64>; 2] {
        let count = self.ran.told.len() as f64;
        self.squares.map(|sum| {
            let mean = libm::sqrt(sum / count);
            mean.is_finite().then_some(mean)
        })
    }
}

/// Whether two efforts are the same bits; the margin is minus their difference.
fn same(one: f64, other: f64) -> Margin {
    match one.to_bits() == other.to_bits() {
        true => Margin(0.0),
        // A zero of another sign, or another undefined number, is another bit pattern.
        false => Margin(-f64::MIN_POSITIVE).and(Margin(-(one - other).abs())),
    }
}

/// The energy of a spring whose force does not grow beyond a limit, J.
fn spring_energy(stiffness: f64, stretch: f64, limit: f64) -> f64 {
    let (stretch, straight) = (stretch.abs(), limit / stiffness);
    let bent = stretch.min(straight);
    0.5 * stiffness * bent * bent + limit * (stretch - bent)
}

/// What was given since a target rests.
#[derive(Clone, Copy)]
struct Spring {
    target: f64,
    /// What the spring held at first, J.
    first: f64,
    /// What the controller gave, J.
    given: f64,
}

/// What the sensors say: a position with noise, rounded, and its change over a few samples.
struct Sensors {
    noise: Draw,
    /// Positions that were seen, the newest first.
    seen: VecDeque<f64>,
}

impl Sensors {
    /// Position and velocity.
    fn read(&mut self, plan: &Plan, scenario: &Scenario, shown: f64) -> [f64; 2] {
        let noisy = shown + scenario.noise * self.normal();
        let quantum = plan.axis.quantum;
        let position = match quantum > 0.0 {
            true => {
                quantum * (libm::floor(noisy / quantum + scenario.phase) + 0.5 - scenario.phase)
            }
            false => noisy,
        };
        self.seen.push_front(position);
        let back = self
            .seen
            .len()
            .min(plan.asked.velocity_samples as usize + 1);
        self.seen.truncate(back);
        let oldest = self.seen.back().copied().unwrap_or(position);
        let steps = back.saturating_sub(1).max(1) as f64;
        [
            position,
            (position - oldest) / (steps * plan.asked.sample_s),
        ]
    }

    /// A normal number (Box and Muller 1958).
    fn normal(&mut self) -> f64 {
        // The logarithm of 0 is none.
        let radius = libm::sqrt(-2.0 * libm::log(1.0 - self.noise.between(0.0, 1.0)));
        let angle = core::f64::consts::TAU * self.noise.between(0.0, 1.0);
        radius * libm::cos(angle)
    }
}

/// The turns of an effort: after the farthest that it went one way, it comes back by enough.
#[derive(Default)]
struct Turns {
    farthest: f64,
    sense: f64,
    /// The ticks of the last second's turns.
    at: VecDeque<u32>,
}

impl Turns {
    /// How often the effort has turned back in the last second.
    fn count(&mut self, plan: &Plan, tick: u32, effort: f64) -> u32 {
        let asked = &plan.asked;
        let enough = TURN_SHARE * asked.limits.effort;
        let moved = effort - self.farthest;
        if self.sense * moved >= 0.0 && self.sense != 0.0 {
            self.farthest = effort;
        } else if moved.abs() > enough {
            if self.sense != 0.0 {
                self.at.push_back(tick);
            }
            (self.farthest, self.sense) = (effort, moved.signum());
        }
        let counted = libm::ceil(COUNTED_S / asked.sample_s) as u32;
        while self.at.front().is_some_and(|own| own + counted <= tick) {
            self.at.pop_front();
        }
        self.at.len() as u32
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spring_that_is_limited_holds_what_its_force_gives_back() {
        assert_eq!(spring_energy(200.0, -0.01, 5.0), 0.01);
        // Beyond 25 mm it gives 5 N and no more.
        let held = spring_energy(200.0, 0.055, 5.0);
        assert!((held - (0.0625 + 5.0 * 0.03)).abs() < 1e-15, "{held}");
    }

    #[test]
    fn another_bit_is_another_effort() {
        assert!(same(0.3, 0.3).holds() && same(f64::NAN, f64::NAN).holds());
        assert!(!same(0.0, -0.0).holds() && !same(0.3, f64::NAN).holds());
        assert!((same(0.3, 0.5).0 + 0.2).abs() < 1e-15);
    }
}
