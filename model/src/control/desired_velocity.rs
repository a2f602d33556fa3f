//! This file says in which direction the tip should move: the velocity field of §6.1.1.

use core::f64::consts::FRAC_PI_2;

use nalgebra::Vector2;

use super::path::Nearest;

/// The desired direction at one point, and the two directions it is blended from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Desired {
    /// Direction of the desired velocity, of length one.
    pub direction: Vector2<f64>,
    /// Direction of the path, with the sign of the operator's force along it.
    pub along: Vector2<f64>,
    /// Direction towards the path; `None` on it.
    pub towards: Option<Vector2<f64>>,
}

impl Desired {
    /// The angle β of the desired velocity, rad.
    pub fn beta_rad(&self) -> f64 {
        libm::atan2(self.direction.y, self.direction.x)
    }

    /// The operator's force towards the path, N; zero on it.
    pub fn towards_path(&self, force_n: Vector2<f64>) -> f64 {
        self.towards.map_or(0.0, |towards| towards.dot(&force_n))
    }

    /// A vector's components along the desired direction and to its left: `v_βx` and `v_βy` (§6.3).
    pub fn components(&self, vector: Vector2<f64>) -> [f64; 2] {
        [self.direction.dot(&vector), self.direction.perp(&vector)]
    }
}

/// The desired velocity at a point (§6.1.1).
///
/// "Outside a specified boundary, the desired velocity always points toward the desired path. Within the boundary, the
/// direction is linearly blended to the direction of the path. The direction of the path and the blend is determined by
/// the direction of force input relative to the path."
///
/// | symbol | here | unit | range |
/// |---|---|---|---|
/// | distance from the path | [`Nearest::distance_m`] | m | 0 or more |
/// | boundary | `boundary_m` | m | above 0; 0.05 in the thesis |
/// | β | [`Desired::beta_rad`] | rad | −π to π |
///
/// The angle between path and desired velocity is 90° times the distance over the boundary. A force without a component
/// along the path counts as one along its tangent (gap `force-across-path`).
pub fn desired_velocity(nearest: &Nearest, force_n: Vector2<f64>, boundary_m: f64) -> Desired {
    let along = if nearest.tangent.dot(&force_n) < 0.0 {
        -nearest.tangent
    } else {
        nearest.tangent
    };
    let towards = nearest.towards();
    let direction = match towards {
        None => along,
        Some(towards) if nearest.distance_m() >= boundary_m => towards,
        Some(towards) => {
            let (sine, cosine) = libm::sincos(FRAC_PI_2 * nearest.distance_m() / boundary_m);
            along * cosine + towards * sine
        }
    };
    Desired {
        direction,
        along,
        towards,
    }
}
