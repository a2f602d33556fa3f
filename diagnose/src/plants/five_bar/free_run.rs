//! This file runs the reference rig freely from recorded force and currents, restarted from the
//! recorded state again and again.

use super::from_rig::{nominal, with_angles};
use super::run::{FiveBarRun, joint_at};
use crate::cause::{Place, Scales};
use crate::effect::Effect;
use crate::filter::rms;
use crate::plant::Run;
use crate::plants::joint::free_run::HORIZONS_S;
use crate::report::Horizon;
use crate::rules::{MOST_OF_PART, SHOTS};
use crate::signals::shifted;
use core::ops::Range;
use rigproof_model::effects::facts::Family;
use rigproof_model::effects::{Drive, Form, OfLinkage, OfSensor, facts, form};
use rigproof_model::error::ModelError;
use rigproof_model::rig::{JointEffect, LONGEST_STEP_S, Parameters, Rig};
use rigproof_spec::geometry::Arms;
use rigproof_spec::joint::Joint;
use rigproof_spec::layout::Layout;
use rigproof_spec::tables::GREATEST_CURRENT_A;
use rigproof_trace::rig::five_bar::FiveBar;

/// A five-bar with all its parameters: the effects on the rig and those of its sensors.
#[derive(Clone, Debug, PartialEq)]
pub struct Model {
    pub(super) rig: Vec<JointEffect>,
    /// Effects of the sensors, and arms of other lengths: all that changes the recorded angles and
    /// forces.
    pub(super) sensors: Vec<Effect>,
}

impl Model {
    /// The model of a description.
    pub fn of(description: &FiveBar) -> Model {
        Model::with(nominal(description))
    }

    fn with(effects: Vec<Effect>) -> Model {
        let (sensors, rig): (Vec<Effect>, Vec<Effect>) =
            effects.into_iter().partition(is_of_readings);
        let rig = rig.into_iter().map(|own| JointEffect {
            mechanism: own.cause.mechanism,
            joint: joint_at(own.cause.at),
            of_torque: own.cause.scales == Scales::Torque,
            parameters: own.parameters,
            onset_s: own.onset_s,
        });
        Model {
            rig: rig.collect(),
            sensors,
        }
    }

    /// The geometry and masses with the arm lengths of these effects.
    pub(super) fn parameters(&self, parameters: &Parameters) -> Parameters {
        let mut own = *parameters;
        for effect in &self.sensors {
            if let (Some(Form::Linkage(OfLinkage::LinkLength)), Some(joint)) =
                (form(effect.mechanism()), joint_at(effect.cause.at))
            {
                *length_of(&mut own.arms, joint) += effect.value(0);
            }
        }
        own
    }

    /// Why the reference rig cannot have all effects; `None` if it can.
    pub(super) fn not_computed(&self, layout: Layout) -> Option<String> {
        if let Some(why) = self.sensors.iter().find_map(not_shown) {
            return Some(why);
        }
        let tip_m = [0.0, MIDDLE_M];
        let rig = Rig::new(layout, tip_m).and_then(|rig| rig.with_effects(&self.rig));
        rig.err().map(|error| error.to_string())
    }
}

/// Why no sensor of this rig can have an effect; `None` if one can.
fn not_shown(effect: &Effect) -> Option<String> {
    let name = effect.mechanism().name();
    let form = form(effect.mechanism())?;
    let is_at_encoder = matches!(joint_at(effect.cause.at), Some(Joint::A | Joint::B));
    match form {
        Form::Linkage(OfLinkage::LinkLength) if effect.onset_s.is_some() => Some(format!(
            "`{name}` has an onset, and no arm grows: take the onset out"
        )),
        Form::Sensor(OfSensor::Clock) => Some(format!(
            "`{name}` is nothing that this five-bar computes: take it out"
        )),
        _ if form.is_of_encoder() && !is_at_encoder => Some(format!(
            "`{name}` is at a joint without an encoder: only A and B have one"
        )),
        _ => None,
    }
}

/// The length of the arm that begins at a joint.
pub(super) const fn length_of(arms: &mut Arms, joint: Joint) -> &mut f64 {
    match joint {
        Joint::A => &mut arms.l_ae_m,
        Joint::E => &mut arms.l_ed_m,
        Joint::B => &mut arms.l_bc_m,
        Joint::C => &mut arms.l_cd_m,
    }
}

/// A height that the tip of every layout can reach, m.
const MIDDLE_M: f64 = 0.4;

fn is_of_readings(effect: &Effect) -> bool {
    let is_of_sensors =
        facts(effect.mechanism()).is_some_and(|facts| facts.family == Family::Sensor);
    is_of_sensors
        || matches!(
            form(effect.mechanism()),
            Some(Form::Linkage(OfLinkage::LinkLength))
        )
}

/// The recording with the sensors' effects on force and angles inverted.
pub(super) fn truly(model: &Model, run: &FiveBarRun) -> Result<FiveBarRun, ModelError> {
    let mut own = run.clone();
    own.parameters = model.parameters(&run.parameters);
    for effect in &model.sensors {
        let first = effect.first_sample(run.clock());
        let value = |k: usize| effect.value(k);
        let [force_x, force_y] = &mut own.force;
        match form(effect.mechanism()) {
            Some(Form::Drive(Drive::Skew)) => {
                for force in [force_x, force_y] {
                    let earlier = shifted(force, value(0) / run.step_s);
                    let pairs = force.iter_mut().zip(earlier).skip(first);
                    pairs.for_each(|(f, e)| *f = e);
                }
            }
            Some(form @ Form::Sensor(of)) if form.is_of_encoder() => {
                let [a, b] = &mut own.theta;
                let angle = match joint_at(effect.cause.at) {
                    Some(Joint::A) => a,
                    _ => b,
                };
                let shown = angle.iter_mut().skip(first);
                shown.for_each(|theta| *theta = of.behind(*theta, &effect.parameters));
            }
            Some(Form::Sensor(of)) => {
                for (x, y) in force_x.iter_mut().zip(force_y).skip(first) {
                    let behind = force_behind(of, [value(0), value(1)], [*x, *y]);
                    (*x, *y) = of_axis(effect.cause.at, behind, [*x, *y]);
                }
            }
            // These do not change the readings of a sensor.
            Some(
                Form::Drive(Drive::Lag | Drive::Gain | Drive::Limit | Drive::Rate)
                | Form::Joint(_)
                | Form::Resistance(_)
                | Form::ShareOfBrake(_)
                | Form::Brake(_)
                | Form::Linkage(_),
            )
            | None => {}
        }
    }
    if own.theta == run.theta && own.parameters == run.parameters {
        return Ok(own);
    }
    let theta = core::mem::take(&mut own.theta);
    with_angles(&own, theta).map_err(|(_, error)| error)
}

/// Applies a change of the force on one axis of the sensor, or on both.
pub(super) const fn of_axis(
    at: Place,
    (changed_x, changed_y): (f64, f64),
    [x, y]: [f64; 2],
) -> (f64, f64) {
    match at {
        Place::Axis(0) => (changed_x, y),
        Place::Axis(_) => (x, changed_y),
        Place::Whole | Place::Every | Place::Joint(_) => (changed_x, changed_y),
    }
}

/// The true force behind one that a sensor shows.
fn force_behind(of: OfSensor, [a, b]: [f64; 2], [x, y]: [f64; 2]) -> (f64, f64) {
    match of {
        OfSensor::ForceGain => (x / (1.0 + a), y / (1.0 + a)),
        OfSensor::ForceBias => (x - a, y - b),
        OfSensor::ForceRotation => {
            let (sine, cosine) = libm::sincos(a);
            (cosine * x + sine * y, cosine * y - sine * x)
        }
        OfSensor::EncoderScale
        | OfSensor::EncoderOffset
        | OfSensor::Eccentric
        | OfSensor::Clock => (x, y),
    }
}

/// The currents of the brakes at a sample, A, cut to what a brake accepts.
pub(super) fn currents_at(run: &FiveBarRun, k: usize) -> [f64; 4] {
    run.currents.each_ref().map(|current| {
        let own = current.as_ref().and_then(|current| current.get(k));
        own.map_or(0.0, |a| a.clamp(0.0, GREATEST_CURRENT_A))
    })
}

pub(super) fn force_at(run: &FiveBarRun, k: usize) -> [f64; 2] {
    let last = run.len().saturating_sub(1);
    run.force
        .each_ref()
        .map(|force| force.get(k.min(last)).copied().unwrap_or(0.0))
}

/// The rig at each sample of `starts` (ascending), led there along the smoothed motion from the
/// first sample. Its brakes thereby have the recorded history.
fn led(model: &Model, run: &FiveBarRun, starts: &[usize]) -> Result<Vec<Rig>, ModelError> {
    let [joint_a, _, joint_b, _] = &run.joints;
    let mut at = joint_a
        .iter()
        .zip(joint_b)
        .map(|(a, b)| ([a.position, b.position], [a.speed, b.speed]));
    let (theta, rates) = at.next().unwrap_or_default();
    let rig = Rig::moving(run.parameters, theta, rates)?;
    let mut rig = rig.with_effects(&model.rig)?;
    let mut there = Vec::with_capacity(starts.len());
    let mut starts = starts.iter().peekable();
    for (k, (theta, rates)) in (0..).zip(core::iter::once((theta, rates)).chain(at)) {
        if k > 0 {
            let joints = run.joints.each_ref();
            let told = joints.map(|joint| joint.get(k).is_some_and(|now| now.sense.abs() >= 1.0));
            rig.lead(theta, rates, currents_at(run, k - 1), told, run.step_s)?;
        }
        while starts.next_if(|start| **start == k).is_some() {
            there.push(rig.clone());
        }
        if starts.peek().is_none() {
            break;
        }
    }
    Ok(there)
}

/// The state of the rig after a sample.
#[derive(Clone, Copy, Debug)]
struct Reached {
    theta_rad: [f64; 2],
    tip_m: [f64; 2],
}

/// The number of integration steps in a sample interval of `step_s`.
pub(super) fn parts_of(step_s: f64) -> f64 {
    (step_s / LONGEST_STEP_S * (1.0 - 1e-9)).ceil().max(1.0)
}

/// A free run of `count` samples from the state of `rig`. It ends early if the force drives the
/// linkage out of its assembly.
///
/// # Errors
/// Those of [`Rig::step`], other than a linkage that comes apart.
fn let_go(
    mut rig: Rig,
    run: &FiveBarRun,
    first: usize,
    count: usize,
) -> Result<Vec<Reached>, ModelError> {
    let parts = parts_of(run.step_s);
    let mut reached = Vec::with_capacity(count);
    for k in first..first + count {
        let (begin, end) = (force_at(run, k), force_at(run, k + 1));
        let currents_a = currents_at(run, k);
        for part in 0..parts as usize {
            let share = (part as f64 + 0.5) / parts;
            let [b_x, b_y] = begin;
            let [e_x, e_y] = end;
            let force_n = [b_x + share * (e_x - b_x), b_y + share * (e_y - b_y)];
            match rig.step(force_n, currents_a, run.step_s / parts) {
                Ok(()) => {}
                Err(ModelError::Singular { .. } | ModelError::CannotClose { .. }) => {
                    return Ok(reached);
                }
                Err(error) => return Err(error),
            }
        }
        reached.push(Reached {
            theta_rad: rig.base_angles_rad(),
            tip_m: rig.tip_m(),
        });
    }
    Ok(reached)
}

/// The free runs of a whole recording, one after another, each from the recorded state.
#[derive(Clone, Debug)]
pub struct Simulated {
    /// θA and θB, rad. Each run starts at the smoothed recording; after a run broke off the values
    /// are NaN.
    pub theta_rad: [Vec<f64>; 2],
    /// Distance of the tip from the recorded one, m.
    pub tip_off_m: Vec<f64>,
    /// Recorded θA and θB with the effects of their encoders inverted, rad.
    pub recorded_rad: [Vec<f64>; 2],
    /// Number of runs.
    pub runs: usize,
    /// Number of runs that drove the linkage out of its assembly.
    pub broken_off: usize,
}

/// Simulates a model along a recording, restarting every `restart_s`.
///
/// # Errors
/// The rig cannot be given the model's effects.
pub fn simulated(model: &Model, run: &FiveBarRun, restart_s: f64) -> Result<Simulated, ModelError> {
    let run = truly(model, run)?;
    let piece = ((restart_s / run.step_s).round() as usize).max(1);
    let starts: Vec<usize> = (0..run.len()).step_by(piece).collect();
    let mut out = Simulated {
        theta_rad: [const { Vec::new() }; 2],
        tip_off_m: Vec::new(),
        recorded_rad: run.theta.clone(),
        runs: starts.len(),
        broken_off: 0,
    };
    for (rig, first) in led(model, &run, &starts)?.into_iter().zip(starts) {
        let count = piece.min(run.len() - first) - 1;
        let start = Reached {
            theta_rad: rig.base_angles_rad(),
            tip_m: rig.tip_m(),
        };
        let reached = let_go(rig, &run, first, count)?;
        out.broken_off += usize::from(reached.len() < count);
        let lost = count - reached.len();
        let nowhere = Reached {
            theta_rad: [f64::NAN; 2],
            tip_m: [f64::NAN; 2],
        };
        let all = core::iter::once(start).chain(reached);
        let all = all.chain(core::iter::repeat_n(nowhere, lost));
        for (k, at) in (first..).zip(all) {
            for (own, theta) in out.theta_rad.iter_mut().zip(at.theta_rad) {
                own.push(theta);
            }
            out.tip_off_m.push(tip_off_m(&run, k, at.tip_m));
        }
    }
    Ok(out)
}

/// Distance of the tip from the recorded one, m.
fn tip_off_m(run: &FiveBarRun, k: usize, [x, y]: [f64; 2]) -> f64 {
    let recorded = run.poses.get(k).map_or([f64::NAN; 2], |pose| pose.tip_m);
    let [r_x, r_y] = recorded;
    libm::hypot(x - r_x, y - r_y)
}

/// The errors of each run at the horizons: θA, θB and the tip. Empty where a run broke off or a
/// sample was not recorded.
struct Errors {
    at: Vec<Vec<Option<[f64; 3]>>>,
    broken_off: usize,
}

fn errors(
    model: &Model,
    run: &FiveBarRun,
    starts: &[usize],
    counts: &[usize],
) -> Result<Errors, ModelError> {
    let run = truly(model, run)?;
    let longest = counts.iter().copied().max().unwrap_or(0);
    let mut broken_off = 0;
    let shots = led(model, &run, starts)?.into_iter().zip(starts);
    let at = shots
        .map(|(rig, &first)| {
            let reached = let_go(rig, &run, first, longest)?;
            broken_off += usize::from(reached.len() < longest);
            let error = |count: &usize| {
                let (at, k) = (reached.get(count - 1)?, first + count);
                let [a, b] = &run.theta;
                let [theta_a, theta_b] = at.theta_rad;
                let off = [theta_a - a.get(k)?, theta_b - b.get(k)?];
                let counts = *run.recorded.get(k)? && *run.recorded.get(first)?;
                counts.then(|| [off[0], off[1], tip_off_m(&run, k, at.tip_m)])
            };
            Ok(counts.iter().map(error).collect())
        })
        .collect::<Result<_, ModelError>>()?;
    Ok(Errors { at, broken_off })
}

/// Root mean square over runs: of the angles, rad, and of the tip, mm.
fn size(shots: &[[f64; 3]]) -> (f64, f64) {
    let angles: Vec<f64> = shots.iter().flat_map(|[a, b, _]| [*a, *b]).collect();
    let tips: Vec<f64> = shots.iter().map(|[_, _, tip_m]| 1e3 * tip_m).collect();
    (rms(&angles), rms(&tips))
}

/// The errors at the horizons with two models on a part of a recording, and a sentence on how the
/// runs went.
///
/// # Errors
/// The rig cannot be given a model's effects.
pub fn horizons(
    before: &Model,
    after: &Model,
    run: &FiveBarRun,
    part: Range<usize>,
    name: &'static str,
) -> Result<(Vec<Horizon>, String), ModelError> {
    let count = |horizon_s: f64| (horizon_s / run.step_s).round() as usize;
    let fits = |horizon_s: &f64| {
        let count = count(*horizon_s);
        count > 0 && count as f64 <= MOST_OF_PART * part.len() as f64
    };
    let kept: Vec<f64> = HORIZONS_S.into_iter().filter(fits).collect();
    let counts: Vec<usize> = kept.iter().map(|h| count(*h)).collect();
    let room = part
        .len()
        .saturating_sub(counts.last().map_or(0, |c| c + 1));
    let starts: Vec<usize> = (0..SHOTS)
        .map(|k| part.start + (2 * k + 1) * room / (2 * SHOTS))
        .collect();
    let (old, new) = (
        errors(before, run, &starts, &counts)?,
        errors(after, run, &starts, &counts)?,
    );
    let horizons = kept.iter().enumerate().filter_map(|(index, &horizon_s)| {
        // A run counts if it reached the horizon with both models.
        let shots = old.at.iter().zip(&new.at);
        let shots = shots.filter_map(|(old, new)| Some(((*old.get(index)?)?, (*new.get(index)?)?)));
        let (of_old, of_new): (Vec<_>, Vec<_>) = shots.unzip();
        if of_old.is_empty() {
            return None;
        }
        let ((before, tip_before_mm), (after, tip_after_mm)) = (size(&of_old), size(&of_new));
        Some(Horizon {
            horizon_s,
            part: name,
            unit: "rad".to_owned(),
            before,
            after,
            tip_before_mm: Some(tip_before_mm),
            tip_after_mm: Some(tip_after_mm),
        })
    });
    let horizons = horizons.collect();
    let said = match (old.broken_off, new.broken_off) {
        (0, 0) => format!("{SHOTS} on the {name}"),
        (old, new) => format!(
            "{SHOTS} on the {name}, of which {old} before and {new} after drove the linkage out of its assembly and count up to there in both"
        ),
    };
    Ok((horizons, said))
}
