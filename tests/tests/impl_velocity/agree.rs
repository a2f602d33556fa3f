//! This file says that the rig's estimator of velocity is the reference's.

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rigproof_impl::encoder::Encoder;
use rigproof_impl::velocity::{self, Velocity};
use rigproof_model::encoder::Encoder as ReferenceEncoder;
use rigproof_model::velocity::{self as reference, AdaptiveWindow};

use crate::budget::assert_within_budget;
use crate::impl_velocity::candidates::{Candidate, Estimator};
use crate::impl_velocity::motions::{SAMPLE_S, motions};

const COUNTS_PER_TURN: u32 = 100_000;

/// Counts of a trial, and walks that change pace and jump.
fn walks() -> Vec<Vec<i64>> {
    let encoder = ReferenceEncoder::new(COUNTS_PER_TURN);
    let mut walks: Vec<Vec<i64>> = motions(3)
        .into_iter()
        .flat_map(|motion| {
            [0, 1].map(|joint| {
                let count = |sample: &crate::impl_velocity::motions::Sample| {
                    encoder.count(sample.theta_rad[joint])
                };
                motion.iter().map(count).collect()
            })
        })
        .collect();
    let mut draw = Pcg64::seed_from_u64(20_031);
    for _ in 0..200 {
        let (mut at, mut pace) = (draw.random_range(-40_000.0..40_000.0), 0.0_f64);
        walks.push(
            (0..500)
                .map(|_| {
                    pace = if draw.random_bool(0.03) {
                        draw.random_range(-9.0..9.0)
                    } else {
                        pace + draw.random_range(-0.11..0.11)
                    };
                    at += pace;
                    at as i64
                })
                .collect(),
        );
    }
    walks
}

#[test]
fn both_rooms_estimate_the_same_velocity() {
    assert_eq!(velocity::LONGEST_WINDOW, reference::LONGEST_WINDOW);
    let encoder = Encoder::<f64>::new(COUNTS_PER_TURN, 0).unwrap();
    let single = Encoder::<f32>::new(COUNTS_PER_TURN, 0).unwrap();
    let (mut doubles, mut singles) = (Vec::new(), Vec::new());
    for walk in walks() {
        let mut reference =
            AdaptiveWindow::new(ReferenceEncoder::new(COUNTS_PER_TURN), SAMPLE_S, walk[0]);
        let mut subject = Velocity::new(&encoder, SAMPLE_S);
        let mut subject_f32 = Velocity::new(&single, SAMPLE_S);
        // As compared for the decision, in counts a sample and in floats.
        let mut candidate = Estimator::new(Candidate::AdaptiveWindow(8, 1.0));
        subject.restart(walk[0] as i32);
        subject_f32.restart(walk[0] as i32);
        for count in walk {
            let expected = reference.update(count);
            let of = |rate: f64| (rate - expected).abs() / expected.abs().max(1e-9);
            doubles.push(of(subject.update(count as i32)));
            singles.push(of(f64::from(subject_f32.update(count as i32))));
            let one = ReferenceEncoder::default().one_count_speed_rad_s(SAMPLE_S);
            assert!(of(candidate.update(count) * one) < 1e-12);
        }
    }
    assert!(doubles.len() > 100_000);
    assert_within_budget("velocity_impl_against_model", doubles);
    assert_within_budget("velocity_f32_against_model", singles);
}
