//! This file compares the estimators of velocity on motions whose velocity is known (decision 0073).

use rayon::prelude::*;
use rigproof_model::trial::LINES;
use rigproof_spec::layout::Layout;
use rigproof_spec::methods::Method;

use crate::impl_velocity::candidates::{Candidate, Estimator};
use crate::impl_velocity::motions::{Motion, SAMPLE_S, motions, trial};
use crate::impl_velocity::score::{Score, resolution_rad, score};

/// The best of each kind by root mean square on seeds 1000 and 1001 at 100 000 counts; of the windows that adapt, what decision 0073 chose.
const FINALISTS: [Candidate; 5] = [
    Candidate::Difference,
    Candidate::Window(6),
    Candidate::LowPass(0.7),
    Candidate::FadingMemory(0.5),
    CHOSEN,
];

const CHOSEN: Candidate = Candidate::AdaptiveWindow(8, 1.0);

/// Counts a turn: the part number's, §4.6's and §5.3.1's.
const COUNTS: [f64; 3] = [20_000.0, 100_000.0, 1_000_000.0];

/// Every candidate that was compared.
fn grid() -> Vec<Candidate> {
    let mut grid = vec![Candidate::Difference];
    grid.extend([2, 3, 4, 6, 8, 12, 16].map(Candidate::Window));
    grid.extend([0.5, 0.7, 0.8, 0.85, 0.9].map(Candidate::LowPass));
    grid.extend([0.5, 0.6, 0.7, 0.75, 0.8, 0.85, 0.9].map(Candidate::FadingMemory));
    for longest in [4, 6, 8, 12, 16, 24] {
        grid.extend([0.5, 0.75, 1.0, 1.5].map(|margin| Candidate::AdaptiveWindow(longest, margin)));
    }
    grid
}

/// How many seeds a comparison takes.
fn seeds() -> u64 {
    std::env::var("RIGPROOF_CAMPAIGN").map_or(1, |text| text.parse().unwrap())
}

fn compare(candidates: &[Candidate], counts: f64, motions: &[Motion]) -> Vec<Score> {
    println!("{counts} counts a turn");
    let scores: Vec<Score> = candidates
        .par_iter()
        .map(|candidate| score(*candidate, counts, motions))
        .collect();
    for (candidate, score) in candidates.iter().zip(&scores) {
        println!("  {:25} {score}", format!("{candidate:?}"));
    }
    scores
}

fn all_motions(first: u64) -> Vec<Motion> {
    (first..first + seeds())
        .into_par_iter()
        .flat_map(motions)
        .collect()
}

/// The choice itself: `RIGPROOF_CAMPAIGN=2` compares the whole grid on seeds 1000 and 1001.
#[test]
fn one_window_of_eight_and_one_count_serves_every_encoder() {
    let motions = all_motions(1000);
    let candidates = if seeds() > 1 {
        grid()
    } else {
        FINALISTS.to_vec()
    };
    for counts in COUNTS {
        let scores = compare(&candidates, counts, &motions);
        let chosen = candidates
            .iter()
            .position(|candidate| *candidate == CHOSEN)
            .unwrap();
        let least = scores
            .iter()
            .map(|score| score.rms)
            .fold(f64::INFINITY, f64::min);
        assert!(scores[chosen].rms <= 1.5 * least);
    }
}

/// What is reported: seeds that nothing was chosen on.
#[test]
fn the_chosen_estimator_errs_little_and_stands_still_at_rest() {
    let motions = all_motions(0);
    for counts in COUNTS {
        let scores = compare(&FINALISTS, counts, &motions);
        let [difference, .., chosen] = scores.as_slice() else {
            unreachable!()
        };
        assert!(chosen.restless == 0.0 && chosen.resting > 1000.0);
        assert!(chosen.wrong_sign < 0.6 * difference.wrong_sign);
        assert!(
            scores
                .iter()
                .all(|other| chosen.rms <= 1.1 * other.rms || counts > 5e5)
        );
    }
}

/// The same with the estimator between rig and controller: trials of the two methods of §6.2 and §6.3.
#[test]
fn inside_the_loop_the_chosen_estimator_has_the_least_worst_error_of_all_that_filter() {
    let counts = COUNTS[1];
    let mut scores = Vec::new();
    for candidate in FINALISTS {
        let motions: Vec<Motion> = [Layout::ThreeBrake, Layout::FourBrake]
            .into_par_iter()
            .flat_map(|layout| {
                (0..LINES.len())
                    .into_par_iter()
                    .map(move |line| (layout, line))
            })
            .flat_map(|(layout, line)| {
                let methods = [
                    Method::Sdof,
                    Method::ProportionalLow,
                    Method::ProportionalHigh,
                ];
                methods.map(|method| in_the_loop(candidate, counts, layout, line, method))
            })
            .collect();
        let score = score(candidate, counts, &motions);
        println!("  {:25} {score}", format!("{candidate:?}"));
        scores.push(score);
    }
    let [difference, filters @ .., chosen] = scores.as_slice() else {
        unreachable!()
    };
    assert!(chosen.restless == 0.0 && chosen.rms < 0.5 * difference.rms);
    for other in filters {
        assert!(chosen.rms <= 1.25 * other.rms && chosen.worst < other.worst);
        assert!(chosen.wrong_sign <= 1.05 * other.wrong_sign);
    }
}

fn in_the_loop(
    candidate: Candidate,
    counts: f64,
    layout: Layout,
    line: usize,
    method: Method,
) -> Motion {
    let resolution_rad = resolution_rad(counts);
    let mut estimators = [Estimator::new(candidate), Estimator::new(candidate)];
    let mut estimate = |theta_rad: [f64; 2], _: [f64; 2]| {
        let [a, b] = &mut estimators;
        let rate = |estimator: &mut Estimator, angle_rad: f64| {
            let count = (angle_rad / resolution_rad).round() as i64;
            estimator.update(count) * resolution_rad / SAMPLE_S
        };
        [rate(a, theta_rad[0]), rate(b, theta_rad[1])]
    };
    trial(layout, line, method, 7, &mut estimate)
}
