//! This file says that a castor rolls where it points, and that three of them leave a plate one degree of freedom.

use super::Margin;

/// A castor under a plate: where it stands from the handle, m, and where it points, of length one; x and y in the plate's frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Castor {
    /// Where it stands, m.
    pub at_m: [f64; 2],
    /// Where it points.
    pub heading: [f64; 2],
}

impl Castor {
    /// Its sideways speed by the plate's motion: handle x and y, m/s, and turning rate, rad/s.
    pub fn row(&self) -> [f64; 3] {
        let ([x, y], [along_x, along_y]) = (self.at_m, self.heading);
        [-along_y, along_x, along_x * x + along_y * y]
    }
}

/// Whether a plate's motion makes no castor slip sideways; the margin is what is left of `slack` at the worst, m/s.
///
/// Source: §2.2.1: Scooter "constrains the user to a single kinematic degree of freedom using three motorized castors".
pub fn rolls(castors: &[Castor; 3], motion: [f64; 3], slack: f64) -> Margin {
    castors.iter().fold(Margin(slack), |margin, castor| {
        let [x, y, turn] = castor.row();
        let [v_x, v_y, rate] = motion;
        margin.and(Margin(slack - (x * v_x + y * v_y + turn * rate).abs()))
    })
}

/// Whether three castors leave exactly one degree of freedom: their rows are dependent, and not all parallel.
///
/// The margin is what is left of `slack`, m, by their determinant, or what the greatest area of two rows is above it.
/// Their axles then meet in one point, or are parallel. Source: as [`rolls`].
pub fn one_degree(castors: &[Castor; 3], slack: f64) -> Margin {
    let [a, b, c] = castors.map(|castor| castor.row());
    let [ab, bc, ca] = [cross(a, b), cross(b, c), cross(c, a)];
    let [x, y, z] = a;
    let [bc_x, bc_y, bc_z] = bc;
    let determinant = x * bc_x + y * bc_y + z * bc_z;
    let greatest = [ab, bc, ca]
        .iter()
        .flatten()
        .fold(0.0, |greatest: f64, part| {
            if part.abs() > greatest {
                part.abs()
            } else {
                greatest
            }
        });
    Margin(slack - determinant.abs()).and(Margin(greatest - slack))
}

fn cross([a_1, a_2, a_3]: [f64; 3], [b_1, b_2, b_3]: [f64; 3]) -> [f64; 3] {
    [
        a_2 * b_3 - a_3 * b_2,
        a_3 * b_1 - a_1 * b_3,
        a_1 * b_2 - a_2 * b_1,
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn castors(headings: [[f64; 2]; 3]) -> [Castor; 3] {
        let [a, b, c] = headings;
        let castor = |at_m, heading| Castor { at_m, heading };
        [
            castor([0.31, 0.07], a),
            castor([-0.13, 0.29], b),
            castor([-0.17, -0.23], c),
        ]
    }

    #[test]
    fn parallel_castors_leave_one_way_and_it_rolls() {
        let same = castors([[0.8, 0.6]; 3]);
        assert!(one_degree(&same, 1e-12).holds());
        assert!(rolls(&same, [0.24, 0.18, 0.0], 1e-12).holds());
        assert!(!rolls(&same, [0.24, 0.18, 0.1], 1e-3).holds());
        assert!(!rolls(&same, [0.18, 0.24, 0.0], 1e-3).holds());
        assert!(!rolls(&same, [f64::NAN, 0.18, 0.0], 1e-3).holds());
    }

    #[test]
    fn castors_whose_axles_miss_each_other_leave_none() {
        let crossed = castors([[0.8, 0.6], [0.6, -0.8], [0.28, 0.96]]);
        assert!(!one_degree(&crossed, 1e-3).holds());
    }

    #[test]
    fn castors_with_one_axle_leave_more_than_one_degree() {
        let castor = |x: f64| Castor {
            at_m: [x, 0.0],
            heading: [0.0, 1.0],
        };
        // Three on one axle: they roll ahead and about any point of the axle.
        assert!(!one_degree(&[castor(0.13), castor(0.13), castor(0.13)], 1e-9).holds());
        assert!(!one_degree(&[castor(0.13), castor(-0.29), castor(f64::NAN)], 1e-9).holds());
    }
}
