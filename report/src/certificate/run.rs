//! This file shows a trial of a certificate run again: the path, the tip, the hand's force and the brakes' currents.

use maud::{Markup, html};

use crate::chart::{Axis, Chart, Curve, Span};
use crate::number::significant;
use crate::table::table;

/// Most points of the drawing and of its table.
const POINTS: usize = 400;
/// Width of the drawing, its greatest height, and the room around what it shows, px.
const WIDTH: f64 = 480.0;
const HEIGHT: f64 = 420.0;
const ROOM: f64 = 26.0;
/// Span of time whose mean a curve of currents shows, s: what switches faster is a share of it.
const MEAN_S: f64 = 0.05;

/// A trial, sample by sample.
pub struct Run {
    /// What it is, in a sentence.
    pub words: String,
    /// Time between samples, s.
    pub step_s: f64,
    /// The path that was to be followed, m.
    pub path_m: Vec<[f64; 2]>,
    /// The tip, m.
    pub tip_m: Vec<[f64; 2]>,
    /// How far it is from the path, m: positive to the left.
    pub offset_m: Vec<f64>,
    /// The hand's force on it, N.
    pub force_n: Vec<[f64; 2]>,
    /// The currents that were commanded at A, E, B and C, A.
    pub currents_a: Vec<[f64; 4]>,
    /// When a law was broken first, s.
    pub broken_at_s: Option<f64>,
}

impl Run {
    /// The drawing and the charts.
    pub fn body(&self, charts: &mut Vec<Chart>) -> Markup {
        let own = self.charts();
        let every = self.every_sample();
        let figures = html! {
            @for (chart, caption) in &own { (chart.figure(caption)) }
            details { summary { "The currents sample by sample" } (every.figure(&html! { "A brake that switches at every sample fills the chart: zoom in." })) }
        };
        charts.extend(own.into_iter().map(|(chart, _)| chart));
        charts.push(every);
        html! { p { (self.words) } (self.drawing()) (figures) }
    }

    fn charts(&self) -> Vec<(Chart, Markup)> {
        let marked = match self.broken_at_s {
            Some(_) => " Yellow: from where the law is broken.",
            None => "",
        };
        let offset: Vec<f64> = self.offset_m.iter().map(|m| 1e3 * m).collect();
        let offset = vec![line("distance", "new", &offset, false)];
        vec![
            (
                self.chart(
                    "offset",
                    "Distance of the tip from the path",
                    ["distance", "mm"],
                    offset,
                ),
                html! { "Above zero: to the left of the path." (marked) },
            ),
            (
                self.chart(
                    "force",
                    "Force of the hand at the tip",
                    ["force", "N"],
                    self.forces(),
                ),
                html! { "What the simulated hand pushes with." (marked) },
            ),
            (
                self.chart(
                    "currents",
                    "Currents that the controller asks for",
                    ["current", "A"],
                    self.currents(MEAN_S),
                ),
                html! { "Means over " (significant(1e3 * MEAN_S, 2)) " ms, one curve a brake; more current brakes harder. How often they switch stands among the metrics." (marked) },
            ),
        ]
    }

    /// The currents as they are, which say when a brake switches.
    fn every_sample(&self) -> Chart {
        self.chart(
            "every-current",
            "Currents, sample by sample",
            ["current", "A"],
            self.currents(0.0),
        )
    }

    fn chart(
        &self,
        id: &'static str,
        title: &str,
        [label, unit]: [&str; 2],
        curves: Vec<Curve>,
    ) -> Chart {
        let ticks = 0..self.tip_m.len();
        let time_s: Vec<f64> = ticks.map(|tick| tick as f64 * self.step_s).collect();
        let last = time_s.last().copied().unwrap_or_default();
        let (label, unit) = (label.to_owned(), unit.to_owned());
        let mut chart = Chart::over_time(id, title, Axis { label, unit }, &time_s, curves);
        chart.height = 220;
        chart.sync = Some("run");
        chart.spans.extend(self.broken_at_s.map(|at| Span {
            // A sample earlier: the breach may be the last one.
            from: (at - self.step_s).max(0.0),
            to: last,
            role: "mark",
        }));
        chart
    }

    fn forces(&self) -> Vec<Curve> {
        let force = |axis: usize| -> Vec<f64> {
            let component = |force: &[f64; 2]| force.get(axis).copied().unwrap_or(f64::NAN);
            self.force_n.iter().map(component).collect()
        };
        vec![
            line("across (x)", "new", &force(0), false),
            line("away from the base (y)", "old", &force(1), true),
        ]
    }

    /// The current of each brake, as means over a span of time.
    fn currents(&self, span_s: f64) -> Vec<Curve> {
        let half = libm::round(0.5 * span_s / self.step_s) as usize;
        let current = |joint: usize| -> Vec<f64> {
            let one = |currents: &[f64; 4]| currents.get(joint).copied().unwrap_or(f64::NAN);
            let own: Vec<f64> = self.currents_a.iter().map(one).collect();
            means(&own, half)
        };
        let joints = [
            ("A", "recorded", false),
            ("E", "old", true),
            ("B", "new", false),
            ("C", "noise", true),
        ];
        let joints = joints.into_iter().enumerate();
        joints
            .map(|(k, (name, role, dashed))| line(name, role, &current(k), dashed))
            .collect()
    }

    fn drawing(&self) -> Markup {
        let every = self.tip_m.len().div_ceil(POINTS).max(1);
        let tips: Vec<(usize, [f64; 2])> = self
            .tip_m
            .iter()
            .copied()
            .enumerate()
            .step_by(every)
            .filter(|(_, [x, y])| x.is_finite() && y.is_finite())
            .collect();
        let shown = tips
            .iter()
            .map(|(_, tip)| *tip)
            .chain(self.path_m.iter().copied());
        let Some(place) = Place::around(shown) else {
            return html! {};
        };
        let points = |points: &mut dyn Iterator<Item = [f64; 2]>| -> String {
            let points: Vec<String> = points
                .map(|point| {
                    let [x, y] = place.at(point);
                    format!("{x},{y}")
                })
                .collect();
            points.join(" ")
        };
        let start = tips.first().map(|(_, tip)| place.at(*tip));
        let broken = self.broken_at_s.and_then(|at_s| {
            let tick = libm::round(at_s / self.step_s) as usize;
            Some(place.at(*self.tip_m.get(tick)?))
        });
        let (bar, name) = place.bar();
        let rows: Vec<Vec<String>> = tips
            .iter()
            .map(|(tick, [x, y])| {
                vec![
                    significant(*tick as f64 * self.step_s, 4),
                    significant(1e3 * x, 5),
                    significant(1e3 * y, 5),
                ]
            })
            .collect();
        html! {
            figure {
                figcaption { strong { "From above." } " Wide and grey: the path that was to be followed. Thin and blue: the tip, from the ring on." @if broken.is_some() { " The diamond: where the law is broken first." } }
                svg.drawing.forest #from-above viewBox={ "0 0 " (WIDTH) " " (place.height) } role="img" aria-label="The path and the tip, seen from above" {
                    polyline points=(points(&mut self.path_m.iter().copied())) fill="none" stroke="var(--line)" stroke-width="9" stroke-linejoin="round" stroke-linecap="round" {}
                    polyline points=(points(&mut tips.iter().map(|(_, tip)| *tip))) fill="none" stroke="var(--new)" stroke-width="2" stroke-linejoin="round" {}
                    @if let Some([x, y]) = start { circle cx=(x) cy=(y) r="7" fill="none" stroke="var(--ink)" stroke-width="2" {} }
                    @if let Some([x, y]) = broken { path d={ "M" (x) " " (y - 9.0) "l9 9l-9 9l-9 -9z" } fill="var(--old)" {} }
                    path d={ "M14 " (place.height - 12.0) "h" (bar) } stroke="var(--ink)" stroke-width="2" {}
                    text x="14" y=(place.height - 18.0) font-size="14" { (name) }
                }
                div.tools { button type="button" data-save-drawing="from-above" aria-label="Save SVG: from above" { "Save SVG" } }
                details { summary { "The points of the tip" } (table("tip", "The tip over time.", &["time (s)", "x (mm)", "y (mm)"], &rows)) }
            }
        }
    }
}

/// For each sample the mean of those up to `half` samples away on either side; a part of it at the ends.
fn means(values: &[f64], half: usize) -> Vec<f64> {
    let around = |k: usize| {
        let to = (k + half + 1).min(values.len());
        let part = values.get(k.saturating_sub(half)..to).unwrap_or_default();
        part.iter().sum::<f64>() / part.len().max(1) as f64
    };
    (0..values.len()).map(around).collect()
}

/// A curve that is told apart by its dashes too.
fn line(name: &str, role: &'static str, values: &[f64], dashed: bool) -> Curve {
    Curve {
        dashed,
        width: 1.8,
        ..Curve::line(name, role, values)
    }
}

/// How places on the rig lie in the drawing.
struct Place {
    low_m: [f64; 2],
    scale: f64,
    height: f64,
}

impl Place {
    /// Around these points, m; `None` where there are none.
    fn around(points: impl Iterator<Item = [f64; 2]>) -> Option<Place> {
        let none = [
            f64::INFINITY,
            f64::INFINITY,
            f64::NEG_INFINITY,
            f64::NEG_INFINITY,
        ];
        let [left, low, right, high] = points.fold(none, |[left, low, right, high], [x, y]| {
            [left.min(x), low.min(y), right.max(x), high.max(y)]
        });
        let (width_m, height_m) = (right - left, high - low);
        if !(width_m.is_finite() && height_m.is_finite()) {
            return None;
        }
        let least = f64::MIN_POSITIVE;
        let inner = [WIDTH - 2.0 * ROOM, HEIGHT - 3.0 * ROOM];
        let scale = (inner[0] / width_m.max(least)).min(inner[1] / height_m.max(least));
        let scale = if scale.is_finite() { scale } else { 1.0 };
        Some(Place {
            low_m: [left + 0.5 * width_m - 0.5 * inner[0] / scale, low],
            scale,
            height: libm::ceil(height_m * scale + 3.0 * ROOM),
        })
    }

    /// Across and down, px.
    fn at(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let across = ROOM + (x - self.low_m[0]) * self.scale;
        let down = self.height - 2.0 * ROOM - (y - self.low_m[1]) * self.scale;
        [across, down].map(|place| libm::round(10.0 * place) / 10.0)
    }

    /// The length of a bar that stands for a round distance, px, and its name.
    fn bar(&self) -> (f64, &'static str) {
        let bars = [
            (0.05, "5 cm"),
            (0.02, "2 cm"),
            (0.01, "1 cm"),
            (0.005, "5 mm"),
            (0.002, "2 mm"),
            (0.001, "1 mm"),
        ];
        let fits = |(metres, _): &(f64, &str)| metres * self.scale <= 0.4 * WIDTH;
        let (metres, name) = bars.into_iter().find(fits).unwrap_or((1e-4, "0.1 mm"));
        (libm::round(metres * self.scale), name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_current_that_switches_at_every_sample_is_a_line_at_its_mean() {
        let switching: Vec<f64> = (0..400).map(|k| f64::from(u8::from(k % 4 == 0))).collect();
        let shown = means(&switching, 25);
        assert_eq!(shown.len(), switching.len());
        for mean in &shown[25..375] {
            assert!((mean - 0.25).abs() < 0.02, "{mean}");
        }
        assert_eq!(means(&switching, 0), switching);
        assert!(means(&[], 25).is_empty());
    }

    #[test]
    fn the_drawing_keeps_shape_and_sides() {
        let points = [[0.1, 0.3], [-0.06, 0.42], [0.02, 0.37]];
        let place = Place::around(points.into_iter()).unwrap();
        let [one, other, third] = points.map(|point| place.at(point));
        assert!(other[0] < third[0] && third[0] < one[0], "left stays left");
        assert!(
            other[1] < third[1] && third[1] < one[1],
            "away from the base is up"
        );
        let ratio = (one[0] - other[0]) / (one[1] - other[1]);
        assert!((ratio - 0.16 / 0.12).abs() < 0.01, "{ratio}");
        for [x, y] in [one, other, third] {
            assert!((ROOM..=WIDTH - ROOM).contains(&x));
            assert!((ROOM..=place.height - ROOM).contains(&y));
        }
        assert!(Place::around(std::iter::empty()).is_none());
        assert!(Place::around([[0.1, 0.3]].into_iter()).is_some());
    }
}
