//! This file is a panel: a frame with two scales, and the curves and bands inside it.

use svg::node::element::{Circle, ClipPath, Definitions, Group, Line, Polyline, Rectangle};

use super::columns::{interrupted, thinned};
use super::scale::Scale;
use super::{INK, LEFT, RIGHT, WIDTH, pixel, text};

/// A frame across the page; what is drawn outside of it is cut off.
pub struct Panel {
    top: f64,
    height: f64,
    x: Scale,
    y: Scale,
    inside: Group,
}

impl Panel {
    /// A panel with its upper edge at `top`.
    pub fn new(top: f64, height: f64, x: Scale, y: Scale) -> Panel {
        Panel {
            top,
            height,
            x,
            y,
            inside: Group::new(),
        }
    }

    /// Draws a curve; a point that is not finite interrupts it.
    pub fn curve(&mut self, x: &[f64], y: &[f64], colour: &str, width: f64) {
        let points = x.iter().zip(y).map(|(&x, &y)| (self.at_x(x), self.at_y(y)));
        let points: Vec<(f64, f64)> = points.collect();
        let stretches = points.split(|(x, y)| !x.is_finite() || !y.is_finite());
        for stretch in stretches.filter(|stretch| !stretch.is_empty()) {
            self.line(thinned(stretch.iter().copied()), colour, width);
        }
    }

    /// Draws a curve that may turn back; a point that is not finite interrupts it.
    pub fn path(&mut self, x: &[f64], y: &[f64], colour: &str, width: f64) {
        let points = x.iter().zip(y).map(|(&x, &y)| (self.at_x(x), self.at_y(y)));
        for stretch in interrupted(points) {
            self.line(stretch, colour, width);
        }
    }

    /// Draws a line through points of the page.
    fn line(&mut self, points: Vec<(f64, f64)>, colour: &str, width: f64) {
        let points: Vec<String> = points
            .into_iter()
            .map(|(x, y)| format!("{},{}", pixel(x), pixel(y)))
            .collect();
        let line = Polyline::new()
            .set("points", points.join(" "))
            .set("fill", "none")
            .set("stroke", colour)
            .set("stroke-width", width)
            .set("stroke-linejoin", "round");
        self.inside = std::mem::take(&mut self.inside).add(line);
    }

    /// Fills a rectangle.
    pub fn fill(&mut self, low: [f64; 2], high: [f64; 2], colour: &str) {
        let ([left, bottom], [right, top]) = (low, high);
        let (left, right) = (self.at_x(left), self.at_x(right));
        let (top, bottom) = (self.at_y(top), self.at_y(bottom));
        let cell = Rectangle::new()
            .set("x", pixel(left))
            .set("y", pixel(top))
            // Neighbours overlap by a hair, so that no seam shows.
            .set("width", pixel(right - left + 0.3))
            .set("height", pixel(bottom - top + 0.3))
            .set("shape-rendering", "crispEdges")
            .set("fill", colour);
        self.inside = std::mem::take(&mut self.inside).add(cell);
    }

    /// Draws a dot for each point.
    pub fn dots(&mut self, x: &[f64], y: &[f64], colour: &str) {
        for (&x, &y) in x
            .iter()
            .zip(y)
            .filter(|(x, y)| x.is_finite() && y.is_finite())
        {
            let dot = Circle::new()
                .set("cx", pixel(self.at_x(x)))
                .set("cy", pixel(self.at_y(y)))
                .set("r", 2.5)
                .set("fill", colour);
            self.inside = std::mem::take(&mut self.inside).add(dot);
        }
    }

    /// Shades the values from `low` to `high`.
    pub fn band(&mut self, low: f64, high: f64, colour: &str) {
        let (top, bottom) = (self.at_y(high), self.at_y(low));
        let band = Rectangle::new()
            .set("x", LEFT)
            .set("width", width())
            .set("y", pixel(top))
            .set("height", pixel(bottom - top).max(1.0))
            .set("fill", colour)
            .set("fill-opacity", 0.35);
        self.inside = std::mem::take(&mut self.inside).add(band);
    }

    /// The panel with its frame, ticks and labels; `id` is its own within the page.
    pub fn finish(self, id: &str) -> Group {
        let frame = || {
            Rectangle::new()
                .set("x", LEFT)
                .set("y", self.top)
                .set("width", width())
                .set("height", self.height)
        };
        let clip = ClipPath::new().set("id", id).add(frame());
        let inside = self.inside.clone().set("clip-path", format!("url(#{id})"));
        let outline = frame().set("fill", "none").set("stroke", INK);
        self.grid(Group::new())
            .add(Definitions::new().add(clip))
            .add(inside)
            .add(outline)
    }

    fn grid(&self, mut group: Group) -> Group {
        let bottom = self.top + self.height;
        for (value, label) in self.x.ticks(10.0) {
            let x = self.at_x(value);
            group = group
                .add(stroke(x, self.top, x, bottom))
                .add(text(x, bottom + 16.0, &label).set("text-anchor", "middle"));
        }
        for (value, label) in self.y.ticks(self.height / 45.0) {
            let y = self.at_y(value);
            group = group
                .add(stroke(LEFT, y, LEFT + width(), y))
                .add(text(LEFT - 7.0, y + 4.0, &label).set("text-anchor", "end"));
        }
        let middle = self.top + 0.5 * self.height;
        let turned = text(20.0, middle, self.y.label())
            .set("text-anchor", "middle")
            .set("transform", format!("rotate(-90 20 {middle})"));
        let below = text(LEFT + 0.5 * width(), bottom + 33.0, self.x.label());
        group.add(turned).add(below.set("text-anchor", "middle"))
    }

    fn at_x(&self, x: f64) -> f64 {
        LEFT + width() * self.x.place(x)
    }

    /// A curve that runs far away is drawn a little outside, where it is cut off.
    fn at_y(&self, y: f64) -> f64 {
        self.top + self.height * (1.0 - self.y.place(y)).clamp(-1.0, 2.0)
    }
}

/// Width of every panel.
pub fn width() -> f64 {
    WIDTH - LEFT - RIGHT
}

/// A line of the grid.
fn stroke(x1: f64, y1: f64, x2: f64, y2: f64) -> Line {
    Line::new()
        .set("x1", pixel(x1))
        .set("y1", pixel(y1))
        .set("x2", pixel(x2))
        .set("y2", pixel(y2))
        .set("stroke", "#dddddd")
}
