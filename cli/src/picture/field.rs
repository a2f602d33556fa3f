//! This file shades a field over the plane in bands, as a contour map.

use rigproof_experiments::Field;

/// Colours of the bands, darker with the value; the last one serves every band after it.
const COLOURS: [&str; 7] = [
    "#fde725", "#a0da39", "#4ac16d", "#1fa187", "#277f8e", "#46327e", "#2b0a3d",
];

/// Neighbouring cells of a row that stand in the same band.
pub struct Run {
    /// The lower left corner.
    pub low: [f64; 2],
    /// The upper right corner.
    pub high: [f64; 2],
    /// The colour of the band.
    pub colour: &'static str,
    row: usize,
    end: usize,
}

/// The field as rectangles; cells without a value are left out.
pub fn runs(field: &Field) -> Vec<Run> {
    let columns = field.columns.max(1);
    let mut runs: Vec<Run> = Vec::new();
    for (index, value) in field.values.iter().enumerate() {
        if !value.is_finite() {
            continue;
        }
        let (row, column, colour) = (index / columns, index % columns, band(field, *value));
        let high = corner(field, column + 1, row + 1);
        match runs.last_mut() {
            Some(run) if run.row == row && run.end == column && run.colour == colour => {
                run.end += 1;
                run.high = high;
            }
            _ => runs.push(Run {
                low: corner(field, column, row),
                high,
                colour,
                row,
                end: column + 1,
            }),
        }
    }
    runs
}

/// The bands with their colours, for a legend.
pub fn bands(field: &Field) -> Vec<(String, &'static str)> {
    let unit = match field.unit.as_str() {
        "°" => "°".to_owned(),
        unit => format!(" {unit}"),
    };
    let pairs = field.bounds.iter().zip(field.bounds.iter().skip(1));
    pairs
        .map(|(least, greatest)| {
            let name = format!("{least} to {greatest}{unit}");
            (name, band(field, *greatest))
        })
        .collect()
}

fn corner(field: &Field, column: usize, row: usize) -> [f64; 2] {
    let [x, y] = field.origin;
    [x + column as f64 * field.step, y + row as f64 * field.step]
}

/// The colour of the first band that the value does not exceed; below the first band there is that of the first.
fn band(field: &Field, value: f64) -> &'static str {
    let [.., last] = COLOURS;
    let mut ends = field.bounds.iter().skip(1).zip(COLOURS);
    let within = ends.find(|(end, _)| value <= **end);
    within.map_or(last, |(_, colour)| colour)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_of_one_band_are_one_rectangle_and_gaps_stay_empty() {
        let field = Field {
            step: 0.5,
            origin: [-1.5, 0.25],
            columns: 4,
            values: vec![46.0, 59.9, f64::NAN, 71.0, 61.0, 61.0, 61.0, 61.0],
            bounds: vec![45.0, 60.0, 75.0],
            unit: "°".to_owned(),
        };
        let runs = runs(&field);
        let corners: Vec<([f64; 2], [f64; 2])> = runs.iter().map(|r| (r.low, r.high)).collect();
        assert_eq!(
            corners,
            [
                ([-1.5, 0.25], [-0.5, 0.75]),
                ([0.0, 0.25], [0.5, 0.75]),
                ([-1.5, 0.75], [0.5, 1.25])
            ]
        );
        assert_ne!(runs[0].colour, runs[1].colour);
        let bands = bands(&field);
        assert_eq!(bands[0], ("45 to 60°".to_owned(), runs[0].colour));
        assert_eq!(bands[1].1, runs[2].colour);
    }
}
