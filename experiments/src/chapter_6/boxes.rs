//! This file draws the box and whisker plots of figures 6.13 to 6.15, as §6.6 describes them.

use rigproof_spec::layout::Layout;

use super::compared::Compared;
use super::trials::ALL;
use crate::outline;
use crate::{Curve, Panel};

/// Half the width of a box, in places of the axis, and of the ends of its whiskers.
const HALF: f64 = 0.22;
const END: f64 = 0.1;

/// What a box and its whiskers show.
#[derive(Clone, Debug, PartialEq)]
pub struct Five {
    pub median: f64,
    /// Lower and upper.
    pub quartiles: [f64; 2],
    /// The least and the greatest value that is no outlier.
    pub whiskers: [f64; 2],
    /// "Points that are a distance of more than 1.5 times the span of the box away from the box boundary" (§6.6).
    pub outliers: Vec<f64>,
}

impl Five {
    /// Of values in any order; no values give no numbers.
    pub fn of(values: &[f64]) -> Five {
        let mut sorted = values.to_vec();
        sorted.sort_by(f64::total_cmp);
        let quartiles = [quantile(&sorted, 0.25), quantile(&sorted, 0.75)];
        let [low, high] = quartiles;
        let far = 1.5 * (high - low);
        let near = |value: &&f64| (low - far..=high + far).contains(*value);
        let least = sorted.iter().find(near).copied().unwrap_or(f64::NAN);
        let greatest = sorted.iter().rev().find(near).copied().unwrap_or(f64::NAN);
        Five {
            median: quantile(&sorted, 0.5),
            quartiles,
            whiskers: [least, greatest],
            outliers: sorted.iter().filter(|v| !near(v)).copied().collect(),
        }
    }

    /// The span of the box.
    pub fn span(&self) -> f64 {
        let [low, high] = self.quartiles;
        high - low
    }

    /// Box, whiskers and outliers around a place of the axis.
    fn curve(&self, name: &str, place: f64) -> Curve {
        let ([low, high], [least, greatest]) = (self.quartiles, self.whiskers);
        let (left, right) = (place - HALF, place + HALF);
        let mut strokes = vec![
            vec![
                (left, low),
                (right, low),
                (right, high),
                (left, high),
                (left, low),
            ],
            vec![(left, self.median), (right, self.median)],
            vec![(place, low), (place, least)],
            vec![(place - END, least), (place + END, least)],
            vec![(place, high), (place, greatest)],
            vec![(place - END, greatest), (place + END, greatest)],
        ];
        let cross = |value: &f64| vec![(place - 0.04, *value), (place + 0.04, *value)];
        strokes.extend(self.outliers.iter().map(cross));
        let gap = [(f64::NAN, f64::NAN)];
        let points = strokes
            .into_iter()
            .flat_map(|stroke| stroke.into_iter().chain(gap));
        let (x, y): (Vec<f64>, Vec<f64>) = points.unzip();
        Curve::line(name, &x, &y)
    }
}

/// A share of sorted values: half a value belongs to each side of it, as in MATLAB.
fn quantile(sorted: &[f64], share: f64) -> f64 {
    let at = share * sorted.len() as f64 - 0.5;
    let below = at.clamp(0.0, (sorted.len() as f64 - 1.0).max(0.0));
    let index = below as usize;
    let value = |index: usize| sorted.get(index).copied();
    let Some(low) = value(index) else {
        return f64::NAN;
    };
    low + (value(index + 1).unwrap_or(low) - low) * (below - index as f64)
}

/// The boxes of a configuration, and the people beside them.
pub fn panel(compared: &Compared, layout: Layout) -> Panel {
    let mut curves = Vec::new();
    let (mut x, mut y) = (Vec::new(), Vec::new());
    for (place, tried) in (1..).map(f64::from).zip(ALL) {
        let five = compared.five(layout, tried);
        curves.push(five.curve(tried.letter, place));
        // The people knew one low gain; they stand beside the one that behaves as theirs.
        if tried.letter.len() == 1 {
            let cells = compared.printed(layout, tried);
            x.extend(cells.iter().map(|_| place + 1.6 * HALF));
            y.extend(cells);
        }
    }
    curves.push(Curve::dots("people", &x, &y));
    let metric = &compared.metric;
    let places = format!(
        "{} configuration: 1 N, 2 S, 3 G, 4 H, 5 L (table 6.2), 6 L in the printed unit",
        outline::name(layout)
    );
    if !metric.logarithmic {
        return Panel::new((&places, ""), (metric.name, metric.unit), curves);
    }
    for value in curves.iter_mut().flat_map(|curve| &mut curve.y) {
        *value = libm::log10(*value);
    }
    let quantity = format!("log10 of the {} in {}", metric.name, metric.unit);
    Panel::new((&places, ""), (&quantity, ""), curves)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_box_spans_the_middle_half_and_its_whiskers_leave_outliers_out() {
        let values = [7.1, 1.3, 2.9, 3.7, 4.3, 2.3, 3.1, 19.7];
        let five = Five::of(&values);
        // Sorted: 1.3 2.3 2.9 3.1 3.7 4.3 7.1 19.7; the quartiles lie halfway between the second and third, sixth and seventh.
        assert!((five.median - 3.4).abs() < 1e-12);
        assert!((five.quartiles[0] - 2.6).abs() < 1e-12 && (five.quartiles[1] - 5.7).abs() < 1e-12);
        assert_eq!(five.whiskers, [1.3, 7.1]);
        assert_eq!(five.outliers, [19.7]);
    }

    #[test]
    fn one_value_is_its_own_box() {
        let five = Five::of(&[3.3]);
        assert_eq!(
            (five.median, five.quartiles, five.span()),
            (3.3, [3.3; 2], 0.0)
        );
        assert!(Five::of(&[]).median.is_nan());
    }
}
