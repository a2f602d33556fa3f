//! This file holds tables C.1 to C.6: what three people did with the five methods on two lines and two layouts.

use crate::layout::Layout;
use crate::methods::Method;

/// The averages of one cell: one operator, layout, method and line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Averages {
    /// Average path error (6.14), cm.
    pub path_error_cm: f64,
    /// Average tip force (6.16b), N.
    pub tip_force_n: f64,
    /// DFT sum of acceleration (6.20) over 10⁵, in a unit and for a length of record that the thesis does not give.
    pub dft_sum_e5: f64,
}

/// The operators of the human-subject experiment.
pub const OPERATORS: [u8; 3] = [1, 2, 3];
/// The lines of figure 6.11.
pub const LINES: [u8; 2] = [1, 2];
/// The order of the rows of tables C.1 to C.6; "controlled gap" is the SDOF controller without a gap.
pub const ROWS: [Method; 5] = [
    Method::Uncontrolled,
    Method::Sdof,
    Method::SdofWithGap,
    Method::ProportionalHigh,
    Method::ProportionalLow,
];
/// A cell that the thesis prints as two dashes.
const DASH: f64 = f64::NAN;

/// The cell of an operator, or `None` for an operator or a line that was not there and for a cell without data.
pub fn averages(operator: u8, layout: Layout, method: Method, line: u8) -> Option<Averages> {
    let table = table(operator, layout)?;
    let row = ROWS.iter().position(|row| *row == method)?;
    let [error_1, error_2, force_1, force_2, sum_1, sum_2] = *table.get(row)?;
    let [path_error_cm, tip_force_n, dft_sum_e5] = match line {
        1 => [error_1, force_1, sum_1],
        2 => [error_2, force_2, sum_2],
        _ => return None,
    };
    (!path_error_cm.is_nan()).then_some(Averages {
        path_error_cm,
        tip_force_n,
        dft_sum_e5,
    })
}

/// How many of a cell's three recordings were empty.
pub const fn missing_recordings(operator: u8, layout: Layout, method: Method, line: u8) -> u8 {
    match (operator, layout, method, line) {
        (1, Layout::ThreeBrake, Method::Uncontrolled, 2) => 2,
        (2, Layout::ThreeBrake, Method::Uncontrolled, 1) => 3,
        _ => 0,
    }
}

/// Rows as [`ROWS`]; columns: path error on line 1 and 2, force on line 1 and 2, DFT sum on line 1 and 2.
const fn table(operator: u8, layout: Layout) -> Option<[[f64; 6]; 5]> {
    match (operator, layout) {
        (1, Layout::ThreeBrake) => Some(C_1),
        (2, Layout::ThreeBrake) => Some(C_2),
        (3, Layout::ThreeBrake) => Some(C_3),
        (1, Layout::FourBrake) => Some(C_4),
        (2, Layout::FourBrake) => Some(C_5),
        (3, Layout::FourBrake) => Some(C_6),
        _ => None,
    }
}

const C_1: [[f64; 6]; 5] = [
    [0.568, 1.674, 4.47, 4.36, 0.880, 0.569],
    [0.156, 0.308, 7.57, 9.90, 2.161, 0.909],
    [0.193, 0.179, 5.41, 2.83, 0.715, 0.496],
    [0.309, 0.222, 7.97, 8.69, 1.462, 0.533],
    [0.219, 0.162, 4.09, 3.37, 0.593, 0.351],
];
const C_2: [[f64; 6]; 5] = [
    [DASH, 0.575, DASH, 0.75, DASH, 0.404],
    [0.151, 0.088, 5.35, 9.29, 2.780, 0.855],
    [0.181, 0.184, 3.45, 2.31, 1.007, 0.442],
    [0.131, 0.215, 5.51, 7.95, 1.701, 0.673],
    [0.073, 0.192, 2.86, 2.57, 0.267, 0.279],
];
const C_3: [[f64; 6]; 5] = [
    [0.599, 0.787, 1.51, 1.36, 0.547, 0.475],
    [0.164, 0.280, 4.99, 9.36, 3.579, 3.058],
    [0.182, 0.256, 3.67, 3.15, 0.771, 0.549],
    [0.235, 0.312, 5.27, 8.16, 4.360, 1.218],
    [0.120, 0.332, 2.65, 3.72, 0.387, 0.596],
];
const C_4: [[f64; 6]; 5] = [
    [0.705, 0.657, 5.40, 2.93, 0.545, 0.431],
    [0.174, 0.390, 6.69, 9.28, 1.330, 1.788],
    [0.225, 0.273, 5.91, 5.37, 0.861, 0.696],
    [0.135, 0.200, 6.66, 9.69, 1.339, 1.235],
    [0.255, 0.285, 4.95, 5.22, 0.584, 0.470],
];
const C_5: [[f64; 6]; 5] = [
    [0.582, 0.558, 1.96, 1.95, 0.542, 0.445],
    [0.175, 0.325, 5.29, 8.94, 2.095, 1.805],
    [0.192, 0.223, 4.40, 7.69, 0.551, 1.337],
    [0.179, 0.163, 6.34, 8.73, 1.510, 0.905],
    [0.101, 0.157, 3.90, 4.91, 0.520, 0.510],
];
const C_6: [[f64; 6]; 5] = [
    [1.312, 1.517, 1.50, 2.38, 0.871, 0.811],
    [0.146, 0.374, 5.11, 9.56, 1.790, 3.118],
    [0.281, 0.472, 4.80, 5.34, 0.965, 1.374],
    [0.598, 0.258, 3.79, 9.98, 1.482, 2.159],
    [0.453, 0.606, 2.64, 2.62, 0.826, 0.752],
];
