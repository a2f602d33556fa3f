//! This file is the kinematics as the thesis prints it, by the law of cosines, to be read beside [`forward`](super::forward)
//! and [`inverse`](super::inverse), which hold where these do not.

mod forward;
mod inverse;

pub use forward::{Printed, forward, parallelogram};
pub use inverse::{inverse, inverse_of_shared_axis, lambda_2_and_4};

/// acos of the law of cosines: the angle between two sides of a triangle, opposite to the third, rad.
fn angle(side: f64, other_side: f64, opposite: f64) -> f64 {
    let cosine =
        (side * side + other_side * other_side - opposite * opposite) / (2.0 * side * other_side);
    libm::acos(cosine)
}
