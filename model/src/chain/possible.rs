//! This file chooses, among the inertial numbers that give the same efforts, some that bodies can have, near the described ones.

use super::{Chain, INERTIAL, Inertial};
use nalgebra::{DMatrix, DVector, Matrix4};

/// Rounds of the search.
const ROUNDS: usize = 4000;
/// The least eigenvalue of a link's scaled pseudo-inertia that is aimed at; one with a positive least is a body's.
const AIMED: f64 = 2e-3;
const LEAST: f64 = 1e-5;
/// Where a matrix of ten numbers holds each entry of the pseudo-inertia.
const PLACES: [(usize, usize); INERTIAL] = [
    (0, 0),
    (1, 1),
    (2, 2),
    (0, 1),
    (0, 2),
    (1, 2),
    (0, 3),
    (1, 3),
    (2, 3),
    (3, 3),
];

/// A link's numbers as a vector whose length is that of its scaled pseudo-inertia (Wensing, Kim and Slotine 2018).
#[derive(Clone, Copy)]
struct Scale {
    mass: f64,
    length: f64,
}

impl Scale {
    fn of(own: &Inertial, usual: f64) -> Scale {
        let mass = if own.mass > 0.0 { own.mass } else { usual };
        let spread = 0.5 * own.second.trace() / mass;
        Scale {
            mass,
            length: if spread > 0.0 { spread.sqrt() } else { 0.1 },
        }
    }

    fn weight(self, k: usize) -> f64 {
        let (row, column) = PLACES.get(k).copied().unwrap_or((3, 3));
        let lengths = i32::from(row < 3) + i32::from(column < 3);
        let twice = if row == column { 1.0 } else { 2f64.sqrt() };
        twice / (self.mass * self.length.powi(lengths))
    }

    fn vector(self, own: &Inertial) -> [f64; INERTIAL] {
        let second = own.second;
        let half = 0.5 * second.trace();
        let h = own.first;
        let plain = [
            half - second.m11,
            half - second.m22,
            half - second.m33,
            -second.m12,
            -second.m13,
            -second.m23,
            h.x,
            h.y,
            h.z,
            own.mass,
        ];
        core::array::from_fn(|k| plain.get(k).copied().unwrap_or(0.0) * self.weight(k))
    }

    fn inertial(self, vector: &[f64]) -> Inertial {
        let n = |k: usize| vector.get(k).copied().unwrap_or(0.0) / self.weight(k);
        let [xx, yy, zz] = [n(0), n(1), n(2)];
        Inertial::of(&[
            n(9),
            n(6),
            n(7),
            n(8),
            yy + zz,
            -n(3),
            -n(4),
            xx + zz,
            -n(5),
            xx + yy,
        ])
    }
}

fn matrix(vector: &[f64]) -> Matrix4<f64> {
    let mut matrix = Matrix4::zeros();
    for (value, (row, column)) in vector.iter().zip(PLACES) {
        let own = if row == column {
            *value
        } else {
            value / 2f64.sqrt()
        };
        matrix[(row, column)] = own;
        matrix[(column, row)] = own;
    }
    matrix
}

/// The nearest vector whose pseudo-inertia has no eigenvalue below what is aimed at.
fn lifted(vector: &[f64]) -> [f64; INERTIAL] {
    let mut parts = matrix(vector).symmetric_eigen();
    parts.eigenvalues.apply(|own| *own = own.max(AIMED));
    let lifted = parts.recompose();
    core::array::from_fn(|k| {
        let (row, column) = PLACES.get(k).copied().unwrap_or((3, 3));
        let twice = if row == column { 1.0 } else { 2f64.sqrt() };
        lifted[(row, column)] * twice
    })
}

impl Chain {
    /// What the links' own inertial numbers come to, when the numbers of all change by this, ten a link: other changes that give the same efforts, so
    /// that each link is a body that can be. `None` where none was found.
    pub fn possible(&self, changes: &[f64]) -> Option<Vec<Inertial>> {
        let base = self.base();
        let links = self.joints.len();
        let usual = self.joints.iter().map(|own| own.own.mass).sum::<f64>() / links.max(1) as f64;
        let scales: Vec<Scale> = self
            .joints
            .iter()
            .map(|own| Scale::of(&own.own, usual))
            .collect();
        let described: Vec<f64> = self
            .joints
            .iter()
            .zip(&scales)
            .flat_map(|(own, scale)| scale.vector(&own.own))
            .collect();
        // What each entry counts in the base parameters, rows of length 1.
        let mut rows = DMatrix::zeros(base.columns.len(), described.len());
        for (link, scale) in scales.iter().enumerate() {
            for k in 0..INERTIAL {
                let mut unit = [0.0; INERTIAL];
                unit[k] = 1.0;
                let numbers = DVector::from_column_slice(&scale.inertial(&unit).numbers());
                let counts = base.counts.columns(INERTIAL * link, INERTIAL) * numbers;
                rows.column_mut(INERTIAL * link + k).copy_from(&counts);
            }
        }
        let lengths: Vec<f64> = rows.row_iter().map(|row| row.norm().max(1e-300)).collect();
        let mut aim = DVector::from_vec(base.of(changes));
        for (k, length) in lengths.iter().enumerate() {
            rows.row_mut(k).unscale_mut(*length);
            aim[k] /= length;
        }
        aim += &rows * DVector::from_column_slice(&described);
        let gram = (&rows * rows.transpose()).cholesky()?;
        let onto =
            |from: &DVector<f64>| from + rows.transpose() * gram.solve(&(&aim - &rows * from));
        let mut now = onto(&DVector::from_column_slice(&described));
        for _ in 0..ROUNDS {
            let least = now
                .as_slice()
                .chunks(INERTIAL)
                .map(|own| matrix(own).symmetric_eigenvalues().min());
            if least.fold(f64::INFINITY, f64::min) > 0.5 * AIMED {
                break;
            }
            let lifted: Vec<f64> = now.as_slice().chunks(INERTIAL).flat_map(lifted).collect();
            now = onto(&DVector::from_vec(lifted));
        }
        let mut each = now.as_slice().chunks(INERTIAL).zip(&scales);
        let is_body =
            |(own, _): (&[f64], &Scale)| matrix(own).symmetric_eigenvalues().min() > LEAST;
        each.clone().all(is_body).then(|| {
            each.by_ref()
                .map(|(own, scale)| scale.inertial(own))
                .collect()
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ARM: &str = include_str!("../../../rigs/arm.urdf");

    /// A heavier link is written as other base parameters; what comes out gives the same efforts and is a body.
    #[test]
    fn numbers_that_give_the_same_efforts_are_those_of_bodies() {
        let arm = Chain::from_urdf(ARM, Some("fore")).unwrap();
        let base = arm.base();
        let mut heavier = vec![0.0; 20];
        for (slot, own) in heavier
            .iter_mut()
            .skip(10)
            .zip(arm.joints[1].inertial.numbers())
        {
            *slot = 0.37 * own;
        }
        // As a diagnosis has it: on the numbers that stand for the groups alone.
        let mut told = vec![0.0; 20];
        for (column, value) in base.columns.iter().zip(base.of(&heavier)) {
            told[*column] = value;
        }
        let links = arm.possible(&told).unwrap();
        let mut other = arm.clone();
        for (joint, own) in other.joints.iter_mut().zip(&links) {
            assert_eq!(own.impossible(0.0), None);
            joint.inertial = *own;
        }
        let all: Vec<f64> = arm
            .parameters()
            .iter()
            .zip(&heavier)
            .map(|(a, b)| a + b)
            .collect();
        let wanted = arm.with_parameters(&all);
        let state = ([0.4, -1.1], [0.7, 1.3], [-2.0, 3.1]);
        let efforts = |arm: &Chain| arm.efforts(&state.0, &state.1, &state.2);
        for (own, wanted) in efforts(&other).iter().zip(efforts(&wanted)) {
            assert!((own - wanted).abs() < 1e-9 * wanted.abs(), "{own} {wanted}");
        }
    }

    #[test]
    fn an_arm_lighter_than_nothing_is_no_arm() {
        let arm = Chain::from_urdf(ARM, Some("fore")).unwrap();
        let gone: Vec<f64> = arm.parameters().iter().map(|own| -1.6 * own).collect();
        assert!(arm.possible(&gone).is_none());
    }
}
