//! This file says what the fluid models of §2.1.2 predict: Bingham's stress and Rosensweig's yield stress.

/// Vacuum permeability μ0, N/A² (CODATA 2018; the text gives no value).
const MU_0: f64 = 1.256_637_062_12e-6;

/// Shear stress of a Bingham plastic, Pa (2.1).
///
/// ```text
/// τ = η·γ̇ + τ_y(H)·sign(γ̇)
/// ```
///
/// | symbol | here | unit | range |
/// |---|---|---|---|
/// | η | `viscosity_pa_s` | Pa·s | ≥ 0 |
/// | γ̇ | `shear_rate_per_s` | 1/s | – |
/// | τ_y | `yield_stress_pa`: [`laminae_yield_stress`] | Pa | ≥ 0 |
///
/// Zero at rest, where any stress up to τ_y may act.
///
/// ```
/// use rigproof_model::brake::bingham_stress;
/// // Table 2.1: a yield stress of 50 to 100 kPa.
/// assert_eq!(bingham_stress(0.28, -130.0, 73_000.0), -0.28 * 130.0 - 73_000.0);
/// ```
//= thesis (2.1)
pub fn bingham_stress(viscosity_pa_s: f64, shear_rate_per_s: f64, yield_stress_pa: f64) -> f64 {
    let sign = if shear_rate_per_s == 0.0 {
        0.0
    } else {
        shear_rate_per_s.signum()
    };
    viscosity_pa_s * shear_rate_per_s + yield_stress_pa * sign
}

/// Yield stress of Rosensweig's laminae, Pa (2.2).
///
/// ```text
/// τ_y = (μ0·H² / 4) · [ φ·(1−φ)·χ_m² / (1 + (1−φ)·χ_m) ]
/// ```
///
/// | symbol | here | unit | range |
/// |---|---|---|---|
/// | H | `field_a_per_m` | A/m | – |
/// | φ | `iron_share` by volume | 1 | 0 to 1 |
/// | χ_m | `susceptibility` of a lamina | 1 | ≥ 0 |
///
/// # Differs from the thesis
///
/// Nothing here; but the thesis concludes that the torque grows with the square of the current, and its own brakes do
/// not (gap `laminae-square`).
//= thesis (2.2)
pub fn laminae_yield_stress(field_a_per_m: f64, iron_share: f64, susceptibility: f64) -> f64 {
    let rest = 1.0 - iron_share;
    let bracket =
        iron_share * rest * susceptibility * susceptibility / (1.0 + rest * susceptibility);
    MU_0 * field_a_per_m * field_a_per_m / 4.0 * bracket
}

#[cfg(test)]
mod tests {
    use super::*;

    //= thesis (2.1) test
    #[test]
    fn a_bingham_fluid_resists_by_hand() {
        // 0.31*87 + 61000 = 61026.97, and its mirror image.
        assert!((bingham_stress(0.31, 87.0, 61_000.0) - 61_026.97).abs() < 1e-9);
        assert!((bingham_stress(0.31, -87.0, 61_000.0) + 61_026.97).abs() < 1e-9);
        assert_eq!(bingham_stress(0.31, 0.0, 61_000.0), 0.0);
    }

    //= thesis (2.2) test
    #[test]
    fn laminae_yield_by_hand() {
        // φ = 0.32, χ = 4.5: bracket 0.32*0.68*20.25/(1 + 3.06) = 4.4064/4.06 = 1.085320197;
        // μ0/4 * (173e3)² = 3.1415926553e-7 * 2.9929e10 = 9402.4727; product 10204.69.
        let yield_pa = laminae_yield_stress(173e3, 0.32, 4.5);
        assert!((yield_pa - 10_204.69).abs() < 0.05, "{yield_pa}");
        assert_eq!(laminae_yield_stress(173e3, 1.0, 4.5), 0.0);
    }

    #[test]
    fn the_laminae_model_predicts_a_square_and_the_brakes_saturate() {
        use crate::brake::torque_gain;
        use rigproof_spec::joint::Joint;
        let ratio =
            laminae_yield_stress(0.94e5, 0.31, 3.7) / laminae_yield_stress(0.47e5, 0.31, 3.7);
        assert!((ratio - 4.0).abs() < 1e-12);
        // Twice the current gives a little over twice the torque, not four times.
        for joint in Joint::ALL {
            let ratio = torque_gain(joint, 0.94) / torque_gain(joint, 0.47);
            assert!((1.6..2.2).contains(&ratio), "{} {ratio}", joint.letter());
        }
    }
}
