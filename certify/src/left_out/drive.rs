//! This file says what the brakes get of a command where what a calibration found makes it late, wrong, limited or hysteretic.

use std::collections::VecDeque;

use rigproof_model::effects::{CurrentPlay, Form, OfBrake, PLAYS, Played, form, limited};
use rigproof_spec::tables::GREATEST_CURRENT_A;

use super::LeftOut;

/// Longest dead time, s: beyond every trial's sense.
pub const LONGEST_S: f64 = 1.0;

/// What lies between command and current of every brake; a delay acts before the gain, that before a limit and that before the magnet, as in the
/// reference.
#[derive(Clone, Debug, Default)]
pub struct Amplifiers {
    each: [Amplifier; 4],
    is_plain: bool,
}

#[derive(Clone, Debug)]
struct Amplifier {
    late_steps: f64,
    times: f64,
    /// The limit, A, and how sharply the current bends towards it.
    limits: Vec<[f64; 2]>,
    /// Share, play, and where that stands, A; where it stands is not known before the first command.
    plays: Vec<(f64, CurrentPlay, Played)>,
    /// Commands, the newest first, A.
    past_a: VecDeque<f64>,
}

impl Default for Amplifier {
    fn default() -> Amplifier {
        Amplifier {
            late_steps: 0.0,
            times: 1.0,
            limits: Vec::new(),
            plays: Vec::new(),
            past_a: VecDeque::new(),
        }
    }
}

impl Amplifiers {
    /// The amplifiers of a plant with these effects, told every so many seconds.
    pub fn new(left_out: &[LeftOut], step_s: f64) -> Amplifiers {
        let mut all = Amplifiers {
            is_plain: true,
            ..Amplifiers::default()
        };
        for one in left_out {
            let place = one.joint.map(|joint| joint as usize);
            let Some(own) = place.and_then(|place| all.each.get_mut(place)) else {
                continue;
            };
            match form(one.mechanism) {
                Some(Form::Brake(OfBrake::DeadTime)) => own.late_steps += one.number(0) / step_s,
                Some(Form::Brake(OfBrake::CurrentGain)) => own.times *= one.number(0),
                Some(Form::Brake(OfBrake::Saturation)) => {
                    own.limits.push([one.number(0), one.number(1)])
                }
                Some(Form::Brake(OfBrake::CurrentHysteresis)) => {
                    let play = CurrentPlay {
                        half_width_a: one.number(0),
                        closing_a: one.number(2),
                        spread: one.number(3),
                        top_a: one.number(4),
                    };
                    own.plays.push((one.number(1), play, [0.0; PLAYS]));
                }
                _ => continue,
            }
            all.is_plain = false;
        }
        all
    }

    /// What the brakes get over a step when they are commanded so much, A: never more than the tables are for.
    #[inline]
    pub fn given(&mut self, commanded_a: [f64; 4]) -> [f64; 4] {
        if self.is_plain {
            return commanded_a;
        }
        let mut given_a = commanded_a;
        for (amplifier, current_a) in self.each.iter_mut().zip(&mut given_a) {
            *current_a = amplifier.given(*current_a);
        }
        given_a
    }
}

impl Amplifier {
    fn given(&mut self, commanded_a: f64) -> f64 {
        let mut current_a = self.times * self.late(commanded_a);
        for numbers in &self.limits {
            current_a = limited(current_a, numbers);
        }
        for (share, play, played) in &mut self.plays {
            *played = play.moved(*played, current_a);
            current_a += *share * (play.held_a(played) - current_a);
        }
        current_a.clamp(0.0, GREATEST_CURRENT_A)
    }

    /// The mean of what was commanded over a step so much earlier; what was commanded first was always commanded.
    fn late(&mut self, commanded_a: f64) -> f64 {
        self.past_a.push_front(commanded_a);
        let (whole, part) = (libm::floor(self.late_steps), self.late_steps.fract());
        let at = |steps: usize| self.past_a.get(steps).or(self.past_a.back());
        let of = |steps: usize| at(steps).copied().unwrap_or(commanded_a);
        let late_a = (1.0 - part) * of(whole as usize) + part * of(whole as usize + 1);
        self.past_a.truncate(whole as usize + 2);
        late_a
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rigproof_spec::effect::Mechanism;
    use rigproof_spec::joint::Joint;

    fn effect(mechanism: Mechanism, parameters: &[f64]) -> LeftOut {
        LeftOut {
            mechanism,
            joint: Some(Joint::E),
            parameters: parameters.to_vec(),
        }
    }

    /// What brake E gets of a command that goes up and down.
    fn given(effects: &[LeftOut]) -> Vec<f64> {
        let mut all = Amplifiers::new(effects, 1e-3);
        let commanded = [0.0, 0.3, 0.9, 0.9, 0.4, 0.1, 0.0, 0.0];
        let one = |a: f64| all.given([0.2, a, 0.0, 0.0]);
        let all: Vec<[f64; 4]> = commanded.into_iter().map(one).collect();
        assert!(all.iter().all(|a| a[0] == 0.2 && a[2] == 0.0));
        all.into_iter().map(|a| a[1]).collect()
    }

    #[track_caller]
    fn is(effects: &[LeftOut], expected: [f64; 8]) {
        let own = given(effects);
        for (own, expected) in own.iter().zip(expected) {
            assert!((own - expected).abs() < 1e-12, "{own} {expected}");
        }
    }

    #[test]
    fn a_command_is_late_multiplied_cut_and_held_back() {
        is(&[], [0.0, 0.3, 0.9, 0.9, 0.4, 0.1, 0.0, 0.0]);
        let late = effect(Mechanism::DeadTime, &[0.0015]);
        is(
            std::slice::from_ref(&late),
            [0.0, 0.0, 0.15, 0.6, 0.9, 0.65, 0.25, 0.05],
        );
        let gain = effect(Mechanism::CurrentGain, &[0.5]);
        let limit = effect(Mechanism::Saturation, &[0.4]);
        is(&[limit, gain], [0.0, 0.15, 0.4, 0.4, 0.2, 0.05, 0.0, 0.0]);
        let bent = effect(Mechanism::Saturation, &[0.3, 1.0]);
        is(
            &[bent],
            [0.0, 0.15, 0.225, 0.225, 0.12 / 0.7, 0.075, 0.0, 0.0],
        );
        let play = effect(Mechanism::CurrentHysteresis, &[0.2, 1.0, 0.0]);
        is(&[play], [0.0, 0.1, 0.7, 0.7, 0.6, 0.3, 0.2, 0.2]);
        // More than the table is for is not given.
        let gain = effect(Mechanism::CurrentGain, &[3.0]);
        is(&[gain], [0.0, 0.9, 1.0, 1.0, 1.0, 0.3, 0.0, 0.0]);
    }
}
