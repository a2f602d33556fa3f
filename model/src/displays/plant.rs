//! This file moves a display from step to step: a body of two coordinates against its rows, solved together in every step.
#![expect(
    clippy::indexing_slicing,
    reason = "indices run over at most four rows"
)]

use nalgebra::{Matrix2, SMatrix, Vector2, Vector4};
use rigproof_spec::geometry::{Arms, arms};
use rigproof_spec::inertia::{Inertia, inertia};
use rigproof_spec::layout::Layout;

use crate::error::ModelError;
use crate::linkage::{forward, inverse};
use crate::motion::friction::{DryBrakes, dry_motion};
use crate::motion::limited::{LimitedRates, limited_motion};
use crate::motion::two_coordinate::two_coordinate;

/// What moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Body {
    /// A five-bar linkage in θA and θB.
    FiveBar {
        /// Its lengths.
        arms: Arms,
        /// Its masses.
        inertia: Inertia,
    },
    /// A mass on a plane that does not turn, in x and y of its handle, m.
    Plate {
        /// Its mass, kg.
        mass_kg: f64,
    },
}

/// Everything that rows are written in, at one place and motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// The tip, x and y, m.
    pub tip_m: [f64; 2],
    /// T: the tip's velocity by the two coordinates' rates.
    pub tip: Matrix2<f64>,
    /// G, 4×2, rows A, E, B, C; zero where there are no joints.
    pub joints: SMatrix<f64, 4, 2>,
    mass: Matrix2<f64>,
    bias: Vector2<f64>,
}

/// What resists: rows of the friction problem, each with its own bounds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Rows {
    /// Dry rows: up to four rates, each opposed by its bound at most.
    Dry(DryBrakes),
    /// Two rates between limits.
    Limited(LimitedRates),
}

/// What the rows did in the last step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Resisted {
    /// The rates of the rows after it; exactly zero where a dry row holds.
    pub rates: [f64; 4],
    /// What each row exerted on its rate, as a mean over the step.
    pub loads: [f64; 4],
    /// Which dry rows held.
    pub held: [bool; 4],
}

/// A body in motion, with what it was given and what it lost.
#[derive(Clone, Debug, PartialEq)]
pub struct Plant {
    body: Body,
    at: [f64; 2],
    rates: [f64; 2],
    place: Place,
    resisted: Resisted,
    work_j: f64,
    dissipated_j: f64,
}

impl Body {
    /// The arms and masses of a layout (tables 4.1 and 5.1).
    pub const fn layout(layout: Layout) -> Body {
        Body::FiveBar {
            arms: arms(layout),
            inertia: inertia(layout),
        }
    }

    fn place(&self, at: [f64; 2], rates: [f64; 2]) -> Result<Place, ModelError> {
        match self {
            Body::FiveBar { arms, inertia } => {
                let pose = forward::pose(arms, at[0], at[1])?;
                let form = two_coordinate(arms, inertia, &pose, rates);
                Ok(Place {
                    tip_m: pose.tip_m,
                    tip: form.tip,
                    joints: form.joints,
                    mass: form.mass,
                    bias: form.bias,
                })
            }
            Body::Plate { mass_kg } => Ok(Place {
                tip_m: at,
                tip: Matrix2::identity(),
                joints: SMatrix::zeros(),
                mass: Matrix2::identity() * *mass_kg,
                bias: Vector2::zeros(),
            }),
        }
    }

    /// The two coordinates with the tip at a point.
    fn coordinates(&self, tip_m: [f64; 2]) -> Result<[f64; 2], ModelError> {
        match self {
            Body::FiveBar { arms, .. } => {
                let pose = inverse::pose(arms, tip_m)?;
                Ok([pose.theta_a_rad, pose.theta_b_rad])
            }
            Body::Plate { .. } => Ok(tip_m),
        }
    }
}

impl Plant {
    /// A body with its tip at a point, m, whose coordinates have rates.
    ///
    /// # Errors
    /// Those of [`inverse::pose`].
    pub fn new(body: Body, tip_m: [f64; 2], rates: [f64; 2]) -> Result<Plant, ModelError> {
        let at = body.coordinates(tip_m)?;
        Ok(Plant {
            place: body.place(at, rates)?,
            resisted: Resisted::default(),
            body,
            at,
            rates,
            work_j: 0.0,
            dissipated_j: 0.0,
        })
    }

    /// One step under a force on the tip, N, against rows: the rates after it and the rows' impulses solve the friction
    /// together, as the rig's own implicit step does (decision 0030).
    ///
    /// # Errors
    /// Those of [`forward::pose`], where a linkage is driven out of its assembly. The plant then is as it was before.
    pub fn advance(
        &mut self,
        tip_force_n: [f64; 2],
        rows: &Rows,
        step_s: f64,
    ) -> Result<(), ModelError> {
        let place = &self.place;
        let force = place.tip.transpose() * Vector2::from(tip_force_n) - place.bias;
        let momentum = place.mass * Vector2::from(self.rates);
        let drive = momentum + force * step_s;
        let (rates, resisted) = rows.resist(&place.mass, &drive, step_s);
        let at = [0, 1].map(|i| self.at[i] + rates[i] * step_s);
        let next = self.body.place(at, rates)?;
        let velocity = place.tip * Vector2::from(rates);
        let work_j = Vector2::from(tip_force_n).dot(&velocity) * step_s;
        let before_j = self.kinetic_energy_j();
        (self.at, self.rates, self.place) = (at, rates, next);
        self.resisted = resisted;
        self.work_j += work_j;
        self.dissipated_j += before_j + work_j - self.kinetic_energy_j();
        Ok(())
    }

    /// Where the body is.
    pub fn place(&self) -> &Place {
        &self.place
    }

    /// What moves.
    pub fn body(&self) -> &Body {
        &self.body
    }

    /// The rates of the two coordinates.
    pub fn rates(&self) -> [f64; 2] {
        self.rates
    }

    /// The tip's velocity, x and y, m/s.
    pub fn tip_velocity_m_s(&self) -> [f64; 2] {
        (self.place.tip * Vector2::from(self.rates)).into()
    }

    /// What the rows did in the last step.
    pub fn resisted(&self) -> &Resisted {
        &self.resisted
    }

    /// Kinetic energy, J.
    pub fn kinetic_energy_j(&self) -> f64 {
        let u = Vector2::from(self.rates);
        0.5 * u.dot(&(self.place.mass * u))
    }

    /// Work of the tip's force since the beginning, J.
    pub fn work_j(&self) -> f64 {
        self.work_j
    }

    /// What is neither stored nor given back, J.
    pub fn dissipated_j(&self) -> f64 {
        self.dissipated_j
    }
}

impl Rows {
    /// Rows that do nothing.
    pub fn none() -> Rows {
        Rows::Dry(DryBrakes {
            rows: SMatrix::zeros(),
            bounds_nm: [0.0; 4],
        })
    }

    /// The rates after a step in which a drive, an impulse, meets these rows.
    fn resist(
        &self,
        mass: &Matrix2<f64>,
        drive: &Vector2<f64>,
        step_s: f64,
    ) -> ([f64; 2], Resisted) {
        match self {
            Rows::Dry(dry) => {
                let impulses = DryBrakes {
                    rows: dry.rows,
                    bounds_nm: dry.bounds_nm.map(|bound| bound * step_s),
                };
                let done = dry_motion(mass, drive, &impulses);
                let rates: Vector4<f64> = dry.rows * Vector2::from(done.motion);
                let held = done.held;
                let resisted = Resisted {
                    rates: [0, 1, 2, 3].map(|i| if held[i] { 0.0 } else { rates[i] }),
                    loads: done.torques_nm.map(|impulse| impulse / step_s),
                    held,
                };
                (done.motion, resisted)
            }
            Rows::Limited(clutches) => {
                let done = limited_motion(mass, drive, clutches);
                let [rate_1, rate_2] = done.rates;
                let [load_1, load_2] = done.loads.map(|impulse| impulse / step_s);
                let resisted = Resisted {
                    rates: [rate_1, rate_2, 0.0, 0.0],
                    loads: [load_1, load_2, 0.0, 0.0],
                    held: [false; 4],
                };
                (done.motion, resisted)
            }
        }
    }
}
