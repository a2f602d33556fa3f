//! This file is who pushes the tip in a trial: an operator of one of three manners, an adversary, or a constant push.

use rigproof_impl::path::Path as _;
use rigproof_impl::plant::Plant;
use rigproof_impl::vector::Vector;
use rigproof_model::operator::{Abilities, Hand as _, Operator};
use rigproof_spec::methods::SAMPLE_STEP_S;
use serde::{Deserialize, Serialize};

use crate::controller::Task;
use crate::scenario::Draw;
use crate::way::{Way, reversed};

/// Greatest force of any hand, N (decision 0047).
pub const GREATEST_FORCE_N: f64 = 20.0;
/// How far from the path the adversary turns back, m.
const TURNING_M: f64 = 0.05;

/// Who pushes, written out.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Hand {
    /// A simulated operator, who turns round at the end of the path.
    Operator {
        /// How it moves.
        manner: Manner,
        /// Share of its force.
        strength: f64,
        /// Of its aim and tremor.
        seed: u64,
    },
    /// Somebody who does what hurts most.
    Adversary {
        /// Share of the greatest force.
        strength: f64,
        /// Of its changes of mind.
        seed: u64,
    },
    /// A force that never changes, N.
    Constant([f64; 2]),
}

/// How an operator moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Manner {
    /// Slow and light.
    Gentle,
    /// Fast and strong, aiming badly.
    Hasty,
    /// With a tremor ten times as strong.
    Trembling,
}

impl Hand {
    /// A hand from a draw.
    pub fn drawn(draw: &mut Draw) -> Hand {
        let manner = match draw.below(4) {
            0 => Manner::Gentle,
            1 => Manner::Hasty,
            2 => Manner::Trembling,
            _ => {
                return Hand::Adversary {
                    strength: draw.between(0.2, 1.0),
                    seed: draw.seed(),
                };
            }
        };
        Hand::Operator {
            manner,
            strength: draw.between(0.6, 1.0),
            seed: draw.seed(),
        }
    }
}

/// The abilities of a manner (decision 0125).
fn abilities(manner: Manner, strength: f64) -> Abilities {
    let careful = Abilities {
        greatest_force_n: GREATEST_FORCE_N * strength,
        ..Abilities::CAREFUL
    };
    match manner {
        Manner::Gentle => Abilities {
            speed_m_s: 0.06,
            correction_n_per_m: 40.0,
            ..careful
        },
        Manner::Hasty => Abilities {
            delay_s: 0.13,
            speed_m_s: 0.3,
            urge_n_s_per_m: 60.0,
            impatience_n_per_m: 120.0,
            aim_error_m: 0.015,
            ..careful
        },
        Manner::Trembling => Abilities {
            tremor_n: 1.5,
            aim_error_m: 0.012,
            ..careful
        },
    }
}

/// A hand at work.
pub enum Pushing {
    /// An operator on the path, and one on the way back.
    Operator(Box<[Operator<Way>; 2]>),
    /// An adversary.
    Adversary(Box<Adversary>),
    /// A constant push, N.
    Constant([f64; 2]),
}

impl Pushing {
    /// A hand that begins; `None` for a task that is no path or for a strength that is no share.
    pub fn new(hand: &Hand, task: &Task) -> Option<Pushing> {
        let (way, back) = (Way::new(task)?, Way::new(&reversed(task))?);
        Some(match *hand {
            Hand::Operator {
                manner,
                strength,
                seed,
            } => {
                let abilities = abilities(manner, strength);
                Pushing::Operator(Box::new([
                    Operator::new(way, abilities, seed).ok()?,
                    Operator::new(back, abilities, !seed).ok()?,
                ]))
            }
            Hand::Adversary { strength, seed } => Pushing::Adversary(Box::new(Adversary {
                way,
                greatest_n: GREATEST_FORCE_N * strength,
                draw: Draw::new(seed, 0),
                mode: Mode::Across,
                left: 0,
                is_turning: false,
            })),
            Hand::Constant(force_n) => Pushing::Constant(force_n),
        })
    }

    /// The force on the tip over the next step, N; the currents are those of the last command, A.
    pub fn push(&mut self, plant: &Plant, currents_a: [f64; 4], has_turned: bool) -> [f64; 2] {
        match self {
            Pushing::Operator(operators) => {
                let [there, back] = operators.as_mut();
                let operator = if has_turned { back } else { there };
                let (tip_m, velocity_m_s) = (plant.tip_m(), plant.tip_velocity_m_s());
                operator.push(tip_m.into(), velocity_m_s.into(), SAMPLE_STEP_S)
            }
            Pushing::Adversary(adversary) => adversary.push(plant, currents_a).into(),
            Pushing::Constant(force_n) => *force_n,
        }
    }
}

/// Who does what hurts most, a while each.
pub struct Adversary {
    way: Way,
    greatest_n: f64,
    draw: Draw,
    mode: Mode,
    /// Samples until another mode.
    left: u32,
    /// Whether the tip is being brought back to the path.
    is_turning: bool,
}

/// What hurts.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Mode {
    /// Away from the path.
    Away,
    /// With the motion.
    Along,
    /// Against the motion.
    Against,
    /// Where the brake that acts has no grip, away from the path.
    Across,
    /// Anywhere: a direction, of length one.
    Anywhere(Vector<f64>),
    /// Not at all.
    Nothing,
}

impl Adversary {
    fn push(&mut self, plant: &Plant, currents_a: [f64; 4]) -> Vector<f64> {
        if self.left == 0 {
            self.left = 20 + self.draw.below(400);
            self.mode = self.another();
        }
        self.left -= 1;
        let nearest = self.way.path.nearest(plant.tip_m());
        let distance_m = nearest.distance_m();
        if distance_m > TURNING_M {
            self.is_turning = true;
        } else if distance_m < 0.1 * TURNING_M {
            self.is_turning = false;
        }
        let left = nearest.tangent.left();
        let away = if nearest.offset_m < 0.0 { -left } else { left };
        let velocity_m_s = plant.tip_velocity_m_s();
        if self.is_turning {
            // Back, and along where the tip is not: braked, or the arms would be torn straight.
            return self.limited(-away * self.greatest_n - velocity_m_s * 8.0);
        }
        let direction = match self.mode {
            Mode::Away => away,
            Mode::Along => unit(velocity_m_s),
            Mode::Against => -unit(velocity_m_s),
            Mode::Across => free(plant, currents_a, away),
            Mode::Anywhere(direction) => direction,
            Mode::Nothing => Vector::zero(),
        };
        self.limited(direction * self.greatest_n)
    }

    fn another(&mut self) -> Mode {
        match self.draw.below(8) {
            0 => Mode::Away,
            1 => Mode::Along,
            2 => Mode::Against,
            3..5 => Mode::Across,
            5..7 => {
                let angle_rad = self.draw.between(0.0, core::f64::consts::TAU);
                let (sine, cosine) = libm::sincos(angle_rad);
                Mode::Anywhere(Vector::new(cosine, sine))
            }
            _ => Mode::Nothing,
        }
    }

    fn limited(&self, force_n: Vector<f64>) -> Vector<f64> {
        let size_n = force_n.norm();
        if size_n > self.greatest_n {
            force_n * (self.greatest_n / size_n)
        } else {
            force_n
        }
    }
}

/// A vector's direction; none of a vector that all but vanishes.
fn unit(vector: Vector<f64>) -> Vector<f64> {
    let size = vector.norm();
    if size > 1e-6 {
        vector * (1.0 / size)
    } else {
        Vector::zero()
    }
}

/// The direction in which the brake with the greatest current has no grip, on the side away from the path.
fn free(plant: &Plant, currents_a: [f64; 4], away: Vector<f64>) -> Vector<f64> {
    let rows = plant.linkage().rows().into_iter();
    let strongest = rows
        .zip(currents_a)
        .max_by(|(_, one), (_, other)| one.total_cmp(other));
    let across = strongest.map_or(away, |(row, _)| unit(row.left()));
    if across.dot(away) < 0.0 {
        -across
    } else {
        across
    }
}
