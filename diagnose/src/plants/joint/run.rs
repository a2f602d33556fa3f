//! This file is an aligned recording of a plant of one joint: regular samples, smoothed motion,
//! efforts, noise levels.

use super::inertia::Inertia;
use super::joined::over_parts;
use super::servo::Servoed;
use super::{columns, mistaken, shapes};
use crate::align::band_hz;
use crate::candidates::standard_shapes;
use crate::cause::{Cause, Place};
use crate::continuity::Remark;
use crate::doubt::{greatest_change, jumps_late, turning};
use crate::effect::Effect;
use crate::filter::{ends, rms};
use crate::locate::{self, Regimes};
use crate::plant::{Clock, Columns, Run};
use crate::plants::brake::{BrakeLaw, Braked};
use crate::problem::add;
use crate::rules::{
    FEWEST_WINDOWS, LEAST_STEPS_AXIS, LEAST_STEPS_BENCH, MOST_AMBIGUOUS, MOST_NOISE, MOST_UNTOLD,
    PERIODS_A_WIDTH, QUIET, WIDTHS_S,
};
use crate::signals::second_difference;
use crate::unknown::{Variable, variables};
use crate::weak::{Windows, is_recorded, untold};
use rigproof_model::brake::Characteristic;
use rigproof_model::effects::facts::Shapes;
use rigproof_model::effects::{Drive, Form, Instant, OfJoint, OfSensor, facts, form};
use rigproof_spec::effect::{Mechanism, Motion};
use rigproof_spec::tables::{BrakeTable, GREATEST_CURRENT_A};
use rigproof_spec::units::Dimension;

/// The kind of plant, which decides the equation that a recording obeys.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlantKind {
    /// Driven joint: the residual is `gain·u − inertia·q̈ − resistance`.
    Axis,
    /// Imposed motion: the residual is the metered effort less the resistance.
    Bench,
}

/// The nominal brake of a bench.
#[derive(Clone, Debug)]
pub enum JointBrake {
    /// The thesis's, with the numbers of a table.
    Thesis(BrakeTable),
    /// A static characteristic over a command in the unit of this dimension.
    Characteristic(Characteristic, Dimension),
}

/// An aligned recording in SI units. Every vector has one value per sample.
#[derive(Clone, Debug)]
pub struct JointRun {
    /// The kind of plant.
    pub plant: PlantKind,
    /// Whether the joint is linear or rotary.
    pub kind: Motion,
    /// The inertia as the description gives it.
    pub inertia: Inertia,
    /// The effects of the description.
    pub described: Vec<Effect>,
    /// Sample interval, s.
    pub step_s: f64,
    /// Time of the first sample, s.
    pub start_s: f64,
    /// Whether the drive holds its value between samples, so that it acts half a sample late on
    /// average.
    pub held: bool,
    /// Of a static sweep, where each sample stood in it.
    pub rows: Option<Vec<usize>>,
    /// Recorded position, m or rad.
    pub position: Vec<f64>,
    /// Smoothed motion: what the laws are evaluated on.
    pub motion: Vec<Instant>,
    /// Axis: `gain·u`. Bench: the metered effort. N or N·m.
    pub effort: Vec<f64>,
    /// Bench: the effort that the nominal model predicts (from a brake or an external simulation).
    pub predicted: Option<Vec<f64>>,
    /// Bench: the current, A, or the command of a characteristic.
    pub current: Option<Vec<f64>>,
    /// Bench: the brake whose torque is predicted.
    pub law: Option<JointBrake>,
    /// Standard deviation of one position sample, m or rad.
    pub position_noise: f64,
    /// Standard deviation of one effort sample, N or N·m.
    pub effort_noise: f64,
    /// Whether a sample was recorded rather than interpolated.
    pub recorded: Vec<bool>,
    /// Speed below which the direction of motion cannot be told, m/s or rad/s.
    pub speed_floor: f64,
    /// The uncertainty of the speed, m/s or rad/s.
    pub untold_speed: Vec<f64>,
    /// Bench: the described effects between the resistance and the metered effort.
    pub metered_by: Vec<Effect>,
    /// Axis: the position servo that drives it, if one does.
    pub servo: Option<Servoed>,
    /// The separate recordings of a joined run; empty for a single one.
    pub parts: Vec<JointRun>,
    /// What was repaired.
    pub remarks: Vec<Remark>,
}

impl JointRun {
    /// The number of samples.
    pub fn len(&self) -> usize {
        self.position.len()
    }

    /// The predicted torque, N·m, and the current, A, of a bench with a brake; `None` on other
    /// plants.
    pub fn brake(&self) -> Option<(&[f64], &[f64])> {
        Some((self.predicted.as_deref()?, self.current.as_deref()?))
    }

    /// The simulated effort of a bench without a brake: what the mechanism transmits. `None` on
    /// other plants.
    pub fn load(&self) -> Option<&[f64]> {
        match self.brake() {
            None => self.predicted.as_deref(),
            Some(_) => None,
        }
    }

    /// The torque of the brake along the recorded motion for a current in A; N·m. `None`
    /// without a brake.
    pub fn braked(&self, current: &[f64]) -> Option<Vec<f64>> {
        self.braked_along(&self.motion, current)
    }

    /// The uncertainty of the brake's torque, N·m.
    ///
    /// Between two samples it is unknown when the shaft reverses, when backlash begins and ends,
    /// and when a current jumps that is not held. Noise may also carry the speed across the
    /// thresholds at which the time constant jumps.
    pub fn brake_doubt(&self) -> Option<Vec<f64>> {
        let current = self.current.as_deref()?;
        let own = self.braked(current)?;
        let late = self.motion.iter().take(1).chain(&self.motion);
        let mut motions: Vec<Vec<Instant>> = vec![late.copied().take(self.len()).collect()];
        motions.extend([1.0, -1.0].map(|sign| turning(&self.motion, &self.untold_speed, sign)));
        let along = |motion: &Vec<Instant>| self.braked_along(motion, current);
        let mut others: Vec<Vec<f64>> = motions.iter().filter_map(along).collect();
        if !self.held {
            others.extend(self.braked(&jumps_late(current)));
        }
        Some(greatest_change(&own, &others))
    }

    fn braked_along(&self, motion: &[Instant], current: &[f64]) -> Option<Vec<f64>> {
        let brake = Braked {
            motion,
            ..self.brake_along(current)?
        };
        // Where the direction cannot be told, the torque is spread over both directions, as for the
        // dry friction laws.
        let torques = motion.iter().zip(brake.yields());
        Some(torques.map(|(now, torque)| torque * now.sense).collect())
    }

    /// The brake along the recorded motion for a current in A. `None` without a brake.
    pub fn brake_along<'a>(&'a self, current: &'a [f64]) -> Option<Braked<'a>> {
        Some(Braked {
            law: match self.law.as_ref()? {
                JointBrake::Thesis(table) => BrakeLaw::Thesis(*table),
                JointBrake::Characteristic(own, _) => BrakeLaw::Characteristic(own),
            },
            motion: &self.motion,
            current,
            held: self.held,
            step_s: self.step_s,
            rows: self.rows.as_deref(),
        })
    }

    /// Forgets the end of a recording whose motion, so much earlier or later, was not recorded.
    pub fn forget_ends(&mut self, delay_s: f64) {
        let count = (delay_s.abs() / self.step_s).ceil() as usize;
        let count = count.min(self.recorded.len());
        let from = match delay_s > 0.0 {
            true => 0,
            false => self.recorded.len() - count,
        };
        if let Some(ends) = self.recorded.get_mut(from..from + count) {
            ends.fill(false);
        }
    }

    /// Whether there are no samples.
    pub fn is_empty(&self) -> bool {
        self.position.is_empty()
    }

    /// The samples `from..to`, with their times.
    pub fn part(&self, from: usize, to: usize) -> JointRun {
        let part = |values: &Vec<f64>| values.get(from..to).unwrap_or_default().to_vec();
        JointRun {
            plant: self.plant,
            kind: self.kind,
            inertia: self.inertia,
            described: self.described.clone(),
            step_s: self.step_s,
            start_s: self.start_s + from as f64 * self.step_s,
            held: self.held,
            rows: self
                .rows
                .as_ref()
                .map(|rows| rows.get(from..to).unwrap_or_default().to_vec()),
            position: part(&self.position),
            motion: self.motion.get(from..to).unwrap_or_default().to_vec(),
            effort: part(&self.effort),
            predicted: self.predicted.as_ref().map(part),
            current: self.current.as_ref().map(part),
            law: self.law.clone(),
            position_noise: self.position_noise,
            effort_noise: self.effort_noise,
            recorded: self.recorded.get(from..to).unwrap_or_default().to_vec(),
            speed_floor: self.speed_floor,
            untold_speed: part(&self.untold_speed),
            metered_by: self.metered_by.clone(),
            servo: self.servo.as_ref().map(|servo| servo.part(from, to)),
            parts: Vec::new(),
            remarks: self.remarks.clone(),
        }
    }

    /// The range of positions, m or rad.
    pub fn travel(&self) -> f64 {
        let [low, high] = ends(self.position.iter().copied());
        (high - low).max(0.0)
    }
}

impl JointRun {
    /// The width of the windows, s.
    ///
    /// It is the narrowest width whose predicted noise is small beside the effort. If the effort is
    /// faster than that, the width is reduced further, to at least eight samples (five on a bench).
    pub fn width_s(&self) -> f64 {
        let scale = rms(&self.effort);
        let quiet = |width_s: &f64| self.floor(&self.all_windows(*width_s)) <= QUIET * scale;
        let fast_s = PERIODS_A_WIDTH / band_hz(&self.effort, self.step_s);
        if self.plant == PlantKind::Bench {
            return WIDTHS_S[0].min(fast_s).max(LEAST_STEPS_BENCH * self.step_s);
        }
        // A fast effort may only be position noise fed back. The narrow width is used if its noise
        // leaves something to see.
        let wide_s = WIDTHS_S.iter().copied().find(quiet).unwrap_or(WIDTHS_S[2]);
        let narrow_s = wide_s.min(fast_s).max(LEAST_STEPS_AXIS * self.step_s);
        match self.floor(&self.all_windows(narrow_s)) <= MOST_NOISE * scale {
            true => narrow_s,
            false => wide_s,
        }
    }
}

impl Run for JointRun {
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
        self.kind
    }

    fn driven_by(&self) -> Dimension {
        match &self.law {
            Some(JointBrake::Characteristic(_, driving)) => *driving,
            _ => Dimension::CURRENT,
        }
    }

    fn full_current(&self) -> f64 {
        match &self.law {
            Some(JointBrake::Characteristic(own, _)) => own.greatest_command(),
            _ => GREATEST_CURRENT_A,
        }
    }

    fn slice(&self, from: usize, to: usize) -> Option<Box<dyn Run>> {
        Some(Box::new(self.part(from, to)))
    }

    fn effort(&self) -> Vec<f64> {
        self.effort.clone()
    }

    fn driving(&self) -> Vec<f64> {
        columns::acting_effort(self, &self.effort)
    }

    fn known(&self) -> Vec<f64> {
        let none = || vec![0.0; self.len()];
        let predicted = self.predicted.as_ref();
        let predicted = predicted.map(|own| columns::metered(self, own.clone()));
        let mut known = predicted.unwrap_or_else(none);
        if let Inertia::Known(value) = self.inertia {
            let acceleration = second_difference(&self.position, self.step_s);
            add(&mut known, &acceleration, value);
        }
        known
    }

    fn nuisances(&self) -> Vec<Vec<f64>> {
        match self.inertia {
            Inertia::Unknown(_) => vec![second_difference(&self.position, self.step_s)],
            _ => Vec::new(),
        }
    }

    fn windows(&self) -> Windows {
        self.windows_of(self.width_s())
    }

    /// Each row of a static sweep stands alone.
    fn all_windows(&self, width_s: f64) -> Windows {
        let times = (self.step_s, self.start_s);
        match self.rows {
            Some(_) => Windows::alone(self.len(), times),
            None => Windows::over(self.len(), self.outputs(), times, width_s),
        }
    }

    /// Keeps windows in which the direction of motion is known throughout. On an axis they must not
    /// hide the start or end of a rest; with a brake, its torque must be predictable.
    fn keep_told(&self, windows: &mut Windows) {
        let most = |share: f64| {
            move |centre: usize, bump: &[f64]| untold(&self.motion, centre, bump) <= share
        };
        windows.keep(|centre, bump| is_recorded(&self.recorded, centre, bump));
        windows.keep(most(MOST_AMBIGUOUS));
        if self.is_sweep() {
            return;
        }
        let floor = self.floor(windows);
        if self.plant == PlantKind::Axis {
            windows.keep(most(MOST_UNTOLD * floor / rms(&self.effort).max(1e-300)));
        }
        let (Some((predicted, _)), Some(doubt)) = (self.brake(), self.brake_doubt()) else {
            return;
        };
        // The torque of a characteristic is known while it changes. The thesis's goes by the speed
        // and by backlash then.
        if !matches!(self.law, Some(JointBrake::Characteristic(..))) {
            let mut steady = windows.clone();
            steady.keep_steady(predicted, floor);
            if steady.usable.iter().filter(|own| **own).count() >= FEWEST_WINDOWS {
                *windows = steady;
                return;
            }
        }
        windows.keep_foreseen(&doubt, floor);
    }

    fn sensors(&self) -> [f64; 2] {
        [
            self.inertia.start() * self.position_noise,
            self.effort_noise,
        ]
    }

    fn position_noise(&self) -> f64 {
        self.position_noise
    }

    fn motion(&self, _: Place) -> &[Instant] {
        &self.motion
    }

    fn travel(&self, _: Place) -> f64 {
        JointRun::travel(self)
    }

    fn causes(&self) -> Vec<Cause> {
        shapes::causes(self)
    }

    /// A stated number can be too large as well as too small.
    fn described(&self, cause: Cause) -> f64 {
        let own = self.described.iter();
        let own = own.filter(|effect| effect.cause == cause && !effect.unknown);
        own.filter_map(|effect| effect.parameters.first()).sum()
    }

    fn speed_floor(&self) -> f64 {
        self.speed_floor
    }

    fn columns(&self, cause: Cause, shape: &[f64], beside: Option<&[f64]>) -> Option<Columns> {
        over_parts(self, |run, part| {
            let beside = match beside {
                Some([]) => Some(&[][..]),
                Some(beside) => Some(beside.get(part)?),
                None => None,
            };
            columns::columns(run, cause, shape, beside)
        })
    }

    fn is_linearised(&self) -> bool {
        true
    }

    fn is_another_unit(&self, cause: Cause, coefficients: &[f64]) -> bool {
        mistaken::is_another_unit(self, cause, coefficients)
    }

    fn linear(&self, mechanism: Mechanism, coefficients: &[f64]) -> Vec<f64> {
        match (form(mechanism), self.plant) {
            // On an axis the column is the known effort: y = e + c·e, so the applied gain is 1/(1 +
            // c) of the stated one. On a bench the metered effort is the brake's torque itself.
            (Some(Form::Drive(Drive::Gain)), PlantKind::Axis) => {
                coefficients.iter().map(|c| -c / (1.0 + c)).collect()
            }
            // An encoder that shows too much motion means that the true motion is smaller.
            (Some(Form::Sensor(OfSensor::EncoderScale | OfSensor::Eccentric)), _) => {
                coefficients.iter().map(|c| -c).collect()
            }
            _ => coefficients.to_vec(),
        }
    }

    /// A load that is not recorded but computed, from a servo's goal or by a simulation, tells no
    /// exponent of the friction under it: that would take what else is left.
    fn shapes(&self, cause: Cause, windows: &Windows, residual: &[f64]) -> Vec<Vec<f64>> {
        let mut shapes = standard_shapes(self, cause, windows, residual);
        let is_load = matches!(form(cause.mechanism), Some(Form::Joint(OfJoint::Load)));
        if is_load && (self.plant == PlantKind::Bench || self.servo.is_some()) {
            shapes.retain(|own| own.len() == 1);
        }
        shapes
    }

    fn shape_over(&self, cause: Cause, shape: &[f64], coefficients: &[f64]) -> Option<Vec<f64>> {
        let is_pitch = facts(cause.mechanism)?.shapes == Shapes::Pitch;
        let pitch = shape.get(..1).filter(|_| is_pitch)?;
        Some([pitch, &self.linear(cause.mechanism, coefficients)].concat())
    }

    /// Without a reversal, a constant may be a bias or a direction asymmetry.
    fn twin(&self, cause: Cause) -> Option<Cause> {
        facts(cause.mechanism)?
            .twin
            .map(|twin| self.twin_here(twin))
    }

    fn brake(&self) -> Option<(&[f64], &[f64])> {
        JointRun::brake(self)
    }

    /// No curve over a position or a time that a static sweep does not have.
    fn variables(&self, windows: &Windows) -> Vec<Variable> {
        let shares = self.shares(Place::Whole, windows);
        let mut all = variables(self, windows, Place::Whole, &shares);
        all.retain(|own| !self.is_sweep() || ["speed", "effort"].contains(&own.name));
        all
    }

    fn regimes(&self, windows: &Windows) -> Regimes {
        if self.is_sweep() {
            return self.regimes_of_sweep(windows);
        }
        let output = match self.plant {
            PlantKind::Axis => "effort balance",
            PlantKind::Bench => "metered effort",
        };
        let [low, _] = ends(self.position.iter().copied());
        locate::along(output, &self.motion, windows, [low, self.travel()])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plants::joint::recorded::{NOMINAL, STEP_S, exact_axis};

    #[test]
    fn a_slice_keeps_its_times() {
        let run = exact_axis(NOMINAL, 500, true);
        let part = run.part(113, 401);
        assert_eq!(part.len(), 288);
        assert_eq!(part.motion[0].time_s, run.motion[113].time_s);
        assert!((part.start_s - 113.0 * STEP_S).abs() < 1e-12);
        assert_eq!(
            part.clock()
                .sample_at(run.motion[117].time_s - 0.3 * STEP_S),
            4
        );
        assert_eq!(part.effort, run.effort[113..401]);
    }
}
