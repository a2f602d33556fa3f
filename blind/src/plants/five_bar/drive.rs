//! This file commands the brakes: an experimenter's programmes, and controllers that look at the encoders.

use super::linkage::{Pair, Pose, dot, plus};
use crate::draw::{Draw, rounded};
use rigproof_spec::geometry::Arms;
use rigproof_spec::joint::Joint;
use rigproof_spec::layout::Layout;
use std::collections::VecDeque;

/// What commands the currents.
#[derive(Clone, Debug)]
pub enum Drive {
    /// Each brake runs through pieces of its own, in the order A, E, B, C.
    Programme([Vec<Piece>; 4]),
    /// A controller in the loop.
    Loop(Controller),
    /// Given currents of A, E, B and C, each held for a step; none before a time, s.
    Given {
        from_s: f64,
        step_s: f64,
        currents_a: [Vec<f64>; 4],
    },
}

/// One piece of a programme, A over s from its start.
#[derive(Clone, Copy, Debug)]
pub enum Piece {
    Hold {
        current_a: f64,
        length_s: f64,
    },
    /// Up in even steps and down again.
    Staircase {
        top_a: f64,
        steps: f64,
        length_s: f64,
    },
    /// Up at a constant rate and down again.
    Triangle {
        top_a: f64,
        length_s: f64,
    },
    /// On for half of each period.
    Switching {
        current_a: f64,
        period_s: f64,
        length_s: f64,
    },
}

impl Piece {
    const fn length_s(self) -> f64 {
        match self {
            Piece::Hold { length_s, .. }
            | Piece::Staircase { length_s, .. }
            | Piece::Triangle { length_s, .. }
            | Piece::Switching { length_s, .. } => length_s,
        }
    }

    fn at(self, time_s: f64) -> f64 {
        let way = |length_s: f64| 1.0 - (2.0 * time_s / length_s - 1.0).abs();
        match self {
            Piece::Hold { current_a, .. } => current_a,
            Piece::Staircase {
                top_a,
                steps,
                length_s,
            } => top_a * (way(length_s) * (steps + 1.0)).floor().min(steps) / steps,
            Piece::Triangle { top_a, length_s } => top_a * way(length_s),
            Piece::Switching {
                current_a,
                period_s,
                ..
            } => {
                if (time_s / period_s).fract() < 0.5 {
                    current_a
                } else {
                    0.0
                }
            }
        }
    }
}

/// The current of a programme, A.
fn current_a(pieces: &[Piece], time_s: f64) -> f64 {
    let mut local_s = time_s;
    for piece in pieces {
        if local_s < piece.length_s() {
            return piece.at(local_s);
        }
        local_s -= piece.length_s();
    }
    0.0
}

/// A programme: the brakes take turns, so that one alone carries most of the load; some pieces have two.
pub fn programme(draw: &mut Draw, layout: Layout, duration_s: f64, greatest_a: f64) -> Drive {
    let mut pieces: [Vec<Piece>; 4] = Default::default();
    let mut total_s = 0.0;
    let mut turn = draw.below(4);
    while total_s < duration_s {
        let length_s = draw.uniform(1.6, 2.8);
        let braked = layout.brakes();
        turn = (turn + 1) % braked.len();
        let active = braked.get(turn).copied().unwrap_or(Joint::A);
        let second = draw.chance(0.25).then(|| draw.pick(braked));
        for (joint, list) in Joint::ALL.into_iter().zip(&mut pieces) {
            let piece = if joint == active || second == Some(joint) {
                piece(draw, length_s, greatest_a)
            } else {
                Piece::Hold {
                    current_a: 0.0,
                    length_s,
                }
            };
            list.push(if braked.contains(&joint) {
                piece
            } else {
                Piece::Hold {
                    current_a: 0.0,
                    length_s,
                }
            });
        }
        total_s += length_s;
    }
    Drive::Programme(pieces)
}

fn piece(draw: &mut Draw, length_s: f64, greatest_a: f64) -> Piece {
    let top_a = rounded(draw.uniform(0.35, 1.0) * greatest_a);
    match draw.below(4) {
        0 => Piece::Hold {
            current_a: top_a,
            length_s,
        },
        1 => Piece::Staircase {
            top_a,
            steps: 3.0,
            length_s,
        },
        2 => Piece::Triangle { top_a, length_s },
        _ => Piece::Switching {
            current_a: top_a,
            period_s: draw.uniform(0.25, 0.7),
            length_s,
        },
    }
}

/// Every brake at a current that never changes: a gain cannot be told from dry friction then.
pub fn constant(draw: &mut Draw, layout: Layout, duration_s: f64, greatest_a: f64) -> Drive {
    let pieces = Joint::ALL.map(|joint| {
        let current_a = rounded(draw.uniform(0.1, 0.35) * greatest_a);
        let current_a = if layout.brakes().contains(&joint) {
            current_a
        } else {
            0.0
        };
        vec![Piece::Hold {
            current_a,
            length_s: duration_s + 1.0,
        }]
    });
    Drive::Programme(pieces)
}

/// A controller: it wants a force on the tip and switches the brakes on whose resistance has a part along it.
#[derive(Clone, Debug)]
pub struct Controller {
    pub aim: Aim,
    /// A per metre of error, or A per m/s.
    pub gain: f64,
    pub greatest_a: f64,
    layout: Layout,
    past: VecDeque<Pair>,
}

/// What the controller wants of the tip.
#[derive(Clone, Copy, Debug)]
pub enum Aim {
    /// Back to the line through a point along a unit vector.
    Line { point_m: Pair, along: Pair },
    /// Back to a circle.
    Circle { centre_m: Pair, radius_m: f64 },
    /// Out of a wall: beyond the point in the direction of the unit vector the tip is inside.
    Wall { point_m: Pair, inward: Pair },
    /// Slower.
    Damper,
}

impl Aim {
    /// Half of all controllers guide along a line or a circle about the centre, the others are a wall or a damper.
    fn draw(draw: &mut Draw, centre_m: Pair, radius_m: f64) -> Aim {
        let (s, c) = libm::sincos(draw.uniform(0.0, std::f64::consts::TAU));
        match draw.below(4) {
            0 => Aim::Line {
                point_m: centre_m,
                along: [c, s],
            },
            1 => Aim::Circle {
                centre_m,
                radius_m: 0.6 * radius_m,
            },
            2 => Aim::Wall {
                point_m: plus(centre_m, 0.2 * radius_m, [c, s]),
                inward: [c, s],
            },
            _ => Aim::Damper,
        }
    }
}

/// A controller of the tip about a centre.
pub fn controller(
    draw: &mut Draw,
    layout: Layout,
    centre_m: Pair,
    radius_m: f64,
    greatest_a: f64,
) -> Drive {
    let aim = Aim::draw(draw, centre_m, radius_m);
    let gain = match aim {
        Aim::Damper => draw.uniform(1.0, 3.0) * greatest_a,
        _ => draw.uniform(20.0, 60.0) * greatest_a,
    };
    Drive::Loop(Controller {
        aim,
        gain,
        greatest_a,
        layout,
        past: VecDeque::new(),
    })
}

/// Samples over which a controller takes its velocity.
const VELOCITY_SAMPLES: usize = 20;
/// A joint slower than this is taken for standing, rad/s.
const STANDING_RAD_S: f64 = 0.01;

impl Drive {
    /// The currents from a sample on, A, in the order A, E, B, C; `shown` are the encoders' angles, rad.
    pub fn currents_a(&mut self, arms: &Arms, time_s: f64, shown: Pair, sample_s: f64) -> [f64; 4] {
        match self {
            Drive::Programme(pieces) => {
                let [a, e, b, c] = pieces;
                [a, e, b, c].map(|pieces| current_a(pieces, time_s))
            }
            Drive::Loop(controller) => controller.currents_a(arms, shown, sample_s),
            Drive::Given {
                from_s,
                step_s,
                currents_a,
            } => {
                let at = (time_s - *from_s) / *step_s + 1e-6;
                currents_a.each_ref().map(|given| match at < 0.0 {
                    true => 0.0,
                    false => given
                        .get(at as usize)
                        .or(given.last())
                        .copied()
                        .unwrap_or(0.0),
                })
            }
        }
    }
}

impl Controller {
    fn currents_a(&mut self, arms: &Arms, shown: Pair, sample_s: f64) -> [f64; 4] {
        self.past.push_front(shown);
        self.past.truncate(VELOCITY_SAMPLES + 1);
        let oldest = self.past.back().copied().unwrap_or(shown);
        let span_s = sample_s * (self.past.len() - 1).max(1) as f64;
        let rates = plus(shown, -1.0, oldest).map(|x| x / span_s);
        let Some(pose) = Pose::at(arms, shown) else {
            return [0.0; 4];
        };
        let velocity = pose.tip_velocity(arms, rates);
        let [x, y] = self.wanted(pose.tip_m, velocity);
        let size = x.hypot(y);
        let level_a = (self.gain * size).min(self.greatest_a);
        let [a, e, b, c] = pose.rows.map(|row| {
            let rate = dot(row, rates);
            if size == 0.0 || rate.abs() < STANDING_RAD_S {
                return 0.0;
            }
            let resists = pose.tip_force_of(arms, row.map(|x| -x * rate.signum()));
            let [fx, fy] = resists;
            let part = dot(resists, [x, y]) / (size * fx.hypot(fy));
            if part > 0.0 { level_a * part } else { 0.0 }
        });
        match self.layout {
            Layout::ThreeBrake => [a, e, b, 0.0],
            Layout::FourBrake => [a, e, b, c],
        }
    }

    /// The way the tip should be pushed, in metres of error or m/s.
    fn wanted(&self, tip_m: Pair, velocity: Pair) -> Pair {
        match self.aim {
            Aim::Line { point_m, along } => {
                let off = plus(tip_m, -1.0, point_m);
                plus(along.map(|x| x * dot(off, along)), -1.0, off)
            }
            Aim::Circle { centre_m, radius_m } => {
                let off = plus(tip_m, -1.0, centre_m);
                let [x, y] = off;
                let distance_m = x.hypot(y).max(1e-6);
                off.map(|x| x * (radius_m / distance_m - 1.0))
            }
            Aim::Wall { point_m, inward } => {
                let depth_m = dot(plus(tip_m, -1.0, point_m), inward).max(0.0);
                inward.map(|x| -x * depth_m)
            }
            Aim::Damper => velocity.map(|x| -x),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_staircase_goes_up_and_down_in_even_steps() {
        let piece = Piece::Staircase {
            top_a: 0.6,
            steps: 3.0,
            length_s: 2.0,
        };
        let levels: Vec<f64> = [0.1, 0.3, 0.6, 0.9, 1.1, 1.4, 1.7, 1.9]
            .iter()
            .map(|t| piece.at(*t))
            .collect();
        let expected = [0.0, 0.2, 0.4, 0.6, 0.6, 0.4, 0.2, 0.0];
        for (level, expected) in levels.iter().zip(expected) {
            assert!((level - expected).abs() < 1e-12, "{levels:?}");
        }
    }

    #[test]
    fn a_controller_brakes_only_what_pushes_towards_its_aim() {
        let arms = rigproof_spec::geometry::arms(Layout::FourBrake);
        let along = [0.8, 0.6];
        let mut controller = Controller {
            aim: Aim::Line {
                point_m: [0.0, 0.42],
                along,
            },
            gain: 31.0,
            greatest_a: 0.7,
            layout: Layout::FourBrake,
            past: VecDeque::new(),
        };
        let mut used = 0;
        for k in 0..400 {
            let time_s = f64::from(k) * 0.01;
            let shown = [
                2.0 + 0.2 * libm::sin(1.7 * time_s),
                1.1 + 0.23 * libm::sin(2.9 * time_s + 1.0),
            ];
            let currents = controller.currents_a(&arms, shown, 0.01);
            let pose = Pose::at(&arms, shown).unwrap();
            let rates = plus(shown, -1.0, *controller.past.back().unwrap());
            let error = controller.wanted(pose.tip_m, [0.0; 2]);
            for (current, row) in currents.into_iter().zip(pose.rows) {
                assert!((0.0..=0.7).contains(&current));
                if current > 0.0 {
                    used += 1;
                    let resists = row.map(|x| -x * dot(row, rates).signum());
                    assert!(dot(pose.tip_force_of(&arms, resists), error) > 0.0);
                }
            }
        }
        assert!(used > 300, "{used}");
    }
}
