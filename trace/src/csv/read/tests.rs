//! This file holds what must be read, and what must be refused with one clear sentence.

use super::*;

fn rows(count: usize) -> String {
    (0..count)
        .map(|i| format!("{}.5,{}e-1\n", i, 3 * i + 1))
        .collect()
}

fn read_text(text: &[u8]) -> Result<Trace, String> {
    parse(text, Path::new("run.csv"), None).map_err(|error| error.to_string())
}

#[test]
fn windows_files_with_comments_and_a_byte_order_mark_are_read() {
    let body = rows(16).replace('\n', "\r\n");
    let text = format!("\u{feff}# a comment\r\n\r\n\"t_s\",\"x (mm)\" \r\n# another\r\n{body}");
    let trace = read_text(text.as_bytes()).unwrap();
    assert_eq!(trace.len(), 16);
    assert_eq!(trace.time_s[3], 3.5);
    let x = trace.channel("x").unwrap();
    assert_eq!((x.unit.as_str(), x.samples[2]), ("mm", 0.7));
}

#[test]
fn columns_in_any_order_with_gaps_and_other_units_of_time_are_read() {
    let mut text = "force,time [ms],t_N\n".to_string();
    for i in 0..20 {
        text += &format!("{},{},1.5\n", if i == 4 { "" } else { " 2.5" }, 10 * i * i);
    }
    let trace = read_text(text.as_bytes()).unwrap();
    assert!((trace.time_s[3] - 0.09).abs() < 1e-15);
    assert!(trace.channel("force").unwrap().samples[4].is_nan());
    let named = trace.channel("t_N").unwrap();
    assert_eq!((named.unit.as_str(), named.likely_unit()), ("", "N"));
}

#[test]
fn the_caller_may_name_the_time() {
    let text = format!("stamp,x\n{}", rows(16));
    let column = TimeColumn {
        name: "stamp".into(),
        unit: "ms".into(),
    };
    let trace = parse(text.as_bytes(), Path::new("run.csv"), Some(&column)).unwrap();
    assert_eq!(trace.time_s[2], 2.5 * 1e-3);
    assert!(
        read_text(text.as_bytes())
            .unwrap_err()
            .contains("no time column")
    );
}

#[test]
fn every_fault_of_a_file_has_its_place_and_its_remedy() {
    let good = rows(16);
    let insert = |line: &str| format!("t,x\n{good}{line}\n");
    for (text, expected) in [
        (String::new(), "the file is empty"),
        ("t,x\n".into(), "has 0 samples, at least 16"),
        (format!("t,x\n{}", rows(2)), "has 2 samples"),
        (format!("a,b\n{good}"), "line 1: there is no time column"),
        (
            good.replace("0.5,", "99.5,"),
            "the first line holds numbers",
        ),
        (
            format!("time (m),x\n{good}"),
            "line 1, column 1 `time`: `m` is no unit of time",
        ),
        (
            format!("t,t (ms)\n{good}"),
            "column 2 `t`: the name stands over column 1",
        ),
        (
            "t,x,y\n1,0,0\n2,0,0\n3,0,far\n3,0,\n4,0,\n".into(),
            "line 4, column 3 `y`: `far` is no finite number",
        ),
        (insert("90,-inf"), "`-inf` is no finite number"),
        (insert("90,1e999"), "`1e999` is no finite number"),
        (insert("90,3 mm"), "`3 mm` is no finite number"),
        (
            insert("90"),
            "line 18: the line has 1 cells, the header has 2",
        ),
        (insert("90,1,2"), "the line has 3 cells"),
        (insert("90,\"1"), "the line has 1 cells"),
        (
            insert(",1"),
            "line 18, column 1 `t`: the time stamp is missing",
        ),
        (
            insert("15.5,1"),
            "line 18, column 1 `t`: the time stamp is repeated, and",
        ),
        (
            insert("3,1"),
            "the time stamp 3 s goes backward after 15.5 s",
        ),
        (insert("90,\0"), "line 18: the file holds NUL bytes"),
        (insert("90,1\r91,1"), "carriage return"),
        (
            insert(&"9".repeat(1 << 21)),
            "line 18: the line is longer than 1 MiB",
        ),
    ] {
        let message = read_text(text.as_bytes()).unwrap_err();
        assert!(message.contains(expected), "{message} lacks {expected}");
        assert!(
            message.starts_with("run.csv") && !message.contains('\n'),
            "{message}"
        );
    }
}

#[test]
fn a_file_that_cannot_be_opened_says_why() {
    let missing = read(Path::new("no/such/run.csv")).unwrap_err().to_string();
    assert!(missing.contains("no such file"), "{missing}");
    let folder = read(Path::new(".")).unwrap_err().to_string();
    assert!(folder.contains("it is a folder"), "{folder}");
}
