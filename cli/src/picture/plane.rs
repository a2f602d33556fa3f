//! This file is a plane: a frame in which a unit is as long along x as along y, with what is drawn in it.

use svg::node::element::{Group, Line, Polygon, Rectangle, Title};

use super::scale::Scale;
use super::{INK, LEFT, RIGHT, WIDTH, pixel, text};

/// Greatest height of a frame.
const TALLEST: f64 = 760.0;

/// A frame around a rectangle of the plane.
pub struct Plane {
    x: Scale,
    y: Scale,
    top: f64,
    pixels_per_unit: f64,
    inside: Group,
}

impl Plane {
    /// A frame with its upper edge at `top` around the values from `low` to `high`; `names` label x and y.
    pub fn new(top: f64, low: [f64; 2], high: [f64; 2], names: [&str; 2], unit: &str) -> Plane {
        let ([left, bottom], [right, upper], [x, y]) = (low, high, names);
        let across = (WIDTH - LEFT - RIGHT) / (right - left);
        Plane {
            x: Scale::exact(left, right, x, unit),
            y: Scale::exact(bottom, upper, y, unit),
            top,
            pixels_per_unit: across.min(TALLEST / (upper - bottom)),
            inside: Group::new(),
        }
    }

    /// Where the frame and its labels end.
    pub fn bottom(&self) -> f64 {
        self.top + self.height() + 46.0
    }

    /// Fills a rectangle; `title` shows where a pointer rests.
    pub fn fill(&mut self, low: [f64; 2], high: [f64; 2], colour: &str, title: Option<&str>) {
        let [left, top] = self.at([low[0], high[1]]);
        let [right, bottom] = self.at([high[0], low[1]]);
        let mut cell = Rectangle::new()
            .set("x", pixel(left))
            .set("y", pixel(top))
            // Neighbours overlap by a hair, so that no seam shows.
            .set("width", pixel(right - left + 0.3))
            .set("height", pixel(bottom - top + 0.3))
            .set("shape-rendering", "crispEdges")
            .set("fill", colour);
        if let Some(title) = title {
            cell = cell.add(Title::new(title));
        }
        self.inside = std::mem::take(&mut self.inside).add(cell);
    }

    /// Draws a line between two points.
    pub fn line(&mut self, from: [f64; 2], to: [f64; 2], colour: &str, width: f64) {
        let ([x_1, y_1], [x_2, y_2]) = (self.at(from), self.at(to));
        let line = Line::new()
            .set("x1", pixel(x_1))
            .set("y1", pixel(y_1))
            .set("x2", pixel(x_2))
            .set("y2", pixel(y_2))
            .set("stroke", colour)
            .set("stroke-width", width)
            .set("stroke-linecap", "round");
        self.inside = std::mem::take(&mut self.inside).add(line);
    }

    /// Draws a closed outline.
    pub fn outline(
        &mut self,
        points: impl IntoIterator<Item = [f64; 2]>,
        colour: &str,
        width: f64,
    ) {
        let points = points.into_iter().map(|point| {
            let [x, y] = self.at(point);
            format!("{},{}", pixel(x), pixel(y))
        });
        let points: Vec<String> = points.collect();
        let outline = Polygon::new()
            .set("points", points.join(" "))
            .set("fill", "none")
            .set("stroke", colour)
            .set("stroke-width", width)
            .set("stroke-linejoin", "round");
        self.inside = std::mem::take(&mut self.inside).add(outline);
    }

    /// Writes a word in the middle of a point.
    pub fn word(&mut self, at: [f64; 2], word: &str) {
        let [x, y] = self.at(at);
        let word = text(x, y + 4.0, word).set("text-anchor", "middle");
        self.inside = std::mem::take(&mut self.inside).add(word);
    }

    /// The frame with its ticks, labels and what is drawn inside.
    pub fn finish(self) -> Group {
        let (width, height) = (self.width(), self.height());
        let bottom = self.top + height;
        let mut group = Group::new().add(self.inside.clone());
        for (value, label) in self.x.ticks(10.0) {
            let x = LEFT + width * self.x.place(value);
            group = group
                .add(tick([x, bottom], [x, bottom + 5.0]))
                .add(text(x, bottom + 18.0, &label).set("text-anchor", "middle"));
        }
        for (value, label) in self.y.ticks(height / 60.0) {
            let y = self.top + height * (1.0 - self.y.place(value));
            group = group
                .add(tick([LEFT - 5.0, y], [LEFT, y]))
                .add(text(LEFT - 8.0, y + 4.0, &label).set("text-anchor", "end"));
        }
        let frame = Rectangle::new()
            .set("x", LEFT)
            .set("y", self.top)
            .set("width", pixel(width))
            .set("height", pixel(height))
            .set("fill", "none")
            .set("stroke", INK);
        let middle = self.top + 0.5 * height;
        let turned = text(22.0, middle, self.y.label())
            .set("text-anchor", "middle")
            .set("transform", format!("rotate(-90 22 {})", pixel(middle)));
        let below = text(LEFT + 0.5 * width, bottom + 38.0, self.x.label());
        group
            .add(frame)
            .add(turned)
            .add(below.set("text-anchor", "middle"))
    }

    fn at(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [
            LEFT + self.width() * self.x.place(x),
            self.top + self.height() * (1.0 - self.y.place(y)),
        ]
    }

    fn width(&self) -> f64 {
        self.pixels_per_unit * (self.x.high - self.x.low)
    }

    fn height(&self) -> f64 {
        self.pixels_per_unit * (self.y.high - self.y.low)
    }
}

fn tick([x_1, y_1]: [f64; 2], [x_2, y_2]: [f64; 2]) -> Line {
    Line::new()
        .set("x1", pixel(x_1))
        .set("y1", pixel(y_1))
        .set("x2", pixel(x_2))
        .set("y2", pixel(y_2))
        .set("stroke", INK)
}
