//! This file is what the rig's left-out physics does: torques, yields and currents at an instant, and what it remembers.
#![expect(clippy::indexing_slicing, reason = "indices run over the four joints")]

use std::sync::Arc;

use nalgebra::Vector2;
use rigproof_spec::inertia::Inertia;
use rigproof_spec::joint::Joint;

use super::contact::Contact;
use super::effects::JointEffect;
use crate::effects::{CurrentPlay, Instant, Law, PLAYS, Played, lagged, limited};
use crate::motion::two_coordinate::TwoCoordinate;

/// The least yield of a joint with dry friction, N·m: what holds has to be able to let go.
const LEAST_NM: f64 = 1e-9;

/// The least distance of a tip from an anchor, m: below it a tension has no direction.
const LEAST_TETHER_M: f64 = 1e-9;

/// What a lag remembers before its brake had a torque, N·m: a yield torque is never below zero.
const NO_TORQUE_YET_NM: f64 = -1.0;

/// One effect as the rig computes it; `place` is the joint's in the order A, E, B, C.
pub enum Term {
    /// A resistance law of a joint; it may remember.
    Law { place: usize, law: Box<dyn Law> },
    /// A share of a brake's torque, as a law says; it may remember.
    Share { place: usize, law: Box<dyn Law> },
    /// A brake's torque, more by a share that stays.
    Gain { place: usize, fraction: f64 },
    /// A brake's torque, less by what it has heated up; remembers the heat, J.
    Fade {
        place: usize,
        per_joule: f64,
        cooling_s: f64,
    },
    /// A share of a brake's current is that of a play; where the play stands is remembered beside the numbers.
    Play {
        place: usize,
        share: f64,
        play: CurrentPlay,
    },
    /// A brake's current comes late.
    Late { place: usize, delay_s: f64 },
    /// A brake's current is limited: the limit, A, and how sharply it bends towards that.
    Limit { place: usize, numbers: [f64; 2] },
    /// A brake's current is another one.
    Amplifier { place: usize, times: f64 },
    /// A brake's time constants are others; remembers whether that has begun.
    Slower { place: usize, times: [f64; 2] },
    /// A brake's torque follows its own by a first-order lag; remembers it, N·m.
    Lag { place: usize, time_constant_s: f64 },
    /// Another backlash; remembers whether it has begun.
    Backlash { joint: Joint, width_rad: f64 },
    /// A brake's torque, more by the force on the tip with an arm.
    Load { place: usize, arm_m: f64 },
    /// A spring from the tip to a point of the plane.
    Anchor {
        stiffness_n_m: f64,
        tension_n: f64,
        anchor_m: [f64; 2],
    },
    /// Weight in the plane, m/s².
    Weight([f64; 2]),
    /// More masses; remembers whether they have begun.
    Masses(Inertia),
}

/// A term and when it begins, s.
pub struct Timed {
    pub term: Term,
    pub onset_s: f64,
}

/// The left-out physics of a rig and what it remembers: a number a term.
#[derive(Clone)]
pub struct LeftOut {
    given: Arc<[JointEffect]>,
    terms: Arc<[Timed]>,
    memory: Vec<f64>,
    /// Where the plays of the currents stand, A: some a term.
    played: Vec<Played>,
    /// What the brakes alone yielded when the memories were last advanced, N·m.
    own_before_nm: [f64; 4],
    /// What the brakes were commanded, A, and since when, s: as far back as the longest delay reaches.
    commands: Vec<(f64, [f64; 4])>,
    /// What is left of the step that is being made, s; 0 between two steps.
    ahead_s: f64,
}

impl PartialEq for LeftOut {
    fn eq(&self, other: &LeftOut) -> bool {
        self.given == other.given
            && self.memory == other.memory
            && self.played == other.played
            && self.own_before_nm == other.own_before_nm
            && self.commands == other.commands
    }
}

impl core::fmt::Debug for LeftOut {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("LeftOut")
            .field("given", &self.given)
            .field("memory", &self.memory)
            .finish_non_exhaustive()
    }
}

/// What the effects look at.
pub struct Situation<'a> {
    pub time_s: f64,
    pub form: &'a TwoCoordinate,
    pub tip_m: [f64; 2],
    pub inertia: &'a Inertia,
    pub contacts: [Contact; 4],
    pub angles_rad: [f64; 4],
    pub joint_rates_rad_s: [f64; 4],
    /// How far the joints have turned since the memories were last advanced, rad.
    pub travels_rad: [f64; 4],
    /// What the brakes alone would yield, N·m.
    pub own_nm: [f64; 4],
    /// The force on the tip, N.
    pub tip_force_n: [f64; 2],
}

/// What the effects do.
pub struct Done {
    /// On θA and θB, N·m.
    pub drive: Vector2<f64>,
    /// The yields of the joints, N·m.
    pub yields_nm: [f64; 4],
}

impl LeftOut {
    pub fn new(given: Vec<JointEffect>, terms: Arc<[Timed]>) -> LeftOut {
        let memory = terms.iter().map(|timed| match &timed.term {
            Term::Lag { .. } => NO_TORQUE_YET_NM,
            Term::Law { law, .. } | Term::Share { law, .. } => law.starts_with(),
            _ => 0.0,
        });
        LeftOut {
            given: Arc::from(given),
            memory: memory.collect(),
            played: vec![[0.0; PLAYS]; terms.len()],
            own_before_nm: [NO_TORQUE_YET_NM; 4],
            terms,
            commands: Vec::new(),
            ahead_s: 0.0,
        }
    }

    pub fn given(&self) -> &[JointEffect] {
        &self.given
    }

    pub fn term(&self, k: usize) -> Option<&Term> {
        self.terms.get(k).map(|timed| &timed.term)
    }

    /// The terms that change the rig itself, whose time has come and that have not begun.
    pub fn beginning(&self, time_s: f64) -> Vec<usize> {
        let pairs = self.terms.iter().zip(&self.memory).enumerate();
        let due = pairs.filter(|(_, (timed, memory))| {
            matches!(
                timed.term,
                Term::Backlash { .. } | Term::Slower { .. } | Term::Masses(_)
            ) && time_s >= timed.onset_s
                && **memory == 0.0
        });
        due.map(|(k, _)| k).collect()
    }

    pub fn has_begun(&mut self, k: usize) {
        if let Some(memory) = self.memory.get_mut(k) {
            *memory = 1.0;
        }
    }

    /// What the brakes get in a step when they are commanded these currents, A.
    pub fn currents(&mut self, commanded_a: [f64; 4], time_s: f64, step_s: f64) -> [f64; 4] {
        self.ahead_s = step_s;
        let first = self.commands.is_empty();
        if self
            .commands
            .last()
            .is_none_or(|(_, last)| *last != commanded_a)
        {
            self.commands.push((time_s, commanded_a));
        }
        let terms = Arc::clone(&self.terms);
        let mut longest_s = 0.0f64;
        let mut given_a = commanded_a;
        // A delay acts before the amplifier, that before a limit and that before the magnet, in whichever order they are given.
        for timed in terms.iter() {
            if let Term::Late { place, delay_s } = timed.term {
                longest_s = longest_s.max(delay_s);
                if time_s >= timed.onset_s {
                    given_a[place] = self.commanded(place, time_s - delay_s, step_s);
                }
            }
        }
        for timed in terms.iter() {
            if let Term::Amplifier { place, times } = timed.term
                && time_s >= timed.onset_s
            {
                given_a[place] *= times;
            }
        }
        for timed in terms.iter() {
            if let Term::Limit { place, numbers } = timed.term
                && time_s >= timed.onset_s
            {
                given_a[place] = limited(given_a[place], &numbers);
            }
        }
        for (timed, played) in terms.iter().zip(&mut self.played) {
            if let Term::Play { place, share, play } = timed.term {
                let now_a = given_a[place];
                let before = if first { [0.0; PLAYS] } else { *played };
                *played = play.moved(before, now_a);
                if time_s >= timed.onset_s {
                    given_a[place] += share * (play.held_a(played) - now_a);
                }
            }
        }
        let needed_s = time_s - longest_s;
        while matches!(self.commands.get(1), Some((since_s, _)) if *since_s <= needed_s) {
            self.commands.remove(0);
        }
        given_a
    }

    /// The mean of a commanded current from a time on, A; before the first command it was the first.
    fn commanded(&self, place: usize, from_s: f64, step_s: f64) -> f64 {
        let to_s = from_s + step_s;
        let ends = self.commands.iter().skip(1).map(|(since_s, _)| *since_s);
        let ends = ends.chain(core::iter::once(f64::INFINITY));
        let mut begin_s = f64::NEG_INFINITY;
        let mut sum = 0.0;
        for ((_, currents_a), end_s) in self.commands.iter().zip(ends) {
            let held_s = (end_s.min(to_s) - begin_s.max(from_s)).max(0.0);
            sum += currents_a[place] * held_s;
            begin_s = end_s;
        }
        sum / step_s
    }

    /// What the effects do at an instant.
    pub fn at(&self, now: &Situation<'_>) -> Done {
        let mut drive = Vector2::zeros();
        let mut more_nm = [0.0; 4];
        let mut shares = [1.0; 4];
        let mut own_nm = now.own_nm;
        for (timed, &memory) in self.terms.iter().zip(&self.memory) {
            if now.time_s < timed.onset_s {
                continue;
            }
            match &timed.term {
                Term::Law { place, law } | Term::Share { place, law } => {
                    let i = *place;
                    let instant = now.instant(i);
                    let memory = law.memory_after(memory, now.travels_rad[i], instant.speed);
                    let (smooth, dry) = law.parts(&instant, memory);
                    let of = match timed.term {
                        Term::Share { .. } => now.own_nm[i],
                        _ => 1.0,
                    };
                    drive -= now.form.joints.row(i).transpose() * (smooth * of);
                    more_nm[i] += dry * of;
                }
                Term::Gain { place, fraction } => shares[*place] += fraction,
                Term::Lag {
                    place,
                    time_constant_s,
                } if memory >= 0.0 => {
                    // Held over a step as it is in the middle of it, so that its mean is right.
                    let share = -libm::expm1(-0.5 * self.ahead_s / time_constant_s);
                    own_nm[*place] = memory + share * (now.own_nm[*place] - memory);
                }
                Term::Fade {
                    place, per_joule, ..
                } => shares[*place] -= per_joule * memory,
                Term::Load { place, arm_m } => {
                    let [x, y] = now.tip_force_n;
                    more_nm[*place] += arm_m * x.hypot(y);
                }
                Term::Anchor {
                    stiffness_n_m,
                    tension_n,
                    anchor_m: [anchor_x, anchor_y],
                } => {
                    let [x, y] = now.tip_m;
                    let away = [x - anchor_x, y - anchor_y];
                    let length = libm::hypot(away[0], away[1]).max(LEAST_TETHER_M);
                    let pull = tension_n / length - stiffness_n_m;
                    drive +=
                        now.form.tip.transpose() * Vector2::from(away.map(|along| pull * along));
                }
                Term::Weight(gravity) => {
                    let [theta_a, _, theta_b, _] = now.angles_rad;
                    drive += now.form.weight(now.inertia, [theta_a, theta_b], *gravity);
                }
                _ => {}
            }
        }
        let yields_nm = [0, 1, 2, 3].map(|i| match now.contacts[i] {
            Contact::Absent => 0.0,
            _ => (own_nm[i] * shares[i] + more_nm[i]).max(LEAST_NM),
        });
        Done { drive, yields_nm }
    }

    /// Advances what is remembered by a stretch in which the joints turned by `travels_rad`, known to be so where `told`, and the brakes
    /// alone yielded `own_nm`.
    pub fn follow(
        &mut self,
        travels_rad: [f64; 4],
        told: [bool; 4],
        own_nm: [f64; 4],
        step_s: f64,
    ) {
        self.ahead_s = (self.ahead_s - step_s).max(0.0);
        for (timed, memory) in self.terms.iter().zip(&mut self.memory) {
            match &timed.term {
                Term::Law { place, law } | Term::Share { place, law }
                    if told[*place] || !law.begins_anew() =>
                {
                    let travel = travels_rad[*place];
                    *memory = law.memory_after(*memory, travel, travel / step_s);
                }
                Term::Fade {
                    place, cooling_s, ..
                } => {
                    *memory *= libm::exp(-step_s / cooling_s);
                    *memory += own_nm[*place] * travels_rad[*place].abs();
                }
                Term::Lag {
                    place,
                    time_constant_s,
                } => {
                    let now_nm = own_nm[*place];
                    *memory = match *memory {
                        // Nothing is remembered yet.
                        memory if memory < 0.0 => now_nm,
                        memory => {
                            let ends_nm = [self.own_before_nm[*place], now_nm];
                            lagged(memory, ends_nm, step_s, *time_constant_s)
                        }
                    };
                }
                _ => {}
            }
        }
        self.own_before_nm = own_nm;
    }
}

impl Situation<'_> {
    fn instant(&self, i: usize) -> Instant {
        let speed = self.joint_rates_rad_s[i];
        Instant {
            time_s: self.time_s,
            position: self.angles_rad[i],
            speed,
            sense: match self.contacts[i] {
                Contact::Slips(sense) => sense,
                Contact::Held => 1.0,
                Contact::Absent => 1.0f64.copysign(speed),
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::effects::first_order_lag_straight;
    use crate::rig::{JointEffect, Rig};
    use rigproof_spec::effect::Mechanism;
    use rigproof_spec::joint::Joint;
    use rigproof_spec::layout::Layout;

    #[test]
    fn a_lag_is_one_of_the_effort_its_brakes_own_response_included() {
        let lag = JointEffect {
            mechanism: Mechanism::Lag,
            joint: Some(Joint::E),
            of_torque: false,
            parameters: vec![0.037],
            onset_s: None,
        };
        let led = |effects: &[JointEffect]| -> Vec<f64> {
            let rig = Rig::new(Layout::FourBrake, [0.037, 0.411]).unwrap();
            let mut rig = rig.with_effects(effects).unwrap();
            let [a, b] = rig.base_angles_rad();
            let steps = (0..900).map(|k| {
                let time_s = 1e-3 * f64::from(k);
                let to = [a + 0.31 * time_s, b - 0.23 * time_s];
                let current = if k / 200 % 2 == 0 { 0.43 } else { 0.07 };
                rig.lead(
                    to,
                    [0.31, -0.23],
                    [0.11, current, 0.13, 0.17],
                    [true; 4],
                    1e-3,
                )
                .unwrap();
                rig.yield_torques_nm()[1]
            });
            steps.collect()
        };
        let (own, late) = (led(&[]), led(&[lag]));
        let expected = first_order_lag_straight(&own, 1e-3, 0.037);
        let off = late.iter().zip(&expected).map(|(l, e)| (l - e).abs());
        assert!(off.fold(0.0, f64::max) < 1e-9);
        let moved = late.iter().zip(&own).map(|(l, o)| (l - o).abs());
        assert!(moved.fold(0.0, f64::max) > 0.1);
    }
}
