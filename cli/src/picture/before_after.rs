//! This file draws the held-out part: recorded, nominal model, model with what is named, and the two errors.

use rigproof_diagnose::Curves;
use rigproof_diagnose::report::{FitReport, Report};

use super::panel::Panel;
use super::scale::Scale;
use super::{NAMED, NOMINAL, RECORDED, heading, legend, page};
use crate::text::number::significant;

/// The picture of a diagnosis as SVG.
pub fn before_after(rig: &str, report: &Report, curves: &Curves) -> String {
    let subtitle = format!("{rig}, held-out part{}", figures(report.fit.as_ref()));
    let names = ["nominal model, its unknowns fitted", "with what is named"];
    overlay((&heading(report), &subtitle), names, curves)
}

/// A recording and two models over it, and the error of each, as SVG.
pub fn overlay((title, subtitle): (&str, &str), [old, new]: [&str; 2], curves: &Curves) -> String {
    let time = || {
        let (first, last) = range(curves.time_s.iter().copied());
        Scale::exact(first, last, "time from the first sample", "s")
    };
    let (low, high) = range(curves.recorded.iter().copied());
    // A model that runs away must not flatten what was recorded.
    let room = (high - low).max(f64::MIN_POSITIVE);
    let models = || curves.before.iter().chain(&curves.after).copied();
    let (model_low, model_high) = range(models().chain([low, high]));
    let values = Scale::around(
        model_low.max(low - room),
        model_high.min(high + room),
        curves.output,
        &curves.unit,
    );
    let mut upper = Panel::new(92.0, 300.0, time(), values);
    upper.curve(&curves.time_s, &curves.recorded, RECORDED, 4.0);
    upper.curve(&curves.time_s, &curves.before, NOMINAL, 1.3);
    upper.curve(&curves.time_s, &curves.after, NAMED, 1.3);

    let before = difference(&curves.before, &curves.recorded);
    let after = difference(&curves.after, &curves.recorded);
    let (low, high) = range(before.iter().chain(&after).copied());
    let errors = Scale::around(
        low.max(-2.0 * room),
        high.min(2.0 * room),
        "error",
        &curves.unit,
    );
    let mut lower = Panel::new(452.0, 180.0, time(), errors);
    lower.curve(&curves.time_s, &before, NOMINAL, 1.0);
    lower.curve(&curves.time_s, &after, NAMED, 1.0);

    let page = page(680.0, title, subtitle);
    let page = legend(
        page,
        76.0,
        &[
            ("recorded", RECORDED, 4.0),
            (old, NOMINAL, 2.0),
            (new, NAMED, 2.0),
        ],
    );
    page.add(upper.finish("output"))
        .add(lower.finish("error"))
        .to_string()
}

fn figures(fit: Option<&FitReport>) -> String {
    let errors = fit.and_then(|fit| fit.held_out);
    errors.map_or_else(String::new, |errors| {
        format!(
            ": NRMSE {} % with the nominal model, {} % with what is named",
            significant(errors.nrmse_before, 3),
            significant(errors.nrmse_after, 3)
        )
    })
}

fn difference(simulated: &[f64], recorded: &[f64]) -> Vec<f64> {
    let pairs = simulated.iter().zip(recorded);
    pairs
        .map(|(simulated, recorded)| simulated - recorded)
        .collect()
}

/// The least and the greatest finite value; 0 and 0 where there is none.
pub fn range(values: impl IntoIterator<Item = f64>) -> (f64, f64) {
    let finite = values.into_iter().filter(|value| value.is_finite());
    let range = finite.fold(None, |range, value| match range {
        None => Some((value, value)),
        Some((low, high)) => Some((value.min(low), value.max(high))),
    });
    range.unwrap_or((0.0, 0.0))
}
