//! This file draws the laboratory of an arm: the arm, how it is led, its sensors, and what its description states.

use super::body::Body;
use super::dynamics::{State, efforts};
use crate::draw::{Draw, rounded};
use std::f64::consts::TAU;

/// One laboratory.
#[derive(Clone, Debug)]
pub struct Setup {
    /// The arm as its description has it; the truth where nothing is hidden.
    pub body: Body,
    pub rate_hz: f64,
    pub duration_s: f64,
    pub paths: Vec<Path>,
    /// Of each joint: an encoder's count, rad or m, and the noise of its effort, N·m or N.
    pub sensors: Vec<[f64; 2]>,
    /// What is usual of each joint's effort and speed: their root mean squares.
    pub usual: Vec<[f64; 2]>,
}

/// A sum of sines about a middle.
#[derive(Clone, Debug)]
pub struct Path {
    middle: f64,
    lines: Vec<Line>,
}

#[derive(Clone, Copy, Debug)]
struct Line {
    size: f64,
    rate: f64,
    phase: f64,
}

impl Path {
    fn draw(slides: bool, draw: &mut Draw) -> Path {
        let reach = match slides {
            true => draw.uniform(0.04, 0.12),
            false => draw.uniform(0.4, 1.0),
        };
        let base_hz = draw.uniform(0.08, 0.16);
        let lines = (1..=5).map(|order| Line {
            size: reach * draw.uniform(0.3, 1.0) / (0.8 + 0.4 * f64::from(order)),
            rate: TAU * base_hz * f64::from(order),
            phase: draw.uniform(0.0, TAU),
        });
        let lines = lines.collect();
        Path {
            middle: if slides { 0.0 } else { draw.uniform(-1.2, 1.2) },
            lines,
        }
    }

    /// Standard deviation of the position.
    pub fn swing(&self) -> f64 {
        let squares = self.lines.iter().map(|line| 0.5 * line.size * line.size);
        squares.sum::<f64>().sqrt()
    }

    /// Position, speed and acceleration.
    pub fn at(&self, time_s: f64) -> State {
        let start = [self.middle, 0.0, 0.0];
        self.lines.iter().fold(start, |[q, v, a], line| {
            let (s, c) = libm::sincos(line.rate * time_s + line.phase);
            [
                q + line.size * s,
                v + line.size * line.rate * c,
                a - line.size * line.rate * line.rate * s,
            ]
        })
    }
}

fn root_mean_square(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0.0), |(sum, count), x| (sum + x * x, count + 1.0));
    (sum / f64::max(count, 1.0)).sqrt()
}

impl Setup {
    /// The laboratory of an arm.
    pub fn of(body: Body, draw: &mut Draw) -> Setup {
        let paths: Vec<Path> = body
            .joints
            .iter()
            .map(|member| Path::draw(member.slides, draw))
            .collect();
        let mut setup = Setup {
            rate_hz: draw.pick(&[100.0, 125.0, 200.0, 250.0, 500.0]),
            duration_s: draw.uniform(12.0, 20.0).floor(),
            sensors: Vec::new(),
            usual: Vec::new(),
            paths,
            body,
        };
        setup.usual = setup.measured();
        let usual = setup.usual.clone();
        let states_friction = draw.chance(0.4);
        let counts = draw.pick(&[14, 16, 17, 19]);
        for (member, [effort, speed]) in setup.body.joints.iter_mut().zip(usual) {
            let turn = if member.slides { 0.05 } else { TAU };
            let noise = rounded(effort * draw.log_uniform(0.002, 0.02));
            setup.sensors.push([turn / f64::from(1 << counts), noise]);
            if states_friction {
                member.dry = rounded(effort * draw.log_uniform(0.05, 0.25));
                member.viscous = rounded(effort / speed * draw.log_uniform(0.05, 0.25));
            }
        }
        setup
    }

    /// The states of the joints at a time, s.
    pub fn states(&self, time_s: f64) -> Vec<State> {
        self.paths.iter().map(|path| path.at(time_s)).collect()
    }

    /// How many samples a recording has.
    pub fn samples(&self) -> usize {
        (self.duration_s * self.rate_hz) as usize
    }

    fn measured(&self) -> Vec<[f64; 2]> {
        let times = (0..40).map(|k| self.duration_s * f64::from(k) / 40.0);
        let both: Vec<(Vec<f64>, Vec<State>)> = times
            .map(|time_s| self.states(time_s))
            .map(|states| (efforts(&self.body, &states), states))
            .collect();
        let each = (0..self.body.joints.len()).map(|k| {
            let of = both
                .iter()
                .filter_map(|(efforts, _)| efforts.get(k).copied());
            let speed = both
                .iter()
                .filter_map(|(_, states)| states.get(k).map(|[_, speed, _]| *speed));
            [root_mean_square(of), root_mean_square(speed)]
        });
        each.collect()
    }
}
