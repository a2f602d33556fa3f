//! This file is the ten numbers that a rigid body's weight and inertia come to, about the origin of a frame.

use nalgebra::{Matrix3, Vector3};

/// How many inertial numbers a link has.
pub const INERTIAL: usize = 10;

/// What the numbers are called, in their order.
pub const PARAMETER_NAMES: [&str; INERTIAL] = [
    "m", "mx", "my", "mz", "ixx", "ixy", "ixz", "iyy", "iyz", "izz",
];

/// Mass, first moments and second moments about the origin of a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inertial {
    /// Mass, kg.
    pub mass: f64,
    /// Mass times its centre, kg·m.
    pub first: Vector3<f64>,
    /// Tensor of inertia about the origin, kg·m².
    pub second: Matrix3<f64>,
}

/// The matrix with which a vector is multiplied crosswise.
pub(super) fn cross(v: &Vector3<f64>) -> Matrix3<f64> {
    Matrix3::new(0.0, -v.z, v.y, v.z, 0.0, -v.x, -v.y, v.x, 0.0)
}

impl Inertial {
    /// Share of the greatest moment of inertia that the rounding of a description may take.
    pub(super) const ROUNDING: f64 = 1e-3;

    /// No mass.
    pub fn none() -> Inertial {
        Inertial {
            mass: 0.0,
            first: Vector3::zeros(),
            second: Matrix3::zeros(),
        }
    }

    /// From the mass, its centre, and the tensor about that centre, both in the axes of the frame.
    pub fn about_centre(mass: f64, centre: Vector3<f64>, tensor: Matrix3<f64>) -> Inertial {
        let arm = cross(&centre);
        Inertial {
            mass,
            first: mass * centre,
            second: tensor - mass * arm * arm,
        }
    }

    /// The centre of mass, m; the origin where there is no mass.
    pub fn centre(&self) -> Vector3<f64> {
        match self.mass == 0.0 {
            true => Vector3::zeros(),
            false => self.first / self.mass,
        }
    }

    /// The tensor about the centre of mass; about the origin where there is no mass.
    pub fn central(&self) -> Matrix3<f64> {
        let arm = cross(&self.centre());
        self.second + self.mass * arm * arm
    }

    /// The ten numbers: `m, mx, my, mz, ixx, ixy, ixz, iyy, iyz, izz`.
    pub fn numbers(&self) -> [f64; INERTIAL] {
        let (h, i) = (self.first, self.second);
        [
            self.mass, h.x, h.y, h.z, i.m11, i.m12, i.m13, i.m22, i.m23, i.m33,
        ]
    }

    /// From the ten numbers; those that are missing are 0.
    pub fn of(numbers: &[f64]) -> Inertial {
        let n = |k: usize| numbers.get(k).copied().unwrap_or(0.0);
        Inertial {
            mass: n(0),
            first: Vector3::new(n(1), n(2), n(3)),
            second: Matrix3::new(n(4), n(5), n(6), n(5), n(7), n(8), n(6), n(8), n(9)),
        }
    }

    /// The same body seen from a frame in which its own frame lies turned and moved so.
    pub fn seen_from(&self, rotation: &Matrix3<f64>, origin: &Vector3<f64>) -> Inertial {
        let turned = rotation * self.first;
        let second = rotation * self.second * rotation.transpose();
        let (arm, own) = (cross(origin), cross(&turned));
        Inertial {
            mass: self.mass,
            first: turned + self.mass * origin,
            second: second - arm * own - own * arm - self.mass * arm * arm,
        }
    }

    /// Two bodies fixed to each other.
    pub fn with(&self, other: &Inertial) -> Inertial {
        Inertial {
            mass: self.mass + other.mass,
            first: self.first + other.first,
            second: self.second + other.second,
        }
    }

    /// Why no body has these numbers; `None` where one does. `slack` is the share of the greatest moment that rounding of a description may take.
    pub fn impossible(&self, slack: f64) -> Option<String> {
        if self.mass < 0.0 {
            return Some(format!("a mass of {} kg is negative", self.mass));
        }
        let moments = self.central().symmetric_eigen().eigenvalues;
        let (greatest, sum) = (moments.max(), moments.sum());
        let least = moments.min();
        if least < -slack * greatest.abs() {
            return Some(format!(
                "a moment of inertia of {least:.3e} kg·m² is negative"
            ));
        }
        // Of three principal moments none is greater than the two others together.
        let others = sum - greatest;
        (greatest > others + slack * greatest).then(|| {
            format!(
                "its principal moments of inertia break the triangle inequality: {greatest:.4} kg·m² is more than the two others together, {others:.4}"
            )
        })
    }
}
