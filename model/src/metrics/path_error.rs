//! This file says how far a run strayed from its path: (6.14) to (6.16a).

use super::{enough, finite};
use crate::control::SHORTEST_PIECE_M;
use crate::control::path::Path;
use crate::error::ModelError;

/// Average path error, m (6.14): the distance from the path, averaged over the length of the way.
///
/// ```text
/// e_avg = (1/L_p)·Σ_{k=2}^{N−1} ε_k·L_k
/// ```
///
/// | symbol | here | unit |
/// |---|---|---|
/// | x_k, y_k | `tips_m`, N samples | m |
/// | ε_k | distance of sample k from `path` | m |
/// | L_k | [`step_lengths`] | m |
/// | L_p | [`path_length`] | m |
///
/// # Errors
/// [`ModelError::TooFew`] for less than three samples; [`ModelError::NotFinite`]; [`ModelError::PathPiece`] when the tip
/// never moved, so that there is no length to average over.
//= thesis (6.14)
pub fn path_error(path: &impl Path, tips_m: &[[f64; 2]]) -> Result<f64, ModelError> {
    enough(tips_m.len(), 3)?;
    finite("a tip position", "m", tips_m)?;
    let lengths_m = step_lengths(tips_m);
    let length_m = path_length(tips_m);
    if length_m < SHORTEST_PIECE_M {
        return Err(ModelError::PathPiece {
            piece: "way of the tip",
            length_m,
            least_m: SHORTEST_PIECE_M,
        });
    }
    let weighted_m2: f64 = tips_m
        .iter()
        .skip(1)
        .zip(&lengths_m)
        .map(|(tip_m, length_m)| path.nearest(*tip_m).distance_m() * length_m)
        .sum();
    Ok(weighted_m2 / length_m)
}

/// Way travelled around each sample but the first and the last, m (6.15).
///
/// ```text
/// L_k = ½·√((x_{k+1} − x_{k−1})² + (y_{k+1} − y_{k−1})²)
/// ```
//= thesis (6.15)
pub fn step_lengths(tips_m: &[[f64; 2]]) -> Vec<f64> {
    tips_m
        .iter()
        .zip(tips_m.iter().skip(2))
        .map(|([x_before, y_before], [x_after, y_after])| {
            0.5 * libm::hypot(x_after - x_before, y_after - y_before)
        })
        .collect()
}

/// Length of the way, m (6.16, the first of that number).
///
/// ```text
/// L_p = Σ_{k=2}^{N−1} L_k
/// ```
//= thesis (6.16a)
pub fn path_length(tips_m: &[[f64; 2]]) -> f64 {
    step_lengths(tips_m).iter().sum()
}
