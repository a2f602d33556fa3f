//! This file draws the residual effort over time, before and after, and where its energy lies.

use rigproof_diagnose::Curves;
use rigproof_diagnose::report::Report;

use super::before_after::range;
use super::panel::Panel;
use super::scale::Scale;
use super::{LEFT, NAMED, NOISE, NOMINAL, heading, legend, page, shares, text};
use crate::text::number::significant;

/// Half of the second panel's range, in standard deviations of the noise or of what is left.
const REACH: f64 = 8.0;

const CLOSER: &str = "The same closer. Windows at rest or across a reversal may reach beyond; they do not count in the naming.";

/// The picture as SVG.
pub fn residual(rig: &str, report: &Report, curves: &Curves) -> String {
    let time = || {
        let (first, last) = range(curves.window_time_s.iter().copied());
        Scale::exact(first, last, "time from the first sample", "s")
    };
    let effort = |low, high| Scale::around(low, high, "residual effort", &curves.residual_unit);
    let band = 1.96 * curves.floor;
    let residuals = curves.residual_before.iter().chain(&curves.residual_after);
    let (low, high) = range(residuals.copied().chain([-band, band]));
    let mut whole = Panel::new(92.0, 220.0, time(), effort(low, high));
    whole.band(-band, band, NOISE);
    whole.curve(&curves.window_time_s, &curves.residual_before, NOMINAL, 1.0);
    whole.curve(&curves.window_time_s, &curves.residual_after, NAMED, 1.0);

    let left = report
        .floor
        .as_ref()
        .map_or(0.0, |floor| floor.measured_after);
    let reach = REACH * curves.floor.max(0.5 * left);
    let mut closer = Panel::new(388.0, 150.0, time(), effort(-reach, reach));
    closer.band(-band, band, NOISE);
    closer.curve(&curves.window_time_s, &curves.residual_after, NAMED, 1.0);

    let figures = report.floor.as_ref().map_or_else(String::new, |floor| {
        format!(
            ": from {} to {} times what sensor noise predicts",
            significant(floor.ratio_before, 3),
            significant(floor.ratio_after, 3)
        )
    });
    let subtitle = format!("{rig}, residual of the windows on the fitted part{figures}");
    let page = page(604.0 + shares::height(report), &heading(report), &subtitle);
    let page = legend(
        page,
        76.0,
        &[
            ("nominal model, its unknowns fitted", NOMINAL, 2.0),
            ("with what is named", NAMED, 2.0),
            ("95 % of sensor noise alone", NOISE, 7.0),
        ],
    );
    page.add(whole.finish("residual"))
        .add(text(LEFT, 376.0, CLOSER))
        .add(closer.finish("closer"))
        .add(shares::chart(602.0, report, curves))
        .to_string()
}
