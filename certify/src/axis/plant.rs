//! This file is the axis of a trial in closed loop: its drive, its motion by the reference model, and what its encoder shows.

use std::collections::VecDeque;

use rigproof_model::axis::{Axis, State, Trailing, Transmission};
use rigproof_model::effects::{Drive, Form, OfJoint, OfSensor, form, lagged, law, limited, slewed};

use super::found::Drawn;

/// Longest step of the model, s.
const STEP_S: f64 = 1e-3;
/// Most of the inertia that can hang on the joint.
const MOST_TRAILING: f64 = 0.99;

/// An axis in motion.
pub struct Plant {
    axis: Axis,
    state: State,
    sample_s: f64,
    /// What changes the effort, in its order.
    drive: Vec<Stage>,
    /// By how many samples a command comes late.
    late_samples: f64,
    /// Commands, the newest first.
    past: VecDeque<f64>,
    encoder: Vec<(OfSensor, Vec<f64>)>,
    /// The effort that the drive gives now, N or N·m.
    pub effort: f64,
}

/// A change of the effort.
enum Stage {
    Gain(f64),
    /// By the parameters of a saturation.
    Limit(Vec<f64>),
    /// At a greatest rate, N/s or N·m/s.
    Rate {
        most: f64,
        state: f64,
    },
    Lag {
        time_constant_s: f64,
        state: f64,
    },
}

impl Plant {
    /// An axis at a position, m or rad, and a speed, whose drive gave nothing before.
    pub fn new(drawn: &Drawn, position: f64, speed: f64, sample_s: f64) -> Plant {
        let laws = drawn.effects.iter();
        let laws = laws.filter_map(|(mechanism, numbers)| match form(*mechanism)? {
            Form::Resistance(_) => law(*mechanism, numbers),
            _ => None,
        });
        let axis = Axis {
            inertia: drawn.inertia,
            laws: laws.collect(),
            transmission: Transmission::default(),
        };
        let mut plant = Plant {
            state: axis.state(0.0, position, speed),
            axis,
            sample_s,
            drive: vec![Stage::Gain(drawn.gain)],
            late_samples: 0.0,
            past: VecDeque::new(),
            encoder: Vec::new(),
            effort: 0.0,
        };
        let mut gap = None;
        for (mechanism, numbers) in &drawn.effects {
            let number = |index: usize| numbers.get(index).copied().unwrap_or(0.0);
            match form(*mechanism) {
                Some(Form::Drive(of)) => plant.driven(of, numbers),
                Some(Form::Joint(OfJoint::Gap)) => gap = Some([number(0), number(1)]),
                Some(Form::Joint(of)) => plant.joined(of, numbers),
                Some(Form::Sensor(of)) => plant.encoder.push((of, numbers.clone())),
                _ => {}
            }
        }
        // Less than the whole of the joint hangs on it, with all that was added.
        let [spring, part] = &mut plant.axis.transmission.trailing;
        let left = MOST_TRAILING - spring.map_or(0.0, |own| own.share);
        *part = gap.map(|[inertia, width]| {
            Trailing::in_a_gap((inertia / plant.axis.inertia).min(left), width)
        });
        plant
    }

    fn driven(&mut self, of: Drive, numbers: &[f64]) {
        let value = numbers.first().copied().unwrap_or(0.0);
        match of {
            Drive::Gain => self.drive.push(Stage::Gain(1.0 + value)),
            Drive::Limit => self.drive.push(Stage::Limit(numbers.to_vec())),
            Drive::Rate => self.drive.push(Stage::Rate {
                most: value,
                state: 0.0,
            }),
            Drive::Lag => self.drive.push(Stage::Lag {
                time_constant_s: value,
                state: 0.0,
            }),
            Drive::Skew => self.late_samples += value / self.sample_s,
        }
    }

    fn joined(&mut self, of: OfJoint, numbers: &[f64]) {
        let number = |index: usize| numbers.get(index).copied().unwrap_or(0.0);
        match of {
            OfJoint::Inertia => self.axis.inertia += number(0),
            OfJoint::Load => self.axis.transmission.add_friction(numbers),
            OfJoint::Compliance => {
                let mut part = Trailing::of(numbers);
                part.share = part.share.min(MOST_TRAILING);
                let [spring, _] = &mut self.axis.transmission.trailing;
                *spring = Some(part);
            }
            OfJoint::Gap | OfJoint::Fade | OfJoint::Link | OfJoint::Stiffness | OfJoint::Lash => {}
        }
    }

    /// Where the axis is, m or rad.
    pub const fn position(&self) -> f64 {
        self.state.position
    }

    /// The position that its encoder shows, before it is rounded, m or rad.
    pub fn shown(&self) -> f64 {
        let each = self.encoder.iter();
        each.fold(self.state.position, |position, (of, numbers)| {
            of.shown(position, numbers)
        })
    }

    /// One sample under a command that is held, N or N·m.
    pub fn step(&mut self, commanded: f64) {
        self.past.push_front(commanded);
        let (whole, part) = (libm::floor(self.late_samples), self.late_samples.fract());
        let at = |samples: f64| self.past.get(samples as usize).copied().unwrap_or(0.0);
        // A delay that is no whole number of samples ends within one.
        let pieces = [(part, at(whole + 1.0)), (1.0 - part, at(whole))];
        self.past.truncate(whole as usize + 2);
        for (share, held) in pieces {
            let piece_s = share * self.sample_s;
            let steps = libm::ceil(piece_s / STEP_S);
            for _ in 0..steps as usize {
                let step_s = piece_s / steps;
                let [begin, end] = given(&mut self.drive, held, step_s);
                self.axis.step(&mut self.state, begin, end, step_s);
                self.effort = end;
            }
        }
    }
}

/// What the drive gives at the beginning and the end of a step under a command that is held.
fn given(drive: &mut [Stage], held: f64, step_s: f64) -> [f64; 2] {
    drive.iter_mut().fold([held; 2], |ends, stage| match stage {
        Stage::Gain(gain) => ends.map(|own| own * *gain),
        Stage::Limit(numbers) => ends.map(|own| limited(own, numbers)),
        Stage::Rate { most, state } => {
            let begin = *state;
            let [_, end] = ends;
            *state = slewed(begin, end, *most * step_s);
            [begin, *state]
        }
        Stage::Lag {
            time_constant_s,
            state,
        } => {
            let begin = *state;
            *state = lagged(begin, ends, step_s, *time_constant_s);
            [begin, *state]
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use rigproof_spec::effect::Mechanism;

    fn plant(effects: &[(Mechanism, &[f64])]) -> Plant {
        let effects = effects.iter();
        let effects = effects.map(|(mechanism, numbers)| (*mechanism, numbers.to_vec()));
        let drawn = Drawn {
            inertia: 1.3,
            gain: 1.1,
            effects: effects.collect(),
        };
        Plant::new(&drawn, 0.2, 0.0, 2e-3)
    }

    #[test]
    fn a_late_command_acts_from_the_middle_of_a_sample() {
        let mut late = plant(&[(Mechanism::ChannelSkew, &[0.005])]);
        for _ in 0..10 {
            late.step(0.7);
        }
        // 15 of 20 ms under 1.1·0.7 N.
        let moved = 0.5 * 0.77 / 1.3 * 0.015 * 0.015;
        assert!(
            (late.position() - 0.2 - moved).abs() < 1e-15,
            "{}",
            late.position()
        );
    }

    #[test]
    fn a_drive_is_slow_and_limited_as_the_calibration_says() {
        let mut drive = plant(&[
            (Mechanism::Lag, &[0.03]),
            (Mechanism::DriveSaturation, &[0.5]),
        ]);
        for _ in 0..15 {
            drive.step(0.4);
        }
        let lagged = 0.44 * -libm::expm1(-1.0);
        assert!((drive.effort - lagged).abs() < 1e-12, "{}", drive.effort);
        for _ in 0..400 {
            drive.step(0.9);
        }
        assert_eq!(drive.effort, 0.5);
    }

    #[test]
    fn a_drive_follows_a_step_at_its_rate_and_bends_towards_its_limit() {
        let mut slow = plant(&[(Mechanism::RateLimit, &[5.0])]);
        for _ in 0..20 {
            slow.step(0.9);
        }
        // 40 ms at 5 N/s, of 1.1·0.9 N.
        assert!((slow.effort - 0.2).abs() < 1e-12, "{}", slow.effort);
        for _ in 0..400 {
            slow.step(0.9);
        }
        assert!((slow.effort - 0.99).abs() < 1e-12, "{}", slow.effort);
        let mut round = plant(&[(Mechanism::DriveSaturation, &[0.99, 2.0])]);
        round.step(0.9);
        let at_limit = 0.99 / core::f64::consts::SQRT_2;
        assert!((round.effort - at_limit).abs() < 1e-12, "{}", round.effort);
    }

    #[test]
    fn friction_holds_and_the_encoder_shows_what_is_not_there() {
        let mut axis = plant(&[
            (Mechanism::DryOffset, &[0.6]),
            (Mechanism::EncoderScale, &[0.05]),
            (Mechanism::EncoderOffset, &[0.01]),
        ]);
        for _ in 0..50 {
            axis.step(0.5);
        }
        assert_eq!(axis.position(), 0.2);
        assert!((axis.shown() - 0.22).abs() < 1e-15);
        axis.step(0.6);
        assert!(axis.position() > 0.2);
    }
}
