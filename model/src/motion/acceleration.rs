//! This file says how the linkage accelerates under tip force and joint torques: (5.40), (5.41), (5.52), (5.66).

use nalgebra::{SMatrix, SVector};
use rigproof_spec::geometry::Arms;
use rigproof_spec::inertia::Inertia;

use super::constraints::{constraint_matrix, constraint_matrix_rate};
use super::coordinates::{CONSTRAINTS, COORDINATES, Eight, Ten};
use super::mass::mass_matrix;
use crate::error::ModelError;

/// Unknowns of (5.66): 10 accelerations and 8 multipliers.
const UNKNOWNS: usize = COORDINATES + CONSTRAINTS;

/// What (5.66) yields.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Acceleration {
    /// q̈ in the order of (5.42), m/s² and rad/s².
    pub q_ddot: Ten,
    /// The Lagrange multipliers λ, N: the forces that hold the eight constraints.
    pub lambda: Eight,
}

/// The left side of (5.66), 18×18, and the part Ȧ·q̇ of its right side.
#[derive(Clone, Copy, Debug)]
pub struct Equations {
    matrix: SMatrix<f64, UNKNOWNS, UNKNOWNS>,
    a_dot_q_dot: Eight,
}

/// The equations of motion in ten coordinates at q, q̇ (5.66), (A.4).
///
/// ```text
/// [  M  −Aᵀ ] [ q̈ ]   [  Q  ]
/// [ −A   0  ] [ λ ] = [ Ȧ·q̇ ]
/// ```
///
/// | symbol | here | unit |
/// |---|---|---|
/// | q, q̇ | `q`, `q_dot`, 10 each as (5.42) | m, rad and per s |
/// | M, A, Ȧ | [`mass_matrix`], [`constraint_matrix`], [`constraint_matrix_rate`] | – |
///
/// The upper row is (5.52), M·q̈ = Q + Aᵀ·λ: Lagrange's equation (5.41) where M does not depend on q and nothing stores
/// potential energy, so that V and G of (5.40) are zero. The lower row is the second derivative of the constraints.
///
/// # Differs from the thesis
///
/// (5.41) and (A.2) print `λ_j` for the multiplier of constraint i (erratum `multiplier-index`).
//= thesis (5.41)
//= thesis (A.2)
//= thesis (5.52)
//= thesis (5.66)
//= thesis (A.3)
//= thesis (A.4)
pub fn equations(arms: &Arms, inertia: &Inertia, q: &Ten, q_dot: &Ten) -> Equations {
    let a = constraint_matrix(arms, inertia, q);
    let a_dot = constraint_matrix_rate(arms, inertia, q, q_dot);
    let mut matrix = SMatrix::<f64, UNKNOWNS, UNKNOWNS>::zeros();
    matrix
        .fixed_view_mut::<COORDINATES, COORDINATES>(0, 0)
        .copy_from(&mass_matrix(inertia));
    matrix
        .fixed_view_mut::<COORDINATES, CONSTRAINTS>(0, COORDINATES)
        .copy_from(&-a.transpose());
    matrix
        .fixed_view_mut::<CONSTRAINTS, COORDINATES>(COORDINATES, 0)
        .copy_from(&-a);
    Equations {
        matrix,
        a_dot_q_dot: a_dot * q_dot,
    }
}

impl Equations {
    /// The acceleration under generalised forces Q, 10 as (5.43), N and N·m.
    ///
    /// # Errors
    /// [`ModelError::NoAcceleration`]: the matrix has no inverse, at a singularity of the linkage.
    pub fn acceleration(&self, forces: &Ten) -> Result<Acceleration, ModelError> {
        let mut right = SVector::<f64, UNKNOWNS>::zeros();
        right.fixed_rows_mut::<COORDINATES>(0).copy_from(forces);
        right
            .fixed_rows_mut::<CONSTRAINTS>(COORDINATES)
            .copy_from(&self.a_dot_q_dot);
        let solution = self
            .matrix
            .lu()
            .solve(&right)
            .ok_or(ModelError::NoAcceleration)?;
        Ok(Acceleration {
            q_ddot: solution.fixed_rows::<COORDINATES>(0).into_owned(),
            lambda: solution.fixed_rows::<CONSTRAINTS>(COORDINATES).into_owned(),
        })
    }

    /// The inverse of the matrix, 18×18: what (5.68) multiplies the right side with.
    ///
    /// # Errors
    /// [`ModelError::NoAcceleration`]: it has none.
    //= thesis (5.68)
    pub fn inverse(&self) -> Result<SMatrix<f64, UNKNOWNS, UNKNOWNS>, ModelError> {
        self.matrix.try_inverse().ok_or(ModelError::NoAcceleration)
    }
}
