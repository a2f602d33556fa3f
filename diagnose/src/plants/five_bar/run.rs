//! This file is an aligned recording of the five-bar: joint motions, forms of the equations of motion, nominal brakes.

use nalgebra::{Matrix2, Vector2};
use rigproof_model::brake::Brake;
use rigproof_model::effects::Instant;
use rigproof_model::error::ModelError;
use rigproof_model::linkage::{Pose, forward};
use rigproof_model::motion::two_coordinate::{TwoCoordinate, two_coordinate};
use rigproof_model::rig::Parameters;
use rigproof_spec::joint::Joint;

/// An aligned recording of the five-bar in SI units, one value a sample in every vector.
#[derive(Clone, Debug)]
pub struct FiveBarRun {
    /// Layout, lengths and masses of the nominal model.
    pub parameters: Parameters,
    /// Sample interval, s.
    pub step_s: f64,
    /// Time of the first sample, s.
    pub start_s: f64,
    /// Recorded θA and θB, rad.
    pub theta: [Vec<f64>; 2],
    /// Smoothed motion of the joints A, E, B, C.
    pub joints: [Vec<Instant>; 4],
    /// The pose of every sample.
    pub poses: Vec<Pose>,
    /// The equations of motion along the smoothed motion.
    pub forms: Vec<TwoCoordinate>,
    /// Recorded force on the tip, x and y, N.
    pub force: [Vec<f64>; 2],
    /// Commanded currents of A, E, B, C, A; `None` without a brake.
    pub currents: [Option<Vec<f64>>; 4],
    /// Yield torques of the nominal brakes at A, E, B, C, N·m; 0 without a brake.
    pub yields: [Vec<f64>; 4],
    /// By how much the nominal yield torques may be mistaken, because where a backlash begins and ends is known to a few counts, N·m.
    pub yield_errors: [Vec<f64>; 4],
    /// Standard deviation of one angle sample, rad.
    pub theta_noise: f64,
    /// Travel within which a joint may rest, rad.
    pub still_rad: f64,
    /// Where the low-pass of the angles ends, Hz.
    pub cutoff_hz: f64,
    /// Standard deviation of one force sample, N.
    pub force_noise: f64,
    /// Samples that were recorded, not filled in.
    pub recorded: Vec<bool>,
    /// Whether a brake's current changes around each sample.
    pub switched: Vec<bool>,
    /// Speed of θA or θB below which its sense cannot be told, rad/s.
    pub speed_floor: f64,
    /// The recordings that stand in it one after another; empty for one recording.
    pub parts: Vec<FiveBarRun>,
}

/// A joint's place in the order A, E, B, C.
pub const fn place(joint: Joint) -> usize {
    match joint {
        Joint::A => 0,
        Joint::E => 1,
        Joint::B => 2,
        Joint::C => 3,
    }
}

impl FiveBarRun {
    /// The number of samples.
    pub fn len(&self) -> usize {
        self.recorded.len()
    }

    /// Whether there are no samples.
    pub fn is_empty(&self) -> bool {
        self.recorded.is_empty()
    }

    /// The length of the recording, s.
    pub fn duration_s(&self) -> f64 {
        self.step_s * self.len().saturating_sub(1) as f64
    }

    /// The first sample at or after a time, s.
    pub fn sample_at(&self, time_s: f64) -> usize {
        ((time_s - self.start_s) / self.step_s).ceil().max(0.0) as usize
    }

    /// The smoothed motion of a joint.
    pub fn motion(&self, joint: Joint) -> &[Instant] {
        self.joints.get(place(joint)).map_or(&[], Vec::as_slice)
    }

    /// What a torque at each joint does to θA and θB, sample by sample: the joint's row of the form.
    pub fn joint_rows(&self, joint: Joint) -> impl Iterator<Item = [f64; 2]> {
        let row = place(joint);
        self.forms
            .iter()
            .map(move |form| [0, 1].map(|k| form.joints.get((row, k)).copied().unwrap_or(0.0)))
    }

    /// A resistance at a joint as θA and θB feel it, θA's samples first.
    pub fn at_joint(&self, joint: Joint, resistance: &[f64]) -> Vec<f64> {
        let pairs = self.joint_rows(joint).zip(resistance);
        stacked(pairs.map(|(row, r)| row.map(|g| g * r)))
    }

    /// A force on the tip as θA and θB feel it, θA's samples first.
    pub fn at_tip(&self, force: impl Iterator<Item = [f64; 2]>) -> Vec<f64> {
        let pairs = self.forms.iter().zip(force);
        stacked(pairs.map(|(form, force)| (form.tip.transpose() * Vector2::from(force)).into()))
    }

    /// The recorded force on the tip.
    pub fn forces(&self) -> impl Iterator<Item = [f64; 2]> {
        let [x, y] = &self.force;
        x.iter().zip(y).map(|(x, y)| [*x, *y])
    }

    /// The recorded force as θA and θB feel it, N·m.
    pub fn driving_effort(&self) -> Vec<f64> {
        self.at_tip(self.forces())
    }

    /// The resistance of the nominal brake at a joint, along the motion, N·m.
    pub fn brake_torque(&self, joint: Joint) -> Vec<f64> {
        let yields = self.yields.get(place(joint)).into_iter().flatten();
        let pairs = self.motion(joint).iter().zip(yields);
        pairs.map(|(now, y)| now.sense * y).collect()
    }

    /// The travel of a joint from sample to sample as far as its recorded angle tells it, rad: through a play as wide as what a joint
    /// at rest seems to move.
    pub fn known_travel(&self, joint: Joint) -> Vec<f64> {
        let half = 0.5 * self.still_rad_at(joint);
        let base = [Joint::A, Joint::B].map(|base| self.motion(base));
        let mut known: Option<f64> = None;
        let positions = self.recorded_angle(joint, base, self.motion(joint));
        positions
            .map(|position| {
                let before = known.unwrap_or(position);
                let after = before.clamp(position - half, position + half);
                known = Some(after);
                after - before
            })
            .collect()
    }

    /// Travel within which a joint may rest, rad.
    pub fn still_rad_at(&self, joint: Joint) -> f64 {
        let sizes = self.joint_rows(joint).map(|[a, b]| a.abs() + b.abs());
        self.still_rad * sizes.fold(1.0, f64::max)
    }

    /// The angle of a joint that the recorded θA and θB imply, rad, given the smoothed motion of A and B and its own.
    pub fn recorded_angle(
        &self,
        joint: Joint,
        [a, b]: [&[Instant]; 2],
        own: &[Instant],
    ) -> impl Iterator<Item = f64> {
        let [theta_a, theta_b] = &self.theta;
        let off_a = theta_a.iter().zip(a).map(|(theta, a)| theta - a.position);
        let off_b = theta_b.iter().zip(b).map(|(theta, b)| theta - b.position);
        let rows = self.joint_rows(joint).zip(off_a.zip(off_b)).zip(own);
        rows.map(|(([by_a, by_b], (a, b)), own)| own.position + by_a * a + by_b * b)
    }

    /// What was recorded beside the angles; what follows from them is empty.
    pub fn without_motion(&self) -> FiveBarRun {
        FiveBarRun {
            parameters: self.parameters,
            theta: Default::default(),
            joints: Default::default(),
            poses: Vec::new(),
            forms: Vec::new(),
            force: self.force.clone(),
            currents: self.currents.clone(),
            yields: Default::default(),
            yield_errors: Default::default(),
            recorded: self.recorded.clone(),
            switched: self.switched.clone(),
            parts: Vec::new(),
            ..*self
        }
    }

    /// The samples `from..to`, times kept.
    pub fn slice(&self, from: usize, to: usize) -> FiveBarRun {
        let part = |values: &Vec<f64>| values.get(from..to).unwrap_or_default().to_vec();
        FiveBarRun {
            parameters: self.parameters,
            step_s: self.step_s,
            start_s: self.start_s + from as f64 * self.step_s,
            theta: self.theta.each_ref().map(part),
            joints: self
                .joints
                .each_ref()
                .map(|joint| joint.get(from..to).unwrap_or_default().to_vec()),
            poses: self.poses.get(from..to).unwrap_or_default().to_vec(),
            forms: self.forms.get(from..to).unwrap_or_default().to_vec(),
            force: self.force.each_ref().map(part),
            currents: self.currents.each_ref().map(|c| c.as_ref().map(part)),
            yields: self.yields.each_ref().map(part),
            yield_errors: self.yield_errors.each_ref().map(part),
            theta_noise: self.theta_noise,
            still_rad: self.still_rad,
            cutoff_hz: self.cutoff_hz,
            force_noise: self.force_noise,
            recorded: self.recorded.get(from..to).unwrap_or_default().to_vec(),
            switched: self.switched.get(from..to).unwrap_or_default().to_vec(),
            speed_floor: self.speed_floor,
            parts: Vec::new(),
        }
    }
}

/// Pairs of values as one signal: the first of every pair, then the second.
pub fn stacked(pairs: impl Iterator<Item = [f64; 2]>) -> Vec<f64> {
    let (mut first, second): (Vec<f64>, Vec<f64>) = pairs.map(|[a, b]| (a, b)).unzip();
    first.extend(second);
    first
}

/// Poses and forms along a smoothed motion of θA and θB.
///
/// # Errors
/// The linkage cannot be assembled at some sample: its number, and why.
pub fn forms(
    parameters: &Parameters,
    base: &[Vec<Instant>; 2],
) -> Result<(Vec<Pose>, Vec<TwoCoordinate>), (usize, ModelError)> {
    let [a, b] = base;
    let mut poses = Vec::with_capacity(a.len());
    let mut forms = Vec::with_capacity(a.len());
    for (k, (a, b)) in a.iter().zip(b).enumerate() {
        let pose = forward::pose(&parameters.arms, a.position, b.position).map_err(|e| (k, e))?;
        let rates = [a.speed, b.speed];
        let form = two_coordinate(&parameters.arms, &parameters.inertia, &pose, rates);
        poses.push(pose);
        forms.push(form);
    }
    Ok((poses, forms))
}

/// The yield torque of a brake along a joint's motion, the current of each sample held to the next.
pub fn yields(mut brake: Brake, motion: &[Instant], current: &[f64], step_s: f64) -> Vec<f64> {
    let mut own = vec![brake.yield_torque()];
    for (now, &current) in motion.iter().skip(1).zip(current) {
        brake.step(current, now.position, now.speed, step_s);
        own.push(brake.yield_torque());
    }
    own
}

/// What the inertia of some mass matrices takes, sample by sample, as the second difference of the angles sees it:
/// d/dt(M·q̇) − ½·∂(q̇ᵀ·M·q̇)/∂q, θA's samples first.
pub fn inertial(run: &FiveBarRun, forms: &[TwoCoordinate]) -> Vec<f64> {
    let step_s = run.step_s;
    let count = forms.len();
    let [a, b] = &run.theta;
    let at = |k: usize| {
        let angle = |theta: &Vec<f64>| theta.get(k).copied().unwrap_or(0.0);
        Vector2::new(angle(a), angle(b))
    };
    let mass = |k: usize| forms.get(k).map_or(Matrix2::zeros(), |form| form.mass);
    let momentum = |k: usize| (mass(k) + mass(k + 1)) * (at(k + 1) - at(k)) * (0.5 / step_s);
    let [joint_a, _, joint_b, _] = &run.joints;
    let rates = joint_a.iter().zip(joint_b);
    let pairs = forms.iter().zip(rates).enumerate();
    stacked(pairs.map(|(k, (form, (a, b)))| {
        if k == 0 || k + 1 >= count {
            return [0.0; 2];
        }
        let mass_rate = (mass(k + 1) - mass(k - 1)) * (0.5 / step_s);
        let rest = form.bias - mass_rate * Vector2::new(a.speed, b.speed);
        ((momentum(k) - momentum(k - 1)) / step_s + rest).into()
    }))
}
