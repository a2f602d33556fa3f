//! This file says that the metrics compute what the page prints: against SciPy, against sums by hand, and by their scaling.

use core::f64::consts::PI;

use crate::budget::assert_within_budget;
use proptest::prelude::*;
use proptest::test_runner::FileFailurePersistence;
use rigproof_model::ModelError;
use rigproof_model::control::path::{Line, Path};
use rigproof_model::metrics::{
    Butterworth, acceleration, average_magnitude, average_tip_force, dft_magnitudes, dft_sum,
    path_error, path_length, six_step_difference, smoothness, step_lengths,
};
use rigproof_spec::methods::SAMPLE_STEP_S;
use rigproof_tests::cases;

// Every reference number of this file is the output of SciPy 1.17.1 with NumPy 2.4.6:
//
//   import numpy as np
//   from scipy.signal import butter, sosfilt, sosfilt_zi, sosfiltfilt
//   sos = butter(4, 25, fs=1000, output="sos"); zi = sosfilt_zi(sos); T = 0.001
//   k = np.arange(47); x = ((k*k*37 + 11*k) % 101)/101 - 0.47
//   BOTH_WAYS = sosfiltfilt(sos, x)
//   ONE_WAY = sosfilt(sos, x, zi=zi*x[0])[0][::6]
//   OTHER_CUTOFF = sosfiltfilt(butter(4, 3.7, fs=83, output="sos"), x)[::5]
//   k = np.arange(307)
//   px = 0.00041*k + 0.003*(((k*k*37 + 11*k) % 101)/101 - 0.47)
//   py = 0.38 - 0.00013*k + 0.002*(((k*k*53 + 7*k) % 97)/97 - 0.51)
//   d = lambda s: (s[6:] - s[:-6])/(6*T); f = lambda s: sosfiltfilt(sos, s)
//   ax, ay = f(d(f(d(px)))), f(d(f(d(py)))); A_X, A_Y = ax[::59], ay[::59]
//   a = np.hypot(ax, ay); N = len(a); A = np.abs(np.fft.fft(a))
//   SMOOTHNESS = sum(A[:N//2]*np.arange(N//2)/(N*T))
//   TIP_FORCE = np.mean(np.hypot(f(1000*(px - 0.05)), f(700*(py - 0.37))))
//   g = lambda s: sosfilt(sos, s, zi=zi*s[0])[0]; SMOOTHNESS_ONE_WAY: as SMOOTHNESS with g for f
const BOTH_WAYS: [f64; 47] = [
    -0.49196091014144094,
    -0.44546920757714115,
    -0.397924292971537,
    -0.34995214372694095,
    -0.3021682749521721,
    -0.2551629743647198,
    -0.20948837722300034,
    -0.16564777133699377,
    -0.12408736790112776,
    -0.08519061954799566,
    -0.049275018680756275,
    -0.01659118443976888,
    0.012676048711967987,
    0.038404900065134175,
    0.060532672411633175,
    0.07905094355489889,
    0.09400026931664728,
    0.1054646638366118,
    0.11356603069078422,
    0.11845864199934612,
    0.12032371913573271,
    0.11936415412510364,
    0.11579940828507873,
    0.10986062878407643,
    0.10178604095187177,
    0.09181669890238027,
    0.08019269199355754,
    0.06714990421675868,
    0.05291741382788724,
    0.037715595590666104,
    0.021754931691432076,
    0.005235454016489488,
    -0.011653334807310787,
    -0.02873224636761861,
    -0.04583206861242203,
    -0.06279324254368027,
    -0.07946566222332513,
    -0.095708689962846,
    -0.11139146075612784,
    -0.1263935172565188,
    -0.14060577405532343,
    -0.15393177615192583,
    -0.16628919657954738,
    -0.17761149833979364,
    -0.18784965379072083,
    -0.19697377581261688,
    -0.20497448663397622,
];
const ONE_WAY: [f64; 8] = [
    -0.46999999999999603,
    -0.46147068860291895,
    -0.3769579579254238,
    -0.20020420606661615,
    -0.03870177501366727,
    0.06117425713667642,
    0.08407929343414103,
    0.054976394531724246,
];
const OTHER_CUTOFF: [f64; 10] = [
    -0.4909087520878691,
    -0.02820146152190153,
    0.11231586928862078,
    0.051074547142564174,
    0.01027094772453022,
    0.014341485808139204,
    0.029406033025453634,
    0.018153193420045968,
    -0.0784152604020011,
    -0.2593939479337278,
];
const A_X: [f64; 5] = [
    -40.72751817264183,
    -4.531491009146479,
    -0.9318700240636735,
    2.0852572308285797,
    2.7114290219839607,
];
const A_Y: [f64; 5] = [
    -2.2819460293947715,
    0.5773005562664298,
    -0.8422847620769985,
    -1.8191297552356755,
    -0.7580832793468611,
];
const SMOOTHNESS: f64 = 905243.4487335559;
const SMOOTHNESS_ONE_WAY: f64 = 148947.89014807757;
const TIP_FORCE: f64 = 34.28041016187589;

/// A number between 0 and 1 that every program gets from the same integers.
fn scatter(k: usize, square: usize, linear: usize, modulus: usize) -> f64 {
    ((k * k * square + linear * k) % modulus) as f64 / modulus as f64
}

fn samples() -> Vec<f64> {
    (0..47).map(|k| scatter(k, 37, 11, 101) - 0.47).collect()
}

fn positions_m() -> Vec<[f64; 2]> {
    (0..307)
        .map(|k| {
            let x = 0.00041 * k as f64 + 0.003 * (scatter(k, 37, 11, 101) - 0.47);
            let y = 0.38 - 0.00013 * k as f64 + 0.002 * (scatter(k, 53, 7, 97) - 0.51);
            [x, y]
        })
        .collect()
}

/// Differences of two computations of one record.
fn differences(ours: impl IntoIterator<Item = f64>, reference: &[f64]) -> Vec<f64> {
    let ours: Vec<f64> = ours.into_iter().collect();
    assert_eq!(ours.len(), reference.len());
    ours.iter()
        .zip(reference)
        .map(|(ours, reference)| (ours - reference).abs())
        .collect()
}

#[test]
fn the_filter_agrees_with_scipy() {
    let filter = Butterworth::low_pass(25.0, 0.001).unwrap();
    let other = Butterworth::low_pass(3.7, 1.0 / 83.0).unwrap();
    let slow = other.both_ways(&samples()).unwrap();
    let mut all = differences(filter.both_ways(&samples()).unwrap(), &BOTH_WAYS);
    all.extend(differences(
        filter.one_way(&samples()).into_iter().step_by(6),
        &ONE_WAY,
    ));
    all.extend(differences(slow.into_iter().step_by(5), &OTHER_CUTOFF));
    assert_within_budget("metric_filter_against_scipy", all);
}

#[test]
fn both_ways_leaves_half_a_sine_at_the_cutoff_and_delays_nothing() {
    // One pass leaves 1/√2 of a sine at the cut-off, two passes a half; the phase comes back.
    let filter = Butterworth::low_pass(25.0, 0.001).unwrap();
    let wave = |k: usize| libm::sin(2.0 * PI * 25.0 * 0.001 * k as f64 + 0.3);
    let record: Vec<f64> = (0..2000).map(wave).collect();
    let filtered = filter.both_ways(&record).unwrap();
    for k in 900..1100 {
        assert!((filtered[k] - 0.5 * record[k]).abs() < 1e-9, "{k}");
    }
    let late = filter.one_way(&record);
    let peak = late[900..1100]
        .iter()
        .fold(0.0_f64, |peak, y| peak.max(y.abs()));
    assert!((peak - 0.5_f64.sqrt()).abs() < 1e-3, "{peak}");
    assert!((900..1100).any(|k| (late[k] - 0.5_f64.sqrt() * record[k]).abs() > 0.5));
}

//= thesis (6.17) test
//= thesis (6.18) test
#[test]
fn acceleration_agrees_with_scipy() {
    let (x, y): (Vec<f64>, Vec<f64>) = acceleration(&positions_m(), SAMPLE_STEP_S)
        .unwrap()
        .into_iter()
        .map(|[x, y]| (x, y))
        .unzip();
    assert_eq!(x.len(), 307 - 12);
    let mut all = differences(x.into_iter().step_by(59), &A_X);
    all.extend(differences(y.into_iter().step_by(59), &A_Y));
    assert_within_budget("metric_acceleration_against_scipy", all);
}

//= thesis (6.19) test
//= thesis (6.20) test
#[test]
fn the_dft_sum_agrees_with_numpy() {
    let ours = smoothness(&positions_m(), SAMPLE_STEP_S).unwrap();
    assert_within_budget(
        "metric_sums_against_scipy",
        vec![(ours / SMOOTHNESS - 1.0).abs()],
    );
}

//= thesis (6.16b) test
#[test]
fn the_average_force_agrees_with_scipy() {
    let forces_n: Vec<[f64; 2]> = positions_m()
        .into_iter()
        .map(|[x, y]| [1000.0 * (x - 0.05), 700.0 * (y - 0.37)])
        .collect();
    let ours = average_tip_force(&forces_n, SAMPLE_STEP_S).unwrap();
    assert_within_budget(
        "metric_sums_against_scipy",
        vec![(ours / TIP_FORCE - 1.0).abs()],
    );
}

#[test]
fn filtering_one_way_gives_another_smoothness() {
    // The text does not say which way; on a scattered record the ends alone make six times the sum.
    let ratio = SMOOTHNESS / SMOOTHNESS_ONE_WAY;
    assert!((ratio - 6.08_f64).abs() < 0.005, "{ratio}");
    let filter = Butterworth::low_pass(25.0, SAMPLE_STEP_S).unwrap();
    let once = |samples: Vec<f64>| filter.one_way(&six_step_difference(&samples, SAMPLE_STEP_S));
    let x = once(once(positions_m().iter().map(|[x, _]| *x).collect()));
    let y = once(once(positions_m().iter().map(|[_, y]| *y).collect()));
    let a: Vec<f64> = x.iter().zip(&y).map(|(x, y)| libm::hypot(*x, *y)).collect();
    let ours = dft_sum(&a, SAMPLE_STEP_S).unwrap();
    assert_within_budget(
        "metric_sums_against_scipy",
        vec![(ours / SMOOTHNESS_ONE_WAY - 1.0).abs()],
    );
}

#[test]
fn the_difference_is_exact_on_a_parabola_and_drops_six_samples() {
    // A balanced difference has no error on a parabola: 2·1.7·t - 0.9 at the middle sample.
    let record: Vec<f64> = (0..41)
        .map(|k| 0.01 * k as f64)
        .map(|t| 1.7 * t * t - 0.9 * t)
        .collect();
    let slopes = six_step_difference(&record, 0.01);
    assert_eq!(slopes.len(), 35);
    for (k, slope) in slopes.iter().enumerate() {
        let t = 0.01 * (k + 3) as f64;
        assert!((slope - (3.4 * t - 0.9)).abs() < 1e-12, "{k}: {slope}");
    }
    assert!(six_step_difference(&record[..6], 0.01).is_empty());
}

//= thesis (6.14) test
//= thesis (6.15) test
//= thesis (6.16a) test
#[test]
fn the_path_error_is_weighted_by_the_way() {
    // Path y = 0.3. Chords around samples 2 to 4: (0.02, 0.01), (0.03, 0.02), (0.05, -0.04).
    let line = Line::through([-0.7, 0.3], [0.9, 0.3]).unwrap();
    let tips_m = [
        [0.0, 0.31],
        [0.01, 0.32],
        [0.02, 0.32],
        [0.04, 0.34],
        [0.07, 0.28],
    ];
    let [l_2, l_3, l_4] = [
        0.5 * 5.0_f64.sqrt(),
        0.5 * 13.0_f64.sqrt(),
        0.5 * 41.0_f64.sqrt(),
    ];
    let expected_m = 0.01 * (2.0 * l_2 + 2.0 * l_3 + 4.0 * l_4) / (l_2 + l_3 + l_4);
    assert!((path_error(&line, &tips_m).unwrap() - expected_m).abs() < 1e-15);
    let by_hand = [0.01 * l_2, 0.01 * l_3, 0.01 * l_4];
    assert!(
        differences(step_lengths(&tips_m), &by_hand)
            .iter()
            .all(|off| *off < 1e-15)
    );
    assert!((path_length(&tips_m) - 0.01 * (l_2 + l_3 + l_4)).abs() < 1e-15);
}

#[test]
fn a_pause_does_not_count_for_the_path_error() {
    let line = Line::through([-0.7, 0.3], [0.9, 0.3]).unwrap();
    let moving: Vec<[f64; 2]> = (0..200)
        .map(|k| [0.001 * k as f64, 0.3 + 1e-5 * k as f64])
        .collect();
    let mut paused = moving.clone();
    let stop = paused[120];
    paused.splice(120..120, std::iter::repeat_n(stop, 5000));
    let (with, without) = (
        path_error(&line, &paused).unwrap(),
        path_error(&line, &moving).unwrap(),
    );
    assert!(
        (with / without - 1.0).abs() < 1e-3,
        "{with} against {without}"
    );
}

#[test]
fn the_dft_sum_grows_with_the_length_to_the_power_one_and_a_half() {
    // Scatter without memory; four times as long should give 4^1.5 = 8 times the sum.
    let mut state = 0x9E37_79B9_u64;
    let mut noise = || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1u64 << 53) as f64 - 0.5
    };
    let long: Vec<f64> = (0..32_768).map(|_| noise()).collect();
    let sum = |count: usize| dft_sum(&long[..count], SAMPLE_STEP_S).unwrap();
    for (short, expected) in [(8192, 8.0), (2048, 64.0)] {
        let ratio = sum(32_768) / sum(short);
        assert!(
            (ratio / expected - 1.0_f64).abs() < 0.05,
            "{short}: {ratio}"
        );
    }
}

#[test]
fn the_dft_sum_follows_the_unit_of_length() {
    let in_cm: Vec<[f64; 2]> = positions_m()
        .into_iter()
        .map(|[x, y]| [100.0 * x, 100.0 * y])
        .collect();
    let ratio = smoothness(&in_cm, SAMPLE_STEP_S).unwrap() / SMOOTHNESS;
    assert!((ratio / 100.0 - 1.0).abs() < 1e-12, "{ratio}");
}

#[test]
fn the_printed_dft_sum_is_complex() {
    // Without the magnitude the sum (6.20) has an imaginary part as large as its real part.
    let a = samples();
    let (mut real, mut imaginary) = (0.0, 0.0);
    for n in 0..a.len() / 2 {
        for (k, a_k) in a.iter().enumerate() {
            let (sine, cosine) = libm::sincos(2.0 * PI * (k * n) as f64 / a.len() as f64);
            real += a_k * cosine * n as f64;
            imaginary += a_k * sine * n as f64;
        }
    }
    assert!(imaginary.abs() > 0.3 * real.abs(), "{real} + {imaginary}j");
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: cases(2_000),
        failure_persistence: Some(Box::new(FileFailurePersistence::WithSource("regressions"))),
        ..ProptestConfig::default()
    })]

    #[test]
    fn the_transform_agrees_with_its_printed_sum(a in prop::collection::vec(-7.3..9.1_f64, 2..90)) {
        let fast = dft_magnitudes(&a);
        for (n, fast) in fast.iter().enumerate() {
            let (mut real, mut imaginary) = (0.0, 0.0);
            for (k, a_k) in a.iter().enumerate() {
                let (sine, cosine) = libm::sincos(2.0 * PI * ((k * n) % a.len()) as f64 / a.len() as f64);
                real += a_k * cosine;
                imaginary += a_k * sine;
            }
            prop_assert!((fast - libm::hypot(real, imaginary)).abs() < 1e-11);
        }
    }

    #[test]
    fn the_path_error_lies_between_the_nearest_and_the_farthest_sample(
        tips_m in prop::collection::vec([-0.4..0.4_f64, 0.1..0.6_f64], 3..60),
        to in [0.03..0.4_f64, 0.1..0.6_f64],
    ) {
        let line = Line::through([-0.013, 0.27], to).unwrap();
        let distances: Vec<f64> = tips_m.iter().map(|tip| line.nearest(*tip).distance_m()).collect();
        let error_m = path_error(&line, &tips_m).unwrap();
        let least = distances.iter().copied().fold(f64::INFINITY, f64::min);
        let greatest = distances.iter().copied().fold(0.0, f64::max);
        prop_assert!(least * (1.0 - 1e-12) <= error_m && error_m <= greatest * (1.0 + 1e-12));
    }
}

#[test]
fn records_that_cannot_be_measured_are_named() {
    let line = Line::through([-0.7, 0.3], [0.9, 0.31]).unwrap();
    let still = [[0.13, 0.37]; 40];
    assert!(matches!(
        path_error(&line, &still),
        Err(ModelError::PathPiece { .. })
    ));
    assert!(matches!(
        path_error(&line, &still[..2]),
        Err(ModelError::TooFew {
            count: 2,
            least: 3,
            ..
        })
    ));
    let undefined = [[0.13, 0.37], [0.14, f64::NAN], [0.17, 0.31]];
    assert!(matches!(
        path_error(&line, &undefined),
        Err(ModelError::NotFinite { .. })
    ));
    assert!(matches!(
        acceleration(&still[..27], 0.001),
        Err(ModelError::TooFew { count: 27, .. })
    ));
    assert!(matches!(
        acceleration(&still, -0.001),
        Err(ModelError::SettingRange { .. })
    ));
    assert!(matches!(
        average_tip_force(&[[0.3, f64::INFINITY]; 40], 0.001),
        Err(ModelError::NotFinite { .. })
    ));
    assert!(matches!(
        average_tip_force(&still[..15], 0.001),
        Err(ModelError::TooFew { count: 15, .. })
    ));
    assert!(matches!(
        average_magnitude(&[]),
        Err(ModelError::TooFew { count: 0, .. })
    ));
    assert!(matches!(
        dft_sum(&[0.3], 0.001),
        Err(ModelError::TooFew { count: 1, .. })
    ));
    for (cutoff_hz, step_s) in [
        (25.0, 0.02),
        (-3.0, 0.001),
        (f64::NAN, 0.001),
        (25.0, f64::NAN),
        (25.0, 0.0),
    ] {
        assert!(matches!(
            Butterworth::low_pass(cutoff_hz, step_s),
            Err(ModelError::SettingRange { .. })
        ));
    }
}

#[test]
fn refusals_say_value_unit_and_range() {
    let line = Line::through([-0.7, 0.3], [0.9, 0.31]).unwrap();
    let still = [[0.13, 0.37]; 40];
    let text = Butterworth::low_pass(612.0, 0.001).unwrap_err().to_string();
    assert_eq!(
        text,
        "the cut-off of the filter is 612 Hz; it must lie between 0 Hz and 500 Hz"
    );
    let text = acceleration(&still, -0.001).unwrap_err().to_string();
    assert_eq!(
        text,
        "the sampling period is -0.001 s; it must lie between 0.000000001 s and 1000 s"
    );
    let text = path_error(&line, &still).unwrap_err().to_string();
    assert_eq!(
        text,
        "the way of the tip is 0 m long; it must be at least 0.0000001 m: check the points and their unit"
    );
}
