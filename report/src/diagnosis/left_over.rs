//! This file shows what is left over of the efforts: over time, how large, and with what memory.

use maud::{Markup, html};
use rigproof_diagnose::Curves;

use super::{counted, place};
use crate::chart::{Axis, Chart, Curve, Kind};
use crate::statistics::{autocorrelation, histogram, normal};

/// Half of the histogram, in units of the noise, and its bars.
const REACH: f64 = 6.0;
const BARS: usize = 60;
/// Lags of the autocorrelation, windows.
const LAGS: usize = 80;

/// What is left over of the efforts, folded up: few act on it. Nothing where nothing was fitted.
pub fn body(curves: &Curves, charts: &mut Vec<Chart>) -> Option<Markup> {
    if curves.window_time_s.is_empty() {
        return None;
    }
    let mut figures = Vec::new();
    for (chart, caption) in residuals(curves) {
        figures.push(place(charts, chart, &caption));
    }
    Some(html! {
        details { summary { "What is left over, in detail" } @for figure in figures { (figure) } }
    })
}

fn residuals(curves: &Curves) -> Vec<(Chart, Markup)> {
    if curves.window_time_s.is_empty() {
        return Vec::new();
    }
    let before = counted(curves, &curves.residual_before);
    let after = counted(curves, &curves.residual_after);
    let effort = Axis {
        label: "left over".to_owned(),
        unit: curves.residual_unit.clone(),
    };
    let lines = vec![
        Curve::line("old model", "old", &before),
        Curve::line("new model", "new", &after),
    ];
    let mut over_time = Chart::over_time(
        "residual",
        "Effort that no model accounts for",
        effort,
        &curves.window_time_s,
        lines,
    );
    let band = 1.96 * curves.floor;
    over_time.band = Some([-band, band]);
    over_time.height = 240;
    let green = html! { "On the fitted part, averaged over short windows; gaps where the rig rests or turns back. Green: where 95 % would lie if nothing but sensor noise were left." };
    vec![
        (over_time, green),
        distribution(curves, &before, &after),
        memory(curves, &before, &after),
    ]
}

fn distribution(curves: &Curves, before: &[f64], after: &[f64]) -> (Chart, Markup) {
    let scaled = |values: &[f64]| -> Vec<f64> { values.iter().map(|v| v / curves.floor).collect() };
    let (t, before) = histogram(&scaled(before), REACH, BARS);
    let (_, after) = histogram(&scaled(after), REACH, BARS);
    let bell: Vec<f64> = t.iter().map(|x| normal(*x)).collect();
    let bars = |name, role, values: &[f64]| Curve {
        kind: Kind::Bars,
        width: 1.0,
        dashed: false,
        ..Curve::line(name, role, values)
    };
    let series = vec![
        bars("old model", "old", &before),
        bars("new model", "new", &after),
        Curve::line("noise alone", "noise", &bell),
    ];
    let x = Axis {
        label: "left over ÷ noise".to_owned(),
        unit: "1".to_owned(),
    };
    let caption = html! { "How often what is left over has which size. The closer to the green bell, the less but noise is left (the noise of a five-bar varies with its pose, so its bell is a rough one); what lies beyond ±" (REACH) " is in the outermost bars." };
    (
        still("histogram", "Distribution", (x, "density"), t, series),
        caption,
    )
}

fn memory(curves: &Curves, before: &[f64], after: &[f64]) -> (Chart, Markup) {
    let after = autocorrelation(after, LAGS);
    let before = autocorrelation(before, after.len().max(2));
    let apart = curves
        .window_time_s
        .first()
        .zip(curves.window_time_s.get(1))
        .map_or(0.0, |(a, b)| b - a);
    let t: Vec<f64> = (0..before.len().max(after.len()))
        .map(|k| k as f64 * apart)
        .collect();
    let filled = |mut values: Vec<f64>| {
        values.resize(t.len(), f64::NAN);
        values
    };
    let series = vec![
        Curve::line("old model", "old", &filled(before)),
        Curve::line("new model", "new", &filled(after)),
    ];
    let x = Axis {
        label: "time apart".to_owned(),
        unit: "s".to_owned(),
    };
    let caption = html! { "How far what is left over resembles itself a little later. Windows overlap, so near neighbours always resemble each other; after that a curve that stays near zero has no pattern left in it." };
    (
        still(
            "autocorrelation",
            "Memory of what is left over",
            (x, "autocorrelation"),
            t,
            series,
        ),
        caption,
    )
}

/// A chart that is not over the recording's time.
fn still(
    id: &'static str,
    title: &str,
    (x, y): (Axis, &str),
    t: Vec<f64>,
    series: Vec<Curve>,
) -> Chart {
    let y = Axis {
        label: y.to_owned(),
        unit: "1".to_owned(),
    };
    Chart {
        x,
        sync: None,
        height: 240,
        from_zero: id == "histogram",
        ..Chart::over_time(id, title, y, &t, series)
    }
}
