//! This file says which inertial numbers of an arm a motion can tell: the base parameters (Gautier and Khalil 1990), found by their columns at drawn states.

use super::{Chain, INERTIAL};
use nalgebra::{DMatrix, DVector};

/// The inertial numbers that efforts hang on, a group a link.
#[derive(Clone, Debug, PartialEq)]
pub struct Base {
    /// Which numbers, ten a link, stand for the groups: those of a link come together.
    pub columns: Vec<usize>,
    /// What every number counts in each group: a row a group, ten columns a link.
    pub counts: DMatrix<f64>,
}

/// The base parameters of one link.
#[derive(Clone, Debug, PartialEq)]
pub struct Group {
    /// The link, by its joint.
    pub link: usize,
    /// Where they stand among all.
    pub from: usize,
    /// How many they are.
    pub len: usize,
}

/// States that are drawn, in multiples of the joints.
const STATES_A_JOINT: usize = 12;
/// Length of a column's part that the columns before do not have, below which it has none.
const NONE: f64 = 1e-7;
/// Length of a column, as a share of the longest, below which it is rounding.
const ROUNDING: f64 = 1e-12;

impl Chain {
    /// The base parameters of this arm: links from the tip to the base, of each the numbers that the efforts hang on beside those already there.
    pub fn base(&self) -> Base {
        let all = INERTIAL * self.joints.len();
        let stacked = self.stacked();
        let from_the_tip = (0..self.joints.len())
            .rev()
            .flat_map(|link| (0..INERTIAL).map(move |k| INERTIAL * link + k));
        let mut kept = independent(&stacked, from_the_tip);
        kept.sort_unstable();
        let chosen =
            DMatrix::from_columns(&kept.iter().map(|&c| stacked.column(c)).collect::<Vec<_>>());
        let counts = match chosen
            .clone()
            .qr()
            .r()
            .solve_upper_triangular(&(chosen.qr().q().transpose() * &stacked))
        {
            Some(counts) => counts.map(|x| if x.abs() < NONE { 0.0 } else { x }),
            None => DMatrix::zeros(kept.len(), all),
        };
        Base {
            columns: kept,
            counts,
        }
    }

    /// The numbers of each link that the efforts hang on when the other links are as described, ten a link counted from the base. Those of
    /// neighbouring links overlap.
    pub fn of_each_link(&self) -> Vec<usize> {
        let stacked = self.stacked();
        let links = 0..self.joints.len();
        let of_a_link = |link| independent(&stacked, INERTIAL * link..INERTIAL * (link + 1));
        links.flat_map(of_a_link).collect()
    }

    /// The regressor at drawn states, one below another.
    fn stacked(&self) -> DMatrix<f64> {
        let count = self.joints.len();
        let states = STATES_A_JOINT * count.max(1);
        let mut stacked = DMatrix::zeros(states * count, INERTIAL * count);
        let mut drawn = Drawn(0x9e37_79b9_7f4a_7c15);
        for state in 0..states {
            let [q, speed, acceleration]: [Vec<f64>; 3] =
                core::array::from_fn(|_| (0..count).map(|_| 3.0 * drawn.next()).collect());
            let own = self.regressor(&q, &speed, &acceleration);
            stacked.rows_mut(state * count, count).copy_from(&own);
        }
        stacked
    }
}

/// Those of the columns, in this order, that are no combination of the ones before. A column of rounding is none.
fn independent(stacked: &DMatrix<f64>, columns: impl Iterator<Item = usize>) -> Vec<usize> {
    let longest = stacked
        .column_iter()
        .fold(0.0, |most: f64, own| most.max(own.norm()));
    let mut directions: Vec<DVector<f64>> = Vec::new();
    let mut kept: Vec<usize> = Vec::new();
    for column in columns {
        let own: DVector<f64> = stacked.column(column).into_owned();
        let mut left = own.clone();
        // Twice is enough (Parlett): once leaves rounding in the order of the parts taken away.
        for _ in 0..2 {
            for direction in &directions {
                left -= direction * direction.dot(&left);
            }
        }
        let size = left.norm();
        if size > NONE * own.norm() && size > ROUNDING * longest {
            directions.push(left / size);
            kept.push(column);
        }
    }
    kept
}

impl Base {
    /// The groups of the links that have any.
    pub fn groups(&self) -> Vec<Group> {
        let mut groups: Vec<Group> = Vec::new();
        for (place, column) in self.columns.iter().enumerate() {
            let link = column / INERTIAL;
            match groups.last_mut() {
                Some(group) if group.link == link => group.len += 1,
                _ => groups.push(Group {
                    link,
                    from: place,
                    len: 1,
                }),
            }
        }
        groups
    }

    /// The base parameters of these inertial numbers.
    pub fn of(&self, numbers: &[f64]) -> Vec<f64> {
        let all = DVector::from_column_slice(numbers);
        (&self.counts * all).iter().copied().collect()
    }
}

/// Numbers between −1 and 1 that look drawn and are always the same (xorshift, Marsaglia 2003).
struct Drawn(u64);

impl Drawn {
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}
