//! This file is one step of the plant.

use rigproof_spec::joint::Joint;

use super::Plant;
use super::brake::Turn;
use super::current::CurrentPath;
use super::effect::{Effect, Instant};
use super::form::{joint_rows, tip_load};
use super::friction::{Contact, Dry, DryBrake, dry_motion, standing};
use super::motion::{Midway, Motion, Outcome, is_defined};
use super::setup::elbows;
use super::turn::{angles_between, is_small};
use crate::linkage::Linkage;
use crate::vector::Vector;

type Plane = Vector<f64>;

/// The joints at the moment at which the forces are looked at.
#[derive(Clone, Copy)]
struct Look {
    angles_rad: [f64; 4],
    elbows: [Plane; 2],
    rates_rad_s: [f64; 4],
    rows: [Plane; 4],
}

/// What resists in a step.
struct Resistance {
    /// The mean of every brake's yield torque, N·m; 0 without a brake.
    yields_nm: [f64; 4],
    /// What other dry friction adds to the yield, N·m.
    dry_nm: [f64; 4],
    /// What else resists, on the coordinates, N·m.
    smooth_nm: Plane,
}

impl Plant {
    /// Advances by `step_s`, at most [`GREATEST_STEP_S`](super::motion::GREATEST_STEP_S), under a constant force on the tip, x and y,
    /// N, and constant currents A, E, B, C, A: 0 to 1, and 0 where there is no brake.
    ///
    /// M·v⁺ = M·v + h·(Tᵀ·F − b) + Σ Gᵢᵀ·λᵢ with everything at the moment of [`Scheme`](super::Scheme), each brake's impulse λᵢ bounded by h
    /// times the mean of its yield torque and opposed to its joint's rate at the end of the step, so that no brake drives.
    //= thesis (5.40)
    pub fn step(&mut self, tip_force_n: [f64; 2], currents_a: [f64; 4], step_s: f64) -> Outcome {
        let force_n = Vector::from(tip_force_n);
        if !is_defined(force_n, step_s) || !self.takes(currents_a) {
            return Outcome::Undefined;
        }
        if self.stays(force_n, currents_a, step_s) {
            return Outcome::Moved;
        }
        let midway = self.motion.midway(&self.mechanism, force_n, step_s);
        let first = self
            .motion
            .checks(&self.mechanism, &midway.linkage, midway.lead_s);
        let outcome = first.outcome();
        if outcome != Outcome::Moved {
            return outcome;
        }
        let rows = midway.form.joint_rows();
        let Some(look) = self.look(&midway.linkage, midway.theta_rad, midway.rates_rad_s, rows)
        else {
            return Outcome::TooFast;
        };
        let brakes = self.brakes;
        let resistance = self.resistance(&look, currents_a, midway.lead_s, step_s);
        let dry = self.dry(&midway, &look, &resistance, step_s);
        let mut next = self
            .motion
            .arrive(&self.mechanism, &midway, dry.rates_rad_s, step_s);
        let second = next.checks(&self.mechanism, &next.linkage, step_s - midway.lead_s);
        let outcome = second.outcome();
        if outcome != Outcome::Moved {
            self.brakes = brakes;
            return outcome;
        }
        if dry.contact == Contact::Rest {
            // Nothing is foreseen to move on from rest.
            next.accelerations_rad_s2 = Vector::zero();
        }
        if self.has_effects() {
            self.remember(look, dry.rates_rad_s, step_s);
        }
        self.motion = next;
        self.take_on(&look, &resistance, &dry, midway.lead_s, step_s);
        if self.paths.is_some() {
            self.pass_on(currents_a, step_s);
        }
        Outcome::Moved
    }

    /// Takes the step if the linkage stands and the brakes hold it: nothing moves but they, and no other force needs to be known.
    #[inline]
    fn stays(&mut self, force_n: Plane, currents_a: [f64; 4], step_s: f64) -> bool {
        let Motion {
            theta_rad,
            rates_rad_s,
            accelerations_rad_s2,
            linkage,
            ..
        } = self.motion;
        let none = Vector::zero();
        if rates_rad_s != none || accelerations_rad_s2 != none {
            return false;
        }
        let [left, right] = linkage.turning();
        let lead_s = step_s * self.mechanism.scheme.lead::<f64>();
        let Some(look) = self.look(&linkage, theta_rad, none, joint_rows(left, right)) else {
            return false;
        };
        let brakes = self.brakes;
        let resistance = self.resistance(&look, currents_a, lead_s, step_s);
        let bounds = resistance.yields_nm.iter().zip(&resistance.dry_nm);
        let mut holding = [DryBrake::absent(); 4];
        for (brake, (row, (yield_nm, dry_nm))) in
            holding.iter_mut().zip(look.rows.iter().zip(bounds))
        {
            (brake.force_row, brake.rate_row) = (*row, *row);
            brake.bound = (yield_nm + dry_nm) * step_s;
        }
        let load_nm = tip_load(left, &linkage, force_n) - resistance.smooth_nm;
        let Some(dry) = standing(load_nm * step_s, &holding) else {
            self.brakes = brakes;
            return false;
        };
        if self.has_effects() {
            self.remember(look, none, step_s);
        }
        self.take_on(&look, &resistance, &dry, lead_s, step_s);
        if self.paths.is_some() {
            self.pass_on(currents_a, step_s);
        }
        true
    }

    /// Keeps what was seen and done in a step.
    #[inline(always)]
    fn take_on(
        &mut self,
        look: &Look,
        resistance: &Resistance,
        dry: &Dry,
        lead_s: f64,
        step_s: f64,
    ) {
        self.looked_rad = look.angles_rad;
        self.elbows = look.elbows;
        self.since_look_s = step_s - lead_s;
        self.contact = dry.contact;
        self.held = dry.held;
        self.time_s += step_s;
        let per_s = 1.0 / (step_s * dry.part);
        self.torques_nm = dry.impulses.map(|impulse| impulse * per_s);
        if self.has_effects() {
            // The rest is that of the other dry friction.
            let shares = resistance.yields_nm.iter().zip(resistance.dry_nm);
            for (torque_nm, (yield_nm, dry_nm)) in self.torques_nm.iter_mut().zip(shares) {
                let bound_nm = yield_nm + dry_nm;
                *torque_nm *= if dry_nm == 0.0 {
                    1.0
                } else if bound_nm > 0.0 {
                    yield_nm / bound_nm
                } else {
                    0.0
                };
            }
        }
    }

    /// Moves what lies between the currents that are asked for, A, and the brakes' over a step.
    #[inline(never)]
    fn pass_on(&mut self, currents_a: [f64; 4], step_s: f64) {
        if let Some(paths) = &mut self.paths {
            for (path, current_a) in paths.iter_mut().zip(currents_a) {
                path.step(current_a, step_s);
            }
        }
    }

    #[inline]
    fn takes(&self, currents_a: [f64; 4]) -> bool {
        let [a, e, b, c] = currents_a;
        let [most_a, most_e, most_b, most_c] = self.greatest_a;
        let within = |current_a: f64, most_a: f64| (current_a >= 0.0) & (current_a <= most_a);
        within(a, most_a) & within(e, most_e) & within(b, most_b) & within(c, most_c)
    }

    #[inline]
    fn has_effects(&self) -> bool {
        let [first, ..] = &self.effects;
        first.is_some()
    }

    /// The joints halfway; none where an elbow turned further than can be computed.
    #[inline(always)]
    fn look(
        &self,
        linkage: &Linkage<f64>,
        theta: Plane,
        rates_rad_s: Plane,
        rows: [Plane; 4],
    ) -> Option<Look> {
        let elbows = elbows(linkage);
        let [from_e, from_c] = self.elbows;
        let by_rad = if elbows == self.elbows {
            // At rest nothing turns, and no quotient has to tell so.
            [0.0; 2]
        } else {
            let [to_e, to_c] = elbows;
            if !is_small(from_e, to_e) || !is_small(from_c, to_c) {
                return None;
            }
            angles_between(self.elbows, elbows)
        };
        let ([_, e, _, c], [by_e, by_c]) = (self.looked_rad, by_rad);
        Some(Look {
            angles_rad: [theta.x, e + by_e, theta.y, c + by_c],
            elbows,
            rates_rad_s: joint_rates(&rows, rates_rad_s),
            rows,
        })
    }

    /// What resists; the brakes go on by a step.
    #[inline(always)]
    fn resistance(
        &mut self,
        look: &Look,
        currents_a: [f64; 4],
        lead_s: f64,
        step_s: f64,
    ) -> Resistance {
        let mut resistance = Resistance {
            yields_nm: [0.0; 4],
            dry_nm: [0.0; 4],
            smooth_nm: Vector::zero(),
        };
        let around_s = [self.since_look_s, lead_s];
        let currents_a = match &self.paths {
            None => currents_a,
            Some(paths) => arriving_a(paths, currents_a, step_s),
        };
        let ways = self.looked_rad.iter().zip(&look.angles_rad);
        let turns = ways.zip(&look.rates_rad_s).zip(&currents_a);
        let brakes = self.brakes.iter_mut().zip(&self.characteristics);
        let each = brakes.zip(turns).zip(&mut resistance.yields_nm);
        for (((brake, of), (((from_rad, to_rad), speed_rad_s), current_a)), yield_nm) in each {
            if let Some(of) = of {
                let turn = Turn {
                    way_rad: [*from_rad, *to_rad],
                    around_s,
                    speed_rad_s: *speed_rad_s,
                    step_s,
                };
                *yield_nm = brake.step(of, *current_a, &turn);
            }
        }
        if self.has_effects() {
            return self.with_effects(resistance, *look, lead_s, step_s);
        }
        resistance
    }

    /// With what the effects add. Kept apart and told everything by value, so that a step without effects need not keep it in memory.
    #[inline(never)]
    fn with_effects(
        &self,
        mut sum: Resistance,
        look: Look,
        lead_s: f64,
        step_s: f64,
    ) -> Resistance {
        for Effect { joint, law, memory } in self.effects.iter().map_while(Option::as_ref) {
            let (position, speed, row) = at(&look, *joint);
            let brake_nm = sum.yields_nm.get(*joint as usize).copied();
            let now = Instant {
                time_s: self.time_s + lead_s,
                position,
                speed,
                // At rest the two breakaway levels differ by what depends on the sense: either sense shifts both.
                sense: if speed < 0.0 { -1.0 } else { 1.0 },
                brake_nm: brake_nm.unwrap_or(0.0),
            };
            let [_, halfway] = law.remember(*memory, speed, step_s);
            sum.smooth_nm = sum.smooth_nm + row * law.smooth(&now, halfway);
            if let Some(dry_nm) = sum.dry_nm.get_mut(*joint as usize) {
                *dry_nm += law.dry(&now, halfway);
            }
        }
        for (dry_nm, yield_nm) in sum.dry_nm.iter_mut().zip(sum.yields_nm) {
            // Dry friction below zero takes from the brake's, and no more than that.
            *dry_nm = if *dry_nm < -yield_nm {
                -yield_nm
            } else {
                *dry_nm
            };
        }
        sum
    }

    /// The rates after the step and what the brakes did for them.
    #[inline]
    fn dry(&self, midway: &Midway<f64>, look: &Look, resistance: &Resistance, step_s: f64) -> Dry {
        let (lead_s, v) = (midway.lead_s, self.motion.rates_rad_s);
        let start = midway.form.joint_rows_ahead(-lead_s);
        let start = joint_rates(&start, v);
        let end = midway.form.joint_rows_ahead(lead_s);
        let ends = start.iter().zip(&end);
        let bounds = resistance.yields_nm.iter().zip(&resistance.dry_nm);
        let mut brakes = [DryBrake::absent(); 4];
        let rows = look.rows.iter().zip(ends).zip(bounds);
        for (brake, ((force_row, (start_rad_s, rate_row)), (yield_nm, dry_nm))) in
            brakes.iter_mut().zip(rows)
        {
            *brake = DryBrake {
                force_row: *force_row,
                rate_row: *rate_row,
                bound: (yield_nm + dry_nm) * step_s,
                start_rad_s: *start_rad_s,
            };
        }
        let impulse = (midway.load_nm - resistance.smooth_nm) * step_s;
        dry_motion(
            &midway.form.mass,
            midway.momentum_nm_s,
            impulse,
            &brakes,
            self.contact,
        )
    }

    /// Moves the memories of the effects over a step in which the rates became new ones, rad/s.
    #[inline(never)]
    fn remember(&mut self, look: Look, rates_rad_s: Plane, step_s: f64) {
        let mean = (self.motion.rates_rad_s + rates_rad_s) * 0.5;
        for Effect { joint, law, memory } in self.effects.iter_mut().map_while(Option::as_mut) {
            let (_, _, row) = at(&look, *joint);
            [*memory, _] = law.remember(*memory, row.dot(mean), step_s);
        }
    }
}

/// The currents that the brakes have over a step, A.
#[inline(never)]
fn arriving_a(paths: &[CurrentPath; 4], mut currents_a: [f64; 4], step_s: f64) -> [f64; 4] {
    for (current_a, path) in currents_a.iter_mut().zip(paths) {
        *current_a = path.clone().step(*current_a, step_s);
    }
    currents_a
}

/// The rates of A, E, B and C, of which A's and B's are those of the coordinates.
#[inline]
fn joint_rates([_, e, _, c]: &[Plane; 4], rates: Plane) -> [f64; 4] {
    [rates.x, e.dot(rates), rates.y, c.dot(rates)]
}

/// Angle, rate and row of a joint.
#[inline]
fn at(look: &Look, joint: Joint) -> (f64, f64, Plane) {
    let [a, e, b, c] = look.angles_rad;
    let [rate_a, rate_e, rate_b, rate_c] = look.rates_rad_s;
    let [row_a, row_e, row_b, row_c] = look.rows;
    match joint {
        Joint::A => (a, rate_a, row_a),
        Joint::E => (e, rate_e, row_e),
        Joint::B => (b, rate_b, row_b),
        Joint::C => (c, rate_c, row_c),
    }
}
