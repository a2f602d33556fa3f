//! This file tests intervals and non-identifiable directions against known truths.

use super::intervals::half_widths;
use super::*;
use crate::regression::covariance;

use crate::plants::joint::recorded::Noise;

#[test]
fn intervals_cover_the_truth_although_the_noise_is_uneven() {
    let blocks = Blocks {
        ranges: (0..20).map(|b| (30 * b, 30 * (b + 1))).collect(),
    };
    let mut noise = Noise::new(51);
    let columns: Vec<Vec<f64>> = (0..2)
        .map(|_| (0..600).map(|_| noise.draw()).collect())
        .collect();
    let columns: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
    let bread = covariance(&columns, &[]).unwrap();
    let (mut covered, mut naive) = (0, 0);
    let repeats = 400;
    for _ in 0..repeats {
        // Three blocks in ten are three times as loud as the noise model says.
        let error: Vec<f64> = (0..600)
            .map(|k| noise.draw() * if k / 30 % 10 < 3 { 3.1 } else { 1.1 })
            .collect();
        let moment = DVector::from_iterator(2, columns.iter().map(|c| dot(c, &error)));
        let departure = &bread * moment;
        let residual: Vec<f64> = error
            .iter()
            .enumerate()
            .map(|(k, e)| e - departure[0] * columns[0][k] - departure[1] * columns[1][k])
            .collect();
        let halves = half_widths(&columns, &[0.0; 2], &residual, &blocks).unwrap();
        covered += usize::from(departure[0].abs() < halves[0]);
        naive += usize::from(departure[0].abs() < 1.96 * bread[(0, 0)].sqrt());
    }
    // 95 % of 400 is 380, with a standard deviation of 4.4.
    assert!((370..=394).contains(&covered), "{covered} of {repeats}");
    assert!(
        naive < 320,
        "{naive} of {repeats} without the blocks' own scatter"
    );
}

#[test]
fn what_only_rounding_tells_has_no_interval_of_width_0() {
    let blocks = Blocks {
        ranges: (0..5).map(|b| (30 * b, 30 * (b + 1))).collect(),
    };
    let mut noise = Noise::new(57);
    let own: Vec<f64> = (0..150).map(|_| noise.draw()).collect();
    // The same column but for its last digits: the inverse is of rounding errors.
    for seed in 0..20 {
        let mut last = Noise::new(seed);
        let twin: Vec<f64> = own
            .iter()
            .map(|v| v * (1.0 + 1e-16 * last.draw()))
            .collect();
        let residual = vec![0.0; 150];
        let halves = half_widths(&[&own, &twin], &[0.0; 2], &residual, &blocks);
        for half in halves.unwrap_or_default() {
            assert!(half.is_nan() || half > 1.0, "{seed}: {half}");
        }
    }
}

#[test]
fn of_bouc_wen_only_the_two_products_are_determined() {
    let mut noise = Noise::new(61);
    let mut column = || -> Vec<f64> { (0..200).map(|_| noise.draw()).collect() };
    let (gamma, delta) = (column(), column());
    let beta: Vec<f64> = gamma.iter().zip(&delta).map(|(g, d)| g + d).collect();
    let names = ["beta", "gamma", "delta"];
    let null = smallest_direction(&names, &[beta, gamma.clone(), delta.clone()]).unwrap();
    let share = 1.0 / 3f64.sqrt();
    for (name, expected) in names.iter().zip([share, -share, -share]) {
        assert!((null.direction[*name] - expected).abs() < 1e-9, "{name}");
    }
    // A column that differs from the products leaves no null direction.
    assert!(smallest_direction(&names, &[column(), gamma, delta]).is_none());
}
