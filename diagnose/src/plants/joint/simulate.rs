//! This file runs a calibrated plant from the recorded inputs, without looking at the recorded output again.

use super::columns::{is_of_brake, of_brake};
use crate::effect::Effect;
use crate::plant::Run;
use crate::plants::joint::run::{JointRun, PlantKind};
use crate::signals::{lagged_yield, shifted};
use rigproof_model::axis::Axis;
use rigproof_model::bench::resistance;
use rigproof_model::effects::{Drive, Form, Instant, Law, first_order_lag, form, law};
use rigproof_spec::effect::Mechanism;
use rustfft::{FftPlannerScalar, num_complex::Complex64};

/// A plant with all its numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Model {
    /// Mass or moment of inertia; unused on a bench.
    pub inertia: f64,
    /// Everything that acts.
    pub effects: Vec<Effect>,
}

/// What the effort does between two samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Interpolation {
    /// It holds, as a digital controller's output does.
    #[default]
    Hold,
    /// It goes straight.
    Linear,
    /// It is band-limited and periodic over the recording.
    Band,
}

/// The protocol of a free run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Protocol {
    /// What the effort does between samples.
    pub interpolation: Interpolation,
    /// Samples from which the start state is estimated (a parabola); 0 starts from rest at the first position.
    pub start_samples: usize,
    /// Integration steps a sample.
    pub substeps: usize,
    /// Periods that are run before the one that counts (a periodic recording in steady state).
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

/// The output of a run: position of an axis, or effort of a bench, one value a sample.
///
/// The first `start_samples` of an axis repeat the recording, because the state is taken from them.
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

fn laws(plant: &Model) -> Vec<Box<dyn Law>> {
    plant
        .effects
        .iter()
        .filter_map(|e| own_law(e).map(|law| with_onset(law, e.onset_s)))
        .collect()
}

/// The law of an effect that is a resistance of its own, not something that a brake does.
fn own_law(effect: &Effect) -> Option<Box<dyn Law>> {
    let is_own = !is_of_brake(effect.mechanism());
    is_own.then(|| law(effect.mechanism(), &effect.parameters))?
}

/// A law that acts from a given time on.
struct Late {
    law: Box<dyn Law>,
    onset_s: f64,
}

impl Law for Late {
    fn smooth(&self, now: &Instant, memory: f64) -> f64 {
        if now.time_s < self.onset_s {
            0.0
        } else {
            self.law.smooth(now, memory)
        }
    }

    fn dry(&self, now: &Instant) -> f64 {
        if now.time_s < self.onset_s {
            0.0
        } else {
            self.law.dry(now)
        }
    }

    fn remembers(&self) -> bool {
        self.law.remembers()
    }

    fn memory_rate(&self, now: &Instant, memory: f64) -> f64 {
        self.law.memory_rate(now, memory)
    }

    fn parts(&self, now: &Instant, memory: f64) -> (f64, f64) {
        if now.time_s < self.onset_s {
            (0.0, 0.0)
        } else {
            self.law.parts(now, memory)
        }
    }

    fn memory_after(&self, memory: f64, travel: f64, speed: f64) -> f64 {
        self.law.memory_after(memory, travel, speed)
    }
}

fn with_onset(law: Box<dyn Law>, onset_s: Option<f64>) -> Box<dyn Law> {
    match onset_s {
        Some(onset_s) => Box::new(Late { law, onset_s }),
        None => law,
    }
}

/// The effort after the changes of the drive: gain, time shift, lag. On an axis the recorded command is ahead of
/// the effort; on a bench `effort` is what the laws give and the recorded one is behind.
fn driven(plant: &Model, effort: &[f64], run: &JointRun) -> Vec<f64> {
    let step_s = run.step_s;
    let mut out = effort.to_vec();
    for effect in &plant.effects {
        let value = effect.value(0);
        let Some(change) = drive_of(effect) else {
            continue;
        };
        let changed = match change {
            Drive::Gain => out.iter().map(|e| e * (1.0 + value)).collect(),
            Drive::Skew => shifted(&out, -value / step_s),
            Drive::Lag => first_order_lag(&out, step_s, value),
            Drive::Limit => out.iter().map(|e| e.min(value).max(-value)).collect(),
        };
        let first = effect.first_sample(run.clock());
        for (o, c) in out.iter_mut().zip(changed).skip(first) {
            *o = c;
        }
    }
    out
}

/// The change of the drive that an effect is.
fn drive_of(effect: &Effect) -> Option<Drive> {
    let Form::Drive(change) = form(effect.mechanism())? else {
        return None;
    };
    Some(change)
}

fn bench(plant: &Model, run: &JointRun) -> Vec<f64> {
    let change = |own: Drive| {
        let mut effects = plant.effects.iter();
        effects.find(|e| drive_of(e) == Some(own))
    };
    let value = |own: Drive| change(own).and_then(|e| e.parameters.first().copied());
    let mut effort = resistance(&laws(plant), &run.motion, run.step_s);
    for effect in plant.effects.iter().filter(|e| is_of_brake(e.mechanism())) {
        let [coefficient, shape @ ..] = effect.parameters.as_slice() else {
            continue;
        };
        let signal = of_brake(run, effect.mechanism(), shape).unwrap_or_default();
        let first = effect.first_sample(run.clock());
        for (e, s) in effort.iter_mut().zip(signal).skip(first) {
            *e += coefficient * s;
        }
    }
    let mut on_sum = vec![Drive::Skew, Drive::Lag];
    if let Some(predicted) = &run.predicted {
        let mut predicted = predicted.clone();
        // The yield of a brake lags; anything else lags as a whole, below.
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
    let rest = Model {
        inertia: 0.0,
        effects: plant
            .effects
            .iter()
            .filter(|e| drive_of(e).is_some_and(|own| on_sum.contains(&own)))
            .cloned()
            .collect(),
    };
    driven(&rest, &effort, run)
}

fn free_run(plant: &Model, run: &JointRun, protocol: &Protocol) -> Vec<f64> {
    let axis = Axis {
        inertia: plant.inertia,
        laws: laws(plant),
    };
    let effort = driven(plant, &run.effort, run);
    let fine = fine_effort(&effort, protocol);
    let (first, position, speed) = start(run, protocol.start_samples);
    let mut state = axis.state(run.start_s + first as f64 * run.step_s, position, speed);
    saturate_presliding(plant, &mut state.memory, speed);
    let mut out = run.position.get(..first).unwrap_or_default().to_vec();
    let step_s = run.step_s / protocol.substeps as f64;
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
            for &(begin, end) in pairs {
                axis.step(&mut state, begin, end, step_s);
            }
        }
    }
    out
}

/// A bristle that has been sliding is bent by all it can bend.
fn saturate_presliding(plant: &Model, memory: &mut [f64], speed: f64) {
    let with_law = plant.effects.iter().filter(|e| own_law(e).is_some());
    for (effect, memory) in with_law.zip(memory) {
        if effect.mechanism() == Mechanism::Presliding && speed != 0.0 {
            *memory = speed.signum();
        }
    }
}

/// Effort at the beginning and the end of every integration step.
fn fine_effort(effort: &[f64], protocol: &Protocol) -> Vec<(f64, f64)> {
    let n = protocol.substeps;
    let next = |k: usize| effort.get(k + 1).or(effort.last()).copied().unwrap_or(0.0);
    match protocol.interpolation {
        Interpolation::Hold => effort
            .iter()
            .flat_map(|&e| core::iter::repeat_n((e, e), n))
            .collect(),
        Interpolation::Linear => effort
            .iter()
            .enumerate()
            .flat_map(|(k, &e)| {
                let slope = (next(k) - e) / n as f64;
                (0..n).map(move |j| (e + slope * j as f64, e + slope * (j + 1) as f64))
            })
            .collect(),
        Interpolation::Band => {
            let fine = band_limited(effort, n);
            let after = fine.iter().skip(1).chain(fine.first());
            fine.iter().copied().zip(after.copied()).collect()
        }
    }
}

/// A periodic signal at `factor` times its rate, by its Fourier series.
fn band_limited(signal: &[f64], factor: usize) -> Vec<f64> {
    let n = signal.len();
    // The scalar planner gives the same bits on every processor.
    let mut planner = FftPlannerScalar::new();
    let mut spectrum: Vec<Complex64> = signal.iter().map(|&x| Complex64::new(x, 0.0)).collect();
    planner.plan_fft_forward(n).process(&mut spectrum);
    let mut wide = vec![Complex64::default(); n * factor];
    let half = n.div_ceil(2);
    for (to, from) in wide.iter_mut().zip(spectrum.iter().take(half)) {
        *to = *from;
    }
    for (to, from) in wide
        .iter_mut()
        .rev()
        .zip(spectrum.iter().rev().take(n - half))
    {
        *to = *from;
    }
    planner.plan_fft_inverse(n * factor).process(&mut wide);
    wide.into_iter().map(|c| c.re / n as f64).collect()
}

/// Start sample, position and speed: the end of a parabola through the first `samples` positions.
fn start(run: &JointRun, samples: usize) -> (usize, f64, f64) {
    if samples < 3 {
        return (0, run.position.first().copied().unwrap_or(0.0), 0.0);
    }
    let last = samples - 1;
    let points: Vec<(f64, f64)> = run
        .position
        .iter()
        .take(samples)
        .enumerate()
        .map(|(k, &x)| ((k as f64 - last as f64) * run.step_s, x))
        .collect();
    let [position, speed, _] = parabola(&points);
    (last, position, speed)
}

/// Least-squares coefficients of 1, t, t².
fn parabola(points: &[(f64, f64)]) -> [f64; 3] {
    let mut gram = nalgebra::Matrix3::zeros();
    let mut right = nalgebra::Vector3::zeros();
    let scale = points.first().map_or(1.0, |p| p.0.abs().max(1e-12));
    for &(t, x) in points {
        let row = nalgebra::Vector3::new(1.0, t / scale, t * t / (scale * scale));
        gram += row * row.transpose();
        right += row * x;
    }
    let c = gram.lu().solve(&right).unwrap_or_default();
    [c.x, c.y / scale, c.z / (scale * scale)]
}

/// The position `count` samples after sample `first`, started from the recorded state there.
pub fn predict(
    plant: &Model,
    run: &JointRun,
    first: usize,
    count: usize,
    protocol: &Protocol,
) -> Option<f64> {
    let begin = run.motion.get(first)?;
    let axis = Axis {
        inertia: plant.inertia,
        laws: laws(plant),
    };
    let effort = driven(plant, run.effort.get(first..first + count)?, run);
    let mut state = axis.state(
        begin.time_s,
        begin.position,
        if begin.sense.abs() < 1.0 {
            0.0
        } else {
            begin.speed
        },
    );
    saturate_presliding(plant, &mut state.memory, state.speed);
    let step_s = run.step_s / protocol.substeps as f64;
    let local = Protocol {
        interpolation: local_interpolation(protocol.interpolation),
        ..*protocol
    };
    for (from, to) in fine_effort(&effort, &local) {
        axis.step(&mut state, from, to, step_s);
    }
    Some(state.position)
}

/// Over a short stretch a band-limited effort goes straight between its samples.
fn local_interpolation(interpolation: Interpolation) -> Interpolation {
    match interpolation {
        Interpolation::Band => Interpolation::Linear,
        other => other,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    use crate::plants::joint::recorded::{INERTIA, NOMINAL, exact_axis};
    use core::f64::consts::TAU;

    #[test]
    fn band_limited_interpolation_is_exact_on_a_multisine() {
        let value = |at: f64| {
            1.3 * libm::sin(TAU * 3.0 * at + 0.4) - 0.7 * libm::cos(TAU * 11.0 * at) + 0.17
        };
        for count in [48, 49] {
            let signal: Vec<f64> = (0..count).map(|k| value(k as f64 / count as f64)).collect();
            let fine = band_limited(&signal, 7);
            assert_eq!(fine.len(), 7 * count);
            for (k, x) in fine.iter().enumerate() {
                let exact = value(k as f64 / (7 * count) as f64);
                assert!(
                    (x - exact).abs() < 1e-12,
                    "{count} samples, {k}: {x} {exact}"
                );
            }
        }
    }

    #[test]
    fn the_start_state_of_a_parabola_is_its_end() {
        let mut run = exact_axis(NOMINAL, 40, true);
        let at = |t: f64| 0.37 - 1.9 * t + 5.3 * t * t;
        for (k, x) in run.position.iter_mut().enumerate() {
            *x = at(k as f64 * run.step_s);
        }
        let (first, position, speed) = start(&run, 17);
        let t = 16.0 * run.step_s;
        assert_eq!(first, 16);
        assert!((position - at(t)).abs() < 1e-12, "{position}");
        assert!((speed - (10.6 * t - 1.9)).abs() < 1e-9, "{speed}");
    }

    #[test]
    fn a_held_effort_and_a_straight_one_differ_inside_the_step() {
        let protocol = |interpolation| Protocol {
            interpolation,
            substeps: 2,
            ..Protocol::default()
        };
        let effort = [0.3, 1.1, -0.7];
        let held = fine_effort(&effort, &protocol(Interpolation::Hold));
        assert_eq!(held[2..4], [(1.1, 1.1), (1.1, 1.1)]);
        let straight = fine_effort(&effort, &protocol(Interpolation::Linear));
        for ((begin, end), expected) in straight[2..4].iter().zip([(1.1, 0.2), (0.2, -0.7)]) {
            assert!((begin - expected.0).abs() + (end - expected.1).abs() < 1e-12);
        }
    }

    fn plant() -> Model {
        Model {
            inertia: INERTIA,
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
