//! This file says how the linkage moves in θA and θB alone: the form without constraints, which checks the ten coordinates.

use nalgebra::{Matrix2, SMatrix, Vector2, Vector4};
use rigproof_spec::geometry::Arms;
use rigproof_spec::inertia::Inertia;

use crate::linkage::{Pose, point_a_m, point_b_m};

/// The motion at one pose and one pair of rates u = (θ̇A, θ̇B): M·u̇ + b = Tᵀ·F + Gᵀ·τ.
///
/// This is (5.40) with q = (θA, θB), where V is not zero. It shares nothing with the ten coordinates but the pose.
///
/// | symbol | here | unit | shape |
/// |---|---|---|---|
/// | M | [`mass`](Self::mass) | kg·m² | 2×2 |
/// | b | [`bias`](Self::bias): V of (5.40) | N·m | 2 |
/// | G | [`joints`](Self::joints): rates of the joints by u | 1 | 4×2, rows A, E, B, C |
/// | ġ·u | [`joints_bias`](Self::joints_bias): their accelerations at u̇ = 0 | rad/s² | 4 |
/// | T | [`tip`](Self::tip): velocity of the tip by u | m/rad | 2×2, rows x, y |
///
/// # Derivation
///
/// With a, b, c, d the vectors along arms AE, ED, BC, CD and ⊥ a quarter turn to the left, the closure ⊥a·θ̇A + ⊥b·φ̇₁ =
/// ⊥c·θ̇B + ⊥d·φ̇₂ gives the turning rates φ̇₁ of ED and φ̇₂ of CD, its derivative their accelerations. Each body adds its
/// share to M and b by the principle of virtual power.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TwoCoordinate {
    /// M, kg·m².
    pub mass: Matrix2<f64>,
    /// b, N·m.
    pub bias: Vector2<f64>,
    /// G, 4×2, rows A, E, B, C.
    pub joints: SMatrix<f64, 4, 2>,
    /// Accelerations of the joints at u̇ = 0, rad/s².
    pub joints_bias: Vector4<f64>,
    /// T, m/rad.
    pub tip: Matrix2<f64>,
    centres: [Matrix2<f64>; 2],
}

/// The two-coordinate form at a pose and the rates (θ̇A, θ̇B), rad/s. `pose` must belong to `arms` and not be singular.
//= thesis (5.40)
//= thesis (A.1)
pub fn two_coordinate(
    arms: &Arms,
    inertia: &Inertia,
    pose: &Pose,
    rates_rad_s: [f64; 2],
) -> TwoCoordinate {
    let u = Vector2::from(rates_rad_s);
    let (point_e, point_c) = (Vector2::from(pose.point_e_m), Vector2::from(pose.point_c_m));
    let tip_m = Vector2::from(pose.tip_m);
    let a = point_e - Vector2::from(point_a_m(arms));
    let b = tip_m - point_e;
    let c = point_c - Vector2::from(point_b_m(arms));
    let d = tip_m - point_c;
    let across = quarter_turn(&b).dot(&d);

    let (unit_a, unit_b) = (Vector2::new(1.0, 0.0), Vector2::new(0.0, 1.0));
    let phi_1 = (unit_b * quarter_turn(&c).dot(&d) - unit_a * quarter_turn(&a).dot(&d)) / across;
    let phi_2 = (unit_b * quarter_turn(&c).dot(&b) - unit_a * quarter_turn(&a).dot(&b)) / across;
    let (rate_a, rate_b) = (u.x, u.y);
    let (rate_1, rate_2) = (phi_1.dot(&u), phi_2.dot(&u));
    let inward = a * (rate_a * rate_a) + b * (rate_1 * rate_1)
        - c * (rate_b * rate_b)
        - d * (rate_2 * rate_2);
    let (bias_1, bias_2) = (inward.dot(&d) / across, inward.dot(&b) / across);

    let point = |base: &Vector2<f64>, base_row: &Vector2<f64>, reach: Vector2<f64>, row: &Vector2<f64>| {
        quarter_turn(base) * base_row.transpose() + quarter_turn(&reach) * row.transpose()
    };
    let point_bias = |base: &Vector2<f64>, base_rate: f64, reach: Vector2<f64>, rate: f64, bias: f64| {
        quarter_turn(&reach) * bias - base * (base_rate * base_rate) - reach * (rate * rate)
    };
    let to_ed = b * (inertia.ed.centre_m / arms.l_ed_m);
    let to_cd = d * (inertia.cd.centre_m / arms.l_cd_m);
    let centre_ed = point(&a, &unit_a, to_ed, &phi_1);
    let centre_cd = point(&c, &unit_b, to_cd, &phi_2);
    let tip = point(&a, &unit_a, b, &phi_1);
    let points = [
        (inertia.ed.mass_kg, centre_ed, point_bias(&a, rate_a, to_ed, rate_1, bias_1)),
        (inertia.cd.mass_kg, centre_cd, point_bias(&c, rate_b, to_cd, rate_2, bias_2)),
        (inertia.payload_kg, tip, point_bias(&a, rate_a, b, rate_1, bias_1)),
    ];
    let about_base = |arm: &rigproof_spec::inertia::ArmInertia| {
        arm.inertia_kg_m2 + arm.mass_kg * arm.centre_m * arm.centre_m
    };
    let turning = [
        (about_base(&inertia.ae), unit_a, 0.0),
        (about_base(&inertia.bc), unit_b, 0.0),
        (inertia.ed.inertia_kg_m2, phi_1, bias_1),
        (inertia.cd.inertia_kg_m2, phi_2, bias_2),
    ];
    let mut mass = Matrix2::zeros();
    let mut bias = Vector2::zeros();
    for (mass_kg, rows, point_bias) in points {
        mass += rows.transpose() * rows * mass_kg;
        bias += rows.transpose() * point_bias * mass_kg;
    }
    for (inertia_kg_m2, row, turn_bias) in turning {
        mass += row * row.transpose() * inertia_kg_m2;
        bias += row * (inertia_kg_m2 * turn_bias);
    }
    TwoCoordinate {
        mass,
        bias,
        joints: SMatrix::from_rows(&[
            unit_a.transpose(),
            (phi_1 - unit_a).transpose(),
            unit_b.transpose(),
            (phi_2 - unit_b).transpose(),
        ]),
        joints_bias: Vector4::new(0.0, bias_1, 0.0, bias_2),
        tip,
        centres: [centre_ed, centre_cd],
    }
}

impl TwoCoordinate {
    /// What drives the two coordinates when no brake resists: Tᵀ·F − b, N·m.
    pub fn drive(&self, tip_force_n: [f64; 2]) -> Vector2<f64> {
        self.tip.transpose() * Vector2::from(tip_force_n) - self.bias
    }

    /// The accelerations of θA and θB under a tip force, N, and joint torques, N·m in the order A, E, B, C.
    pub fn acceleration_rad_s2(&self, tip_force_n: [f64; 2], torques_nm: [f64; 4]) -> [f64; 2] {
        let load = self.drive(tip_force_n) + self.joints.transpose() * Vector4::from(torques_nm);
        solve(&self.mass, &load).into()
    }

    /// The rates of the joints A, E, B, C, rad/s.
    pub fn joint_rates_rad_s(&self, rates_rad_s: [f64; 2]) -> [f64; 4] {
        (self.joints * Vector2::from(rates_rad_s)).into()
    }

    /// The accelerations of the joints A, E, B, C that belong to accelerations of θA and θB, rad/s².
    pub fn joint_accelerations_rad_s2(&self, accelerations_rad_s2: [f64; 2]) -> [f64; 4] {
        (self.joints * Vector2::from(accelerations_rad_s2) + self.joints_bias).into()
    }

    /// The velocity of the tip, x and y, m/s.
    pub fn tip_velocity_m_s(&self, rates_rad_s: [f64; 2]) -> [f64; 2] {
        (self.tip * Vector2::from(rates_rad_s)).into()
    }

    /// The velocities of the centres of mass of arms ED and CD, m/s.
    pub fn centre_velocities_m_s(&self, rates_rad_s: [f64; 2]) -> [[f64; 2]; 2] {
        self.centres
            .map(|rows| (rows * Vector2::from(rates_rad_s)).into())
    }

    /// Kinetic energy ½·uᵀ·M·u, J.
    pub fn kinetic_energy_j(&self, rates_rad_s: [f64; 2]) -> f64 {
        let u = Vector2::from(rates_rad_s);
        0.5 * u.dot(&(self.mass * u))
    }
}

/// The solution of two equations with a positive definite matrix.
pub fn solve(matrix: &Matrix2<f64>, right: &Vector2<f64>) -> Vector2<f64> {
    let determinant = matrix.m11 * matrix.m22 - matrix.m12 * matrix.m21;
    Vector2::new(
        matrix.m22 * right.x - matrix.m12 * right.y,
        matrix.m11 * right.y - matrix.m21 * right.x,
    ) / determinant
}

fn quarter_turn(vector: &Vector2<f64>) -> Vector2<f64> {
    Vector2::new(-vector.y, vector.x)
}
