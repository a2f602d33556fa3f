//! This file says how the linkage moves in θA and θB alone: the form without constraints, which checks the ten coordinates.

use nalgebra::{Matrix2, SMatrix, Vector2, Vector4};
use rigproof_spec::geometry::Arms;
use rigproof_spec::inertia::{ArmInertia, Inertia};

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
    let [left, right] = sides(arms, pose, Vector2::from(rates_rad_s));
    let centre_ed = left.point(inertia.ed.centre_m / arms.l_ed_m);
    let centre_cd = right.point(inertia.cd.centre_m / arms.l_cd_m);
    let tip = left.point(1.0);
    let mut mass = Matrix2::zeros();
    let mut bias = Vector2::zeros();
    for (mass_kg, point) in [
        (inertia.ed.mass_kg, centre_ed),
        (inertia.cd.mass_kg, centre_cd),
        (inertia.payload_kg, tip),
    ] {
        mass += point.rows.transpose() * point.rows * mass_kg;
        bias += point.rows.transpose() * point.bias * mass_kg;
    }
    for (inertia_kg_m2, arm) in [
        (about_joint(&inertia.ae), left.base),
        (about_joint(&inertia.bc), right.base),
        (inertia.ed.inertia_kg_m2, left.carried),
        (inertia.cd.inertia_kg_m2, right.carried),
    ] {
        mass += arm.row * arm.row.transpose() * inertia_kg_m2;
        bias += arm.row * (inertia_kg_m2 * arm.bias);
    }
    let row_e = left.carried.row - left.base.row;
    let row_c = right.carried.row - right.base.row;
    let rows = [left.base.row, row_e, right.base.row, row_c];
    TwoCoordinate {
        mass,
        bias,
        joints: SMatrix::from_rows(&rows.map(|row| row.transpose())),
        joints_bias: Vector4::new(0.0, left.carried.bias, 0.0, right.carried.bias),
        tip: tip.rows,
        centres: [centre_ed.rows, centre_cd.rows],
    }
}

/// How an arm turns: its rate is `row`·u, its acceleration `row`·u̇ + `bias`.
#[derive(Clone, Copy)]
struct Arm {
    vector: Vector2<f64>,
    row: Vector2<f64>,
    rate: f64,
    bias: f64,
}

/// How a point moves: its velocity is `rows`·u, its acceleration `rows`·u̇ + `bias`.
#[derive(Clone, Copy)]
struct Point {
    rows: Matrix2<f64>,
    bias: Vector2<f64>,
}

/// A base arm and the arm it carries to the tip.
struct Side {
    base: Arm,
    carried: Arm,
}

impl Side {
    /// The point at a share of the carried arm.
    fn point(&self, share: f64) -> Point {
        let Side { base, carried } = self;
        let reach = carried.vector * share;
        Point {
            rows: quarter_turn(&base.vector) * base.row.transpose()
                + quarter_turn(&reach) * carried.row.transpose(),
            bias: quarter_turn(&reach) * carried.bias
                - base.vector * (base.rate * base.rate)
                - reach * (carried.rate * carried.rate),
        }
    }
}

/// The sides A, E, D and B, C, D of the linkage.
fn sides(arms: &Arms, pose: &Pose, u: Vector2<f64>) -> [Side; 2] {
    let (point_e, point_c) = (Vector2::from(pose.point_e_m), Vector2::from(pose.point_c_m));
    let tip_m = Vector2::from(pose.tip_m);
    let a = point_e - Vector2::from(point_a_m(arms));
    let b = tip_m - point_e;
    let c = point_c - Vector2::from(point_b_m(arms));
    let d = tip_m - point_c;
    let across = quarter_turn(&b).dot(&d);
    // What the base arms would open between ED and CD if these did not turn, seen along v.
    let opening = |v: &Vector2<f64>| {
        let (of_a, of_b) = (-quarter_turn(&a).dot(v), quarter_turn(&c).dot(v));
        Vector2::new(of_a, of_b) / across
    };
    let (phi_1, phi_2) = (opening(&d), opening(&b));
    let (rate_1, rate_2) = (phi_1.dot(&u), phi_2.dot(&u));
    let inward = a * (u.x * u.x) + b * (rate_1 * rate_1) - c * (u.y * u.y) - d * (rate_2 * rate_2);
    let arm = |vector, row, rate, bias| Arm {
        vector,
        row,
        rate,
        bias,
    };
    [
        Side {
            base: arm(a, Vector2::x(), u.x, 0.0),
            carried: arm(b, phi_1, rate_1, inward.dot(&d) / across),
        },
        Side {
            base: arm(c, Vector2::y(), u.y, 0.0),
            carried: arm(d, phi_2, rate_2, inward.dot(&b) / across),
        },
    ]
}

/// The moment of inertia about an arm's own joint, kg·m².
fn about_joint(arm: &ArmInertia) -> f64 {
    arm.inertia_kg_m2 + arm.mass_kg * arm.centre_m * arm.centre_m
}

impl TwoCoordinate {
    /// What drives the two coordinates when no brake resists: Tᵀ·F − b, N·m.
    pub fn drive(&self, tip_force_n: [f64; 2]) -> Vector2<f64> {
        self.tip.transpose() * Vector2::from(tip_force_n) - self.bias
    }

    /// What the weight of arms and tip does to θA and θB, N·m, at their angles, rad, and a gravity in the plane, m/s².
    pub fn weight(
        &self,
        inertia: &Inertia,
        theta_rad: [f64; 2],
        gravity: [f64; 2],
    ) -> Vector2<f64> {
        let gravity = Vector2::from(gravity);
        // The centre of a base arm moves across the arm.
        let base = |arm: &ArmInertia, theta_rad: f64| {
            let (sine, cosine) = libm::sincos(theta_rad);
            arm.mass_kg * arm.centre_m * (cosine * gravity.y - sine * gravity.x)
        };
        let [theta_a, theta_b] = theta_rad;
        let [centre_ed, centre_cd] = &self.centres;
        Vector2::new(base(&inertia.ae, theta_a), base(&inertia.bc, theta_b))
            + centre_ed.transpose() * gravity * inertia.ed.mass_kg
            + centre_cd.transpose() * gravity * inertia.cd.mass_kg
            + self.tip.transpose() * gravity * inertia.payload_kg
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
