//! This file balances impulse and momentum over windows, and says what each number of the certificate would add.
//!
//! With a weight φ that rises over one block and falls over the next, −∫φ̇·M·v = ∫φ·(∂T/∂q + Tᵀ·F − Gᵀ·τ): the momentum is asked
//! for in the mean, so that nothing is differentiated twice and the quantum of a count is divided by a block.

use super::constants::NUMBERS;
use super::information::Row;
use crate::linkage::Linkage;
use crate::plant::form::{Form, Mass, joint_rows, tip_load};
use crate::vector::Vector;

type Plane = Vector<f64>;

/// Steps of a block: 32 ms at 1 kHz. The quantum of a count weighs with the inverse square of it (0.015 N·m at 0.35 kg·m²), and a reversal costs
/// two blocks: of 64 a third fewer could be used.
pub const BLOCK: u32 = 32;

/// What happens in a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// Momentum of the arms of the sides A-E-D and B-C-D and of the payload, N·m·s.
    pub momentum: [Plane; 3],
    /// What their motion makes of it, N·m.
    pub motion: [Plane; 3],
    /// The hand's torque less what resists, N·m.
    pub load: Plane,
    /// How fast the joints A, E, B, C turn by the coordinates.
    pub rows: [Plane; 4],
    /// The senses of the joints, their driven torque and its slowness, each with its sense, N·m.
    pub senses: [[f64; 3]; 4],
    /// The joints of which it cannot be told what resists, a bit each.
    pub open: u8,
}

/// A sum, and the sum with a weight that rises from 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Weighed {
    all: Plane,
    risen: Plane,
}

impl Weighed {
    const NONE: Weighed = Weighed {
        all: Vector { x: 0.0, y: 0.0 },
        risen: Vector { x: 0.0, y: 0.0 },
    };

    #[inline(always)]
    fn add(&mut self, value: Plane, weight: f64) {
        self.all = self.all + value;
        self.risen = self.risen + value * weight;
    }

    /// The weight rises over this block and falls over the next.
    #[inline(always)]
    fn with(&self, next: &Weighed) -> Plane {
        self.risen + (next.all - next.risen)
    }
}

/// The sums of a block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Block {
    momentum: [Plane; 3],
    motion: [Weighed; 3],
    load: Weighed,
    /// Of every joint: sense, driven torque, slowness.
    joints: [[Weighed; 3]; 4],
    open: u8,
    rows: [Plane; 4],
    steps: u32,
}

impl Block {
    /// Nothing yet.
    pub const NONE: Block = {
        let none = Vector { x: 0.0, y: 0.0 };
        Block {
            momentum: [none; 3],
            motion: [Weighed::NONE; 3],
            load: Weighed::NONE,
            joints: [[Weighed::NONE; 3]; 4],
            open: 0,
            rows: [none; 4],
            steps: 0,
        }
    };

    /// Whether it has all its steps.
    pub fn is_whole(&self) -> bool {
        self.steps >= BLOCK
    }

    /// Adds a step.
    #[inline]
    pub fn add(&mut self, step: &Step) {
        let weight = (f64::from(self.steps) + 0.5) * (1.0 / f64::from(BLOCK));
        self.steps = self.steps.saturating_add(1);
        for (sum, own) in self.momentum.iter_mut().zip(step.momentum) {
            *sum = *sum + own;
        }
        for (sum, own) in self.motion.iter_mut().zip(step.motion) {
            sum.add(own, weight);
        }
        self.load.add(step.load, weight);
        let joints = self.joints.iter_mut().zip(step.rows).zip(step.senses);
        for ((sums, row), senses) in joints {
            for (sum, size) in sums.iter_mut().zip(senses) {
                sum.add(row * size, weight);
            }
        }
        self.open |= step.open;
        self.rows = step.rows;
    }
}

/// How exact a balance is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Accuracy {
    /// Time of a step, s.
    pub step_s: f64,
    /// Standard deviation of an angle of A and B, rad.
    pub angle_rad: [f64; 2],
    /// Share of an inertial impulse, and of an impulse of the brakes, that the model may miss.
    pub missed_share: [f64; 2],
}

/// What the end of a block left to do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Due {
    /// A balance; none where not everything that resists is known along it.
    Row(Option<Row>),
    /// The block's balances are done: whether it had any.
    End(bool),
    /// Nothing.
    Nothing,
}

/// The block at work, the two before it, and how much of their balances is done.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Balancing {
    /// The third is at work.
    blocks: [Block; 3],
    /// The inertia at the end of the second.
    mass: Mass<f64>,
    /// Directions in which they are still to be balanced.
    along: [Option<Plane>; 2],
    is_due: [bool; 3],
}

impl Balancing {
    /// Nothing yet.
    pub const NONE: Balancing = Balancing {
        blocks: [Block::NONE; 3],
        mass: Mass {
            aa: 0.0,
            ab: 0.0,
            bb: 0.0,
        },
        along: [None; 2],
        is_due: [false; 3],
    };

    /// Samples are missing: what was begun is not gone on with.
    pub fn lose(&mut self) {
        *self = Balancing::NONE;
    }

    /// Adds a step. Where that ends a block after a whole one, both are to be balanced.
    #[inline]
    pub fn add(&mut self, step: &Step, form: &Form<f64>) {
        let [_, _, current] = &mut self.blocks;
        current.add(step);
        if !current.is_whole() {
            return;
        }
        let [_, first, second] = self.blocks;
        self.blocks = [first, second, Block::NONE];
        if first.is_whole() {
            self.mass = form.mass;
            self.along = known(&first, &second);
            self.is_due = [true; 3];
        }
    }

    /// One of the things to do: first the balances in both directions, then the end of the block.
    pub fn due(&mut self, of: &Accuracy) -> Due {
        let [first, second, _] = &self.blocks;
        let both = Both {
            first,
            second,
            mass: &self.mass,
            of,
        };
        let row = |along: Option<Plane>| Due::Row(along.map(|along| both.row(along)));
        let [x, y] = self.along;
        match &mut self.is_due {
            [due @ true, _, _] => {
                *due = false;
                row(x)
            }
            [_, due @ true, _] => {
                *due = false;
                row(y)
            }
            [_, _, due @ true] => {
                *due = false;
                Due::End(x.is_some() || y.is_some())
            }
            _ => Due::Nothing,
        }
    }
}

/// The directions in which everything that resists in two blocks is known: two, one or none.
fn known(first: &Block, second: &Block) -> [Option<Plane>; 2] {
    let (x, y) = (Vector::new(1.0, 0.0), Vector::new(0.0, 1.0));
    let open = first.open | second.open;
    match open {
        0 => [Some(x), Some(y)],
        0b0001 => [None, Some(y)],
        0b0100 => [Some(x), None],
        0b0010 | 0b1000 => [across(first, open), None],
        _ => [None; 2],
    }
}

/// The direction in which a joint that is open has no grip, of length one.
fn across(first: &Block, open: u8) -> Option<Plane> {
    let [_, e, _, c] = first.rows;
    let row = if open == 0b0010 { e } else { c };
    let size = row.norm_squared();
    (size > 1e-12).then(|| row.left() * (1.0 / libm::sqrt(size)))
}

struct Both<'a> {
    first: &'a Block,
    second: &'a Block,
    mass: &'a Mass<f64>,
    of: &'a Accuracy,
}

impl Both<'_> {
    /// The balance along a direction.
    fn row(&self, along: Plane) -> Row {
        let Both {
            first, second, of, ..
        } = *self;
        let per_block = 1.0 / f64::from(BLOCK);
        let sides = first.momentum.iter().zip(&second.momentum);
        let motions = first.motion.iter().zip(&second.motion);
        let mut inertial = [0.0; 3];
        for ((own, (up, down)), (rising, falling)) in inertial.iter_mut().zip(sides).zip(motions) {
            let change = (*down - *up) * per_block;
            *own = along.dot(change - rising.with(falling) * of.step_s);
        }
        let load = along.dot(first.load.with(&second.load)) * of.step_s;
        let [left, right, payload] = inertial;
        let mut row = Row {
            left: load - left - right - payload,
            of: [0.0; NUMBERS],
            variance: 0.0,
        };
        let mut braked = 0.0;
        let (gains, rest) = row.of.split_at_mut(4);
        let (levels, rest) = rest.split_at_mut(4);
        let (biases, rest) = rest.split_at_mut(2);
        let (slow, masses) = rest.split_at_mut(4);
        let joints = first.joints.iter().zip(&second.joints);
        let places = gains.iter_mut().zip(levels).zip(slow);
        for (((gain, level), slow), (one, other)) in places.zip(joints) {
            let [senses, driven, slowness] = one;
            let [senses_of, driven_of, slowness_of] = other;
            let sum = |up: &Weighed, down: &Weighed| along.dot(up.with(down)) * of.step_s;
            *level = sum(senses, senses_of);
            *gain = sum(driven, driven_of);
            *slow = sum(slowness, slowness_of);
            braked += gain.abs();
        }
        let time_s = f64::from(BLOCK) * of.step_s;
        for (bias, part) in biases.iter_mut().zip([along.x, along.y]) {
            *bias = part * time_s;
        }
        for (mass, own) in masses.iter_mut().zip(inertial) {
            *mass = own;
        }
        row.variance = self.variance(along, left.abs() + right.abs() + payload.abs(), braked);
        row
    }

    /// The variance of a balance: of the six counts at its ends and in its middle, and of what the model misses.
    fn variance(&self, along: Plane, inertial: f64, braked: f64) -> f64 {
        let of = self.of;
        let [angle_a, angle_b] = of.angle_rad;
        let [of_inertia, of_brakes] = of.missed_share;
        let heavy = self.mass.times(along);
        let per_s = 1.0 / (f64::from(BLOCK) * of.step_s);
        // The middle counts twice: 1 + 4 + 1.
        let counts = 6.0 * per_s * per_s;
        let (a, b) = (heavy.x * angle_a, heavy.y * angle_b);
        let (missed_i, missed_b) = (of_inertia * inertial, of_brakes * braked);
        counts * (a * a + b * b) + missed_i * missed_i + missed_b * missed_b
    }
}

/// Momentum of the arms of both sides and of the payload, and what their motion makes of it: M·v and ∂T/∂q, at rates, rad/s.
#[inline(always)]
pub fn inertial(
    bodies: &[[f64; 3]; 3],
    at: &Linkage<f64>,
    form: &Form<f64>,
    rates: Plane,
) -> ([Plane; 3], [Plane; 3]) {
    let [left, right] = form.turning;
    let [left_rate, right_rate] = form.turning_rate;
    let [of_left, of_right, of_payload] = bodies;
    let (x, y) = (Vector::new(1.0, 0.0), Vector::new(0.0, 1.0));
    let (p_left, c_left) = side(of_left, [at.ae, at.ed], [x, left, left_rate], rates);
    let (p_right, c_right) = side(of_right, [at.bc, at.cd], [y, right, right_rate], rates);
    let carried = [x, left, left_rate];
    let (p_payload, c_payload) = side(of_payload, [at.ae, at.ed], carried, rates);
    ([p_left, p_right, p_payload], [c_left, c_right, c_payload])
}

/// Of one side: its base arm and outer arm, the directions of its coordinate, of the outer arm's turning and how that changes.
#[inline(always)]
fn side(
    [base, carried, outer]: &[f64; 3],
    [inner_m, outer_m]: [Plane; 2],
    [own, row, row_rate]: [Plane; 3],
    rates: Plane,
) -> (Plane, Plane) {
    let (speed, turning) = (own.dot(rates), row.dot(rates));
    let (with, twist) = (
        carried * inner_m.dot(outer_m),
        carried * inner_m.cross(outer_m),
    );
    let of_outer = with * speed + outer * turning;
    let momentum = own * (base * speed + with * turning) + row * of_outer;
    let motion = (own - row) * (twist * speed * turning) + row_rate * of_outer;
    (momentum, motion)
}

/// The rows of the joints and the hand's torque.
#[inline(always)]
pub fn rows_and_load(form: &Form<f64>, at: &Linkage<f64>, force_n: Plane) -> ([Plane; 4], Plane) {
    let [left, right] = form.turning;
    (joint_rows(left, right), tip_load(left, at, force_n))
}
