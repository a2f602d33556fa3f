//! This file describes what is to be drawn; how it is drawn is the program's business.

/// One picture: panels below each other.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// The file's name without its ending: lower case, digits and hyphens.
    pub name: String,
    /// The headline.
    pub title: String,
    /// What it was made with, in one line.
    pub subtitle: String,
    /// The panels, from above.
    pub panels: Vec<Panel>,
}

/// One pair of axes with its curves.
#[derive(Clone, Debug, PartialEq)]
pub struct Panel {
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis.
    pub y: Axis,
    /// Whether a metre to the right is as long as a metre upwards, as on a map.
    pub equal_scales: bool,
    /// What is shaded below the curves.
    pub field: Option<Field>,
    /// What is drawn; its order gives the colours, its names the legend.
    pub curves: Vec<Curve>,
}

/// A value over the plane, shaded in bands as a contour map is.
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    /// Side of a cell, in the unit of both axes.
    pub step: f64,
    /// The lower left corner of the first cell.
    pub origin: [f64; 2],
    /// Cells along x, at least one.
    pub columns: usize,
    /// The value in each cell, row by row from below; NaN leaves a cell empty.
    pub values: Vec<f64>,
    /// Where bands begin and end, growing: a value belongs to the band that it is at most the end of.
    pub bounds: Vec<f64>,
    /// The unit of the values.
    pub unit: String,
}

/// What an axis shows.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// The quantity.
    pub quantity: String,
    /// Its unit; empty for a plain number.
    pub unit: String,
}

/// How the points of a curve are shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// Joined in their order; a point that is not finite interrupts the line.
    Line,
    /// Joined, and thin: one of many.
    Thin,
    /// One dot each.
    Dots,
}

/// One curve.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// Its name in the legend; empty for one that needs none and takes the colour of the curve before it.
    pub name: String,
    /// Horizontal coordinates, in the unit of the axis, in any order.
    pub x: Vec<f64>,
    /// Vertical coordinates, one each.
    pub y: Vec<f64>,
    /// How it is shown.
    pub mark: Mark,
}

impl Panel {
    /// A panel whose axes have scales of their own.
    pub fn new(x: (&str, &str), y: (&str, &str), curves: Vec<Curve>) -> Panel {
        let axis = |(quantity, unit): (&str, &str)| Axis {
            quantity: quantity.to_owned(),
            unit: unit.to_owned(),
        };
        Panel {
            x: axis(x),
            y: axis(y),
            equal_scales: false,
            field: None,
            curves,
        }
    }

    /// The panel as a map: both axes with one scale.
    #[must_use]
    pub fn map(mut self) -> Panel {
        self.equal_scales = true;
        self
    }

    /// The panel with a shaded field below its curves.
    #[must_use]
    pub fn over(mut self, field: Field) -> Panel {
        self.field = Some(field);
        self
    }
}

impl Curve {
    /// A line through points.
    pub fn line(name: impl Into<String>, x: &[f64], y: &[f64]) -> Curve {
        Curve::new(name, x, y, Mark::Line)
    }

    /// A thin line through points.
    pub fn thin(name: impl Into<String>, x: &[f64], y: &[f64]) -> Curve {
        Curve::new(name, x, y, Mark::Thin)
    }

    /// Dots.
    pub fn dots(name: impl Into<String>, x: &[f64], y: &[f64]) -> Curve {
        Curve::new(name, x, y, Mark::Dots)
    }

    fn new(name: impl Into<String>, x: &[f64], y: &[f64], mark: Mark) -> Curve {
        Curve {
            name: name.into(),
            x: x.to_vec(),
            y: y.to_vec(),
            mark,
        }
    }
}
