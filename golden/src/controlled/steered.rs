//! This file names the controllers that have a case, with their settings and what their runs must show.

use rigproof_model::ModelError;
use rigproof_model::control::path::Line;
use rigproof_model::control::{
    Actuation, Controller, GainUnit, Impedance, Obstacle, Optimal, Sdof, Side, VelocityRatio,
    Virtual, Weights, controller, tip_mass,
};
use rigproof_model::linkage::Pose;
use rigproof_model::rig::Parameters;
use rigproof_model::trial::Segment;
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
    /// SDOF control on the solid side of a wall only.
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

/// The obstacle's boundary: it crosses the line, so that the hand starts free and runs into it.
const WALL: Segment = Segment {
    from_m: [-0.085, 0.296],
    to_m: [0.11, 0.41],
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
            Steered::Obstacle => "obstacle, with SDOF control",
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
            Steered::Obstacle => {
                let [[from_x, from_y], [to_x, to_y]] = [WALL.from_m, WALL.to_m];
                parameters.extend([
                    Parameter::word("controller inside", "Sdof"),
                    Parameter::word("solid side of the wall", "left"),
                    Parameter::number("wall from x", from_x, "m"),
                    Parameter::number("wall from y", from_y, "m"),
                    Parameter::number("wall to x", to_x, "m"),
                    Parameter::number("wall to y", to_y, "m"),
                ]);
            }
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
                let wall = Line::through(WALL.from_m, WALL.to_m)?;
                let inner = Sdof::new(actuation, wall, boundary_m, 0.0)?;
                Box::new(Obstacle::new(wall, Side::Left, inner))
            }
        })
    }
}

/// What the runs of a layout must show.
pub fn must_show(layout: Layout) -> Vec<Claim> {
    let says = "the tip goes along the line, which is 0.17 m wide, for 0.14 m";
    let mut claims = vec![Claim::each(says, "tip_x", Shows::Spans(0.14))];
    for (index, steered) in Steered::ALL.into_iter().enumerate() {
        let (run, (least, reasons)) = (index + 1, steered.reasons(layout));
        if least > 0 {
            let says = format!("the controller changes its mind {least} times from row to row");
            claims.push(Claim::of(run, says, "reason", Shows::Changes(least)));
        }
        for reason in reasons {
            let says = format!("the controller comes to `{reason}`");
            let has = Shows::Has((*reason).to_owned());
            claims.push(Claim::of(run, says, "reason", has));
        }
    }
    claims
}

impl Steered {
    /// How often the reason must change, and the reasons that must be there.
    const fn reasons(self, layout: Layout) -> (usize, &'static [&'static str]) {
        let three = matches!(layout, Layout::ThreeBrake);
        match self {
            Steered::Method(Method::Uncontrolled) => (0, &["uncontrolled"]),
            Steered::Method(Method::Sdof) if three => (20, &["chosen_A", "chosen_E", "chosen_B"]),
            Steered::Method(Method::Sdof) => (20, &["chosen_B", "chosen_C"]),
            Steered::Method(Method::SdofWithGap) => (4, &["inside_gap", "chosen_B"]),
            Steered::Method(Method::ProportionalLow | Method::ProportionalHigh) if three => {
                (10, &["chosen_E", "chosen_B", "locked_pushed_away"])
            }
            Steered::Method(Method::ProportionalLow | Method::ProportionalHigh) => (
                5,
                &["chosen_B", "chosen_C", "none_helps", "locked_pushed_away"],
            ),
            Steered::VelocityRatio => (5, &["chosen_E", "chosen_B", "nothing_to_do"]),
            Steered::Optimal => (10, &["chosen_A", "chosen_E", "chosen_B", "nothing_to_do"]),
            Steered::Impedance if three => (10, &["chosen_A_E", "chosen_A_B", "none_helps"]),
            Steered::Impedance => (5, &["chosen_A_E", "chosen_A_B", "none_helps"]),
            Steered::Obstacle if three => (5, &["free_side", "chosen_E"]),
            Steered::Obstacle => (5, &["free_side", "chosen_C"]),
        }
    }
}
