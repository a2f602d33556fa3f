//! This file claims that the weak form holds on exact motion, and tests the transformations of
//! signals.

use super::*;
use rigproof_spec::effect::Mechanism;

use crate::filter::rms;
use crate::plants::joint::recorded::{NOMINAL, exact_axis};
use crate::plants::joint::run::JointRun;
use crate::regression::reduced_target;
use crate::signals::{numerov, second_difference, shifted};

/// The residual of the usable windows relative to the effort, when the nominal model is complete.
fn relative_residual(run: &JointRun) -> f64 {
    let mut laws = NOMINAL.to_vec();
    laws.push((Mechanism::DryOffset, &[1.73]));
    let problem = Problem::new(run, run.windows_of(0.077));
    let terms: Vec<Term> = laws
        .iter()
        .filter_map(|(mechanism, parameters)| {
            problem.nominal_term(&Effect {
                cause: Cause::of(*mechanism),
                parameters: parameters.to_vec(),
                unknown: false,
                onset_s: None,
            })
        })
        .collect();
    assert_eq!(terms.len(), 3);
    let residual = reduced_target(&problem, &terms.iter().collect::<Vec<_>>()).raw;
    // The exact motion has a known direction everywhere. Windows that hold a reversal are left out
    // here.
    let senses: Vec<f64> = run.motion.iter().map(|now| now.sense).collect();
    let half = problem.windows.bump.len() / 2 + 2;
    let away: Vec<f64> = residual
        .iter()
        .zip(&problem.windows.centres)
        .filter(|(_, c)| {
            senses[**c + 1 - half..**c + half]
                .iter()
                .all(|s| *s != 0.0 && *s == senses[**c])
        })
        .map(|(r, _)| *r)
        .collect();
    assert!(away.len() > 100, "{} windows", away.len());
    rms(&away) / rms(&run.effort)
}

#[test]
fn the_weak_form_holds_on_exact_motion_and_only_with_the_right_drive() {
    let mut laws = NOMINAL.to_vec();
    laws.push((Mechanism::DryOffset, &[1.73]));
    // Under a held drive the acceleration jumps at every sample, which costs Numerov's weights an
    // order.
    for (held, most) in [(true, 1e-5), (false, 1e-6)] {
        let mut run = exact_axis(&laws, 5300, held);
        let right = relative_residual(&run);
        assert!(right < most, "held {held}: {right:e}");
        run.held = !held;
        let wrong = relative_residual(&run);
        assert!(
            wrong > 100.0 * right,
            "held {held}: {wrong:e} against {right:e}"
        );
    }
}

#[test]
fn numerov_averages_a_fourth_order_polynomial_as_its_double_integral_does() {
    // f = t²; its double integral t⁴/12 has the second difference t² + 1/6.
    let f: Vec<f64> = (0..9).map(|k| (k as f64 + 0.37).powi(2)).collect();
    let twice: Vec<f64> = (0..9).map(|k| (k as f64 + 0.37).powi(4) / 12.0).collect();
    let (seen, accelerated) = (numerov(&f), second_difference(&twice, 1.0));
    for k in 1..8 {
        assert!((seen[k] - accelerated[k]).abs() < 1e-11, "{k}");
    }
}

#[test]
fn a_shifted_signal_reads_between_its_samples_and_holds_its_ends() {
    let signal = [0.3, 1.7, -2.9, 4.1];
    let ahead = shifted(&signal, 0.25);
    let expected = [0.65, 0.55, -1.15, 4.1];
    for (a, e) in ahead.iter().zip(expected) {
        assert!((a - e).abs() < 1e-12, "{a} {e}");
    }
}
