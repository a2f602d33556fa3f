//! This file says which current buys a torque: the current gain block of §6.1.4.

use rigproof_spec::joint::Joint;
use rigproof_spec::tables::{GREATEST_CURRENT_A, torque_gain_fit};

/// Current at which the torque gain (3.3) changes from a line to a parabola, A.
const PIECES_MEET_A: f64 = 0.2;

/// The current that gives a torque, A: the inverse of the torque gain (3.3).
///
/// | symbol | here | unit | range |
/// |---|---|---|---|
/// | τ | `torque_nm` | N·m | any |
/// | I | result | A | 0 to 1 |
///
/// A torque up to the off-state torque needs no current; one above that of 1 A gets 1 A; one that is not a number gets
/// none. Of the two currents that give the same torque just below 0.2 A it is the smaller one (gap `gain-inverse-control`).
///
/// ```
/// use rigproof_model::control::current_for_torque;
/// use rigproof_spec::joint::Joint;
/// // Brake B at 0.73 A gives -2.14*0.73² + 8.76*0.73 - 0.49 = 4.764394 N·m.
/// assert!((current_for_torque(Joint::B, 4.764_394) - 0.73).abs() < 1e-12);
/// ```
pub fn current_for_torque(joint: Joint, torque_nm: f64) -> f64 {
    let fit = torque_gain_fit(joint);
    if torque_nm.is_nan() || torque_nm <= fit.off_state_nm() {
        return 0.0;
    }
    if torque_nm >= fit.greatest_nm() {
        return GREATEST_CURRENT_A;
    }
    let linear_a = (torque_nm - fit.k_2) / fit.k_1;
    if linear_a < PIECES_MEET_A {
        return linear_a;
    }
    let discriminant = fit.k_4 * fit.k_4 - 4.0 * fit.k_3 * (fit.k_5 - torque_nm);
    let root_a = (libm::sqrt(discriminant) - fit.k_4) / (2.0 * fit.k_3);
    root_a.clamp(PIECES_MEET_A, GREATEST_CURRENT_A)
}
