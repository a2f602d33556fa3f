//! The motion of the linkage: thesis §5.2, §5.3.5 and appendix A, and the two independent forms it is checked with.

pub mod acceleration;
pub mod added_mass;
pub mod constraints;
pub mod coordinates;
pub mod friction;
pub mod limited;
pub mod lumped;
pub mod mass;
pub mod stick;
pub mod ten_coordinates;
pub mod two_coordinate;

use rigproof_spec::inertia::Inertia;

use crate::error::ModelError;

/// Checks that five bodies can move: every arm has a mass and an inertia, the tip has no negative mass.
///
/// # Errors
/// [`ModelError::Mass`]; [`ModelError::NotFinite`] for a centre of mass that is no number.
pub fn check_inertia(inertia: &Inertia) -> Result<(), ModelError> {
    let arms = [
        ("arm AE", "m_AE", "I_AE", inertia.ae),
        ("arm ED", "m_ED", "I_ED", inertia.ed),
        ("arm BC", "m_BC", "I_BC", inertia.bc),
        ("arm CD", "m_CD", "I_CD", inertia.cd),
    ];
    for (part, mass, moment, arm) in arms {
        check_positive(part, mass, arm.mass_kg, "kg")?;
        check_positive(part, moment, arm.inertia_kg_m2, "kg·m²")?;
        if !arm.centre_m.is_finite() {
            return Err(ModelError::NotFinite {
                quantity: "centre of mass of an arm",
                value: arm.centre_m,
                unit: "m",
            });
        }
    }
    if inertia.payload_kg == 0.0 {
        return Ok(());
    }
    check_positive("the tip", "m_D", inertia.payload_kg, "kg")
}

fn check_positive(
    part: &'static str,
    symbol: &'static str,
    value: f64,
    unit: &'static str,
) -> Result<(), ModelError> {
    if value > 0.0 && value.is_finite() {
        return Ok(());
    }
    Err(ModelError::Mass {
        part,
        symbol,
        value,
        unit,
    })
}
