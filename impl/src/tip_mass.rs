//! This file says how heavy the rig feels at its tip: (5.40) without angles.

use rigproof_spec::geometry::Arms;
use rigproof_spec::inertia::{ArmInertia, Inertia};

use crate::linkage::Linkage;
use crate::number::Real;
use crate::vector::Vector;

/// What resists when the rig is accelerated, with what is computed from it once.
///
/// A side turns its base arm at α and its outer arm at φ; twice its kinetic energy is J·α² + K·φ² + 2·m·c·(base·outer)·α·φ,
/// where c is the share of the outer arm at which its mass m lies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bodies<R> {
    sides: [Side<R>; 2],
    payload_kg: R,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Side<R> {
    /// J, kg·m².
    base_kg_m2: R,
    /// K, kg·m².
    outer_kg_m2: R,
    /// m·c, kg.
    coupling_kg: R,
}

impl<R: Real> Bodies<R> {
    /// The bodies of a rig with these arms.
    pub fn new(arms: &Arms, inertia: &Inertia) -> Bodies<R> {
        let about =
            |arm: &ArmInertia| arm.inertia_kg_m2 + arm.mass_kg * arm.centre_m * arm.centre_m;
        let side = |[base, outer]: [&ArmInertia; 2], [inner_m, outer_m]: [f64; 2]| Side {
            base_kg_m2: R::of(about(base) + outer.mass_kg * inner_m * inner_m),
            outer_kg_m2: R::of(about(outer)),
            coupling_kg: R::of(outer.mass_kg * outer.centre_m / outer_m),
        };
        Bodies {
            sides: [
                side([&inertia.ae, &inertia.ed], [arms.l_ae_m, arms.l_ed_m]),
                side([&inertia.bc, &inertia.cd], [arms.l_bc_m, arms.l_cd_m]),
            ],
            payload_kg: R::of(inertia.payload_kg),
        }
    }

    /// The mass that the tip feels: the kinetic energy is half of v·M·v.
    //= thesis (5.40)
    pub fn tip_mass(&self, linkage: &Linkage<R>, rows: &[Vector<R>; 4]) -> TipMass<R> {
        let [a, e, b, c] = *rows;
        let [left, right] = &self.sides;
        let mut mass = TipMass {
            xx: self.payload_kg,
            xy: R::zero(),
            yy: self.payload_kg,
        };
        left.add(&mut mass, [a, a + e], linkage.ae.dot(linkage.ed));
        right.add(&mut mass, [b, b + c], linkage.bc.dot(linkage.cd));
        mass
    }
}

impl<R: Real> Side<R> {
    /// Adds what a side weighs; `base` and `outer` are the turning rates of its arms by the tip's velocity, 1/m.
    fn add(&self, mass: &mut TipMass<R>, [base, outer]: [Vector<R>; 2], product_m2: R) {
        let coupling = self.coupling_kg * product_m2;
        let from_base = base * self.base_kg_m2 + outer * coupling;
        let from_outer = base * coupling + outer * self.outer_kg_m2;
        mass.xx = mass.xx + base.x * from_base.x + outer.x * from_outer.x;
        mass.xy = mass.xy + base.x * from_base.y + outer.x * from_outer.y;
        mass.yy = mass.yy + base.y * from_base.y + outer.y * from_outer.y;
    }
}

/// A symmetric 2×2 matrix, rows and columns x, y, kg.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TipMass<R> {
    /// First diagonal element.
    pub xx: R,
    /// Element beside the diagonal.
    pub xy: R,
    /// Second diagonal element.
    pub yy: R,
}

impl<R: Real> TipMass<R> {
    /// v·M·v.
    pub fn square(&self, v: Vector<R>) -> R {
        let twice = self.xy + self.xy;
        self.xx * v.x * v.x + twice * v.x * v.y + self.yy * v.y * v.y
    }

    /// Whether every force has an acceleration.
    pub fn is_definite(&self) -> bool {
        self.determinant() > R::zero()
    }

    fn determinant(&self) -> R {
        self.xx * self.yy - self.xy * self.xy
    }

    /// The acceleration under a force, m/s²; no number where the matrix is not definite.
    pub fn acceleration_m_s2(&self, force_n: Vector<R>) -> Vector<R> {
        let inverse = R::of(1.0) / self.determinant();
        Vector::new(
            self.yy * force_n.x - self.xy * force_n.y,
            self.xx * force_n.y - self.xy * force_n.x,
        ) * inverse
    }
}
