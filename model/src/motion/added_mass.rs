//! This file is masses that are added to a linkage's own, as a load at the tip or an error of the arms' inertias.

use rigproof_spec::inertia::{ArmInertia, Inertia};

const NO_ARM: ArmInertia = ArmInertia {
    mass_kg: 0.0,
    inertia_kg_m2: 0.0,
    centre_m: 0.0,
};

/// A mass at the tip, kg, and nothing else.
pub const fn at_tip(payload_kg: f64) -> Inertia {
    Inertia {
        ae: NO_ARM,
        ed: NO_ARM,
        bc: NO_ARM,
        cd: NO_ARM,
        payload_kg,
    }
}

/// Masses that have some moments of inertia about the first joints of the arms AE, BC, ED, CD, kg·m², and a mass at the tip,
/// kg. A carried arm grows as a whole, its centre of mass stays.
pub fn in_all(nominal: &Inertia, [ae, bc, ed, cd, tip_kg]: [f64; 5]) -> Inertia {
    let turning = |inertia_kg_m2| ArmInertia {
        inertia_kg_m2,
        ..NO_ARM
    };
    let carried = |arm: &ArmInertia, added: f64| {
        let about_joint = arm.inertia_kg_m2 + arm.mass_kg * arm.centre_m * arm.centre_m;
        ArmInertia {
            mass_kg: arm.mass_kg * added / about_joint,
            inertia_kg_m2: arm.inertia_kg_m2 * added / about_joint,
            centre_m: arm.centre_m,
        }
    };
    Inertia {
        ae: turning(ae),
        bc: turning(bc),
        ed: carried(&nominal.ed, ed),
        cd: carried(&nominal.cd, cd),
        payload_kg: tip_kg,
    }
}

/// A share of all masses and moments of inertia.
pub fn share(nominal: &Inertia, fraction: f64) -> Inertia {
    let arm = |own: &ArmInertia| ArmInertia {
        mass_kg: own.mass_kg * fraction,
        inertia_kg_m2: own.inertia_kg_m2 * fraction,
        centre_m: own.centre_m,
    };
    Inertia {
        ae: arm(&nominal.ae),
        ed: arm(&nominal.ed),
        bc: arm(&nominal.bc),
        cd: arm(&nominal.cd),
        payload_kg: nominal.payload_kg * fraction,
    }
}

/// Masses, kg, and moments of inertia, kg·m², with what is added to them; centres of mass stay.
pub fn sum(own: &Inertia, more: &Inertia) -> Inertia {
    let arm = |own: &ArmInertia, more: &ArmInertia| ArmInertia {
        mass_kg: own.mass_kg + more.mass_kg,
        inertia_kg_m2: own.inertia_kg_m2 + more.inertia_kg_m2,
        centre_m: own.centre_m,
    };
    Inertia {
        ae: arm(&own.ae, &more.ae),
        ed: arm(&own.ed, &more.ed),
        bc: arm(&own.bc, &more.bc),
        cd: arm(&own.cd, &more.cd),
        payload_kg: own.payload_kg + more.payload_kg,
    }
}
