//! This file draws the trials of an axis: a target that rests, steps, runs or swings, a start, and an axis within its intervals.

use core::f64::consts::TAU;

use super::description::Reference;
use super::found::Drawn;
use super::plan::Plan;
use crate::scenario::Draw;

/// One trial before it is run.
#[derive(Clone, Debug, PartialEq)]
pub struct Scenario {
    /// Where the axis is to be.
    pub target: Target,
    /// Where it starts, m or rad, and how fast.
    pub start: [f64; 2],
    /// The axis.
    pub drawn: Drawn,
    /// Standard deviation of the sensed position's noise, m or rad.
    pub noise: f64,
    /// Where a step of the encoder begins, as a share of it.
    pub phase: f64,
    /// The seed of the noise.
    pub seed: u64,
}

/// Where the axis is to be over a trial; positions in m or rad.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(missing_docs, reason = "the variants say it")]
pub enum Target {
    /// At one place.
    Rest { at: f64 },
    /// At one place, and from a time on at another.
    Step { from: f64, to: f64, at_s: f64 },
    /// From one place to another at a speed, from a time on.
    Ramp {
        from: f64,
        to: f64,
        speed: f64,
        at_s: f64,
    },
    /// To and fro about a place.
    Sine {
        middle: f64,
        amplitude: f64,
        frequency_hz: f64,
    },
}

impl Target {
    /// Position and speed at a time.
    pub fn at(&self, time_s: f64) -> [f64; 2] {
        match *self {
            Target::Rest { at } => [at, 0.0],
            Target::Step { from, to, at_s } => [if time_s < at_s { from } else { to }, 0.0],
            Target::Ramp {
                from,
                to,
                speed,
                at_s,
            } => {
                let run = speed * (time_s - at_s);
                let whole = (to - from).abs();
                let sense = (to - from).signum();
                match (0.0..whole).contains(&run) {
                    true => [from + sense * run, sense * speed],
                    false => [if run < 0.0 { from } else { to }, 0.0],
                }
            }
            Target::Sine {
                middle,
                amplitude,
                frequency_hz,
            } => {
                let rate = TAU * frequency_hz;
                let (sine, cosine) = libm::sincos(rate * time_s);
                // It begins at rest, at its lower end.
                [middle - amplitude * cosine, amplitude * rate * sine]
            }
        }
    }

    fn drawn(draw: &mut Draw, reference: &Reference, length_s: f64) -> Target {
        let Reference {
            low,
            high,
            step,
            speed,
            frequency_hz,
        } = *reference;
        let from = draw.between(low, high);
        let at_s = draw.between(0.1, 0.4) * length_s;
        match draw.below(4) {
            0 => Target::Rest { at: from },
            1 => {
                let by = draw.sign() * draw.between(0.1, 1.0) * step;
                // A step that would leave the targets goes the other way.
                let is_inside = (low..=high).contains(&(from + by));
                let to = if is_inside { from + by } else { from - by };
                let to = to.clamp(low, high);
                Target::Step { from, to, at_s }
            }
            2 => Target::Ramp {
                from,
                to: draw.between(low, high),
                speed: draw.between(0.1, 1.0) * speed,
                at_s,
            },
            _ => {
                let frequency_hz = draw.between(0.1, 1.0) * frequency_hz;
                let room = (from - low).min(high - from);
                let most = room.min(speed / (TAU * frequency_hz));
                Target::Sine {
                    middle: from,
                    amplitude: draw.between(0.1, 1.0) * most,
                    frequency_hz,
                }
            }
        }
    }
}

impl Scenario {
    /// The trial of an index.
    pub fn drawn(plan: &Plan, index: u64) -> Scenario {
        let asked = &plan.asked;
        let mut draw = Draw::new(plan.seed, index);
        let length_s = f64::from(plan.ticks) * asked.sample_s;
        let target = Target::drawn(&mut draw, &asked.reference, length_s);
        let [first, _] = target.at(0.0);
        let off = draw.between(-1.0, 1.0) * asked.reference.step;
        let is_moving = draw.one_in(4);
        let speed = draw.between(-0.5, 0.5) * asked.reference.speed;
        Scenario {
            start: [first + off, if is_moving { speed } else { 0.0 }],
            drawn: plan.axis.drawn(plan.seed, index),
            noise: draw.between(0.5, 1.5) * plan.axis.noise,
            phase: draw.between(0.0, 1.0),
            seed: draw.seed(),
            target,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const REFERENCE: Reference = Reference {
        low: -0.3,
        high: 0.7,
        step: 0.1,
        speed: 1.3,
        frequency_hz: 2.1,
    };

    #[test]
    fn every_target_stays_within_its_ends_and_its_speed() {
        let mut kinds = [0; 4];
        for index in 0..300 {
            let target = Target::drawn(&mut Draw::new(5, index), &REFERENCE, 3.0);
            let kind = match target {
                Target::Rest { .. } => 0,
                Target::Step { .. } => 1,
                Target::Ramp { .. } => 2,
                Target::Sine { .. } => 3,
            };
            kinds[kind] += 1;
            for k in 0..300 {
                let [at, speed] = target.at(0.01 * f64::from(k));
                assert!((-0.3 - 1e-12..=0.7 + 1e-12).contains(&at), "{target:?}");
                assert!(speed.abs() <= 1.3 + 1e-12, "{target:?}");
            }
        }
        assert!(kinds.iter().all(|count| *count > 40), "{kinds:?}");
    }

    #[test]
    fn the_speed_of_a_target_is_how_its_position_changes() {
        let sine = Target::Sine {
            middle: 0.2,
            amplitude: 0.07,
            frequency_hz: 1.7,
        };
        let ramp = Target::Ramp {
            from: 0.5,
            to: -0.1,
            speed: 0.9,
            at_s: 0.31,
        };
        for target in [sine, ramp] {
            let [before, after] = [0.4299, 0.4301].map(|time_s| target.at(time_s)[0]);
            let [_, speed] = target.at(0.43);
            assert!(
                ((after - before) / 0.0002 - speed).abs() < 1e-5,
                "{target:?}"
            );
        }
    }
}
