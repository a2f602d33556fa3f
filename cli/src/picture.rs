//! This file is the paper that pictures are drawn on: a white page with title, subtitle and legend.

mod before_after;
mod columns;
mod field;
mod figure;
pub mod linkage;
mod panel;
mod plane;
mod residual;
mod scale;
mod shares;

use crate::outcome::steady;
use crate::text::found::at;
use rigproof_diagnose::report::Report;
use svg::Document;
use svg::node::element::{Line, Rectangle, Text, Title};

pub use before_after::{before_after, overlay};
pub use figure::figure;
pub use residual::residual;

/// Colours that people with any colour vision tell apart (Okabe and Ito 2008).
const RECORDED: &str = "#777777";
const NOMINAL: &str = "#d55e00";
const NAMED: &str = "#0072b2";
const NOISE: &str = "#009e73";
const INK: &str = "#222222";

/// Width of every picture; the unit is the pixel of a screen at full size.
const WIDTH: f64 = 960.0;
const LEFT: f64 = 84.0;
const RIGHT: f64 = 24.0;

/// An empty page: white also where the viewer's background is dark.
fn page(height: f64, title: &str, subtitle: &str) -> Document {
    let background = Rectangle::new()
        .set("width", WIDTH)
        .set("height", height)
        .set("fill", "white");
    Document::new()
        .set("viewBox", format!("0 0 {WIDTH} {height}"))
        .set("width", WIDTH)
        .set("height", height)
        .set("font-family", "sans-serif")
        .set("font-size", 12)
        .set("fill", INK)
        .set("role", "img")
        .add(Title::new(steady(title)))
        .add(background)
        .add(
            text(LEFT, 28.0, title)
                .set("font-size", 17)
                .set("font-weight", "bold"),
        )
        .add(text(LEFT, 48.0, subtitle).set("fill", "#555555"))
}

fn text(x: f64, y: f64, content: &str) -> Text {
    Text::new(steady(content))
        .set("x", pixel(x))
        .set("y", pixel(y))
}

/// A row of coloured strokes with their names.
fn legend(mut page: Document, y: f64, entries: &[(&str, &str, f64)]) -> Document {
    let mut x = LEFT;
    for (name, colour, width) in entries {
        let stroke = Line::new()
            .set("x1", x)
            .set("x2", x + 26.0)
            .set("y1", y - 4.0)
            .set("y2", y - 4.0)
            .set("stroke", *colour)
            .set("stroke-width", *width);
        page = page.add(stroke).add(text(x + 32.0, y, name));
        x += 62.0 + 6.6 * name.chars().count() as f64;
    }
    page
}

/// Verdict and names, for a title.
fn heading(report: &Report) -> String {
    let effects = report.effects.iter();
    let names: Vec<String> = effects.map(|e| at(e.mechanism, e.joint)).collect();
    let verdict = report.verdict.name().replace('_', " ");
    match names.as_slice() {
        [] => format!("Verdict: {verdict}, nothing is named"),
        [first, second, third, rest @ ..] if rest.len() > 1 => format!(
            "Verdict: {verdict}, named: {first}, {second}, {third} and {} more",
            rest.len()
        ),
        names => format!("Verdict: {verdict}, named: {}", names.join(", ")),
    }
}

/// A coordinate with a tenth of a pixel, which nobody can see.
fn pixel(x: f64) -> f64 {
    (x * 10.0).round() / 10.0
}
