//! This file is the little geometry of space that an arm needs: vectors as three numbers, turns as three rows.

/// A vector.
pub type V = [f64; 3];
/// A turn: its rows are the axes of the outer frame seen in the inner one.
pub type M = [V; 3];

pub const ZERO: V = [0.0; 3];
pub const NO_TURN: M = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

pub fn dot([a, b, c]: V, [x, y, z]: V) -> f64 {
    a * x + b * y + c * z
}

pub const fn cross([a, b, c]: V, [x, y, z]: V) -> V {
    [b * z - c * y, c * x - a * z, a * y - b * x]
}

/// `a + factor·b`.
pub fn plus([a, b, c]: V, factor: f64, [x, y, z]: V) -> V {
    [a + factor * x, b + factor * y, c + factor * z]
}

pub fn times(turn: &M, v: V) -> V {
    turn.map(|row| dot(row, v))
}

pub const fn transposed(&[[a, b, c], [d, e, f], [g, h, i]]: &M) -> M {
    [[a, d, g], [b, e, h], [c, f, i]]
}

pub fn product(left: &M, right: &M) -> M {
    let columns = transposed(right);
    left.map(|row| columns.map(|column| dot(row, column)))
}

/// A symmetric matrix of the inner frame as the outer one sees it.
pub fn seen(turn: &M, own: &M) -> M {
    product(&product(turn, own), &transposed(turn))
}

/// The turn of roll, pitch and yaw about the fixed axes x, y and z, one after the other.
pub fn turned([roll, pitch, yaw]: V) -> M {
    let ((sr, cr), (sp, cp), (sy, cy)) =
        (libm::sincos(roll), libm::sincos(pitch), libm::sincos(yaw));
    [
        [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
        [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
        [-sp, cp * sr, cp * cr],
    ]
}

/// The turn by an angle about the z axis.
pub fn about_z(angle: f64) -> M {
    turned([0.0, 0.0, angle])
}
