//! This file says how much a brake can resist with.

use super::Margin;
use crate::joint::Joint;
use crate::tables::torque_gain_fit;

/// Whether the torque's magnitude is one the brake can reach: at most the torque at 1 A. The margin is N·m.
///
/// Any magnitude below is possible, because a brake at rest carries whatever load is put on it up to its yield.
///
/// Source: §5.3.4 and table 3.2.
pub fn torque_limit(joint: Joint, torque_nm: f64) -> Margin {
    Margin(torque_gain_fit(joint).greatest_nm() - torque_nm.abs())
}

/// Whether the yield torque lies between the off-state torque and the torque at 1 A. The margin to the nearer end
/// is N·m.
///
/// Source: §5.3.4, "yield torque is always positive and must lie between the off-state torque and the torque at
/// maximum current (1 A)"; values from table 3.2.
pub fn yield_limit(joint: Joint, yield_nm: f64) -> Margin {
    let fit = torque_gain_fit(joint);
    Margin(yield_nm - fit.off_state_nm()).and(Margin(fit.greatest_nm() - yield_nm))
}

#[cfg(test)]
mod tests {
    use super::*;

    // Torque at 1 A by hand from table 3.2: -3.68 + 12.05 - 0.84, and so on.
    const GREATEST_NM: [(Joint, f64); 4] = [
        (Joint::A, 7.53),
        (Joint::E, 5.94),
        (Joint::B, 6.13),
        (Joint::C, 5.88),
    ];

    #[test]
    fn the_torque_at_one_ampere_bounds_both_signs() {
        for (joint, greatest_nm) in GREATEST_NM {
            for sign in [-1.0, 1.0] {
                assert!(torque_limit(joint, sign * (greatest_nm - 1e-3)).holds());
                assert!(!torque_limit(joint, sign * (greatest_nm + 1e-3)).holds());
            }
            assert!(!torque_limit(joint, f64::NAN).holds());
        }
    }

    #[test]
    fn the_yield_lies_between_off_state_and_one_ampere() {
        for (joint, greatest_nm) in GREATEST_NM {
            assert!(yield_limit(joint, greatest_nm - 1e-3).holds());
            assert!(!yield_limit(joint, greatest_nm + 1e-3).holds());
            assert!(!yield_limit(joint, 0.203).holds());
            assert!(!yield_limit(joint, -1.37).holds());
            assert!(!yield_limit(joint, f64::NAN).holds());
        }
        assert!(yield_limit(Joint::E, 0.213).holds());
        assert!(!yield_limit(Joint::C, 0.268).holds());
    }
}
