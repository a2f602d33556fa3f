//! This file says how a point lies to a smooth curve through given points, in bounded work.

use super::roots::{bracketed, crossing, pairs};
use super::{Nearest, Path, beside, of, piece, straight_on, undefined};
use crate::number::{Real, least};
use crate::vector::Vector;

/// A smooth curve of at most `N` pieces: a centripetal Catmull-Rom spline (Yuksel, Schaefer and Keyser, Computer-Aided Design 43, 2011).
///
/// Greatest work of a tick: for every piece at most 15 crossings of 16 steps each, 5 of them where the distance turns and, where the
/// signs of its Bernstein coefficients change more than once, 10 to part those (decision 0072). A piece whose control points all lie
/// farther away than the nearest end of any piece is left out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spline<R, const N: usize> {
    /// The pieces, without a gap from the first on.
    pieces: [Option<Cubic<R>>; N],
}

/// A cubic polynomial in a share from 0 to 1, and a disc around it.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Cubic<R> {
    /// Constant, linear, quadratic and cubic coefficient, m.
    coefficients_m: [Vector<R>; 4],
    /// Directions at the ends.
    tangents: [Vector<R>; 2],
    end_m: Vector<R>,
    /// Centre and radius of a disc that holds the piece, m.
    disc_m: (Vector<R>, R),
}

impl<R: Real, const N: usize> Spline<R, N> {
    /// The curve through 3 to `N` + 1 points, m; `None` for another number of them, or if one is not finite or less than
    /// [`SHORTEST_PIECE_M`](rigproof_spec::settings::SHORTEST_PIECE_M) from the next.
    pub fn through(points_m: &[[f64; 2]]) -> Option<Spline<R, N>> {
        let [first, second, ..] = points_m else {
            return None;
        };
        let [.., before, last] = points_m else {
            return None;
        };
        (points_m.len() >= 3).then_some(())?;
        for (from_m, to_m) in points_m.iter().zip(points_m.iter().skip(1)) {
            piece(*from_m, *to_m)?;
        }
        // Each end is mirrored once, so that every piece has a neighbour on both sides.
        let mirrored =
            |end: &[f64; 2], inner: &[f64; 2]| Vector::from(*end) * 2.0 - Vector::from(*inner);
        let mut window = [mirrored(first, second); 4];
        let mut pieces = [None; N];
        let mut places = pieces.iter_mut();
        let points = points_m.iter().map(|point_m| Vector::from(*point_m));
        for (index, point) in points.chain([mirrored(last, before)]).enumerate() {
            let [_, b, c, d] = window;
            window = [b, c, d, point];
            if index >= 2 {
                *places.next()? = Some(Cubic::centripetal(window));
            }
        }
        Some(Spline { pieces })
    }

    fn pieces(&self) -> impl Iterator<Item = &Cubic<R>> {
        self.pieces.iter().map_while(Option::as_ref)
    }
}

impl<R: Real> Cubic<R> {
    /// The piece from the second to the third of four points.
    fn centripetal([p_0, p_1, p_2, p_3]: [Vector<f64>; 4]) -> Cubic<R> {
        let span = |from: Vector<f64>, to: Vector<f64>| {
            let way = to - from;
            libm::sqrt(libm::hypot(way.x, way.y))
        };
        let speed = |from: Vector<f64>, to: Vector<f64>, time: f64| (to - from) * (1.0 / time);
        let (t_1, t_2, t_3) = (span(p_0, p_1), span(p_1, p_2), span(p_2, p_3));
        let middle = speed(p_1, p_2, t_2);
        let start = (speed(p_0, p_1, t_1) - speed(p_0, p_2, t_1 + t_2) + middle) * t_2;
        let end = (middle - speed(p_1, p_3, t_2 + t_3) + speed(p_2, p_3, t_3)) * t_2;
        let way = p_2 - p_1;
        let direction =
            |velocity: Vector<f64>| of(velocity * (1.0 / libm::hypot(velocity.x, velocity.y)));
        // The piece lies in the hull of its Bézier points.
        let centre = (p_1 + p_2) * 0.5;
        let hull = [p_1, p_1 + start * (1.0 / 3.0), p_2 - end * (1.0 / 3.0), p_2];
        let radius_m = hull
            .map(|point| libm::hypot(point.x - centre.x, point.y - centre.y))
            .into_iter()
            .fold(0.0, f64::max);
        Cubic {
            coefficients_m: [
                p_1,
                start,
                way * 3.0 - start * 2.0 - end,
                start + end - way * 2.0,
            ]
            .map(of),
            tangents: [direction(start), direction(end)],
            end_m: of(p_2),
            disc_m: (of(centre), R::of(radius_m)),
        }
    }

    fn start_m(&self) -> Vector<R> {
        let [start_m, ..] = self.coefficients_m;
        start_m
    }

    fn beside(&self, point_m: Vector<R>, share: R) -> Nearest<R> {
        let [c_0, c_1, c_2, c_3] = self.coefficients_m;
        let velocity = c_1 + (c_2 * R::of(2.0) + c_3 * (R::of(3.0) * share)) * share;
        let way_m = (c_1 + (c_2 + c_3 * share) * share) * share;
        let tangent = velocity * (R::of(1.0) / velocity.norm());
        beside(point_m - c_0 - way_m, tangent)
    }

    /// How fast the squared distance from a point grows along the piece, halved, as a polynomial of the share, constant first.
    fn receding(&self, point_m: Vector<R>) -> [R; 6] {
        let [c_0, c_1, c_2, c_3] = self.coefficients_m;
        let away = c_0 - point_m;
        let (two, three) = (R::of(2.0), R::of(3.0));
        [
            away.dot(c_1),
            two * away.dot(c_2) + c_1.dot(c_1),
            three * (away.dot(c_3) + c_1.dot(c_2)),
            R::of(4.0) * c_1.dot(c_3) + two * c_2.dot(c_2),
            R::of(5.0) * c_2.dot(c_3),
            three * c_3.dot(c_3),
        ]
    }

    /// Whether every point of the piece is farther away than this, m.
    fn is_farther(&self, point_m: Vector<R>, distance_m: R) -> bool {
        let (centre_m, radius_m) = self.disc_m;
        let reach_m = (radius_m + distance_m) * R::of(ROOM);
        (point_m - centre_m).norm_squared() > reach_m * reach_m
    }

    /// The nearest point of the piece, its ends included.
    fn nearest(&self, point_m: Vector<R>) -> Nearest<R> {
        let [start, end] = self.tangents;
        let mut best =
            beside(point_m - self.start_m(), start).or_nearer(beside(point_m - self.end_m, end));
        let receding = self.receding(point_m);
        for (low, high) in pairs(&bracketed(receding)) {
            if let Some(share) = crossing(&receding, low, high) {
                best = best.or_nearer(self.beside(point_m, share));
            }
        }
        best
    }
}

/// Room for rounding in what is left out: more than a float's last digit.
const ROOM: f64 = 1.000_01;

impl<R: Real, const N: usize> Path<R> for Spline<R, N> {
    fn nearest(&self, point_m: Vector<R>) -> Nearest<R> {
        let (Some(first), Some(last)) = (self.pieces().next(), self.pieces().last()) else {
            return undefined();
        };
        let ends = self.pieces().map(|piece| piece.end_m);
        let squares = ends.map(|end_m| (point_m - end_m).norm_squared());
        let start = (point_m - first.start_m()).norm_squared();
        let bound_m = squares.fold(start, least).sqrt();

        let [tangent, _] = first.tangents;
        let mut best = straight_on(point_m - first.start_m(), tangent, -R::of(1.0));
        for piece in self.pieces() {
            if !piece.is_farther(point_m, bound_m) {
                best = best.or_nearer(piece.nearest(point_m));
            }
        }
        let [_, tangent] = last.tangents;
        best.or_nearer(straight_on(point_m - last.end_m, tangent, R::of(1.0)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const POINTS: [[f64; 2]; 6] = [
        [-0.31, 0.17],
        [0.07, 0.63],
        [0.11, 0.21],
        [0.43, 0.29],
        [0.13, 0.19],
        [-0.27, 0.57],
    ];

    /// Every window of four of the points, in every order.
    fn windows() -> impl Iterator<Item = [Vector<f64>; 4]> {
        let orders = (0..6 * 6 * 6 * 6).map(|k| [k % 6, k / 6 % 6, k / 36 % 6, k / 216]);
        let distinct = |order: &[usize; 4]| (1..4).all(|i| !order[..i].contains(&order[i]));
        orders
            .filter(distinct)
            .map(|order| order.map(|place| POINTS[place].into()))
    }

    #[test]
    fn the_disc_over_the_chord_holds_the_control_points() {
        for window in windows() {
            let piece = Cubic::<f64>::centripetal(window);
            let [c_0, c_1, c_2, _] = piece.coefficients_m;
            let (centre_m, radius_m) = piece.disc_m;
            let inner_m = [
                c_0 + c_1 * (1.0 / 3.0),
                c_0 + c_1 * (2.0 / 3.0) + c_2 * (1.0 / 3.0),
            ]
            .map(|point_m| (point_m - centre_m).norm())
            .into_iter()
            .fold(0.0, f64::max);
            let ends_m = (c_0 - centre_m).norm();
            assert!((ends_m - (piece.end_m - centre_m).norm()).abs() < 1e-15);
            assert!((radius_m - ends_m).abs() < 1e-15 && inner_m <= radius_m + 1e-15);
        }
    }

    #[test]
    fn a_piece_out_of_reach_is_left_out() {
        let window = POINTS.map(Vector::from);
        let piece = Cubic::<f64>::centripetal([window[0], window[1], window[2], window[3]]);
        let (centre_m, radius_m) = piece.disc_m;
        for distance_m in [0.07, 0.31, 2.3] {
            for (share, is_left_out) in [(0.999, false), (1.001, true), (1.7, true)] {
                let way_m = Vector::new(0.6, -0.8) * (share * (radius_m + distance_m));
                let is_farther = piece.is_farther(centre_m + way_m, distance_m);
                assert_eq!(is_farther, is_left_out, "{distance_m} {share}");
            }
        }
    }
}
