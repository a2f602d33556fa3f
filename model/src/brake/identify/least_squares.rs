//! This file is plain least squares whose standard errors allow for a scatter that is not the same everywhere.

use nalgebra::{SMatrix, SVector};

/// A number with its standard error and the degrees of freedom that stand behind it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// The number.
    pub value: f64,
    /// Its standard error; 0 where the fit had nothing to spare.
    pub standard_error: f64,
    /// Degrees of freedom of the standard error (Satterthwaite).
    pub freedom: f64,
}

/// One measurement: what the unknowns are multiplied by, and what they add up to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row<const P: usize> {
    /// One factor for each unknown.
    pub terms: [f64; P],
    /// The measured value.
    pub value: f64,
    /// Measurements of one group scatter alike, up to their `spread`.
    pub group: usize,
    /// Scatter within the group, in proportion.
    pub spread: f64,
}

/// The unknowns and how well the measurements are met.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit<const P: usize> {
    /// The unknowns.
    pub unknowns: [Estimate; P],
    /// What the fit gives for each measurement.
    pub fitted: Vec<f64>,
}

/// Share of the largest direction below which a direction of the unknowns counts as undetermined.
const LEAST_SHARE: f64 = 1e-5;

/// Unweighted least squares; `None` when the measurements do not determine the unknowns.
///
/// The scatter of each group is estimated from its residuals. With H the projection on the fit and v the spreads,
/// s² = Σ_group e² / Σ_group Σ_k (δ_ik − H_ik)²·v_k² has the right mean when every group scatters alike, and nearly so
/// otherwise; the variance of an unknown is the sum of s²·v² over its weights squared.
pub fn least_squares<const P: usize>(rows: &[Row<P>]) -> Option<Fit<P>> {
    let terms: Vec<SVector<f64, P>> = rows.iter().map(|r| SVector::from(r.terms)).collect();
    let gram: SMatrix<f64, P, P> = terms.iter().map(|x| x * x.transpose()).sum();
    let scale = gram.diagonal().map(libm::sqrt);
    if !scale.iter().all(|s| *s > 0.0) {
        return None;
    }
    let scaled = gram.component_div(&(scale * scale.transpose()));
    if !determined(&scaled) {
        return None;
    }
    let inverse = scaled
        .try_inverse()?
        .component_div(&(scale * scale.transpose()));
    let moment: SVector<f64, P> = terms.iter().zip(rows).map(|(x, r)| x * r.value).sum();
    let unknowns = inverse * moment;
    let fitted: Vec<f64> = terms.iter().map(|x| x.dot(&unknowns)).collect();
    let weights: Vec<SVector<f64, P>> = terms.iter().map(|x| inverse * x).collect();
    let groups = groups(rows, &terms, &weights, &fitted);
    let estimate = |index: usize| {
        let (mut variance, mut square_over_freedom) = (0.0, 0.0);
        for group in &groups {
            let mut share = 0.0;
            for (row, weight) in rows.iter().zip(&weights) {
                if row.group == group.name {
                    let weight = weight.get(index).copied().unwrap_or(0.0) * row.spread;
                    share += weight * weight;
                }
            }
            let part = share * group.variance;
            variance += part;
            if group.freedom > 0.0 {
                square_over_freedom += part * part / group.freedom;
            }
        }
        Estimate {
            value: unknowns.get(index).copied().unwrap_or(f64::NAN),
            standard_error: libm::sqrt(variance),
            freedom: if square_over_freedom > 0.0 {
                variance * variance / square_over_freedom
            } else {
                0.0
            },
        }
    };
    Some(Fit {
        unknowns: core::array::from_fn(estimate),
        fitted,
    })
}

/// Whether every direction of the unknowns is seen by the measurements.
fn determined<const P: usize>(scaled: &SMatrix<f64, P, P>) -> bool {
    // Gauss with the diagonal as pivots, on a matrix of ones on the diagonal: a pivot is what a direction keeps.
    let mut rest = *scaled;
    for k in 0..P {
        let pivot = rest[(k, k)];
        if pivot.is_nan() || pivot < LEAST_SHARE {
            return false;
        }
        for i in k + 1..P {
            let factor = rest[(i, k)] / pivot;
            for j in k..P {
                rest[(i, j)] -= factor * rest[(k, j)];
            }
        }
    }
    true
}

struct Group {
    name: usize,
    variance: f64,
    freedom: f64,
}

/// Scatter of each group for a spread of one, and its degrees of freedom.
fn groups<const P: usize>(
    rows: &[Row<P>],
    terms: &[SVector<f64, P>],
    weights: &[SVector<f64, P>],
    fitted: &[f64],
) -> Vec<Group> {
    let mut groups: Vec<Group> = Vec::new();
    let mut expected: Vec<f64> = Vec::new();
    for (i, ((row, term), fitted)) in rows.iter().zip(terms).zip(fitted).enumerate() {
        let mut left = 0.0;
        for (k, (other, weight)) in rows.iter().zip(weights).enumerate() {
            let projected = term.dot(weight);
            let rest = if i == k { 1.0 - projected } else { -projected };
            left += rest * rest * other.spread * other.spread;
        }
        let own = weights.get(i).map_or(0.0, |weight| term.dot(weight));
        let residual = row.value - fitted;
        match groups.iter().position(|group| group.name == row.group) {
            Some(index) => {
                if let (Some(group), Some(sum)) = (groups.get_mut(index), expected.get_mut(index)) {
                    group.variance += residual * residual;
                    group.freedom += 1.0 - own;
                    *sum += left;
                }
            }
            None => {
                groups.push(Group {
                    name: row.group,
                    variance: residual * residual,
                    freedom: 1.0 - own,
                });
                expected.push(left);
            }
        }
    }
    for (group, expected) in groups.iter_mut().zip(expected) {
        group.variance = if group.freedom > 1e-6 && expected > 0.0 {
            group.variance / expected
        } else {
            0.0
        };
    }
    groups
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(x: f64, value: f64) -> Row<2> {
        Row {
            terms: [x, 1.0],
            value,
            group: 3,
            spread: 1.0,
        }
    }

    #[test]
    fn a_straight_line_has_its_textbook_standard_errors() {
        let points = [(1.1, 2.7), (2.3, 3.1), (3.7, 5.2), (4.9, 5.9)];
        let rows = points.map(|(x, y)| row(x, y));
        let fit = least_squares(&rows).unwrap();
        let n = 4.0;
        let mean_x = points.iter().map(|p| p.0).sum::<f64>() / n;
        let mean_y = points.iter().map(|p| p.1).sum::<f64>() / n;
        let sxx: f64 = points.iter().map(|p| (p.0 - mean_x) * (p.0 - mean_x)).sum();
        let sxy: f64 = points.iter().map(|p| (p.0 - mean_x) * (p.1 - mean_y)).sum();
        let slope = sxy / sxx;
        let sse: f64 = points
            .iter()
            .map(|p| p.1 - mean_y - slope * (p.0 - mean_x))
            .map(|e| e * e)
            .sum();
        let [found, _] = fit.unknowns;
        assert!((found.value - slope).abs() < 1e-12);
        assert!((found.standard_error - libm::sqrt(sse / 2.0 / sxx)).abs() < 1e-12);
        assert!((found.freedom - 2.0).abs() < 1e-9);
    }

    #[test]
    fn unknowns_that_the_measurements_do_not_tell_apart_are_refused() {
        let rows = [1.3, 2.1, 4.4].map(|y| row(2.7, y));
        assert!(least_squares(&rows).is_none());
        assert!(least_squares::<2>(&[]).is_none());
        assert!(least_squares(&[row(1.3, 2.2)]).is_none());
    }

    #[test]
    fn a_group_that_scatters_more_makes_only_its_own_unknown_uncertain() {
        // Two means: one group of ±0.1, one of ±2.3.
        let mean = |group: usize, value: f64| Row {
            terms: [f64::from(group == 0), f64::from(group == 1)],
            value,
            group,
            spread: 1.0,
        };
        let rows = [
            mean(0, 5.1),
            mean(0, 4.9),
            mean(0, 5.1),
            mean(0, 4.9),
            mean(1, 9.3),
            mean(1, 4.7),
            mean(1, 9.3),
            mean(1, 4.7),
        ];
        let [first, second] = least_squares(&rows).unwrap().unknowns;
        // Sample standard deviation 0.1·√(4/3) over √4.
        assert!((first.standard_error - 0.1 / libm::sqrt(3.0)).abs() < 1e-12);
        assert!((second.standard_error - 2.3 / libm::sqrt(3.0)).abs() < 1e-12);
        assert!((first.freedom - 3.0).abs() < 1e-9);
    }
}
