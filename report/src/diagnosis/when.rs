//! This file shows when the old model fails, and what the new one would leave without one of its names.

use maud::{Markup, html};
use rigproof_diagnose::Curves;

use super::{counted, place};
use crate::chart::{Axis, Chart, Curve, Span};
use crate::number::percent;
use crate::what_if::WhatIf;

/// Stretches of the time line.
const STRETCHES: usize = 120;
/// A stretch is unexplained when its residual is so many times the noise.
const UNEXPLAINED: f64 = 2.0;
/// Its anchor.
const ID: &str = "time-line";

/// How many windows make a stretch.
fn stretch(curves: &Curves) -> usize {
    curves.window_time_s.len().div_ceil(STRETCHES).max(1)
}

/// What the new model would leave in each stretch without one of its names; nothing where none is.
pub fn what_if(curves: &Curves) -> Option<WhatIf> {
    WhatIf::of(curves, stretch(curves), 1)
}

/// The time line, with a switch for each name; nothing where there are no windows.
pub fn body(curves: &Curves, what_if: Option<&WhatIf>, charts: &mut Vec<Chart>) -> Option<Markup> {
    if curves.window_time_s.is_empty() {
        return None;
    }
    let (mut chart, caption) = time_line(curves);
    chart.what_if = what_if.cloned();
    let switches = chart.what_if.as_ref().map(|own| own.switches(ID));
    Some(
        html! { @if let Some(switches) = switches { (switches) } (place(charts, chart, &caption)) },
    )
}

/// How many times the noise the residual is, stretch by stretch.
fn time_line(curves: &Curves) -> (Chart, Markup) {
    let size = stretch(curves);
    let over = |values: &[f64]| -> Vec<f64> {
        let rms = |part: &[f64]| {
            let finite = part.iter().filter(|v| v.is_finite());
            let (count, sum) =
                finite.fold((0.0, 0.0), |(count, sum), v| (count + 1.0, sum + v * v));
            if count > 0.0 {
                (sum / count).sqrt() / curves.floor
            } else {
                f64::NAN
            }
        };
        values.chunks(size).map(rms).collect()
    };
    let begins: Vec<f64> = curves
        .window_time_s
        .chunks(size)
        .filter_map(|part| part.first().copied())
        .collect();
    let (before, after) = (
        over(&counted(curves, &curves.residual_before)),
        over(&counted(curves, &curves.residual_after)),
    );
    let last = curves.window_time_s.last().copied().unwrap_or(0.0);
    let y = Axis {
        label: "left over ÷ noise".to_owned(),
        unit: "1".to_owned(),
    };
    let spans = unexplained(&begins, last, &before);
    let marked = spans.iter().map(|span| span.to - span.from).sum::<f64>();
    let whole = last - begins.first().copied().unwrap_or(0.0);
    let curves = vec![
        Curve::line("old model", "old", &before),
        Curve::line("new model", "new", &after),
    ];
    let mut chart = Chart::over_time(ID, "When", y, &begins, curves);
    chart.spans = spans;
    chart.height = 220;
    chart.log_y = true;
    chart.band = Some([0.0, 1.0]);
    let caption = html! {
        "What is left over, in units of what the sensors' noise alone would leave (green up to 1), on a logarithmic scale. Marked in yellow: stretches that the old model does not explain, "
        (percent(if whole > 0.0 { marked / whole } else { 0.0 })) " of the fitted part. Gaps: at rest and where the motion turns back nothing can be told."
    };
    (chart, caption)
}

/// Neighbouring stretches that are unexplained, joined.
fn unexplained(begins: &[f64], last: f64, ratios: &[f64]) -> Vec<Span> {
    let mut spans: Vec<Span> = Vec::new();
    let ends = begins.iter().skip(1).copied().chain([last]);
    for ((from, to), ratio) in begins.iter().copied().zip(ends).zip(ratios) {
        if ratio.is_nan() || *ratio <= UNEXPLAINED {
            continue;
        }
        match spans.last_mut() {
            Some(span) if span.to >= from => span.to = to,
            _ => spans.push(Span {
                from,
                to,
                role: "mark",
            }),
        }
    }
    spans
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbouring_stretches_are_one() {
        let spans = unexplained(&[0.0, 1.5, 2.5, 4.0], 5.25, &[2.5, 3.1, 0.9, f64::NAN]);
        assert_eq!(
            spans,
            [Span {
                from: 0.0,
                to: 2.5,
                role: "mark"
            }]
        );
        let last = unexplained(&[0.0, 1.5], 5.25, &[0.7, 2.6]);
        assert_eq!(last[0].to, 5.25);
    }
}
