//! This file says that tables 6.1, 6.2 and C.1 to C.6 agree with their second transcription, and what they say themselves.

use rigproof_spec::layout::Layout;
use rigproof_spec::methods::{Method, Setting};
use rigproof_spec::trials::{Averages, LINES, OPERATORS, ROWS, averages, missing_recordings};

/// The cells of `spec/thesis/tables/<name>.csv`, below the headings.
fn rows(name: &str) -> Vec<Vec<String>> {
    let path = format!(
        "{}/../spec/thesis/tables/{name}.csv",
        env!("CARGO_MANIFEST_DIR")
    );
    csv::Reader::from_path(path)
        .unwrap()
        .records()
        .map(|record| record.unwrap().iter().map(str::to_owned).collect())
        .collect()
}

const TABLES: [(&str, u8, Layout); 6] = [
    ("C.1", 1, Layout::ThreeBrake),
    ("C.2", 2, Layout::ThreeBrake),
    ("C.3", 3, Layout::ThreeBrake),
    ("C.4", 1, Layout::FourBrake),
    ("C.5", 2, Layout::FourBrake),
    ("C.6", 3, Layout::FourBrake),
];

const LAYOUTS: [Layout; 2] = [Layout::ThreeBrake, Layout::FourBrake];

/// Every cell that was printed: operator, layout, method, line and its averages.
fn cells() -> Vec<(u8, Layout, Method, u8, Averages)> {
    let mut cells = Vec::new();
    for operator in OPERATORS {
        for layout in LAYOUTS {
            for method in Method::ALL {
                for line in LINES {
                    if let Some(averages) = averages(operator, layout, method, line) {
                        cells.push((operator, layout, method, line, averages));
                    }
                }
            }
        }
    }
    cells
}

#[test]
fn table_6_1_agrees_with_its_second_transcription() {
    let names = [
        "None",
        "SDOF without gap",
        "SDOF with gap",
        "Proportional (low gain)",
        "Proportional (high gain)",
    ];
    let table = rows("6.1");
    assert_eq!(table.len(), Method::ALL.len());
    for ((method, name), row) in Method::ALL.into_iter().zip(names).zip(table) {
        let (gap, gain) = match method.setting() {
            Setting::Nothing => (None, None),
            Setting::GapCm(gap) => (Some(gap), None),
            Setting::GainPrinted(gain) => (None, Some(gain)),
        };
        assert_eq!(row[0], method.experiment().to_string());
        assert_eq!(row[1], name);
        assert_eq!(row[2].parse().ok(), gap);
        assert_eq!(row[3].parse().ok(), gain);
    }
}

#[test]
fn table_6_2_agrees_with_its_second_transcription() {
    let order = [
        Method::Uncontrolled,
        Method::Sdof,
        Method::SdofWithGap,
        Method::ProportionalHigh,
        Method::ProportionalLow,
    ];
    let table = rows("6.2");
    assert_eq!(table.len(), order.len());
    for (method, row) in order.into_iter().zip(table) {
        assert_eq!(row[0], method.abbreviation());
    }
}

#[test]
fn tables_c_agree_with_their_second_transcription() {
    let mut missing = 0;
    for (name, operator, layout) in TABLES {
        let table = rows(name);
        assert_eq!(table.len(), ROWS.len());
        for (method, row) in ROWS.into_iter().zip(table) {
            for line in LINES {
                let printed: Vec<&str> = [0, 2, 4]
                    .map(|column| row[column + usize::from(line)].as_str())
                    .to_vec();
                let stars = printed[0].matches('*').count() as u8;
                let numbers: Option<Vec<f64>> = printed
                    .iter()
                    .map(|cell| cell.trim_end_matches('*').parse().ok())
                    .collect();
                let ours = averages(operator, layout, method, line)
                    .map(|cell| vec![cell.path_error_cm, cell.tip_force_n, cell.dft_sum_e5]);
                assert_eq!(ours, numbers, "table {name}, {method:?}, line {line}");
                // One star means two recordings missing, two stars three.
                let expected = if stars == 0 { 0 } else { stars + 1 };
                assert_eq!(missing_recordings(operator, layout, method, line), expected);
                missing += expected;
            }
        }
    }
    // §6.5.1: five of the 180 sets of data were empty.
    assert_eq!(missing, 5);
    assert_eq!(cells().len(), 59);
}

#[test]
fn path_error_is_greater_on_line_2_in_21_of_29_cells() {
    let (mut greater, mut compared) = (0, 0);
    for (operator, layout, method, line, second) in cells() {
        if line == 2
            && let Some(first) = averages(operator, layout, method, 1)
        {
            compared += 1;
            greater += u32::from(second.path_error_cm > first.path_error_cm);
        }
    }
    assert_eq!((greater, compared), (21, 29));
}

/// In how many cells a quantity of one method is below that of another, and of how many.
fn below(one: Method, other: Method, quantity: fn(Averages) -> f64) -> (u32, u32) {
    let (mut count, mut compared) = (0, 0);
    for (operator, layout, method, line, ours) in cells() {
        if method == one
            && let Some(theirs) = averages(operator, layout, other, line)
        {
            compared += 1;
            count += u32::from(quantity(ours) < quantity(theirs));
        }
    }
    (count, compared)
}

#[test]
fn every_controller_has_less_path_error_than_none_in_every_cell() {
    for method in Method::ALL.into_iter().skip(1) {
        let (count, compared) = below(method, Method::Uncontrolled, |cell| cell.path_error_cm);
        assert_eq!((count, compared), (11, 11), "{method:?}");
    }
}

#[test]
fn the_gap_lowers_force_and_smoothness_sum_and_costs_accuracy() {
    let (with, without) = (Method::SdofWithGap, Method::Sdof);
    assert_eq!(below(with, without, |cell| cell.tip_force_n), (12, 12));
    assert_eq!(below(with, without, |cell| cell.dft_sum_e5), (12, 12));
    assert_eq!(below(without, with, |cell| cell.path_error_cm), (8, 12));
}

#[test]
fn the_low_gain_is_lighter_and_smoother_than_the_high_gain() {
    let (low, high) = (Method::ProportionalLow, Method::ProportionalHigh);
    assert_eq!(below(low, high, |cell| cell.tip_force_n), (12, 12));
    assert_eq!(below(low, high, |cell| cell.dft_sum_e5), (12, 12));
}

/// Mean of a quantity over the cells of one method.
fn mean(method: Method, quantity: fn(Averages) -> f64) -> f64 {
    let of: Vec<f64> = cells()
        .into_iter()
        .filter(|(_, _, row, _, _)| *row == method)
        .map(|(_, _, _, _, averages)| quantity(averages))
        .collect();
    of.iter().sum::<f64>() / of.len() as f64
}

#[test]
fn the_low_gain_is_as_smooth_as_no_control_but_not_as_light() {
    // §6.6: "similar levels of workload and smoothness to the uncontrolled experiment".
    let (low, none) = (Method::ProportionalLow, Method::Uncontrolled);
    let smoothness = mean(low, |cell| cell.dft_sum_e5) / mean(none, |cell| cell.dft_sum_e5);
    let force = mean(low, |cell| cell.tip_force_n) / mean(none, |cell| cell.tip_force_n);
    assert!((smoothness - 0.86).abs() < 0.005, "{smoothness}");
    assert!((force - 1.40).abs() < 0.005, "{force}");
}

#[test]
fn proportional_control_is_smoother_than_sdof_only_gain_by_gain() {
    // §6.6: "overall the proportional controller exhibited lower workload and higher levels of smoothness".
    let sum = |method| mean(method, |cell: Averages| cell.dft_sum_e5);
    assert!(sum(Method::ProportionalHigh) < sum(Method::Sdof));
    assert!(sum(Method::ProportionalLow) < sum(Method::SdofWithGap));
    assert!(sum(Method::ProportionalHigh) > sum(Method::SdofWithGap));
}
