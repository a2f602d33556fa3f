//! This file is an aligned recording of the five-bar: joint motions, equations of motion, nominal
//! brakes.

use super::encoder::Encoder;
use super::equations::stacked;
use super::{candidates, columns, locate, noise};
use crate::cause::{Cause, JointId, Place};
use crate::continuity::Remark;
use crate::locate::Regimes;
use crate::plant::{Clock, Columns, Rules, Run};
use crate::plants::brake::{BrakeLaw, Braked};
use crate::rules::{QUIET_NM, WIDTHS_S};
use crate::signals::known_travel;
use crate::weak::Windows;
use crate::whiten::Whitener;
use nalgebra::Vector2;
use rigproof_model::effects::{Form, Instant, form};
use rigproof_model::linkage::Pose;
use rigproof_model::motion::two_coordinate::TwoCoordinate;
use rigproof_model::rig::Parameters;
use rigproof_spec::effect::{Mechanism, Motion};
use rigproof_spec::joint::Joint;
use rigproof_spec::tables::brake_table;

/// An aligned recording of the five-bar in SI units. Every vector has one value per sample.
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
    /// The efforts of θA and θB per unit of torque at A, E, B, C.
    pub levers: [[Vec<f64>; 2]; 4],
    /// Recorded force on the tip, x and y, N.
    pub force: [Vec<f64>; 2],
    /// Commanded currents of A, E, B, C, A; `None` without a brake.
    pub currents: [Option<Vec<f64>>; 4],
    /// Yield torques of the nominal brakes at A, E, B, C, N·m; 0 without a brake.
    pub yields: [Vec<f64>; 4],
    /// The uncertainty of the nominal yield torques from that of their backlash, N·m.
    pub yield_errors: [Vec<f64>; 4],
    /// The backlash of A, E, B, C where the description states another width than the table, rad.
    pub stated_gaps_rad: [Option<f64>; 4],
    /// Standard deviation of one angle sample, rad.
    pub theta_noise: f64,
    /// The travel within which a joint may be at rest, rad.
    pub still_rad: f64,
    /// Cut-off of the low-pass of the angles, Hz.
    pub cutoff_hz: f64,
    /// Standard deviation of one force sample, N.
    pub force_noise: f64,
    /// Whether a sample was recorded rather than interpolated.
    pub recorded: Vec<bool>,
    /// Whether a brake's current changes around each sample.
    pub switched: Vec<bool>,
    /// Speed of θA or θB below which its direction cannot be told, rad/s.
    pub speed_floor: f64,
    /// The separate recordings of a joined run; empty for a single one.
    pub parts: Vec<FiveBarRun>,
    /// What was repaired.
    pub remarks: Vec<Remark>,
}

/// A joint's index in the order A, E, B, C.
pub const fn place(joint: Joint) -> usize {
    match joint {
        Joint::A => 0,
        Joint::E => 1,
        Joint::B => 2,
        Joint::C => 3,
    }
}

/// The place of a joint; the whole linkage for `None`.
pub fn place_of(joint: Option<Joint>) -> Place {
    joint.map_or(Place::Whole, |joint| Place::Joint(JointId(place(joint))))
}

/// The joint at a place; `None` for the whole linkage.
pub fn joint_at(at: Place) -> Option<Joint> {
    match at {
        Place::Joint(JointId(joint)) => Joint::ALL.get(joint).copied(),
        Place::Whole | Place::Every | Place::Axis(_) => None,
    }
}

/// A mechanism at a joint.
pub fn at(mechanism: Mechanism, joint: Joint) -> Cause {
    Cause::at(mechanism, place_of(Some(joint)))
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

    /// The smoothed motion of a joint.
    pub fn motion_of(&self, joint: Joint) -> &[Instant] {
        self.joints.get(place(joint)).map_or(&[], Vec::as_slice)
    }

    /// The efforts of θA and θB per unit of torque at a joint, sample by sample.
    pub fn joint_rows(&self, joint: Joint) -> impl Iterator<Item = [f64; 2]> {
        let [by_a, by_b] = self.levers_of(joint);
        by_a.iter().zip(by_b).map(|(a, b)| [*a, *b])
    }

    /// The efforts of θA and θB for a resistance at a joint; θA's samples first.
    pub fn at_joint(&self, joint: Joint, resistance: &[f64]) -> Vec<f64> {
        let levers = self.levers_of(joint).into_iter();
        let mut efforts = Vec::with_capacity(2 * resistance.len());
        levers.for_each(|own| efforts.extend(own.iter().zip(resistance).map(|(g, r)| g * r)));
        efforts
    }

    fn levers_of(&self, joint: Joint) -> [&[f64]; 2] {
        self.levers
            .get(place(joint))
            .map_or([&[]; 2], |own| own.each_ref().map(Vec::as_slice))
    }

    /// The efforts of θA and θB for a force on the tip; θA's samples first.
    pub fn at_tip(&self, force: impl Iterator<Item = [f64; 2]>) -> Vec<f64> {
        let pairs = self.forms.iter().zip(force);
        stacked(pairs.map(|(form, force)| (form.tip.transpose() * Vector2::from(force)).into()))
    }

    /// The recorded force on the tip, N.
    pub fn forces(&self) -> impl Iterator<Item = [f64; 2]> {
        let [x, y] = &self.force;
        x.iter().zip(y).map(|(x, y)| [*x, *y])
    }

    /// The efforts of θA and θB for the recorded force, N·m.
    pub fn driving_effort(&self) -> Vec<f64> {
        self.at_tip(self.forces())
    }

    /// The brake of a joint along its motion; `None` at a joint without one.
    pub fn braked(&self, joint: Joint) -> Option<Braked<'_>> {
        Some(Braked {
            law: BrakeLaw::Thesis(brake_table(joint)),
            motion: self.motion_of(joint),
            current: self.currents.get(place(joint))?.as_ref()?,
            held: true,
            rows: None,
            step_s: self.step_s,
        })
    }

    /// The torque of the nominal brake at a joint, along the motion, N·m.
    pub fn brake_torque(&self, joint: Joint) -> Vec<f64> {
        let yields = self.yields.get(place(joint)).into_iter().flatten();
        let pairs = self.motion_of(joint).iter().zip(yields);
        pairs.map(|(now, y)| now.sense * y).collect()
    }

    /// The travel of a joint between samples, rad, without the apparent motion of a joint at rest.
    pub fn known_travel(&self, joint: Joint) -> Vec<f64> {
        let half = 0.5 * self.still_rad_at(joint);
        let base = [Joint::A, Joint::B].map(|base| self.motion_of(base));
        known_travel(
            self.recorded_angle(joint, base, self.motion_of(joint)),
            half,
        )
    }

    /// The travel within which a joint may be at rest, rad.
    pub fn still_rad_at(&self, joint: Joint) -> f64 {
        let sizes = self.joint_rows(joint).map(|[a, b]| a.abs() + b.abs());
        self.still_rad * sizes.fold(1.0, f64::max)
    }

    /// The angle of a joint that follows from the recorded θA and θB, rad.
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

    /// The recorded signals other than the angles. Everything that depends on the angles is empty.
    pub fn without_motion(&self) -> FiveBarRun {
        FiveBarRun {
            parameters: self.parameters,
            theta: Default::default(),
            joints: Default::default(),
            poses: Vec::new(),
            forms: Vec::new(),
            levers: Default::default(),
            force: self.force.clone(),
            currents: self.currents.clone(),
            yields: Default::default(),
            yield_errors: Default::default(),
            recorded: self.recorded.clone(),
            switched: self.switched.clone(),
            parts: Vec::new(),
            remarks: self.remarks.clone(),
            ..*self
        }
    }

    /// The samples `from..to`, with their times.
    pub fn part(&self, from: usize, to: usize) -> FiveBarRun {
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
            levers: self.levers.each_ref().map(|own| own.each_ref().map(part)),
            force: self.force.each_ref().map(part),
            currents: self.currents.each_ref().map(|c| c.as_ref().map(part)),
            yields: self.yields.each_ref().map(part),
            yield_errors: self.yield_errors.each_ref().map(part),
            stated_gaps_rad: self.stated_gaps_rad,
            theta_noise: self.theta_noise,
            still_rad: self.still_rad,
            cutoff_hz: self.cutoff_hz,
            force_noise: self.force_noise,
            recorded: self.recorded.get(from..to).unwrap_or_default().to_vec(),
            switched: self.switched.get(from..to).unwrap_or_default().to_vec(),
            speed_floor: self.speed_floor,
            parts: Vec::new(),
            remarks: self.remarks.clone(),
        }
    }
}

impl Run for FiveBarRun {
    fn clock(&self) -> Clock {
        Clock::new(self.step_s, self.start_s, self.len())
    }

    fn recorded(&self) -> &[bool] {
        &self.recorded
    }

    fn remarks(&self) -> &[Remark] {
        &self.remarks
    }

    fn motion_kind(&self) -> Motion {
        Motion::Rotary
    }

    fn outputs(&self) -> usize {
        2
    }

    fn output_name(&self, output: usize) -> &'static str {
        match output {
            0 => "effort on arm AE (θA)",
            _ => "effort on arm BC (θB)",
        }
    }

    fn rules(&self) -> &'static Rules {
        &Rules::LINKAGE
    }

    fn slice(&self, from: usize, to: usize) -> Option<Box<dyn Run>> {
        Some(Box::new(self.part(from, to)))
    }

    fn effort(&self) -> Vec<f64> {
        self.driving_effort()
    }

    fn driving(&self) -> Vec<f64> {
        columns::driving(self, self.forces())
    }

    fn known(&self) -> Vec<f64> {
        columns::known(self)
    }

    /// The narrowest windows whose predicted noise is small beside the driving effort.
    fn windows(&self) -> Windows {
        let [narrow, middle, wide] = WIDTHS_S;
        let quiet = |width_s: f64| {
            let windows = self.windows_of(width_s);
            (self.floor(&windows) <= QUIET_NM).then_some(windows)
        };
        let windows = quiet(narrow).or_else(|| quiet(middle));
        windows.unwrap_or_else(|| self.windows_of(wide))
    }

    /// Keeps the rows in which the torques of the brakes are known.
    fn keep_told(&self, windows: &mut Windows) {
        noise::keep_told(self, windows);
    }

    /// Of θA's or θB's own equation. The noise of each row depends on the poses.
    fn sensors(&self) -> [f64; 2] {
        let inertia = self.forms.first().map_or(0.0, |form| form.mass.m11);
        [inertia * self.theta_noise, self.force_noise]
    }

    fn floor(&self, windows: &Windows) -> f64 {
        noise::floor(self, windows)
    }

    fn whitener(&self, windows: &Windows, excess: f64) -> Whitener {
        noise::whitener(self, windows, excess)
    }

    fn position_noise(&self) -> f64 {
        self.theta_noise
    }

    fn joints(&self) -> usize {
        Joint::ALL.len()
    }

    fn place_name(&self, at: Place) -> Option<&'static str> {
        match at {
            Place::Every => Some("every brake"),
            Place::Axis(0) => Some("x"),
            Place::Axis(_) => Some("y"),
            Place::Whole | Place::Joint(_) => joint_at(at).map(Joint::letter),
        }
    }

    fn motion(&self, at: Place) -> &[Instant] {
        joint_at(at).map_or(&[], |joint| self.motion_of(joint))
    }

    /// The range of a joint's angle; for the whole linkage the greater of those of θA and θB.
    fn travel(&self, at: Place) -> f64 {
        let range = |positions: &mut dyn Iterator<Item = f64>| {
            let (low, high) = positions
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
                    (low.min(x), high.max(x))
                });
            high - low
        };
        match joint_at(at) {
            Some(joint) => range(&mut self.motion_of(joint).iter().map(|now| now.position)),
            None => {
                let angles = self.theta.iter();
                let ranges = angles.map(|theta| range(&mut theta.iter().copied()));
                ranges.fold(0.0, f64::max)
            }
        }
    }

    fn causes(&self) -> Vec<Cause> {
        candidates::causes(self)
    }

    fn shapes(&self, cause: Cause, windows: &Windows, residual: &[f64]) -> Vec<Vec<f64>> {
        candidates::shapes(self, cause, windows, residual)
    }

    fn reach(&self, cause: Cause) -> Option<(f64, f64)> {
        candidates::reach(self, cause)
    }

    fn columns(&self, cause: Cause, shape: &[f64], _: Option<&[f64]>) -> Option<Columns> {
        if self.moves(cause) {
            return columns::free(self, cause, shape).map(Columns::Moved);
        }
        let free = columns::free(self, cause, shape).map(Columns::Free);
        free.or_else(|| columns::fixed(self, cause, shape).map(Columns::Fixed))
    }

    fn moves(&self, cause: Cause) -> bool {
        cause.at != Place::Whole && form(cause.mechanism).is_some_and(Form::is_of_encoder)
    }

    fn moved_rows(
        &self,
        windows: &Windows,
        recorded: &[f64],
        signals: &[Vec<f64>],
        cause: Cause,
        shape: &[f64],
        first: usize,
    ) -> Vec<Vec<f64>> {
        let encoder = Encoder::of(self, cause, shape);
        encoder.map_or(Vec::new(), |encoder| {
            encoder.rows(windows, recorded, signals, first)
        })
    }

    fn shape_over(&self, cause: Cause, shape: &[f64], coefficients: &[f64]) -> Option<Vec<f64>> {
        Encoder::of(self, cause, shape)?.over(coefficients)
    }

    fn linear(&self, mechanism: Mechanism, coefficients: &[f64]) -> Vec<f64> {
        match mechanism {
            Mechanism::ForceGain => coefficients.iter().map(|c| c / (1.0 - c)).collect(),
            _ => coefficients.to_vec(),
        }
    }

    fn coefficients(&self, mechanism: Mechanism, parameters: &[f64]) -> Vec<f64> {
        match mechanism {
            Mechanism::ForceGain => parameters.iter().map(|f| f / (1.0 + f)).collect(),
            _ => parameters.to_vec(),
        }
    }

    fn regimes(&self, windows: &Windows) -> Regimes {
        locate::regimes(self, windows)
    }

    /// The weight of the joint's torque in each row, at the window's centre.
    fn shares(&self, at: Place, windows: &Windows) -> Vec<f64> {
        let Some(joint) = joint_at(at) else {
            return vec![0.0; windows.centres.len()];
        };
        let all: Vec<[f64; 2]> = self.joint_rows(joint).collect();
        let rows = windows.centres.iter().enumerate();
        rows.map(|(row, &centre)| {
            let own = all.get(centre).copied().unwrap_or_default();
            let shares = windows.shares(row);
            own.iter().zip(&shares).map(|(g, share)| g * share).sum()
        })
        .collect()
    }
}
