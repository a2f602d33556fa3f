//! This file is the interface of a plant: everything that the diagnosis asks of an aligned
//! recording. Code that uses it does not know which plant it is.

mod described;
mod replayed;
mod rules;
mod simulated;

use crate::candidates::standard_shapes;
use crate::cause::{Cause, JointId, Place, Scales};
use crate::continuity::Remark;
use crate::filter::ends;
use crate::locate::{self, Regimes};
use crate::rules::{MOST_AMBIGUOUS, NOISE_ORDER, WIDTHS_S};
use crate::signals::unit_parameters;
use crate::unknown::{Variable, variables};
use crate::weak::{Windows, is_recorded, untold};
use crate::whiten::Whitener;
use core::fmt::Debug;
use rigproof_model::bench::{column, column_by_travel};
use rigproof_model::effects::{Form, Instant, Law, entry};
use rigproof_spec::effect::{Mechanism, Motion};
use rigproof_spec::tables::GREATEST_CURRENT_A;
use rigproof_spec::units::Dimension;

pub use crate::align::Fault;
pub use crate::effect::Effect;
pub use crate::signals::{numerov, second_difference};
pub use described::{At, Described, Plant, Replica, Shown};
pub use replayed::{Frame, RESTART_S, Replayed};
pub use rules::Rules;
pub use simulated::{Simulated, SimulatedOutput, Unsimulated};

/// The clock of a recording, with regular samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clock {
    /// Sample interval, s.
    pub step_s: f64,
    /// Time of the first sample, s.
    pub start_s: f64,
    /// Number of samples.
    pub samples: usize,
}

impl Clock {
    /// A clock from its sample interval (s), its first time (s) and its number of samples.
    pub const fn new(step_s: f64, start_s: f64, samples: usize) -> Clock {
        Clock {
            step_s,
            start_s,
            samples,
        }
    }

    /// The length of the recording, s.
    pub fn duration_s(self) -> f64 {
        self.step_s * self.samples.saturating_sub(1) as f64
    }

    /// The first sample at or after a time, s.
    pub fn sample_at(self, time_s: f64) -> usize {
        ((time_s - self.start_s) / self.step_s).ceil().max(0.0) as usize
    }
}

/// What a cause adds to the balance of efforts. With several outputs, a signal holds the samples of
/// one output after those of another.
#[derive(Clone, Debug, PartialEq)]
pub enum Columns {
    /// One signal per linear parameter, which is its coefficient.
    Free(Vec<Vec<f64>>),
    /// A signal with coefficient 1: the cause has no linear parameter.
    Fixed(Vec<f64>),
    /// Signals of a plant in another configuration than recorded. [`Run::moved_rows`] makes rows of
    /// them, which are no averages of a signal.
    Moved(Vec<Vec<f64>>),
}

/// An aligned recording, with the equations of its plant.
///
/// Signals are in SI units, one value per sample. With several outputs, a signal holds the samples
/// of one output after those of another.
pub trait Run: Debug + Send + Sync {
    /// Its samples.
    fn clock(&self) -> Clock {
        let motion = self.motion(Place::Whole);
        let at = |now: Option<&Instant>| now.map_or(0.0, |now| now.time_s);
        let (start_s, samples) = (at(motion.first()), motion.len());
        let step_s = (at(motion.last()) - start_s) / samples.saturating_sub(1).max(1) as f64;
        Clock::new(step_s, start_s, samples)
    }

    /// Whether each sample was recorded rather than interpolated; empty if all were.
    fn recorded(&self) -> &[bool] {
        &[]
    }

    /// What was repaired, and other remarks.
    fn remarks(&self) -> &[Remark] {
        &[]
    }

    /// Whether the plant is linear or rotary, which decides the units of its parameters.
    fn motion_kind(&self) -> Motion {
        Motion::Rotary
    }

    /// What drives a brake, which decides the unit of its limits.
    fn driven_by(&self) -> Dimension {
        Dimension::CURRENT
    }

    /// The greatest current of a brake's table, A, or the greatest command of its characteristic.
    fn full_current(&self) -> f64 {
        GREATEST_CURRENT_A
    }

    /// Number of equations: each window gives as many rows.
    fn outputs(&self) -> usize {
        1
    }

    /// The name of an output.
    fn output_name(&self, output: usize) -> &'static str {
        let _ = output;
        "effort"
    }

    /// The rules of naming for this plant.
    fn rules(&self) -> &'static Rules {
        &Rules::ONE_EQUATION
    }

    /// The samples `from..to`, with their times; `None` if the recording cannot be cut.
    fn slice(&self, from: usize, to: usize) -> Option<Box<dyn Run>> {
        let _ = (from, to);
        None
    }

    // The balance of efforts: driving effort = known part + what the nominal model lacks.

    /// The driving effort as recorded: the scale of all contributions.
    fn effort(&self) -> Vec<f64>;

    /// The driving effort as the second difference of the positions shows it: with Numerov's
    /// weights where it is smooth between samples.
    fn driving(&self) -> Vec<f64> {
        numerov(&self.effort())
    }

    /// The known part of the balance: inertia, predicted efforts.
    fn known(&self) -> Vec<f64>;

    /// Signals of the nuisance parameters, such as an unknown inertia. They enter every fit.
    fn nuisances(&self) -> Vec<Vec<f64>> {
        Vec::new()
    }

    // Windows and noise.

    /// The windows that suit the recording. Those in which the sensors show too little are marked
    /// unusable.
    fn windows(&self) -> Windows {
        let [narrowest_s, ..] = WIDTHS_S;
        self.windows_of(narrowest_s)
    }

    /// Marks rows as unusable where the sensors show too little: a sample is missing, or a
    /// direction of motion is unknown.
    fn keep_told(&self, windows: &mut Windows) {
        windows.keep(|centre, bump| is_recorded(self.recorded(), centre, bump));
        for place in self.moving_places() {
            let motion = self.motion(place);
            windows.keep(|centre, bump| untold(motion, centre, bump) <= MOST_AMBIGUOUS);
        }
    }

    /// Windows of about a width in s, with unusable rows marked.
    fn windows_of(&self, width_s: f64) -> Windows {
        let mut windows = self.all_windows(width_s);
        self.keep_told(&mut windows);
        windows
    }

    /// All windows of about a width in s.
    fn all_windows(&self, width_s: f64) -> Windows {
        let clock = self.clock();
        let times = (clock.step_s, clock.start_s);
        Windows::over(clock.samples, self.outputs(), times, width_s)
    }

    /// Standard deviations of the sensor noise: of the signal that is differenced twice (an inertia
    /// times a position), and of the effort.
    fn sensors(&self) -> [f64; 2];

    /// The noise floor: root mean square over the usable rows of the standard deviation that sensor
    /// noise gives them.
    fn floor(&self, windows: &Windows) -> f64 {
        let covariance = windows.noise_covariance(self.sensors(), 0.0, 1);
        covariance.iter().sum::<f64>().sqrt()
    }

    /// The noise model of the usable rows. `excess` is the variance of additional white effort.
    fn whitener(&self, windows: &Windows, excess: f64) -> Whitener {
        let covariance = windows.noise_covariance(self.sensors(), excess, NOISE_ORDER + 1);
        Whitener::new(&covariance, &windows.usable)
    }

    /// Standard deviation of a position sample: the scale of a travel.
    fn position_noise(&self) -> f64 {
        0.0
    }

    // Places.

    /// Number of named joints; 0 if the plant is a single joint.
    fn joints(&self) -> usize {
        0
    }

    /// The name of a place in reports; `None` for the whole plant.
    fn place_name(&self, at: Place) -> Option<&'static str> {
        let _ = at;
        None
    }

    /// The smoothed motion at a place, on which the laws are evaluated. Empty for a place without a
    /// motion of its own.
    fn motion(&self, at: Place) -> &[Instant];

    /// The range of the position at a place, m or rad.
    fn travel(&self, at: Place) -> f64 {
        let [low, high] = ends(self.motion(at).iter().map(|now| now.position));
        (high - low).max(0.0)
    }

    /// Speed below which the direction of motion cannot be told.
    fn speed_floor(&self) -> f64 {
        0.0
    }

    // Causes.

    /// The causes that have a meaning on this plant.
    fn causes(&self) -> Vec<Cause>;

    /// The trial shapes of a cause. `residual` has one value per row.
    fn shapes(&self, cause: Cause, windows: &Windows, residual: &[f64]) -> Vec<Vec<f64>> {
        standard_shapes(self, cause, windows, residual)
    }

    /// How much of a passive cause the nominal model already has. A fit may take away that much.
    fn described(&self, cause: Cause) -> f64 {
        let _ = cause;
        0.0
    }

    /// The standard deviation of each linear parameter of a cause about 0 that is known without the
    /// recording; empty where nothing is known.
    fn prior_deviations(&self, cause: Cause) -> Vec<f64> {
        let _ = cause;
        Vec::new()
    }

    /// The bounds of the first shape parameter, where they lie beyond the grid.
    fn reach(&self, cause: Cause) -> Option<(f64, f64)> {
        let _ = cause;
        None
    }

    /// What a cause of this shape adds to the balance; `None` if it has no meaning here.
    ///
    /// `beside` is the effort of all other terms, sample by sample. A cause that acts on that
    /// effort has no columns without it.
    fn columns(&self, cause: Cause, shape: &[f64], beside: Option<&[f64]>) -> Option<Columns> {
        let _ = beside;
        self.resistances(cause, shape)
    }

    /// The columns of a resistance along the motion at its place, with Numerov's weights.
    fn resistances(&self, cause: Cause, shape: &[f64]) -> Option<Columns> {
        let (motion, step_s) = (self.motion(cause.at), self.clock().step_s);
        let own = resistances(cause, shape, |law| column(law, motion, step_s))?;
        Some(Columns::Free(
            own.iter().map(|signal| numerov(signal)).collect(),
        ))
    }

    /// Whether some causes act on the effort of the other terms, so that they have to be linearised
    /// repeatedly.
    fn is_linearised(&self) -> bool {
        false
    }

    /// Whether a cause changes the configuration of the plant: its columns are [`Columns::Moved`].
    fn moves(&self, cause: Cause) -> bool {
        let _ = cause;
        false
    }

    /// The rows of [`Columns::Moved`], one list per linear parameter. `recorded` is the recorded
    /// balance, `first` the sample of the onset.
    fn moved_rows(
        &self,
        windows: &Windows,
        recorded: &[f64],
        signals: &[Vec<f64>],
        cause: Cause,
        shape: &[f64],
        first: usize,
    ) -> Vec<Vec<f64>> {
        let _ = (windows, recorded, signals, cause, shape, first);
        Vec::new()
    }

    /// For a cause whose columns are straight for a small change only: the shape with which they
    /// hold for the whole change that these coefficients state.
    fn shape_over(&self, cause: Cause, shape: &[f64], coefficients: &[f64]) -> Option<Vec<f64>> {
        let _ = (cause, shape, coefficients);
        None
    }

    /// The linear parameters of a mechanism from the coefficients of its columns.
    fn linear(&self, mechanism: Mechanism, coefficients: &[f64]) -> Vec<f64> {
        let _ = mechanism;
        coefficients.to_vec()
    }

    /// Whether a cause with these coefficients is no plant's: the description has another unit or
    /// sign than the recording.
    fn is_another_unit(&self, cause: Cause, coefficients: &[f64]) -> bool {
        let _ = (cause, coefficients);
        false
    }

    /// The coefficients of the columns from the linear parameters: the inverse of [`Run::linear`].
    fn coefficients(&self, mechanism: Mechanism, parameters: &[f64]) -> Vec<f64> {
        let _ = mechanism;
        parameters.to_vec()
    }

    /// The cause that no recording of this plant can distinguish from another.
    fn twin(&self, cause: Cause) -> Option<Cause> {
        let _ = cause;
        None
    }

    /// For a bench with one brake: the torque that its nominal model predicts, N·m, and its
    /// current, A.
    fn brake(&self) -> Option<(&[f64], &[f64])> {
        None
    }

    // The residual.

    /// The regimes in which unexplained energy is located.
    fn regimes(&self, windows: &Windows) -> Regimes {
        let motion = self.motion(Place::Whole);
        let [low, _] = ends(motion.iter().map(|now| now.position));
        locate::along(
            "effort balance",
            motion,
            windows,
            [low, self.travel(Place::Whole)],
        )
    }

    /// The row entries of a unit of effort at a place.
    fn shares(&self, at: Place, windows: &Windows) -> Vec<f64> {
        let _ = at;
        vec![1.0; windows.centres.len()]
    }

    /// The variables over which a free curve of the residual can be drawn.
    fn variables(&self, windows: &Windows) -> Vec<Variable> {
        let places = self.moving_places().into_iter();
        let each = places.map(|at| variables(self, windows, at, &self.shares(at, windows)));
        each.flatten().collect()
    }

    /// All places with a motion of their own: every joint, or the whole of a single joint.
    fn moving_places(&self) -> Vec<Place> {
        match self.joints() {
            0 => vec![Place::Whole],
            joints => (0..joints).map(|k| Place::Joint(JointId(k))).collect(),
        }
    }

    /// The name of a cause in reports: `viscous`, `viscous at E`, `stribeck of the torque at every
    /// brake`.
    fn cause_name(&self, cause: Cause) -> String {
        let mechanism = cause.mechanism.name();
        let of = match cause.scales {
            Scales::Nothing => "",
            Scales::Torque => " of the torque",
        };
        match self.place_name(cause.at) {
            Some(place) => format!("{mechanism}{of} at {place}"),
            None => format!("{mechanism}{of}"),
        }
    }
}

/// The resistance of a law along the motion of a joint.
///
/// A law that restarts at a reversal goes by the recorded travel. A smoothed position hides a slow
/// reversal of a few counts, and rings where the joint comes to rest.
pub fn along(
    law: &dyn Law,
    motion: &[Instant],
    step_s: f64,
    known_travel: impl FnOnce() -> Vec<f64>,
) -> Vec<f64> {
    if law.begins_anew() {
        return column_by_travel(law, motion, &known_travel(), step_s);
    }
    column(law, motion, step_s)
}

/// One signal per linear parameter of a resistance: the law with that parameter 1 and the others 0,
/// `along` a motion. `None` for a mechanism that is no resistance.
pub fn resistances(
    cause: Cause,
    shape: &[f64],
    along: impl Fn(&dyn Law) -> Vec<f64>,
) -> Option<Vec<Vec<f64>>> {
    let entry = entry(cause.mechanism)?;
    if !matches!(entry.form, Form::Resistance(_) | Form::ShareOfBrake(_)) {
        return None;
    }
    let each = unit_parameters(entry.linear, shape);
    each.map(|parameters| {
        let law = cause.law(&parameters)?;
        Some(along(law.as_ref()))
    })
    .collect()
}
