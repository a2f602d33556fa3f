//! This file draws numbers with their intervals below each other, and gives them as a table.

use maud::{Markup, html};

use crate::chart::rounded;
use crate::number::significant;
use crate::table::table;

/// Width of the drawing and of the room at its sides, px: small enough that its letters can be read on a phone.
const WIDTH: f64 = 480.0;
const SIDE: f64 = 34.0;
/// Heights of a row's name, of each of its marks, and of the room below it, px.
const NAME: f64 = 22.0;
const MARK: f64 = 18.0;
const BELOW: f64 = 12.0;
/// Height of the scale, px.
const SCALE: f64 = 30.0;

/// A number with its interval.
pub struct Mark {
    /// What it is; an entry of the key.
    pub what: &'static str,
    /// Whose colour it has, as of a curve.
    pub role: &'static str,
    /// The number.
    pub value: f64,
    /// Its interval.
    pub interval: [f64; 2],
    /// What stands in the table beside it.
    pub remark: String,
}

/// Rows of numbers on one scale.
pub struct Forest {
    /// Its anchor and the name of its files, of letters and hyphens.
    pub id: &'static str,
    /// Its title.
    pub title: &'static str,
    /// What the scale shows, with its unit.
    pub scale: &'static str,
    /// What the remarks are.
    pub remark: &'static str,
    /// The rows, with their names.
    pub rows: Vec<(String, Vec<Mark>)>,
    /// What the scale does not go beyond; an interval that does ends in an arrow.
    pub limits: [f64; 2],
}

impl Forest {
    /// The drawing with its caption, its key and its numbers; nothing where there are none.
    pub fn figure(&self, caption: &Markup) -> Markup {
        let Some([low, high]) = self.ends() else {
            return html! {};
        };
        let x = |value: f64| {
            SIDE + (WIDTH - 2.0 * SIDE) * ((value - low) / (high - low)).clamp(0.0, 1.0)
        };
        let ticks = ticks(low, high);
        let mut top = 4.0;
        let rows: Vec<Markup> = self
            .rows
            .iter()
            .map(|(name, marks)| {
                let drawn = row(top, name, marks, [low, high], &ticks, &x);
                top += NAME + MARK * marks.len() as f64 + BELOW;
                drawn
            })
            .collect();
        html! {
            figure {
                figcaption { strong { (self.title) "." } " " (caption) }
                (self.key())
                svg.drawing.forest #(self.id) viewBox={ "0 0 " (WIDTH) " " (top + SCALE + 18.0) } role="img" aria-label={ (self.title) ": the numbers stand in the table below" } {
                    @for tick in &ticks {
                        text x=(pixel(x(*tick))) y=(pixel(top + 18.0)) font-size="14" text-anchor="middle" { (rounded(*tick, 6).to_string().replace('-', "−")) }
                    }
                    text x=(WIDTH / 2.0) y=(pixel(top + SCALE + 10.0)) font-size="14" text-anchor="middle" { (self.scale) }
                    @for row in &rows { (row) }
                }
                div.tools { button type="button" data-save-drawing=(self.id) aria-label={ "Save SVG: " (self.title) } { "Save SVG" } }
                details { summary { "The numbers of this picture" } (self.numbers()) }
            }
        }
    }

    /// What the colours say, where there is more than one.
    fn key(&self) -> Markup {
        let mut kinds: Vec<(&str, &str)> = Vec::new();
        for mark in self.rows.iter().flat_map(|(_, marks)| marks) {
            if !kinds.contains(&(mark.what, mark.role)) {
                kinds.push((mark.what, mark.role));
            }
        }
        html! { @if kinds.len() > 1 { p.keys { @for (what, role) in kinds { span.key { svg.point viewBox="-8 -8 16 16" aria-hidden="true" { (point(role, 0.0, 0.0)) } (what) } } } } }
    }

    fn numbers(&self) -> Markup {
        let row = |name: &String, mark: &Mark| {
            let [low, high] = mark.interval;
            vec![
                name.clone(),
                mark.what.to_owned(),
                significant(mark.value, 4),
                significant(low, 4),
                significant(high, 4),
                mark.remark.clone(),
            ]
        };
        let rows = self.rows.iter();
        let rows: Vec<Vec<String>> = rows
            .flat_map(|(name, marks)| marks.iter().map(move |mark| row(name, mark)))
            .collect();
        let head = ["of", "what", self.scale, "from", "to", self.remark];
        table(
            &format!("{}-numbers", self.id),
            &format!("{}, with 95 % intervals.", self.title),
            &head,
            &rows,
        )
    }

    /// The ends of the scale; `None` where nothing is to be drawn.
    fn ends(&self) -> Option<[f64; 2]> {
        let marks = self.rows.iter().flat_map(|(_, marks)| marks);
        let all = marks.flat_map(|mark| [mark.interval[0], mark.value, mark.interval[1]]);
        let [low, high] = all
            .filter(|value| value.is_finite())
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| {
                [low.min(value), high.max(value)]
            });
        let [least, greatest] = self.limits;
        let [low, high] = [low.min(0.0).max(least), high.max(0.0).min(greatest)];
        (high > low).then_some([low, high])
    }
}

/// A row: its name, and its marks below each other. The lines of the scale leave room for the name.
fn row(
    top: f64,
    name: &str,
    marks: &[Mark],
    ends: [f64; 2],
    ticks: &[f64],
    x: &dyn Fn(f64) -> f64,
) -> Markup {
    let height = MARK * marks.len() as f64 + 0.5 * BELOW;
    html! {
        @for tick in ticks {
            path d={ "M" (pixel(x(*tick))) " " (pixel(top + NAME)) "v" (pixel(height)) } stroke=(if *tick == 0.0 { "var(--ink)" } else { "var(--line)" }) stroke-width="1" {}
        }
        text x="4" y=(pixel(top + 15.0)) font-size="15" { (name) }
        @for (k, mark) in marks.iter().enumerate() {
            @let y = top + NAME + MARK * (k as f64 + 0.5);
            @let [from, to] = mark.interval;
            path d={ "M" (pixel(x(from))) " " (pixel(y)) "H" (pixel(x(to))) } stroke={ "var(--" (mark.role) ")" } stroke-width="3" {}
            @if from < ends[0] { (arrow(x(from), y, -1.0, mark.role)) }
            @if to > ends[1] { (arrow(x(to), y, 1.0, mark.role)) }
            @if mark.value >= ends[0] && mark.value <= ends[1] { (point(mark.role, x(mark.value), y)) }
        }
    }
}

/// The end of an interval that goes on.
fn arrow(x: f64, y: f64, way: f64, role: &str) -> Markup {
    html! { path d={ "M" (pixel(x + 9.0 * way)) " " (pixel(y)) "L" (pixel(x)) " " (pixel(y - 6.0)) "V" (pixel(y + 6.0)) "Z" } fill={ "var(--" (role) ")" } {} }
}

/// A point; colours are told apart by their forms too.
fn point(role: &str, x: f64, y: f64) -> Markup {
    let fill = format!("var(--{role})");
    html! {
        @match role {
            "old" => path d={ "M" (pixel(x)) " " (pixel(y - 8.0)) "l8 8l-8 8l-8 -8z" } fill=(fill) {},
            "noise" => rect x=(pixel(x - 6.0)) y=(pixel(y - 6.0)) width="12" height="12" fill=(fill) {},
            _ => circle cx=(pixel(x)) cy=(pixel(y)) r="6.5" fill=(fill) {},
        }
    }
}

/// Round places on a scale, a few.
fn ticks(low: f64, high: f64) -> Vec<f64> {
    let rough = (high - low) / 4.0;
    let power = libm::pow(10.0, libm::floor(libm::log10(rough)));
    let step = [1.0, 2.0, 5.0, 10.0].map(|digit| digit * power);
    let step = step.into_iter().find(|step| *step >= 0.999 * rough);
    let step = step.unwrap_or(10.0 * power);
    let first = libm::ceil(low / step - 1e-9) as i64;
    let last = libm::floor(high / step + 1e-9) as i64;
    (first..=last).map(|k| k as f64 * step).collect()
}

/// A place as it is written into a drawing.
fn pixel(place: f64) -> f64 {
    libm::round(10.0 * place) / 10.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scales_have_round_places_within_their_ends() {
        assert_eq!(ticks(0.0, 100.0), [0.0, 50.0, 100.0]);
        assert_eq!(ticks(-7.3, 31.0), [0.0, 10.0, 20.0, 30.0]);
        for (low, high) in [(-0.031, 0.002), (-300.0, 17.0), (0.0, 6.1e-5)] {
            let ticks = ticks(low, high);
            assert!((3..=7).contains(&ticks.len()), "{ticks:?}");
            assert!(ticks.iter().all(|tick| *tick >= low && *tick <= high));
            assert!(ticks.contains(&0.0));
        }
    }

    #[test]
    fn what_goes_beyond_the_scale_ends_in_an_arrow_and_names_are_escaped() {
        let mark = |value: f64, interval| Mark {
            what: "change",
            role: "old",
            value,
            interval,
            remark: "worse".to_owned(),
        };
        let forest = Forest {
            id: "f",
            title: "Change",
            scale: "%",
            remark: "says",
            rows: vec![("<a>".to_owned(), vec![mark(30.0, [10.0, 250.0])])],
            limits: [-100.0, 100.0],
        };
        let html = forest.figure(&html! {}).into_string();
        assert!(!html.contains("<a>") && html.contains("&lt;a&gt;"));
        // The greatest place on the scale is its right end, from which the arrow goes on.
        assert!(html.contains("M455 35L446 29V41Z"), "{html}");
        assert!(html.contains("250.0") && html.contains("worse"));
        let nothing = Forest {
            rows: Vec::new(),
            ..forest
        };
        assert!(nothing.figure(&html! {}).into_string().is_empty());
    }
}
