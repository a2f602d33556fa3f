//! This file draws the picture of an experiment: its panels below each other, each with a legend of its own.

use rigproof_experiments::{Axis, Curve, Mark, Panel as Content, Picture};

use super::before_after::range;
use super::field::{self, Run};
use super::panel::{Panel, width};
use super::scale::Scale;
use super::{NAMED, NOISE, NOMINAL, RECORDED, legend, page};

/// Colours in the order of the curves; the last four are those of Okabe and Ito (2008) that no other picture uses.
const COLOURS: [&str; 8] = [
    NAMED, NOMINAL, NOISE, RECORDED, "#cc79a7", "#56b4e9", "#e69f00", "#222222",
];

/// Height of a panel, and the most that a map may take.
const HEIGHT: f64 = 260.0;
const MOST: f64 = 760.0;
/// Room above a panel for its legend, for that of its field, and below it for ticks and label.
const ABOVE: f64 = 34.0;
const FIELD: f64 = 20.0;
const BELOW: f64 = 44.0;

/// The picture as SVG.
pub fn figure(picture: &Picture) -> String {
    let placed: Vec<(&Content, Scale, Scale, f64)> = picture
        .panels
        .iter()
        .map(|content| {
            let (x, y, height) = scales(content);
            (content, x, y, height)
        })
        .collect();
    let heights = placed
        .iter()
        .map(|(content, .., height)| above(content) + height + BELOW);
    let mut page = page(
        62.0 + heights.sum::<f64>(),
        &picture.title,
        &picture.subtitle,
    );
    let mut top = 62.0;
    for (index, (content, x, y, height)) in placed.into_iter().enumerate() {
        let colours = colours(&content.curves);
        let named = content.curves.iter().zip(&colours);
        let names: Vec<(&str, &str, f64)> = named
            .filter(|(curve, _)| !curve.name.is_empty())
            .map(|(curve, colour)| (curve.name.as_str(), *colour, stroke_width(curve.mark)))
            .collect();
        page = legend(page, top + 22.0, &names);
        let mut panel = Panel::new(top + above(content), height, x, y);
        if let Some(shaded) = &content.field {
            for run in field::runs(shaded) {
                panel.fill(run.low, run.high, run.colour);
            }
            let bands = field::bands(shaded);
            let bands: Vec<(&str, &str, f64)> =
                bands.iter().map(|(n, c)| (n.as_str(), *c, 12.0)).collect();
            page = legend(page, top + 22.0 + FIELD, &bands);
        }
        for (curve, colour) in content.curves.iter().zip(&colours) {
            draw(&mut panel, curve, colour);
        }
        page = page.add(panel.finish(&format!("panel-{index}")));
        top += above(content) + height + BELOW;
    }
    page.to_string()
}

/// Room above a panel.
fn above(content: &Content) -> f64 {
    ABOVE + content.field.as_ref().map_or(0.0, |_| FIELD)
}

fn draw(panel: &mut Panel, curve: &Curve, colour: &str) {
    match curve.mark {
        Mark::Dots => panel.dots(&curve.x, &curve.y, colour),
        Mark::Line | Mark::Thin => {
            panel.path(&curve.x, &curve.y, colour, stroke_width(curve.mark));
        }
    }
}

const fn stroke_width(mark: Mark) -> f64 {
    match mark {
        Mark::Line => 1.6,
        Mark::Thin => 0.7,
        Mark::Dots => 3.0,
    }
}

/// A colour for each curve; one without a name takes the colour of the curve before it.
fn colours(curves: &[Curve]) -> Vec<&'static str> {
    let mut next = COLOURS.iter().copied().cycle();
    let mut colour = NAMED;
    let mut first = true;
    let pick = |curve: &Curve| {
        if first || !curve.name.is_empty() {
            colour = next.next().unwrap_or(NAMED);
        }
        first = false;
        colour
    };
    curves.iter().map(pick).collect()
}

/// Both scales and the height of a panel.
fn scales(content: &Content) -> (Scale, Scale, f64) {
    let shaded: Vec<Run> = content.field.iter().flat_map(field::runs).collect();
    let along = |pick: fn(&Curve) -> &Vec<f64>, corner: fn(&[f64; 2]) -> f64| {
        let corners = shaded.iter().flat_map(|run| [run.low, run.high]);
        let corners: Vec<f64> = corners.map(|point| corner(&point)).collect();
        range(content.curves.iter().flat_map(pick).copied().chain(corners))
    };
    let (x_low, x_high) = along(|curve| &curve.x, |[x, _]| *x);
    let (y_low, y_high) = along(|curve| &curve.y, |[_, y]| *y);
    let scale = |low, high, axis: &Axis| Scale::around(low, high, &axis.quantity, &axis.unit);
    if !content.equal_scales {
        let (x, y) = (
            scale(x_low, x_high, &content.x),
            scale(y_low, y_high, &content.y),
        );
        return (x, y, HEIGHT);
    }
    let (across, up) = (x_high - x_low, y_high - y_low);
    let height = (width() * up / across).clamp(HEIGHT, MOST);
    // The direction with room to spare is widened, so that both are drawn at one scale.
    let metre = (across / width()).max(up / height);
    let widen = |low: f64, high: f64, pixels: f64| {
        let room = 0.5 * (metre * pixels - (high - low)).max(0.0);
        (low - room, high + room)
    };
    let (x_low, x_high) = widen(x_low, x_high, width());
    let (y_low, y_high) = widen(y_low, y_high, height);
    let (x, y) = (
        scale(x_low, x_high, &content.x),
        scale(y_low, y_high, &content.y),
    );
    (x, y, height)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(content: Content) -> Picture {
        Picture {
            name: "path".to_owned(),
            title: "Path".to_owned(),
            subtitle: "of the tip".to_owned(),
            panels: vec![content],
        }
    }

    #[test]
    fn a_map_has_one_scale_in_both_directions() {
        for (across, up) in [(0.37, 0.21), (0.13, 0.92), (1.7, 0.05)] {
            let curve = Curve::line("tip", &[0.1, 0.1 + across], &[-0.3, -0.3 + up]);
            let content = Content::new(("x", "m"), ("y", "m"), vec![curve]).map();
            let (x, y, height) = scales(&content);
            let ratio = (x.high - x.low) / width() / ((y.high - y.low) / height);
            assert!((ratio - 1.0).abs() < 1e-9, "{ratio}");
            assert!((HEIGHT..=MOST).contains(&height));
        }
    }

    #[test]
    fn a_curve_without_a_name_belongs_to_the_one_before() {
        let line = |name: &str| Curve::line(name, &[0.3, 0.7], &[1.3, 1.9]);
        let curves = [line("a"), line(""), line("b")];
        let given = colours(&curves);
        assert_eq!(given[0], given[1]);
        assert_ne!(given[1], given[2]);
        let drawn = figure(&picture(Content::new(
            ("t", "s"),
            ("q", "rad"),
            curves.into(),
        )));
        assert_eq!(drawn.matches("<polyline").count(), 3);
        assert!(drawn.contains("q (rad)") && drawn.contains("\na\n"));
    }
}
