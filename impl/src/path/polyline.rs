//! This file says how a point lies to a chain of straight pieces.

use super::{Nearest, Path, beside_line, of, piece, undefined};
use crate::number::Real;
use crate::vector::Vector;

/// Straight pieces from corner to corner, at most `N`; a closed chain returns to its first corner, an open one goes on straight.
///
/// The work of a tick is that of its pieces, each once.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Polyline<R, const N: usize> {
    /// The pieces, without a gap from the first on.
    pieces: [Option<Piece<R>>; N],
    /// The direction of the piece before the first one and after the last one; `None` for an open chain.
    around: Option<[Vector<R>; 2]>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Piece<R> {
    from_m: Vector<R>,
    direction: Vector<R>,
    length_m: R,
}

/// The nearest place of a chain so far: at a foot inside a piece, or at a corner between two directions.
enum Place<R> {
    Inside(Vector<R>, Vector<R>),
    Corner(Vector<R>, [Vector<R>; 2]),
}

impl<R: Real, const N: usize> Polyline<R, N> {
    /// An open chain through 2 to `N` + 1 corners, m; `None` for another number of them, or if one is not finite or less than
    /// [`SHORTEST_PIECE_M`](rigproof_spec::settings::SHORTEST_PIECE_M) from the next.
    pub fn open(corners_m: &[[f64; 2]]) -> Option<Polyline<R, N>> {
        (corners_m.len() >= 2).then_some(())?;
        let ends = corners_m.iter().skip(1);
        Polyline::chain(corners_m.iter().zip(ends), false)
    }

    /// A closed chain through 3 to `N` corners, m; the obstacle it bounds lies to its left if it runs counter-clockwise. `None` as of
    /// [`Polyline::open`].
    pub fn closed(corners_m: &[[f64; 2]]) -> Option<Polyline<R, N>> {
        (corners_m.len() >= 3).then_some(())?;
        let ends = corners_m.iter().cycle().skip(1);
        Polyline::chain(corners_m.iter().zip(ends), true)
    }

    fn chain<'a>(
        ways_m: impl Iterator<Item = (&'a [f64; 2], &'a [f64; 2])>,
        closed: bool,
    ) -> Option<Polyline<R, N>> {
        let mut pieces = [None; N];
        let mut places = pieces.iter_mut();
        let mut ends: Option<[Vector<R>; 2]> = None;
        for (from_m, to_m) in ways_m {
            let (direction, length_m) = piece(*from_m, *to_m)?;
            let direction = of(direction);
            *places.next()? = Some(Piece {
                from_m: of((*from_m).into()),
                direction,
                length_m: R::of(length_m),
            });
            ends = Some([direction, ends.map_or(direction, |[_, first]| first)]);
        }
        Some(Polyline {
            pieces,
            around: ends.filter(|_| closed),
        })
    }
}

impl<R: Real, const N: usize> Path<R> for Polyline<R, N> {
    fn nearest(&self, point_m: Vector<R>) -> Nearest<R> {
        let mut before = self.around.map(|[last, _]| last);
        let mut best: Option<(R, Place<R>)> = None;
        let mut pieces = self.pieces.iter().map_while(Option::as_ref).peekable();
        while let Some(piece) = pieces.next() {
            let after = match pieces.peek() {
                Some(next) => Some(next.direction),
                None => self.around.map(|[_, first]| first),
            };
            let (square_m2, place) = piece.place(point_m, before, after);
            if best.as_ref().is_none_or(|(least, _)| square_m2 < *least) {
                best = Some((square_m2, place));
            }
            before = Some(piece.direction);
        }
        match best {
            Some((_, Place::Inside(away_m, direction))) => beside_line(away_m, direction),
            Some((_, Place::Corner(away_m, [before, after]))) => around(away_m, before, after),
            // A chain has at least one piece; without one there is no path to be near to.
            None => undefined(),
        }
    }
}

impl<R: Real> Piece<R> {
    /// The nearest place of the piece and the square of its distance, m².
    fn place(
        &self,
        point_m: Vector<R>,
        before: Option<Vector<R>>,
        after: Option<Vector<R>>,
    ) -> (R, Place<R>) {
        let away_m = point_m - self.from_m;
        let along_m = away_m.dot(self.direction);
        match (before, after) {
            (Some(before), _) if along_m <= R::zero() => {
                let place = Place::Corner(away_m, [before, self.direction]);
                (away_m.norm_squared(), place)
            }
            (_, Some(after)) if along_m >= self.length_m => {
                let away_m = away_m - self.direction * self.length_m;
                let place = Place::Corner(away_m, [self.direction, after]);
                (away_m.norm_squared(), place)
            }
            _ => {
                let across_m = self.direction.cross(away_m);
                (across_m * across_m, Place::Inside(away_m, self.direction))
            }
        }
    }
}

/// How a point lies to a corner on its outer side, where every direction between the two legs is nearest to the corner.
fn around<R: Real>(away_m: Vector<R>, before: Vector<R>, after: Vector<R>) -> Nearest<R> {
    let distance_m = away_m.norm();
    if distance_m > R::zero() {
        let outward = away_m * (R::of(1.0) / distance_m);
        let left = (before + after).cross(away_m) >= R::zero();
        Nearest {
            tangent: if left {
                -outward.left()
            } else {
                outward.left()
            },
            offset_m: if left { distance_m } else { -distance_m },
        }
    } else {
        Nearest {
            tangent: after,
            offset_m: R::zero(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_two_pieces_as_near_the_first_along_the_chain_is_taken() {
        let corners = [[-0.25, 1.0], [-0.25, -1.0], [0.25, -1.0], [0.25, 1.0]];
        let chain = Polyline::<f64, 3>::open(&corners).unwrap();
        let nearest = chain.nearest(Vector::new(0.0, 0.37));
        assert_eq!(nearest.tangent, Vector::new(0.0, -1.0));
        assert_eq!(nearest.offset_m, 0.25);
    }

    #[test]
    fn outside_a_corner_is_the_right_of_a_chain_that_turns_left_and_the_left_of_one_that_turns_right()
     {
        let corners = [[-0.31, 0.17], [0.29, 0.17], [0.29, 0.63], [-0.31, 0.63]];
        let mut back = corners;
        back.reverse();
        for (corners, side) in [(corners, -1.0), (back, 1.0)] {
            let chain = Polyline::<f64, 4>::closed(&corners).unwrap();
            // Three to the right and four down from the second corner, and turned so at the others.
            for (point, [x, y]) in [
                ([0.32, 0.13], [0.8, 0.6]),
                ([0.33, 0.66], [-0.6, 0.8]),
                ([-0.34, 0.67], [-0.8, -0.6]),
                ([-0.35, 0.14], [0.6, -0.8]),
            ] {
                let nearest = chain.nearest(Vector::from(point));
                assert!((nearest.offset_m - side * 0.05).abs() < 1e-15);
                let along = Vector::new(-side * x, -side * y);
                assert!((nearest.tangent - along).norm() < 1e-14, "{nearest:?}");
            }
        }
    }
}
