//! This file is the hand on the tip: a spring and damper towards a moving goal, with the tremor of a person.

use super::linkage::{Pair, plus};
use crate::draw::Draw;
use crate::path::Path;
use std::f64::consts::TAU;

/// A hand. A person's is soft and trembles; an experimenter pushes the handle with a stiff one.
#[derive(Clone, Debug)]
pub struct Hand {
    pub goal: Goal,
    /// N/m.
    pub stiffness: f64,
    /// N·s/m.
    pub damping: f64,
    /// The most it pushes with, N.
    pub greatest_n: f64,
    pub tremor: Vec<Wave>,
}

/// One line of the tremor, of 8 to 12 Hz (Elble and Koller 1990).
#[derive(Clone, Copy, Debug)]
pub struct Wave {
    pub force_n: Pair,
    pub omega: f64,
    pub phase: f64,
}

/// Where the hand wants to be.
#[derive(Clone, Debug)]
pub enum Goal {
    /// Movements of a laboratory on each axis of its own about a centre.
    Excitation { centre_m: Pair, axes: [Path; 2] },
    /// Reaches from place to place, each with the least jerk (Flash and Hogan 1985), and a rest between.
    Reaches { centre_m: Pair, reaches: Vec<Reach> },
    /// A reach from the centre to the beginning of a given path, and the path.
    Led {
        centre_m: Pair,
        reach_s: f64,
        step_s: f64,
        path_m: Vec<Pair>,
    },
}

/// One reach: it starts, takes its time, and goes to a place relative to the centre.
#[derive(Clone, Copy, Debug)]
pub struct Reach {
    pub start_s: f64,
    pub length_s: f64,
    pub to_m: Pair,
}

impl Hand {
    /// The force on the handle, N, at a place and a velocity of the handle.
    pub fn force_n(&self, time_s: f64, at_m: Pair, velocity: Pair) -> Pair {
        let (goal_m, goal_velocity) = self.goal.at(time_s);
        let pull = plus(goal_m, -1.0, at_m).map(|x| x * self.stiffness);
        let pull = plus(pull, self.damping, plus(goal_velocity, -1.0, velocity));
        let [x, y] = pull;
        let share = (self.greatest_n / x.hypot(y)).min(1.0);
        self.tremor
            .iter()
            .fold(pull.map(|x| x * share), |force, wave| {
                plus(
                    force,
                    libm::sin(wave.omega * time_s + wave.phase),
                    wave.force_n,
                )
            })
    }

    /// A person who reaches about.
    pub fn person(draw: &mut Draw, centre_m: Pair, radius_m: f64, duration_s: f64) -> Hand {
        let mut reaches = Vec::new();
        let mut start_s = draw.uniform(0.2, 0.5);
        while start_s < duration_s {
            let length_s = draw.uniform(0.5, 1.6);
            reaches.push(Reach {
                start_s,
                length_s,
                to_m: in_disc(draw, radius_m),
            });
            start_s += length_s + draw.uniform(0.0, 0.25);
        }
        Hand {
            goal: Goal::Reaches { centre_m, reaches },
            stiffness: draw.log_uniform(250.0, 600.0),
            damping: draw.uniform(15.0, 40.0),
            greatest_n: draw.uniform(30.0, 45.0),
            tremor: tremor(draw, 0.4),
        }
    }

    /// An experimenter who reaches for the beginning of a path and leads the handle along it.
    pub fn led(
        draw: &mut Draw,
        centre_m: Pair,
        reach_s: f64,
        step_s: f64,
        path_m: Vec<Pair>,
    ) -> Hand {
        Hand {
            goal: Goal::Led {
                centre_m,
                reach_s,
                step_s,
                path_m,
            },
            stiffness: draw.log_uniform(900.0, 2000.0),
            damping: draw.uniform(40.0, 90.0),
            greatest_n: draw.uniform(45.0, 70.0),
            tremor: tremor(draw, 0.15),
        }
    }

    /// An experimenter who pushes the handle along slow triangles, sines, ramps of speed and multisines.
    pub fn experimenter(draw: &mut Draw, centre_m: Pair, radius_m: f64, duration_s: f64) -> Hand {
        let mut axis = |share: f64| {
            let (scale, frequency_hz) = (share * radius_m, draw.uniform(0.35, 0.8));
            Path::draw(draw, scale, frequency_hz, duration_s, false)
        };
        let axes = [axis(0.75), axis(0.75)];
        Hand {
            goal: Goal::Excitation { centre_m, axes },
            stiffness: draw.log_uniform(900.0, 2000.0),
            damping: draw.uniform(40.0, 90.0),
            greatest_n: draw.uniform(45.0, 70.0),
            tremor: tremor(draw, 0.15),
        }
    }
}

impl Goal {
    /// The centre of the motion, where it begins, m.
    pub const fn centre_m(&self) -> Pair {
        match self {
            Goal::Excitation { centre_m, .. }
            | Goal::Reaches { centre_m, .. }
            | Goal::Led { centre_m, .. } => *centre_m,
        }
    }

    /// Place, m, and velocity, m/s, of the goal.
    fn at(&self, time_s: f64) -> (Pair, Pair) {
        match self {
            Goal::Excitation {
                centre_m,
                axes: [x, y],
            } => {
                let ((x_m, x_rate), (y_m, y_rate)) = (x.at(time_s), y.at(time_s));
                (plus(*centre_m, 1.0, [x_m, y_m]), [x_rate, y_rate])
            }
            Goal::Reaches { centre_m, reaches } => {
                let begun = reaches.partition_point(|reach| reach.start_s <= time_s);
                let mut last = reaches.iter().take(begun).rev();
                let Some(now) = last.next() else {
                    return (*centre_m, [0.0; 2]);
                };
                let from_m = last.next().map_or([0.0; 2], |reach| reach.to_m);
                let (place, velocity) =
                    reached([from_m, now.to_m], time_s - now.start_s, now.length_s);
                (plus(*centre_m, 1.0, place), velocity)
            }
            Goal::Led {
                centre_m,
                reach_s,
                step_s,
                path_m,
            } => {
                let point = |k: usize| path_m.get(k).or(path_m.last()).copied();
                let within = (time_s - reach_s) / step_s;
                if within < 0.0 {
                    let first_m = point(0).unwrap_or(*centre_m);
                    return reached([*centre_m, first_m], time_s, *reach_s);
                }
                let from_m = point(within as usize).unwrap_or(*centre_m);
                let to_m = point(within as usize + 1).unwrap_or(*centre_m);
                let way = plus(to_m, -1.0, from_m);
                let place = plus(from_m, within.fract(), way);
                (place, way.map(|x| x / step_s))
            }
        }
    }
}

/// Place, m, and velocity, m/s, within a reach of least jerk between two places; it stays where it ends.
fn reached([from_m, to_m]: [Pair; 2], time_s: f64, length_s: f64) -> (Pair, Pair) {
    let way = plus(to_m, -1.0, from_m);
    let x = (time_s / length_s).min(1.0);
    let part = x * x * x * (10.0 + x * (-15.0 + 6.0 * x));
    let rate = 30.0 * x * x * (1.0 - x) * (1.0 - x) / length_s;
    (plus(from_m, part, way), way.map(|x| x * rate))
}

fn in_disc(draw: &mut Draw, radius_m: f64) -> Pair {
    let (s, c) = libm::sincos(draw.uniform(0.0, TAU));
    let radius_m = radius_m * draw.uniform(0.0, 1.0).sqrt();
    [radius_m * c, radius_m * s]
}

fn tremor(draw: &mut Draw, force_n: f64) -> Vec<Wave> {
    (0..4)
        .map(|_| Wave {
            force_n: [draw.normal(force_n), draw.normal(force_n)],
            omega: TAU * draw.uniform(8.0, 12.0),
            phase: draw.uniform(0.0, TAU),
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plant::Plant;

    #[test]
    fn a_goal_moves_as_fast_as_it_says() {
        let mut draw = Draw::new(Plant::Rig, 29, "hand");
        let path = (0..310).map(|k| libm::sincos(0.1 * f64::from(k)));
        let path = path
            .map(|(s, c)| [0.01 + 0.07 * s, 0.38 + 0.05 * c])
            .collect();
        for hand in [
            Hand::led(&mut draw, [0.01, 0.38], 1.5, 0.05, path),
            Hand::person(&mut draw, [0.01, 0.38], 0.09, 17.0),
            Hand::experimenter(&mut draw, [0.01, 0.38], 0.09, 17.0),
        ] {
            let mut reach_m = 0.0_f64;
            for k in 1..1690 {
                let time_s = 0.01 * f64::from(k) + 3.1e-4;
                let step_s = 1e-6;
                let ((before, _), (at, rate), (after, _)) = (
                    hand.goal.at(time_s - step_s),
                    hand.goal.at(time_s),
                    hand.goal.at(time_s + step_s),
                );
                let moved = plus(after, -1.0, before).map(|x| x / (2.0 * step_s));
                assert!(
                    (moved[0] - rate[0]).hypot(moved[1] - rate[1]) < 1e-4,
                    "{time_s} s"
                );
                reach_m = reach_m.max((at[0] - 0.01).hypot(at[1] - 0.38));
            }
            assert!(reach_m > 0.04 && reach_m < 0.12, "{reach_m} m");
        }
    }
}
