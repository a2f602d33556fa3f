//! This file moves the five-bar: Lagrange's equations in (θA, θB), with the dry friction of up to four joints as a set.
//!
//! A step is the midpoint rule, its middle extrapolated; friction is settled on the rates at the end (Moreau 1988, Jean 1999), so
//! that a joint that sticks stands, and one that slides is resisted.

use super::linkage::{Pair, Pose, dot, plus};
use super::mass::{Dynamics, weight};
use super::stick::{Contact, Motion};
use crate::brake::BrakeStep;
use crate::braked::Braked;
use crate::effect::Effect;
use crate::element::{Element, Instant};
use crate::form::{Form, Stage};
use rigproof_spec::geometry::{Arms, arms};
use rigproof_spec::inertia::{ArmInertia, Inertia, inertia};
use rigproof_spec::joint::Joint;
use rigproof_spec::layout::Layout;

/// A moment over which a bristle's rate is taken, s.
const MOMENT_S: f64 = 1e-7;

/// The rig with what is hidden in it.
#[derive(Clone, Debug)]
pub struct FiveBar {
    pub arms: Arms,
    inertia: Inertia,
    /// Gravity in the plane and springs to places in it, with their numbers.
    fields: Vec<(usize, Effect)>,
    joints: [At; 4],
    pub theta: Pair,
    pub rates: Pair,
    /// Of the last step, rad/s².
    pub acceleration: Pair,
    /// Direction of each joint, 0 where it sticks.
    pub signs: [f64; 4],
    pub pose: Pose,
    /// Work of the force on the tip, J.
    pub work_j: f64,
    /// What brakes and hidden effects took at the joints, J; springs and bristles give some back.
    pub taken_j: f64,
}

/// One joint: its brake, what is hidden there, and where it started.
#[derive(Clone, Debug)]
struct At {
    brake: Option<Braked>,
    /// Rate of the yield torque over the last step, N·m/s.
    yield_rate: f64,
    elements: Vec<(usize, Element)>,
    start_rad: f64,
    angle_rad: f64,
}

/// A step that may be taken.
struct Tried {
    motion: Motion,
    /// Share of the step after which the first sliding joint is at rest; 1 or more when none is.
    until_rest: f64,
    /// Single-valued and set-valued torques at the joints, N·m.
    torques: [f64; 4],
    bounds: [f64; 4],
    force_n: Pair,
}

/// Cuts a step can have.
const CUTS: usize = 4;
/// A rest this near to either end of a step is not worth a cut.
const LEAST_CUT: f64 = 0.01;

impl FiveBar {
    /// A rig at rest at θA and θB, rad; `None` where the arms do not meet.
    pub fn new(layout: Layout, theta: Pair, hidden: &[Effect]) -> Option<FiveBar> {
        let arms = true_arms(layout, hidden);
        let pose = Pose::at(&arms, theta)?;
        let numbered = || hidden.iter().copied().enumerate();
        let angles = pose.joint_angles_rad(theta);
        let mut angles = angles.into_iter();
        let joints = Joint::ALL.map(|joint| {
            let angle_rad = angles.next().unwrap_or_default();
            let here = |stage| {
                numbered().filter(move |(_, effect)| effect.is_at(joint) && effect.stage() == stage)
            };
            let brake = layout
                .brakes()
                .contains(&joint)
                .then(|| Braked::new(joint, here(Stage::Drive).collect(), angle_rad));
            At {
                yield_rate: 0.0,
                brake,
                elements: here(Stage::Joint)
                    .map(|(k, effect)| (k, Element::new(effect)))
                    .collect(),
                start_rad: angle_rad,
                angle_rad,
            }
        });
        Some(FiveBar {
            arms,
            inertia: true_inertia(layout, hidden),
            fields: numbered()
                .filter(|(_, effect)| effect.stage() == Stage::Field)
                .collect(),
            joints,
            theta,
            rates: [0.0; 2],
            acceleration: [0.0; 2],
            signs: [0.0; 4],
            pose,
            work_j: 0.0,
            taken_j: 0.0,
        })
    }

    /// Moves the rig under currents, A, and a force on the tip, N, that is asked for at a time, a tip position and a tip velocity, first
    /// at the middle of the step; `None` where the arms would not meet any more. A step in which a sliding joint comes to rest or turns
    /// round is cut there.
    pub fn step(
        &mut self,
        time_s: f64,
        step_s: f64,
        currents_a: [f64; 4],
        force: &mut impl FnMut(f64, Pair, Pair) -> Pair,
    ) -> Option<()> {
        let (mut time_s, mut left_s) = (time_s, step_s);
        for _ in 0..CUTS {
            let tried = self.try_step(time_s, left_s, force)?;
            if !(LEAST_CUT..1.0 - LEAST_CUT).contains(&tried.until_rest) {
                return self.take(tried, time_s, left_s, currents_a);
            }
            let part_s = tried.until_rest * left_s;
            let part = self.try_step(time_s, part_s, force)?;
            self.take(part, time_s, part_s, currents_a)?;
            (time_s, left_s) = (time_s + part_s, left_s - part_s);
        }
        let last = self.try_step(time_s, left_s, force)?;
        self.take(last, time_s, left_s, currents_a)
    }

    /// What a step would do.
    fn try_step(
        &self,
        time_s: f64,
        step_s: f64,
        force: &mut impl FnMut(f64, Pair, Pair) -> Pair,
    ) -> Option<Tried> {
        let half_s = 0.5 * step_s;
        let middle_s = time_s + half_s;
        let rates = plus(self.rates, half_s, self.acceleration);
        let theta = plus(self.theta, half_s, self.rates);
        let theta = plus(theta, 0.5 * half_s * half_s, self.acceleration);
        let middle = Pose::at(&self.arms, theta)?;
        // The rows at the end, as far beyond the middle as the middle is beyond the start.
        let mut end = middle.rows;
        for (row, start) in end.iter_mut().zip(self.pose.rows) {
            *row = plus(row.map(|x| 2.0 * x), -1.0, start);
        }
        let form = Dynamics::new(&self.arms, &self.inertia, &middle, rates);
        let velocity = middle.tip_velocity(&self.arms, rates);
        let force_n = force(middle_s, middle.tip_m, velocity);
        let mut pushed = middle.tip_force_along(&self.arms, force_n);
        for (_, field) in &self.fields {
            pushed = plus(pushed, 1.0, self.pull(field, middle_s, &middle));
        }
        let [fx, fy] = force_n;
        let load_n = fx.hypot(fy);
        let mut torques = [0.0; 4];
        let mut bounds = [0.0; 4];
        let each = self.joints.iter().zip(self.signs).zip(middle.rows);
        let out = torques.iter_mut().zip(&mut bounds);
        for (((joint, sign), row), (torque, bound)) in each.zip(out) {
            let sticks = sign == 0.0 && joint.is_frictional();
            let rate_rad_s = if sticks { 0.0 } else { dot(row, rates) };
            let at = joint.instant(middle_s, half_s * rate_rad_s, rate_rad_s, load_n);
            (*torque, *bound) = joint.resists(&at, half_s);
            pushed = plus(pushed, -*torque, row);
        }
        let momentum = plus(
            form.times(self.rates),
            step_s,
            plus(pushed, -1.0, form.bias),
        );
        let contact = Contact {
            form: &form,
            momentum,
            forces: middle.rows,
            rates: end,
            impulses: bounds.map(|bound| bound * step_s),
        };
        Some(Tried {
            motion: contact.settle(self.signs),
            until_rest: contact
                .until_rest(self.signs, self.pose.rows.map(|row| dot(row, self.rates))),
            torques,
            bounds,
            force_n,
        })
    }

    /// Does what was tried.
    fn take(&mut self, tried: Tried, time_s: f64, step_s: f64, currents_a: [f64; 4]) -> Option<()> {
        let Tried {
            motion,
            torques,
            bounds,
            force_n,
            ..
        } = tried;
        let theta = plus(
            self.theta,
            0.5 * step_s,
            plus(self.rates, 1.0, motion.rates),
        );
        let pose = Pose::at(&self.arms, theta)?;
        self.work_j += dot(force_n, plus(pose.tip_m, -1.0, self.pose.tip_m));
        self.acceleration = plus(motion.rates, -1.0, self.rates).map(|x| x / step_s);
        (self.theta, self.rates, self.pose, self.signs) = (theta, motion.rates, pose, motion.signs);
        let [fx, fy] = force_n;
        let travels = self.turn_joints(time_s + step_s, step_s, currents_a, fx.hypot(fy));
        let each = torques.into_iter().zip(bounds).zip(self.signs).zip(travels);
        self.taken_j += each
            .map(|(((torque, bound), sign), travel)| (torque + bound * sign) * travel)
            .sum::<f64>();
        Some(())
    }

    /// Brakes and memories after a step that ends at `time_s`; returns how far each joint turned.
    fn turn_joints(
        &mut self,
        time_s: f64,
        step_s: f64,
        currents_a: [f64; 4],
        load_n: f64,
    ) -> [f64; 4] {
        let angles = self.pose.joint_angles_rad(self.theta);
        let rates = self.joint_rates();
        let mut travels = [0.0; 4];
        let each = self
            .joints
            .iter_mut()
            .zip(angles)
            .zip(rates)
            .zip(currents_a);
        for ((((joint, angle_rad), rate_rad_s), current_a), travel) in each.zip(&mut travels) {
            *travel = angle_rad - joint.angle_rad;
            let at = joint.instant(time_s, 0.0, rate_rad_s, load_n);
            for (_, element) in &mut joint.elements {
                element.advance(&at, *travel, step_s);
            }
            joint.angle_rad = angle_rad;
            if let Some(brake) = &mut joint.brake {
                let before_nm = brake.yield_nm();
                let step = BrakeStep {
                    step_s,
                    current_a,
                    position_rad: angle_rad,
                    speed_rad_s: rate_rad_s,
                };
                brake.step(time_s, &step);
                joint.yield_rate = (brake.yield_nm() - before_nm) / step_s;
            }
        }
        travels
    }

    /// Rates of the joints A, E, B, C, rad/s; exactly 0 where one sticks.
    pub fn joint_rates(&self) -> [f64; 4] {
        let mut rates = self.pose.rows.map(|row| dot(row, self.rates));
        for ((rate, sign), joint) in rates.iter_mut().zip(self.signs).zip(&self.joints) {
            if sign == 0.0 && joint.is_frictional() {
                *rate = 0.0;
            }
        }
        rates
    }

    /// Which joints stick.
    pub fn stuck(&self) -> [bool; 4] {
        let mut stuck = self.signs.map(|sign| sign == 0.0);
        for (stuck, joint) in stuck.iter_mut().zip(&self.joints) {
            *stuck &= joint.is_frictional();
        }
        stuck
    }

    /// Nominal yield torques, N·m, in the order A, E, B, C.
    pub fn nominal_yields_nm(&self) -> [f64; 4] {
        let [a, e, b, c] = &self.joints;
        [a, e, b, c].map(|joint| joint.brake.as_ref().map_or(0.0, Braked::nominal_yield_nm))
    }

    /// What each effect in the machine resists with along θA and θB, N·m, by its number; nothing at joints that stick.
    pub fn hidden_nm(&self, time_s: f64, load_n: f64, hidden: &mut [Pair]) {
        hidden.fill([0.0; 2]);
        let mut add = |number: usize, torque_nm: f64, row: Pair| {
            if let Some(force) = hidden.get_mut(number) {
                *force = plus(*force, torque_nm, row);
            }
        };
        for (number, field) in &self.fields {
            add(*number, -1.0, self.pull(field, time_s, &self.pose));
        }
        let rates = self.joint_rates();
        for ((joint, rate_rad_s), row) in self.joints.iter().zip(rates).zip(self.pose.rows) {
            if rate_rad_s == 0.0 {
                continue;
            }
            let sign = rate_rad_s.signum();
            let at = joint.instant(time_s, 0.0, rate_rad_s, load_n);
            for (number, element) in &joint.elements {
                let travel = MOMENT_S * rate_rad_s;
                let torque_nm = element.force(&at, travel, MOMENT_S) + sign * element.bound(&at);
                add(*number, torque_nm, row);
            }
            for (number, more_nm) in joint.brake.iter().flat_map(Braked::added_nm) {
                add(number, sign * more_nm, row);
            }
        }
    }

    /// What a field does along θA and θB, N·m.
    fn pull(&self, field: &Effect, time_s: f64, pose: &Pose) -> Pair {
        let [a, b, c, rest_m] = field.values;
        match field.form {
            _ if !field.acts(time_s) => [0.0; 2],
            Form::Gravity => weight(&self.arms, &self.inertia, pose, [a, b]),
            _ => {
                let away = plus(pose.tip_m, -1.0, [b, c]);
                let length_m = dot(away, away).sqrt().max(1e-9);
                let force_n = away.map(|x| -a * (length_m - rest_m) * x / length_m);
                pose.tip_force_along(&self.arms, force_n)
            }
        }
    }
}

impl At {
    fn instant(&self, time_s: f64, ahead_rad: f64, rate_rad_s: f64, load_n: f64) -> Instant {
        Instant {
            time_s,
            position: self.angle_rad - self.start_rad + ahead_rad,
            velocity: rate_rad_s,
            direction: rate_rad_s.signum(),
            load: load_n,
            brake: self.brake.as_ref().map_or(0.0, Braked::yield_nm),
        }
    }

    /// Single-valued and set-valued torque half a step ahead, N·m; the yield torque by extrapolation.
    fn resists(&self, at: &Instant, half_s: f64) -> (f64, f64) {
        let travel = half_s * at.velocity;
        let yield_nm = self.brake.as_ref().map_or(0.0, |brake| {
            (brake.yield_nm() + half_s * self.yield_rate).max(0.0)
        });
        let elements = self.elements.iter().map(|(_, element)| element);
        let (torque, bound) = elements.fold((0.0, yield_nm), |(torque, bound), element| {
            (
                torque + element.force(at, travel, half_s),
                bound + element.bound(at),
            )
        });
        (torque, bound.max(0.0))
    }

    fn is_frictional(&self) -> bool {
        let mut elements = self.elements.iter();
        self.brake.is_some() || elements.any(|(_, element)| element.is_frictional())
    }
}

/// Table 4.1 with the hidden lengths: of AE at A, of ED at E, of BC at B, of CD at C.
fn true_arms(layout: Layout, hidden: &[Effect]) -> Arms {
    let mut arms = arms(layout);
    for effect in hidden
        .iter()
        .filter(|effect| effect.form == Form::LinkLength)
    {
        let [ae, ed, bc, cd] = Joint::ALL.map(|joint| match effect.is_at(joint) {
            true => effect.first(),
            false => 0.0,
        });
        arms.l_ae_m += ae;
        arms.l_ed_m += ed;
        arms.l_bc_m += bc;
        arms.l_cd_m += cd;
    }
    arms
}

/// Table 5.1 with the hidden masses.
fn true_inertia(layout: Layout, hidden: &[Effect]) -> Inertia {
    let mut inertia = inertia(layout);
    for effect in hidden {
        let amount = effect.first();
        match effect.form {
            Form::Payload => inertia.payload_kg += amount,
            Form::Inertia => {
                let scaled = |arm: ArmInertia| ArmInertia {
                    mass_kg: (1.0 + amount) * arm.mass_kg,
                    inertia_kg_m2: (1.0 + amount) * arm.inertia_kg_m2,
                    centre_m: arm.centre_m,
                };
                inertia.ae = scaled(inertia.ae);
                inertia.ed = scaled(inertia.ed);
                inertia.bc = scaled(inertia.bc);
                inertia.cd = scaled(inertia.cd);
            }
            _ => {}
        }
    }
    inertia
}
