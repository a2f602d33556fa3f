//! This file watches whether the rig is still one that a certificate is about: bounded work in every sample, no heap, no panic.
//!
//! It is told what the tick is told and what it commands. Once it raised an alarm it lets go for good; a new one has to be made.

pub mod balance;
pub mod braking;
pub mod constants;
pub mod envelope;
pub mod estimate;
pub mod information;
pub mod sought;

use balance::{Accuracy, BLOCK, Balancing, Due, Step};
use braking::Braking;
use constants::{Constants, WATCHED};
use envelope::{Envelope, Seen};
use estimate::{Estimate, PART_BLOCKS};

use rigproof_spec::inertia::Inertia;
use rigproof_spec::joint::Joint;
use rigproof_spec::tables::GREATEST_CURRENT_A;

use crate::encoder::Encoder;
use crate::guard::{Guard, RECOVERY_SAMPLES, SLACK_A, Verdict};
use crate::linkage::{Linkage, Shape, linkage};
use crate::number::{Real, Scalar};
use crate::plant::form::{Bodies, Form, form};
use crate::tick::{Sensed, Settings};
use crate::vector::Vector;
use crate::velocity::Velocity;

type Plane = Vector<f64>;

/// Rate below which it is not asked what resists at a joint, rad/s: two and a half times what one count in eight samples is on the thesis's rig
/// (7.9 mrad/s), so that its sense is known between two arms too.
const LEAST_RATE_RAD_S: f64 = 0.02;

/// Why the rig is not what was certified.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Alarm {
    /// No good sample came for longer than in any trial.
    Sensor,
    /// A command is no current of a brake that is there.
    Command,
    /// The tip is where it was in no trial.
    Place,
    /// The tip is faster than in any trial.
    Speed,
    /// The hand pushes harder than in any trial.
    Force,
    /// Place, speed and force came together in no trial.
    Cell,
    /// The torque that current makes at a joint's brake is outside its interval.
    Gain(Joint),
    /// Friction without current at a joint is outside its interval.
    Friction(Joint),
    /// A constant torque at A or B is outside its interval.
    Bias(Joint),
    /// The motion is further from the model than in any trial, and no number says why.
    Motion,
}

impl Alarm {
    /// What a watched number is called, in the order of [`Constants::low`].
    const NUMBERS: [Alarm; WATCHED] = [
        Alarm::Gain(Joint::A),
        Alarm::Gain(Joint::E),
        Alarm::Gain(Joint::B),
        Alarm::Gain(Joint::C),
        Alarm::Friction(Joint::A),
        Alarm::Friction(Joint::E),
        Alarm::Friction(Joint::B),
        Alarm::Friction(Joint::C),
        Alarm::Bias(Joint::A),
        Alarm::Bias(Joint::B),
    ];
}

/// What the monitor makes of a sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Watched {
    /// The currents that may leave, A: those of the command, or none.
    pub currents_a: [f64; 4],
    /// Why none may leave any more.
    pub alarm: Option<Alarm>,
    /// Whether a sensor is wrong in this sample: none leaves until it is well.
    pub is_faulty: bool,
}

/// What a sample leaves for the step that follows it.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Last {
    travels: [i32; 2],
    force_n: Plane,
    currents_a: [f64; 4],
}

/// The monitor at work.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Monitor {
    of: Constants,
    shape: Shape<f64>,
    bodies: Bodies<f64>,
    /// Of the arms of both sides and of the payload: see [`Bodies::sides`].
    inertias: [[f64; 3]; 3],
    braked: [bool; 4],
    encoders: [Encoder<f64>; 2],
    velocities: [Velocity<f64>; 2],
    guard: Guard<f64>,
    accuracy: Accuracy,
    brakings: [Braking; 4],
    last: Option<Last>,
    balancing: Balancing,
    estimate: Estimate,
    envelope: Envelope,
    /// Samples in a row without a good one, and steps until blocks begin.
    faulty: u32,
    wait: u32,
    alarm: Option<Alarm>,
}

impl Monitor {
    /// A monitor that has seen nothing; `None` for settings that no rig has and constants that are no numbers.
    pub fn new(settings: &Settings, of: &Constants) -> Option<Monitor> {
        let [of_a, of_b] = settings.counts_per_turn;
        let [zero_a, zero_b] = settings.zero_counts;
        let encoders = [Encoder::new(of_a, zero_a)?, Encoder::new(of_b, zero_b)?];
        let numbers = of.low.iter().chain(&of.high).chain(&of.spread);
        let is_sound = settings.are_sound()
            && numbers.chain(&of.levels).all(|number| number.is_finite())
            && of.levels.iter().all(|level| *level > 0.0)
            && of.memory_s > 0.0
            && of.spread.iter().all(|spread| *spread > 0.0)
            && of.low.iter().zip(&of.high).all(|(low, high)| low < high)
            && of.surprise > 0.0;
        if !is_sound {
            return None;
        }
        let bodies = Bodies::new(&settings.arms, &of.inertia);
        let part_s = f64::from(BLOCK * PART_BLOCKS) * settings.sample_s;
        Some(Monitor {
            of: *of,
            shape: Shape::new(&settings.arms),
            inertias: inertias(settings, &of.inertia),
            bodies,
            braked: Joint::ALL.map(|joint| settings.layout.brakes().contains(&joint)),
            velocities: encoders.map(|encoder| Velocity::new(&encoder, settings.sample_s)),
            guard: settings.guard(),
            accuracy: Accuracy {
                step_s: settings.sample_s,
                // A count is as likely anywhere within one.
                angle_rad: encoders
                    .map(|encoder| encoder.rad_per_count() * (1.0 / libm::sqrt(12.0))),
                missed_share: of.missed_share,
            },
            encoders,
            brakings: of
                .brakes
                .map(|table| Braking::new(&table, of.backlash_share)),
            last: None,
            balancing: Balancing::NONE,
            estimate: Estimate::new(&of.spread, libm::exp(-part_s / of.memory_s)),
            envelope: Envelope::default(),
            faulty: 0,
            wait: BLOCK,
            alarm: None,
        })
    }

    /// The alarm, once there is one.
    pub fn alarm(&self) -> Option<Alarm> {
        self.alarm
    }

    /// Where the last good sample lay.
    pub fn seen(&self) -> Seen {
        self.envelope.seen()
    }

    /// What the balances say of the numbers: how far each is from the middle, with its variance.
    pub fn estimate(&self) -> &Estimate {
        &self.estimate
    }

    /// Watches a sample and the currents that the tick commands for it, A. The work is bounded whatever is told.
    pub fn watch(&mut self, sensed: &Sensed<f64>, commanded_a: [f64; 4]) -> Watched {
        let travels = self.travels(sensed.counts);
        let reached = self
            .encoders
            .iter()
            .zip(travels)
            .all(|(of, travel)| of.reaches(travel));
        let force_n = sensed.tip_force_n;
        let verdict = self
            .guard
            .judge(sensed.number, travels, reached, force_n.into());
        if !self.may_leave(commanded_a) {
            self.raise(Alarm::Command);
        }
        let is_faulty = matches!(verdict, Verdict::Fault(_));
        let is_let_go = is_faulty || self.alarm.is_some();
        let currents_a = if is_let_go { [0.0; 4] } else { commanded_a };
        match verdict {
            Verdict::Good | Verdict::Early => {
                self.faulty = 0;
                self.good(Last {
                    travels,
                    force_n,
                    currents_a,
                });
            }
            Verdict::Repeated => self.interrupt(),
            Verdict::Fault(_) => {
                self.interrupt();
                for (velocity, travel) in self.velocities.iter_mut().zip(travels) {
                    velocity.restart(travel);
                }
                self.faulty = self.faulty.saturating_add(1);
                if self.faulty > self.of.longest_fault {
                    self.raise(Alarm::Sensor);
                }
            }
        }
        let is_let_go = is_faulty || self.alarm.is_some();
        Watched {
            currents_a: if is_let_go { [0.0; 4] } else { currents_a },
            alarm: self.alarm,
            is_faulty,
        }
    }

    fn travels(&self, [count_a, count_b]: [i32; 2]) -> [i32; 2] {
        let [of_a, of_b] = &self.encoders;
        [of_a.travel(count_a), of_b.travel(count_b)]
    }

    /// Whether every current is one of a brake that is there.
    fn may_leave(&self, commanded_a: [f64; 4]) -> bool {
        let allowed = |(current_a, braked): (f64, bool)| {
            (current_a == 0.0)
                | (braked & (-SLACK_A..=GREATEST_CURRENT_A + SLACK_A).contains(&current_a))
        };
        commanded_a.into_iter().zip(self.braked).all(allowed)
    }

    /// The first alarm stays.
    fn raise(&mut self, alarm: Alarm) {
        self.alarm.get_or_insert(alarm);
    }

    /// What was begun is not gone on with: samples are missing.
    fn interrupt(&mut self) {
        self.last = None;
        self.balancing.lose();
        self.wait = BLOCK;
        for braking in &mut self.brakings {
            braking.lose();
        }
    }

    /// A sample that can be used.
    fn good(&mut self, now: Last) {
        let [a, b] = &mut self.velocities;
        let [of_a, of_b] = now.travels;
        let rates = Vector::new(a.update(of_a), b.update(of_b));
        let before = self.last.replace(now);
        let Some(before) = before else { return };
        let ends = [before.travels, now.travels].map(|travels| self.angles(travels));
        let [from, to] = ends;
        let middle = (from + to) * 0.5;
        let unit = |angle: f64| {
            let (sine, cosine) = angle.sine_cosine();
            Vector::new(cosine, sine)
        };
        let at = linkage(&self.shape, unit(middle.x), unit(middle.y));
        if !at.is_sound(&self.shape) {
            self.raise(Alarm::Place);
            return;
        }
        let velocity_m_s = at.tip_velocity(rates);
        let outside = self
            .envelope
            .look(&self.of, at.tip_m, velocity_m_s, now.force_n);
        if let Some(alarm) = outside {
            self.raise(alarm);
        }
        let by = to - from;
        let mean = by * (1.0 / self.accuracy.step_s);
        let form = form(&self.bodies, &at, mean);
        let step = self.step(&at, &form, [by, mean, rates], &before);
        if self.wait > 0 {
            self.wait -= 1;
            return;
        }
        self.balancing.add(&step, &form);
        self.go_on();
    }

    fn angles(&self, [of_a, of_b]: [i32; 2]) -> Plane {
        let [a, b] = &self.encoders;
        Vector::new(a.angle_rad(of_a), b.angle_rad(of_b))
    }

    /// What happened in a step, by the way, rad, its mean rates, and rates without the noise of counts, rad/s.
    fn step(
        &mut self,
        at: &Linkage<f64>,
        form: &Form<f64>,
        [by, mean, rates]: [Plane; 3],
        before: &Last,
    ) -> Step {
        let (momentum, motion) = balance::inertial(&self.inertias, at, form, mean);
        let (rows, mut load) = balance::rows_and_load(form, at, before.force_n);
        let (mut senses, mut open, mut bit) = ([[0.0; 3]; 4], 0, 1);
        let known = self
            .of
            .viscous_nm_s
            .iter()
            .zip(&self.of.dry_nm)
            .zip(&self.of.constant_nm);
        let brakes = self
            .brakings
            .iter_mut()
            .zip(self.braked)
            .zip(before.currents_a);
        let all = rows.iter().zip(brakes).zip(known).zip(&mut senses);
        for (((row, ((braking, braked), current_a)), ((viscous, dry), constant)), own) in all {
            let speed = row.dot(rates);
            let sense = if speed < 0.0 { -1.0 } else { 1.0 };
            let step_s = self.accuracy.step_s;
            let mut resists = viscous * row.dot(mean) + dry * sense + constant;
            let is_slow = speed.magnitude() < LEAST_RATE_RAD_S;
            let mut is_open = is_slow & (*dry != 0.0);
            if braked {
                let torque = braking.step(current_a, row.dot(by), speed, step_s);
                resists += sense * torque.yield_nm;
                is_open |= is_slow | torque.is_open;
                *own = [sense, sense * torque.driven_nm, sense * torque.slowness_nm];
            } else if !is_slow {
                *own = [sense, 0.0, 0.0];
            }
            load = load - *row * resists;
            open |= if is_open { bit } else { 0 };
            bit <<= 1;
        }
        Step {
            momentum,
            motion,
            load,
            rows,
            senses,
            open,
        }
    }

    /// Goes on with what a block left to do: its balances first, then a look at the numbers. A part of bounded work in every sample.
    fn go_on(&mut self) {
        match self.balancing.due(&self.accuracy) {
            Due::Row(Some(row)) => self.estimate.take(&row),
            Due::Row(None) => {}
            Due::End(has_rows) => self.estimate.end_block(has_rows),
            Due::Nothing => {
                if self.estimate.go_on()
                    && let Some(alarm) = self.judged()
                {
                    self.raise(alarm);
                }
            }
        }
    }

    /// The number that is surely outside its interval by most, or what else the balances do not agree with.
    fn judged(&self) -> Option<Alarm> {
        let ends = self.of.low.iter().zip(&self.of.high).zip(&self.of.levels);
        let all = Alarm::NUMBERS
            .into_iter()
            .zip(self.estimate.numbers())
            .zip(ends);
        let mut worst = (1.0, None);
        for ((alarm, number), ((low, high), level)) in all {
            // The square of its share of what is needed.
            let share = number.beyond_squared(*low, *high) / (level * level);
            if share > worst.0 {
                worst = (share, Some(alarm));
            }
        }
        let (_, number) = worst;
        let is_unlike = self.estimate.surprise() > self.of.surprise;
        number.or(is_unlike.then_some(Alarm::Motion))
    }
}

/// The inertias of the arms of both sides, and what the payload adds to those of A-E-D.
fn inertias(settings: &Settings, of: &Inertia) -> [[f64; 3]; 3] {
    let empty = Inertia {
        payload_kg: 0.0,
        ..*of
    };
    let [left, right] = Bodies::new(&settings.arms, &empty).sides();
    let [with, _] = Bodies::new(&settings.arms, of).sides();
    let mut payload = with;
    for (own, arms) in payload.iter_mut().zip(left) {
        *own -= arms;
    }
    [left, right, payload]
}

/// Samples after which a fault of a sensor is over by itself in a trial: the longest that is drawn, and the window of the velocity.
pub const LONGEST_FAULT: u32 = 40 + RECOVERY_SAMPLES as u32;
