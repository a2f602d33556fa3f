//! This file simulates a plant from the recorded inputs, without feeding back the recorded output.

use super::columns::{is_of_brake, of_effect, under_load};
use super::drive::{drive_of, driven, fine_effort, local_interpolation};
use super::encoder::{behind, shown};
use super::laws::{bend_bristles, laws};
use super::start::begun;
use crate::effect::Effect;
use crate::plant::{Clock, Run};
use crate::plants::joint::run::{JointRun, PlantKind};
use crate::rules::MOST_TRAILING;
use crate::signals::lagged_yield;
use rigproof_model::axis::{Axis, State, Trailing, Transmission};
use rigproof_model::bench::resistance;
use rigproof_model::effects::{Drive, Form, OfJoint, form};

/// A plant with all its parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct Model {
    /// Mass or moment of inertia; unused on a bench.
    pub inertia: f64,
    /// Everything that acts; the described effects come first, in the order of the description.
    pub effects: Vec<Effect>,
    /// The number of described effects. A fade acts on the described effects before it.
    pub described: usize,
}

/// How the effort is interpolated between two samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Interpolation {
    /// Held, as a digital controller's output is.
    #[default]
    Hold,
    /// Linear.
    Linear,
    /// Band-limited and periodic over the recording.
    Band,
}

/// The protocol of a free run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Protocol {
    /// How the effort is interpolated.
    pub interpolation: Interpolation,
    /// Samples from which the start state is estimated: a parabola, then a fit to the samples after
    /// it. With 0 the run starts from rest at the first position.
    pub start_samples: usize,
    /// Integration steps per sample.
    pub substeps: usize,
    /// Periods that are simulated before the one that is compared (a periodic recording in steady
    /// state).
    pub warm_up_periods: usize,
}

impl Default for Protocol {
    fn default() -> Protocol {
        Protocol {
            interpolation: Interpolation::Hold,
            start_samples: 20,
            substeps: 1,
            warm_up_periods: 0,
        }
    }
}

/// The output of a free run: the position of an axis or the effort of a bench, one value per
/// sample.
///
/// The first `start_samples` of an axis repeat the recording, because they give the start state.
pub fn output(plant: &Model, run: &JointRun, protocol: &Protocol) -> Vec<f64> {
    if !run.parts.is_empty() {
        let each = run
            .parts
            .iter()
            .flat_map(|part| output(plant, part, protocol));
        return each.collect();
    }
    match run.plant {
        PlantKind::Axis => free_run(plant, run, protocol),
        PlantKind::Bench => bench(plant, run),
    }
}

fn bench(plant: &Model, run: &JointRun) -> Vec<f64> {
    let change = |own: Drive| {
        let mut effects = plant.effects.iter();
        effects.find(|e| drive_of(e) == Some(own))
    };
    let value = |own: Drive| change(own).and_then(|e| e.parameters.first().copied());
    let mut effort = resistance(&laws(plant), &run.motion, run.step_s);
    let is_of_load = |e: &Effect| matches!(form(e.mechanism()), Some(Form::Joint(OfJoint::Load)));
    for effect in &plant.effects {
        let signal = match is_of_load(effect) {
            true => under_load(run, &effect.parameters),
            false if is_of_brake(effect.cause) => of_effect(run, effect),
            false => continue,
        };
        let signal = signal.unwrap_or_default();
        let first = effect.first_sample(run.clock());
        for (e, s) in effort.iter_mut().zip(signal).skip(first) {
            *e += s;
        }
    }
    let mut on_sum = vec![Drive::Skew, Drive::Lag];
    if let Some(predicted) = &run.predicted {
        let mut predicted = predicted.clone();
        // The yield torque of a brake lags here; on other benches the whole effort lags, below.
        if let (Some(time_constant_s), Some(_)) = (value(Drive::Lag), &run.current) {
            let first = change(Drive::Lag).map_or(0, |e| e.first_sample(run.clock()));
            let lagged = lagged_yield(&predicted, run.step_s, time_constant_s);
            for (p, l) in predicted.iter_mut().zip(lagged).skip(first) {
                *p = l;
            }
            on_sum.pop();
        }
        let gain = 1.0 + value(Drive::Gain).unwrap_or(0.0);
        for (e, p) in effort.iter_mut().zip(predicted) {
            *e += gain * p;
        }
    }
    let rest = plant.effects.iter();
    let rest = rest.filter(|e| drive_of(e).is_some_and(|own| on_sum.contains(&own)));
    driven(rest.chain(&run.metered_by), &effort, run, 0)
}

/// A joint in a free run. Changes of the joint itself, such as added inertia, start at their
/// onsets.
pub(super) struct Free {
    pub(super) axis: Axis,
    inertia: f64,
    of_joint: Vec<(OfJoint, Effect)>,
}

impl Free {
    fn of(plant: &Model) -> Free {
        let of_joint = plant
            .effects
            .iter()
            .filter_map(|effect| match form(effect.mechanism())? {
                Form::Joint(own) => Some((own, effect.clone())),
                _ => None,
            });
        Free {
            axis: Axis {
                inertia: plant.inertia,
                laws: laws(plant),
                transmission: Transmission::default(),
            },
            inertia: plant.inertia,
            of_joint: of_joint.collect(),
        }
    }

    /// Updates the joint to a time.
    pub(super) fn take_hold(&mut self, time_s: f64) {
        if self.of_joint.is_empty() {
            return;
        }
        self.axis.inertia = self.inertia;
        self.axis.transmission = Transmission::default();
        let begun = |onset_s: f64| onset_s <= time_s;
        let mut gap = None;
        for (of, effect) in &self.of_joint {
            if !effect.onset_s.is_none_or(begun) {
                continue;
            }
            match of {
                OfJoint::Inertia => self.axis.inertia += effect.value(0),
                OfJoint::Load => self.axis.transmission.add_friction(&effect.parameters),
                OfJoint::Compliance => {
                    let mut part = Trailing::of(&effect.parameters);
                    part.share = part.share.min(MOST_TRAILING);
                    self.axis.transmission.trailing[0] = Some(part);
                }
                OfJoint::Gap => gap = Some(effect),
                // These act through the laws.
                OfJoint::Fade | OfJoint::Link | OfJoint::Stiffness | OfJoint::Lash => {}
            }
        }
        self.axis.inertia = self.axis.inertia.max(LEAST_INERTIA * self.inertia);
        // What hangs on the joint is less than the whole of it, with all that was added.
        let [spring, part] = &mut self.axis.transmission.trailing;
        let left = MOST_TRAILING - spring.map_or(0.0, |own| own.share);
        *part = gap.map(|own| {
            let share = (own.value(0) / self.axis.inertia).min(left);
            Trailing::in_a_gap(share, own.value(1))
        });
    }

    pub(super) fn run(&mut self, state: &mut State, efforts: &[(f64, f64)], step_s: f64) {
        for &(begin, end) in efforts {
            self.axis.step(state, begin, end, step_s);
        }
    }
}

/// The smallest share of the inertia that a negative added inertia may leave.
const LEAST_INERTIA: f64 = 1e-3;

fn free_run(plant: &Model, run: &JointRun, protocol: &Protocol) -> Vec<f64> {
    let clock = run.clock();
    let effort = driven(&plant.effects, &run.effort, run, 0);
    let fine = fine_effort(&effort, protocol);
    let there = behind(&plant.effects, &run.position, clock);
    let step_s = run.step_s / protocol.substeps as f64;
    let mut free = Free::of(plant);
    let (first, mut state) = begun((plant, &mut free), (run, &there), &fine, protocol);
    let mut out = there.get(..first).unwrap_or_default().to_vec();
    if let Some(servo) = &run.servo {
        let begun = (first, &mut state);
        out.extend(servo.free_run((plant, &mut free), begun, protocol, step_s));
        return shown(&plant.effects, out, clock);
    }
    for period in 0..=protocol.warm_up_periods {
        let counts = period == protocol.warm_up_periods;
        let from = if period == 0 { first } else { 0 };
        if counts && period > 0 {
            out.clear();
        }
        for pairs in fine.chunks(protocol.substeps).skip(from) {
            if counts {
                out.push(state.position);
            }
            free.take_hold(state.time_s);
            free.run(&mut state, pairs, step_s);
        }
    }
    shown(&plant.effects, out, clock)
}

/// The position `count` samples after sample `first`, started from the recorded state there.
pub fn predict(
    plant: &Model,
    run: &JointRun,
    first: usize,
    count: usize,
    protocol: &Protocol,
) -> Option<f64> {
    let clock = run.clock();
    let efforts = run.effort.get(first..first + count)?;
    let effort = driven(&plant.effects, efforts, run, first);
    let begin = run.motion.get(first)?;
    let seen = [begin, run.motion.get(first + 1)?].map(|now| now.position);
    let stretch = Clock {
        start_s: begin.time_s,
        samples: 2,
        ..clock
    };
    let there = behind(&plant.effects, &seen, stretch);
    let &[position, next] = there.as_slice() else {
        return None;
    };
    // A scale error of the encoder scales the shown speed too.
    let shows = |seen: f64, is: f64| if is == 0.0 { 1.0 } else { seen / is };
    let speed = match begin.sense.abs() < 1.0 {
        true => 0.0,
        false => begin.speed / shows(seen[1] - seen[0], next - position),
    };
    let step_s = run.step_s / protocol.substeps as f64;
    let mut free = Free::of(plant);
    let mut state = free.axis.state(begin.time_s, position, speed);
    bend_bristles(plant, &mut state.memory, speed);
    let local = Protocol {
        interpolation: local_interpolation(protocol.interpolation),
        ..*protocol
    };
    for pairs in fine_effort(&effort, &local).chunks(protocol.substeps) {
        free.take_hold(state.time_s);
        free.run(&mut state, pairs, step_s);
    }
    let end = Clock {
        start_s: state.time_s,
        samples: 1,
        ..clock
    };
    shown(&plant.effects, vec![state.position], end).pop()
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    use crate::plants::joint::recorded::{INERTIA, NOMINAL, exact_axis};
    use rigproof_spec::effect::Mechanism;

    pub fn plant() -> Model {
        Model {
            inertia: INERTIA,
            described: NOMINAL.len(),
            effects: NOMINAL
                .iter()
                .map(|(mechanism, parameters)| Effect::of(*mechanism, parameters))
                .collect(),
        }
    }

    #[test]
    fn a_free_run_with_the_true_numbers_is_the_recording() {
        let run = exact_axis(NOMINAL, 1900, true);
        let protocol = Protocol {
            start_samples: 0,
            ..Protocol::default()
        };
        let simulated = output(&plant(), &run, &protocol);
        assert_eq!(simulated.len(), run.len());
        let worst = simulated
            .iter()
            .zip(&run.position)
            .map(|(s, r)| (s - r).abs())
            .fold(0.0, f64::max);
        assert!(worst < 1e-9, "{worst} m");
        let ahead = predict(&plant(), &run, 611, 700, &protocol).unwrap();
        assert!((ahead - run.position[1311]).abs() < 1e-8, "{ahead}");
    }

    #[test]
    fn what_hangs_in_a_gap_keeps_its_inertia_and_leaves_some_of_the_joint() {
        let mut heavier = plant();
        heavier.effects.extend([
            Effect::of(Mechanism::LoadBacklash, &[0.43, 0.013]),
            Effect::of(Mechanism::AddedInertia, &[0.7]),
        ]);
        let mut free = Free::of(&heavier);
        free.take_hold(0.0);
        let [_, part] = free.axis.transmission.trailing;
        let held = part.unwrap().share * free.axis.inertia;
        assert!((held - 0.43).abs() < 1e-12, "{held} kg");
        let compliance = Effect::of(Mechanism::Compliance, &[0.9, 61.0, 0.11]);
        heavier.effects.push(compliance);
        let mut free = Free::of(&heavier);
        free.take_hold(0.0);
        let parts = free.axis.transmission.trailing.into_iter().flatten();
        assert!(parts.map(|part| part.share).sum::<f64>() < 1.0);
    }

    #[test]
    fn an_effect_acts_from_its_onset_on() {
        let run = exact_axis(NOMINAL, 900, true);
        let mut late = plant();
        let onset_s = 401.5 * run.step_s;
        late.effects.push(Effect {
            onset_s: Some(onset_s),
            ..Effect::of(Mechanism::ConstantBias, &[2.7])
        });
        let protocol = Protocol::default();
        let (without, with) = (
            output(&plant(), &run, &protocol),
            output(&late, &run, &protocol),
        );
        assert_eq!(without[..402], with[..402]);
        assert!((without[899] - with[899]).abs() > 1e-3);
    }
}
