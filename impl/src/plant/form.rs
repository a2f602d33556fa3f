//! This file says how the linkage moves in θA and θB: M·v̇ + b = Tᵀ·F + Gᵀ·τ in closed form, without angles.

use rigproof_spec::geometry::Arms;
use rigproof_spec::inertia::{ArmInertia, Inertia};

use crate::linkage::Linkage;
use crate::number::Real;
use crate::vector::Vector;

/// What the masses come to, once for a rig; of each pair the side A, E, D comes first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bodies<R> {
    /// Inertia about the base joint, with the mass carried at the end of the base arm, kg·m².
    base_kg_m2: [R; 2],
    /// Mass carried at a share of the outer arm, times the share, kg.
    carried_kg: [R; 2],
    /// Inertia of the outer arm about its joint with the base arm, kg·m².
    outer_kg_m2: [R; 2],
}

impl<R: Real> Bodies<R> {
    /// The bodies of a rig; the payload counts on the side A, E, D.
    pub fn new(arms: &Arms, inertia: &Inertia) -> Bodies<R> {
        let about_joint =
            |arm: &ArmInertia| arm.inertia_kg_m2 + arm.mass_kg * arm.centre_m * arm.centre_m;
        let side =
            |base: &ArmInertia, outer: &ArmInertia, [inner_m, outer_m]: [f64; 2], kg: f64| {
                [
                    about_joint(base) + (outer.mass_kg + kg) * inner_m * inner_m,
                    outer.mass_kg * outer.centre_m / outer_m + kg,
                    about_joint(outer) + kg * outer_m * outer_m,
                ]
            };
        let left = [arms.l_ae_m, arms.l_ed_m];
        let right = [arms.l_bc_m, arms.l_cd_m];
        let [base_a, carried_a, outer_a] = side(&inertia.ae, &inertia.ed, left, inertia.payload_kg);
        let [base_b, carried_b, outer_b] = side(&inertia.bc, &inertia.cd, right, 0.0);
        Bodies {
            base_kg_m2: [base_a, base_b].map(R::of),
            carried_kg: [carried_a, carried_b].map(R::of),
            outer_kg_m2: [outer_a, outer_b].map(R::of),
        }
    }
}

impl<R: Real> Bodies<R> {
    /// Of each side, A-E-D first: the inertia about its base joint, what its outer arm carries, and the outer arm's inertia.
    pub fn sides(&self) -> [[R; 3]; 2] {
        let [base_a, base_b] = self.base_kg_m2;
        let [carried_a, carried_b] = self.carried_kg;
        let [outer_a, outer_b] = self.outer_kg_m2;
        [[base_a, carried_a, outer_a], [base_b, carried_b, outer_b]]
    }
}

/// A symmetric matrix of two rows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mass<R> {
    /// First row, first column, kg·m².
    pub aa: R,
    /// Off the diagonal, kg·m².
    pub ab: R,
    /// Second row, second column, kg·m².
    pub bb: R,
}

impl<R: Real> Mass<R> {
    /// The matrix times a vector.
    #[inline(always)]
    pub fn times(&self, vector: Vector<R>) -> Vector<R> {
        Vector::new(
            self.aa * vector.x + self.ab * vector.y,
            self.ab * vector.x + self.bb * vector.y,
        )
    }

    /// The vector that the matrix turns into `right`.
    #[inline(always)]
    pub fn solve(&self, right: Vector<R>) -> Vector<R> {
        let inverse = R::of(1.0) / (self.aa * self.bb - self.ab * self.ab);
        Vector::new(
            self.bb * right.x - self.ab * right.y,
            self.aa * right.y - self.ab * right.x,
        ) * inverse
    }
}

/// The motion at one place and one pair of rates v = (θ̇A, θ̇B).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Form<R> {
    /// M, kg·m².
    pub mass: Mass<R>,
    /// b, N·m.
    pub bias_nm: Vector<R>,
    /// How fast ED and CD turn by v: rows, 1.
    pub turning: [Vector<R>; 2],
    /// How fast these rows change, 1/s.
    pub turning_rate: [Vector<R>; 2],
}

/// The form of a linkage whose base joints turn at `rates_rad_s`.
///
/// With a, b, c, d along AE, ED, BC, CD, the closure gives the turning of ED and CD as quotients of cross products, whose
/// derivatives are dot products times differences of rates. Each body adds its share by the principle of virtual power.
//= thesis (5.40)
//= thesis (A.1)
#[inline(always)]
pub fn form<R: Real>(bodies: &Bodies<R>, at: &Linkage<R>, rates_rad_s: Vector<R>) -> Form<R> {
    let Linkage {
        ae: a,
        ed: b,
        bc: c,
        cd: d,
        ..
    } = *at;
    let u = rates_rad_s;
    let inverse = R::of(1.0) / at.opening_m2;
    let left = Vector::new(-a.cross(d), c.cross(d)) * inverse;
    let right = Vector::new(-a.cross(b), c.cross(b)) * inverse;
    let (rate_ed, rate_cd) = (left.dot(u), right.dot(u));
    let (with_a, with_c) = (a.dot(b), c.dot(d));
    // The rows' derivatives: of the numerators, and less the rows times that of the denominator.
    let opening = (rate_cd - rate_ed) * (b.dot(d) * inverse);
    let left_part = Vector::new(
        (u.x - rate_cd) * (a.dot(d) * inverse),
        (rate_cd - u.y) * (with_c * inverse),
    );
    let right_part = Vector::new(
        (u.x - rate_ed) * (with_a * inverse),
        (rate_ed - u.y) * (c.dot(b) * inverse),
    );
    let (left_rate, right_rate) = (left_part - left * opening, right_part - right * opening);
    let bias_ed = left_part.dot(u) - rate_ed * opening;
    let bias_cd = right_part.dot(u) - rate_cd * opening;
    let [base_a, base_b] = bodies.base_kg_m2;
    let [carried_a, carried_b] = bodies.carried_kg;
    let [outer_a, outer_b] = bodies.outer_kg_m2;
    let (couple_a, couple_b) = (carried_a * with_a, carried_b * with_c);
    let (twist_a, twist_b) = (carried_a * a.cross(b), carried_b * c.cross(d));
    let mass = Mass {
        aa: base_a
            + (couple_a + couple_a) * left.x
            + outer_a * left.x * left.x
            + outer_b * right.x * right.x,
        ab: couple_a * left.y
            + outer_a * left.x * left.y
            + couple_b * right.x
            + outer_b * right.x * right.y,
        bb: base_b
            + (couple_b + couple_b) * right.y
            + outer_b * right.y * right.y
            + outer_a * left.y * left.y,
    };
    let along_a = couple_a * bias_ed - twist_a * rate_ed * rate_ed;
    let along_b = couple_b * bias_cd - twist_b * rate_cd * rate_cd;
    let through_ed = outer_a * bias_ed + twist_a * u.x * u.x;
    let through_cd = outer_b * bias_cd + twist_b * u.y * u.y;
    Form {
        mass,
        bias_nm: Vector::new(along_a, along_b) + left * through_ed + right * through_cd,
        turning: [left, right],
        turning_rate: [left_rate, right_rate],
    }
}

impl<R: Real> Form<R> {
    /// What a force on the tip drives the two coordinates with: Tᵀ·F, N·m.
    #[inline(always)]
    pub fn tip_load(&self, at: &Linkage<R>, force_n: Vector<R>) -> Vector<R> {
        let [left, _] = self.turning;
        tip_load(left, at, force_n)
    }

    /// G: how fast the joints A, E, B, C turn by v, rows, 1.
    #[inline]
    pub fn joint_rows(&self) -> [Vector<R>; 4] {
        let [left, right] = self.turning;
        joint_rows(left, right)
    }

    /// G after `ahead_s` at the rates of the form.
    #[inline]
    pub fn joint_rows_ahead(&self, ahead_s: R) -> [Vector<R>; 4] {
        let [left, right] = self.turning;
        let [left_rate, right_rate] = self.turning_rate;
        joint_rows(left + left_rate * ahead_s, right + right_rate * ahead_s)
    }

    /// Kinetic energy ½·vᵀ·M·v, J.
    pub fn kinetic_energy_j(&self, rates_rad_s: Vector<R>) -> R {
        R::of(0.5) * rates_rad_s.dot(self.mass.times(rates_rad_s))
    }
}

/// Tᵀ·F of a linkage whose arm ED turns by a row.
#[inline(always)]
pub fn tip_load<R: Real>(turning_ed: Vector<R>, at: &Linkage<R>, force_n: Vector<R>) -> Vector<R> {
    Vector::new(at.ae.cross(force_n), R::zero()) + turning_ed * at.ed.cross(force_n)
}

/// G of a linkage whose arms ED and CD turn by two rows.
#[inline]
pub fn joint_rows<R: Real>(left: Vector<R>, right: Vector<R>) -> [Vector<R>; 4] {
    let (one, none) = (R::of(1.0), R::zero());
    let (base_a, base_b) = (Vector::new(one, none), Vector::new(none, one));
    [base_a, left - base_a, base_b, right - base_b]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linkage::{Shape, linkage};
    use rigproof_spec::geometry::arms;
    use rigproof_spec::inertia::inertia;
    use rigproof_spec::layout::Layout;

    //= thesis (A.1) test
    #[test]
    fn the_three_brake_layout_has_its_mass_by_hand() {
        // ED turns with BC and CD with AE: about A 0.0661 + 3.70·0.166² + 2.74·0.305² + 0.0355 + 2.59·0.188² = 0.54999,
        // about B 0.0355 + 2.62·0.109² + 2.59·0.305² + 0.0336 + 2.74·0.096² = 0.36641, and off the diagonal
        // (2.74·0.096 + 2.59·0.188)·0.305 = 0.22874 times the cosine of the angle between AE and BC.
        let (arms, inertia) = (arms(Layout::ThreeBrake), inertia(Layout::ThreeBrake));
        let shape = Shape::new(&arms);
        let unit = |angle| Vector::new(libm::cos(angle), libm::sin(angle));
        let at = linkage(&shape, unit(2.31), unit(0.87));
        let form: Form<f64> = form(&Bodies::new(&arms, &inertia), &at, Vector::new(0.71, -1.3));
        assert!((form.mass.aa - 0.54999).abs() < 5e-6);
        assert!((form.mass.bb - 0.36641).abs() < 5e-6);
        assert!((form.mass.ab - 0.22874 * libm::cos(2.31 - 0.87)).abs() < 5e-6);
    }
}
