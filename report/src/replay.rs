//! This file is a plant that moves: frames of the recording and of the models beside it.

use maud::{Markup, html};
use serde::Serialize;

/// What moves, and what the numbers of a frame are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Shape {
    /// A five-bar linkage: x and y of E, of D (the tip) and of C, m.
    Linkage,
    /// A joint that turns: its angle, rad.
    Turning,
    /// A joint that slides: its position, m.
    Sliding,
}

/// The numbers of a frame: as many as its shape has.
pub type Frame = Vec<f64>;

/// One way in which the plant moves.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Way {
    /// Its name.
    pub name: String,
    /// `recorded`, `old` or `new`.
    pub role: &'static str,
    /// One frame for each time; nothing where a run broke off.
    pub frames: Vec<Option<Frame>>,
}

/// A recording and its simulations, frame by frame.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Replay {
    /// What moves.
    pub shape: Shape,
    /// Times of the frames, s.
    pub time_s: Vec<f64>,
    /// Base joint A of a linkage, m; of one joint where it is held.
    pub a: [f64; 2],
    /// Base joint B of a linkage, m; of one joint the same.
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
        let [left, top, width, height] = self.view();
        let stroke = |role: &str| if role == "recorded" { 0.022 } else { 0.008 } * width;
        let dash =
            |role: &str| (role == "old").then(|| format!("{} {}", 0.03 * width, 0.015 * width));
        html! {
            figure #figure-replay {
                figcaption { strong { "Replay." } " " (self.what()) " as recorded, and as the two models move it. " (self.protocol) }
                div.replay {
                    svg.drawing #replay-drawing viewBox={ (left) " " (top) " " (width) " " (height) } role="img" aria-label={ (self.what()) " as recorded and as simulated" } {
                        @match self.shape {
                            Shape::Turning => circle cx="0" cy="0" r="1" fill="none" stroke="var(--line)" stroke-width=(0.01 * width) {},
                            Shape::Sliding => line x1=(left) y1="0" x2=(left + width) y2="0" stroke="var(--line)" stroke-width=(0.02 * width) {},
                            Shape::Linkage => {}
                        }
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

    /// What moves, at the beginning of a sentence.
    const fn what(&self) -> &'static str {
        match self.shape {
            Shape::Linkage => "The linkage",
            Shape::Turning => "The joint, as a hand that turns with it,",
            Shape::Sliding => "The joint, as a mark that slides with it,",
        }
    }

    /// The base joints with their names; one point where they lie on one axis.
    fn bases(&self) -> Vec<(&'static str, [f64; 2])> {
        match self.shape {
            Shape::Linkage if self.a == self.b => vec![("A, B", self.a)],
            Shape::Linkage => vec![("A", self.a), ("B", self.b)],
            Shape::Turning => vec![("", self.a)],
            Shape::Sliding => Vec::new(),
        }
    }

    /// What the drawing has to show, y downward: left, top, width, height.
    fn view(&self) -> [f64; 4] {
        let frames = self.ways.iter().filter(|way| way.role == "recorded");
        let frames = frames.flat_map(|way| way.frames.iter().flatten());
        match self.shape {
            Shape::Turning => return [-1.2, -1.2, 2.4, 2.4],
            Shape::Sliding => return sliding(frames.flatten()),
            Shape::Linkage => {}
        }
        let points = frames.flat_map(|frame| frame.chunks_exact(2));
        let points = points.filter_map(|point| <[f64; 2]>::try_from(point).ok());
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

/// How much of the way of a joint that slides is shown above and below it.
const HALF_HEIGHT: f64 = 0.12;

/// The view of a joint that slides along x, with a tenth of its way on each side.
fn sliding<'a>(positions: impl Iterator<Item = &'a f64>) -> [f64; 4] {
    let [least, greatest] = positions.fold([f64::INFINITY, f64::NEG_INFINITY], |own, x| {
        [own[0].min(*x), own[1].max(*x)]
    });
    let way = (greatest - least).max(f64::MIN_POSITIVE);
    [
        least - 0.1 * way,
        -HALF_HEIGHT * way,
        1.2 * way,
        2.0 * HALF_HEIGHT * way,
    ]
}
