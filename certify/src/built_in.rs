//! This file makes a controller of the rig's own laws from a kind and its parameters.

use rigproof_impl::actuation::Actuation;
use rigproof_impl::law::{
    AnyLaw, Impedance, Obstacle, Optimal, PathLaw, Proportional, Sdof, Side, Uncontrolled,
    VelocityRatio, Virtual, Weights,
};
use rigproof_impl::number::Real;
use rigproof_impl::path::Path;
use rigproof_impl::tick::{Settings, Tick};
use rigproof_impl::tip_mass::Bodies;
use rigproof_model::control::GainUnit;
use rigproof_spec::geometry::Arms;
use rigproof_spec::inertia::inertia;
use rigproof_spec::layout::Layout;
use rigproof_spec::methods::{BLEND_BOUNDARY_M, Method, Setting};
use rigproof_spec::units::M_PER_CM;
use serde::{Deserialize, Serialize};

use crate::controller::{Controller, Failure, Source, Task};
use crate::declared::{Choice, Claim, Declared, EVERY, Solid};
use crate::way::{Remembered, Way};

/// A law of the rig with its parameters.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub enum Kind {
    /// No brake ever acts.
    Uncontrolled,
    /// §6.2.
    Sdof {
        /// Distance from the path inside which no brake acts, m.
        gap_m: f64,
    },
    /// §6.3.
    Proportional {
        /// `K_y` of (6.13), N·s/m.
        gain_n_s_per_m: f64,
    },
    /// §2.2.2.
    VelocityRatio {
        /// Gain, N·m·s/rad.
        gain_nm_s_per_rad: f64,
    },
    /// §2.2.2.
    Optimal {
        /// Weight of the squared angle, 1/rad².
        weight_angle: f64,
        /// Weight of the squared change of energy, 1.
        weight_energy: f64,
        /// Horizon, s.
        horizon_s: f64,
    },
    /// §2.2.2.
    Impedance {
        /// Spring across the path, N/m.
        stiffness_n_per_m: f64,
        /// Damper across it, N·s/m.
        damping_across_n_s_per_m: f64,
        /// Damper along it, N·s/m.
        damping_along_n_s_per_m: f64,
    },
}

/// A law on any path: what the rig runs, with its guard.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BuiltIn {
    /// Which law.
    pub law: Kind,
    /// Boundary of the velocity field (§6.1.1), m.
    pub boundary_m: f64,
    /// On which side of the path an obstacle lies, if it bounds one (§7.3).
    pub obstacle: Option<Solid>,
}

impl BuiltIn {
    /// A row of table 6.1, its gains read as N·s/cm (erratum `gain-unit`).
    pub fn of(method: Method) -> BuiltIn {
        let law = match method.setting() {
            Setting::Nothing => Kind::Uncontrolled,
            Setting::GapCm(gap_cm) => Kind::Sdof {
                gap_m: gap_cm * M_PER_CM,
            },
            Setting::GainPrinted(gain) => Kind::Proportional {
                gain_n_s_per_m: gain * GainUnit::PerCentimetre.to_si(),
            },
        };
        BuiltIn {
            law,
            boundary_m: BLEND_BOUNDARY_M,
            obstacle: None,
        }
    }

    /// What this controller promises, as far as its kind says.
    pub fn declared(&self) -> Declared {
        let claim = Claim {
            law: *self,
            every: EVERY,
        };
        let selective = Declared {
            most_brakes: Some(1),
            locks: Some(true),
            boundary_m: Some(self.boundary_m),
            within_force: true,
            solid: self.obstacle,
            reference: Some(claim),
            ..Declared::default()
        };
        let without_lock = |most: u8| Declared {
            most_brakes: Some(most),
            locks: Some(false),
            solid: self.obstacle,
            reference: Some(claim),
            ..Declared::default()
        };
        match self.law {
            Kind::Uncontrolled => without_lock(0),
            Kind::Sdof { gap_m } => Declared {
                gap_m: Some(gap_m),
                choice: Some(Choice::QuarterTurn),
                ..selective
            },
            Kind::Proportional { .. } => Declared {
                choice: Some(Choice::Influence),
                ..selective
            },
            Kind::Optimal { .. } => Declared {
                within_force: true,
                ..without_lock(1)
            },
            Kind::VelocityRatio { .. } | Kind::Impedance { .. } => without_lock(2),
        }
    }

    /// A controller that has seen nothing.
    ///
    /// # Errors
    /// [`Failure::Refused`]: a parameter, the path or a setting is outside its range.
    pub fn controller(
        &self,
        settings: &Settings,
        task: &Task,
    ) -> Result<Box<dyn Controller>, Failure> {
        let refused = |what: &str| Failure::Refused(format!("{what} is outside its range"));
        let law = self
            .law(settings, task)
            .ok_or_else(|| refused("a parameter of the law or a point of the path"))?;
        let tick = Tick::new(settings, law).ok_or_else(|| refused("a setting of the rig"))?;
        Ok(Box::new(tick))
    }

    fn law(&self, settings: &Settings, task: &Task) -> Option<AnyLaw<f64, Remembered>> {
        let actuation = Actuation::thesis(settings.layout);
        let path = Way::new(task)?.path;
        self.on(actuation, path, &settings.arms, settings.layout)
    }

    /// The rig's law on a path, by brakes, with the bodies of these arms and this layout; `None` for parameters that it does not take.
    pub fn on<R: Real, P: Path<R> + Clone>(
        &self,
        actuation: Actuation<R>,
        path: P,
        arms: &Arms,
        layout: Layout,
    ) -> Option<AnyLaw<R, P>> {
        let boundary = path.clone();
        let boundary_m = self.boundary_m;
        let inner = match self.law {
            Kind::Uncontrolled => PathLaw::Uncontrolled(Uncontrolled),
            Kind::Sdof { gap_m } => PathLaw::Sdof(Sdof::new(actuation, path, boundary_m, gap_m)?),
            Kind::Proportional { gain_n_s_per_m } => PathLaw::Proportional(Proportional::new(
                actuation,
                path,
                boundary_m,
                gain_n_s_per_m,
            )?),
            Kind::VelocityRatio { gain_nm_s_per_rad } => PathLaw::VelocityRatio(
                VelocityRatio::new(actuation, path, boundary_m, gain_nm_s_per_rad)?,
            ),
            Kind::Optimal {
                weight_angle,
                weight_energy,
                horizon_s,
            } => {
                let weights = Weights {
                    angle: weight_angle,
                    energy: weight_energy,
                    horizon_s,
                };
                let bodies = Bodies::new(arms, &inertia(layout));
                PathLaw::Optimal(Optimal::new(actuation, path, boundary_m, weights, bodies)?)
            }
            Kind::Impedance {
                stiffness_n_per_m,
                damping_across_n_s_per_m,
                damping_along_n_s_per_m,
            } => {
                let elements = Virtual {
                    stiffness_n_per_m,
                    damping_across_n_s_per_m,
                    damping_along_n_s_per_m,
                };
                PathLaw::Impedance(Impedance::new(actuation, path, elements)?)
            }
        };
        Some(match self.obstacle {
            None => AnyLaw::Path(inner),
            Some(Solid::Left) => AnyLaw::Obstacle(Obstacle::new(boundary, Side::Left, inner)),
            Some(Solid::Right) => AnyLaw::Obstacle(Obstacle::new(boundary, Side::Right, inner)),
        })
    }
}

impl Source for BuiltIn {
    fn begin(&self, settings: &Settings, task: &Task) -> Result<Box<dyn Controller + '_>, Failure> {
        self.controller(settings, task)
    }
}
