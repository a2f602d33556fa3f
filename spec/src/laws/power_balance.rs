//! This file says that what goes into the rig is stored or braked away.

use super::Margin;

/// Whether power supplied is power stored plus power dissipated, to a slack; powers, W, or energies over the same time, J.
///
/// `slack` is what the step of the integrator and rounding may lose; the margin is what is left of it.
///
/// Source: §5.3.5: the brakes only take energy out; the operator's force is the only supply.
pub fn power_balance(supplied: f64, stored: f64, dissipated: f64, slack: f64) -> Margin {
    Margin(slack - (supplied - stored - dissipated).abs())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn energy_from_nowhere_breaks_the_law() {
        assert!(power_balance(2.71, 1.13, 1.58, 1e-12).holds());
        assert!(!power_balance(2.71, 1.13, 1.59, 1e-3).holds());
        assert!(!power_balance(2.71, 1.14, 1.56, 1e-3).holds());
        assert!(power_balance(2.71, 1.13, 1.59, 0.011).holds());
        assert!(!power_balance(f64::NAN, 1.13, 1.58, 1e-3).holds());
        assert!(!power_balance(2.71, f64::INFINITY, 1.58, 1e-3).holds());
    }
}
