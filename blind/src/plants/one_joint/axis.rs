//! This file moves a driven joint with dry friction: an implicit stick-slip step that ends phases where they end.
//!
//! Inside a fine step the motion is a chain of phases of constant direction. At rest the friction is the set
//! [−F, F] and the joint stays while the net effort is inside (complementarity, as in Moreau 1988 and Jean 1999);
//! sliding is the implicit midpoint rule; a phase that would carry the velocity through zero is cut there. Friction
//! therefore never drives, at any step.

use super::run::{Delay, Run, skew_s};
use super::setup::{Drive, Setup};
use crate::effect::Effect;
use crate::element::{Element, Instant, sliding_resistance, total_bound};
use crate::form::{Form, Stage};

/// Runs the joint with the laws the nominal model knows and the hidden effects, `fine_steps` to a sample.
pub fn run(
    setup: &Setup,
    drive: &Drive,
    known: &[Effect],
    hidden: &[Effect],
    fine_steps: usize,
) -> Run {
    let step_s = 1.0 / (setup.rate_hz * fine_steps as f64);
    let samples = (setup.duration_s * setup.rate_hz) as usize;
    let mut joint = Joint::new(drive.inertia, known, hidden);
    let mut amplifier = Amplifier::new(drive.gain, hidden);
    let delay_s = skew_s(hidden);
    let mut late_position = Delay::new(delay_s, step_s);
    let mut late_command = Delay::new(delay_s.abs(), step_s);
    let mut run = Run::new(hidden.len(), samples);
    let mut last_velocity = joint.velocity;
    for fine in 0..samples * fine_steps {
        let time_s = fine as f64 * step_s;
        let command_v = command(setup, drive, time_s, joint.position, joint.velocity);
        late_position.push(joint.position);
        late_command.push(command_v);
        if fine.is_multiple_of(fine_steps) {
            let shown = late_position.value();
            run.take(time_s, joint.position, joint.velocity, shown);
            run.shown_input.push(if delay_s < 0.0 {
                late_command.value()
            } else {
                command_v
            });
            let at = joint.instant(time_s, amplifier.effort(time_s, command_v));
            let skewed = drive.gain * (late_command.value() - command_v);
            let upstream = at.load - drive.gain * command_v;
            for (effect, force) in hidden.iter().zip(&mut run.hidden) {
                force.push(match effect.stage() {
                    Stage::Sensor => skewed,
                    Stage::Drive => upstream,
                    _ => joint.resistance_of(effect, &at),
                });
            }
        }
        let middle_s = time_s + 0.5 * step_s;
        let middle = joint.position + 0.5 * step_s * joint.velocity;
        // The velocity half a step ahead, by extrapolation: with this step's own start velocity the servo's damping
        // would act late and look like a smaller inertia.
        let ahead = joint.velocity + 0.5 * (joint.velocity - last_velocity);
        let middle_v = command(setup, drive, middle_s, middle, ahead);
        last_velocity = joint.velocity;
        amplifier.advance(time_s, middle_v, 0.5 * step_s);
        let effort = amplifier.effort(middle_s, middle_v);
        amplifier.advance(middle_s, middle_v, 0.5 * step_s);
        joint.step(time_s, effort, step_s);
    }
    run
}

/// The servo's command at an instant, V.
fn command(setup: &Setup, drive: &Drive, time_s: f64, position: f64, velocity: f64) -> f64 {
    let (reference, reference_rate) = setup.path.at(time_s);
    let (target, target_rate) = if drive.tracks {
        (reference, reference_rate)
    } else {
        (0.0, 0.0)
    };
    let command_v = drive.feedforward * reference
        + drive.proportional * (target - position)
        + drive.derivative * (target_rate - velocity);
    command_v.clamp(-drive.limit_v, drive.limit_v)
}

/// From command to effort, with at most one hidden effect on the way.
struct Amplifier {
    gain: f64,
    hidden: Option<Effect>,
    lagged_v: f64,
}

impl Amplifier {
    fn new(gain: f64, hidden: &[Effect]) -> Amplifier {
        Amplifier {
            gain,
            hidden: hidden.iter().copied().find(|e| e.stage() == Stage::Drive),
            lagged_v: 0.0,
        }
    }

    fn effort(&self, time_s: f64, command_v: f64) -> f64 {
        let ideal = self.gain * command_v;
        match self.hidden.filter(|hidden| hidden.acts(time_s)) {
            None => ideal,
            Some(hidden) => match hidden.form {
                Form::Gain => (1.0 + hidden.first()) * ideal,
                Form::Lag => self.gain * self.lagged_v,
                Form::DeadZone => ideal.signum() * (ideal.abs() - hidden.first()).max(0.0),
                Form::Saturation => ideal.clamp(-hidden.first(), hidden.first()),
                _ => ideal,
            },
        }
    }

    fn advance(&mut self, time_s: f64, command_v: f64, step_s: f64) {
        let lag = self
            .hidden
            .filter(|hidden| hidden.form == Form::Lag && hidden.acts(time_s));
        self.lagged_v = lag.map_or(command_v, |lag| {
            command_v + (self.lagged_v - command_v) * libm::exp(-step_s / lag.first())
        });
    }
}

/// The mass and everything that resists it.
pub struct Joint {
    inertia: f64,
    elements: Vec<Element>,
    position: f64,
    velocity: f64,
    direction: f64,
}

/// Phases of constant direction inside one fine step: slide, stop, slide back, stop.
const PHASES: usize = 4;

impl Joint {
    /// A joint at rest at zero, with the laws that are known and the hidden ones.
    pub fn new(inertia: f64, known: &[Effect], hidden: &[Effect]) -> Joint {
        Joint {
            inertia,
            elements: known
                .iter()
                .chain(hidden)
                .copied()
                .map(Element::new)
                .collect(),
            position: 0.0,
            velocity: 0.0,
            direction: 1.0,
        }
    }

    fn instant(&self, time_s: f64, effort: f64) -> Instant {
        Instant {
            time_s,
            position: self.position,
            velocity: self.velocity,
            direction: self.direction,
            load: effort,
            brake: 0.0,
        }
    }

    fn resistance_of(&self, effect: &Effect, at: &Instant) -> f64 {
        self.elements
            .iter()
            .filter(|element| element.effect == *effect)
            .map(|element| element.force(at, 0.0, 0.0) + at.direction * element.bound(at))
            .sum()
    }

    pub const fn position(&self) -> f64 {
        self.position
    }

    pub const fn velocity(&self) -> f64 {
        self.velocity
    }

    /// Moves under an effort that holds over a step.
    pub fn step(&mut self, time_s: f64, effort: f64, step_s: f64) {
        let mut left_s = step_s;
        for _ in 0..PHASES {
            let at = self.instant(time_s + step_s - left_s, effort);
            if self.velocity == 0.0 {
                match self.breakaway(&at) {
                    Some(direction) => self.direction = direction,
                    None => return self.settle(&at, 0.0, left_s),
                }
            }
            let at = Instant {
                direction: self.direction,
                ..at
            };
            let velocity = self.slide(&at, left_s);
            if velocity * self.direction >= 0.0 {
                let travel = 0.5 * (self.velocity + velocity) * left_s;
                self.settle(&at, travel, left_s);
                self.velocity = velocity;
                return;
            }
            let part_s = left_s * self.velocity / (self.velocity - velocity);
            self.settle(&at, 0.5 * self.velocity * part_s, part_s);
            self.velocity = 0.0;
            left_s -= part_s;
            if part_s == 0.0 {
                return;
            }
        }
    }

    /// The direction in which a joint at rest begins to slide, or `None` while friction holds it.
    fn breakaway(&self, at: &Instant) -> Option<f64> {
        let force: f64 = self.elements.iter().map(|e| e.force(at, 0.0, 0.0)).sum();
        let net = at.load - force;
        let direction = net.signum();
        let bound = total_bound(&self.elements, &Instant { direction, ..*at });
        (net.abs() > bound).then_some(direction)
    }

    /// Velocity after sliding for a time: the midpoint rule, corrected twice.
    fn slide(&self, at: &Instant, step_s: f64) -> f64 {
        let mut velocity = self.velocity;
        for _ in 0..2 {
            let mean = 0.5 * (self.velocity + velocity);
            let middle = Instant {
                time_s: at.time_s + 0.5 * step_s,
                position: at.position + 0.25 * step_s * (self.velocity + mean),
                velocity: mean,
                ..*at
            };
            let travel = middle.position - at.position;
            let resistance = sliding_resistance(&self.elements, &middle, travel, 0.5 * step_s);
            velocity = self.velocity + step_s * (at.load - resistance) / self.inertia;
        }
        velocity
    }

    fn settle(&mut self, at: &Instant, travel: f64, step_s: f64) {
        for element in &mut self.elements {
            element.advance(at, travel, step_s);
        }
        self.position += travel;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A mass on dry friction loses its speed at a constant rate and then stays.
    #[test]
    fn a_thrown_mass_stops_after_the_distance_of_coulomb() {
        let mut joint = Joint::new(0.7, &[Form::Coulomb.of([1.3])], &[]);
        joint.velocity = -2.1;
        joint.direction = -1.0;
        for k in 0..40_000 {
            joint.step(f64::from(k) * 1e-4, 0.0, 1e-4);
        }
        assert_eq!(joint.velocity, 0.0);
        // m v² / (2 F) by hand.
        assert!((joint.position + 0.7 * 2.1 * 2.1 / 2.6).abs() < 1e-9);
    }

    #[test]
    fn a_push_below_the_bound_moves_nothing_and_one_above_does() {
        let mut joint = Joint::new(0.7, &[Form::Coulomb.of([1.3])], &[]);
        for k in 0..1000 {
            joint.step(f64::from(k) * 1e-4, 1.299, 1e-4);
        }
        assert_eq!((joint.position, joint.velocity), (0.0, 0.0));
        for k in 0..1000 {
            joint.step(f64::from(k) * 1e-4, -1.37, 1e-4);
        }
        assert!((joint.velocity + 0.07 / 0.7 * 0.1).abs() < 1e-12);
    }

    #[test]
    fn a_spring_without_friction_keeps_its_energy() {
        let mut joint = Joint::new(0.013, &[Form::Spring.of([1.7])], &[]);
        joint.position = 0.37;
        let energy_j = |joint: &Joint| {
            0.5 * 0.013 * joint.velocity * joint.velocity
                + 0.5 * 1.7 * joint.position * joint.position
        };
        let before_j = energy_j(&joint);
        for k in 0..200_000 {
            joint.step(f64::from(k) * 5e-5, 0.0, 5e-5);
        }
        assert!((energy_j(&joint) / before_j - 1.0).abs() < 1e-5);
    }

    #[test]
    fn friction_never_gives_energy_back() {
        let laws = [
            Form::Coulomb.of([0.03]),
            Form::Viscous.of([0.011]),
            Form::Stribeck.of([0.02, 0.05, 2.0]),
            Form::Asymmetric.of([-0.017, 0.004]),
        ];
        let mut joint = Joint::new(0.004, &laws, &[]);
        let step_s = 5e-5;
        for k in 0..400_000 {
            let time_s = f64::from(k) * step_s;
            let effort = 0.071 * libm::sin(7.3 * time_s) + 0.02 * libm::sin(31.7 * time_s);
            let (position, velocity) = (joint.position, joint.velocity);
            joint.step(time_s, effort, step_s);
            let gained_j = 0.5 * 0.004 * (joint.velocity * joint.velocity - velocity * velocity);
            let work_j = effort * (joint.position - position);
            assert!(
                gained_j <= work_j + 1e-15,
                "step {k}: {gained_j} J from {work_j} J"
            );
        }
    }
}
