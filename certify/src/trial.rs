//! This file runs one trial: a controller on a plant under a hand, sample by sample, before a judge.

pub(crate) mod sensors;

use rigproof_impl::plant::{Outcome, Plant};
use rigproof_impl::tick::Sensed;
use rigproof_impl::vector::Vector;
use rigproof_spec::laws::Margin;
use rigproof_spec::methods::SAMPLE_STEP_S;
use rigproof_spec::tables::GREATEST_CURRENT_A;
use serde::{Deserialize, Serialize};

use crate::controller::{Controller, Failure, Source};
use crate::coverage::{Cell, Met, Since};
use crate::declared::Declared;
use crate::differential::tie::Ties;
use crate::hand::Pushing;
use crate::judge::Judge;
use crate::law::{Fared, LAWS, Law};
use crate::left_out::Amplifiers;
use crate::metrics::{Measured, Track};
use crate::scenario::Scenario;
use crate::way::Way;
use sensors::Sensors;

/// How a trial ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Ending {
    /// Its time was over.
    Time,
    /// The hand took the linkage to the stops of table 4.2.
    LeftWorkspace,
    /// The controller did not answer any more.
    NoAnswer,
}

/// What came of a trial.
#[derive(Clone, Debug, PartialEq)]
pub struct Ran {
    /// Samples.
    pub ticks: u32,
    /// How it ended.
    pub ending: Ending,
    /// How every law fared, in the order of [`Law::ALL`].
    pub fared: [Fared; LAWS],
    /// Where their premises were met.
    pub met: [Met; LAWS],
    /// The samples that were ties beside the reference.
    pub ties: Ties,
    /// The metrics.
    pub measured: Measured,
    /// How the controller broke, if it did.
    pub failure: Option<Failure>,
    /// What it was told and what it commanded, A, sample by sample.
    pub told: Vec<(Sensed<f64>, [f64; 4])>,
    /// What the plant was at the start of every sample, if that was asked for.
    pub states: Vec<State>,
}

/// What the plant was, and what the hand did.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct State {
    /// θA and θB, rad.
    pub theta_rad: [f64; 2],
    /// Their rates, rad/s.
    pub rates_rad_s: [f64; 2],
    /// The tip, m.
    pub tip_m: [f64; 2],
    /// The force on it, N.
    pub force_n: [f64; 2],
}

impl Ran {
    /// The laws that were broken.
    pub fn broken(&self) -> impl Iterator<Item = (Law, Fared)> {
        Law::ALL
            .into_iter()
            .zip(self.fared)
            .filter(|(_, fared)| fared.broken > 0)
    }
}

/// Runs a scenario; `None` where it is none: no path, no pose, no plant.
pub fn run(
    scenario: &Scenario,
    source: &dyn Source,
    declared: &Declared,
    with_states: bool,
) -> Option<Ran> {
    let mut trial = Trial::new(scenario, declared, with_states)?;
    match source.begin(&scenario.settings(), &scenario.task) {
        Ok(mut controller) => trial.go(controller.as_mut()),
        Err(failure) => trial.fail(0, failure),
    }
    if trial.failure.is_none() {
        trial.repeat(source);
    }
    let way = trial.way;
    Some(Ran {
        ticks: trial.told.len() as u32,
        ending: trial.ending,
        fared: trial.judge.fared,
        met: trial.judge.covered.met(),
        ties: trial.judge.ties(),
        measured: trial.track.measured(&way),
        failure: trial.failure,
        told: trial.told,
        states: trial.states,
    })
}

struct Trial<'a> {
    scenario: &'a Scenario,
    way: Way,
    plant: Plant,
    hand: Pushing,
    sensors: Sensors<'a>,
    amplifiers: Amplifiers,
    judge: Judge,
    since: Since,
    track: Track,
    has_turned: bool,
    has_left_end: bool,
    ending: Ending,
    failure: Option<Failure>,
    told: Vec<(Sensed<f64>, [f64; 4])>,
    with_states: bool,
    states: Vec<State>,
}

impl<'a> Trial<'a> {
    fn new(scenario: &'a Scenario, declared: &Declared, with_states: bool) -> Option<Trial<'a>> {
        let way = Way::new(&scenario.task)?;
        let plant = scenario.begun()?;
        let settings = scenario.settings();
        let capacity = scenario.ticks as usize;
        Some(Trial {
            scenario,
            way,
            hand: Pushing::new(&scenario.hand, &scenario.task)?,
            sensors: Sensors::new(scenario),
            amplifiers: Amplifiers::new(&scenario.left_out, SAMPLE_STEP_S),
            judge: Judge::new(
                &settings,
                declared,
                &scenario.task,
                scenario.is_passive().then(|| plant.kinetic_energy_j()),
            )?,
            plant,
            since: Since::default(),
            track: Track {
                tips_m: Vec::with_capacity(capacity),
                forces_n: Vec::with_capacity(capacity),
                ..Track::default()
            },
            has_turned: false,
            has_left_end: false,
            ending: Ending::Time,
            failure: None,
            told: Vec::with_capacity(capacity),
            with_states,
            states: Vec::new(),
        })
    }

    fn go(&mut self, controller: &mut dyn Controller) {
        let mut last_a = [0.0; 4];
        for tick in 0..self.scenario.ticks {
            if self.step(controller, tick, &mut last_a).is_none() {
                break;
            }
        }
        if self.failure.is_none() {
            self.over(controller);
        }
    }

    /// Ends a controller; what breaks then breaks its last sample.
    fn over(&mut self, controller: &mut dyn Controller) {
        if let Err(failure) = controller.end() {
            self.fail(self.told.len() as u32, failure);
        }
    }

    /// One sample and one step of the plant; `None` where the trial ends.
    fn step(
        &mut self,
        controller: &mut dyn Controller,
        tick: u32,
        last_a: &mut [f64; 4],
    ) -> Option<()> {
        let force_n = self.hand.push(&self.plant, *last_a, self.has_turned);
        let (sensed, fault) = self.sensors.read(tick, &self.plant, force_n);
        let (tip_m, velocity_m_s) = (self.plant.tip_m(), self.plant.tip_velocity_m_s());
        let of_fault = self.since.part(fault);
        self.judge
            .at(Cell::of(tip_m, velocity_m_s, force_n, of_fault));
        let currents_a = match controller.tick(&sensed) {
            Ok(currents_a) => currents_a,
            Err(failure) => {
                self.fail(tick, failure);
                return None;
            }
        };
        self.judge.add(Law::Answers, tick, Margin(0.0));
        self.told.push((sensed, currents_a));
        self.judge
            .command(tick, &sensed, fault.is_some(), currents_a);
        let given_a = self.given(currents_a);
        self.note(tick, tip_m, force_n, given_a, *last_a);
        *last_a = given_a;
        let flowing_a = self.amplifiers.given(given_a);
        let outcome = self.plant.step(force_n, flowing_a, SAMPLE_STEP_S);
        if outcome != Outcome::Moved || is_stretched(&self.plant) {
            self.ending = Ending::LeftWorkspace;
            return None;
        }
        self.judge.step(tick, &self.plant, force_n, tip_m);
        Some(())
    }

    /// What amplifiers make of a command: 0 to 1 A, nothing of what is no number, and nothing where no brake is.
    fn given(&self, mut currents_a: [f64; 4]) -> [f64; 4] {
        let tables = self.plant.yield_torques_nm();
        for (current_a, yield_nm) in currents_a.iter_mut().zip(tables) {
            let is_braked = yield_nm > 0.0;
            *current_a = if is_braked && *current_a > 0.0 {
                current_a.min(GREATEST_CURRENT_A)
            } else {
                0.0
            };
        }
        currents_a
    }

    /// What is measured, until the end of the path is reached.
    fn note(
        &mut self,
        tick: u32,
        tip_m: Vector<f64>,
        force_n: [f64; 2],
        given_a: [f64; 4],
        last_a: [f64; 4],
    ) {
        if self.with_states {
            self.states.push(State {
                theta_rad: self.plant.base_angles_rad(),
                rates_rad_s: self.plant.base_rates_rad_s(),
                tip_m: tip_m.into(),
                force_n,
            });
        }
        if self.has_turned {
            return;
        }
        let acts = |currents_a: [f64; 4]| currents_a.map(|current_a| current_a > 0.0);
        self.track.switches += u64::from(acts(given_a) != acts(last_a));
        self.track.tips_m.push(tip_m.into());
        self.track.forces_n.push(force_n);
        // A start beside the end has ended nothing.
        let is_at_end = self.way.has_ended(tip_m);
        if is_at_end && self.has_left_end {
            self.has_turned = true;
            self.track.finish_s = Some(f64::from(tick) * SAMPLE_STEP_S);
        }
        self.has_left_end |= !is_at_end;
    }

    fn fail(&mut self, tick: u32, failure: Failure) {
        self.judge.add(Law::Answers, tick, Margin(-1.0));
        self.ending = Ending::NoAnswer;
        self.failure = Some(failure);
    }

    /// Tells a fresh controller the same samples again, and one in another process where controllers have their own.
    fn repeat(&mut self, source: &dyn Source) {
        let (settings, task) = (self.scenario.settings(), &self.scenario.task);
        match source.begin_again(&settings, task) {
            Ok(mut fresh) => self.tell(fresh.as_mut()),
            Err(failure) => self.fail(self.told.len() as u32, failure),
        }
        if self.failure.is_some() {
            return;
        }
        match source.begin_elsewhere(&settings, task) {
            Ok(Some(mut fresh)) => self.tell(fresh.as_mut()),
            Ok(None) => {}
            Err(failure) => self.fail(self.told.len() as u32, failure),
        }
    }

    /// Tells a controller what was told, and judges whether it answers the same.
    fn tell(&mut self, fresh: &mut dyn Controller) {
        let told = self
            .told
            .iter()
            .map(|(sensed, answer_a)| (sensed, answer_a));
        if retold(&mut self.judge, fresh, told) {
            self.over(fresh);
        }
    }
}

/// Judges whether a fresh controller answers the same to what was told, up to the first other answer; false where it gave none.
pub fn retold<'a>(
    judge: &mut Judge,
    fresh: &mut dyn Controller,
    told: impl Iterator<Item = (&'a Sensed<f64>, &'a [f64; 4])>,
) -> bool {
    for (tick, (sensed, answer_a)) in (0..).zip(told) {
        judge.covered.back_to(tick);
        let Ok(again_a) = fresh.tick(sensed) else {
            judge.add(Law::Repeats, tick, Margin(f64::NAN));
            return false;
        };
        let margin = same(*answer_a, again_a);
        judge.add(Law::Repeats, tick, margin);
        if !margin.holds() {
            break;
        }
    }
    true
}

/// Least sine between two arms: that of 10°, where table 4.2 has its stops and a step of 1 ms its accuracy.
pub const LEAST_SINE: f64 = 0.173_648;

/// Whether a pair of arms is nearer to a line than table 4.2 allows.
pub(crate) fn is_stretched(plant: &Plant) -> bool {
    let linkage = plant.linkage();
    let pairs = [
        (linkage.ed, linkage.ae),
        (linkage.bc, linkage.cd),
        (linkage.ed, linkage.cd),
    ];
    pairs.into_iter().any(|(one, other)| {
        let sine = one.cross(other);
        sine <= 0.0
            || sine * sine < LEAST_SINE * LEAST_SINE * one.norm_squared() * other.norm_squared()
    })
}

/// Whether two commands are the same bits; the margin is minus the greatest difference, A.
fn same(one_a: [f64; 4], other_a: [f64; 4]) -> Margin {
    if one_a.map(f64::to_bits) == other_a.map(f64::to_bits) {
        return Margin(0.0);
    }
    let apart = one_a.into_iter().zip(other_a);
    // A zero of another sign, or another undefined number, is another bit pattern.
    apart.fold(Margin(-f64::MIN_POSITIVE), |margin, (one, other)| {
        margin.and(Margin(-(one - other).abs()))
    })
}
