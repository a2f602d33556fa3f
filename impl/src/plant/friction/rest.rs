//! This file says when brakes hold a load and how they share it: the polygon of what they can hold.

use super::dry_brake::{DryBrake, exact_zero};
use super::{Contact, Dry, Plane, Problem};
use crate::vector::Vector;

/// A side of the polygon that the brakes can hold.
struct Side {
    normal: Plane,
    /// Of the brakes' rows along the normal; exactly zero for those parallel to the side.
    components: [f64; 4],
    /// The load along the normal, with its sign, and the most that the brakes hold there.
    load: f64,
    strength: f64,
}

impl Problem<'_> {
    /// Rest, if the brakes can hold the load.
    pub(super) fn rest(&self) -> Option<Dry> {
        let mut impulses = [0.0; 4];
        if self.drive != Vector::zero() {
            let sides = self.sides();
            let side = self.tightest(&sides)?;
            impulses = if side.strength > 0.0 {
                self.impulses_at_rest(side)
            } else {
                self.impulses_of_parallels(side.normal)?
            };
        }
        Some(Dry {
            rates_rad_s: Vector::zero(),
            impulses,
            part: 1.0,
            held: self.brakes.each_ref().map(DryBrake::acts),
            contact: Contact::Rest,
        })
    }

    /// The side of the polygon along whose normal the load takes most of the brakes' strength; none where it takes more than there is.
    #[inline]
    fn tightest<'a>(&self, sides: &'a [Side; 4]) -> Option<&'a Side> {
        let mut tightest: Option<&Side> = None;
        for (brake, side) in self.brakes.iter().zip(sides) {
            let load = side.load.abs();
            if !brake.acts() {
                continue;
            }
            // Along nothing: all brakes are parallel.
            if side.strength == 0.0 {
                return Some(side);
            }
            if load > side.strength {
                return None;
            }
            if tightest.is_none_or(|other| load * other.strength > other.load.abs() * side.strength)
            {
                tightest = Some(side);
            }
        }
        tightest
    }

    /// The impulses where all brakes are parallel: they hold nothing across, and what they hold lies along them.
    #[inline(never)]
    fn impulses_of_parallels(&self, normal: Plane) -> Option<[f64; 4]> {
        if exact_zero(normal, self.drive) != 0.0 {
            return None;
        }
        let row = -normal.left();
        let components = self.brakes.each_ref();
        let components = components.map(|brake| exact_zero(brake.force_row, row));
        let side = self.side(row, components);
        (side.load.abs() <= side.strength).then(|| self.impulses_at_rest(&side))
    }

    /// The sides of the polygon, one parallel to the row of every brake.
    #[inline]
    fn sides(&self) -> [Side; 4] {
        let [a, e, b, c] = self.brakes.each_ref().map(|brake| brake.force_row);
        let [of_a, of_e, of_b, of_c] = [a, e, b, c].map(Vector::left);
        // Every pair once: what the second has along the normal of the first, the first has against that of the second.
        let (ae, ab, ac) = (
            exact_zero(e, of_a),
            exact_zero(b, of_a),
            exact_zero(c, of_a),
        );
        let (eb, ec, bc) = (
            exact_zero(b, of_e),
            exact_zero(c, of_e),
            exact_zero(c, of_b),
        );
        [
            self.side(of_a, [0.0, ae, ab, ac]),
            self.side(of_e, [-ae, 0.0, eb, ec]),
            self.side(of_b, [-ab, -eb, 0.0, bc]),
            self.side(of_c, [-ac, -ec, -bc, 0.0]),
        ]
    }

    #[inline]
    fn side(&self, normal: Plane, components: [f64; 4]) -> Side {
        let [a, e, b, c] = components.map(f64::abs);
        let [of_a, of_e, of_b, of_c] = self.brakes.each_ref().map(|brake| brake.bound);
        Side {
            normal,
            components,
            load: normal.dot(self.drive),
            strength: of_a * a + of_e * e + of_b * b + of_c * c,
        }
    }

    /// The impulses that balance the load and load every brake least by its bound.
    fn impulses_at_rest(&self, side: &Side) -> [f64; 4] {
        let share = side.load / side.strength;
        let along = side.normal.left();
        let mut impulses = [0.0; 4];
        // What the brakes across the side do not carry lies along it and is shared by those parallel to it.
        let (mut left, mut strength) = (-self.drive, 0.0);
        let places = impulses.iter_mut().zip(self.brakes).zip(side.components);
        for ((impulse, brake), component) in places {
            if component == 0.0 {
                strength += brake.bound * brake.force_row.dot(along).abs();
            } else {
                *impulse = -share * brake.bound * component.signum();
                left = left - brake.force_row * *impulse;
            }
        }
        if strength > 0.0 {
            let part = left.dot(along) / strength;
            let places = impulses.iter_mut().zip(self.brakes).zip(side.components);
            for ((impulse, brake), _) in places.filter(|(_, component)| *component == 0.0) {
                *impulse = part * brake.bound * brake.force_row.dot(along).signum();
            }
        }
        impulses
    }
}
