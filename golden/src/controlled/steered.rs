//! This file names the controllers that have a case, with their settings and what their runs must show.

use rigproof_model::ModelError;
use rigproof_model::control::path::Line;
use rigproof_model::control::{
    Actuation, Controller, GainUnit, Impedance, Obstacle, Optimal, Sdof, Side, VelocityRatio,
    Virtual, Weights, controller, tip_mass,
};
use rigproof_model::linkage::Pose;
use rigproof_model::rig::Parameters;
use rigproof_spec::layout::Layout;
use rigproof_spec::methods::{BLEND_BOUNDARY_M, Method, Setting};
use rigproof_spec::units::M_PER_CM;

use crate::case::Parameter;
use crate::claim::{Claim, Shows};

/// A controller of the model with its settings.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Steered {
    /// A row of table 6.1.
    Method(Method),
    /// Velocity ratio control (Swanson).
    VelocityRatio,
    /// Optimal control (Swanson).
    Optimal,
    /// Impedance control with torque translation.
    Impedance,
    /// SDOF control on one side of the line only.
    Obstacle,
}

/// Gain of velocity ratio control, N·m·s/rad (decision 0042 leaves it to the user).
const RATIO_GAIN: f64 = 30.0;
/// Costs of optimal control.
const WEIGHTS: Weights = Weights {
    angle: 1.0,
    energy: 0.01,
    horizon_s: 0.03,
};
/// The virtual elements of impedance control.
const ELEMENTS: Virtual = Virtual {
    stiffness_n_per_m: 3000.0,
    damping_across_n_s_per_m: 300.0,
    damping_along_n_s_per_m: 100.0,
};

impl Steered {
    /// Every controller of the model, in the order of the runs.
    pub const ALL: [Steered; 9] = [
        Steered::Method(Method::Uncontrolled),
        Steered::Method(Method::Sdof),
        Steered::Method(Method::SdofWithGap),
        Steered::Method(Method::ProportionalLow),
        Steered::Method(Method::ProportionalHigh),
        Steered::VelocityRatio,
        Steered::Optimal,
        Steered::Impedance,
        Steered::Obstacle,
    ];

    /// What the run is called.
    pub const fn name(self) -> &'static str {
        match self {
            Steered::Method(Method::Uncontrolled) => "no control",
            Steered::Method(Method::Sdof) => "SDOF without gap",
            Steered::Method(Method::SdofWithGap) => "SDOF with gap",
            Steered::Method(Method::ProportionalLow) => "proportional, low gain",
            Steered::Method(Method::ProportionalHigh) => "proportional, high gain",
            Steered::VelocityRatio => "velocity ratio",
            Steered::Optimal => "optimal",
            Steered::Impedance => "impedance with torque translation",
            Steered::Obstacle => "SDOF, obstacle on the left of the line",
        }
    }

    /// Its law, by its name in the model.
    const fn law(self) -> &'static str {
        match self {
            Steered::Method(Method::Uncontrolled) => "Uncontrolled",
            Steered::Method(Method::Sdof | Method::SdofWithGap) => "Sdof",
            Steered::Method(Method::ProportionalLow | Method::ProportionalHigh) => "Proportional",
            Steered::VelocityRatio => "VelocityRatio",
            Steered::Optimal => "Optimal",
            Steered::Impedance => "Impedance",
            Steered::Obstacle => "Obstacle",
        }
    }

    /// Its settings.
    pub fn parameters(self) -> Vec<Parameter> {
        let mut parameters = vec![Parameter::word("controller", self.law())];
        if !matches!(
            self,
            Steered::Method(Method::Uncontrolled) | Steered::Impedance
        ) {
            let boundary =
                Parameter::number("boundary of the velocity field", BLEND_BOUNDARY_M, "m");
            parameters.push(boundary);
        }
        match self {
            Steered::Method(method) => match method.setting() {
                Setting::Nothing => {}
                Setting::GapCm(gap) => {
                    parameters.push(Parameter::number("gap", gap * M_PER_CM, "m"))
                }
                Setting::GainPrinted(gain) => {
                    let gain = gain * GainUnit::PerCentimetre.to_si();
                    parameters.push(Parameter::number("gain", gain, "N·s/m"));
                }
            },
            Steered::VelocityRatio => {
                parameters.push(Parameter::number("gain", RATIO_GAIN, "N·m·s/rad"));
            }
            Steered::Optimal => parameters.extend([
                Parameter::number("cost of the angle", WEIGHTS.angle, "1/rad^2"),
                Parameter::number("cost of the energy", WEIGHTS.energy, "1"),
                Parameter::number("horizon", WEIGHTS.horizon_s, "s"),
            ]),
            Steered::Impedance => parameters.extend([
                Parameter::number("stiffness across", ELEMENTS.stiffness_n_per_m, "N/m"),
                Parameter::number("damping across", ELEMENTS.damping_across_n_s_per_m, "N·s/m"),
                Parameter::number("damping along", ELEMENTS.damping_along_n_s_per_m, "N·s/m"),
            ]),
            Steered::Obstacle => parameters.extend([
                Parameter::word("controller inside", "Sdof"),
                Parameter::word("solid side", "left"),
            ]),
        }
        parameters
    }

    /// The controller on a line.
    ///
    /// # Errors
    /// None with these settings.
    pub fn controller(self, layout: Layout, line: Line) -> Result<Box<dyn Controller>, ModelError> {
        let (actuation, boundary_m) = (Actuation::thesis(layout), BLEND_BOUNDARY_M);
        Ok(match self {
            Steered::Method(method) => {
                controller(method, GainUnit::PerCentimetre, actuation, line)?
            }
            Steered::VelocityRatio => {
                Box::new(VelocityRatio::new(actuation, line, boundary_m, RATIO_GAIN)?)
            }
            Steered::Optimal => {
                let inertia = move |pose: &Pose| tip_mass(&Parameters::of(layout), pose);
                Box::new(Optimal::new(actuation, line, boundary_m, WEIGHTS, inertia)?)
            }
            Steered::Impedance => Box::new(Impedance::new(actuation, line, ELEMENTS)?),
            Steered::Obstacle => {
                let inner = Sdof::new(actuation, line, boundary_m, 0.0)?;
                Box::new(Obstacle::new(line, Side::Left, inner))
            }
        })
    }
}

/// What the runs of a layout must show.
pub fn must_show(layout: Layout) -> Vec<Claim> {
    vec![Claim::each("the tip moves", "tip_x", Shows::Spans(0.1))]
}
