//! This file thins a curve to what a screen can show, and keeps its extremes.

/// Keeps in every column of pixels the lowest and the highest point, in the order in which they come.
///
/// `points` are pixels with growing x; those that are not finite are left out.
pub fn thinned(points: impl IntoIterator<Item = (f64, f64)>) -> Vec<(f64, f64)> {
    let mut kept: Vec<(f64, f64)> = Vec::new();
    let mut column: Option<Column> = None;
    for (x, y) in points {
        if !x.is_finite() || !y.is_finite() {
            continue;
        }
        match &mut column {
            Some(open) if open.index == x.floor() => open.take(x, y),
            _ => {
                kept.extend(column.iter().flat_map(Column::points));
                column = Some(Column {
                    index: x.floor(),
                    lowest: (x, y),
                    highest: (x, y),
                });
            }
        }
    }
    kept.extend(column.iter().flat_map(Column::points));
    kept
}

/// The stretches of a curve between points that are not finite, without the points that nobody could tell from
/// the one before.
pub fn interrupted(points: impl IntoIterator<Item = (f64, f64)>) -> Vec<Vec<(f64, f64)>> {
    let mut stretches: Vec<Vec<(f64, f64)>> = vec![Vec::new()];
    for (x, y) in points {
        let Some(open) = stretches.last_mut() else {
            continue;
        };
        if !x.is_finite() || !y.is_finite() {
            stretches.push(Vec::new());
        } else if open
            .last()
            .is_none_or(|(a, b)| (x - a).abs().max((y - b).abs()) > LEAST_PIXELS)
        {
            open.push((x, y));
        }
    }
    stretches.retain(|stretch| !stretch.is_empty());
    stretches
}

/// Distance below which two points of a curve fall together.
const LEAST_PIXELS: f64 = 0.3;

struct Column {
    index: f64,
    lowest: (f64, f64),
    highest: (f64, f64),
}

impl Column {
    fn take(&mut self, x: f64, y: f64) {
        if y < self.lowest.1 {
            self.lowest = (x, y);
        }
        if y > self.highest.1 {
            self.highest = (x, y);
        }
    }

    fn points(&self) -> Vec<(f64, f64)> {
        let (a, b) = (self.lowest, self.highest);
        if a == b {
            vec![a]
        } else if a.0 < b.0 {
            vec![a, b]
        } else {
            vec![b, a]
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spike_of_one_sample_stays() {
        let points = (0..10_000).map(|k| {
            let y = if k == 4_321 { 77.7 } else { f64::from(k % 7) };
            (f64::from(k) * 0.013, y)
        });
        let kept = thinned(points);
        assert!(kept.len() <= 2 * 131, "{}", kept.len());
        assert!(kept.iter().any(|(_, y)| *y == 77.7));
        assert!(kept.windows(2).all(|pair| pair[0].0 <= pair[1].0));
    }

    #[test]
    fn a_curve_that_turns_back_keeps_its_turns_and_its_gaps() {
        let points = [
            (1.3, 2.0),
            (1.4, 2.1),
            (5.5, 2.2),
            (f64::NAN, 2.3),
            (0.2, 7.7),
        ];
        let kept = interrupted(points);
        assert_eq!(kept, [vec![(1.3, 2.0), (5.5, 2.2)], vec![(0.2, 7.7)]]);
    }

    #[test]
    fn few_points_stay_as_they_are_and_missing_ones_are_left_out() {
        let points = [(0.5, 3.0), (1.5, f64::NAN), (2.5, -4.0), (9.1, 2.0)];
        assert_eq!(thinned(points), [(0.5, 3.0), (2.5, -4.0), (9.1, 2.0)]);
    }
}
