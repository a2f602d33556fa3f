//! This file says where the arms are when the base joints are turned, and how joints and tip move together: closed form, no angles.

use rigproof_spec::geometry::Arms;

use crate::number::Real;
use crate::vector::Vector;

/// Least sine of the angle between two arms at which a pose is used, as in the reference.
pub const LEAST_SINE: f64 = 1e-5;

/// Arm lengths and what is computed from them once.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shape<R> {
    /// Arms AE and BC, m.
    base_m: [R; 2],
    /// `L_ED`², m².
    ed_squared_m2: R,
    /// Base joint A is at minus this on the x axis, B at plus this, m.
    pub half_base_m: R,
    /// (`L_ED`² − `L_CD`²)/2, m².
    half_difference_m2: R,
    /// Least ED × AE, BC × CD and ED × CD at which a pose is used, m².
    least_m2: [R; 3],
}

impl<R: Real> Shape<R> {
    /// The shape of arms; the lengths must be those of a linkage (finite, above zero but for `L_AB`).
    pub fn new(arms: &Arms) -> Shape<R> {
        let squares = arms.l_ed_m * arms.l_ed_m - arms.l_cd_m * arms.l_cd_m;
        let lengths_m = [arms.l_ae_m, arms.l_ed_m, arms.l_bc_m, arms.l_cd_m];
        let [l_ae, l_ed, l_bc, l_cd] = lengths_m.map(R::of);
        let least = R::of(LEAST_SINE);
        Shape {
            base_m: [l_ae, l_bc],
            ed_squared_m2: l_ed * l_ed,
            least_m2: [
                least * l_ae * l_ed,
                least * l_bc * l_cd,
                least * l_ed * l_cd,
            ],
            half_base_m: R::of(0.5 * arms.l_ab_m),
            half_difference_m2: R::of(0.5 * squares),
        }
    }
}

/// A closed linkage: its arms as vectors, m.
///
/// Branch-free: where the arms cannot close some component is not a number; [`Linkage::is_sound`] tells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Linkage<R> {
    /// From A to E.
    pub ae: Vector<R>,
    /// From E to the tip.
    pub ed: Vector<R>,
    /// From B to C.
    pub bc: Vector<R>,
    /// From C to the tip.
    pub cd: Vector<R>,
    /// The tip.
    pub tip_m: Vector<R>,
    /// ED × CD, m²: 0 where they lie on one line.
    pub opening_m2: R,
}

/// The linkage whose base arms AE and BC point along two directions of length one: the tip is the point at `L_ED` from E and `L_CD` from
/// C, to the left of the way from E to C (5.1) to (5.17).
//= thesis (5.14)
//= thesis (5.15)
#[inline(always)]
pub fn linkage<R: Real>(shape: &Shape<R>, ae: Vector<R>, bc: Vector<R>) -> Linkage<R> {
    let [l_ae, l_bc] = shape.base_m;
    let (ae, bc) = (ae * l_ae, bc * l_bc);
    let base = Vector::new(shape.half_base_m + shape.half_base_m, R::zero());
    let across = base + bc - ae;
    let distance_squared = across.norm_squared();
    let scaled = across * (R::of(1.0) / distance_squared);
    // Of ED along the way from E to C and beside it, times the distance; a quotient and a root that do not wait for each other.
    let along = R::of(0.5) * distance_squared + shape.half_difference_m2;
    let beside = (shape.ed_squared_m2 * distance_squared - along * along).sqrt();
    let ed = scaled * along + scaled.left() * beside;
    Linkage {
        ae,
        ed,
        bc,
        cd: ed - across,
        tip_m: Vector::new(ae.x - shape.half_base_m, ae.y) + ed,
        opening_m2: beside,
    }
}

impl<R: Real> Linkage<R> {
    /// Whether the linkage is closed and away from its singularities: the sine of the angle between the arms of each pair is at least
    /// [`LEAST_SINE`] on the thesis's side.
    #[inline(always)]
    pub fn is_sound(&self, shape: &Shape<R>) -> bool {
        let [left, right, opening] = shape.least_m2;
        // The products that the rows divide by, so that a compiler takes them once.
        (self.ae.cross(self.ed) <= -left)
            & (self.bc.cross(self.cd) >= right)
            & (self.opening_m2 >= opening)
    }

    /// The rows of the Jacobian, 1/m, in the order A, E, B, C: θ̇ = J·ẋ (5.39).
    ///
    /// The inverse of J₁, whose columns are the tip's velocities at unit rates of A and E, in its closed form.
    //= thesis (5.39)
    #[inline]
    pub fn rows(&self) -> [Vector<R>; 4] {
        let left = R::of(1.0) / self.ae.cross(self.ed);
        let right = R::of(1.0) / self.bc.cross(self.cd);
        [
            self.ed * left,
            -(self.ae + self.ed) * left,
            self.cd * right,
            -(self.bc + self.cd) * right,
        ]
    }

    /// How fast arms ED and CD turn for rates (θ̇A, θ̇B) of the base joints: two rows, 1.
    #[inline]
    pub fn turning(&self) -> [Vector<R>; 2] {
        let inverse = R::of(1.0) / self.opening_m2;
        let row =
            |other: Vector<R>| Vector::new(-self.ae.cross(other), self.bc.cross(other)) * inverse;
        [row(self.cd), row(self.ed)]
    }

    /// The velocity of the tip for rates of the base joints, rad/s, m/s.
    #[inline]
    pub fn tip_velocity(&self, rates_rad_s: Vector<R>) -> Vector<R> {
        let [turning_ed, _] = self.turning();
        self.ae.left() * rates_rad_s.x + self.ed.left() * turning_ed.dot(rates_rad_s)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rigproof_spec::geometry::arms;
    use rigproof_spec::layout::Layout;

    fn at(layout: Layout, theta_a_rad: f64, theta_b_rad: f64) -> (Shape<f64>, Linkage<f64>) {
        let shape = Shape::new(&arms(layout));
        let unit = |angle: f64| {
            let (sine, cosine) = libm::sincos(angle);
            Vector::new(cosine, sine)
        };
        (shape, linkage(&shape, unit(theta_a_rad), unit(theta_b_rad)))
    }

    //= thesis (5.14) test
    //= thesis (5.15) test
    #[test]
    fn the_parallelogram_of_the_three_brake_layout_closes() {
        // AE straight to the left and BC straight up: the tip is at (−30.5 cm, 30.5 cm).
        let half_turn = core::f64::consts::PI;
        let (shape, linkage) = at(Layout::ThreeBrake, half_turn, 0.5 * half_turn);
        let off = linkage.tip_m - Vector::new(-0.305, 0.305);
        assert!(off.norm() < 1e-15 && linkage.is_sound(&shape));
    }

    //= thesis (5.39) test
    #[test]
    fn rows_undo_the_tip_velocity() {
        let (_, linkage) = at(Layout::FourBrake, 2.17, 0.83);
        let rates = Vector::new(0.71, -0.37);
        let velocity = linkage.tip_velocity(rates);
        let [turning_ed, turning_cd] = linkage.turning().map(|row| row.dot(rates));
        let expected = [rates.x, turning_ed - rates.x, rates.y, turning_cd - rates.y];
        for (row, rate) in linkage.rows().into_iter().zip(expected) {
            assert!((row.dot(velocity) - rate).abs() < 1e-14);
        }
    }

    #[test]
    fn arms_that_do_not_meet_are_not_sound() {
        let (shape, apart) = at(Layout::FourBrake, 3.1, 0.02);
        assert!(!apart.is_sound(&shape));
        let (shape, crossed) = at(Layout::ThreeBrake, 0.8, 1.9);
        assert!(!crossed.is_sound(&shape));
    }
}
