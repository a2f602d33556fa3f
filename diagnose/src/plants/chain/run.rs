//! This file is an aligned recording of an arm. Its signals hold one joint's samples after
//! another's.

use super::parts::ArmPlace;
use crate::candidates::{is_plain, standard_shapes};
use crate::cause::{Cause, JointId, Place};
use crate::filter::{ends, gradient, rms};
use crate::plant::{Clock, Columns, Rules, Run};
use crate::problem::less;
use crate::rules::{ARM_WIDTH_S, DESCRIBED_WITHIN, MOST_AMBIGUOUS, NOISE_ORDER};
use crate::weak::{Windows, is_recorded, untold};
use crate::whiten::Whitener;
use nalgebra::{DMatrix, DVector};
use rigproof_model::effects::{Drive, Form, Instant, OfJoint, OfLinkage, form};
use rigproof_spec::effect::Mechanism;
use rigproof_trace::rig::transmission::Part;

/// An aligned recording in SI units.
#[derive(Clone, Debug)]
pub struct ChainRun {
    /// Sample interval, s.
    pub step_s: f64,
    /// Time of the first sample, s.
    pub start_s: f64,
    /// Where mechanisms may act: the links first, joint by joint.
    pub places: Vec<ArmPlace>,
    /// The place of each equation, by which it is named.
    pub equations: Vec<usize>,
    /// The smoothed motion at each place.
    pub motions: Vec<Vec<Instant>>,
    /// The recorded efforts.
    pub effort: Vec<f64>,
    /// The efforts that the description predicts.
    pub known: Vec<f64>,
    /// The effort per unit of one inertial parameter: link and parameter index, and the signal.
    pub links: Vec<((usize, usize), Vec<f64>)>,
    /// The mass and the radius of gyration about its joint of each link, kg and m.
    pub bodies: Vec<[f64; 2]>,
    /// The effort per kilogram at the tip.
    pub payload: Vec<f64>,
    /// Noise of the position and of the effort of each equation, standard deviation.
    pub noise: Vec<[f64; 2]>,
    /// The inertia that the joint of each equation moves when it moves alone, kg·m² or kg.
    pub masses: Vec<f64>,
    /// Speed below which the direction of motion cannot be told.
    pub speed_floor: f64,
    /// Whether a sample was recorded rather than interpolated.
    pub recorded: Vec<bool>,
    /// The samples with which further recordings begin.
    pub seams: Vec<usize>,
}

/// The squared cosine between two signals from which on they are one: the ends of a part of a
/// recording are differenced one-sidedly. What is left to 1 is also the share of a signal's energy
/// that is rounding.
const SAME: f64 = 1.0 - 1e-6;

impl ChainRun {
    /// The number of samples.
    pub fn len(&self) -> usize {
        self.recorded.len()
    }

    /// Whether there are no samples.
    pub fn is_empty(&self) -> bool {
        self.recorded.is_empty()
    }

    /// The samples `from..to`, with their times.
    pub fn part(&self, from: usize, to: usize) -> ChainRun {
        let samples = self.len().max(1);
        let own = |signal: &Vec<f64>| -> Vec<f64> {
            let stretches = signal.chunks(samples);
            let parts = stretches.map(|own| own.get(from..to).unwrap_or_default());
            parts.collect::<Vec<_>>().concat()
        };
        let motions = self.motions.iter();
        ChainRun {
            start_s: self.start_s + from as f64 * self.step_s,
            motions: motions
                .map(|own| own.get(from..to).unwrap_or_default().to_vec())
                .collect(),
            effort: own(&self.effort),
            known: own(&self.known),
            payload: own(&self.payload),
            bodies: self.bodies.clone(),
            links: self
                .links
                .iter()
                .map(|(of, signal)| (*of, own(signal)))
                .collect(),
            recorded: self.recorded.get(from..to).unwrap_or_default().to_vec(),
            seams: {
                let inside = self.seams.iter().filter(|own| (from + 1..to).contains(own));
                inside.map(|own| own - from).collect()
            },
            step_s: self.step_s,
            places: self.places.clone(),
            equations: self.equations.clone(),
            noise: self.noise.clone(),
            masses: self.masses.clone(),
            speed_floor: self.speed_floor,
        }
    }

    /// The rate of change of a signal of one joint, of each recording by itself.
    pub(super) fn rate(&self, signal: &[f64]) -> Vec<f64> {
        let ends = self.seams.iter().copied().chain([signal.len()]);
        let mut from = 0;
        let each = ends.flat_map(|to| {
            let own = signal.get(from..to).unwrap_or_default();
            from = to;
            gradient(own, self.step_s)
        });
        each.collect()
    }

    /// The causes that are looked for at a place.
    fn causes_at(&self, at: Place) -> impl Iterator<Item = Cause> {
        let place = joint_at(at).and_then(|place| self.places.get(place));
        let asked = move |own: &Mechanism| place.is_some_and(|place| place.asks(*own));
        let all = Mechanism::ALL.into_iter().filter(asked);
        all.map(move |mechanism| Cause::at(mechanism, at))
    }

    /// The samples of a signal in the first equation in which a place stands.
    pub(super) fn stretch<'a>(&self, signal: &'a [f64], place: usize) -> &'a [f64] {
        let rows = self.places.get(place).map(|own| own.rows.as_slice());
        let row = rows.and_then(<[_]>::first).map(|(row, _)| *row);
        let mut stretches = signal.chunks(self.len().max(1));
        row.and_then(|row| stretches.nth(row)).unwrap_or_default()
    }

    /// A signal of all equations that is `own`, with its sign, where a place stands, and 0
    /// elsewhere.
    pub(super) fn at_place(&self, place: usize, own: &[f64]) -> Vec<f64> {
        let mut all = vec![0.0; self.effort.len()];
        let rows = self.places.get(place).into_iter();
        for (row, sign) in rows.flat_map(|own| &own.rows) {
            let slots = all.iter_mut().skip(row * self.len()).zip(own);
            slots.for_each(|(slot, x)| *slot = sign * x);
        }
        all
    }

    /// Whether all that a link shows acts as the inertia of its joint does: a first link that turns
    /// about the vertical.
    fn is_inertia_alone(&self, cause: Cause) -> bool {
        let Some(Form::Joint(OfJoint::Link)) = form(cause.mechanism) else {
            return false;
        };
        let inertia = Cause::at(Mechanism::AddedInertia, cause.at);
        let Some(Columns::Free(signals)) = self.columns(inertia, &[], None) else {
            return false;
        };
        let Some(inertia) = signals.first() else {
            return false;
        };
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
        let of = self
            .links
            .iter()
            .filter(|own| joint_at(cause.at) == Some(own.0.0));
        let numbers: Vec<(f64, f64)> = of
            .map(|(_, own)| (dot(own, own), dot(own, inertia)))
            .collect();
        let most = numbers.iter().fold(0.0, |most: f64, own| most.max(own.0));
        let square = dot(inertia, inertia);
        let mut acting = numbers.iter().filter(|own| own.0 > (1.0 - SAME) * most);
        acting.all(|(own, both)| both * both >= SAME * own * square)
    }

    /// The relative noise of each joint: the residual with every common mechanism free, scaled to
    /// mean square 1.
    fn uneven(&self, windows: &Windows) -> Vec<f64> {
        let outputs = self.outputs();
        let target = windows.average(&less(&self.effort, &self.known));
        let level = |values: &[f64], joint: usize| {
            let rows = values
                .iter()
                .zip(&windows.usable)
                .skip(joint)
                .step_by(outputs);
            let own: Vec<f64> = rows.filter(|(_, u)| **u).map(|(x, _)| *x).collect();
            rms(&own).max(1e-12)
        };
        let mut columns: Vec<Vec<f64>> =
            self.links.iter().map(|(_, s)| windows.average(s)).collect();
        for at in self.moving_places() {
            for cause in self.causes_at(at).filter(|own| is_plain(own.mechanism)) {
                if let Some(Columns::Free(signals)) = self.columns(cause, &[], None) {
                    columns.extend(signals.iter().map(|signal| windows.average(signal)));
                }
            }
        }
        let scale: Vec<f64> = (0..outputs).map(|joint| level(&target, joint)).collect();
        let weight = |row: usize| match windows.usable.get(row) {
            Some(true) => scale.get(row % outputs).map_or(0.0, |s| 1.0 / s),
            _ => 0.0,
        };
        let weighted = |own: &[f64]| -> Vec<f64> {
            own.iter()
                .enumerate()
                .map(|(row, x)| x * weight(row))
                .collect()
        };
        let all: Vec<DVector<f64>> = columns
            .iter()
            .map(|own| DVector::from_vec(weighted(own)))
            .map(|own| own.clone() / own.norm().max(1e-150))
            .collect();
        let matrix = DMatrix::from_columns(&all);
        let aim = DVector::from_vec(weighted(&target));
        let gram = matrix.transpose() * &matrix + DMatrix::identity(all.len(), all.len()) * 1e-8;
        let left = match gram.cholesky() {
            Some(factor) => &aim - &matrix * factor.solve(&(matrix.transpose() * &aim)),
            None => aim.clone(),
        };
        let left: Vec<f64> = left.iter().copied().collect();
        let sizes =
            (0..outputs).map(|joint| level(&left, joint) * scale.get(joint).unwrap_or(&1.0));
        let sizes: Vec<f64> = sizes.collect();
        let mean = rms(&sizes).max(1e-300);
        sizes.into_iter().map(|size| size / mean).collect()
    }
}

/// Converts the coefficient of a torque constant's column to its fraction. It is its own inverse.
fn undone(mechanism: Mechanism, own: f64) -> f64 {
    match form(mechanism) {
        Some(Form::Drive(Drive::Gain)) => -own / (1.0 + own),
        _ => own,
    }
}

/// The joint of a place.
pub(super) fn joint_at(at: Place) -> Option<usize> {
    match at {
        Place::Joint(JointId(joint)) => Some(joint),
        _ => None,
    }
}

impl Run for ChainRun {
    fn clock(&self) -> Clock {
        Clock::new(self.step_s, self.start_s, self.len())
    }

    fn recorded(&self) -> &[bool] {
        &self.recorded
    }

    fn outputs(&self) -> usize {
        self.equations.len()
    }

    fn output_name(&self, output: usize) -> &'static str {
        let place = self.equations.get(output);
        let place = place.and_then(|place| self.places.get(*place));
        place.map_or("effort", |own| own.name)
    }

    fn rules(&self) -> &'static Rules {
        &Rules::ARM
    }

    fn slice(&self, from: usize, to: usize) -> Option<Box<dyn Run>> {
        Some(Box::new(self.part(from, to)))
    }

    fn effort(&self) -> Vec<f64> {
        self.effort.clone()
    }

    fn driving(&self) -> Vec<f64> {
        self.effort.clone()
    }

    fn known(&self) -> Vec<f64> {
        self.known.clone()
    }

    fn windows(&self) -> Windows {
        self.windows_of(ARM_WIDTH_S)
    }

    /// A row of a joint is unusable where the direction of its own motion cannot be told. What a
    /// transmission does has no direction.
    fn keep_told(&self, windows: &mut Windows) {
        windows.keep(|centre, bump| is_recorded(&self.recorded, centre, bump));
        let rows = windows.centres.iter().zip(&mut windows.usable);
        for ((&centre, usable), &place) in rows.zip(self.equations.iter().cycle()) {
            let motion = self.motions.get(place).map_or(&[][..], Vec::as_slice);
            let part = self.places.get(place).map(|own| own.part);
            let is_told = || untold(motion, centre, &windows.bump) <= MOST_AMBIGUOUS;
            *usable = *usable && (part == Some(Part::Transmission) || is_told());
        }
    }

    fn sensors(&self) -> [f64; 2] {
        let pairs = self.noise.iter().zip(&self.masses);
        let curved: Vec<f64> = pairs.map(|([position, _], mass)| position * mass).collect();
        let effort: Vec<f64> = self.noise.iter().map(|[_, effort]| *effort).collect();
        [rms(&curved), rms(&effort)]
    }

    /// The unexplained residual is slower than a window. Modelled as white effort it would be
    /// spread over frequencies that the windows suppress.
    fn whitener(&self, windows: &Windows, excess: f64) -> Whitener {
        let outputs = self.outputs();
        let uneven = self.uneven(windows);
        let each = self.noise.iter().zip(&self.masses).zip(uneven);
        let each = each.map(|(([position, effort], mass), uneven)| {
            let mut own =
                windows.noise_covariance([position * mass, *effort], 0.0, NOISE_ORDER + 1);
            if let Some(variance) = own.first_mut() {
                *variance += excess * uneven * uneven;
            }
            own
        });
        let apart = each.enumerate().map(|(output, own)| {
            let usable = windows.usable.iter().skip(output).step_by(outputs);
            let usable: Vec<bool> = usable.copied().collect();
            Whitener::banded(&usable, NOISE_ORDER, |row, earlier| {
                own.get(row - earlier).copied().unwrap_or(0.0)
            })
        });
        Whitener::Apart(apart.collect())
    }

    fn position_noise(&self) -> f64 {
        self.noise
            .iter()
            .map(|[position, _]| *position)
            .fold(0.0, f64::max)
    }

    fn joints(&self) -> usize {
        self.places.len()
    }

    fn place_name(&self, at: Place) -> Option<&'static str> {
        joint_at(at).and_then(|place| self.places.get(place).map(|own| own.name))
    }

    fn motion(&self, at: Place) -> &[Instant] {
        let joint = joint_at(at).unwrap_or(0);
        self.motions.get(joint).map_or(&[], Vec::as_slice)
    }

    /// The range of motion of a joint; the greatest one for the whole arm.
    fn travel(&self, at: Place) -> f64 {
        let range = |own: &Vec<Instant>| {
            let [low, high] = ends(own.iter().map(|now| now.position));
            (high - low).max(0.0)
        };
        match joint_at(at) {
            Some(joint) => self.motions.get(joint).map_or(0.0, range),
            None => self.motions.iter().map(range).fold(0.0, f64::max),
        }
    }

    fn speed_floor(&self) -> f64 {
        self.speed_floor
    }

    /// All candidates at the joints that moved, without links that the inertia of their joint stands
    /// for. A twist is small wherever it acts.
    fn causes(&self) -> Vec<Cause> {
        let part = |at: Place| {
            joint_at(at)
                .and_then(|k| self.places.get(k))
                .map(|own| own.part)
        };
        let moved = |at: &Place| {
            part(*at) == Some(Part::Transmission)
                || self.travel(*at) > 100.0 * self.position_noise()
        };
        let moved = self.moving_places().into_iter().filter(moved);
        let links = self.places.iter().filter(|own| own.part == Part::Link);
        let last = Place::Joint(JointId(links.count().saturating_sub(1)));
        let is_payload =
            |own: Mechanism| matches!(form(own), Some(Form::Linkage(OfLinkage::Payload)));
        moved
            .flat_map(|at| self.causes_at(at))
            .filter(|cause| !is_payload(cause.mechanism) || cause.at == last)
            .filter(|cause| !self.is_inertia_alone(*cause))
            .collect()
    }

    /// A small delay and a friction by the effort enter linearly.
    fn shapes(&self, cause: Cause, windows: &Windows, residual: &[f64]) -> Vec<Vec<f64>> {
        match form(cause.mechanism) {
            Some(Form::Drive(Drive::Skew) | Form::Joint(OfJoint::Load)) => vec![Vec::new()],
            _ => standard_shapes(self, cause, windows, residual),
        }
    }

    fn described(&self, cause: Cause) -> f64 {
        let place = joint_at(cause.at).and_then(|place| self.places.get(place));
        place.map_or(0.0, |own| own.described(cause.mechanism))
    }

    /// Of the inertial numbers of a link: its own mass, times its radius of gyration for a moment of
    /// the first order, times its square for one of the second, each by a share. A link without
    /// mass, which stands for what is not described, tells nothing.
    fn prior_deviations(&self, cause: Cause) -> Vec<f64> {
        let is_link = matches!(form(cause.mechanism), Some(Form::Joint(OfJoint::Link)));
        let body = joint_at(cause.at).and_then(|joint| self.bodies.get(joint));
        let [mass, radius] = match body.filter(|[mass, _]| is_link && *mass > 0.0) {
            Some(body) => *body,
            None => return Vec::new(),
        };
        let orders = [0].into_iter().chain([1; 3]).chain([2; 6]);
        let each = orders.map(|order| DESCRIBED_WITHIN * mass * radius.powi(order));
        each.collect()
    }

    /// The column is the described effort, so a coefficient c means a torque constant off by −c/(1
    /// + c).
    fn linear(&self, mechanism: Mechanism, coefficients: &[f64]) -> Vec<f64> {
        let each = coefficients.iter().copied();
        each.map(|own| undone(mechanism, own)).collect()
    }

    fn coefficients(&self, mechanism: Mechanism, parameters: &[f64]) -> Vec<f64> {
        self.linear(mechanism, parameters)
    }

    fn columns(&self, cause: Cause, shape: &[f64], _: Option<&[f64]>) -> Option<Columns> {
        self.lacked(cause, shape)
    }

    fn shares(&self, at: Place, windows: &Windows) -> Vec<f64> {
        let outputs = self.outputs();
        let place = joint_at(at).and_then(|place| self.places.get(place));
        let stands = |row: usize| {
            let mut rows = place.iter().flat_map(|own| &own.rows);
            place.is_none() || rows.any(|(own, _)| *own == row % outputs)
        };
        let rows = 0..windows.centres.len();
        rows.map(|row| f64::from(u8::from(stands(row)))).collect()
    }
}
