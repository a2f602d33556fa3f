//! This file draws which share of the unexplained energy lies in which regime, before and after.

use rigproof_diagnose::Curves;
use rigproof_diagnose::report::{Located, Report};
use svg::node::element::{Group, Line, Rectangle};

use crate::text::found::regime;

use super::{INK, LEFT, NAMED, NOMINAL, RIGHT, WIDTH, pixel, text};

/// Height of a regime's row.
const ROW: f64 = 25.0;
/// Where the bars begin.
const BARS: f64 = LEFT + 230.0;

/// The height of the chart, scale included.
pub fn height(report: &Report) -> f64 {
    ROW * report.located.len() as f64 + 40.0
}

/// A row a regime: its share before with the 95 % interval, what is left of it after, and its share of the time.
pub fn chart(top: f64, report: &Report, curves: &Curves) -> Group {
    let left_over = energy(&curves.residual_after) / energy(&curves.residual_before);
    let words = "Where the unexplained energy lies: share of the nominal model's (95 % interval), and what is left of it. A tick marks the share of the time.";
    let bottom = top + 14.0 + ROW * report.located.len() as f64;
    let mut group = Group::new().add(text(LEFT, top, words));
    for percent in [0, 20, 40, 60, 80, 100] {
        let x = at(f64::from(percent) / 100.0);
        let label = text(x, bottom + 16.0, &format!("{percent} %"));
        let grid = line(x, top + 12.0, x, bottom, "#dddddd", 1.0);
        group = group.add(grid).add(label.set("text-anchor", "middle"));
    }
    for (index, place) in report.located.iter().enumerate() {
        group = group.add(row(top + 14.0 + ROW * index as f64, place, left_over));
    }
    group
}

fn row(y: f64, place: &Located, left_over: f64) -> Group {
    let middle = y + 0.25 * ROW;
    let whisker = line(
        at(place.share_low95),
        middle,
        at(place.share_high95),
        middle,
        INK,
        1.2,
    );
    let time = at(place.share_of_time);
    let name = text(BARS - 8.0, y + 0.6 * ROW, &regime(place));
    Group::new()
        .add(name.set("text-anchor", "end"))
        .add(bar(y, place.share, NOMINAL))
        .add(bar(y + 0.42 * ROW, place.share_after * left_over, NAMED))
        .add(whisker)
        .add(line(time, y - 1.0, time, y + 0.9 * ROW, INK, 2.0))
}

fn bar(y: f64, share: f64, colour: &str) -> Rectangle {
    let share = if share.is_finite() {
        share.clamp(0.0, 1.0)
    } else {
        0.0
    };
    Rectangle::new()
        .set("x", BARS)
        .set("y", pixel(y))
        .set("width", pixel(at(share) - BARS))
        .set("height", 0.4 * ROW)
        .set("fill", colour)
}

fn line(x1: f64, y1: f64, x2: f64, y2: f64, colour: &str, width: f64) -> Line {
    Line::new()
        .set("x1", pixel(x1))
        .set("y1", pixel(y1))
        .set("x2", pixel(x2))
        .set("y2", pixel(y2))
        .set("stroke", colour)
        .set("stroke-width", width)
}

fn at(share: f64) -> f64 {
    BARS + (WIDTH - RIGHT - 10.0 - BARS) * share
}

fn energy(residual: &[f64]) -> f64 {
    let finite = residual.iter().filter(|x| x.is_finite());
    finite.map(|x| x * x).sum()
}
