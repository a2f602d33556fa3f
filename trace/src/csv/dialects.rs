//! This file holds the dialects that loggers write: each is read, said, and reads back to the same bits.

use std::path::Path;

use proptest::prelude::*;

use super::*;
use crate::series::{Channel, Trace};

/// Rows of a time and two channels, with points.
fn rows(count: usize) -> Vec<[String; 3]> {
    let row = |k: usize| {
        let k = k as f64;
        [0.25 + 1e-3 * k, 1.5 - 0.75 * k, -3.25e-5 * (k + 0.5)].map(|x| format!("{x:?}"))
    };
    (0..count).map(row).collect()
}

/// The same rows with another separator and decimal mark, each line between `before` and `after`.
fn table(separator: &str, comma: bool, before: &str, after: &str) -> String {
    let line = |row: [String; 3]| {
        let line = row.join(separator);
        let line = if comma { line.replace('.', ",") } else { line };
        format!("{before}{line}{after}\r\n")
    };
    rows(20).into_iter().map(line).collect()
}

fn read_text(text: &str, hints: &Hints) -> Result<(Trace, Dialect), String> {
    parse_as(text.as_bytes(), Path::new("run.csv"), None, hints).map_err(|error| error.to_string())
}

/// Checks the numbers of [`rows`] and gives names with units and the dialect in words.
fn read_back(text: &str) -> (Vec<String>, String) {
    let (trace, dialect) = read_text(text, &Hints::default()).unwrap();
    let columns: Vec<&[f64]> = trace
        .channels
        .iter()
        .map(|c| c.samples.as_slice())
        .collect();
    assert_eq!((trace.len(), columns.len()), (20, 2), "{text}");
    for (k, [time, first, second]) in rows(20).iter().enumerate() {
        let read = [trace.time_s[k], columns[0][k], columns[1][k]].map(|x| format!("{x:?}"));
        assert_eq!([&read[0], &read[1], &read[2]], [time, first, second]);
    }
    let names = trace
        .channels
        .iter()
        .map(|c| format!("{}|{}", c.name, c.unit));
    (names.collect(), dialect.to_string())
}

#[test]
fn labview_measurement_files_are_read() {
    let head = "LabVIEW Measurement\t\r\nWriter_Version\t2\r\nReader_Version\t2\r\nSeparator\tTab\r\n\
        Decimal_Separator\t,\r\nMulti_Headings\tNo\r\nX_Columns\tOne\r\nTime_Pref\tRelative\r\nDate\t2024/05/06\r\n\
        Time\t10:11:12,123\r\n***End_of_Header***\t\r\n\t\r\nChannels\t2\t\t\r\nSamples\t20\t20\t\r\n\
        Y_Unit_Label\tVolts\tVolts\t\r\nX0\t0,0\t0,0\t\r\nDelta_X\t0,001\t0,001\t\r\n***End_of_Header***\t\t\t\r\n\
        X_Value\tVoltage_0\tVoltage_1\tComment\r\n";
    let said = "separator tab, decimal ',', 18 header lines, UTF-8";
    for after in ["", "\t"] {
        let (names, dialect) = read_back(&format!("{head}{}", table("\t", true, "", after)));
        assert_eq!(
            (names.join(" "), dialect.as_str()),
            ("Voltage_0| Voltage_1|".into(), said)
        );
    }
}

#[test]
fn controldesk_exports_are_read() {
    let head = "format;tagged csv\r\nrecorder_name;Recorder 1\r\n\r\ndevice;;Platform;Platform\r\n\
        path;;Model Root/Axis;Model Root/Axis\r\ntrace_names;;x;u\r\nunit;s;mm;V\r\n";
    let rows = table(";", true, ";", "");
    let (names, dialect) = read_back(&format!("{head}trace_values{rows}"));
    assert_eq!(names, ["x|mm", "u|V"]);
    assert_eq!(
        dialect,
        "separator ';', decimal ',', 5 header lines, units row, UTF-8"
    );
}

#[test]
fn tables_that_matlab_writes_are_read() {
    let (names, dialect) = read_back(&format!("Time,qm_m,Var3\r\n{}", table(",", false, "", "")));
    assert_eq!(names, ["qm_m|", "Var3|"]);
    assert_eq!(dialect, "separator ',', decimal '.', 0 header lines, UTF-8");
    let (names, _) = read_back(&format!("t x u\n{}", table("   ", false, " ", " ")));
    assert_eq!(names, ["x|", "u|"]);
}

#[test]
fn oscilloscope_exports_are_read() {
    let tektronix = "Model,MSO54\r\nPoint Format,Y,\r\nHorizontal Units,s,\r\nSample Interval,1e-3\r\n\
        Record Length,20,\r\nProbe Attenuation,1,1\r\nVertical Units,V,V\r\n,,\r\nLabels,,\r\nTIME,CH1,CH2\r\n";
    let keysight = "x-axis,1,2\r\nsecond,Volt,Ampere\r\n";
    let siglent = "Record Length,Analog:20\r\nSample Interval,Analog:0.001\r\nSource,CH1,CH2\r\nSecond,Volt,Volt\r\n";
    for (head, after, names, said) in [
        (tektronix, "", ["CH1|", "CH2|"], "9 header lines"),
        (keysight, "", ["1|V", "2|A"], "0 header lines, units row"),
        (siglent, "", ["CH1|V", "CH2|V"], "2 header lines, units row"),
        (tektronix, ",,", ["CH1|", "CH2|"], "9 header lines"),
    ] {
        let (found, dialect) = read_back(&format!("{head}{}", table(",", false, "", after)));
        assert_eq!(found, names);
        assert_eq!(
            dialect,
            format!("separator ',', decimal '.', {said}, UTF-8")
        );
    }
}

#[test]
fn a_rigol_counts_samples_and_says_its_step() {
    let rows: String = (0..20)
        .map(|k| format!("{k},{}.5,1.25,,\n", 3 * k))
        .collect();
    let text = format!("X,CH1,CH2,Start,Increment\nSequence,Volt,Volt,-6.0e-3,2.5e-4\n{rows}");
    let (trace, dialect) = read_text(&text, &Hints::default()).unwrap();
    assert!(dialect.units_row);
    assert_eq!(trace.time_s[7], -6.0e-3 + 2.5e-4 * 7.0);
    let names: Vec<&str> = trace.channels.iter().map(|c| c.name.as_str()).collect();
    assert_eq!(
        (names, trace.channels[0].samples[7]),
        (vec!["CH1", "CH2"], 21.5)
    );
}

#[test]
fn a_rigol_whose_increment_is_nothing_is_refused() {
    let rows: String = (0..20).map(|k| format!("{k},0.5,1.25,,\n")).collect();
    let text = format!("X,CH1,CH2,Start,Increment\nSequence,Volt,Volt,-6.0e-3,2.5e-420\n{rows}");
    let said = read_text(&text, &Hints::default()).unwrap_err().to_string();
    assert!(
        said.contains("line 4") && said.contains("column 1"),
        "{said}"
    );
}

#[test]
fn sixteen_bit_text_and_quoted_decimal_commas_are_read() {
    let text = format!("\u{feff}t_s;x [mm];µ\r\n{}", table(";", true, "", ";"));
    let units = text.encode_utf16();
    let little: Vec<u8> = units.clone().flat_map(u16::to_le_bytes).collect();
    let big: Vec<u8> = units.flat_map(u16::to_be_bytes).collect();
    for (bytes, encoding) in [
        (little, Encoding::Utf16Le),
        (big, Encoding::Utf16Be),
        (text.into_bytes(), Encoding::Utf8),
    ] {
        let read = parse_as(
            bytes.as_slice(),
            Path::new("run.csv"),
            None,
            &Hints::default(),
        );
        let (trace, dialect) = read.unwrap();
        assert_eq!(dialect.encoding, encoding);
        assert_eq!(trace.channel("x").unwrap().samples[3], -0.75);
        assert_eq!(trace.channels[1].name, "µ");
    }
    let quoted = table("\",\"", true, "\"", "\"");
    let (names, dialect) = read_back(&format!("\"t\",\"x (mm)\",\"a,b\"\n{quoted}"));
    assert_eq!(names, ["x|mm", "a,b|"]);
    assert_eq!(dialect, "separator ',', decimal ',', 0 header lines, UTF-8");
}

#[test]
fn what_is_not_clear_is_refused_and_what_the_caller_says_holds() {
    let clear: String = (0..20)
        .map(|k| format!("{k},234;5,{}78\n", 6 + k))
        .collect();
    let (trace, _) = read_text(&format!("t;x\n{clear}"), &Hints::default()).unwrap();
    assert_eq!(
        (trace.time_s[2], trace.channels[0].samples[2]),
        (2.234, 5.878)
    );
    let unclear = clear.replace(';', ",");
    let refused = |text: &str, hints: &Hints| read_text(text, hints).unwrap_err();
    let message = refused(&format!("t,x\n{unclear}"), &Hints::default());
    assert!(
        message.contains("line 2: the line has 4 cells, the header has 2"),
        "{message}"
    );
    assert!(
        message.contains("export it with another separator or with decimal points"),
        "{message}"
    );

    let two = "Motor,t,x\nof,t,x\n".to_owned() + &unclear.replace(",234", "").replace("5,", "5.5,");
    let hints = |header_lines| Hints {
        header_lines: Some(header_lines),
        ..Hints::default()
    };
    assert!(refused(&two, &hints(40)).contains("no line with names stands behind 40 header lines"));
    let said = Hints {
        separator: Some(Separator::Semicolon),
        decimal: Some(Decimal::Point),
        ..Hints::default()
    };
    let message = refused(&format!("t;x\n{clear}"), &said);
    assert!(
        message.contains("line 2, column 1 `t`: the time stamp `0,234` is no finite number"),
        "{message}"
    );
    let (trace, dialect) = read_text(&format!("a;b\nt;x\n{clear}"), &hints(1)).unwrap();
    assert_eq!(
        (trace.channels[0].name.as_str(), dialect.header_lines),
        ("x", 1)
    );
}

#[test]
fn a_fault_in_an_early_row_does_not_hide_the_row_of_units() {
    let text = format!(
        "t;x;y\ns;mm;V\n0,1;1,5;2,5\n0,2;far;2,5\n{}",
        table(";", true, "", "")
    );
    let message = read_text(&text, &Hints::default()).unwrap_err();
    let expected = "line 4, column 2 `x`: `far` is no finite number";
    assert!(message.contains(expected), "{message}");
}

#[test]
fn a_fault_below_a_header_block_has_its_place() {
    let good = format!("Recorder;x\n\nt;x;y\ns;mm;V\n{}", table(";", true, "", ""));
    for (line, expected) in [
        (
            "9,5;far;1",
            "line 25, column 2 `x`: `far` is no finite number",
        ),
        ("9,5;1", "line 25: the line has 2 cells, the header has 3"),
        (
            "0,1;1;1",
            "line 25, column 1 `t`: the time stamp 0.1 s goes backward",
        ),
    ] {
        let message = read_text(&format!("{good}{line}\n"), &Hints::default()).unwrap_err();
        assert!(message.contains(expected), "{message} lacks {expected}");
    }
}

/// Writes a recording as a logger of that dialect would; no helper of the reader is used.
fn written(
    trace: &Trace,
    separator: &str,
    comma: bool,
    head: &str,
    units: bool,
    wide: bool,
) -> Vec<u8> {
    let quoted = |cell: String| match cell.contains([',', ';', '\t', '"', ' ']) {
        true => format!("\"{}\"", cell.replace('"', "\"\"")),
        false => cell,
    };
    let number = |x: f64| match (x.is_nan(), comma) {
        (true, _) => String::new(),
        (false, true) => format!("{x:e}").replace('.', ","),
        (false, false) => format!("{x:?}"),
    };
    let line = |cells: Vec<String>| {
        cells
            .into_iter()
            .map(quoted)
            .collect::<Vec<_>>()
            .join(separator)
            + "\r\n"
    };
    let channels = || trace.channels.iter();
    let mut text = head.to_owned();
    text += &line(
        ["t".to_owned()]
            .into_iter()
            .chain(channels().map(|c| c.name.clone()))
            .collect(),
    );
    if units {
        text += &line(
            ["s".to_owned()]
                .into_iter()
                .chain(channels().map(|c| c.unit.clone()))
                .collect(),
        );
    }
    for (k, &time_s) in trace.time_s.iter().enumerate() {
        text += &line(
            [time_s]
                .into_iter()
                .chain(channels().map(|c| c.samples[k]))
                .map(number)
                .collect(),
        );
    }
    match wide {
        true => format!("\u{feff}{text}")
            .encode_utf16()
            .flat_map(u16::to_le_bytes)
            .collect(),
        false => text.into_bytes(),
    }
}

prop_compose! {
    fn any_trace()(
        steps in prop::collection::vec(1e-9..1e3_f64, 17..40),
        start_s in -1e4..1e4_f64,
        names in prop::collection::btree_set("[a-su-z][a-z\"µ;]{0,5}x", 1..4),
        unit in prop::sample::select(vec!["N·m", "mm", "deg/s", "V"]),
        values in prop::collection::vec(
            prop_oneof![9 => prop::num::f64::NORMAL | prop::num::f64::SUBNORMAL | prop::num::f64::ZERO, 1 => Just(f64::NAN)], 160),
    ) -> Trace {
        let mut time_s: Vec<f64> = steps.iter().scan(start_s, |t, step| { *t += step; Some(*t) }).collect();
        time_s.dedup();
        let count = time_s.len();
        let channels = names.into_iter().enumerate().map(|(k, name)| Channel {
            name, unit: unit.to_string(),
            samples: values.iter().cycle().skip(11 * k).take(count).copied().collect(),
        });
        Trace { channels: channels.collect(), time_s }
    }
}

proptest! {
    #[test]
    fn a_recording_in_any_dialect_reads_back_bit_for_bit(
        trace in any_trace(),
        (separator, comma) in prop::sample::select(vec![
            (",", false), (",", true), (";", false), (";", true), ("\t", false), ("\t", true)]),
        head in prop::sample::select(vec!["", "# a remark\n", "Recorder 1\n\nDate: 2024-05-06\n", "a;b;c\n"]),
        units in any::<bool>(),
        wide in any::<bool>(),
    ) {
        prop_assume!(trace.len() >= LEAST_SAMPLES);
        let bytes = written(&trace, separator, comma, head, units, wide);
        let (back, dialect) = parse_as(bytes.as_slice(), Path::new("run.csv"), None, &Hints::default()).unwrap();
        let name = if separator == "\t" { "tab" } else { separator };
        prop_assert_eq!((dialect.separator.name(), dialect.units_row), (name, units));
        let bits = |values: &[f64]| -> Vec<Option<u64>> {
            values.iter().map(|x| (!x.is_nan()).then_some(x.to_bits())).collect()
        };
        prop_assert_eq!(bits(&back.time_s), bits(&trace.time_s));
        prop_assert_eq!(back.channels.len(), trace.channels.len());
        for (read, wrote) in back.channels.iter().zip(&trace.channels) {
            prop_assert_eq!(&read.name, &wrote.name);
            prop_assert_eq!(&read.unit, if units { &wrote.unit } else { "" });
            prop_assert_eq!(bits(&read.samples), bits(&wrote.samples));
        }
    }
}
