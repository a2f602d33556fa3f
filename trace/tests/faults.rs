//! This file holds faults of text files, kind by kind, each made by a few lines of code with the right answer known.

#[path = "faults/clocks.rs"]
mod clocks;

use std::path::Path;

use rigproof_trace::csv::{Known, Text, TimeColumn, parse_text};

/// Rows of a time, a position and a command, 0.5 s to 0.79 s at 100 Hz.
fn rows(separator: &str) -> String {
    let row = |k: usize| {
        let k = k as f64;
        let cells =
            [0.5 + 0.01 * k, 1.5 - 0.75 * k, -3.25e-3 * (k + 0.5)].map(|x| format!("{x:.6}"));
        cells.join(separator) + "\n"
    };
    (0..30).map(row).collect()
}

fn read(bytes: &[u8], wanted: Option<&[&str]>) -> Result<Text, String> {
    let known = Known {
        wanted,
        ..Known::default()
    };
    parse_text(bytes, Path::new("run.csv"), &known).map_err(|error| error.to_string())
}

/// Checks that the position of the file is that of [`rows`] at its times, `from_s` earlier, and gives the remarks.
fn reads(name: &str, text: &str, from_s: f64) -> String {
    reads_bytes(name, text.as_bytes(), from_s)
}

fn reads_bytes(name: &str, bytes: &[u8], from_s: f64) -> String {
    let text = read(bytes, Some(&[name])).unwrap();
    let (trace, remarks) = (text.trace, text.remarks.join("\n"));
    assert_eq!((trace.len(), trace.channels.len()), (30, 1), "{remarks}");
    for (k, (time_s, x)) in trace
        .time_s
        .iter()
        .zip(&trace.channels[0].samples)
        .enumerate()
    {
        let k = k as f64;
        assert!(
            (time_s - (0.5 + 0.01 * k - from_s)).abs() < 1e-9,
            "{time_s} {remarks}"
        );
        assert!((x - (1.5 - 0.75 * k)).abs() < 1e-9, "{x} {remarks}");
    }
    remarks
}

/// Every row with another cell at its end.
fn with_column(head: &str, cell: impl Fn(usize) -> String) -> String {
    let rows = rows(",");
    let lines = rows
        .lines()
        .enumerate()
        .map(|(k, line)| format!("{line},{}\n", cell(k)));
    format!("t,x,u,{head}\n{}", lines.collect::<String>())
}

#[test]
fn columns_that_nobody_needs_are_passed_over_and_named() {
    let states = ["idle", "run", "3"];
    for (text, said) in [
        (with_column("state", |k| states[k % 3].into()), "`state`"),
        (with_column("state", |_| "idle".into()), "`state` (text)"),
        (
            with_column("enabled", |k| {
                if k % 2 == 0 { "True" } else { "False" }.into()
            }),
            "`enabled` (text)",
        ),
        (
            with_column("temp", |k| if k > 3 { "nan" } else { "21.5" }.into()),
            "`temp`",
        ),
        (
            with_column("note", |k| {
                if k == 7 { "\"cable moved, again\"" } else { "" }.into()
            }),
            "`note`",
        ),
        (with_column("", |k| k.to_string()), "column 4 (no name)"),
    ] {
        let remarks = reads("x", &text, 0.0);
        assert!(
            remarks.contains("passed over: ") && remarks.contains(said),
            "{remarks}"
        );
    }
    // Where no rig says what is needed, all that holds numbers is.
    let all = read(with_column("state", |_| "idle".into()).as_bytes(), None).unwrap();
    let names: Vec<&str> = all.trace.channels.iter().map(|c| c.name.as_str()).collect();
    assert_eq!(
        (names, all.remarks),
        (
            vec!["x", "u"],
            vec!["passed over: `state` (text)".to_owned()]
        )
    );
    let message = read(
        with_column("state", |_| "idle".into()).as_bytes(),
        Some(&["state"]),
    )
    .unwrap_err();
    assert!(
        message.contains("line 2, column 4 `state`: `idle` is no finite number"),
        "{message}"
    );
}

#[test]
fn a_sample_that_is_said_to_be_missing_is_missing() {
    for word in ["nan", "NaN", "", "NA", "null", "-nan(ind)", "#N/A"] {
        let text = format!("t,x,u\n{}", rows(",").replace("-3.750000", word));
        let trace = read(text.as_bytes(), Some(&["x"])).unwrap().trace;
        let missing: Vec<usize> = (0..30)
            .filter(|k| trace.channels[0].samples[*k].is_nan())
            .collect();
        assert_eq!(missing, [7], "{word}");
    }
    let message = read(
        format!("t,x,u\n{}", rows(",").replace("-3.750000", "inf")).as_bytes(),
        None,
    );
    assert!(
        message
            .unwrap_err()
            .contains("`inf` is no finite number; leave the cell empty, or write `nan`")
    );
}

#[test]
fn time_is_found_under_the_names_that_loggers_give_it() {
    for name in [
        "t",
        "Time",
        "timestamp",
        "Time Stamp",
        "%time",
        "__time",
        "Zeit",
        "secs",
        "t / s",
        "Elapsed Time (s)",
        "Zeit [s]",
        "time_s",
        "Seconds",
        "rosTime",
    ] {
        let remarks = reads("x", &format!("{name},x,u\n{}", rows(",")), 0.0);
        assert_eq!(remarks, "passed over: `u`", "{name}");
        let rows = rows(",");
        let last = rows.lines().map(|line| {
            let (time, rest) = line.split_once(',').unwrap();
            format!("{rest},{time}\n")
        });
        reads(
            "x",
            &format!("x,u,{name}\n{}", last.collect::<String>()),
            0.0,
        );
    }
    let in_ms: String = (0..30)
        .map(|k| format!("{},{}\n", 500 + 10 * k, 1.5 - 0.75 * f64::from(k)))
        .collect();
    for name in [
        "millis",
        "time (ms)",
        "t_ms",
        "Zeit / ms",
        "Back-end Time [ms]",
    ] {
        reads("x", &format!("{name},x\n{in_ms}"), 0.0);
    }
}

#[test]
fn separators_are_found_by_the_rows_and_not_by_the_header() {
    for (head, separator) in [
        ("t,x,u", "\t"),
        ("t,x,u", "  "),
        ("t\tx\tu", ","),
        ("t;x;u", ","),
        ("Elapsed Time (s)  x  u", " "),
        ("\"t\",\"x\",\"u\"", ";"),
    ] {
        reads("x", &format!("{head}\n{}", rows(separator)), 0.0);
    }
    let commas = rows(";").replace('.', ",");
    reads("x", &format!("t;x;u, filtered\n{commas}"), 0.0);
    // A text beside the numbers does not hide the separator.
    let noted: String = rows(";")
        .lines()
        .map(|line| format!("{line};warm, and quiet\n"))
        .collect();
    reads("x", &format!("t;x;u;note\n{noted}"), 0.0);
}

#[test]
fn numpy_and_others_write_the_names_into_a_comment() {
    for (head, separator) in [
        ("# t,q,u", ","),
        ("# t q u", " "),
        ("# t,q,u", " "),
        ("% recorded on Monday\n% t, q, u", ","),
        ("%time,q,u", ","),
        ("# a remark of six words stands here\n# t,q,u", ","),
    ] {
        let remarks = reads("q", &format!("{head}\n{}", rows(separator)), 0.0);
        assert_eq!(remarks, "passed over: `u`", "{head}");
    }
}

#[test]
fn pandas_and_r_put_the_index_first() {
    let indexed = |first: usize| {
        let rows = rows(",");
        let lines = rows
            .lines()
            .enumerate()
            .map(move |(k, line)| format!("{},{line}\n", k + first));
        lines.collect::<String>()
    };
    for head in [",t,x,u", "Unnamed: 0,t,x,u", "index,t,x,u"] {
        reads("x", &format!("{head}\n{}", indexed(0)), 0.0);
    }
    // R gives the column of row names no name at all.
    reads("x", &format!("t,x,u\n{}", indexed(1)), 0.0);
    // An index that is the time.
    let remarks = reads("x", &format!(",x,u\n{}", rows(",")), 0.0);
    assert!(
        remarks.contains("column 1 has no name") && remarks.contains("a guess"),
        "{remarks}"
    );
    // One that only counts is no time.
    let message = read(
        format!(
            ",x,u\n{}",
            rows(",")
                .lines()
                .enumerate()
                .map(|(k, line)| {
                    let (_, rest) = line.split_once(',').unwrap();
                    format!("{k},{rest}\n")
                })
                .collect::<String>()
        )
        .as_bytes(),
        None,
    )
    .unwrap_err();
    assert!(
        message.contains("there is no time column; call it `time (s)`"),
        "{message}"
    );
}

#[test]
fn a_file_without_a_header_is_read_by_the_numbers_of_its_columns() {
    for separator in [",", ";", " ", "\t"] {
        let remarks = reads("column 2", &rows(separator), 0.0);
        assert!(
            remarks.contains("there is no header: the columns are called `column 1` to `column 3`"),
            "{remarks}"
        );
        assert!(
            remarks.contains("taken for the time in s: a guess"),
            "{remarks}"
        );
    }
    let time = TimeColumn {
        name: "column 1".into(),
        unit: "ms".into(),
    };
    let known = Known {
        time: Some(&time),
        ..Known::default()
    };
    let text = parse_text(rows(",").as_bytes(), Path::new("run.csv"), &known).unwrap();
    assert!((text.trace.time_s[3] - 0.53e-3).abs() < 1e-15);
    let falling: String = rows(",")
        .lines()
        .map(|line| {
            let (time, rest) = line.split_once(',').unwrap();
            format!("{rest},{time}\n")
        })
        .collect();
    assert!(
        read(falling.as_bytes(), None)
            .unwrap_err()
            .contains("put a header over it")
    );
}

#[test]
fn western_letters_of_one_byte_are_read() {
    for (name, unit, letters) in [
        ("Winkel", "°", &b"Winkel (\xb0)"[..]),
        ("Weg", "µm", b"Weg (\xb5m)"),
        ("Kr\u{e4}fte", "N", b"Kr\xe4fte (N)"),
    ] {
        let bytes = [b"t,", letters, b",u\n", rows(",").as_bytes()].concat();
        reads_bytes(name, &bytes, 0.0);
        let text = read(&bytes, Some(&[name])).unwrap();
        assert_eq!(text.trace.channels[0].unit, unit);
        assert!(text.dialect.to_string().ends_with("Latin-1"));
    }
}

#[test]
fn labview_measurements_of_every_form_are_read() {
    let head = |columns: &str| {
        format!(
            "LabVIEW Measurement\t\nWriter_Version\t2\nSeparator\tTab\nDecimal_Separator\t.\nMulti_Headings\tNo\nX_Columns\t{columns}\n\
             ***End_of_Header***\t\n\t\nChannels\t2\t\t\nSamples\t30\t30\t\nX0\t0.5\t0.5\t\nDelta_X\t0.01\t0.01\t\n***End_of_Header***\t\t\t\n"
        )
    };
    let line = |k: usize, form: &str| {
        let rows = rows("\t");
        let cells: Vec<&str> = rows.lines().nth(k).unwrap().split('\t').collect();
        form.replace('T', cells[0])
            .replace('X', cells[1])
            .replace('U', cells[2])
            + "\n"
    };
    let body = |form: &str| (0..30).map(|k| line(k, form)).collect::<String>();
    for (columns, names, form) in [
        ("One", "X_Value\tx\tu\tComment", "T\tX\tU"),
        ("Multi", "X_Value\tx\tX_Value\tu\tComment", "T\tX\tT\tU"),
        ("No", "X_Value\tx\tu\tComment", "\tX\tU"),
        ("No", "X_Value\tx\tu\tComment", "X\tU"),
        ("No", "x\tu\tComment", "X\tU"),
    ] {
        reads(
            "x",
            &format!("{}{names}\n{}", head(columns), body(form)),
            0.0,
        );
    }
    // Parts with a head each.
    let part = "Channels\t2\t\t\nSamples\t15\t15\t\nX0\t0.65\t0.65\t\nDelta_X\t0.01\t0.01\t\n***End_of_Header***\t\t\t\nX_Value\tx\tu\tComment\n";
    let halves = |from: usize| {
        (from..from + 15)
            .map(|k| line(k, "T\tX\tU"))
            .collect::<String>()
    };
    let text = format!(
        "{}X_Value\tx\tu\tComment\n{}\t\n{part}{}",
        head("One"),
        halves(0),
        halves(15)
    );
    reads("x", &text, 0.0);
}

#[test]
fn a_line_that_the_end_of_the_file_cuts_is_left_out_and_said() {
    let whole = format!("t,x,u\n{}0.800000,-21.000000,-0.099125\n", rows(","));
    for cut in [3, 9, 12, 24] {
        let text = &whole[..whole.len() - cut];
        let remarks = reads("x", text, 0.0);
        assert!(
            remarks.contains("line 32 is cut off by the end of the file, and left out"),
            "{remarks}"
        );
    }
    // Without its line feed only, the line is whole.
    let text = read(whole.trim_end().as_bytes(), None).unwrap();
    assert_eq!((text.trace.len(), text.remarks.len()), (31, 0));
}

#[test]
fn a_file_compressed_with_gzip_is_read() {
    use std::io::Write;
    for separator in [",", ";", "\t"] {
        let mut packed = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::default());
        packed
            .write_all(format!("t{separator}x{separator}u\n{}", rows(separator)).as_bytes())
            .unwrap();
        reads_bytes("x", &packed.finish().unwrap(), 0.0);
    }
}
