//! This file is a linkage that moves: frames of the recording and of the models beside it.

use maud::{Markup, html};
use serde::Serialize;

/// Points E, D (the tip) and C of a frame: x and y of each, m.
pub type Frame = [f64; 6];

/// One way in which the linkage moves.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Way {
    /// Its name.
    pub name: String,
    /// `recorded`, `old` or `new`.
    pub role: &'static str,
    /// One frame for each time; nothing where a run broke off.
    pub frames: Vec<Option<Frame>>,
}

/// A five-bar's recording and simulations, frame by frame.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Replay {
    /// Times of the frames, s.
    pub time_s: Vec<f64>,
    /// Base joint A, m.
    pub a: [f64; 2],
    /// Base joint B, m.
    pub b: [f64; 2],
    /// The ways, the recorded one first.
    pub ways: Vec<Way>,
    /// How the simulations were made.
    #[serde(skip)]
    pub protocol: String,
}

impl Replay {
    /// The drawing, its slider and its buttons.
    pub fn figure(&self) -> Markup {
        let [left, top, width, height] = self.frame();
        let stroke = |role: &str| if role == "recorded" { 0.022 } else { 0.008 } * width;
        let dash =
            |role: &str| (role == "old").then(|| format!("{} {}", 0.03 * width, 0.015 * width));
        html! {
            figure #figure-replay {
                figcaption { strong { "Replay." } " The linkage as recorded, and as the two models move it from the recorded forces. " (self.protocol) }
                div.replay {
                    svg.drawing #replay-drawing viewBox={ (left) " " (top) " " (width) " " (height) } role="img" aria-label="The five-bar linkage as recorded and as simulated" {
                        line x1=(self.a[0]) y1=(-self.a[1]) x2=(self.b[0]) y2=(-self.b[1]) stroke="var(--line)" stroke-width=(0.02 * width) {}
                        @for way in &self.ways {
                            g data-linkage=(way.role) {
                                polyline.trail fill="none" stroke={ "var(--" (way.role) ")" } stroke-width=(0.3 * stroke(way.role)) opacity="0.7" points="" {}
                                polyline.arms fill="none" stroke={ "var(--" (way.role) ")" } stroke-width=(stroke(way.role)) stroke-linejoin="round" stroke-dasharray=[dash(way.role)] points="" {}
                                circle.tip r=(0.016 * width) fill={ "var(--" (way.role) ")" } {}
                            }
                        }
                        @for (name, [x, y]) in self.bases() {
                            circle cx=(x) cy=(-y) r=(0.012 * width) fill="var(--ink)" {}
                            text x=(x) y=(-y + 0.06 * width) font-size=(0.045 * width) text-anchor="middle" { (name) }
                        }
                    }
                    p.keys {
                        @for way in &self.ways { span.key { i style={ "border-color: var(--" (way.role) ")" } {} (way.name) } }
                    }
                    div.row {
                        button #replay-play type="button" { "Play" }
                        label for="replay-time" { "Time" }
                        input #replay-time type="range" min="0" value="0" step="1";
                        label for="replay-speed" { "Speed" }
                        select #replay-speed { option value="0.1" { "1/10" } option value="0.5" { "1/2" } option value="1" selected { "1" } option value="4" { "4" } }
                        label for="replay-times" { "Differences" }
                        select #replay-times { option value="1" selected { "×1" } option value="20" { "×20" } }
                    }
                    p.soft #replay-said role="status" aria-live="off" {}
                }
                div.tools {
                    button type="button" data-save-drawing="replay-drawing" aria-label="Save SVG: replay" { "Save SVG" }
                    button #replay-csv type="button" aria-label="Save CSV: replay" { "Save CSV" }
                }
            }
        }
    }

    /// The base joints with their names; one point where they lie on one axis.
    fn bases(&self) -> Vec<(&'static str, [f64; 2])> {
        if self.a == self.b {
            return vec![("A, B", self.a)];
        }
        vec![("A", self.a), ("B", self.b)]
    }

    /// What the drawing has to show, y downward: left, top, width, height.
    fn frame(&self) -> [f64; 4] {
        let frames = self.ways.iter().filter(|way| way.role == "recorded");
        let frames = frames.flat_map(|way| way.frames.iter().flatten());
        let points =
            frames.flat_map(|[ex, ey, dx, dy, cx, cy]| [[*ex, *ey], [*dx, *dy], [*cx, *cy]]);
        let start = [self.a[0], self.b[0], self.a[1], self.a[1]];
        let [left, right, low, high] = points
            .chain([self.a, self.b])
            .fold(start, |[left, right, low, high], [x, y]| {
                [left.min(x), right.max(x), low.min(y), high.max(y)]
            });
        let room = 0.14 * (right - left).max(high - low);
        [
            left - room,
            -high - room,
            right - left + 2.0 * room,
            high - low + 2.0 * room,
        ]
        .map(|x| (1e4 * x).round() / 1e4)
    }
}
