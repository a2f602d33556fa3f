//! This file commands in steps, which is no clipping, and clips, which is.

use super::made::{self, axis_under};
use super::{assert_fault, diagnosed};
use rigproof_diagnose::report::Verdict;

#[test]
fn a_command_in_steps_is_not_clipped() {
    let square = |t: f64| {
        if libm::sin(9.1 * t) + 0.3 * libm::sin(3.3 * t) > 0.0 {
            1.2
        } else {
            -1.2
        }
    };
    let levels = |t: f64| [0.9, -0.6, 0.3, -1.1, 0.9, 0.0, -0.8][(t / 0.31) as usize % 7];
    let on_off = |t: f64| {
        if ((t / 0.23) as usize).is_multiple_of(2) {
            1.4
        } else {
            0.0
        }
    };
    for command in [square as fn(f64) -> f64, levels, on_off] {
        // As commanded: without the noise of a meter.
        let made = axis_under(command).with("u", |x| {
            (0..x.len()).for_each(|k| x[k] = command(k as f64 / made::RATE_HZ));
        });
        let report = diagnosed(&made);
        let fault = report.fault.as_ref().map(|own| &own.reason);
        assert_ne!(report.verdict, Verdict::DataFault, "{fault:?}");
        assert!(report.effects.is_empty(), "{}", report.summary);
    }
}

#[test]
fn a_channel_that_ends_at_a_level_is_clipped() {
    for (made, name, share) in [
        (made::axis(), "u", 0.5),
        (made::bench(), "torque", 0.8),
        (made::axis(), "u", 0.3),
    ] {
        let peak = made
            .samples(name)
            .iter()
            .fold(0.0_f64, |m, x| m.max(x.abs()));
        let spoilt = made.with(name, |x| {
            x.iter_mut()
                .for_each(|x| *x = x.clamp(-share * peak, share * peak));
        });
        assert_fault(&spoilt, "effort", None, "");
    }
}
