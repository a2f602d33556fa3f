//! This file draws the residual effort over time, before and after, and where its energy lies.

use rigproof_diagnose::Curves;
use rigproof_diagnose::report::Report;

use super::before_after::range;
use super::panel::Panel;
use super::scale::Scale;
use super::{NAMED, NOISE, NOMINAL, heading, legend, page, shares};
use crate::text::number::significant;

/// The picture as SVG.
pub fn residual(rig: &str, report: &Report, curves: &Curves) -> String {
    let (first, last) = range(curves.window_time_s.iter().copied());
    let time = Scale::exact(first, last, "time from the first sample", "s");
    let band = 1.96 * curves.floor;
    let residuals = curves.residual_before.iter().chain(&curves.residual_after);
    let (low, high) = range(residuals.copied().chain([-band, band]));
    let effort = Scale::around(low, high, "residual effort", &curves.residual_unit);
    let mut upper = Panel::new(92.0, 280.0, time, effort);
    upper.curve(&curves.window_time_s, &curves.residual_before, NOMINAL, 1.0);
    upper.curve(&curves.window_time_s, &curves.residual_after, NAMED, 1.0);
    upper.band(-band, band, NOISE);

    let figures = report.floor.as_ref().map_or_else(String::new, |floor| {
        format!(
            ": from {} to {} times what sensor noise predicts",
            significant(floor.ratio_before, 3),
            significant(floor.ratio_after, 3)
        )
    });
    let subtitle = format!("{rig}, residual of the windows on the fitted part{figures}");
    let height = 470.0 + shares::height(report);
    let page = page(height, &heading(report), &subtitle);
    let page = legend(
        page,
        76.0,
        &[
            ("nominal model, its unknowns fitted", NOMINAL, 2.0),
            ("with what is named", NAMED, 2.0),
            ("95 % of sensor noise alone", NOISE, 7.0),
        ],
    );
    page.add(upper.finish("residual"))
        .add(shares::chart(430.0, report, curves))
        .to_string()
}
