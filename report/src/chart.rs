//! This file is a chart: its curves, thinned out so that no extreme is lost, and the place in the page where it is drawn.

use maud::{Markup, html};
use serde::Serialize;

use crate::what_if::WhatIf;

/// Most buckets of a chart; each keeps the least and the greatest value of every curve.
const BUCKETS: usize = 3000;

/// What an axis shows.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Axis {
    /// The quantity.
    pub label: String,
    /// Its unit; `1` for a plain number.
    pub unit: String,
}

/// How a curve is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// A line.
    Line,
    /// Bars from zero.
    Bars,
    /// A line with its points.
    Points,
}

/// A curve over the chart's abscissa.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Curve {
    /// Its name.
    pub name: String,
    /// Whose colour it has: `recorded`, `old`, `new`, `noise`.
    pub role: &'static str,
    /// How it is drawn.
    pub kind: Kind,
    /// Width of the stroke.
    pub width: f64,
    /// Whether the stroke is dashed: curves are told apart without colour too.
    pub dashed: bool,
    /// One value for each place of the abscissa; nothing where there is none.
    #[serde(rename = "v")]
    pub values: Vec<Option<f64>>,
}

impl Curve {
    /// A line; values that are not finite are gaps.
    pub fn line(name: &str, role: &'static str, values: &[f64]) -> Curve {
        Curve {
            name: name.to_owned(),
            role,
            kind: Kind::Line,
            width: if role == "recorded" { 3.0 } else { 1.6 },
            dashed: role == "old",
            values: values.iter().map(|v| v.is_finite().then_some(*v)).collect(),
        }
    }
}

/// A marked stretch of the abscissa.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Span {
    /// Where it begins.
    pub from: f64,
    /// Where it ends.
    pub to: f64,
    /// `mark` or `held`.
    pub role: &'static str,
}

/// A chart with everything it shows.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Chart {
    /// Its anchor and the name of the files it is saved as, of letters and hyphens.
    pub id: &'static str,
    /// Its title.
    pub title: String,
    /// Abscissa.
    pub x: Axis,
    /// Ordinate.
    pub y: Axis,
    /// Height on the screen, px.
    pub height: u32,
    /// Places on the abscissa, in rising order.
    pub t: Vec<f64>,
    /// The curves.
    pub series: Vec<Curve>,
    /// Marked stretches.
    pub spans: Vec<Span>,
    /// A horizontal band, from and to.
    pub band: Option<[f64; 2]>,
    /// What the ordinate does not go beyond, so that a model that runs away does not flatten a recording.
    pub limits: Option<[f64; 2]>,
    /// Whether the ordinate begins at zero.
    pub from_zero: bool,
    /// Whether the ordinate is logarithmic.
    pub log_y: bool,
    /// Charts of the same name are zoomed together.
    pub sync: Option<&'static str>,
    /// What one of its curves would be without some of the named effects.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub what_if: Option<WhatIf>,
}

impl Chart {
    /// A chart over time of curves that share their time stamps, thinned out.
    pub fn over_time(
        id: &'static str,
        title: &str,
        y: Axis,
        time_s: &[f64],
        curves: Vec<Curve>,
    ) -> Chart {
        let (t, series) = thinned(time_s, curves, BUCKETS);
        Chart {
            id,
            title: title.to_owned(),
            x: Axis {
                label: "time".to_owned(),
                unit: "s".to_owned(),
            },
            y,
            height: 300,
            t,
            series,
            spans: Vec::new(),
            band: None,
            limits: None,
            from_zero: false,
            log_y: false,
            sync: Some("time"),
            what_if: None,
        }
    }

    /// The place where the chart is drawn, with its caption and buttons.
    pub fn figure(&self, caption: &Markup) -> Markup {
        let buttons = [
            ("in", "Zoom in"),
            ("out", "Zoom out"),
            ("left", "◀ Earlier"),
            ("right", "Later ▶"),
            ("whole", "Whole"),
            ("svg", "Save SVG"),
            ("csv", "Save CSV"),
        ];
        let moves = self.sync.is_some();
        let buttons = buttons
            .into_iter()
            .filter(|(what, _)| moves || matches!(*what, "svg" | "csv"));
        html! {
            figure #{ "figure-" (self.id) } {
                figcaption { strong { (self.title) "." } " " (caption) }
                div.plot #{ "plot-" (self.id) } tabindex="0" role="group" aria-label={ "Chart: " (self.title) } {}
                noscript { p.soft { "The chart needs JavaScript; its numbers stand in report.json beside this page." } }
                div.tools {
                    @for (what, label) in buttons {
                        button type="button" data-chart=(self.id) data-do=(what) aria-label={ (label) ": " (self.title) } { (label) }
                    }
                    @if moves { span.hint { "Drag to zoom, double-click for the whole; keys + − ← → 0." } }
                }
            }
        }
    }
}

/// Curves thinned out to two places a bucket, at which every curve has its least and its greatest value in the order in which they came.
fn thinned(time: &[f64], curves: Vec<Curve>, buckets: usize) -> (Vec<f64>, Vec<Curve>) {
    if time.len() <= 2 * buckets {
        let curves = curves.into_iter().map(|mut curve| {
            for value in curve.values.iter_mut().flatten() {
                *value = rounded(*value, 6);
            }
            curve
        });
        return (
            time.iter().map(|t| rounded(*t, 8)).collect(),
            curves.collect(),
        );
    }
    let size = time.len().div_ceil(buckets);
    let places = |bucket: &[f64]| {
        let first = bucket.first().copied().unwrap_or(0.0);
        let half = bucket.get(bucket.len() / 2).copied().unwrap_or(first);
        [first, if half > first { half } else { first }].map(|t| rounded(t, 8))
    };
    let times = time.chunks(size).flat_map(places).collect();
    let curves = curves.into_iter().map(|curve| Curve {
        values: curve.values.chunks(size).flat_map(extremes).collect(),
        ..curve
    });
    (times, curves.collect())
}

/// The least and the greatest value of a bucket in the order in which they came; nothing twice where there is no value.
fn extremes(bucket: &[Option<f64>]) -> [Option<f64>; 2] {
    let present = || {
        bucket
            .iter()
            .enumerate()
            .filter_map(|(k, v)| v.map(|v| (k, v)))
    };
    let least = present().min_by(|a, b| a.1.total_cmp(&b.1));
    let greatest = present().max_by(|a, b| a.1.total_cmp(&b.1));
    let mut both = [least, greatest];
    both.sort_by_key(|entry| entry.map(|(k, _)| k));
    both.map(|entry| entry.map(|(_, v)| rounded(v, 6)))
}

/// A number with so many significant digits: what a screen shows, in fewer bytes.
pub fn rounded(value: f64, digits: i32) -> f64 {
    let text = format!("{value:.*e}", digits.max(1) as usize - 1);
    text.parse().unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thinning_keeps_every_extreme_and_its_order() {
        let count = 100_003;
        let time: Vec<f64> = (0..count).map(|k| 1e-3 * f64::from(k)).collect();
        let mut values: Vec<f64> = time.iter().map(|t| 0.31 * libm::sin(7.3 * t)).collect();
        values[41_717] = 9.25;
        values[41_720] = -7.5;
        values[60_001] = f64::NAN;
        let chart = Chart::over_time(
            "x",
            "x",
            Axis {
                label: "force".to_owned(),
                unit: "N".to_owned(),
            },
            &time,
            vec![Curve::line("recorded", "recorded", &values)],
        );
        let kept = &chart.series[0].values;
        assert!(chart.t.len() <= 2 * BUCKETS && chart.t.len() == kept.len());
        assert!(chart.t.windows(2).all(|pair| pair[0] < pair[1]));
        let place = |x: f64| kept.iter().position(|v| *v == Some(x)).unwrap();
        assert!(place(9.25) < place(-7.5));
        assert!((chart.t[place(9.25)] - time[41_717]).abs() < 0.04);
    }

    #[test]
    fn a_stretch_without_values_stays_a_gap() {
        assert_eq!(extremes(&[None, None]), [None, None]);
        assert_eq!(extremes(&[None, Some(2.5), None]), [Some(2.5); 2]);
        assert_eq!(rounded(0.123_456_789, 6), 0.123_457);
    }
}
